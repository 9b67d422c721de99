//! Which function may be called in which state: the tables of the standard's sections 4.2.4
//! (Co-Simulation) and 3.2.3 (Model Exchange), one bit mask for each function and interface.
//!
//! This FMU never enters the states "error" and "fatal", because an error does not change its
//! state, nor those of a step that is in progress, failed or cancelled, because fmi2DoStep
//! completes a step or refuses it.
//!
//! Where the tables have conditions on the variable, the block keeps them: what may be set when
//! (`block::Stage`). The table marks fmi2SetTime in Event Mode for a "Pure Discrete-Time FMU" only
//! (condition 8). Importers set the time of an event there with any FMU, and other exporters accept
//! it; so does this one, in which no equation contains time.

use super::types::{FMI2_CO_SIMULATION, FMI2_MODEL_EXCHANGE, fmi2Enumeration};
use serde::{Deserialize, Serialize};

/// The interface for which an instance was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Interface {
    CoSimulation,
    ModelExchange,
}

impl Interface {
    /// The interface behind an `fmi2Type`.
    pub fn from_type(kind: fmi2Enumeration) -> Option<Self> {
        match kind {
            FMI2_CO_SIMULATION => Some(Self::CoSimulation),
            FMI2_MODEL_EXCHANGE => Some(Self::ModelExchange),
            _ => None,
        }
    }

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
// Of Co-Simulation:
pub const STEP_COMPLETE: States = 1 << 4;
pub const STEP_IN_PROGRESS: States = 1 << 5;
pub const STEP_FAILED: States = 1 << 6;
pub const STEP_CANCELED: States = 1 << 7;
// Of Model Exchange:
pub const EVENT_MODE: States = 1 << 8;
pub const CONTINUOUS_TIME_MODE: States = 1 << 9;

const NEVER: States = 0;

// Sets of states in Co-Simulation.
const AT_REST: States =
    INSTANTIATED | INITIALIZATION_MODE | STEP_COMPLETE | STEP_FAILED | STEP_CANCELED | TERMINATED;
const ALIVE: States = AT_REST | STEP_IN_PROGRESS;
const READ: States = INITIALIZATION_MODE | STEP_COMPLETE | STEP_FAILED | STEP_CANCELED | TERMINATED;
const WRITE: States = INSTANTIATED | INITIALIZATION_MODE | STEP_COMPLETE;
const STATUS: States = STEP_COMPLETE | STEP_IN_PROGRESS | STEP_FAILED | TERMINATED;
const STEPPED: States = STEP_COMPLETE | STEP_FAILED | STEP_CANCELED | TERMINATED;

// Sets of states in Model Exchange.
const MODES: States = EVENT_MODE | CONTINUOUS_TIME_MODE;
const ME_ALIVE: States = INSTANTIATED | INITIALIZATION_MODE | MODES | TERMINATED;
const ME_READ: States = INITIALIZATION_MODE | MODES | TERMINATED;
const ME_WRITE: States = INSTANTIATED | INITIALIZATION_MODE | EVENT_MODE;

macro_rules! functions {
    ($($name:ident: $co_simulation:expr, $model_exchange:expr;)*) => {
        /// The functions of fmi2Functions.h.
        #[allow(non_camel_case_types)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Function { $($name,)* }

        /// Every function with the states in which it may be called in Co-Simulation and in Model
        /// Exchange.
        pub const TABLE: &[(Function, States, States)] =
            &[$((Function::$name, $co_simulation, $model_exchange),)*];

        impl Function {
            /// The function's name in C.
            pub fn name(self) -> &'static str {
                match self { $(Self::$name => stringify!($name),)* }
            }
        }
    };
}

