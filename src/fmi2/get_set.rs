//! Getting and setting the values of variables: fmi2Functions.h, "Getting and setting variable
//! values".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    arguments::{elements, room},
    instance::{Instance, call},
    legality::Function,
};

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Real,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, room(value, nvr, "value")?) };
        instance.get_reals(vr, value)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetReal, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Integer,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, room(value, nvr, "value")?) };
        instance.get_integers(vr, value)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetInteger, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, room(value, nvr, "value")?) };
        instance.get_booleans(vr, value)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetBoolean, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *mut fmi2String,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, room(value, nvr, "value")?) };
        instance.get_strings(vr, value)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetString, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetReal(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Real,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, elements(value, nvr, "value")?) };
        Ok(instance.block.set_reals(vr, value)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetReal, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetInteger(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Integer,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, elements(value, nvr, "value")?) };
        Ok(instance.block.set_integers(vr, value)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetInteger, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetBoolean(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2Boolean,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, elements(value, nvr, "value")?) };
        Ok(instance.block.set_booleans(vr, value)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetBoolean, body) }
}

/// # Safety
/// As in the standard: `vr` and `value` have `nvr` elements, C strings the latter.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetString(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    value: *const fmi2String,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, value) = unsafe { (elements(vr, nvr, "vr")?, elements(value, nvr, "value")?) };
        // SAFETY: passed on from the caller.
        unsafe { instance.set_strings(vr, value) }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetString, body) }
}
