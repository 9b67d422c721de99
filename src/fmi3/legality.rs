//! Which function may be called in which state: the standard's sections 2.3 (common states), 4.2
//! (Co-Simulation) and 3.2 (Model Exchange).
//!
//! Where the sections have conditions on the variable, the block keeps them: what may be set when
//! (`block::Stage`). In three points this FMU is more lenient than the sections:
//!
//! * An error does not bring it into the state Terminated: it stays where it was, as its values do.
//! * Values can also be read in the state Instantiated, as the section's table says and its list of
//!   functions does not.
//! * fmi3SetTime is accepted in Event Mode, as in FMI 2.0, because no equation contains time; the
//!   numbers of states and event indicators, which never change, can always be asked for.
//!
//! Without structural parameters there is no Configuration or Reconfiguration Mode. The functions
//! for them refuse every call with their own sentence. Tunable parameters are set in Event Mode and
//! Step Mode, like inputs.
//!
//! During an intermediate update it is stricter: nothing but the functions that read and set
//! variables may be called there, not even those for the complete state, in the middle of a step.

use crate::fmi::legality::*;

// Sets of states.
const INITIALIZED: States = EVENT_MODE | STEP_MODE | CONTINUOUS_TIME_MODE;
const COMPUTED: States = INITIALIZATION_MODE | INITIALIZED | TERMINATED;
/// Not in the middle of a step.
const AT_REST: States = INSTANTIATED | COMPUTED;
const ALIVE: States = AT_REST | INTERMEDIATE_SET | INTERMEDIATE_GET;
const WRITE: States = INSTANTIATED | INITIALIZATION_MODE | EVENT_MODE | STEP_MODE;
const CONTINUOUS_WRITE: States = WRITE | CONTINUOUS_TIME_MODE;
const CLOCKS: States = INITIALIZATION_MODE | EVENT_MODE;

