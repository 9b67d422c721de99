//! States and derivatives for an importer that integrates.
//!
//! No equation contains time itself, and there are no event indicators: a change of the one
//! discrete output, `flowState`, asks for its event after a completed step.

use super::{
    arguments::{elements, fill, room, room_for_one},
    instance::{Instance, Outcome, call, refuse},
    legality::{CONTINUOUS_TIME_MODE, EVENT_MODE, Function},
    types::{Component, Status},
};
use crate::block::variables::STATES;

impl Instance {
    pub fn enter_event_mode(&mut self) -> Outcome {
        self.block.begin_event();
        self.state = EVENT_MODE;
        Ok(())
    }

    pub fn enter_continuous_time_mode(&mut self) -> Outcome {
        self.block.begin_integration()?;
        self.state = CONTINUOUS_TIME_MODE;
        Ok(())
    }

    pub fn set_time(&mut self, time: f64) -> Outcome {
        if !time.is_finite() {
            return refuse(format!("time = {time} is not finite; pass a finite time"));
        }
        self.experiment.time = time;
        Ok(())
    }
}

/// An error if the importer's vector does not have as many `what` as this FMU.
pub fn check_count(given: usize, count: usize, what: &str) -> Outcome {
    if given == count {
        return Ok(());
    }
    refuse(format!(
        "the vector has room for {given} {what}, but this FMU has {count}; pass that number"
    ))
}

/// Ends a step of the importer's solver: tells whether an event is due. The simulation never asks
/// for its end. `T` is a Boolean.
///
/// # Safety
/// As `call`; the two results may be written.
pub unsafe fn completed_step<T: From<bool>>(
    component: Component,
    function: &'static Function,
    enter_event_mode: *mut T,
    terminate_simulation: *mut T,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller. One reference ends before the next is made, because an
        // importer may pass the same place twice; the event then counts.
        unsafe {
            let event = || room_for_one(enter_event_mode, "enterEventMode");
            let end = || room_for_one(terminate_simulation, "terminateSimulation");
            event()?;
            end()?;
            let has_event = instance.block.has_event()?;
            end()?.write(false.into());
            event()?.write(has_event.into());
        }
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// Sets the continuous states.
///
/// # Safety
/// As `call`; `x` has `count` elements.
pub unsafe fn set_states(
    component: Component,
    function: &'static Function,
    x: *const f64,
    count: usize,
) -> Status {
    let body = |instance: &mut Instance| {
        check_count(count, STATES.len(), "continuous states")?;
        // SAFETY: passed on from the caller.
        let x = unsafe { elements(x, count, "x")? };
        Ok(instance.block.set_states(x)?)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// The numbers of which there is one for each continuous state.
#[derive(Clone, Copy)]
pub enum Vector {
    States,
    Derivatives,
    Nominals,
}

/// Returns one number for each continuous state.
///
/// # Safety
/// As `call`; `out` has `count` elements.
pub unsafe fn state_vector(
    component: Component,
    function: &'static Function,
    vector: Vector,
    out: *mut f64,
    count: usize,
) -> Status {
    let body = |instance: &mut Instance| {
        check_count(count, STATES.len(), "continuous states")?;
        // SAFETY: passed on from the caller.
        let out = unsafe { room(out, count, "the vector for the result")? };
        let numbers = match vector {
            Vector::States => instance.block.states()?,
            Vector::Derivatives => instance.block.derivatives()?,
            Vector::Nominals => STATES.map(|state| state.nominal),
        };
        fill(out, numbers);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}
