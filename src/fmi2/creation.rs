//! Making and freeing instances: fmi2Functions.h, "Creation and destruction of FMU instances".

#![allow(non_snake_case)]

use super::{legality::interface, logger::wanted, types::*};
use crate::fmi::{
    creation::{self, Request},
    instance::{Message, Options},
    legality::Function,
    logger::Callback,
};
use std::ptr;

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
    // SAFETY: passed on from the caller. It is copied, whatever its alignment.
    let callbacks = (!functions.is_null()).then(|| unsafe { functions.read_unaligned() });
    let request = Request {
        function: Function::fmi2Instantiate,
        instance_name: instanceName,
        token: fmuGUID,
        token_name: "fmuGUID",
        resources: fmuResourceLocation,
        callback: callbacks.and_then(|f| f.logger).map(Callback::Two),
        environment: callbacks.map_or(ptr::null_mut(), |f| f.componentEnvironment),
        wanted: wanted(loggingOn != FMI2_FALSE, None),
        choose: &|| match interface(fmuType) {
            Some(interface) => Ok((interface, Options::default())),
            None => Err(Message::Error(format!(
                "fmuType = {fmuType} is unknown; pass fmi2ModelExchange (0) or fmi2CoSimulation (1)"
            ))),
        },
    };
    // SAFETY: passed on from the caller.
    unsafe { creation::create(request) }
}

/// # Safety
/// As in the standard: `c` is null or comes from fmi2Instantiate and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeInstance(c: fmi2Component) {
    // SAFETY: passed on from the caller.
    unsafe { creation::free(c, Function::fmi2FreeInstance) }
}
