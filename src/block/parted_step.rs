//! Steps in parts: to the time of an event, and with inputs that the importer sets within a step.

use super::{
    BlockError, Fresh, RotorBlock, Stage,
    beyond_stops::BeyondStopsNotice,
    flight_condition::FlightCondition,
    integrate::{Integration, Memory},
    limited_inputs::LimitedInputs,
    outside_data::OutsideDataNotice,
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
    /// Number of sentences for the log, and which of those that are said once have been said.
    notes: usize,
    limited_inputs: LimitedInputs,
    outside_data: OutsideDataNotice,
    beyond_stops: BeyondStopsNotice,
}

impl RotorBlock {
    /// The present moment, to return to. The rotor is made before, since that is not taken back.
    pub fn moment(&mut self) -> Result<Moment, BlockError> {
        self.rotor()?;
        Ok(Moment {
            reals: self.values.reals,
            shown_flow_state: self.values.integers[integer::FLOW_STATE],
            flow_state: self.flow_state,
            memory: self.memory,
            slopes: self.ramp.slopes,
            past_slopes: self.ramp.past,
            fresh: self.fresh,
            notes: self.notes.len(),
            limited_inputs: self.limited_inputs,
            outside_data: self.outside_data,
            beyond_stops: self.beyond_stops,
        })
    }

    pub fn return_to(&mut self, moment: &Moment) {
        self.values.reals = moment.reals;
        self.values.integers[integer::FLOW_STATE] = moment.shown_flow_state;
        self.flow_state = moment.flow_state;
        self.memory = moment.memory;
        self.ramp.slopes = moment.slopes;
        self.ramp.past = moment.past_slopes;
        self.fresh = moment.fresh;
        self.notes.truncate(moment.notes);
        self.limited_inputs = moment.limited_inputs;
        self.outside_data = moment.outside_data;
        self.beyond_stops = moment.beyond_stops;
    }

    /// Whether the discrete output keeps its value in steps. If it does not, it gets the present
    /// one.
    pub fn hold_flow_state(&mut self, holds: bool) {
        self.holds_flow_state = holds;
        if !holds && self.stage == Stage::Running && self.fresh == Fresh::All {
            self.values.integers[integer::FLOW_STATE] = self.flow_state;
        }
    }

    /// Whether the discrete output waits for an event to get its new value.
    pub fn is_event_pending(&self) -> bool {
        self.values.integers[integer::FLOW_STATE] != self.flow_state
    }

    /// Advances as `step`. If the flow state at the end is another, the step ends just after a
    /// change of it: within a thousandth of `duration`, or later where the work of a search would
    /// exceed the budget of a step, of which `spent` is used up. Returns the duration of the step.
    /// If an event is already pending at the beginning, the step goes to its end.
    pub fn step_to_event(&mut self, duration: f64, spent: u64) -> Result<f64, BlockError> {
        let is_known = self.is_event_pending();
        let begin = self.moment()?;
        self.step(duration)?;
        if is_known || !self.is_event_pending() {
            return Ok(duration);
        }
        let mut work = self.workspace.work.done();
        // A shorter step takes no more work than the whole one. The last step comes on top.
        let reserved = spent.saturating_add(2 * work);
        let most = self.budget().left().saturating_sub(reserved);
        let (mut before, mut after, mut reached) = (0.0, duration, duration);
        for _ in 0..HALVINGS {
            if work > most {
                break;
            }
            reached = 0.5 * (before + after);
            self.return_to(&begin);
            self.step(reached)?;
            work += self.workspace.work.done();
            if self.is_event_pending() {
                after = reached;
            } else {
                before = reached;
            }
        }
        if reached != after {
            self.return_to(&begin);
            self.step(after)?;
        } else {
            work -= self.workspace.work.done();
        }
        // The work of the last step and of those before it.
        self.workspace.work.count(work);
        Ok(after)
    }

    pub fn inputs(&self) -> Inputs {
        core::array::from_fn(|i| (*self.values.reals)[i])
    }

