//! Getting and setting the values of variables: fmi3Functions.h, "Getting and setting variable
//! values".

#![allow(non_snake_case)]

use super::{
    types::*,
    variables::{Access, Kind},
};
use crate::{
    block::{RotorBlock, variables::TIME_REFERENCE},
    fmi::{
        arguments::{elements, room},
        instance::{Instance, Message, Outcome, call, no_memory},
        legality::Function,
        types::ValueReference,
    },
};
use core::mem::MaybeUninit;

/// Reads variables of one kind.
///
/// # Safety
/// As in the standard: `references` and `values` have as many elements as their counts say.
unsafe fn get<T>(
    instance: fmi3Instance,
    function: &'static Function,
    kind: Kind,
    references: (*const fmi3ValueReference, usize),
    values: (*mut T, usize),
    write: fn(&mut Instance, &[ValueReference], &mut [MaybeUninit<T>]) -> Outcome,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (references, room) = unsafe {
            (
                elements(references.0, references.1, "valueReferences")?,
                room(values.0, values.1, "values")?,
            )
        };
        let count = (room.len(), "nValues");
        let mut read = |instance: &mut Instance, vr: &[ValueReference]| write(instance, vr, room);
        instance.with_elements(kind, Access::Get, references, count, &mut read)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, function, body) }
}

/// Sets variables of one kind.
///
/// # Safety
/// As in the standard: `references` and `values` have as many elements as their counts say.
unsafe fn set<T>(
    instance: fmi3Instance,
    function: &'static Function,
    kind: Kind,
    references: (*const fmi3ValueReference, usize),
    values: (*const T, usize),
    write: fn(&mut Instance, &[ValueReference], &[T]) -> Outcome,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (references, values) = unsafe {
            (
                elements(references.0, references.1, "valueReferences")?,
                elements(values.0, values.1, "values")?,
            )
        };
        let count = (values.len(), "nValues");
        let mut set = |instance: &mut Instance, vr: &[ValueReference]| write(instance, vr, values);
        instance.with_elements(kind, Access::Set, references, count, &mut set)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(instance, function, body) }
}

/// Defines the function that reads and the one that sets variables of a kind.
macro_rules! get_and_set {
    ($($get:ident, $set:ident, $kind:ident, $type:ty: $read:expr, $write:expr;)*) => {$(
        /// # Safety
        /// As in the standard: the arrays have as many elements as their counts say.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $get(
            instance: fmi3Instance,
            valueReferences: *const fmi3ValueReference,
            nValueReferences: usize,
            values: *mut $type,
            nValues: usize,
        ) -> fmi3Status {
            let references = (valueReferences, nValueReferences);
            let (function, values) = (Function::$get, (values, nValues));
            // SAFETY: passed on from the caller.
            unsafe { get(instance, function, Kind::$kind, references, values, $read) }
        }

        /// # Safety
        /// As in the standard: the arrays have as many elements as their counts say.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $set(
            instance: fmi3Instance,
            valueReferences: *const fmi3ValueReference,
            nValueReferences: usize,
            values: *const $type,
            nValues: usize,
        ) -> fmi3Status {
            let references = (valueReferences, nValueReferences);
            let (function, values) = (Function::$set, (values, nValues));
            // SAFETY: passed on from the caller.
            unsafe { set(instance, function, Kind::$kind, references, values, $write) }
        }
    )*};
}

get_and_set! {
    fmi3GetFloat64, fmi3SetFloat64, Float64, fmi3Float64: get_reals,
        |instance, vr, values| Ok(instance.block.set_reals(vr, values)?);
    fmi3GetInt32, fmi3SetInt32, Int32, fmi3Int32: get_integers,
        |instance, vr, values| Ok(instance.block.set_integers(vr, values)?);
    fmi3GetInt64, fmi3SetInt64, Int64, fmi3Int64: get_integers, set_enumerations;
    fmi3GetBoolean, fmi3SetBoolean, Boolean, fmi3Boolean: get_booleans, set_booleans;
    fmi3GetString, fmi3SetString, String, fmi3String: get_strings, set_strings;
}

type Room<'a, T> = &'a mut [MaybeUninit<T>];

fn get_reals(
    instance: &mut Instance,
    vr: &[ValueReference],
    room: Room<'_, fmi3Float64>,
) -> Outcome {
    instance.refresh_reals(vr)?;
    for (reference, slot) in vr.iter().zip(room) {
        slot.write(match *reference {
            TIME_REFERENCE => instance.experiment.time,
            reference => instance.block.values().real(reference)?,
        });
    }
    Ok(())
}

fn get_integers<T: From<i32>>(
    instance: &mut Instance,
    vr: &[ValueReference],
    room: Room<'_, T>,
) -> Outcome {
    instance.refresh_integers(vr)?;
    for (reference, slot) in vr.iter().zip(room) {
        slot.write(instance.block.values().integer(*reference)?.into());
    }
    Ok(())
}

fn get_booleans(
    instance: &mut Instance,
    vr: &[ValueReference],
    room: Room<'_, fmi3Boolean>,
) -> Outcome {
    for (reference, slot) in vr.iter().zip(room) {
        slot.write(instance.block.values().boolean(*reference)?.into());
    }
    Ok(())
}

fn get_strings(
    instance: &mut Instance,
    vr: &[ValueReference],
    room: Room<'_, fmi3String>,
) -> Outcome {
    for (reference, slot) in vr.iter().zip(room) {
        slot.write(instance.kept_string(*reference)?);
    }
    Ok(())
}

/// Called by fmi3SetString alone.
fn set_strings(instance: &mut Instance, vr: &[ValueReference], values: &[fmi3String]) -> Outcome {
    // SAFETY: by the contract of fmi3SetString the values are null or C strings.
    unsafe { instance.set_strings(vr, values) }
}

fn set_enumerations(
    instance: &mut Instance,
    vr: &[ValueReference],
    values: &[fmi3Int64],
) -> Outcome {
    with_integers(instance, values, |block, items| {
        Ok(block.set_integers(vr, items)?)
    })
}

fn set_booleans(instance: &mut Instance, vr: &[ValueReference], values: &[fmi3Boolean]) -> Outcome {
    with_integers(instance, values, |block, values| {
        Ok(block.set_booleans(vr, values)?)
    })
}

/// Sets values of another width than the block's.
fn with_integers<T: Copy + Into<i64>>(
    instance: &mut Instance,
    values: &[T],
    set: impl FnOnce(&mut RotorBlock, &[i32]) -> Outcome,
) -> Outcome {
    let mut integers = std::mem::take(&mut instance.integers);
    integers.clear();
    let narrow = |value: &T| {
        let value = (*value).into();
        let integer = value.try_into().map_err(|_| {
            Message::Error(format!(
                "{value} is not an item of an enumeration; see modelDescription.xml"
            ))
        })?;
        integers.try_reserve(1).map_err(no_memory)?;
        integers.push(integer);
        Ok(())
    };
    let outcome = values.iter().try_for_each(narrow);
    let outcome = outcome.and_then(|()| set(&mut instance.block, &integers));
    instance.integers = integers;
    outcome
}
