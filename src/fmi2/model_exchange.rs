//! The functions of Model Exchange: fmi2Functions.h, "Functions for FMI2 for Model Exchange".
//!
//! This FMU does not offer that interface: by the table of legality every call is refused.

#![allow(non_snake_case)]

use super::{
    instance::{call, refuse},
    legality::Function,
    types::*,
};

/// # Safety
/// As `call`.
unsafe fn refused(c: fmi2Component, function: Function) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { call(c, function, |_| refuse("not offered by this FMU".into())) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2EnterEventMode) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(
    c: fmi2Component,
    _info: *mut fmi2EventInfo,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2NewDiscreteStates) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2EnterContinuousTimeMode) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: fmi2Component,
    _noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
    _enterEventMode: *mut fmi2Boolean,
    _terminateSimulation: *mut fmi2Boolean,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2CompletedIntegratorStep) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: fmi2Component, _time: fmi2Real) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2SetTime) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(
    c: fmi2Component,
    _x: *const fmi2Real,
    _nx: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2SetContinuousStates) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(
    c: fmi2Component,
    _derivatives: *mut fmi2Real,
    _nx: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2GetDerivatives) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetEventIndicators(
    c: fmi2Component,
    _eventIndicators: *mut fmi2Real,
    _ni: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2GetEventIndicators) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(
    c: fmi2Component,
    _x: *mut fmi2Real,
    _nx: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2GetContinuousStates) }
}

/// # Safety
/// As in the standard.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: fmi2Component,
    _x_nominal: *mut fmi2Real,
    _nx: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { refused(c, Function::fmi2GetNominalsOfContinuousStates) }
}
