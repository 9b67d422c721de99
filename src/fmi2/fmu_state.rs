//! The complete state of an instance: fmi2Functions.h, "Getting and setting the internal FMU
//! state".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{fmu_state, legality::Function};

/// # Safety
/// As in the standard: `*state` is null or comes from this function and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::get(c, Function::fmi2GetFMUstate, state) }
}

/// # Safety
/// As in the standard: `state` comes from fmi2GetFMUstate or fmi2DeSerializeFMUstate and was not
/// freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::set(c, Function::fmi2SetFMUstate, state) }
}

/// # Safety
/// As in the standard: `state` is null, or `*state` as in fmi2SetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(
    c: fmi2Component,
    state: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::free(c, Function::fmi2FreeFMUstate, state) }
}

/// # Safety
/// As in the standard: `state` as in fmi2SetFMUstate, `size` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    state: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    let function = Function::fmi2SerializedFMUstateSize;
    // SAFETY: passed on from the caller.
    unsafe { fmu_state::serialized_size(c, function, state, size) }
}

/// # Safety
/// As in the standard: `state` as in fmi2SetFMUstate, `serializedState` has `size` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    state: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    let (function, bytes) = (Function::fmi2SerializeFMUstate, serializedState.cast());
    // SAFETY: passed on from the caller; a byte is a byte.
    unsafe { fmu_state::serialize(c, function, state, bytes, size) }
}

/// # Safety
/// As in the standard: `serializedState` has `size` elements, `*state` as in fmi2GetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    state: *mut fmi2FMUstate,
) -> fmi2Status {
    let (function, bytes) = (Function::fmi2DeSerializeFMUstate, serializedState.cast());
    // SAFETY: passed on from the caller; a byte is a byte.
    unsafe { fmu_state::deserialize(c, function, bytes, size, state) }
}
