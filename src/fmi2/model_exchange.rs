//! The functions of Model Exchange: fmi2Functions.h, "Functions for FMI2 for Model Exchange".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    arguments::room_for_one,
    instance::{Instance, call},
    legality::Function,
    model_exchange::{Vector, check_count, completed_step, set_states, state_vector},
};

// ------------------------------------------------------------------ modes

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterEventMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2EnterEventMode, Instance::enter_event_mode) }
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
    let body = Instance::enter_continuous_time_mode;
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
    let function = Function::fmi2CompletedIntegratorStep;
    // SAFETY: passed on from the caller.
    unsafe { completed_step(c, function, enterEventMode, terminateSimulation) }
}

// ------------------------------------------------------------------ time and states

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetTime(c: fmi2Component, time: fmi2Real) -> fmi2Status {
    let body = |instance: &mut Instance| instance.set_time(time);
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetTime, body) }
}

/// # Safety
/// As in the standard: `x` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetContinuousStates(
    c: fmi2Component,
    x: *const fmi2Real,
    nx: usize,
) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { set_states(c, Function::fmi2SetContinuousStates, x, nx) }
}

/// # Safety
/// As in the standard: `x` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetContinuousStates(
    c: fmi2Component,
    x: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let function = Function::fmi2GetContinuousStates;
    // SAFETY: passed on from the caller.
    unsafe { state_vector(c, function, Vector::States, x, nx) }
}

/// # Safety
/// As in the standard: `derivatives` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDerivatives(
    c: fmi2Component,
    derivatives: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let function = Function::fmi2GetDerivatives;
    // SAFETY: passed on from the caller.
    unsafe { state_vector(c, function, Vector::Derivatives, derivatives, nx) }
}

/// # Safety
/// As in the standard: `x_nominal` has `nx` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetNominalsOfContinuousStates(
    c: fmi2Component,
    x_nominal: *mut fmi2Real,
    nx: usize,
) -> fmi2Status {
    let function = Function::fmi2GetNominalsOfContinuousStates;
    // SAFETY: passed on from the caller.
    unsafe { state_vector(c, function, Vector::Nominals, x_nominal, nx) }
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
