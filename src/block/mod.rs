//! The rotor as a block of named variables: which variable feeds which quantity of the physics.
//! Neutral of the FMI version.

mod coverage;
mod flight;
mod integrate;
mod location;
mod outputs;
mod setup;
mod shown;
mod values;
pub mod variables;

pub use location::path_from_uri;
pub use setup::SetupError;
pub use values::{Stage, ValueError, Values};

use crate::rotor::{self, Response, Rotor, SolveError, Start};
use coverage::Coverage;
use flight::Flight;
use integrate::Memory;
use outputs::{write_outputs, write_stations};
use std::path::PathBuf;
use thiserror::Error;
use variables::{Causality, FlowState, Initialization, REALS, integer, real};

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
}

/// One rotor with the values of all of its variables.
#[derive(Debug)]
pub struct RotorBlock {
    values: Values,
    stage: Stage,
    resources: PathBuf,
    /// None until it is needed, and again when a parameter that shapes it has changed.
    rotor: Option<Rotor>,
    /// The states of the rotor, as of the last step.
    memory: Memory,
    /// Whether the outputs belong to the present inputs and parameters.
    current: bool,
    /// What is worth a line in the log since the last call of `take_notes`.
    notes: Vec<String>,
    coverage: Coverage,
}

impl RotorBlock {
    /// A rotor with default values; `resources` is the folder of the FMU's resources.
    pub fn new(resources: PathBuf) -> Self {
        Self {
            values: Values::default(),
            stage: Stage::Configuring,
            resources,
            rotor: None,
            memory: Memory::default(),
            current: false,
            notes: Vec::new(),
            coverage: Coverage::default(),
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
    pub fn set_reals(&mut self, references: &[u32], values: &[f64]) -> Result<(), ValueError> {
        self.values.set_reals(self.stage, references, values)?;
        let shapes = |r: &u32| {
            let variable = &REALS[*r as usize];
            variable.causality == Causality::Parameter && !variable.tunable
        };
        let shape_changes = self.stage == Stage::Configuring && references.iter().any(shapes);
        self.invalidate(shape_changes);
        Ok(())
    }

    /// Sets Integer and Enumeration variables: all, or none if one is refused.
    pub fn set_integers(&mut self, references: &[u32], values: &[i32]) -> Result<(), ValueError> {
        self.values.set_integers(self.stage, references, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets Boolean variables, 0 being false and 1 true: all, or none if one is refused.
    pub fn set_booleans(&mut self, references: &[u32], values: &[i32]) -> Result<(), ValueError> {
        self.values.set_booleans(self.stage, references, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    /// Sets String variables: all, or none if one is refused.
    pub fn set_strings(&mut self, references: &[u32], values: &[&str]) -> Result<(), ValueError> {
        self.values.set_strings(self.stage, references, values)?;
        self.invalidate(self.stage == Stage::Configuring);
        Ok(())
    }

    fn invalidate(&mut self, shape_changes: bool) {
        self.current = false;
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

    /// Lets go of the rotor, of which a panic may have left a part undone; the next call makes it anew.
    pub fn forget_rotor(&mut self) {
        self.rotor = None;
        self.current = false;
    }

    /// What was read from which file, and whether the flow went beyond what was read, since the last
    /// call.
    pub fn take_notes(&mut self) -> Vec<String> {
        std::mem::take(&mut self.notes)
    }

    /// Makes the outputs those of the present inputs, parameters and states. While the block is being
    /// configured, the states are those of the start.
    pub fn update(&mut self) -> Result<(), BlockError> {
        if self.current {
            return Ok(());
        }
        let flight = Flight::new(&self.values)?;
        let memory = match self.stage {
            Stage::Running => self.memory,
            Stage::Configuring => {
                let values = &self.values;
                let start = setup::choice(
                    values,
                    integer::INITIALIZATION,
                    Initialization::from_integer,
                )?;
                let start = match start {
                    Initialization::Steady => Start::Steady,
                    Initialization::Rest => Start::Rest,
                };
                let azimuth_step = values.reals[real::NUMERICS__AZIMUTH_STEP];
                let rotor = self.rotor()?;
                let state = rotor.start(&flight.operation, start, azimuth_step);
                Memory::starting(state.map_err(|e| self.unsolved(e))?)
            }
        };
        self.publish(&flight, memory)
    }

    /// Moves on by `duration` s (> 0) with the present inputs, which are constant during it. If that
    /// fails, the states and outputs keep their values.
    pub fn step(&mut self, duration: f64) -> Result<(), BlockError> {
        let flight = Flight::new(&self.values)?;
        let azimuth_step = self.values.reals[real::NUMERICS__AZIMUTH_STEP];
        let (memory, is_current) = (self.memory, self.current);
        let rotor = self.rotor()?;
        let advanced =
            integrate::advance(rotor, &flight.operation, &memory, duration, azimuth_step);
        if is_current
            && !rotor.has_memory(&flight.operation)
            && !rotor.shows_blades(&flight.operation, &memory.state)
            && let Ok(advanced) = advanced
        {
            // A disc that nothing changes answers the same.
            self.memory = advanced;
            self.values.reals[real::AZIMUTH] = advanced.state.azimuth;
            return Ok(());
        }
        let memory = advanced.map_err(|e| self.unsolved(e))?;
        self.publish(&flight, memory)
    }

    /// The rotor of the present parameters.
    fn rotor(&mut self) -> Result<&mut Rotor, BlockError> {
        let rotor = match self.rotor.take() {
            Some(rotor) => rotor,
            None => {
                let (rotor, notes) = setup::rotor(&self.values, &self.resources)?;
                self.notes.extend(notes);
                self.coverage = Coverage::default();
                rotor
            }
        };
        Ok(self.rotor.insert(rotor))
    }

    fn unsolved(&self, error: SolveError) -> BlockError {
        BlockError::Unsolved(error, inputs(&self.values))
    }

    /// Computes the outputs in a flight and takes them and the states over, if all are finite.
    fn publish(&mut self, flight: &Flight, memory: Memory) -> Result<(), BlockError> {
        let mut reals = self.values.reals;
        let rotor = self.rotor()?;
        let response = rotor.respond(&flight.operation, &memory.state);
        let Response { performance, .. } = match response {
            Ok(response) => response,
            Err(error) => return Err(self.unsolved(error)),
        };
        let turning = flight.operation.at_speed_of(&memory.state);
        write_outputs(&mut reals, rotor, &performance, &flight.shaft, &turning);
        reals[real::AZIMUTH] = memory.state.azimuth;
        write_stations(&mut reals, rotor);
        for (variable, value) in REALS.iter().zip(reals) {
            if variable.causality.is_computed() && !value.is_finite() {
                let inputs = inputs(&self.values);
                return Err(BlockError::NotFinite {
                    name: variable.name,
                    value,
                    inputs,
                });
            }
        }
        self.values.reals = reals;
        let flow_state = match performance.flow_state {
            rotor::inflow::descent::FlowState::Normal => FlowState::Normal,
            rotor::inflow::descent::FlowState::VortexRing => FlowState::VortexRing,
            rotor::inflow::descent::FlowState::TurbulentWake => FlowState::TurbulentWake,
            rotor::inflow::descent::FlowState::WindmillBrake => FlowState::WindmillBrake,
        };
        self.values.integers[integer::FLOW_STATE] = flow_state as i32;
        self.memory = memory;
        self.current = true;
        let rotor = self.rotor.as_ref();
        let note = rotor.and_then(|rotor| self.coverage.note(rotor));
        self.notes.extend(note);
        Ok(())
    }
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
