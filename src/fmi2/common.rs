//! The functions that Co-Simulation and Model Exchange share: fmi2Functions.h, "Common Functions".

#![allow(non_snake_case)]

use super::{
    instance::{Experiment, Instance, Message, call, refuse},
    legality::{Function, INITIALIZATION_MODE, INSTANTIATED, Interface, TERMINATED},
    logger::{Category, Logger, printable},
    types::*,
};
use crate::block::{
    PerVariable, RotorBlock, path_from_uri,
    variables::{GUID, LOG_CATEGORIES, MODEL_IDENTIFIER},
};
use core::ffi::{CStr, c_char};
use std::{
    panic::{AssertUnwindSafe, catch_unwind},
    path::{Path, PathBuf},
    ptr, slice,
    sync::Once,
};

/// The elements behind a pointer; none where the importer says that there are none.
///
/// # Safety
/// `pointer` is null or points to `count` initialised elements that live as long as the slice.
pub unsafe fn elements<'a, T>(
    pointer: *const T,
    count: usize,
    what: &str,
) -> Result<&'a [T], Message> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer, but {count} are announced"
        )));
    }
    // SAFETY: by the contract above.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// As `elements`, for what the function writes.
///
/// # Safety
/// As `elements`, and nothing else refers to the elements.
pub unsafe fn elements_mut<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [T], Message> {
    if count == 0 {
        return Ok(&mut []);
    }
    if pointer.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer, but {count} are announced"
        )));
    }
    // SAFETY: by the contract above.
    Ok(unsafe { slice::from_raw_parts_mut(pointer, count) })
}

/// The text behind a C string.
///
/// # Safety
/// `text` is null or a C string that lives as long as the answer.
pub unsafe fn text<'a>(text: fmi2String, what: &str) -> Result<&'a str, Message> {
    if text.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer; pass a string"
        )));
    }
    // SAFETY: by the contract above.
    let bytes = unsafe { CStr::from_ptr(text) };
    bytes
        .to_str()
        .map_err(|_| Message::Error(format!("{what} is no valid UTF-8; pass UTF-8")))
}

// ------------------------------------------------------------------ version and logging

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate, `categories` with `nCategories` C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: fmi2Component,
    loggingOn: fmi2Boolean,
    nCategories: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        let mut chosen = [false; LOG_CATEGORIES.len()];
        let mut unknown = Vec::new();
        // SAFETY: passed on from the caller.
        for category in unsafe { elements(categories, nCategories, "categories")? } {
            // SAFETY: passed on from the caller.
            let name = unsafe { text(*category, "a category")? };
            match LOG_CATEGORIES.iter().position(|known| *known == name) {
                Some(place) => chosen[place] = true,
                None => unknown.push(name),
            }
        }
        instance.logger.logging_on = loggingOn != FMI2_FALSE;
        instance.logger.chosen = (nCategories > 0).then_some(chosen);
        if unknown.is_empty() {
            return Ok(());
        }
        Err(Message::Warning(format!(
            "there are no log categories {}; this FMU has {}",
            unknown.join(", "),
            LOG_CATEGORIES.join(", ")
        )))
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetDebugLogging, body) }
}

// ------------------------------------------------------------------ creation and destruction

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
    let body = || {
        // SAFETY: passed on from the caller.
        let callbacks = unsafe { functions.as_ref() };
        // SAFETY: passed on from the caller.
        let name = unsafe { text(instanceName, "instanceName") };
        let name = name.ok().filter(|n| !n.is_empty());
        let logger = Logger {
            callback: callbacks.and_then(|f| f.logger),
            environment: callbacks.map_or(ptr::null_mut(), |f| f.componentEnvironment),
            instance_name: printable(name.unwrap_or(MODEL_IDENTIFIER)),
            logging_on: loggingOn != FMI2_FALSE,
            chosen: None,
        };
        // SAFETY: passed on from the caller.
        let guid = unsafe { text(fmuGUID, "fmuGUID") };
        let interface = match identity(fmuType, guid) {
            Ok(interface) => interface,
            Err(sentence) => {
                let sentence = format!("fmi2Instantiate: {sentence}");
                logger.log(fmi2Status::fmi2Error, Category::Error, &sentence);
                return ptr::null_mut();
            }
        };
        // SAFETY: passed on from the caller.
        let location = unsafe { text(fmuResourceLocation, "fmuResourceLocation") }.ok();
        let instance = Instance {
            interface,
            state: INSTANTIATED,
            block: RotorBlock::new(resources(location)),
            logger,
            strings: PerVariable::new(Default::default()),
            experiment: Experiment::default(),
        };
        Box::into_raw(Box::new(instance)).cast()
    };
    catch_unwind(AssertUnwindSafe(body)).unwrap_or(ptr::null_mut())
}

