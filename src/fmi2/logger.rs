//! Which messages the importer wants: fmi2Functions.h, "Inquire version numbers of header files and
//! setting logging status".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    instance::{Instance, call},
    legality::Function,
    logger::{Category, Wanted, choose},
};

/// Errors and warnings are always wanted, unless fmi2SetDebugLogging chose other categories; events
/// only while logging is on.
pub fn wanted(logging_on: bool, chosen: Option<Wanted>) -> Wanted {
    let mut wanted = chosen.unwrap_or([true; _]);
    wanted[Category::Events as usize] &= logging_on;
    wanted
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
    let change = |present: &mut Wanted, named: Wanted| {
        *present = wanted(loggingOn != FMI2_FALSE, (nCategories > 0).then_some(named));
    };
    // SAFETY: passed on from the caller.
    let body =
        |instance: &mut Instance| unsafe { choose(instance, categories, nCategories, change) };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetDebugLogging, body) }
}