    /// Advances as `step`, or as `step_to_event`, while the inputs move linearly from `before` to
    /// their present values. Adds its work to that of the parts before it, and fails if the sum
    /// exceeds the budget of a step. Returns the duration of the step.
    pub fn step_from(
        &mut self,
        before: &Inputs,
        duration: f64,
        stops_at_event: bool,
        work: &mut u64,
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
            self.step_to_event(duration, *work)?
        } else {
            self.step(duration)?;
            duration
        };
        let budget = self.budget().left();
        *work = work.saturating_add(self.workspace.work.done());
        if *work > budget {
            return Err(BlockError::TooMuchWork(budget));
        }
        if advanced == duration {
            // As they were set, without the rounding errors of the slopes.
            for (value, after) in self.values.reals.iter_mut().zip(after) {
                *value = after;
            }
        }
        Ok(advanced)
    }

    /// Number of parts in which inputs that are curved in time can be followed during the next
    /// `duration` s: as long as the steps of the integration at their beginning, or one part if
    /// nothing is integrated.
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
}

#[cfg(test)]
mod tests {
    use super::super::variables::InflowModel;
    use super::*;

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    type Failure = Box<dyn std::error::Error>;

    /// A rotor whose inflow has states, and that will descend into the vortex ring in a step of
    /// 0.2 s.
    fn descending(budget: Option<u64>) -> Result<RotorBlock, Failure> {
        let mut block = RotorBlock::new(RESOURCES.into());
        let inflow = InflowModel::PittPetersDynamic as i32;
        block.set_integers(&[integer::MODELS__INFLOW], &[inflow])?;
        if let Some(budget) = budget {
            block.set_integers(&[integer::NUMERICS__BUDGET], &[budget.try_into()?])?;
        }
        block.start()?;
        block.hold_flow_state(true);
        block.take_notes();
        descend(&mut block)?;
        Ok(block)
    }

    fn descend(block: &mut RotorBlock) -> Result<(), Failure> {
        Ok(block.set_input_slopes(&[real::VELOCITY_3], &[-40.0])?)
    }

    const DURATION: f64 = 0.2;

    #[test]
    fn the_search_for_an_event_takes_no_more_than_the_budget_of_a_step() -> Result<(), Failure> {
        let mut block = descending(None)?;
        block.step(DURATION)?;
        let whole = block.workspace.work.done();
        let mut ends = Vec::new();
        for tenths in [11, 15, 29, 35, 50, 80, 200] {
            let budget = whole * tenths / 10;
            let mut block = descending(Some(budget))?;
            let advanced = block.step_to_event(DURATION, 0)?;
            let work = block.workspace.work.done();
            assert!(work <= budget, "{work} of {budget}");
            assert!(block.is_event_pending());
            ends.push(advanced);
            // What was spent before counts.
            let mut block = descending(Some(budget))?;
            block.step_to_event(DURATION, budget / 2)?;
            let work = block.workspace.work.done();
            assert!(work <= (budget / 2).max(whole), "{work} of {budget}");
        }
        assert_eq!(ends[..2], [DURATION; 2], "no search");
        assert!(ends.is_sorted_by(|a, b| a >= b), "{ends:?}");
        assert!(ends[6] < 0.95 * DURATION, "{ends:?}");
        Ok(())
    }

    /// The whole step, which the event cuts short, would leave the range of an input.
    #[test]
    fn nothing_is_said_of_moments_after_the_event() -> Result<(), Failure> {
        let mut block = descending(None)?;
        let height = real::HEIGHT_ABOVE_GROUND;
        let (begin, slope) = (block.values().reals[height], -6000.0);
        block.set_input_slopes(&[height], &[slope])?;
        let advanced = block.step_to_event(DURATION, 0)?;
        assert!(begin + slope * advanced > 0.0 && begin + slope * DURATION < 0.0);
        assert_eq!(block.take_notes(), []);
        // But when that moment comes.
        block.set_input_slopes(&[height], &[slope])?;
        block.step(DURATION)?;
        assert_eq!(block.take_notes().len(), 1);
        Ok(())
    }
}
