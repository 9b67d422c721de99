//! The rotor as a block of named variables: which variable feeds which quantity of the physics.
//! Independent of the FMI version.
//!
//! * `variables`, `references`, `values`: the table of variables, and a value for each of them
//! * `setting`, `settings`, `limited_inputs`: values into the block, one by one or as a text of
//!   assignments
//! * `rotor_file`, `from_file`: values that a rotor file gives
//! * `packaged`: the defaults of an .fmu that was made for one rotor
//! * `setup`, `airfoils`, `flight_condition`, `ramp`: from values to a rotor and its operating
//!   point
//! * `computation`, `outputs`: the rotor's response, written to the outputs
//! * `co_simulation`, `parted_step`, `integrate`, `known_rates`: steps that the block integrates
//! * `model_exchange`, `state_vector`: states and derivatives for an importer that integrates
//! * `derivative`: directional derivatives
//! * `snapshot`: the block's state, saved and restored
//! * `location`, `resource_files`, `files`: where files are, what is in them, and whether they have
//!   changed
//! * `shown`, `outside_data`, `plausibility`, `beyond_stops`: texts for messages

mod airfoils;
mod beyond_stops;
#[cfg(test)]
mod bounded_work;
mod co_simulation;
mod computation;
mod derivative;
mod files;
mod flight_condition;
mod from_file;
mod integrate;
mod known_rates;
mod limited_inputs;
mod location;
mod model_exchange;
mod outputs;
mod outside_data;
pub mod packaged;
mod parted_step;
mod plausibility;
mod ramp;
mod references;
mod resource_files;
mod rotor_file;
mod setting;
mod settings;
mod setup;
mod shown;
mod snapshot;
mod state_vector;
mod values;
pub mod variables;

pub use derivative::DerivativeError;
pub use location::path_from_uri;
pub use parted_step::{Inputs, Moment};
pub use references::{Booleans, Integers, Names, PerVariable, Reals, Reference, Strings};
pub use settings::{SetStringsError, SettingsError};
pub use setup::SetupError;
pub use snapshot::{Contradiction, Snapshot};
pub use values::{Stage, ValueError, Values};

use crate::host::memory::NO_MEMORY;
use beyond_stops::BeyondStopsNotice;
use files::{FileHash, ReadFile};
use integrate::Memory;
use known_rates::KnownRates;
use limited_inputs::LimitedInputs;
use outside_data::OutsideDataNotice;
use ramp::Ramp;
use rotor::numbers::Dual64;
use rotor::{Rotor, SolveError, Workspace};
use serde::{Deserialize, Serialize};
use std::{path::PathBuf, sync::Arc};
use thiserror::Error;
use variables::integer;

/// Why the outputs could not be computed. They keep their last values.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum BlockError {
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error("{NO_MEMORY}")]
    NoMemory,
    #[error("{0}; check the inputs: {1}")]
    Unsolved(SolveError, String),
    #[error(
        "this takes more work than numerics.budget = {0} computations of blade sections; take shorter steps, set numerics.elements lower or numerics.azimuthStep higher, or raise numerics.budget"
    )]
    TooMuchWork(u64),
    #[error("{name} would be {value}, which is not finite; check the inputs: {inputs}")]
    NotFinite {
        name: &'static str,
        value: f64,
        inputs: String,
    },
}

/// A sentence for the log.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Note {
    /// For users who want to know what happens.
    Event(String),
    /// Something may be wrong.
    Warning(String),
}

/// Which computed values belong to the present inputs, parameters and states.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
enum Fresh {
    Nothing,
    /// The derivatives of the states only.
    Derivatives,
    All,
}

/// One rotor with the values of all of its variables.
#[derive(Debug)]
pub struct RotorBlock {
    values: Values,
    /// The values of a rotor of which nothing is set.
    defaults: Box<Values>,
    stage: Stage,
    resources: PathBuf,
    /// None until the rotor is needed, and after a change of a parameter that defines it.
    rotor: Option<Arc<Rotor>>,
    /// The files from which `rotor` was made.
    files: Vec<ReadFile>,
    /// The files of a state that was restored before its rotor was needed.
    saved_files: Vec<FileHash>,
    workspace: Workspace,
    known_rates: KnownRates,
    /// For directional derivatives; empty until the first of them.
    dual_workspace: Workspace<Dual64>,
    /// The states of the rotor, and the grid point from which they were integrated. `values` holds
    /// the states as well.
    memory: Memory,
    /// Whether the last start that was computed is the one that was asked for.
    has_start: bool,
    /// How the inputs move during the next step.
    ramp: Ramp,
    fresh: Fresh,
    /// The flow state as last computed. The variable changes at events only.
    flow_state: i32,
    /// Whether flowState keeps its value during steps, until the importer enters Event Mode.
    holds_flow_state: bool,
    /// Sentences for the log since the last call of `take_notes`.
    notes: Vec<Note>,
    limited_inputs: LimitedInputs,
    outside_data: OutsideDataNotice,
    beyond_stops: BeyondStopsNotice,
}

impl RotorBlock {
    /// A rotor with default values. `resources` is the folder of the FMU's resources.
    pub fn new(resources: PathBuf) -> Self {
        let values = packaged::defaults(&resources);
        Self {
            flow_state: values.integers[integer::FLOW_STATE],
            defaults: Box::new(values.clone()),
            values,
            stage: Stage::Configuring,
            resources,
            rotor: None,
            files: Vec::new(),
            saved_files: Vec::new(),
            workspace: Workspace::default(),
            known_rates: KnownRates::default(),
            dual_workspace: Workspace::default(),
            memory: Memory::default(),
            has_start: true,
            ramp: Ramp::default(),
            fresh: Fresh::Nothing,
            holds_flow_state: false,
            notes: Vec::new(),
            limited_inputs: LimitedInputs::default(),
            outside_data: OutsideDataNotice::default(),
            beyond_stops: BeyondStopsNotice::default(),
        }
    }

    /// Returns to the state after `new`.
    pub fn reset(&mut self) {
        *self = Self::new(std::mem::take(&mut self.resources));
    }

    /// The values of all variables.
    pub fn values(&self) -> &Values {
        &self.values
    }

    /// Returns the sentences for the log that have come up since the last call: the files that
    /// were read, files that have changed since a state was saved, implausible values, flow outside
    /// the data of an airfoil file, and blades far beyond their stops.
    pub fn take_notes(&mut self) -> Vec<Note> {
        std::mem::take(&mut self.notes)
    }
}
