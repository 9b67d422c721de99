//! From the experiment to the end: fmi2Functions.h, "Enter and exit initialization mode, terminate
//! and reset".

#![allow(non_snake_case)]

use super::{
    communication_time::Experiment,
    instance::{Instance, call, refuse},
    legality::{Function, INITIALIZATION_MODE, INSTANTIATED, TERMINATED},
    types::*,
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
        if !startTime.is_finite() {
            return refuse(format!(
                "startTime = {startTime} is not finite; pass a finite time"
            ));
        }
        let stop_time = (stopTimeDefined != FMI2_FALSE).then_some(stopTime);
        if let Some(stop) = stop_time
            && (stop.is_nan() || stop < startTime)
        {
            return refuse(format!(
                "stopTime = {stop} s is before startTime = {startTime} s; pass a later stopTime or none"
            ));
        }
        instance.experiment = Experiment {
            start_time: startTime,
            time: startTime,
            stop_time,
        };
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
    let body = |instance: &mut Instance| {
        instance.block.start()?;
        instance.state = instance.initialized();
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2ExitInitializationMode, body) }
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
    let body = |instance: &mut Instance| {
        instance.block.reset();
        instance.experiment = Experiment::default();
        instance.state = INSTANTIATED;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2Reset, body) }
}
