//! One instance of the FMU, and the frame in which every function of the interface runs.

use super::{
    communication_time::Experiment,
    handle::{self, Marked},
    legality::{
        EVENT_MODE, Function, INITIALIZATION_MODE, INSTANTIATED, Interface, STEP_COMPLETE,
        STEP_MODE, States, Version,
    },
    logger::{Category, Logger},
    types::{Component, IntermediateUpdate, Status, ValueReference},
};
use crate::block::{
    BlockError, Note, PerVariable, RotorBlock,
    variables::{STRINGS, StringRef},
};
use crate::host::{float_environment::in_default_environment, memory::NO_MEMORY};
use std::{
    any::Any,
    ffi::CString,
    panic::{AssertUnwindSafe, catch_unwind},
};

pub struct Instance {
    pub version: Version,
    pub interface: Interface,
    pub state: States,
    pub block: RotorBlock,
    pub logger: Logger,
    /// The strings that were returned; valid until the next call.
    pub strings: PerVariable<StringRef, CString, { STRINGS.len() }>,
    pub experiment: Experiment,
    pub options: Options,
    /// Memory for the elements of variables of FMI 3.0, so that getting and setting allocates none.
    pub references: Vec<ValueReference>,
    /// Memory for Booleans and enumeration items, which the block takes as i32.
    pub integers: Vec<i32>,
}

/// The options of Co-Simulation in FMI 3.0, which an importer chooses for an instance.
#[derive(Default)]
pub struct Options {
    pub has_event_mode: bool,
    pub allows_early_return: bool,
    pub intermediate_update: Option<IntermediateUpdate>,
    /// The variables that it accesses during intermediate updates.
    pub required: Vec<ValueReference>,
}

impl Marked for Instance {
    const MARK: u64 = 0x726f_746f_7220_4f4b;
}

/// What the importer is told when a function ends.
pub enum Message {
    Error(String),
    Warning(String),
}

pub type Outcome = Result<(), Message>;

/// An error of the block, as a sentence.
impl<E: std::error::Error> From<E> for Message {
    fn from(error: E) -> Self {
        Self::Error(error.to_string())
    }
}

/// The error where there is not enough memory, whatever found that.
pub fn no_memory<E>(_: E) -> Message {
    Message::Error(NO_MEMORY.to_owned())
}

/// An error in the arguments of a call.
pub fn refuse(text: String) -> Outcome {
    Err(Message::Error(text))
}

impl Instance {
    /// In Initialization Mode, in Event Mode and in Model Exchange, outputs follow the inputs that
    /// were set; in steps of Co-Simulation they are those of the last one. Before the
    /// initialisation, FMI 3.0 reads what the variables are then.
    pub fn refresh(&mut self) -> Result<(), BlockError> {
        let is_current = match self.state {
            INSTANTIATED => false,
            INITIALIZATION_MODE | EVENT_MODE => true,
            _ => self.interface == Interface::ModelExchange,
        };
        if is_current {
            self.block.update()?;
        }
        Ok(())
    }

    /// The state after the initialisation.
    pub fn initialized(&self) -> States {
        match (self.interface, self.version) {
            (Interface::CoSimulation, Version::Two) => STEP_COMPLETE,
            (Interface::CoSimulation, Version::Three) if !self.options.has_event_mode => STEP_MODE,
            _ => EVENT_MODE,
        }
    }
}

/// Runs the body of a function on its instance. Refuses a call without an instance or in the wrong
/// state, catches panics, and logs the outcome. The body runs in the default floating-point
/// environment, the logger in the importer's.
///
/// A warning of the block is logged as a warning, but the call returns OK: many importers end the
/// simulation at any other answer.
///
/// # Safety
/// `component` is null or an instance that is not freed, and no other call on it runs.
pub unsafe fn call(
    component: Component,
    function: &'static Function,
    mut body: impl FnMut(&mut Instance) -> Outcome,
) -> Status {
    // SAFETY: passed on from the caller.
    unsafe { run(component, function, &mut body) }
}

/// As `call`. The frame is in the library once, and not once for each function.
///
/// # Safety
/// As `call`.
unsafe fn run(
    component: Component,
    function: &'static Function,
    body: &mut dyn FnMut(&mut Instance) -> Outcome,
) -> Status {
    // SAFETY: passed on from the caller.
    let Some(instance) = (unsafe { handle::living::<Instance>(component) }) else {
        // Without an instance there is no logger to tell.
        return Status::Error;
    };
    let instance = instance.as_ptr();
    let run = || {
        // SAFETY: by the contract above the only reference to a living instance. It
        // ends before the logger runs, which may call back into this library.
        let instance = unsafe { &mut *instance };
        function
            .check(instance.version, instance.interface, instance.state)
            .map_err(Message::Error)?;
        body(instance)
    };
    let outcome =
        catch_unwind(AssertUnwindSafe(|| in_default_environment(run))).unwrap_or_else(|panic| {
            // SAFETY: as above.
            unsafe { (*instance).block.forget_results() };
            Err(Message::Error(internal_error(&*panic)))
        });

    let (status, last) = match outcome {
        Ok(()) => (Status::Ok, None),
        Err(Message::Warning(text)) => (Status::Warning, Some((Category::Warning, text))),
        Err(Message::Error(text)) => (Status::Error, Some((Category::Error, text))),
    };
    // SAFETY: as above; the logger has not been called yet.
    let notes = unsafe { (*instance).block.take_notes() };
    if notes.is_empty() && last.is_none() {
        return status;
    }
    let last = last.map(|(category, text)| (category, prefixed(function, &text)));
    let notes = notes.into_iter().map(|note| match note {
        Note::Event(text) => (Category::Events, text),
        Note::Warning(text) => (Category::Warning, prefixed(function, &text)),
    });
    let lines: Vec<_> = notes.chain(last).collect();
    // SAFETY: as above. The copy of the logger is used, not the instance: what the importer's
    // function does with the instance, freeing it included, harms nothing here.
    let logger = unsafe { (*instance).logger.clone() };
    let log = || {
        for (category, text) in &lines {
            logger.log(*category, text);
        }
    };
    // A panic in the logger cannot be logged.
    let _ = catch_unwind(AssertUnwindSafe(log));
    status
}

fn prefixed(function: &Function, text: &str) -> String {
    if text.starts_with(function.name) {
        text.to_owned()
    } else {
        format!("{}: {text}", function.name)
    }
}

/// The sentence for a caught panic.
fn internal_error(panic: &(dyn Any + Send)) -> String {
    let text = panic
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no message");
    format!("internal error ({text}); the instance can still be used, but please report this")
}
