//! Making and freeing instances: fmi3Functions.h, "Creation and destruction of FMU instances".

#![allow(non_snake_case)]

use super::{types::*, variables::has_intermediate_values};
use crate::fmi::{
    arguments::elements,
    creation::{self, Request},
    instance::{Message, Options, no_memory},
    legality::{Function, Interface},
    logger::Callback,
};

type Chosen = Result<(Interface, Options), Message>;

/// The arguments that all three functions have.
fn request<'a>(
    function: &'static Function,
    (instance_name, token, resources): (fmi3String, fmi3String, fmi3String),
    logging_on: fmi3Boolean,
    environment: fmi3InstanceEnvironment,
    log: Option<fmi3LogMessageCallback>,
    choose: &'a dyn Fn() -> Chosen,
) -> Request<'a> {
    Request {
        function,
        instance_name,
        token,
        token_name: "instantiationToken",
        resources,
        callback: log.map(Callback::Three),
        environment,
        wanted: [logging_on != FMI3_FALSE; _],
        choose,
    }
}

/// # Safety
/// As in the standard: the strings are null or live during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateModelExchange(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    _visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: Option<fmi3LogMessageCallback>,
) -> fmi3Instance {
    let request = request(
        Function::fmi3InstantiateModelExchange,
        (instanceName, instantiationToken, resourcePath),
        loggingOn,
        instanceEnvironment,
        logMessage,
        &|| Ok((Interface::ModelExchange, Options::default())),
    );
    // SAFETY: passed on from the caller.
    unsafe { creation::create(request) }
}

/// # Safety
/// As in the standard: the strings are null or live during the call, and
/// `requiredIntermediateVariables` has `nRequiredIntermediateVariables` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateCoSimulation(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    _visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    eventModeUsed: fmi3Boolean,
    earlyReturnAllowed: fmi3Boolean,
    requiredIntermediateVariables: *const fmi3ValueReference,
    nRequiredIntermediateVariables: usize,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: Option<fmi3LogMessageCallback>,
    intermediateUpdate: Option<fmi3IntermediateUpdateCallback>,
) -> fmi3Instance {
    let choose = || {
        let (references, count) = (
            requiredIntermediateVariables,
            nRequiredIntermediateVariables,
        );
        // SAFETY: passed on from the caller.
        let required = unsafe { elements(references, count, "requiredIntermediateVariables")? };
        let options = Options {
            has_event_mode: eventModeUsed != FMI3_FALSE,
            allows_early_return: earlyReturnAllowed != FMI3_FALSE,
            intermediate_update: intermediateUpdate,
            required: check_required(required)?,
        };
        Ok((Interface::CoSimulation, options))
    };
    let request = request(
        Function::fmi3InstantiateCoSimulation,
        (instanceName, instantiationToken, resourcePath),
        loggingOn,
        instanceEnvironment,
        logMessage,
        &choose,
    );
    // SAFETY: passed on from the caller.
    unsafe { creation::create(request) }
}

/// The variables that the importer wants to access during intermediate updates; an error if one of
/// them cannot be accessed there.
fn check_required(references: &[fmi3ValueReference]) -> Result<Vec<fmi3ValueReference>, Message> {
    let mut required = Vec::new();
    required
        .try_reserve_exact(references.len())
        .map_err(no_memory)?;
    for reference in references {
        if !has_intermediate_values(*reference) {
            return Err(Message::Error(format!(
                "requiredIntermediateVariables names the value reference {reference}, but modelDescription.xml has no variable with it that says intermediateUpdate = true; leave it out"
            )));
        }
        required.push(*reference);
    }
    Ok(required)
}

/// Refused: this FMU has no clocks that could schedule it.
///
/// # Safety
/// As in the standard: the strings are null or live during the call.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3InstantiateScheduledExecution(
    instanceName: fmi3String,
    instantiationToken: fmi3String,
    resourcePath: fmi3String,
    _visible: fmi3Boolean,
    loggingOn: fmi3Boolean,
    instanceEnvironment: fmi3InstanceEnvironment,
    logMessage: Option<fmi3LogMessageCallback>,
    _clockUpdate: Option<fmi3ClockUpdateCallback>,
    _lockPreemption: Option<fmi3LockPreemptionCallback>,
    _unlockPreemption: Option<fmi3LockPreemptionCallback>,
) -> fmi3Instance {
    let choose = || {
        Err(Message::Error(
            "this FMU does not offer Scheduled Execution; use Co-Simulation or Model Exchange"
                .into(),
        ))
    };
    let request = request(
        Function::fmi3InstantiateScheduledExecution,
        (instanceName, instantiationToken, resourcePath),
        loggingOn,
        instanceEnvironment,
        logMessage,
        &choose,
    );
    // SAFETY: passed on from the caller.
    unsafe { creation::create(request) }
}

/// # Safety
/// As in the standard: `instance` is null or was made here, and is not used afterwards.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3FreeInstance(instance: fmi3Instance) {
    // SAFETY: passed on from the caller.
    unsafe { creation::free(instance, Function::fmi3FreeInstance) }
}
