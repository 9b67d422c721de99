//! Getting and setting the values of variables: fmi3Functions.h, "Getting and setting variable
//! values".

#![allow(non_snake_case)]

use super::{
    types::*,
    variables::{Kind, References, Time},
};
use crate::{
    block::{RotorBlock, variables::INTEGERS},
    fmi::{
        arguments::{elements, room},
        get_set::Room,
        instance::{Instance, Message, Outcome, call, no_memory},
        legality::Function,
        types::ValueReference,
    },
};

/// Reads variables of one kind.
///
/// # Safety
/// As in the standard: `references` and `values` have as many elements as their counts say.
unsafe fn get<T>(
    instance: fmi3Instance,
    function: &'static Function,
    kind: Kind,
    references: References,
    values: (*mut T, usize),
    write: fn(&mut Instance, &[ValueReference], Room<'_, T>) -> Outcome,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let mut read = |instance: &mut Instance, vr: &[ValueReference]| {
            // SAFETY: passed on from the caller. The importer's value references have been read.
            write(instance, vr, unsafe { room(values.0, values.1, "values")? })
        };
        let (what, count) = ((kind, Time::Allowed), (values.1, "nValues"));
        // SAFETY: passed on from the caller.
        unsafe { instance.with_elements(what, (references, "valueReferences"), count, &mut read) }
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
    references: References,
    values: (*const T, usize),
    write: fn(&mut Instance, &[ValueReference], &[T]) -> Outcome,
) -> fmi3Status {
    let body = |instance: &mut Instance| {
        let mut set = |instance: &mut Instance, vr: &[ValueReference]| {
            // SAFETY: passed on from the caller.
            write(instance, vr, unsafe {
                elements(values.0, values.1, "values")?
            })
        };
        let (what, count) = ((kind, Time::Refused), (values.1, "nValues"));
        // SAFETY: passed on from the caller.
        unsafe { instance.with_elements(what, (references, "valueReferences"), count, &mut set) }
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
    fmi3GetFloat64, fmi3SetFloat64, Float64, fmi3Float64: Instance::get_reals,
        |instance, vr, values| Ok(instance.block.set_reals(vr, values)?);
    fmi3GetInt32, fmi3SetInt32, Int32, fmi3Int32: Instance::get_integers,
        |instance, vr, values| Ok(instance.block.set_integers(vr, values)?);
    fmi3GetInt64, fmi3SetInt64, Int64, fmi3Int64: Instance::get_integers, set_enumerations;
    fmi3GetBoolean, fmi3SetBoolean, Boolean, fmi3Boolean: Instance::get_booleans, set_booleans;
    fmi3GetString, fmi3SetString, String, fmi3String: Instance::get_strings, set_strings;
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
    with_integers(instance, vr, values, |block, items| {
        Ok(block.set_integers(vr, items)?)
    })
}

fn set_booleans(instance: &mut Instance, vr: &[ValueReference], values: &[fmi3Boolean]) -> Outcome {
    with_integers(instance, vr, values, |block, values| {
        Ok(block.set_booleans(vr, values)?)
    })
}

/// Sets values of another width than the block's.
fn with_integers<T: Copy + Into<i64>>(
    instance: &mut Instance,
    vr: &[ValueReference],
    values: &[T],
    set: impl FnOnce(&mut RotorBlock, &[i32]) -> Outcome,
) -> Outcome {
    let mut integers = std::mem::take(&mut instance.integers);
    integers.clear();
    let narrow = |(reference, value): (&ValueReference, &T)| {
        let value = (*value).into();
        let integer = value.try_into().map_err(|_| {
            let name = INTEGERS
                .get(*reference as usize)
                .map_or("a value", |v| v.name);
            Message::Error(format!(
                "{name} = {value} is not allowed; see its items in modelDescription.xml"
            ))
        })?;
        integers.try_reserve(1).map_err(no_memory)?;
        integers.push(integer);
        Ok(())
    };
    let outcome = vr.iter().zip(values).try_for_each(narrow);
    let outcome = outcome.and_then(|()| set(&mut instance.block, &integers));
    instance.integers = integers;
    outcome
}
