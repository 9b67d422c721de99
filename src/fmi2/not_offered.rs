//! The function whose capability flag is false in modelDescription.xml: directional derivatives. Every call is
//! refused with the flag's name.

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
