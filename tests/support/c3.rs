//! The C types and the 75 functions of FMI 3.0 as its headers declare them.

#![allow(non_camel_case_types, non_snake_case)]

use super::c::{FmuState, Reference, Status, Text, functions};
use std::ffi::{c_int, c_void};

pub type Instance = *mut c_void;
/// A C `bool`: a byte, so that a wrong one can be seen.
pub type Bool = u8;
pub type Binary = *const u8;

pub type LogMessage = unsafe extern "C" fn(*mut c_void, Status, Text, Text);
pub type IntermediateUpdate =
    unsafe extern "C" fn(*mut c_void, f64, Bool, Bool, Bool, Bool, *mut Bool, *mut f64);
pub type ClockUpdate = unsafe extern "C" fn(*mut c_void);
pub type Lock = unsafe extern "C" fn();

type Refs = *const Reference;

functions! {
    75;
    fmi3GetVersion() -> Text;
    fmi3SetDebugLogging(Instance, Bool, usize, *const Text) -> Status;
    fmi3InstantiateModelExchange(
        Text, Text, Text, Bool, Bool, *mut c_void, Option<LogMessage>
    ) -> Instance;
    fmi3InstantiateCoSimulation(
        Text, Text, Text, Bool, Bool, Bool, Bool, Refs, usize, *mut c_void,
        Option<LogMessage>, Option<IntermediateUpdate>
    ) -> Instance;
    fmi3InstantiateScheduledExecution(
        Text, Text, Text, Bool, Bool, *mut c_void, Option<LogMessage>, Option<ClockUpdate>,
        Option<Lock>, Option<Lock>
    ) -> Instance;
    fmi3FreeInstance(Instance);
    fmi3EnterInitializationMode(Instance, Bool, f64, f64, Bool, f64) -> Status;
    fmi3ExitInitializationMode(Instance) -> Status;
    fmi3EnterEventMode(Instance) -> Status;
    fmi3Terminate(Instance) -> Status;
    fmi3Reset(Instance) -> Status;
    fmi3GetFloat32(Instance, Refs, usize, *mut f32, usize) -> Status;
    fmi3GetFloat64(Instance, Refs, usize, *mut f64, usize) -> Status;
    fmi3GetInt8(Instance, Refs, usize, *mut i8, usize) -> Status;
    fmi3GetUInt8(Instance, Refs, usize, *mut u8, usize) -> Status;
    fmi3GetInt16(Instance, Refs, usize, *mut i16, usize) -> Status;
    fmi3GetUInt16(Instance, Refs, usize, *mut u16, usize) -> Status;
    fmi3GetInt32(Instance, Refs, usize, *mut i32, usize) -> Status;
    fmi3GetUInt32(Instance, Refs, usize, *mut u32, usize) -> Status;
    fmi3GetInt64(Instance, Refs, usize, *mut i64, usize) -> Status;
    fmi3GetUInt64(Instance, Refs, usize, *mut u64, usize) -> Status;
    fmi3GetBoolean(Instance, Refs, usize, *mut Bool, usize) -> Status;
    fmi3GetString(Instance, Refs, usize, *mut Text, usize) -> Status;
    fmi3GetBinary(Instance, Refs, usize, *mut usize, *mut Binary, usize) -> Status;
    fmi3GetClock(Instance, Refs, usize, *mut Bool) -> Status;
    fmi3SetFloat32(Instance, Refs, usize, *const f32, usize) -> Status;
    fmi3SetFloat64(Instance, Refs, usize, *const f64, usize) -> Status;
    fmi3SetInt8(Instance, Refs, usize, *const i8, usize) -> Status;
    fmi3SetUInt8(Instance, Refs, usize, *const u8, usize) -> Status;
    fmi3SetInt16(Instance, Refs, usize, *const i16, usize) -> Status;
    fmi3SetUInt16(Instance, Refs, usize, *const u16, usize) -> Status;
    fmi3SetInt32(Instance, Refs, usize, *const i32, usize) -> Status;
    fmi3SetUInt32(Instance, Refs, usize, *const u32, usize) -> Status;
    fmi3SetInt64(Instance, Refs, usize, *const i64, usize) -> Status;
    fmi3SetUInt64(Instance, Refs, usize, *const u64, usize) -> Status;
    fmi3SetBoolean(Instance, Refs, usize, *const Bool, usize) -> Status;
    fmi3SetString(Instance, Refs, usize, *const Text, usize) -> Status;
    fmi3SetBinary(Instance, Refs, usize, *const usize, *const Binary, usize) -> Status;
    fmi3SetClock(Instance, Refs, usize, *const Bool) -> Status;
    fmi3GetNumberOfVariableDependencies(Instance, Reference, *mut usize) -> Status;
    fmi3GetVariableDependencies(
        Instance, Reference, *mut usize, *mut Reference, *mut usize, *mut c_int, usize
    ) -> Status;
    fmi3GetFMUState(Instance, *mut FmuState) -> Status;
    fmi3SetFMUState(Instance, FmuState) -> Status;
    fmi3FreeFMUState(Instance, *mut FmuState) -> Status;
    fmi3SerializedFMUStateSize(Instance, FmuState, *mut usize) -> Status;
    fmi3SerializeFMUState(Instance, FmuState, *mut u8, usize) -> Status;
    fmi3DeserializeFMUState(Instance, *const u8, usize, *mut FmuState) -> Status;
    fmi3GetDirectionalDerivative(
        Instance, Refs, usize, Refs, usize, *const f64, usize, *mut f64, usize
    ) -> Status;
    fmi3GetAdjointDerivative(
        Instance, Refs, usize, Refs, usize, *const f64, usize, *mut f64, usize
    ) -> Status;
    fmi3EnterConfigurationMode(Instance) -> Status;
    fmi3ExitConfigurationMode(Instance) -> Status;
    fmi3GetIntervalDecimal(Instance, Refs, usize, *mut f64, *mut c_int) -> Status;
    fmi3GetIntervalFraction(Instance, Refs, usize, *mut u64, *mut u64, *mut c_int) -> Status;
    fmi3GetShiftDecimal(Instance, Refs, usize, *mut f64) -> Status;
    fmi3GetShiftFraction(Instance, Refs, usize, *mut u64, *mut u64) -> Status;
    fmi3SetIntervalDecimal(Instance, Refs, usize, *const f64) -> Status;
    fmi3SetIntervalFraction(Instance, Refs, usize, *const u64, *const u64) -> Status;
    fmi3SetShiftDecimal(Instance, Refs, usize, *const f64) -> Status;
    fmi3SetShiftFraction(Instance, Refs, usize, *const u64, *const u64) -> Status;
    fmi3EvaluateDiscreteStates(Instance) -> Status;
    fmi3UpdateDiscreteStates(
        Instance, *mut Bool, *mut Bool, *mut Bool, *mut Bool, *mut Bool, *mut f64
    ) -> Status;
    fmi3EnterContinuousTimeMode(Instance) -> Status;
    fmi3CompletedIntegratorStep(Instance, Bool, *mut Bool, *mut Bool) -> Status;
    fmi3SetTime(Instance, f64) -> Status;
    fmi3SetContinuousStates(Instance, *const f64, usize) -> Status;
    fmi3GetContinuousStateDerivatives(Instance, *mut f64, usize) -> Status;
    fmi3GetEventIndicators(Instance, *mut f64, usize) -> Status;
    fmi3GetContinuousStates(Instance, *mut f64, usize) -> Status;
    fmi3GetNominalsOfContinuousStates(Instance, *mut f64, usize) -> Status;
    fmi3GetNumberOfEventIndicators(Instance, *mut usize) -> Status;
    fmi3GetNumberOfContinuousStates(Instance, *mut usize) -> Status;
    fmi3EnterStepMode(Instance) -> Status;
    fmi3GetOutputDerivatives(Instance, Refs, usize, *const c_int, *mut f64, usize) -> Status;
    fmi3DoStep(
        Instance, f64, f64, Bool, *mut Bool, *mut Bool, *mut Bool, *mut f64
    ) -> Status;
    fmi3ActivateModelPartition(Instance, Reference, f64) -> Status;
}
