//! Which function may be called in which state: the table of the standard's section 4.2.4
//! (Co-Simulation), one bit mask for each function.
//!
//! An error does not change the state here, so that the states "error" and "fatal" are never
//! entered; nor are those of a step that runs on, fails or is cancelled, because a step is done
//! or refused within the call of fmi2DoStep.

/// A set of states.
pub type States = u16;

pub const START_AND_END: States = 1 << 0;
pub const INSTANTIATED: States = 1 << 1;
pub const INITIALIZATION_MODE: States = 1 << 2;
pub const STEP_COMPLETE: States = 1 << 3;
pub const STEP_IN_PROGRESS: States = 1 << 4;
pub const STEP_FAILED: States = 1 << 5;
pub const STEP_CANCELED: States = 1 << 6;
pub const TERMINATED: States = 1 << 7;

const NEVER: States = 0;
const INSTANCE_AT_REST: States =
    INSTANTIATED | INITIALIZATION_MODE | STEP_COMPLETE | STEP_FAILED | STEP_CANCELED | TERMINATED;
const INSTANCE: States = INSTANCE_AT_REST | STEP_IN_PROGRESS;
const ANYWHERE: States = START_AND_END | INSTANCE;
const READ: States = INITIALIZATION_MODE | STEP_COMPLETE | STEP_FAILED | STEP_CANCELED | TERMINATED;
const WRITE: States = INSTANTIATED | INITIALIZATION_MODE | STEP_COMPLETE;
const STATUS: States = STEP_COMPLETE | STEP_IN_PROGRESS | STEP_FAILED | TERMINATED;

macro_rules! functions {
    ($($name:ident: $states:expr,)*) => {
        /// The functions of fmi2Functions.h.
        #[allow(non_camel_case_types)]
        #[derive(Debug, Clone, Copy, PartialEq, Eq)]
        pub enum Function { $($name,)* }

        /// Every function with the states in which it may be called.
        pub const TABLE: &[(Function, States)] = &[$((Function::$name, $states),)*];

        impl Function {
            /// The function's name in C.
            pub fn name(self) -> &'static str {
                match self { $(Self::$name => stringify!($name),)* }
            }
        }
    };
}

functions! {
    fmi2GetTypesPlatform: ANYWHERE,
    fmi2GetVersion: ANYWHERE,
    fmi2SetDebugLogging: INSTANCE,
    fmi2Instantiate: START_AND_END,
    fmi2FreeInstance: INSTANCE_AT_REST,
    fmi2SetupExperiment: INSTANTIATED,
    fmi2EnterInitializationMode: INSTANTIATED,
    fmi2ExitInitializationMode: INITIALIZATION_MODE,
    fmi2Terminate: STEP_COMPLETE | STEP_FAILED,
    fmi2Reset: INSTANCE_AT_REST,
    fmi2GetReal: READ,
    fmi2GetInteger: READ,
    fmi2GetBoolean: READ,
    fmi2GetString: READ,
    fmi2SetReal: WRITE,
    fmi2SetInteger: WRITE,
    fmi2SetBoolean: WRITE,
    fmi2SetString: WRITE,
    fmi2GetFMUstate: INSTANCE_AT_REST,
    fmi2SetFMUstate: INSTANCE_AT_REST,
    fmi2FreeFMUstate: INSTANCE_AT_REST,
    fmi2SerializedFMUstateSize: INSTANCE_AT_REST,
    fmi2SerializeFMUstate: INSTANCE_AT_REST,
    fmi2DeSerializeFMUstate: INSTANCE_AT_REST,
    fmi2GetDirectionalDerivative: READ,
    // Co-Simulation
    fmi2SetRealInputDerivatives: WRITE,
    fmi2GetRealOutputDerivatives: STEP_COMPLETE | STEP_FAILED | STEP_CANCELED | TERMINATED,
    fmi2DoStep: STEP_COMPLETE,
    fmi2CancelStep: STEP_IN_PROGRESS,
    fmi2GetStatus: STATUS,
    fmi2GetRealStatus: STATUS,
    fmi2GetIntegerStatus: STATUS,
    fmi2GetBooleanStatus: STATUS,
    fmi2GetStringStatus: STATUS,
    // Model Exchange, which this FMU does not offer
    fmi2EnterEventMode: NEVER,
    fmi2NewDiscreteStates: NEVER,
    fmi2EnterContinuousTimeMode: NEVER,
    fmi2CompletedIntegratorStep: NEVER,
    fmi2SetTime: NEVER,
    fmi2SetContinuousStates: NEVER,
    fmi2GetDerivatives: NEVER,
    fmi2GetEventIndicators: NEVER,
    fmi2GetContinuousStates: NEVER,
    fmi2GetNominalsOfContinuousStates: NEVER,
}

impl Function {
    fn states(self) -> States {
        TABLE
            .iter()
            .find(|(function, _)| *function == self)
            .map_or(NEVER, |(_, states)| *states)
    }

    /// Whether the function may be called in a state; if not, a sentence with the remedy.
    pub fn check(self, state: States) -> Result<(), String> {
        let legal = self.states();
        if legal & state != 0 {
            return Ok(());
        }
        let name = self.name();
        if legal == NEVER {
            return Err(format!(
                "{name} belongs to Model Exchange, which this FMU does not offer; use it for Co-Simulation"
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
        for (i, (function, _)) in TABLE.iter().enumerate() {
            assert_eq!(*function as usize, i);
        }
    }

    #[test]
    fn a_refusal_names_the_function_the_state_and_the_legal_states() {
        let error = Function::fmi2DoStep.check(INSTANTIATED).unwrap_err();
        assert_eq!(
            error,
            "fmi2DoStep must not be called in the state instantiated; it may be called in stepComplete"
        );
        assert!(
            Function::fmi2SetTime
                .check(STEP_COMPLETE)
                .unwrap_err()
                .contains("Model Exchange")
        );
    }
}
