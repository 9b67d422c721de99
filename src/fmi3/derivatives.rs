//! Derivatives along a direction, and the adjoint ones: fmi3Functions.h, "Getting partial
//! derivatives".

#![allow(non_snake_case)]

use super::{
    types::*,
    variables::{Kind, References, Time},
};
use crate::fmi::{
    arguments::{elements, fill, room},
    instance::{Instance, Message, call, no_memory},
    legality::Function,
    types::ValueReference,
};

/// The arguments of both functions: unknowns, knowns, seed and sensitivity, each with its number of
/// elements.
#[derive(Clone, Copy)]
struct Arguments {
    unknowns: References,
    knowns: References,
    seed: (*const fmi3Float64, usize),
    sensitivity: (*mut fmi3Float64, usize),
}

/// # Safety
/// As in the standard: the arrays have as many elements as their counts say.
unsafe fn derivative(
    instance: fmi3Instance,
    function: &'static Function,
    arguments: Arguments,
    is_adjoint: bool,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let Arguments {
            unknowns,
            knowns,
            seed,
            sensitivity,
        } = arguments;
        let room = || {
            // SAFETY: passed on from the caller. The value references and the seed have been read
            // by then, so that they may be the same memory.
            unsafe { room(sensitivity.0, sensitivity.1, "sensitivity") }
        };
        room()?;
        let (of_seed, of_result) = ((seed.1, "nSeed"), (sensitivity.1, "nSensitivity"));
        let (rows, columns) = match is_adjoint {
            true => (of_seed, of_result),
            false => (of_result, of_seed),
        };
        let what = (Kind::Float64, Time::Refused);
        let (of_unknowns, of_knowns) = ((unknowns, "unknowns"), (knowns, "knowns"));
        let compute = |instance: &mut Instance, unknowns: &[_], knowns: &[_]| {
            // SAFETY: passed on from the caller.
            let seed = unsafe { elements(seed.0, seed.1, "seed")? };
            if is_adjoint {
                let sums = adjoint(instance, unknowns, knowns, seed)?;
                fill(room()?, sums);
            } else {
                let block = &mut instance.block;
                let changes = block.directional_derivative(unknowns, knowns, seed)?;
                fill(room()?, changes);
            }
            Ok(())
        };
        // SAFETY: passed on from the caller.
        unsafe {
            instance.with_elements(what, of_unknowns, rows, &mut |instance, unknowns| {
                instance.with_elements(what, of_knowns, columns, &mut |instance, knowns| {
                    compute(instance, unknowns, knowns)
                })
            })
        }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, function, body) }
}

/// For each known the sum of (d unknown/d known) times the seed of the unknown: the columns of the
/// Jacobian one after the other, each one derivative along a direction.
fn adjoint(
    instance: &mut Instance,
    unknowns: &[ValueReference],
    knowns: &[ValueReference],
    seed: &[f64],
) -> Result<Vec<f64>, Message> {
    let mut sums = Vec::new();
    sums.try_reserve_exact(knowns.len()).map_err(no_memory)?;
    for known in knowns {
        let block = &mut instance.block;
        let known = core::slice::from_ref(known);
        let column = block.directional_derivative(unknowns, known, &[1.0])?;
        sums.push(column.zip(seed).map(|(change, seed)| change * seed).sum());
    }
    Ok(sums)
}

/// # Safety
/// As in the standard: the arrays have as many elements as their counts say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: fmi3Instance,
    unknowns: *const fmi3ValueReference,
    nUnknowns: usize,
    knowns: *const fmi3ValueReference,
    nKnowns: usize,
    seed: *const fmi3Float64,
    nSeed: usize,
    sensitivity: *mut fmi3Float64,
    nSensitivity: usize,
) -> fmi3Status {
    let arguments = Arguments {
        unknowns: (unknowns, nUnknowns),
        knowns: (knowns, nKnowns),
        seed: (seed, nSeed),
        sensitivity: (sensitivity, nSensitivity),
    };
    let function = Function::fmi3GetDirectionalDerivative;
    // SAFETY: passed on from the caller.
    unsafe { derivative(instance, function, arguments, false) }
}

/// # Safety
/// As in the standard: the arrays have as many elements as their counts say.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    instance: fmi3Instance,
    unknowns: *const fmi3ValueReference,
    nUnknowns: usize,
    knowns: *const fmi3ValueReference,
    nKnowns: usize,
    seed: *const fmi3Float64,
    nSeed: usize,
    sensitivity: *mut fmi3Float64,
    nSensitivity: usize,
) -> fmi3Status {
    let arguments = Arguments {
        unknowns: (unknowns, nUnknowns),
        knowns: (knowns, nKnowns),
        seed: (seed, nSeed),
        sensitivity: (sensitivity, nSensitivity),
    };
    let function = Function::fmi3GetAdjointDerivative;
    // SAFETY: passed on from the caller.
    unsafe { derivative(instance, function, arguments, true) }
}
