//! The rotor as a block of named variables: which variable feeds which quantity of the physics.
//! Neutral of the FMI version.

mod airfoils;
mod bytes;
mod derivative;
mod flight_condition;
mod integrate;
mod location;
mod outputs;
mod outside_data;
mod ramp;
mod references;
mod setup;
mod shown;
mod snapshot;
mod state_vector;
mod values;
pub mod variables;

pub use bytes::{DecodeError, Reader};
pub use derivative::DerivativeError;
pub use location::path_from_uri;
pub use references::{Booleans, Integers, Names, PerVariable, Reals, Reference, Strings};
pub use setup::SetupError;
pub use snapshot::Snapshot;
pub use values::{Stage, ValueError, Values};

use flight_condition::FlightCondition;
use integrate::{Inputs, Integration, Memory};
use num_dual::Dual64;
use outputs::{write_outputs, write_stations};
use outside_data::OutsideDataNotice;
use ramp::Ramp;
use rotor::{OperatingPoint, Response, Rotor, SolveError, Workspace};
use state_vector::{StateVector, read_states, write_derivatives, write_states};
use std::{path::PathBuf, sync::Arc};
use thiserror::Error;
use variables::{
    BooleanRef, Causality, DriveMode, FlowState, IntegerRef, REALS, RealRef, STATES, StringRef,
    integer, real,
};

/// Why the outputs could not be computed; they keep their last values.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum BlockError {
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error("{0}; check the inputs: {1}")]
    Unsolved(SolveError, String),
    #[error("{name} would be {value}, which is not finite; check the inputs: {inputs}")]
    NotFinite {
        name: &'static str,
        value: f64,
        inputs: String,
    },
    #[error(
        "{name} would be {value} at the end of the step by its derivative, but goes from {min} to {max}; set another derivative or a shorter step"
    )]
    LeavesRange {
        name: &'static str,
        value: String,
        min: String,
        max: String,
    },
}

/// How much of what is computed belongs to the present inputs, parameters and states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fresh {
    Nothing,
    Derivatives,
    All,
}

/// One rotor with the values of all of its variables.
#[derive(Debug)]
pub struct RotorBlock {
    values: Values,
    stage: Stage,
    resources: PathBuf,
    /// None until it is needed, and again when a parameter that shapes it has changed.
    rotor: Option<Arc<Rotor>>,
    workspace: Workspace,
    /// For derivatives; empty until they are asked for.
    dual_workspace: Workspace<Dual64>,
    /// The states of the rotor, which stand among the values as well, and where they come from.
    memory: Memory,
    /// How the inputs move in the next step.
    ramp: Ramp,
    fresh: Fresh,
    /// The flow as last computed; the variable keeps its value between events.
    flow_state: i32,
    /// What is worth a line in the log since the last call of `take_notes`.
    notes: Vec<String>,
    outside_data: OutsideDataNotice,
}

impl RotorBlock {
    /// A rotor with default values; `resources` is the folder of the FMU's resources.
    pub fn new(resources: PathBuf) -> Self {
        let values = Values::default();
        Self {
            flow_state: values.integers[integer::FLOW_STATE],
            values,
            stage: Stage::Configuring,
            resources,
            rotor: None,
            workspace: Workspace::default(),
            dual_workspace: Workspace::default(),
            memory: Memory::default(),
            ramp: Ramp::default(),
            fresh: Fresh::Nothing,
            notes: Vec::new(),
            outside_data: OutsideDataNotice::default(),
        }
    }

    /// Back to the state after `new`.
    pub fn reset(&mut self) {
        *self = Self::new(std::mem::take(&mut self.resources));
    }

    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Sets Real variables: all, or none if one is refused.
    pub fn set_reals(
        &mut self,
        names: &[impl Names<RealRef>],
        values: &[f64],
    ) -> Result<(), ValueError> {
        self.values.set_reals(self.stage, names, values)?;
        let mut references = names.iter().flat_map(|name| name.reference());
        let shapes = |reference: RealRef| {
            let variable = reference.variable();
            variable.causality == Causality::Parameter && !variable.tunable
        };
        let shape_changes = self.stage == Stage::Configuring && references.clone().any(shapes);
        self.invalidate(shape_changes);
        if references.any(RealRef::is_state) {
            self.memory = Memory::starting(read_states(&self.values.reals));
        }
        Ok(())
    }

