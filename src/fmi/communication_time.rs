//! Time as the importer keeps it, and how far its communication points may be from ours.

use super::instance::{Message, Outcome, refuse};
use serde::{Deserialize, Serialize};

/// Rounding errors, in units of the last place of the largest time so far, that an importer may
/// make from one communication point to the next: it adds steps up, multiplies them by their
/// number, or divides an interval.
const ROUNDING_ULPS: f64 = 16.0;

/// Largest part of a step that counts as a rounding error.
const PART_OF_STEP: f64 = 0.01;

/// Rounding errors of an importer that keeps time in single precision, in units of its last place.
const SINGLE_PRECISION_ULPS: f64 = 4.0;

/// Time as the importer keeps it, s.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Experiment {
    pub start_time: f64,
    /// The present.
    pub time: f64,
    pub stop_time: Option<f64>,
}

impl Experiment {
    /// An experiment that is at its start. An error if its times make no sense.
    pub fn new(start_time: f64, stop_time: Option<f64>) -> Result<Self, Message> {
        if !start_time.is_finite() {
            refuse(format!(
                "startTime = {start_time} is not finite; pass a finite time"
            ))?;
        }
        if let Some(stop) = stop_time
            && (stop.is_nan() || stop < start_time)
        {
            refuse(format!(
                "stopTime = {stop} s is before startTime = {start_time} s; pass a later stopTime or none"
            ))?;
        }
        Ok(Self {
            start_time,
            time: start_time,
            stop_time,
        })
    }

    /// The end of a step that begins at the communication point `point`. An error if a step there
    /// makes no sense.
    pub fn end_of_step(&self, point: f64, step: f64) -> Result<f64, Message> {
        if step <= 0.0 || !step.is_finite() {
            refuse(format!(
                "communicationStepSize = {step} s; the step must be positive and finite"
            ))?;
        }
        self.check_point(point, step)?;
        let end = point + step;
        if end <= point || end.is_infinite() {
            refuse(format!(
                "communicationStepSize = {step} s is too small to change the time {point} s; take longer steps"
            ))?;
        }
        // The importer's rounding errors have added up since the start.
        let steps = (end - self.start_time).abs() / step;
        if let Some(stop) = self.stop_time
            && end > stop + self.tolerance(stop, step, ROUNDING_ULPS + steps)
        {
            refuse(format!(
                "the step would end at {end} s, past stopTime = {stop} s; shorten it or define no stopTime"
            ))?;
        }
        Ok(end)
    }

    /// An error if the importer's point is not ours.
    fn check_point(&self, point: f64, step: f64) -> Outcome {
        let drift = (point - self.time).abs();
        if drift <= self.tolerance(self.time, step, ROUNDING_ULPS) {
            return Ok(());
        }
        let is_single = |value: f64| f64::from(value as f32) == value;
        let ulp = f64::from(f32::EPSILON) * point.abs().max(step);
        let cause = if is_single(point) && is_single(step) && drift <= SINGLE_PRECISION_ULPS * ulp {
            "; the importer seems to keep time in single precision, whose rounding errors are too large for this step: keep it in double precision"
        } else {
            ""
        };
        refuse(format!(
            "currentCommunicationPoint = {point} s, but the last step ended at {} s; continue from there{cause}",
            self.time
        ))
    }

    /// How far the importer's time may be from ours, s, with a number of rounding errors.
    fn tolerance(&self, time: f64, step: f64, errors: f64) -> f64 {
        let largest = self.start_time.abs().max(time.abs()).max(step);
        (errors * f64::EPSILON * largest).min(PART_OF_STEP * step)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(time: f64, stop_time: Option<f64>) -> Experiment {
        let start_time = time;
        Experiment {
            start_time,
            time,
            stop_time,
        }
    }

    fn refusal(experiment: Experiment, point: f64, step: f64) -> String {
        match experiment.end_of_step(point, step) {
            Err(Message::Error(text)) => text,
            Err(Message::Warning(text)) => panic!("a warning: {text}"),
            Ok(end) => panic!("the step was accepted; it ends at {end}"),
        }
    }

    /// Every way in which an importer computes its points, at times large and small.
    #[test]
    fn rounding_errors_of_importers_are_accepted() {
        for start in [0.0, -1.0, 1e3, 1e6, -1e6] {
            for step in [1e-5, 1e-3, 0.1, 1.0 / 3.0] {
                let stop = start + 2000.0 * step;
                let interval = |i: u32| start + (stop - start) * (f64::from(i) / 2000.0);
                let mut sum = start;
                let mut by_sum = at(start, Some(stop));
                let mut by_number = at(start, Some(stop));
                let mut by_interval = at(start, Some(stop));
                for i in 0..2000 {
                    by_sum.time = by_sum.end_of_step(sum, step).ok().unwrap();
                    sum += step;
                    let point = start + f64::from(i) * step;
                    by_number.time = by_number.end_of_step(point, step).ok().unwrap();
                    let (point, next) = (interval(i), interval(i + 1));
                    by_interval.time = by_interval.end_of_step(point, next - point).ok().unwrap();
                }
            }
        }
    }

    /// Sums of many steps, which end up to 2e-8 s late.
    #[test]
    fn an_importer_that_adds_its_steps_up_reaches_the_stop_time() {
        for (step, count) in [(0.1, 100_000), (0.001, 100_000), (0.01, 10_000)] {
            let mut experiment = at(0.0, Some(step * f64::from(count)));
            for _ in 0..count {
                experiment.time = experiment.end_of_step(experiment.time, step).ok().unwrap();
            }
            refusal(experiment, experiment.time, step);
        }
    }

    #[test]
    fn at_a_late_start_a_point_counts_once() {
        let mut experiment = at(1e6, None);
        experiment.time = experiment.end_of_step(1e6, 1e-3).ok().unwrap();
        let text = refusal(experiment, 1e6, 1e-3);
        assert!(text.contains("ended at 1000000.001 s; continue"), "{text}");
    }

    #[test]
    fn a_long_step_ends_at_the_stop_time() {
        let text = refusal(at(0.0, Some(1000.0)), 0.0, 1000.9);
        assert!(text.contains("past stopTime = 1000 s"), "{text}");
        refusal(at(0.0, Some(1000.0)), 0.0, 1000.0 + 1e-9);
        assert_eq!(at(0.0, Some(1e3)).end_of_step(0.0, 1e3).ok(), Some(1e3));
    }

    #[test]
    fn an_importer_in_single_precision_gets_a_sentence() {
        let mut experiment = at(0.0, None);
        let (mut time, step) = (0.0_f32, 0.01_f32);
        let text = loop {
            match experiment.end_of_step(time.into(), step.into()) {
                Ok(end) => experiment.time = end,
                Err(Message::Error(text) | Message::Warning(text)) => break text,
            }
            time += step;
        };
        assert!(text.contains("single precision"), "{text}");
        assert!(time < 1.0, "refused at once, not after {time} s");
        // Another point is another matter.
        let text = refusal(at(16.0, None), 16.5, 0.5);
        assert!(!text.contains("single precision"), "{text}");
    }

    #[test]
    fn a_step_changes_the_time() {
        let text = refusal(at(1e6, None), 1e6, 1e-12);
        assert!(text.contains("too small to change the time"), "{text}");
    }
}
