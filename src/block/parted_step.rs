//! Steps in parts: to the time of an event, and with inputs that the importer sets within a step.

use super::{
    BlockError, Fresh, RotorBlock,
    flight_condition::FlightCondition,
    integrate::{Integration, Memory},
    ramp::Slopes,
    references::Reals,
    variables::{INPUTS, integer, real},
};

/// The values of all Real inputs.
pub type Inputs = [f64; INPUTS];

/// Halvings of a step in the search for the time of an event, which then is known to a thousandth
/// of the step.
const HALVINGS: usize = 10;

/// Largest number of parts of a step, which keeps the number of calls to the importer bounded.
const MAX_PARTS: f64 = 1000.0;

/// What a step changes in a block, to return to.
#[derive(Clone, Copy)]
pub struct Moment {
    reals: Reals,
    shown_flow_state: i32,
    flow_state: i32,
    memory: Memory,
    slopes: Slopes,
    past_slopes: Slopes,
    fresh: Fresh,
}

impl RotorBlock {
    pub fn moment(&self) -> Moment {
        Moment {
            reals: self.values.reals,
            shown_flow_state: self.values.integers[integer::FLOW_STATE],
            flow_state: self.flow_state,
            memory: self.memory,
            slopes: self.ramp.slopes,
            past_slopes: self.ramp.past,
            fresh: self.fresh,
        }
    }

    pub fn return_to(&mut self, moment: &Moment) {
        self.values.reals = moment.reals;
        self.values.integers[integer::FLOW_STATE] = moment.shown_flow_state;
        self.flow_state = moment.flow_state;
        self.memory = moment.memory;
        self.ramp.slopes = moment.slopes;
        self.ramp.past = moment.past_slopes;
        self.fresh = moment.fresh;
    }

    /// The discrete output keeps its value until the next event.
    pub fn hold_flow_state(&mut self) {
        self.holds_flow_state = true;
    }

    /// Whether the discrete output waits for an event to get its new value.
    pub fn is_event_pending(&self) -> bool {
        self.values.integers[integer::FLOW_STATE] != self.flow_state
    }

    /// Advances as `step`. If an event comes up, the step ends just after it: within a thousandth
    /// of `duration`. Returns the duration of the step. An event that is still pending when the
    /// step begins does not end it again.
    pub fn step_to_event(&mut self, duration: f64) -> Result<f64, BlockError> {
        let is_known = self.is_event_pending();
        let begin = self.moment();
        self.step(duration)?;
        if is_known || !self.is_event_pending() {
            return Ok(duration);
        }
        let (mut before, mut after) = (0.0, duration);
        for _ in 0..HALVINGS {
            let middle = 0.5 * (before + after);
            self.return_to(&begin);
            self.step(middle)?;
            if self.is_event_pending() {
                after = middle;
            } else {
                before = middle;
            }
        }
        self.return_to(&begin);
        self.step(after)?;
        Ok(after)
    }

    pub fn inputs(&self) -> Inputs {
        core::array::from_fn(|i| (*self.values.reals)[i])
    }

    /// Advances as `step`, or as `step_to_event`, while the inputs move linearly from `before` to
    /// their present values. Returns the duration of the step.
    pub fn step_from(
        &mut self,
        before: &Inputs,
        duration: f64,
        stops_at_event: bool,
    ) -> Result<f64, BlockError> {
        let after = self.inputs();
        let inputs = self.values.reals.iter_mut().zip(&mut self.ramp.slopes);
        for ((value, slope), (before, after)) in inputs.zip(before.iter().zip(after)) {
            if *before != after {
                *value = *before;
                *slope = (after - before) / duration;
            }
        }
        let advanced = if stops_at_event {
            self.step_to_event(duration)?
        } else {
            self.step(duration)?;
            duration
        };
        if advanced == duration {
            // As they were set, without the rounding errors of the slopes.
            for (value, after) in self.values.reals.iter_mut().zip(after) {
                *value = after;
            }
        }
        Ok(advanced)
    }

    /// Number of parts in which inputs that are curved in time can be followed during the next
    /// `duration` s: as long as the steps of the integration, or one part if nothing is integrated.
    pub fn parts_of_step(&mut self, duration: f64) -> Result<f64, BlockError> {
        let point = FlightCondition::new(&self.values)?.point;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        let rotor = self.rotor()?;
        if !rotor.has_memory(&point) {
            return Ok(1.0);
        }
        let speed = point.at_speed_of(&self.memory.state).speed;
        let cell = Integration {
            rotor: &rotor,
            workspace: &mut self.workspace,
            known_rates: &mut self.known_rates,
            azimuth_step,
        }
        .cell(&point, speed);
        Ok((duration / cell).ceil().clamp(1.0, MAX_PARTS))
    }

    /// Adds the work of the last step to that of the parts before it. An error if the sum exceeds
    /// the budget of a step.
    pub fn add_work(&self, before: u64) -> Result<u64, BlockError> {
        let budget = self.budget().left();
        let sum = before.saturating_add(self.workspace.work.done());
        if sum > budget {
            return Err(BlockError::TooMuchWork(budget));
        }
        Ok(sum)
    }
}
