//! The common functions whose capability flags are false in modelDescription.xml: getting and
//! setting the whole state, and directional derivatives. Every call is refused with the flag's name.

#![allow(non_snake_case)]

use super::{
    instance::{call, refuse},
    legality::Function,
    types::*,
};

/// Answers a function whose capability flag is false in modelDescription.xml.
///
/// # Safety
/// As `call`.
pub unsafe fn not_offered(c: fmi2Component, function: Function, flag: &str) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe {
        call(c, function, |_| {
            refuse(format!(
                "not offered by this FMU: modelDescription.xml says {flag}"
            ))
        })
    }
}

const NO_STATE: &str = "canGetAndSetFMUstate = false";
const NO_SERIALIZATION: &str = "canSerializeFMUstate = false";

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(
    c: fmi2Component,
    _state: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { not_offered(c, Function::fmi2GetFMUstate, NO_STATE) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, _state: fmi2FMUstate) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { not_offered(c, Function::fmi2SetFMUstate, NO_STATE) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(
    c: fmi2Component,
    _state: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { not_offered(c, Function::fmi2FreeFMUstate, NO_STATE) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    _state: fmi2FMUstate,
    _size: *mut usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { not_offered(c, Function::fmi2SerializedFMUstateSize, NO_SERIALIZATION) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    _state: fmi2FMUstate,
    _serializedState: *mut fmi2Byte,
    _size: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { not_offered(c, Function::fmi2SerializeFMUstate, NO_SERIALIZATION) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    _serializedState: *const fmi2Byte,
    _size: usize,
    _state: *mut fmi2FMUstate,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { not_offered(c, Function::fmi2DeSerializeFMUstate, NO_SERIALIZATION) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: fmi2Component,
    _vUnknown_ref: *const fmi2ValueReference,
    _nUnknown: usize,
    _vKnown_ref: *const fmi2ValueReference,
    _nKnown: usize,
    _dvKnown: *const fmi2Real,
    _dvUnknown: *mut fmi2Real,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe {
        not_offered(
            c,
            Function::fmi2GetDirectionalDerivative,
            "providesDirectionalDerivative = false",
        )
    }
}