    /// Sets the derivatives in time of inputs, per second: all, or none if one is refused. They
    /// hold for the next step, in which the inputs move linearly from their values; after it the
    /// inputs stand at its end.
    pub fn set_input_slopes(
        &mut self,
        names: &[impl Names<RealRef>],
        slopes: &[f64],
    ) -> Result<(), ValueError> {
        Values::set_slopes(names, slopes, &mut self.ramp.slopes)
    }

    /// Sets Integer and Enumeration variables: all, or none if one is refused.
    pub fn set_integers(
        &mut self,
        names: &[impl Names<IntegerRef>],
        values: &[i32],
    ) -> Result<(), ValueError> {
        self.values.set_integers(self.stage, names, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets Boolean variables, 0 being false and 1 true: all, or none if one is refused.
    pub fn set_booleans(
        &mut self,
        names: &[impl Names<BooleanRef>],
        values: &[i32],
    ) -> Result<(), ValueError> {
        self.values.set_booleans(self.stage, names, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets String variables: all, or none if one is refused.
    pub fn set_strings(
        &mut self,
        names: &[impl Names<StringRef>],
        values: &[&str],
    ) -> Result<(), ValueError> {
        self.values.set_strings(self.stage, names, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    fn invalidate(&mut self, shape_changes: bool) {
        self.fresh = Fresh::Nothing;
        if shape_changes {
            self.rotor = None;
        }
    }

    /// Ends the time in which fixed parameters may change.
    pub fn start(&mut self) -> Result<(), BlockError> {
        self.update()?;
        self.stage = Stage::Running;
        Ok(())
    }

    /// Marks all results as out of date, after a panic that may have left them half-written.
    pub fn forget_results(&mut self) {
        self.fresh = Fresh::Nothing;
    }

    /// What was read from which file, and whether the flow went beyond what was read, since the
    /// last call.
    pub fn take_notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// Makes the outputs those of the present inputs, parameters and states. While the block is
    /// being configured, the states are those of the start.
    pub fn update(&mut self) -> Result<(), BlockError> {
        if self.fresh == Fresh::All {
            return Ok(());
        }
        let condition = FlightCondition::new(&self.values)?;
        let memory = match self.stage {
            Stage::Running | Stage::Integrating => self.memory,
            Stage::Configuring => {
                let values = &self.values;
                let start = setup::start(values)?;
                let azimuth_step = values.reals[real::NUMERICS__AZIMUTH_STEP];
                let rotor = self.rotor()?;
                let workspace = &mut self.workspace;
                let state = rotor.start(&condition.point, start, azimuth_step, workspace);
                Memory::starting(state.map_err(|e| self.unsolved(e))?)
            }
        };
        self.publish(&condition, memory)
    }

    /// Moves on by `duration` s (> 0). During it the inputs are constant, or move by the
    /// derivatives that were set. If that fails, states, inputs and outputs keep their values.
    pub fn step(&mut self, duration: f64) -> Result<(), BlockError> {
        if self.ramp.is_moving() {
            return self.step_with_moving_inputs(duration);
        }
        let condition = FlightCondition::new(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        let (memory, is_current) = (self.memory, self.fresh == Fresh::All);
        let rotor = self.rotor()?;
        let point = &condition.point;
        let inputs = Inputs::<fn(f64) -> OperatingPoint>::Constant(*point);
        let advanced = Integration {
            rotor: &rotor,
            workspace: &mut self.workspace,
            azimuth_step,
        }
        .advance(inputs, &memory, duration);
        if is_current
            && !rotor.has_memory(point)
            && !rotor.evaluate(point, &memory.state).shows_blades()
            && let Ok(advanced) = advanced
        {
            // A disc that nothing changes answers the same.
            self.memory = advanced;
            write_states(&mut self.values.reals, &advanced.state);
        } else {
            let memory = advanced.map_err(|e| self.unsolved(e))?;
            self.publish(&condition, memory)?;
        }
        self.ramp.end();
        Ok(())
    }

    fn step_with_moving_inputs(&mut self, duration: f64) -> Result<(), BlockError> {
        let condition = FlightCondition::new(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        self.ramp.begin(&self.values, duration)?;
        let rotor = self.rotor()?;
        let (ramp, values) = (&mut self.ramp, &self.values);
        // Only the choices among the values can be wrong, and they are those of the beginning.
        let point_at = |offset| {
            FlightCondition::new(ramp.at(values, offset)).map_or(condition.point, |c| c.point)
        };
        let advanced = Integration {
            rotor: &rotor,
            workspace: &mut self.workspace,
            azimuth_step,
        }
        .advance(Inputs::Moving(point_at), &self.memory, duration);
        let memory = advanced.map_err(|e| self.unsolved(e))?;
        let start = self.values.reals;
        self.values.reals = self.ramp.at(&self.values, duration).reals;
        let published = FlightCondition::new(&self.values)
            .map_err(BlockError::from)
            .and_then(|condition| self.publish(&condition, memory));
        match published {
            Ok(()) => self.ramp.end(),
            Err(_) => self.values.reals = start,
        }
        published
    }

    // ------------------------------------------------------------ integration by the importer

    /// The continuous states in the order of `STATES`; those of the start while the block is being
    /// configured.
    pub fn states(&mut self) -> Result<StateVector, BlockError> {
        if self.stage == Stage::Configuring {
            self.update()?;
        }
        Ok(STATES.map(|row| self.values.reals[row.value]))
    }

    /// Sets the continuous states, all or none.
    pub fn set_states(&mut self, states: &[f64]) -> Result<(), ValueError> {
        if states.len() != STATES.len() {
            let given = states.len();
            return Err(ValueError::StateCount { given });
        }
        let references = STATES.map(|row| row.value);
        let (fresh, before) = (self.fresh, self.memory.state);
        self.set_reals(&references, states)?;
        // Solvers move each state by itself for their Jacobian; one that does not count leaves what
        // is computed valid.
        let is_driven = self.values.integers[integer::DRIVE__MODE] == DriveMode::Torque as i32;
        let is_same = |rotor: &Arc<Rotor>| {
            rotor.used(is_driven, &before) == rotor.used(is_driven, &self.memory.state)
        };
        if self.rotor.as_ref().is_some_and(is_same) {
            self.fresh = fresh;
        }
        Ok(())
    }

    /// The derivatives of the continuous states in time, per second, for the present inputs and
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
        let rates = rotor.rates(&point, &self.memory.state, &mut self.workspace);
        let rates = rates.map_err(|e| self.unsolved(e))?;
        let mut reals = self.values.reals;
        write_derivatives(&mut reals, &rates);
        check_finite(&self.values, &reals)?;
        self.values.reals = reals;
        self.fresh = Fresh::Derivatives;
        Ok(())
    }

    /// From here on the importer integrates: it sets the states, and what is discrete keeps its
    /// values.
    pub fn begin_integration(&mut self) -> Result<(), BlockError> {
        self.update()?;
        self.stage = Stage::Integrating;
        Ok(())
    }

    /// Whether a discrete variable would have another value than it has, so that an event is due.
    pub fn has_event(&mut self) -> Result<bool, BlockError> {
        self.update()?;
        Ok(self.values.integers[integer::FLOW_STATE] != self.flow_state)
    }

    /// Ends an integration by the importer: discrete variables follow, and tunable parameters may
    /// be set.
    pub fn begin_event(&mut self) {
        self.stage = Stage::Running;
        if self.fresh == Fresh::All {
            self.values.integers[integer::FLOW_STATE] = self.flow_state;
        }
    }

    // ------------------------------------------------------------ computation

    /// The rotor of the present parameters.
    fn rotor(&mut self) -> Result<Arc<Rotor>, BlockError> {
        if let Some(rotor) = &self.rotor {
            return Ok(Arc::clone(rotor));
        }
        let (rotor, notes) = setup::rotor(&self.values, &self.resources)?;
        Ok(self.take_over(rotor, notes))
    }

    /// Takes over a rotor that was just made.
    fn take_over(&mut self, rotor: Rotor, notes: Vec<String>) -> Arc<Rotor> {
        self.notes.extend(notes);
        self.outside_data = OutsideDataNotice::default();
        Arc::clone(self.rotor.insert(Arc::new(rotor)))
    }

    fn unsolved(&self, error: SolveError) -> BlockError {
        BlockError::Unsolved(error, inputs(&self.values))
    }

    /// Computes the outputs in a flight condition and takes them and the states over, if all are
    /// finite.
    fn publish(&mut self, condition: &FlightCondition, memory: Memory) -> Result<(), BlockError> {
        let mut reals = self.values.reals;
        let rotor = self.rotor()?;
        let response = rotor.respond(&condition.point, &memory.state, &mut self.workspace);
        let Response { hub, rates, blade } = match response {
            Ok(response) => response,
            Err(error) => return Err(BlockError::Unsolved(error, inputs(&self.values))),
        };
        write_outputs(&mut reals, &rotor, &hub, condition, &memory.state);
        write_stations(&mut reals, &rotor, &blade);
        write_states(&mut reals, &memory.state);
        write_derivatives(&mut reals, &rates);
        check_finite(&self.values, &reals)?;
        self.values.reals = reals;
        let flow_state = match hub.flow_state {
            rotor::inflow::FlowState::Normal => FlowState::Normal,
            rotor::inflow::FlowState::VortexRing => FlowState::VortexRing,
            rotor::inflow::FlowState::TurbulentWake => FlowState::TurbulentWake,
            rotor::inflow::FlowState::WindmillBrake => FlowState::WindmillBrake,
        };
        self.flow_state = flow_state as i32;
        if self.stage != Stage::Integrating {
            self.values.integers[integer::FLOW_STATE] = self.flow_state;
        }
        self.memory = memory;
        self.fresh = Fresh::All;
        self.notes.extend(self.outside_data.next(&rotor, &blade));
        Ok(())
    }
}

/// An error if any computed value in `reals` is not finite.
fn check_finite(values: &Values, reals: &Reals) -> Result<(), BlockError> {
    for (variable, value) in REALS.iter().zip(reals) {
        if variable.causality.is_computed() && !value.is_finite() {
            return Err(BlockError::NotFinite {
                name: variable.name,
                value: *value,
                inputs: inputs(values),
            });
        }
    }
    Ok(())
}

/// The inputs as a text for errors.
fn inputs(values: &Values) -> String {
    let inputs = REALS
        .iter()
        .zip(values.reals)
        .filter(|(v, _)| v.causality == Causality::Input);
    let texts = inputs.map(|(v, value)| format!("{} = {} {}", v.name, shown::shown(value), v.unit));
    texts.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use variables::boolean;

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    /// A quarter to a half of a solver's calls are for columns of its Jacobian that belong to
    /// states which do not count. They cost nothing, and all others are computed.
    #[test]
    fn only_states_that_count_make_the_derivatives_anew() -> Result<(), Box<dyn std::error::Error>>
    {
        // Azimuth, 3 of the inflow, and angles and rates of 4 blades; then the speed, too.
        for (drive, expected) in [
            (DriveMode::Speed, 1 + 3 + 8),
            (DriveMode::Torque, 1 + 1 + 3 + 8),
        ] {
            let mut block = RotorBlock::new(RESOURCES.into());
            let inflow = variables::InflowModel::PittPetersDynamic as i32;
            let references = [integer::MODELS__INFLOW, integer::DRIVE__MODE];
            block.set_integers(&references, &[inflow, drive as i32])?;
            block.set_booleans(&[boolean::FLAPPING__ENABLED], &[1])?;
            block.start()?;
            block.begin_integration()?;
            let states = block.states()?;
            let still = block.derivatives()?;
            let mut counting = 0;
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
                    counting += 1;
                }
                block.set_states(&states)?;
                assert_eq!(block.derivatives()?, still);
            }
            assert_eq!(counting, expected);
        }
        Ok(())
    }
}
