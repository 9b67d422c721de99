//! The functions of Co-Simulation: fmi3Functions.h, "Functions for Co-Simulation".

#![allow(non_snake_case)]

use super::{
    intermediate_update::{Interval, Progress, step_with_updates},
    types::*,
    variables::{Kind, Time},
};
use crate::fmi::{
    arguments::{elements, room, room_for_one},
    instance::{Instance, Message, Outcome, call},
    legality::{Function, STEP_MODE},
    types::ValueReference,
};

/// # Safety
/// As in the standard: `instance` lives.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3EnterStepMode(instance: fmi3Instance) -> fmi3Status {
    let body = |instance: &mut Instance| {
        instance.block.hold_flow_state(true);
        instance.state = STEP_MODE;
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3EnterStepMode, body) }
}

/// Where the results of fmi3DoStep go.
#[derive(Clone, Copy)]
pub struct Results {
    event_handling_needed: *mut fmi3Boolean,
    terminate_simulation: *mut fmi3Boolean,
    early_return: *mut fmi3Boolean,
    last_successful_time: *mut fmi3Float64,
}

impl Results {
    /// An error if they cannot be written.
    ///
    /// # Safety
    /// As in the standard: the pointers are null, or the results may be written.
    pub unsafe fn check(self) -> Outcome {
        // SAFETY: passed on from the caller. One reference ends before the next is made.
        unsafe {
            room_for_one(self.event_handling_needed, "eventHandlingNeeded")?;
            room_for_one(self.terminate_simulation, "terminateSimulation")?;
            room_for_one(self.early_return, "earlyReturn")?;
            room_for_one(self.last_successful_time, "lastSuccessfulTime")?;
        }
        Ok(())
    }

    /// Writes the results of a step that has come to the instance's present time; `end` is where
    /// it should have come to.
    ///
    /// # Safety
    /// As `check`, which has passed.
    pub unsafe fn write(self, instance: &Instance, end: f64) {
        let time = instance.experiment.time;
        let needs_event = instance.options.has_event_mode && instance.block.is_event_pending();
        // SAFETY: passed on from the caller; `check` has passed.
        unsafe {
            self.event_handling_needed.write(needs_event.into());
            self.terminate_simulation.write(FMI3_FALSE);
            self.early_return.write((time < end).into());
            self.last_successful_time.write(time);
        }
    }
}

impl Instance {
    /// Advances the block, and no further than to an event if the importer allows that. Returns
    /// the duration by which it has advanced.
    pub fn advance(&mut self, duration: f64) -> Result<f64, Message> {
        if self.options.has_event_mode && self.options.allows_early_return {
            return Ok(self.block.step_to_event(duration, 0)?);
        }
        self.block.step(duration)?;
        Ok(duration)
    }
}

/// # Safety
/// As in the standard: the results may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: fmi3Instance,
    currentCommunicationPoint: fmi3Float64,
    communicationStepSize: fmi3Float64,
    _noSetFMUStatePriorToCurrentPoint: fmi3Boolean,
    eventHandlingNeeded: *mut fmi3Boolean,
    terminateSimulation: *mut fmi3Boolean,
    earlyReturn: *mut fmi3Boolean,
    lastSuccessfulTime: *mut fmi3Float64,
) -> fmi3Status {
    let results = Results {
        event_handling_needed: eventHandlingNeeded,
        terminate_simulation: terminateSimulation,
        early_return: earlyReturn,
        last_successful_time: lastSuccessfulTime,
    };
    let (point, step) = (currentCommunicationPoint, communicationStepSize);
    let mut progress = None;
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { results.check()? };
        let end = instance.experiment.end_of_step(point, step)?;
        if let Some(update) = instance.options.intermediate_update {
            let interval = Interval {
                begin: point,
                end,
                size: step,
            };
            progress = Some(Progress::begin(instance, update, interval)?);
            return Ok(());
        }
        let advanced = instance.advance(step)?;
        instance.experiment.time = if advanced < step {
            point + advanced
        } else {
            end
        };
        // SAFETY: passed on from the caller.
        unsafe { results.write(instance, end) };
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe {
        let status = call(instance, Function::fmi3DoStep, body);
        match progress {
            Some(progress) => step_with_updates(instance, progress, results),
            None => status,
        }
    }
}

/// # Safety
/// As in the standard: `valueReferences` and `orders` have `nValueReferences` elements, `values`
/// has `nValues`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    instance: fmi3Instance,
    valueReferences: *const fmi3ValueReference,
    nValueReferences: usize,
    orders: *const fmi3Int32,
    values: *mut fmi3Float64,
    nValues: usize,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let mut rates = |instance: &mut Instance, vr: &[ValueReference]| {
            // SAFETY: passed on from the caller.
            unsafe {
                let orders = elements(orders, nValueReferences, "orders")?;
                instance.output_rates(vr, orders, room(values, nValues, "values")?)
            }
        };
        let (what, count) = ((Kind::Float64, Time::Refused), (nValues, "nValues"));
        let references = ((valueReferences, nValueReferences), "valueReferences");
        // SAFETY: passed on from the caller.
        unsafe { instance.with_elements(what, references, count, &mut rates) }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3GetOutputDerivatives, body) }
}
