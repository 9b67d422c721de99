//! Derivatives along a direction: fmi2Functions.h, "Getting partial derivatives".

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    arguments::{elements, fill, room},
    instance::{Instance, call},
    legality::Function,
};

/// # Safety
/// As in the standard: `vUnknown_ref` and `dvUnknown` have `nUnknown` elements, `vKnown_ref` and
/// `dvKnown` have `nKnown`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetDirectionalDerivative(
    c: fmi2Component,
    vUnknown_ref: *const fmi2ValueReference,
    nUnknown: usize,
    vKnown_ref: *const fmi2ValueReference,
    nKnown: usize,
    dvKnown: *const fmi2Real,
    dvUnknown: *mut fmi2Real,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        let room = || {
            // SAFETY: passed on from the caller. `along` does not exist yet or has been read, so
            // that they may be the same memory.
            unsafe { room(dvUnknown, nUnknown, "dvUnknown") }
        };
        room()?;
        // SAFETY: passed on from the caller.
        let (unknowns, knowns, along) = unsafe {
            (
                elements(vUnknown_ref, nUnknown, "vUnknown_ref")?,
                elements(vKnown_ref, nKnown, "vKnown_ref")?,
                elements(dvKnown, nKnown, "dvKnown")?,
            )
        };
        let changes = (instance.block).directional_derivative(unknowns, knowns, along)?;
        fill(room()?, changes);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetDirectionalDerivative, body) }
}
