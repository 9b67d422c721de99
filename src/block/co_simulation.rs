//! Steps in time that the block integrates itself (Co-Simulation).

use super::{
    BlockError, Fresh, Note, RotorBlock,
    flight_condition::FlightCondition,
    integrate::{Inputs, Integration},
    state_vector::write_states,
    variables::real,
};
use core::f64::consts::PI;
use rotor::OperatingPoint;

impl RotorBlock {
    /// Advances the time by `duration` s (> 0). During the step the inputs are constant, or move
    /// with the derivatives that were set. After an error, states, inputs and outputs keep their
    /// values.
    pub fn step(&mut self, duration: f64) -> Result<(), BlockError> {
        if self.ramp.is_moving() {
            return self.step_with_moving_inputs(duration);
        }
        let condition = FlightCondition::new(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        let (memory, is_current) = (self.memory, self.fresh == Fresh::All);
        let rotor = self.rotor()?;
        self.workspace.work = self.budget();
        let point = &condition.point;
        let inputs = Inputs::<fn(f64) -> OperatingPoint>::Constant(*point);
        let advanced = Integration {
            rotor: &rotor,
            workspace: &mut self.workspace,
            known_rates: &mut self.known_rates,
            azimuth_step,
        }
        .advance(inputs, &memory, duration);
        if is_current
            && !rotor.has_memory(point)
            && !rotor.evaluate(point, &memory.state).is_individual()
            && let Ok(advanced) = advanced
        {
            // Nothing changes but the azimuth, on which the loads of a disc do not depend.
            self.memory = advanced;
            write_states(&mut self.values.reals, &advanced.state);
        } else {
            let memory = advanced.map_err(|e| self.unsolved(e))?;
            self.publish(&condition, memory)?;
        }
        self.ramp.end(&self.values);
        Ok(())
    }

    fn step_with_moving_inputs(&mut self, duration: f64) -> Result<(), BlockError> {
        let condition = FlightCondition::new(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        self.ramp.begin(&self.values);
        for (input, end) in self.ramp.ends(&self.values, duration) {
            let warning = self.limited_inputs.next(input, end);
            self.notes.extend(warning.map(Note::Warning));
        }
        let rotor = self.rotor()?;
        self.workspace.work = self.budget();
        let mean_speed = self.ramp.mean(&self.values, real::RPM, duration) * PI / 30.0;
        let (ramp, values) = (&mut self.ramp, &self.values);
        // A flight condition fails only for an integer that is no choice. The integers are constant
        // during the step, and `condition` has accepted them.
        let point_at = |offset| {
            FlightCondition::new(ramp.at(values, offset)).map_or(condition.point, |c| c.point)
        };
        let advanced = Integration {
            rotor: &rotor,
            workspace: &mut self.workspace,
            known_rates: &mut self.known_rates,
            azimuth_step,
        }
        .advance(Inputs::Moving(point_at, mean_speed), &self.memory, duration);
        let memory = advanced.map_err(|e| self.unsolved(e))?;
        let reals_before = self.values.reals;
        self.values.reals = self.ramp.at(&self.values, duration).reals;
        let published = FlightCondition::new(&self.values)
            .map_err(BlockError::from)
            .and_then(|condition| self.publish(&condition, memory));
        match published {
            Ok(()) => self.ramp.end(&self.values),
            Err(_) => self.values.reals = reals_before,
        }
        published
    }
}
