//! The C types and the 44 functions of FMI 2.0 as its headers declare them.
//!
//! Statuses and enumerations are plain integers here, so that a wrong one can be seen.

#![allow(non_camel_case_types, non_snake_case)]

use std::ffi::{c_char, c_int, c_uint, c_void};

pub type Component = *mut c_void;
pub type FmuState = *mut c_void;
pub type Reference = c_uint;
pub type Text = *const c_char;
pub type Status = c_int;

pub const OK: Status = 0;
pub const WARNING: Status = 1;
pub const ERROR: Status = 3;

pub const MODEL_EXCHANGE: c_int = 0;
pub const CO_SIMULATION: c_int = 1;

pub const DO_STEP_STATUS: c_int = 0;
pub const PENDING_STATUS: c_int = 1;
pub const LAST_SUCCESSFUL_TIME: c_int = 2;
pub const TERMINATED: c_int = 3;

/// The logger has further, variadic arguments; the library passes none, as its messages are
/// complete sentences, so that a function without them can take its place.
pub type Logger = unsafe extern "C" fn(*mut c_void, Text, Status, Text, Text, ...);
pub type PlainLogger = unsafe extern "C" fn(*mut c_void, Text, Status, Text, Text);

#[repr(C)]
#[derive(Clone, Copy)]
pub struct Callbacks {
    pub logger: Option<Logger>,
    pub allocate_memory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    pub free_memory: Option<unsafe extern "C" fn(*mut c_void)>,
    pub step_finished: Option<unsafe extern "C" fn(*mut c_void, Status)>,
    pub environment: *mut c_void,
}

#[repr(C)]
#[derive(Default)]
pub struct EventInfo {
    pub flags: [c_int; 5],
    pub next_event_time: f64,
}

macro_rules! functions {
    ($count:literal; $($name:ident($($argument:ty),*) $(-> $answer:ty)?;)*) => {
        /// The functions of the shared library, by their names in C.
        pub struct Functions { $(pub $name: unsafe extern "C" fn($($argument),*) $(-> $answer)?,)* }

        /// The names of all functions.
        pub const NAMES: [&str; $count] = [$(stringify!($name),)*];

        impl Functions {
            /// Looks all functions up.
            ///
            /// # Safety
            /// The library has them with the types of the standard, and stays loaded while they
            /// are called.
            pub unsafe fn find(library: &libloading::Library) -> Self {
                Self { $($name: {
                    // SAFETY: by the contract above.
                    let symbol = unsafe { library.get(stringify!($name)) };
                    *symbol.unwrap_or_else(|e| panic!("{} is not exported: {e}", stringify!($name)))
                },)* }
            }
        }
    };
}

pub(super) use functions;

functions! {
    44;
    // Common functions
    fmi2GetTypesPlatform() -> Text;
    fmi2GetVersion() -> Text;
    fmi2SetDebugLogging(Component, c_int, usize, *const Text) -> Status;
    fmi2Instantiate(Text, c_int, Text, Text, *const Callbacks, c_int, c_int) -> Component;
    fmi2FreeInstance(Component);
    fmi2SetupExperiment(Component, c_int, f64, f64, c_int, f64) -> Status;
    fmi2EnterInitializationMode(Component) -> Status;
    fmi2ExitInitializationMode(Component) -> Status;
    fmi2Terminate(Component) -> Status;
    fmi2Reset(Component) -> Status;
    fmi2GetReal(Component, *const Reference, usize, *mut f64) -> Status;
    fmi2GetInteger(Component, *const Reference, usize, *mut c_int) -> Status;
    fmi2GetBoolean(Component, *const Reference, usize, *mut c_int) -> Status;
    fmi2GetString(Component, *const Reference, usize, *mut Text) -> Status;
    fmi2SetReal(Component, *const Reference, usize, *const f64) -> Status;
    fmi2SetInteger(Component, *const Reference, usize, *const c_int) -> Status;
    fmi2SetBoolean(Component, *const Reference, usize, *const c_int) -> Status;
    fmi2SetString(Component, *const Reference, usize, *const Text) -> Status;
    fmi2GetFMUstate(Component, *mut FmuState) -> Status;
    fmi2SetFMUstate(Component, FmuState) -> Status;
    fmi2FreeFMUstate(Component, *mut FmuState) -> Status;
    fmi2SerializedFMUstateSize(Component, FmuState, *mut usize) -> Status;
    fmi2SerializeFMUstate(Component, FmuState, *mut c_char, usize) -> Status;
    fmi2DeSerializeFMUstate(Component, *const c_char, usize, *mut FmuState) -> Status;
    fmi2GetDirectionalDerivative(
        Component, *const Reference, usize, *const Reference, usize, *const f64, *mut f64
    ) -> Status;
    // Model Exchange
    fmi2EnterEventMode(Component) -> Status;
    fmi2NewDiscreteStates(Component, *mut EventInfo) -> Status;
    fmi2EnterContinuousTimeMode(Component) -> Status;
    fmi2CompletedIntegratorStep(Component, c_int, *mut c_int, *mut c_int) -> Status;
    fmi2SetTime(Component, f64) -> Status;
    fmi2SetContinuousStates(Component, *const f64, usize) -> Status;
    fmi2GetDerivatives(Component, *mut f64, usize) -> Status;
    fmi2GetEventIndicators(Component, *mut f64, usize) -> Status;
    fmi2GetContinuousStates(Component, *mut f64, usize) -> Status;
    fmi2GetNominalsOfContinuousStates(Component, *mut f64, usize) -> Status;
    // Co-Simulation
    fmi2SetRealInputDerivatives(
        Component, *const Reference, usize, *const c_int, *const f64
    ) -> Status;
    fmi2GetRealOutputDerivatives(
        Component, *const Reference, usize, *const c_int, *mut f64
    ) -> Status;
    fmi2DoStep(Component, f64, f64, c_int) -> Status;
    fmi2CancelStep(Component) -> Status;
    fmi2GetStatus(Component, c_int, *mut Status) -> Status;
    fmi2GetRealStatus(Component, c_int, *mut f64) -> Status;
    fmi2GetIntegerStatus(Component, c_int, *mut c_int) -> Status;
    fmi2GetBooleanStatus(Component, c_int, *mut c_int) -> Status;
    fmi2GetStringStatus(Component, c_int, *mut Text) -> Status;
}
