//! The functions for what this FMU does not have: variables of other types, structural parameters,
//! clocks, discrete states to be evaluated, and model partitions. Each checks its state and
//! refuses.

#![allow(non_snake_case)]

use super::types::*;
use crate::fmi::{
    instance::{Instance, call, refuse},
    legality::Function,
};

const NO_VARIABLES: &str = "this FMU has no variables of that type; see modelDescription.xml";
const NO_CLOCKS: &str = "this FMU has no clocks";
const NO_MODE: &str = "this FMU has no structural parameters; parameters are set before the initialization ends, and tunable ones also in Event Mode and between steps";

macro_rules! not_offered {
    ($($name:ident($($type:ty),*): $sentence:expr;)*) => {$(
        /// # Safety
        /// As in the standard: `instance` lives. The other arguments do not matter.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name(instance: fmi3Instance, $(_: $type),*) -> fmi3Status {
            // SAFETY: passed on from the caller.
            unsafe { refuse_call(instance, Function::$name, $sentence) }
        }
    )*};
}

/// # Safety
/// As `call`.
unsafe fn refuse_call(
    instance: fmi3Instance,
    function: &'static Function,
    sentence: &'static str,
) -> fmi3Status {
    let body = |_: &mut Instance| refuse(sentence.to_owned());
    // SAFETY: passed on from the caller.
    unsafe { call(instance, function, body) }
}

type References = *const fmi3ValueReference;
type Sizes = *const usize;

not_offered! {
    fmi3GetFloat32(References, usize, *mut f32, usize): NO_VARIABLES;
    fmi3GetInt8(References, usize, *mut i8, usize): NO_VARIABLES;
    fmi3GetUInt8(References, usize, *mut u8, usize): NO_VARIABLES;
    fmi3GetInt16(References, usize, *mut i16, usize): NO_VARIABLES;
    fmi3GetUInt16(References, usize, *mut u16, usize): NO_VARIABLES;
    fmi3GetUInt32(References, usize, *mut u32, usize): NO_VARIABLES;
    fmi3GetUInt64(References, usize, *mut u64, usize): NO_VARIABLES;
    fmi3GetBinary(References, usize, *mut usize, *mut fmi3Binary, usize): NO_VARIABLES;
    fmi3SetFloat32(References, usize, *const f32, usize): NO_VARIABLES;
    fmi3SetInt8(References, usize, *const i8, usize): NO_VARIABLES;
    fmi3SetUInt8(References, usize, *const u8, usize): NO_VARIABLES;
    fmi3SetInt16(References, usize, *const i16, usize): NO_VARIABLES;
    fmi3SetUInt16(References, usize, *const u16, usize): NO_VARIABLES;
    fmi3SetUInt32(References, usize, *const u32, usize): NO_VARIABLES;
    fmi3SetUInt64(References, usize, *const u64, usize): NO_VARIABLES;
    fmi3SetBinary(References, usize, Sizes, *const fmi3Binary, usize): NO_VARIABLES;
    fmi3GetClock(References, usize, *mut fmi3Clock): NO_CLOCKS;
    fmi3SetClock(References, usize, *const fmi3Clock): NO_CLOCKS;
    fmi3GetIntervalDecimal(References, usize, *mut f64, *mut fmi3IntervalQualifier): NO_CLOCKS;
    fmi3GetIntervalFraction(
        References, usize, *mut fmi3UInt64, *mut fmi3UInt64, *mut fmi3IntervalQualifier
    ): NO_CLOCKS;
    fmi3GetShiftDecimal(References, usize, *mut f64): NO_CLOCKS;
    fmi3GetShiftFraction(References, usize, *mut fmi3UInt64, *mut fmi3UInt64): NO_CLOCKS;
    fmi3SetIntervalDecimal(References, usize, *const f64): NO_CLOCKS;
    fmi3SetIntervalFraction(References, usize, *const fmi3UInt64, *const fmi3UInt64): NO_CLOCKS;
    fmi3SetShiftDecimal(References, usize, *const f64): NO_CLOCKS;
    fmi3SetShiftFraction(References, usize, *const fmi3UInt64, *const fmi3UInt64): NO_CLOCKS;
    fmi3EnterConfigurationMode(): NO_MODE;
    fmi3ExitConfigurationMode(): NO_MODE;
    fmi3EvaluateDiscreteStates(): "modelDescription.xml says providesEvaluateDiscreteStates = false";
    fmi3ActivateModelPartition(fmi3ValueReference, f64): NO_CLOCKS;
}
