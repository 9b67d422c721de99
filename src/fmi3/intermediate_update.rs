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
        instance::{Instance, Message, Outcome, call},
        legality::{Function, INTERMEDIATE_GET, INTERMEDIATE_SET, NEVER, STEP_MODE, Version},
        types::{Environment, IntermediateUpdate},
    },
};

/// fmi3DoStep between the calls of the importer's function.
const PART: &Function = &Function {
    name: "fmi3DoStep",
    version: Version::Three,
    co_simulation: INTERMEDIATE_SET | INTERMEDIATE_GET,
    model_exchange: NEVER,
};

/// A step: from a communication point to another, which have been checked, and its size.
pub struct Interval {
    pub begin: f64,
    pub end: f64,
    pub size: f64,
}

/// How far a step has come.
pub struct Progress {
    update: IntermediateUpdate,
    environment: Environment,
    can_return: bool,
    interval: Interval,
    /// Block and time before it, to which an error returns.
    begin: (Moment, f64),
    /// The inputs at the present time.
    inputs: Inputs,
    /// Where the step will end: the communication point, or earlier at an event or at the
    /// importer's wish.
    end: f64,
    /// Into how many parts the step is divided, and how many have been begun.
    parts: f64,
    begun: f64,
    /// The end of the part, and how long that takes.
    next: f64,
    duration: f64,
    /// The present time, which the importer is told after the part.
    now: f64,
    /// Work of the parts that are done.
    work: u64,
}

/// Returns to the time before a step, unless it is forgotten. A panic drops it, too.
struct Return<'a> {
    instance: &'a mut Instance,
    begin: &'a (Moment, f64),
}

impl Drop for Return<'_> {
    fn drop(&mut self) {
        self.instance.block.return_to(&self.begin.0);
        self.instance.experiment.time = self.begin.1;
        self.instance.state = STEP_MODE;
    }
}

impl Progress {
    /// Begins a step, in which the importer's function is called.
    pub fn begin(
        instance: &mut Instance,
        update: IntermediateUpdate,
        interval: Interval,
    ) -> Result<Self, Message> {
        let begin = (instance.block.moment()?, instance.experiment.time);
        // Without variables to set or to read, the parts have no use.
        let parts = match instance.options.required.as_slice() {
            [] => 1.0,
            _ => instance.block.parts_of_step(interval.size)?,
        };
        instance.experiment.time = interval.begin;
        let mut progress = Self {
            update,
            environment: instance.logger.environment,
            can_return: instance.options.allows_early_return,
            begin,
            inputs: instance.block.inputs(),
            end: interval.end,
            parts,
            begun: 0.0,
            next: interval.begin,
            duration: 0.0,
            now: interval.begin,
            work: 0,
            interval,
        };
        progress.plan(instance);
        Ok(progress)
    }

    /// Finds the end of the next part.
    fn plan(&mut self, instance: &mut Instance) {
        let Interval { begin, end, size } = self.interval;
        self.begun += 1.0;
        let next = begin + size * (self.begun / self.parts);
        self.next = if self.begun < self.parts && next > self.now && next < self.end {
            next
        } else {
            self.end
        };
        let is_whole = self.now == begin && self.next == end;
        // The size of the step, without the rounding errors of its end.
        self.duration = if is_whole { size } else { self.next - self.now };
        instance.state = INTERMEDIATE_SET;
    }

    /// Advances to the end of the part, with the inputs that were set for it. After an error or a
    /// panic all is as before the step, and the importer hears of it in Step Mode.
    fn advance(&mut self, instance: &mut Instance) -> Outcome {
        let back = Return {
            instance,
            begin: &self.begin,
        };
        let Instance {
            options,
            block,
            experiment,
            state,
            ..
        } = &mut *back.instance;
        let stops_at_event = options.has_event_mode && options.allows_early_return;
        let advanced =
            block.step_from(&self.inputs, self.duration, stops_at_event, &mut self.work)?;
        if advanced < self.duration {
            self.end = self.now + advanced;
            self.next = self.end;
        }
        self.now = self.next;
        experiment.time = self.now;
        self.inputs = block.inputs();
        *state = INTERMEDIATE_GET;
        std::mem::forget(back);
        Ok(())
    }

    /// Ends the step early if the importer wants that, and begins the next part if there is one.
    fn go_on(&mut self, instance: &mut Instance, wanted: Option<f64>, results: Results) {
        if let Some(time) = wanted.filter(|_| self.can_return) {
            self.end = if time > self.now {
                self.end.min(time)
            } else {
                self.now
            };
        }
        if self.now < self.end {
            self.plan(instance);
            return;
        }
        instance.state = STEP_MODE;
        // SAFETY: by the contract of `step_with_updates`.
        unsafe { results.write(instance, self.interval.end) };
    }
}

