//! The complete state of an instance: fmi3Functions.h, "Getting and setting the internal FMU
//! state".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{fmu_state, legality::Function};

/// # Safety
/// As in the standard: `*FMUState` is null or comes from this function and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetFMUState(
    instance: fmi3Instance,
    FMUState: *mut fmi3FMUState,
) -> fmi3Status {
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::get(instance, Function::fmi3GetFMUState, FMUState) }
}

/// # Safety
/// As in the standard: `FMUState` comes from fmi3GetFMUState or fmi3DeserializeFMUState and was not
/// freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetFMUState(
    instance: fmi3Instance,
    FMUState: fmi3FMUState,
) -> fmi3Status {
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::set(instance, Function::fmi3SetFMUState, FMUState) }
}

/// # Safety
/// As in the standard: `FMUState` is null, or `*FMUState` as in fmi3SetFMUState.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeFMUState(
    instance: fmi3Instance,
    FMUState: *mut fmi3FMUState,
) -> fmi3Status {
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::free(instance, Function::fmi3FreeFMUState, FMUState) }
}

/// # Safety
/// As in the standard: `FMUState` as in fmi3SetFMUState, `size` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializedFMUStateSize(
    instance: fmi3Instance,
    FMUState: fmi3FMUState,
    size: *mut usize,
) -> fmi3Status {
    let function = Function::fmi3SerializedFMUStateSize;
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::serialized_size(instance, function, FMUState, size) }
}

/// # Safety
/// As in the standard: `FMUState` as in fmi3SetFMUState, `serializedState` has `size` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SerializeFMUState(
    instance: fmi3Instance,
    FMUState: fmi3FMUState,
    serializedState: *mut fmi3Byte,
    size: usize,
) -> fmi3Status {
    let function = Function::fmi3SerializeFMUState;
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::serialize(instance, function, FMUState, serializedState, size) }
}

/// # Safety
/// As in the standard: `serializedState` has `size` elements, `*FMUState` as in fmi3GetFMUState.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DeserializeFMUState(
    instance: fmi3Instance,
    serializedState: *const fmi3Byte,
    size: usize,
    FMUState: *mut fmi3FMUState,
) -> fmi3Status {
    let function = Function::fmi3DeserializeFMUState;
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::deserialize(instance, function, serializedState, size, FMUState) }
}
