//! From the experiment to the end: fmi2Functions.h, "Enter and exit initialization mode, terminate
//! and reset".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    Experiment,
    instance::{Instance, call},
    legality::{Function, INITIALIZATION_MODE, TERMINATED},
};

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetupExperiment(
    c: fmi2Component,
    _toleranceDefined: fmi2Boolean,
    _tolerance: fmi2Real,
    startTime: fmi2Real,
    stopTimeDefined: fmi2Boolean,
    stopTime: fmi2Real,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        let stop_time = (stopTimeDefined != FMI2_FALSE).then_some(stopTime);
        instance.experiment = Experiment::new(startTime, stop_time)?;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetupExperiment, body) }
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2EnterInitializationMode(c: fmi2Component) -> fmi2Status {
    let body = |instance: &mut Instance| {
        instance.state = INITIALIZATION_MODE;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2EnterInitializationMode, body) }
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2ExitInitializationMode(c: fmi2Component) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2ExitInitializationMode, Instance::start) }
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Terminate(c: fmi2Component) -> fmi2Status {
    let body = |instance: &mut Instance| {
        instance.state = TERMINATED;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2Terminate, body) }
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Reset(c: fmi2Component) -> fmi2Status {
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2Reset, Instance::reset) }
}
