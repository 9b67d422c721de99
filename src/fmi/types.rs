//! The C types that both versions have, under names without a version.

use core::ffi::{c_char, c_uint, c_void};

/// An instance: `fmi2Component` and `fmi3Instance`.
pub type Component = *mut c_void;
/// What the importer gets back in its callbacks.
pub type Environment = *mut c_void;
/// A complete state: `fmi2FMUstate` and `fmi3FMUState`.
pub type StatePointer = *mut c_void;
pub type ValueReference = c_uint;
pub type Text = *const c_char;

/// The importer's function during a step: `fmi3IntermediateUpdateCallback`.
pub type IntermediateUpdate = unsafe extern "C" fn(
    environment: Environment,
    time: f64,
    inputs_are_asked_for: u8,
    outputs_may_be_read: u8,
    is_part_finished: u8,
    can_return_early: u8,
    wants_early_return: *mut u8,
    time_of_return: *mut f64,
);

/// The status that a function returns, with the numbers of both versions. Three are never returned:
/// `Discard`, because no step may be repeated with a smaller size; `Fatal`, because no error
/// affects other instances; `fmi2Pending`, because no step runs asynchronously.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Status {
    Ok = 0,
    Warning = 1,
    Error = 3,
}
