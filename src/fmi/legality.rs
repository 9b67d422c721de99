//! Which function may be called in which state: one bit mask for each function and interface. The
//! tables are those of the versions.
//!
//! This FMU never enters the states "error" and "fatal", because an error does not change its
//! state.

use crate::block::variables::{GUID, INSTANTIATION_TOKEN};
use serde::{Deserialize, Serialize};

/// The version of FMI.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Version {
    #[default]
    Two,
    Three,
}

impl Version {
    pub fn name(self) -> &'static str {
        match self {
            Self::Two => "FMI 2.0",
            Self::Three => "FMI 3.0",
        }
    }

    /// What its modelDescription.xml calls the GUID or token.
    pub fn token_name(self) -> &'static str {
        match self {
            Self::Two => "GUID",
            Self::Three => "instantiationToken",
        }
    }

    /// The GUID or token in the modelDescription.xml of this version.
    pub fn token(self) -> &'static str {
        match self {
            Self::Two => GUID,
            Self::Three => INSTANTIATION_TOKEN,
        }
    }
}

/// The interface for which an instance was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interface {
    CoSimulation,
    ModelExchange,
}

impl Interface {
    fn name(self) -> &'static str {
        match self {
            Self::CoSimulation => "Co-Simulation",
            Self::ModelExchange => "Model Exchange",
        }
    }
}

/// A set of states.
pub type States = u16;

pub const START_AND_END: States = 1 << 0;
pub const INSTANTIATED: States = 1 << 1;
pub const INITIALIZATION_MODE: States = 1 << 2;
pub const TERMINATED: States = 1 << 3;
// Of Co-Simulation in FMI 2.0:
pub const STEP_COMPLETE: States = 1 << 4;
pub const STEP_IN_PROGRESS: States = 1 << 5;
pub const STEP_FAILED: States = 1 << 6;
pub const STEP_CANCELED: States = 1 << 7;
// Of Model Exchange, and of Co-Simulation in FMI 3.0:
pub const EVENT_MODE: States = 1 << 8;
// Of Model Exchange:
pub const CONTINUOUS_TIME_MODE: States = 1 << 9;
// Of FMI 3.0:
pub const STEP_MODE: States = 1 << 10;
/// Intermediate Update Mode while inputs are asked for.
pub const INTERMEDIATE_SET: States = 1 << 11;
/// Intermediate Update Mode while outputs may be read.
pub const INTERMEDIATE_GET: States = 1 << 12;

/// States that one interface alone has.
const OF_CO_SIMULATION: States = STEP_COMPLETE
    | STEP_IN_PROGRESS
    | STEP_FAILED
    | STEP_CANCELED
    | STEP_MODE
    | INTERMEDIATE_SET
    | INTERMEDIATE_GET;
const OF_MODEL_EXCHANGE: States = CONTINUOUS_TIME_MODE;

pub const NEVER: States = 0;

/// A function of the C interface.
#[derive(Debug, PartialEq)]
pub struct Function {
    /// Its name in C.
    pub name: &'static str,
    pub version: Version,
    /// The states in which it may be called in Co-Simulation.
    pub co_simulation: States,
    /// The states in which it may be called in Model Exchange.
    pub model_exchange: States,
}

/// Defines the functions of a version by the states in which they may be called.
macro_rules! functions {
    ($version:ident; $($name:ident: $co_simulation:expr, $model_exchange:expr;)*) => {
        #[allow(non_upper_case_globals)]
        impl Function {
            $(pub const $name: &'static Self = &Self {
                name: stringify!($name),
                version: Version::$version,
                co_simulation: $co_simulation,
                model_exchange: $model_exchange,
            };)*
        }

        /// Every function of this version.
        pub const TABLE: &[&Function] = &[$(Function::$name,)*];
    };
}
pub(crate) use functions;

impl Function {
    /// An error, with the remedy, if the function must not be called in a state.
    pub fn check(
        &self,
        version: Version,
        interface: Interface,
        state: States,
    ) -> Result<(), String> {
        let name = self.name;
        if version != self.version {
            return Err(format!(
                "{name} belongs to {}, but the instance was made for {}; use the functions of one version",
                self.version.name(),
                version.name()
            ));
        }
        if self.co_simulation == NEVER && self.model_exchange == NEVER {
            return Err(format!(
                "{name} belongs to Scheduled Execution, which this FMU does not offer"
            ));
        }
        let (legal, other) = match interface {
            Interface::CoSimulation => (
                self.co_simulation & !OF_MODEL_EXCHANGE,
                Interface::ModelExchange,
            ),
            Interface::ModelExchange => (
                self.model_exchange & !OF_CO_SIMULATION,
                Interface::CoSimulation,
            ),
        };
        if legal & state != 0 {
            return Ok(());
        }
        if legal == NEVER {
            return Err(format!(
                "{name} belongs to {}, but the instance was made for {}; make another instance",
                other.name(),
                interface.name()
            ));
        }
        Err(format!(
            "{name} must not be called in the state {}; it may be called in {}",
            names(state),
            names(legal)
        ))
    }
}

/// The names of the states in a set, as the standard has them.
fn names(states: States) -> String {
    let all = [
        (START_AND_END, "without an instance"),
        (INSTANTIATED, "instantiated"),
        (INITIALIZATION_MODE, "Initialization Mode"),
        (EVENT_MODE, "Event Mode"),
        (CONTINUOUS_TIME_MODE, "Continuous-Time Mode"),
        (STEP_MODE, "Step Mode"),
        (
            INTERMEDIATE_SET,
            "Intermediate Update Mode where inputs are asked for",
        ),
        (
            INTERMEDIATE_GET,
            "Intermediate Update Mode where outputs may be read",
        ),
        (STEP_COMPLETE, "stepComplete"),
        (STEP_IN_PROGRESS, "stepInProgress"),
        (STEP_FAILED, "stepFailed"),
        (STEP_CANCELED, "stepCanceled"),
        (TERMINATED, "terminated"),
    ];
    let names: Vec<&str> = all
        .iter()
        .filter(|(bit, _)| states & bit != 0)
        .map(|(_, name)| *name)
        .collect();
    names.join(", ")
}
