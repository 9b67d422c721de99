//! From the initialisation to the end: fmi3Functions.h, "Enter and exit initialization mode, enter
//! event mode, terminate and reset".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    Experiment,
    instance::{Instance, call},
    legality::{Function, INITIALIZATION_MODE, TERMINATED},
};

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterInitializationMode(
    instance: fmi3Instance,
    _toleranceDefined: fmi3Boolean,
    _tolerance: fmi3Float64,
    startTime: fmi3Float64,
    stopTimeDefined: fmi3Boolean,
    stopTime: fmi3Float64,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let stop_time = (stopTimeDefined != FMI3_FALSE).then_some(stopTime);
        instance.experiment = Experiment::new(startTime, stop_time)?;
        instance.state = INITIALIZATION_MODE;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3EnterInitializationMode, body) }
}

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3ExitInitializationMode(instance: fmi3Instance) -> fmi3Status {
    let function = Function::fmi3ExitInitializationMode;
    // SAFETY: passed on from the caller.
    unsafe { call(instance, function, Instance::start) }
}

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Terminate(instance: fmi3Instance) -> fmi3Status {
    let body = |instance: &mut Instance| {
        instance.state = TERMINATED;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3Terminate, body) }
}

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3Reset(instance: fmi3Instance) -> fmi3Status {
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3Reset, Instance::reset) }
}
