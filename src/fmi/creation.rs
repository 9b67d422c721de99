//! Making and freeing instances.

use super::{
    arguments::text,
    communication_time::Experiment,
    handle,
    instance::{Instance, Message, Options, Outcome, call, refuse},
    legality::{Function, INSTANTIATED, Interface, Version},
    logger::{Callback, Category, Logger, Wanted, printable},
    resource_location::resources,
    types::{Component, Environment, Status, Text},
};
use crate::{
    block::{
        PerVariable, RotorBlock,
        packaged::Packaged,
        variables::{INTEGERS, MODEL_IDENTIFIER, REALS},
    },
    host::{
        float_environment::in_default_environment,
        memory::{NO_MEMORY, Watch},
    },
};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    ptr,
    sync::Once,
};

/// What an importer passes for a new instance.
pub struct Request<'a> {
    pub function: &'static Function,
    pub instance_name: Text,
    /// The GUID or token in the importer's modelDescription.xml, and what that is called.
    pub token: Text,
    pub token_name: &'a str,
    pub resources: Text,
    pub callback: Option<Callback>,
    pub environment: Environment,
    pub wanted: Wanted,
    /// Tells the interface that it asks for, or what is wrong with its request.
    pub choose: &'a dyn Fn() -> Result<(Interface, Options), Message>,
}

/// Makes an instance; null if that is refused, which is logged whatever messages are wanted.
///
/// # Safety
/// The texts are null or C strings that live during the call.
pub unsafe fn create(request: Request) -> Component {
    keep_panics_silent();
    let watch = Watch::begin();
    let make = || {
        // SAFETY: passed on from the caller.
        let name = unsafe { text(request.instance_name, "instanceName") };
        let name = name.ok().filter(|n| !n.is_empty());
        let logger = Logger {
            callback: request.callback,
            environment: request.environment,
            instance_name: printable(cut(name.unwrap_or(MODEL_IDENTIFIER))),
            wanted: request.wanted,
        };
        // SAFETY: passed on from the caller.
        let location = unsafe { text(request.resources, "the location of the resources") };
        let location = location.ok().filter(|text| text.len() <= LONGEST_TEXT);
        let resources = resources(location);
        // SAFETY: passed on from the caller.
        let token = unsafe { text(request.token, request.token_name) };
        let version = request.function.version;
        let checked = check_token(token, version, &resources).and_then(|()| (request.choose)());
        let (interface, options) = match checked {
            Ok(chosen) => chosen,
            Err(Message::Error(text) | Message::Warning(text)) => return Err((logger, text)),
        };
        // What only the functions of FMI 3.0 use.
        let (references, integers) = match version {
            Version::Two => (0, 0),
            Version::Three => (REALS.len(), INTEGERS.len()),
        };
        let instance = Instance {
            version,
            interface,
            state: INSTANTIATED,
            block: RotorBlock::new(resources),
            logger,
            strings: PerVariable::new(Default::default()),
            experiment: Experiment::default(),
            options,
            references: Vec::with_capacity(references),
            integers: Vec::with_capacity(integers),
        };
        Ok(instance)
    };
    let create = || {
        let (logger, sentence) = match in_default_environment(make) {
            Ok(instance) => {
                let logger = instance.logger.clone();
                let component = handle::create(instance);
                if !watch.is_short() {
                    return component;
                }
                // SAFETY: it was made here, and nobody else knows it.
                unsafe { handle::free::<Instance>(component) };
                (logger, NO_MEMORY.to_owned())
            }
            Err(refusal) => refusal,
        };
        let name = request.function.name;
        logger.send(Category::Error, &format!("{name}: {sentence}"));
        ptr::null_mut()
    };
    catch_unwind(AssertUnwindSafe(create)).unwrap_or(ptr::null_mut())
}

/// Bytes of the longest name of an instance and of the longest resource location.
const LONGEST_TEXT: usize = 1 << 16;

/// At most the first `LONGEST_TEXT` bytes of a name.
fn cut(name: &str) -> &str {
    let ends = (0..=LONGEST_TEXT.min(name.len())).rev();
    ends.filter_map(|end| name.get(..end)).next().unwrap_or("")
}

/// An error if the importer asks for another FMU.
fn check_token(given: Result<&str, Message>, version: Version, resources: &Path) -> Outcome {
    let given = given?;
    // An .fmu that was made for one rotor has a GUID of its own, since its start values differ.
    let packaged = Packaged::read(resources);
    let of_this_library = packaged
        .as_ref()
        .filter(|packaged| packaged.library == version.token());
    let ours = of_this_library.map_or(version.token(), |packaged| &packaged.guid);
    if given.trim() != ours {
        let given: String = given.chars().take(80).collect();
        return refuse(format!(
            "the {} {given:?} is not the binary's, {ours}; modelDescription.xml and binary must come from the same .fmu",
            version.token_name()
        ));
    }
    Ok(())
}

/// Frees an instance, unless it is one of the other version or makes a step, to which it returns.
///
/// # Safety
/// As `call`; an instance that is freed is not used afterwards.
pub unsafe fn free(component: Component, function: &'static Function) {
    // SAFETY: passed on from the caller.
    if unsafe { call(component, function, |_| Ok(())) } != Status::Ok {
        return;
    }
    // A panic cannot be reported: the logger belongs to the instance.
    let _ = catch_unwind(|| {
        // SAFETY: passed on from the caller.
        unsafe { handle::free::<Instance>(component) };
    });
}

/// Rust's standard panic hook prints. This library logs panics instead and prints nothing. The hook
/// belongs to this shared library; an importer written in Rust keeps its own.
fn keep_panics_silent() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| std::panic::set_hook(Box::new(|_| {})));
}
