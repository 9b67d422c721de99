//! The C types of fmi3PlatformTypes.h and fmi3FunctionTypes.h, under their own names.

#![allow(non_camel_case_types, non_snake_case)]

use crate::fmi::types::{
    Component, Environment, IntermediateUpdate, StatePointer, Status, Text, ValueReference,
};
use core::ffi::c_int;

pub type fmi3Instance = Component;
pub type fmi3InstanceEnvironment = Environment;
pub type fmi3FMUState = StatePointer;
pub type fmi3ValueReference = ValueReference;
pub type fmi3Status = Status;
pub type fmi3String = Text;
pub type fmi3Float64 = f64;
pub type fmi3Int32 = i32;
pub type fmi3Int64 = i64;
pub type fmi3UInt64 = u64;
pub type fmi3Byte = u8;
/// A C `bool` as an importer passes it: any byte may arrive.
pub type fmi3Boolean = u8;
pub type fmi3Clock = fmi3Boolean;
pub type fmi3Binary = *const fmi3Byte;
/// An `fmi3DependencyKind`.
pub type fmi3DependencyKind = c_int;
/// An `fmi3IntervalQualifier`.
pub type fmi3IntervalQualifier = c_int;

pub const FMI3_FALSE: fmi3Boolean = 0;

/// The last `fmi3DependencyKind`: no particular structure.
pub const FMI3_DEPENDENT: fmi3DependencyKind = 5;

pub type fmi3LogMessageCallback =
    unsafe extern "C" fn(fmi3InstanceEnvironment, fmi3Status, fmi3String, fmi3String);

pub type fmi3IntermediateUpdateCallback = IntermediateUpdate;

pub type fmi3ClockUpdateCallback = unsafe extern "C" fn(fmi3InstanceEnvironment);
pub type fmi3LockPreemptionCallback = unsafe extern "C" fn();
