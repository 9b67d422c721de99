//! The functions of Co-Simulation: fmi2Functions.h, "Functions for FMI2 for Co-Simulation".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    arguments::{elements, room, room_for_one},
    instance::{Instance, Message, Outcome, call, refuse},
    legality::Function,
};

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DoStep(
    c: fmi2Component,
    currentCommunicationPoint: fmi2Real,
    communicationStepSize: fmi2Real,
    _noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        let step = communicationStepSize;
        let experiment = &instance.experiment;
        let end = experiment.end_of_step(currentCommunicationPoint, step)?;
        instance.block.step(step)?;
        instance.experiment.time = end;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2DoStep, body) }
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CancelStep(c: fmi2Component) -> fmi2Status {
    // Legal only while a step runs asynchronously, and no step of this FMU does.
    // SAFETY: passed on from the caller.
    unsafe {
        call(c, Function::fmi2CancelStep, |_| {
            refuse("modelDescription.xml says canRunAsynchronuously = false".into())
        })
    }
}

/// The derivatives apply to the next step: by the standard, inputs and their derivatives are those
/// at the beginning of a step. A refused step does not use them up.
///
/// # Safety
/// As in the standard: `vr`, `order` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetRealInputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *const fmi2Real,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, order, value) = unsafe {
            (
                elements(vr, nvr, "vr")?,
                elements(order, nvr, "order")?,
                elements(value, nvr, "value")?,
            )
        };
        if let Some(other) = order.iter().find(|order| **order != 1) {
            return refuse(format!(
                "order = {other}, but the inputs of this FMU move linearly within a step; pass first derivatives (order 1)"
            ));
        }
        Ok(instance.block.set_input_slopes(vr, value)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetRealInputDerivatives, body) }
}

/// # Safety
/// As in the standard: `vr`, `order` and `value` have `nvr` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealOutputDerivatives(
    c: fmi2Component,
    vr: *const fmi2ValueReference,
    nvr: usize,
    order: *const fmi2Integer,
    value: *mut fmi2Real,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (vr, order, value) = unsafe {
            (
                elements(vr, nvr, "vr")?,
                elements(order, nvr, "order")?,
                room(value, nvr, "value")?,
            )
        };
        instance.output_rates(vr, order, value)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetRealOutputDerivatives, body) }
}

// ------------------------------------------------------------------ status

/// Returns one kind of status and refuses the others. Steps end within fmi2DoStep, so nothing is
/// ever pending.
///
/// # Safety
/// As `call`; `value` is null or may be written.
unsafe fn status<T>(
    c: fmi2Component,
    function: &'static Function,
    value: *mut T,
    answer: impl Fn(&Instance) -> Option<T>,
) -> fmi2Status {
    let body = |instance: &mut Instance| -> Outcome {
        let answer = answer(instance).ok_or_else(|| {
            Message::Error(
                "this function does not return that kind of status; see fmi2StatusKind".into(),
            )
        })?;
        // SAFETY: passed on from the caller.
        unsafe { room_for_one(value, "value")? }.write(answer);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, function, body) }
}

/// # Safety
/// As in the standard: `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStatus(
    c: fmi2Component,
    s: fmi2Enumeration,
    value: *mut fmi2Status,
) -> fmi2Status {
    let answer = |_: &Instance| (s == FMI2_DO_STEP_STATUS).then_some(fmi2Status::Ok);
    // SAFETY: passed on from the caller.
    unsafe { status(c, Function::fmi2GetStatus, value, answer) }
}

/// # Safety
/// As in the standard: `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetRealStatus(
    c: fmi2Component,
    s: fmi2Enumeration,
    value: *mut fmi2Real,
) -> fmi2Status {
    let answer = |i: &Instance| (s == FMI2_LAST_SUCCESSFUL_TIME).then_some(i.experiment.time);
    // SAFETY: passed on from the caller.
    unsafe { status(c, Function::fmi2GetRealStatus, value, answer) }
}

/// # Safety
/// As in the standard: `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetIntegerStatus(
    c: fmi2Component,
    _s: fmi2Enumeration,
    value: *mut fmi2Integer,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { status(c, Function::fmi2GetIntegerStatus, value, |_| None) }
}

/// # Safety
/// As in the standard: `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetBooleanStatus(
    c: fmi2Component,
    s: fmi2Enumeration,
    value: *mut fmi2Boolean,
) -> fmi2Status {
    // This FMU never asks the importer to end the simulation.
    let answer = |_: &Instance| (s == FMI2_TERMINATED).then_some(FMI2_FALSE);
    // SAFETY: passed on from the caller.
    unsafe { status(c, Function::fmi2GetBooleanStatus, value, answer) }
}

/// # Safety
/// As in the standard: `value` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetStringStatus(
    c: fmi2Component,
    s: fmi2Enumeration,
    value: *mut fmi2String,
) -> fmi2Status {
    let answer = |_: &Instance| (s == FMI2_PENDING_STATUS).then_some(c"".as_ptr());
    // SAFETY: passed on from the caller.
    unsafe { status(c, Function::fmi2GetStringStatus, value, answer) }
}
