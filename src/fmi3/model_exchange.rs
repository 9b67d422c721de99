//! The functions of Model Exchange: fmi3Functions.h, "Functions for Model Exchange".

#![allow(non_snake_case)]

use super::types::*;
use crate::{
    block::variables::STATES,
    fmi::{
        arguments::room_for_one,
        instance::{Instance, call},
        legality::Function,
        model_exchange::{Vector, check_count, completed_step, set_states, state_vector},
    },
};

// ------------------------------------------------------------------ modes

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterContinuousTimeMode(instance: fmi3Instance) -> fmi3Status {
    let body = Instance::enter_continuous_time_mode;
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3EnterContinuousTimeMode, body) }
}

/// # Safety
/// As in the standard: the two results may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3CompletedIntegratorStep(
    instance: fmi3Instance,
    _noSetFMUStatePriorToCurrentPoint: fmi3Boolean,
    enterEventMode: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
) -> fmi3Status {
    let function = Function::fmi3CompletedIntegratorStep;
    // SAFETY: passed on from the caller.
    unsafe { completed_step(instance, function, enterEventMode, terminateSimulation) }
}

// ------------------------------------------------------------------ time and states

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetTime(instance: fmi3Instance, time: fmi3Float64) -> fmi3Status {
    let body = |instance: &mut Instance| instance.set_time(time);
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3SetTime, body) }
}

/// # Safety
/// As in the standard: `continuousStates` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetContinuousStates(
    instance: fmi3Instance,
    continuousStates: *const fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    let (function, count) = (Function::fmi3SetContinuousStates, nContinuousStates);
    // SAFETY: passed on from the caller.
    unsafe { set_states(instance, function, continuousStates, count) }
}

/// # Safety
/// As in the standard: `continuousStates` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStates(
    instance: fmi3Instance,
    continuousStates: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    let (function, count) = (Function::fmi3GetContinuousStates, nContinuousStates);
    // SAFETY: passed on from the caller.
    unsafe { state_vector(instance, function, Vector::States, continuousStates, count) }
}

/// # Safety
/// As in the standard: `derivatives` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetContinuousStateDerivatives(
    instance: fmi3Instance,
    derivatives: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    let (function, count) = (
        Function::fmi3GetContinuousStateDerivatives,
        nContinuousStates,
    );
    // SAFETY: passed on from the caller.
    unsafe { state_vector(instance, function, Vector::Derivatives, derivatives, count) }
}

/// # Safety
/// As in the standard: `nominals` has `nContinuousStates` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNominalsOfContinuousStates(
    instance: fmi3Instance,
    nominals: *mut fmi3Float64,
    nContinuousStates: usize,
) -> fmi3Status {
    let (function, count) = (
        Function::fmi3GetNominalsOfContinuousStates,
        nContinuousStates,
    );
    // SAFETY: passed on from the caller.
    unsafe { state_vector(instance, function, Vector::Nominals, nominals, count) }
}

/// # Safety
/// As in the standard; this FMU has no event indicators.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetEventIndicators(
    instance: fmi3Instance,
    _eventIndicators: *mut fmi3Float64,
    nEventIndicators: usize,
) -> fmi3Status {
    let body = |_: &mut Instance| check_count(nEventIndicators, 0, "event indicators");
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3GetEventIndicators, body) }
}

/// # Safety
/// As in the standard: `nContinuousStates` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfContinuousStates(
    instance: fmi3Instance,
    nContinuousStates: *mut usize,
) -> fmi3Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { room_for_one(nContinuousStates, "nContinuousStates")? }.write(STATES.len());
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3GetNumberOfContinuousStates, body) }
}

/// # Safety
/// As in the standard: `nEventIndicators` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetNumberOfEventIndicators(
    instance: fmi3Instance,
    nEventIndicators: *mut usize,
) -> fmi3Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { room_for_one(nEventIndicators, "nEventIndicators")? }.write(0);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3GetNumberOfEventIndicators, body) }
}
