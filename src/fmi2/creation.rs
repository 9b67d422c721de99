//! Making and freeing instances: fmi2Functions.h, "Creation and destruction of FMU instances".

#![allow(non_snake_case)]

use super::{
    arguments::text,
    communication_time::Experiment,
    handle,
    instance::{Instance, Message},
    legality::{INSTANTIATED, Interface},
    logger::{Category, Logger, printable},
    resource_location::resources,
    types::*,
};
use crate::block::{
    PerVariable, RotorBlock,
    packaged::Packaged,
    variables::{GUID, MODEL_IDENTIFIER},
};
use crate::host::{
    float_environment::in_default_environment,
    memory::{NO_MEMORY, Watch},
};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::Path,
    ptr,
    sync::Once,
};

/// # Safety
/// As in the standard: the strings and `functions` are null or live during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2Instantiate(
    instanceName: fmi2String,
    fmuType: fmi2Enumeration,
    fmuGUID: fmi2String,
    fmuResourceLocation: fmi2String,
    functions: *const fmi2CallbackFunctions,
    _visible: fmi2Boolean,
    loggingOn: fmi2Boolean,
) -> fmi2Component {
    keep_panics_silent();
    let watch = Watch::begin();
    let make = || {
        // SAFETY: passed on from the caller. It is copied, whatever its alignment.
        let callbacks = (!functions.is_null()).then(|| unsafe { functions.read_unaligned() });
        // SAFETY: passed on from the caller.
        let name = unsafe { text(instanceName, "instanceName") };
        let name = name.ok().filter(|n| !n.is_empty());
        let logger = Logger {
            callback: callbacks.and_then(|f| f.logger),
            environment: callbacks.map_or(ptr::null_mut(), |f| f.componentEnvironment),
            instance_name: printable(cut(name.unwrap_or(MODEL_IDENTIFIER))),
            logging_on: loggingOn != FMI2_FALSE,
            chosen: None,
        };
        // SAFETY: passed on from the caller.
        let location = unsafe { text(fmuResourceLocation, "fmuResourceLocation") };
        let location = location.ok().filter(|text| text.len() <= LONGEST_TEXT);
        let resources = resources(location);
        // SAFETY: passed on from the caller.
        let guid = unsafe { text(fmuGUID, "fmuGUID") };
        let interface = match identity(fmuType, guid, &resources) {
            Ok(interface) => interface,
            Err(sentence) => return Err((logger, sentence)),
        };
        let instance = Instance {
            interface,
            state: INSTANTIATED,
            block: RotorBlock::new(resources),
            logger,
            strings: PerVariable::new(Default::default()),
            experiment: Experiment::default(),
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
        let sentence = format!("fmi2Instantiate: {sentence}");
        logger.log(fmi2Status::fmi2Error, Category::Error, &sentence);
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

/// The interface that the importer asks for; an error if it asks for another FMU.
fn identity(
    kind: fmi2Enumeration,
    guid: Result<&str, Message>,
    resources: &Path,
) -> Result<Interface, String> {
    let guid = guid.map_err(|message| match message {
        Message::Error(text) | Message::Warning(text) => text,
    })?;
    // An .fmu that was made for one rotor has a GUID of its own, since its start values differ.
    let packaged = Packaged::read(resources);
    let of_this_library = packaged
        .as_ref()
        .filter(|packaged| packaged.library == GUID);
    let own = of_this_library.map_or(GUID, |packaged| &packaged.guid);
    if guid.trim() != own {
        let guid: String = guid.chars().take(80).collect();
        return Err(format!(
            "the GUID {guid:?} is not the binary's, {own}; modelDescription.xml and binary must come from the same .fmu"
        ));
    }
    Interface::from_type(kind).ok_or_else(|| {
        format!("fmuType = {kind} is unknown; pass fmi2ModelExchange (0) or fmi2CoSimulation (1)")
    })
}

/// # Safety
/// As in the standard: `c` is null or comes from fmi2Instantiate and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: fmi2Component) {
    // Freeing is legal in every state that this FMU enters. A panic cannot be reported: the logger
    // belongs to the instance.
    let _ = catch_unwind(|| {
        // SAFETY: passed on from the caller.
        unsafe { handle::free::<Instance>(c) };
    });
}

/// Rust's standard panic hook prints. This library logs panics instead and prints nothing. The hook
/// belongs to this shared library; an importer written in Rust keeps its own.
fn keep_panics_silent() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| std::panic::set_hook(Box::new(|_| {})));
}