/// Makes a step that has begun.
///
/// # Safety
/// As `call`; the importer's function is one, and `results` have been checked.
pub unsafe fn step_with_updates(
    instance: fmi3Instance,
    mut progress: Progress,
    results: Results,
) -> fmi3Status {
    let (update, environment) = (progress.update, progress.environment);
    loop {
        let (mut requested, mut time) = (FMI3_FALSE, progress.next);
        // SAFETY: the importer's function, with places for its answers. It cannot return early
        // here: the part has not been computed yet.
        let status = unsafe {
            let next = progress.next;
            update(environment, next, 1, 0, 0, 0, &mut requested, &mut time);
            call(instance, PART, |instance| progress.advance(instance))
        };
        if status != fmi3Status::Ok {
            return status;
        }
        let (mut requested, mut time) = (FMI3_FALSE, progress.now);
        let (now, can_return) = (progress.now, progress.can_return.into());
        // SAFETY: as above.
        unsafe {
            update(
                environment,
                now,
                0,
                1,
                1,
                can_return,
                &mut requested,
                &mut time,
            )
        };
        let wanted = (requested != FMI3_FALSE).then_some(time);
        let mut is_over = false;
        let go_on = |instance: &mut Instance| {
            progress.go_on(instance, wanted, results);
            is_over = instance.state == STEP_MODE;
            Ok(())
        };
        // SAFETY: as above.
        let status = unsafe { call(instance, PART, go_on) };
        if is_over || status != fmi3Status::Ok {
            return status;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{
        super::{creation::*, get_set::*, life_cycle::*},
        *,
    };
    use crate::block::variables::{
        BLOCK_OF_REFERENCES, INSTANTIATION_TOKEN, InflowModel, integer, real,
    };
    use std::{ffi::CString, ptr};

    unsafe extern "C" fn ignore(
        _: Environment,
        _: f64,
        _: u8,
        _: u8,
        _: u8,
        _: u8,
        _: *mut u8,
        _: *mut f64,
    ) {
    }

    #[test]
    fn after_a_panic_in_the_middle_of_a_step_the_instance_is_where_the_step_began() {
        let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");
        let texts = [INSTANTIATION_TOKEN, resources].map(|text| CString::new(text).unwrap());
        let [token, resources] = texts.each_ref().map(|text| text.as_ptr());
        let (name, none) = (c"rotor".as_ptr(), ptr::null_mut());
        let (thrust, inflow) = (
            real::THRUST.number(),
            BLOCK_OF_REFERENCES + integer::MODELS__INFLOW.number(),
        );
        let rest = BLOCK_OF_REFERENCES + integer::INITIALIZATION.number();
        // SAFETY: the pointers live during the calls, and so does the instance.
        unsafe {
            let update: Option<IntermediateUpdate> = Some(ignore);
            let c = fmi3InstantiateCoSimulation(
                name, token, resources, 0, 0, 0, 0, &thrust, 1, none, None, update,
            );
            let (r, model) = ([inflow, rest], InflowModel::PittPetersDynamic as i64);
            assert_eq!(
                fmi3SetInt64(c, r.as_ptr(), 2, [model, 2].as_ptr(), 2),
                fmi3Status::Ok
            );
            assert_eq!(
                fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0),
                fmi3Status::Ok
            );
            assert_eq!(fmi3ExitInitializationMode(c), fmi3Status::Ok);
            let seen = || {
                let mut values = [0.0; 2];
                let r = [thrust, real::AZIMUTH.number()];
                let status = fmi3GetFloat64(c, r.as_ptr(), 2, values.as_mut_ptr(), 2);
                assert_eq!(status, fmi3Status::Ok);
                values
            };
            let before = seen();
            let begin = |instance: &mut Instance| {
                let interval = Interval {
                    begin: 0.0,
                    end: 0.1,
                    size: 0.1,
                };
                let mut progress = Progress::begin(instance, ignore, interval)?;
                progress.advance(instance)?;
                assert!(instance.experiment.time > 0.0 && instance.state == INTERMEDIATE_GET);
                let back = Return {
                    instance,
                    begin: &progress.begin,
                };
                assert!(back.instance.options.required.is_empty(), "a panic");
                Ok(())
            };
            assert_eq!(call(c, Function::fmi3DoStep, begin), fmi3Status::Error);
            assert_eq!(seen(), before);
            let at_the_beginning = |instance: &mut Instance| {
                assert_eq!((instance.experiment.time, instance.state), (0.0, STEP_MODE));
                Ok(())
            };
            assert_eq!(
                call(c, Function::fmi3DoStep, at_the_beginning),
                fmi3Status::Ok
            );
            fmi3FreeInstance(c);
        }
    }
}
