//! The version of FMI, and which messages the importer wants: fmi3Functions.h, "Inquire version
//! numbers and setting logging status".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    instance::{Instance, call},
    legality::Function,
    logger::{Wanted, choose},
};

#[unsafe(no_mangle)]
pub extern "C" fn fmi3GetVersion() -> fmi3String {
    c"3.0".as_ptr()
}

/// Turns the named categories on or off, or all without names.
///
/// # Safety
/// As in the standard: `categories` has `nCategories` C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3SetDebugLogging(
    instance: fmi3Instance,
    loggingOn: fmi3Boolean,
    nCategories: usize,
    categories: *const fmi3String,
) -> fmi3Status {
    let change = |wanted: &mut Wanted, named: Wanted| {
        for (wanted, is_named) in wanted.iter_mut().zip(named) {
            if is_named || nCategories == 0 {
                *wanted = loggingOn != FMI3_FALSE;
            }
        }
    };
    // SAFETY: passed on from the caller.
    let body =
        |instance: &mut Instance| unsafe { choose(instance, categories, nCategories, change) };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, Function::fmi3SetDebugLogging, body) }
}
