//! Which function may be called in which state: the tables of the standard's sections 4.2.4
//! (Co-Simulation) and 3.2.3 (Model Exchange).
//!
//! This FMU never enters the states of a step that is in progress, failed or cancelled, because
//! fmi2DoStep completes a step or refuses it.
//!
//! Where the tables have conditions on the variable, the block keeps them: what may be set when
//! (`block::Stage`). The table marks fmi2SetTime in Event Mode for a "Pure Discrete-Time FMU" only
//! (condition 8). Importers set the time of an event there with any FMU, and other exporters accept
//! it; so does this one, in which no equation contains time.

use super::types::{FMI2_CO_SIMULATION, FMI2_MODEL_EXCHANGE, fmi2Enumeration};
use crate::fmi::legality::*;

/// The interface behind an `fmi2Type`.
pub fn interface(kind: fmi2Enumeration) -> Option<Interface> {
    match kind {
        FMI2_CO_SIMULATION => Some(Interface::CoSimulation),
        FMI2_MODEL_EXCHANGE => Some(Interface::ModelExchange),
        _ => None,
    }
}

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

functions! {
    Two;
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_function_once() {
        assert_eq!(TABLE.len(), 44);
        for (i, function) in TABLE.iter().enumerate() {
            assert!(!TABLE[..i].contains(function), "{}", function.name);
        }
    }

    #[test]
    fn a_refusal_names_the_function_the_state_and_the_legal_states() {
        let refusal = |function: &Function, interface, state| {
            let checked = function.check(Version::Two, interface, state);
            checked.unwrap_err()
        };
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
