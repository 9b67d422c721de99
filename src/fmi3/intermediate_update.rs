//! A step during which the importer sets inputs and reads outputs: fmi3FunctionTypes.h,
//! "CallbackIntermediateUpdate".
//!
//! Such a step goes in parts, each about as long as a step of the integration. Before each part the
//! importer is asked for the inputs at its end, to which they move linearly; after it, outputs may
//! be read. FMI 3.0 has no derivatives of inputs: an importer that has them, or knows more of its
//! inputs, sets what they are at the times at which it is asked.
//!
//! While the importer's function runs, no reference to the instance lives, as it calls functions on
//! it.

use super::{co_simulation::Results, types::*};
use crate::{
    block::{Inputs, Moment},
    fmi::{
        instance::{Instance, Outcome, call},
        legality::{Function, INTERMEDIATE_GET, INTERMEDIATE_SET, NEVER, STEP_MODE, Version},
    },
};

/// fmi3DoStep between the calls of the importer's function.
const PART: &Function = &Function {
    name: "fmi3DoStep",
    version: Version::Three,
    co_simulation: STEP_MODE | INTERMEDIATE_SET | INTERMEDIATE_GET,
    model_exchange: NEVER,
};

/// How far a step has come.
struct Progress {
    /// Block and time before it, to which an error returns.
    begin: (Moment, f64),
    /// The inputs at the present time.
    inputs: Inputs,
    /// The end at which the importer wants it, or an earlier one.
    end: f64,
    /// The end of the next part, and how long that takes.
    next: f64,
    duration: f64,
    /// Work of the parts that are done.
    work: u64,
}

impl Progress {
    fn begin(instance: &mut Instance, interval: &Interval) -> Self {
        let time = std::mem::replace(&mut instance.experiment.time, interval.begin);
        Self {
            begin: (instance.block.moment(), time),
            inputs: instance.block.inputs(),
            end: interval.end,
            next: interval.begin,
            duration: 0.0,
            work: 0,
        }
    }

    /// Finds the end of the next part.
    fn plan(&mut self, instance: &mut Instance, interval: &Interval) -> Outcome {
        let now = instance.experiment.time;
        let remaining = self.end - now;
        // Without variables to set or to read, the parts have no use.
        let parts = match instance.importer.required.as_slice() {
            [] => 1.0,
            _ => instance.block.parts_of_step(remaining)?,
        };
        let next = now + remaining / parts;
        self.next = if parts > 1.0 && next > now {
            next
        } else {
            self.end
        };
        let is_whole = now == interval.begin && self.next == interval.end;
        // The size of the step, without the rounding errors of its end.
        self.duration = if is_whole {
            interval.size
        } else {
            self.next - now
        };
        instance.state = INTERMEDIATE_SET;
        Ok(())
    }

    /// Advances to the end of the part, with the inputs that were set for it.
    fn advance(&mut self, instance: &mut Instance) -> Outcome {
        let (importer, block) = (&instance.importer, &mut instance.block);
        let stops_at_event = importer.has_event_mode && importer.allows_early_return;
        let advanced = block.step_from(&self.inputs, self.duration, stops_at_event)?;
        self.work = block.add_work(self.work)?;
        instance.experiment.time = if advanced < self.duration {
            self.end = instance.experiment.time + advanced;
            self.end
        } else {
            self.next
        };
        self.inputs = block.inputs();
        instance.state = INTERMEDIATE_GET;
        Ok(())
    }

    fn abandon(&self, instance: &mut Instance) -> Outcome {
        instance.block.return_to(&self.begin.0);
        instance.experiment.time = self.begin.1;
        instance.state = STEP_MODE;
        Ok(())
    }
}

/// A step: from a communication point to another, which have been checked, and its size.
pub struct Interval {
    pub begin: f64,
    pub end: f64,
    pub size: f64,
}

/// Makes a step.
///
/// # Safety
/// As `call`; `update` is the importer's function, and `results` have been checked.
pub unsafe fn step_with_updates(
    instance: fmi3Instance,
    update: fmi3IntermediateUpdateCallback,
    interval: &Interval,
    results: Results,
) -> fmi3Status {
    let (mut progress, mut now, mut end) = (None, interval.begin, interval.end);
    let (mut environment, mut can_return) = (std::ptr::null_mut(), false);
    while now < end {
        let plan = |instance: &mut Instance| {
            environment = instance.logger.environment;
            can_return = instance.importer.allows_early_return;
            progress
                .get_or_insert_with(|| Progress::begin(instance, interval))
                .plan(instance, interval)
        };
        // SAFETY: passed on from the caller.
        let mut status = unsafe { call(instance, PART, plan) };
        let Some(progress) = &mut progress else {
            return status;
        };
        if status == fmi3Status::Ok {
            let (mut requested, mut time) = (FMI3_FALSE, progress.next);
            // SAFETY: the importer's function, with places for its answers. No part is done, from
            // which it could return early.
            unsafe {
                let (environment, next) = (environment, progress.next);
                update(environment, next, 1, 0, 0, 0, &mut requested, &mut time);
                status = call(instance, PART, |instance| progress.advance(instance));
            }
        }
        if status != fmi3Status::Ok {
            // SAFETY: passed on from the caller.
            unsafe { call(instance, PART, |instance| progress.abandon(instance)) };
            return status;
        }
        // SAFETY: as above.
        unsafe {
            let at = |instance: &mut Instance| {
                now = instance.experiment.time;
                Ok(())
            };
            call(instance, PART, at);
            let (mut requested, mut time) = (FMI3_FALSE, now);
            let flag = can_return.into();
            update(environment, now, 0, 1, 1, flag, &mut requested, &mut time);
            if can_return && requested != FMI3_FALSE {
                progress.end = if time > now {
                    progress.end.min(time)
                } else {
                    now
                };
            }
        }
        end = progress.end;
    }
    let finish = |instance: &mut Instance| {
        instance.state = STEP_MODE;
        // SAFETY: passed on from the caller.
        unsafe { results.write(instance, interval.end) };
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, PART, finish) }
}
