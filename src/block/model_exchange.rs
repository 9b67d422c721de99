//! States and derivatives for an importer that integrates (Model Exchange).

use super::{
    BlockError, Fresh, RotorBlock, Stage, ValueError,
    computation::check_finite,
    flight_condition::FlightCondition,
    state_vector::{StateVector, write_derivatives},
    variables::{DriveMode, STATES, integer},
};
use rotor::Rotor;
use std::sync::Arc;

impl RotorBlock {
    /// Starts an integration by the importer: it sets the states, and discrete variables keep their
    /// values until the next event.
    pub fn begin_integration(&mut self) -> Result<(), BlockError> {
        self.update()?;
        self.stage = Stage::Integrating;
        Ok(())
    }

    /// Whether the value of a discrete variable is out of date, so that an event is due.
    pub fn has_event(&mut self) -> Result<bool, BlockError> {
        self.update()?;
        Ok(self.is_event_pending())
    }

    /// Begins an event: discrete variables get their new values, and tunable parameters may be set.
    pub fn begin_event(&mut self) {
        self.stage = Stage::Running;
        self.hold_flow_state(false);
    }

    /// The continuous states in the order of `STATES`. While the block is being configured, they
    /// are the states at the start.
    pub fn states(&mut self) -> Result<StateVector, BlockError> {
        if self.stage == Stage::Configuring {
            self.update()?;
        }
        Ok(STATES.map(|row| self.values.reals[row.value]))
    }

    /// Sets the continuous states. If one is refused, none is set.
    pub fn set_states(&mut self, states: &[f64]) -> Result<(), ValueError> {
        if states.len() != STATES.len() {
            let given = states.len();
            return Err(ValueError::StateCount { given });
        }
        let references = STATES.map(|row| row.value);
        let (fresh, before) = (self.fresh, self.memory.state);
        self.set_reals(&references, states)?;
        // For its Jacobian a solver moves one state at a time. A state that the models do not use
        // leaves all computed values valid.
        let is_driven = self.values.integers[integer::DRIVE__MODE] == DriveMode::Torque as i32;
        let is_same = |rotor: &Arc<Rotor>| {
            rotor.used(is_driven, &before) == rotor.used(is_driven, &self.memory.state)
        };
        if self.rotor.as_ref().is_some_and(is_same) {
            self.fresh = fresh;
        }
        Ok(())
    }

    /// The time derivatives of the continuous states, per second, for the present inputs and
    /// states.
    pub fn derivatives(&mut self) -> Result<StateVector, BlockError> {
        self.update_derivatives()?;
        Ok(STATES.map(|row| self.values.reals[row.derivative]))
    }

    fn update_derivatives(&mut self) -> Result<(), BlockError> {
        if self.fresh >= Fresh::Derivatives {
            return Ok(());
        }
        if self.stage == Stage::Configuring {
            return self.update();
        }
        let point = FlightCondition::new(&self.values)?.point;
        let rotor = self.rotor()?;
        self.workspace.work = self.budget();
        let rates = rotor.rates(&point, &self.memory.state, &mut self.workspace);
        let rates = rates.map_err(|e| self.unsolved(e))?;
        let mut reals = self.values.reals;
        write_derivatives(&mut reals, &rates);
        check_finite(&self.values, &reals)?;
        self.values.reals = reals;
        self.fresh = Fresh::Derivatives;
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::variables::{InflowModel, boolean};
    use super::*;

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    /// A quarter to a half of a solver's calls move a state that the models do not use, for a
    /// column of its Jacobian. These calls compute nothing, and all others do.
    #[test]
    fn only_a_change_of_a_used_state_computes_the_derivatives_again()
    -> Result<(), Box<dyn std::error::Error>> {
        // Azimuth, 3 of the inflow, and angles and rates of 4 blades; then the speed, too.
        for (drive, expected) in [
            (DriveMode::Speed, 1 + 3 + 8),
            (DriveMode::Torque, 1 + 1 + 3 + 8),
        ] {
            let mut block = RotorBlock::new(RESOURCES.into());
            let inflow = InflowModel::PittPetersDynamic as i32;
            let references = [integer::MODELS__INFLOW, integer::DRIVE__MODE];
            block.set_integers(&references, &[inflow, drive as i32])?;
            block.set_booleans(&[boolean::FLAPPING__ENABLED], &[1])?;
            block.start()?;
            block.begin_integration()?;
            let states = block.states()?;
            let still = block.derivatives()?;
            let mut used = 0;
            for i in 0..STATES.len() {
                let mut moved = states;
                moved[i] += 1e-3;
                block.set_states(&moved)?;
                let is_valid = block.fresh != Fresh::Nothing;
                block.fresh = Fresh::Nothing;
                let rates = block.derivatives()?;
                if is_valid {
                    assert_eq!(rates, still, "state {i}");
                } else {
                    used += 1;
                }
                block.set_states(&states)?;
                assert_eq!(block.derivatives()?, still);
            }
            assert_eq!(used, expected);
        }
        Ok(())
    }
}