functions! {
    // Function: Co-Simulation, Model Exchange;
    fmi2GetTypesPlatform: START_AND_END | ALIVE, START_AND_END | ME_ALIVE;
    fmi2GetVersion: START_AND_END | ALIVE, START_AND_END | ME_ALIVE;
    fmi2SetDebugLogging: ALIVE, ME_ALIVE;
    fmi2Instantiate: START_AND_END, START_AND_END;
    fmi2FreeInstance: AT_REST, ME_ALIVE;
    fmi2SetupExperiment: INSTANTIATED, INSTANTIATED;
    fmi2EnterInitializationMode: INSTANTIATED, INSTANTIATED;
    fmi2ExitInitializationMode: INITIALIZATION_MODE, INITIALIZATION_MODE;
    fmi2Terminate: STEP_COMPLETE | STEP_FAILED, MODES;
    fmi2Reset: AT_REST, ME_ALIVE;
    fmi2GetReal: READ, ME_READ;
    fmi2GetInteger: READ, ME_READ;
    fmi2GetBoolean: READ, ME_READ;
    fmi2GetString: READ, ME_READ;
    fmi2SetReal: WRITE, ME_WRITE | CONTINUOUS_TIME_MODE;
    fmi2SetInteger: WRITE, ME_WRITE;
    fmi2SetBoolean: WRITE, ME_WRITE;
    fmi2SetString: WRITE, ME_WRITE;
    fmi2GetFMUstate: AT_REST, ME_ALIVE;
    fmi2SetFMUstate: AT_REST, ME_ALIVE;
    fmi2FreeFMUstate: AT_REST, ME_ALIVE;
    fmi2SerializedFMUstateSize: AT_REST, ME_ALIVE;
    fmi2SerializeFMUstate: AT_REST, ME_ALIVE;
    fmi2DeSerializeFMUstate: AT_REST, ME_ALIVE;
    fmi2GetDirectionalDerivative: READ, ME_READ;
    // Co-Simulation only
    fmi2SetRealInputDerivatives: WRITE, NEVER;
    fmi2GetRealOutputDerivatives: STEPPED, NEVER;
    fmi2DoStep: STEP_COMPLETE, NEVER;
    fmi2CancelStep: STEP_IN_PROGRESS, NEVER;
    fmi2GetStatus: STATUS, NEVER;
    fmi2GetRealStatus: STATUS, NEVER;
    fmi2GetIntegerStatus: STATUS, NEVER;
    fmi2GetBooleanStatus: STATUS, NEVER;
    fmi2GetStringStatus: STATUS, NEVER;
    // Model Exchange only
    fmi2EnterEventMode: NEVER, MODES;
    fmi2NewDiscreteStates: NEVER, EVENT_MODE;
    fmi2EnterContinuousTimeMode: NEVER, EVENT_MODE;
    fmi2CompletedIntegratorStep: NEVER, CONTINUOUS_TIME_MODE;
    fmi2SetTime: NEVER, MODES;
    fmi2SetContinuousStates: NEVER, CONTINUOUS_TIME_MODE;
    fmi2GetDerivatives: NEVER, ME_READ;
    fmi2GetEventIndicators: NEVER, ME_READ;
    fmi2GetContinuousStates: NEVER, ME_READ;
    fmi2GetNominalsOfContinuousStates: NEVER, ME_ALIVE;
}

impl Function {
    fn states(self, interface: Interface) -> States {
        let row = TABLE.iter().find(|(function, _, _)| *function == self);
        row.map_or(
            NEVER,
            |(_, co_simulation, model_exchange)| match interface {
                Interface::CoSimulation => *co_simulation,
                Interface::ModelExchange => *model_exchange,
            },
        )
    }

    /// An error, with the remedy, if the function must not be called in a state.
    pub fn check(self, interface: Interface, state: States) -> Result<(), String> {
        let legal = self.states(interface);
        if legal & state != 0 {
            return Ok(());
        }
        let name = self.name();
        if legal == NEVER {
            let other = match interface {
                Interface::CoSimulation => Interface::ModelExchange,
                Interface::ModelExchange => Interface::CoSimulation,
            };
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_function_once() {
        assert_eq!(TABLE.len(), 44);
        for (i, (function, _, _)) in TABLE.iter().enumerate() {
            assert_eq!(*function as usize, i);
        }
    }

    #[test]
    fn a_refusal_names_the_function_the_state_and_the_legal_states() {
        let refusal =
            |function: Function, interface, state| function.check(interface, state).unwrap_err();
        assert_eq!(
            refusal(Function::fmi2DoStep, Interface::CoSimulation, INSTANTIATED),
            "fmi2DoStep must not be called in the state instantiated; it may be called in stepComplete"
        );
        assert_eq!(
            refusal(
                Function::fmi2SetTime,
                Interface::CoSimulation,
                STEP_COMPLETE
            ),
            "fmi2SetTime belongs to Model Exchange, but the instance was made for Co-Simulation; make another instance"
        );
        assert_eq!(
            refusal(
                Function::fmi2SetContinuousStates,
                Interface::ModelExchange,
                EVENT_MODE
            ),
            "fmi2SetContinuousStates must not be called in the state Event Mode; it may be called in Continuous-Time Mode"
        );
    }
}
