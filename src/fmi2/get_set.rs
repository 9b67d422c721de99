//! Getting and setting the values of variables: fmi2Functions.h, "Getting and setting variable
//! values".

#![allow(non_snake_case)]

use super::{
    arguments::{elements, room, text},
    instance::{Instance, call, no_memory},
    legality::{CONTINUOUS_TIME_MODE, Function, INITIALIZATION_MODE},
    logger::printable,
    types::*,
};
use crate::block::{
    Names,
    variables::{IntegerRef, RealRef, StringRef},
};
use crate::host::memory::Watch;

/// Those of the importer's value references that exist.
fn references<R>(vr: &[fmi2ValueReference]) -> impl Iterator<Item = R>
where
    fmi2ValueReference: Names<R>,
{
    vr.iter().flat_map(|number| number.reference())
}

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
        // The states have their values already, except in Initialization Mode.
        let is_initializing = instance.state == INITIALIZATION_MODE;
        let must_be_computed = |real: RealRef| {
            real.variable().causality.is_computed() && (is_initializing || !real.is_state())
        };
        if references(vr).any(must_be_computed) {
            instance.refresh()?;
        }
        for (reference, slot) in vr.iter().zip(value) {
            slot.write(instance.block.values().real(*reference)?);
        }
        Ok(())
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
        // Discrete variables keep their values in Continuous-Time Mode.
        let is_held = instance.state == CONTINUOUS_TIME_MODE;
        let is_computed = |integer: IntegerRef| integer.variable().causality.is_computed();
        if !is_held && references(vr).any(is_computed) {
            instance.refresh()?;
        }
        for (reference, slot) in vr.iter().zip(value) {
            slot.write(instance.block.values().integer(*reference)?);
        }
        Ok(())
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
        for (reference, slot) in vr.iter().zip(value) {
            slot.write(instance.block.values().boolean(*reference)?.into());
        }
        Ok(())
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
        for (reference, slot) in vr.iter().zip(value) {
            let reference: StringRef = reference.reference()?;
            let kept = &mut instance.strings[reference];
            // An unchanged text keeps its address, also where one call names it twice.
            let present = &instance.block.values().strings[reference];
            if kept.as_bytes() != present.as_bytes() {
                let watch = Watch::begin();
                let changed = printable(present);
                if watch.is_short() {
                    return Err(no_memory(()));
                }
                *kept = changed;
            }
            slot.write(kept.as_ptr());
        }
        Ok(())
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
        let texts = value.iter().map(|v| unsafe { text(*v, "a value") });
        let mut known = Vec::new();
        known.try_reserve_exact(value.len()).map_err(no_memory)?;
        for text in texts {
            known.push(text?);
        }
        let texts = known;
        Ok(instance.block.set_strings(vr, &texts)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetString, body) }
}