functions! {
    Three;
    // Function: Co-Simulation, Model Exchange;
    fmi3GetVersion: START_AND_END | ALIVE, START_AND_END | ALIVE;
    fmi3SetDebugLogging: ALIVE, ALIVE;
    fmi3InstantiateModelExchange: START_AND_END, START_AND_END;
    fmi3InstantiateCoSimulation: START_AND_END, START_AND_END;
    fmi3InstantiateScheduledExecution: START_AND_END, START_AND_END;
    fmi3FreeInstance: AT_REST, AT_REST;
    fmi3EnterInitializationMode: INSTANTIATED, INSTANTIATED;
    fmi3ExitInitializationMode: INITIALIZATION_MODE, INITIALIZATION_MODE;
    fmi3EnterEventMode: STEP_MODE, CONTINUOUS_TIME_MODE;
    fmi3Terminate: INITIALIZED, INITIALIZED;
    fmi3Reset: AT_REST, AT_REST;
    fmi3GetFloat32: AT_REST, AT_REST;
    fmi3GetFloat64: AT_REST | INTERMEDIATE_GET, AT_REST;
    fmi3GetInt8: AT_REST, AT_REST;
    fmi3GetUInt8: AT_REST, AT_REST;
    fmi3GetInt16: AT_REST, AT_REST;
    fmi3GetUInt16: AT_REST, AT_REST;
    fmi3GetInt32: AT_REST, AT_REST;
    fmi3GetUInt32: AT_REST, AT_REST;
    fmi3GetInt64: AT_REST, AT_REST;
    fmi3GetUInt64: AT_REST, AT_REST;
    fmi3GetBoolean: AT_REST, AT_REST;
    fmi3GetString: AT_REST, AT_REST;
    fmi3GetBinary: AT_REST, AT_REST;
    fmi3GetClock: EVENT_MODE, EVENT_MODE;
    fmi3SetFloat32: CONTINUOUS_WRITE, CONTINUOUS_WRITE;
    fmi3SetFloat64: CONTINUOUS_WRITE | INTERMEDIATE_SET, CONTINUOUS_WRITE;
    fmi3SetInt8: WRITE, WRITE;
    fmi3SetUInt8: WRITE, WRITE;
    fmi3SetInt16: WRITE, WRITE;
    fmi3SetUInt16: WRITE, WRITE;
    fmi3SetInt32: WRITE, WRITE;
    fmi3SetUInt32: WRITE, WRITE;
    fmi3SetInt64: WRITE, WRITE;
    fmi3SetUInt64: WRITE, WRITE;
    fmi3SetBoolean: WRITE, WRITE;
    fmi3SetString: WRITE, WRITE;
    fmi3SetBinary: WRITE, WRITE;
    fmi3SetClock: EVENT_MODE, EVENT_MODE;
    fmi3GetNumberOfVariableDependencies: AT_REST, AT_REST;
    fmi3GetVariableDependencies: AT_REST, AT_REST;
    fmi3GetFMUState: AT_REST, AT_REST;
    fmi3SetFMUState: AT_REST, AT_REST;
    fmi3FreeFMUState: AT_REST, AT_REST;
    fmi3SerializedFMUStateSize: AT_REST, AT_REST;
    fmi3SerializeFMUState: AT_REST, AT_REST;
    fmi3DeserializeFMUState: AT_REST, AT_REST;
    fmi3GetDirectionalDerivative: COMPUTED, COMPUTED;
    fmi3GetAdjointDerivative: COMPUTED, COMPUTED;
    fmi3EnterConfigurationMode: ALIVE, ALIVE;
    fmi3ExitConfigurationMode: ALIVE, ALIVE;
    fmi3GetIntervalDecimal: CLOCKS, CLOCKS;
    fmi3GetIntervalFraction: CLOCKS, CLOCKS;
    fmi3GetShiftDecimal: INITIALIZATION_MODE, INITIALIZATION_MODE;
    fmi3GetShiftFraction: INITIALIZATION_MODE, INITIALIZATION_MODE;
    fmi3SetIntervalDecimal: CLOCKS, CLOCKS;
    fmi3SetIntervalFraction: CLOCKS, CLOCKS;
    fmi3SetShiftDecimal: INITIALIZATION_MODE, INITIALIZATION_MODE;
    fmi3SetShiftFraction: INITIALIZATION_MODE, INITIALIZATION_MODE;
    fmi3EvaluateDiscreteStates: EVENT_MODE, EVENT_MODE;
    fmi3UpdateDiscreteStates: EVENT_MODE, EVENT_MODE;
    // Model Exchange only
    fmi3EnterContinuousTimeMode: NEVER, EVENT_MODE;
    fmi3CompletedIntegratorStep: NEVER, CONTINUOUS_TIME_MODE;
    fmi3SetTime: NEVER, EVENT_MODE | CONTINUOUS_TIME_MODE;
    fmi3SetContinuousStates: NEVER, CONTINUOUS_TIME_MODE;
    fmi3GetContinuousStateDerivatives: NEVER, COMPUTED;
    fmi3GetEventIndicators: NEVER, COMPUTED;
    fmi3GetContinuousStates: NEVER, COMPUTED;
    fmi3GetNominalsOfContinuousStates: NEVER, COMPUTED;
    fmi3GetNumberOfEventIndicators: NEVER, AT_REST;
    fmi3GetNumberOfContinuousStates: NEVER, AT_REST;
    // Co-Simulation only
    fmi3EnterStepMode: EVENT_MODE, NEVER;
    fmi3GetOutputDerivatives: STEP_MODE | INTERMEDIATE_GET | TERMINATED, NEVER;
    fmi3DoStep: STEP_MODE, NEVER;
    // Scheduled Execution only
    fmi3ActivateModelPartition: NEVER, NEVER;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_function_once() {
        assert_eq!(TABLE.len(), 75);
        for (i, function) in TABLE.iter().enumerate() {
            assert!(!TABLE[..i].contains(function), "{}", function.name);
        }
    }

    #[test]
    fn a_refusal_names_the_states_of_the_interface_alone() {
        let refusal = |function: &Function, interface, state| {
            let checked = function.check(Version::Three, interface, state);
            checked.unwrap_err()
        };
        assert_eq!(
            refusal(Function::fmi3SetInt32, Interface::CoSimulation, TERMINATED),
            "fmi3SetInt32 must not be called in the state terminated; it may be called in instantiated, Initialization Mode, Event Mode, Step Mode"
        );
        assert_eq!(
            refusal(
                Function::fmi3ActivateModelPartition,
                Interface::CoSimulation,
                EVENT_MODE
            ),
            "fmi3ActivateModelPartition belongs to Scheduled Execution, which this FMU does not offer"
        );
        assert_eq!(
            refusal(Function::fmi2Reset, Interface::CoSimulation, EVENT_MODE),
            "fmi2Reset belongs to FMI 2.0, but the instance was made for FMI 3.0; use the functions of one version"
        );
    }
}
