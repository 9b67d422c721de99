//! The functions of Model Exchange: fmi2Functions.h, "Functions for FMI2 for Model Exchange".
//!
//! The importer integrates. No equation contains time itself, and there are no event indicators: a
//! change of the one discrete output, `flowState`, asks for its event after a completed step.

#![allow(non_snake_case)]

use super::{
    arguments::{elements, fill, room, room_for_one},
    instance::{Instance, Message, Outcome, call, refuse},
    legality::{CONTINUOUS_TIME_MODE, EVENT_MODE, Function},
    types::*,
};
use crate::block::variables::STATES;

// ------------------------------------------------------------------ modes

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(c: fmi2Component) -> fmi2Status {
    let body = |instance: &mut Instance| {
        instance.block.begin_event();
        instance.state = EVENT_MODE;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2EnterEventMode, body) }
}

/// # Safety
/// As in the standard: `info` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2NewDiscreteStates(
    c: fmi2Component,
    info: *mut fmi2EventInfo,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let info = unsafe { room_for_one(info, "eventInfo")? };
        instance.block.update()?;
        let answer = fmi2EventInfo {
            newDiscreteStatesNeeded: FMI2_FALSE,
            terminateSimulation: FMI2_FALSE,
            nominalsOfContinuousStatesChanged: FMI2_FALSE,
            valuesOfContinuousStatesChanged: FMI2_FALSE,
            nextEventTimeDefined: FMI2_FALSE,
            nextEventTime: 0.0,
        };
        info.write(answer);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2NewDiscreteStates, body) }
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterContinuousTimeMode(c: fmi2Component) -> fmi2Status {
    let body = |instance: &mut Instance| {
        instance.block.begin_integration()?;
        instance.state = CONTINUOUS_TIME_MODE;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2EnterContinuousTimeMode, body) }
}

/// # Safety
/// As in the standard: the two results may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2CompletedIntegratorStep(
    c: fmi2Component,
    _noSetFMUStatePriorToCurrentPoint: fmi2Boolean,
    enterEventMode: *mut fmi2Boolean,
    terminateSimulation: *mut fmi2Boolean,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller. One reference ends before the next is made, because an
        // importer may pass the same place twice; the event then counts.
        unsafe {
            room_for_one(enterEventMode, "enterEventMode")?;
            room_for_one(terminateSimulation, "terminateSimulation")?;
            let has_event = instance.block.has_event()?;
            room_for_one(terminateSimulation, "terminateSimulation")?.write(FMI2_FALSE);
            room_for_one(enterEventMode, "enterEventMode")?.write(has_event.into());
        }
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2CompletedIntegratorStep, body) }
}

// ------------------------------------------------------------------ time and states

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: fmi2Component, time: fmi2Real) -> fmi2Status {
    let body = |instance: &mut Instance| {
        if !time.is_finite() {
            return refuse(format!("time = {time} is not finite; pass a finite time"));
        }
        instance.experiment.time = time;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetTime, body) }
}

/// An error if the importer's vector does not have as many `what` as this FMU.
fn check_count(given: usize, count: usize, what: &str) -> Outcome {
    if given == count {
        return Ok(());
    }
    refuse(format!(
        "the vector has room for {given} {what}, but this FMU has {count}; pass that number"
    ))
}

/// # Safety
/// As in the standard: `x` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(
    c: fmi2Component,
    x: *const fmi2Real,
    nx: usize,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        check_count(nx, STATES.len(), "continuous states")?;
        // SAFETY: passed on from the caller.
        let x = unsafe { elements(x, nx, "x")? };
        Ok(instance.block.set_states(x)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetContinuousStates, body) }
}

/// # Safety
/// As in the standard: `x` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(
    c: fmi2Component,
    x: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let answer = |instance: &mut Instance| Ok(instance.block.states()?);
    // SAFETY: passed on from the caller.
    unsafe { state_vector(c, Function::fmi2GetContinuousStates, x, nx, answer) }
}

/// # Safety
/// As in the standard: `derivatives` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(
    c: fmi2Component,
    derivatives: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let answer = |instance: &mut Instance| Ok(instance.block.derivatives()?);
    // SAFETY: passed on from the caller.
    unsafe { state_vector(c, Function::fmi2GetDerivatives, derivatives, nx, answer) }
}

/// # Safety
/// As in the standard: `x_nominal` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: fmi2Component,
    x_nominal: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let answer = |_: &mut Instance| Ok(STATES.map(|state| state.nominal));
    let function = Function::fmi2GetNominalsOfContinuousStates;
    // SAFETY: passed on from the caller.
    unsafe { state_vector(c, function, x_nominal, nx, answer) }
}

/// Returns one number for each continuous state.
///
/// # Safety
/// As `call`; `out` has `count` elements.
unsafe fn state_vector(
    c: fmi2Component,
    function: Function,
    out: *mut fmi2Real,
    count: usize,
    answer: impl FnOnce(&mut Instance) -> Result<[f64; STATES.len()], Message>,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        check_count(count, STATES.len(), "continuous states")?;
        // SAFETY: passed on from the caller.
        let out = unsafe { room(out, count, "the vector for the result")? };
        fill(out, answer(instance)?);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, function, body) }
}

/// # Safety
/// As in the standard; this FMU has no event indicators.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetEventIndicators(
    c: fmi2Component,
    _eventIndicators: *mut fmi2Real,
    ni: usize,
) -> fmi2Status {
    let body = |_: &mut Instance| check_count(ni, 0, "event indicators");
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetEventIndicators, body) }
}
