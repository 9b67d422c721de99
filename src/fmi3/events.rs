//! Event Mode, in which the discrete output `flowState` gets its new value: fmi3Functions.h, "Enter
//! event mode" and "fmi3UpdateDiscreteStates".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    arguments::room_for_one,
    instance::{Instance, call, refuse},
    legality::{Function, Interface},
};

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterEventMode(instance: fmi3Instance) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let is_stepping = instance.interface == Interface::CoSimulation;
        if is_stepping && !instance.options.has_event_mode {
            return refuse(
                "the instance was made with eventModeUsed = false; events happen between its steps by themselves".into(),
            );
        }
        instance.enter_event_mode()
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3EnterEventMode, body) }
}

/// # Safety
/// As in the standard: the results may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3UpdateDiscreteStates(
    instance: fmi3Instance,
    discreteStatesNeedUpdate: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
    nominalsOfContinuousStatesChanged: *mut fmi3Boolean,
    valuesOfContinuousStatesChanged: *mut fmi3Boolean,
    nextEventTimeDefined: *mut fmi3Boolean,
    nextEventTime: *mut fmi3Float64,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let flags = [
            (discreteStatesNeedUpdate, "discreteStatesNeedUpdate"),
            (terminateSimulation, "terminateSimulation"),
            (
                nominalsOfContinuousStatesChanged,
                "nominalsOfContinuousStatesChanged",
            ),
            (
                valuesOfContinuousStatesChanged,
                "valuesOfContinuousStatesChanged",
            ),
            (nextEventTimeDefined, "nextEventTimeDefined"),
        ];
        // SAFETY: passed on from the caller. One reference ends before the next is made.
        unsafe {
            for (flag, name) in flags {
                room_for_one(flag, name)?;
            }
            room_for_one(nextEventTime, "nextEventTime")?;
            instance.block.update()?;
            for (flag, name) in flags {
                room_for_one(flag, name)?.write(FMI3_FALSE);
            }
            room_for_one(nextEventTime, "nextEventTime")?.write(0.0);
        }
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3UpdateDiscreteStates, body) }
}
