//! The C types of fmi2TypesPlatform.h and fmi2FunctionTypes.h, under their own names.

#![allow(non_camel_case_types, non_snake_case)]

use crate::fmi::types::{Component, Environment, StatePointer, Status, Text, ValueReference};
use core::ffi::{c_char, c_int, c_void};

pub type fmi2Component = Component;
pub type fmi2ComponentEnvironment = Environment;
pub type fmi2FMUstate = StatePointer;
pub type fmi2ValueReference = ValueReference;
pub type fmi2Status = Status;
pub type fmi2Real = f64;
pub type fmi2Integer = c_int;
pub type fmi2Boolean = c_int;
pub type fmi2String = Text;
pub type fmi2Byte = c_char;
/// An `fmi2Type` or `fmi2StatusKind` as an importer passes it: any integer may arrive.
pub type fmi2Enumeration = c_int;

/// `fmi2Type`.
pub const FMI2_MODEL_EXCHANGE: fmi2Enumeration = 0;
pub const FMI2_CO_SIMULATION: fmi2Enumeration = 1;

/// `fmi2StatusKind`.
pub const FMI2_DO_STEP_STATUS: fmi2Enumeration = 0;
pub const FMI2_PENDING_STATUS: fmi2Enumeration = 1;
pub const FMI2_LAST_SUCCESSFUL_TIME: fmi2Enumeration = 2;
pub const FMI2_TERMINATED: fmi2Enumeration = 3;

pub const FMI2_FALSE: fmi2Boolean = 0;

pub type fmi2CallbackLogger = unsafe extern "C" fn(
    fmi2ComponentEnvironment,
    fmi2String,
    fmi2Status,
    fmi2String,
    fmi2String,
    ...
);

#[repr(C)]
#[derive(Clone, Copy)]
pub struct fmi2CallbackFunctions {
    pub logger: Option<fmi2CallbackLogger>,
    pub allocateMemory: Option<unsafe extern "C" fn(usize, usize) -> *mut c_void>,
    pub freeMemory: Option<unsafe extern "C" fn(*mut c_void)>,
    pub stepFinished: Option<unsafe extern "C" fn(fmi2ComponentEnvironment, fmi2Status)>,
    pub componentEnvironment: fmi2ComponentEnvironment,
}

#[repr(C)]
pub struct fmi2EventInfo {
    pub newDiscreteStatesNeeded: fmi2Boolean,
    pub terminateSimulation: fmi2Boolean,
    pub nominalsOfContinuousStatesChanged: fmi2Boolean,
    pub valuesOfContinuousStatesChanged: fmi2Boolean,
    pub nextEventTimeDefined: fmi2Boolean,
    pub nextEventTime: fmi2Real,
}