/// The interface that is asked of this FMU and no other.
fn identity(kind: fmi2Enumeration, guid: Result<&str, Message>) -> Result<Interface, String> {
    let guid = guid.map_err(|message| match message {
        Message::Error(text) | Message::Warning(text) => text,
    })?;
    if guid.trim() != GUID {
        return Err(format!(
            "the GUID {guid:?} is not that of this binary, {GUID}; modelDescription.xml and binary must come from the same .fmu"
        ));
    }
    Interface::from_type(kind).ok_or_else(|| {
        format!("fmuType = {kind} is none; pass fmi2ModelExchange (0) or fmi2CoSimulation (1)")
    })
}

/// A folder that our resources have.
const AIRFOILS: &str = "airfoils";

/// The folder of the resources: the importer's URI (or plain path) if our files are in it, else the
/// one beside `binaries/<platform>/`, where this library lies.
fn resources(location: Option<&str>) -> PathBuf {
    let given = location.map(|text| path_from_uri(text).unwrap_or_else(|| PathBuf::from(text)));
    let ours = given.filter(|path| path.join(AIRFOILS).is_dir());
    // Made absolute, so that it stays the same folder when the importer changes its own.
    if let Some(folder) = ours.and_then(|path| path.canonicalize().ok()) {
        return folder;
    }
    let beside = library_file().and_then(|file| {
        let unpacked = file.parent()?.parent()?.parent()?;
        Some(unpacked.join("resources"))
    });
    beside.unwrap_or_else(|| PathBuf::from("resources"))
}

/// The file of this shared library.
#[cfg(unix)]
fn library_file() -> Option<PathBuf> {
    use std::os::unix::ffi::OsStrExt;
    let address = fmi2Instantiate as *const ();
    // SAFETY: `info` is a plain C structure for which zeros are valid; dladdr writes it.
    let name = unsafe {
        let mut info: libc::Dl_info = std::mem::zeroed();
        if libc::dladdr(address.cast(), &mut info) == 0 || info.dli_fname.is_null() {
            return None;
        }
        CStr::from_ptr(info.dli_fname)
    };
    Path::new(std::ffi::OsStr::from_bytes(name.to_bytes()))
        .canonicalize()
        .ok()
}

#[cfg(not(unix))]
fn library_file() -> Option<PathBuf> {
    None
}

/// Rust's standard panic hook prints; this library prints nothing and logs panics instead. The
/// hook is this shared library's own: the importer's is another one.
fn keep_panics_silent() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| std::panic::set_hook(Box::new(|_| {})));
}

/// # Safety
/// As in the standard: `c` is null or comes from fmi2Instantiate and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: fmi2Component) {
    if c.is_null() {
        return;
    }
    // Freeing is legal in every state that this FMU enters. Dropping cannot fail usefully.
    let _ = catch_unwind(AssertUnwindSafe(|| {
        // SAFETY: made by Box::into_raw in fmi2Instantiate.
        drop(unsafe { Box::from_raw(c.cast::<Instance>()) });
    }));
}

// ------------------------------------------------------------------ the course of a simulation

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
                "stopTime = {stop} s lies before startTime = {startTime} s; pass a later one or none"
            ));
        }
        instance.experiment = Experiment {
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
