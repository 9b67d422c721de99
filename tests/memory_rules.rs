//! The memory behind the C interface: instances and states behind opaque pointers, arrays, strings,
//! and pointers that cannot be right. Short enough for Miri, which checks every access:
//! `cargo +nightly miri test --test memory_rules`. So it calls the functions directly, without
//! a logger, whose variadic function Miri cannot call.

use helicopter_rotor::{
    block::variables::{GUID, STATES, boolean, integer, real, string},
    fmi2::{
        co_simulation::{fmi2DoStep, fmi2GetRealStatus, fmi2GetStringStatus},
        creation::{fmi2FreeInstance, fmi2Instantiate},
        directional::fmi2GetDirectionalDerivative,
        fmu_state::*,
        get_set::*,
        life_cycle::*,
        logger::fmi2SetDebugLogging,
        model_exchange::*,
        types::*,
    },
};
use std::{
    ffi::{CStr, CString},
    mem::MaybeUninit,
    ptr,
};

const OK: fmi2Status = fmi2Status::Ok;
const ERROR: fmi2Status = fmi2Status::Error;

/// A small rotor before its initialisation.
fn instance(kind: fmi2Enumeration) -> fmi2Component {
    let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");
    let [guid, resources] = [GUID, resources].map(|text| CString::new(text).unwrap());
    let (guid, resources) = (guid.as_ptr(), resources.as_ptr());
    let name = c"rotor".as_ptr();
    // SAFETY: the pointers are null or live during the calls.
    unsafe {
        let c = fmi2Instantiate(name, kind, guid, resources, ptr::null(), 0, 0);
        assert!(!c.is_null());
        let references = [
            integer::NUMERICS__ELEMENTS.number(),
            integer::GEOMETRY__NUMBER_OF_BLADES.number(),
        ];
        assert_eq!(
            fmi2SetInteger(c, references.as_ptr(), 2, [1, 1].as_ptr()),
            OK
        );
        let file = c"circle.polar".as_ptr();
        let reference = string::AIRFOIL__FILE.number();
        assert_eq!(fmi2SetString(c, &reference, 1, &file), OK);
        c
    }
}

fn initialized(kind: fmi2Enumeration) -> fmi2Component {
    let c = instance(kind);
    // SAFETY: the instance lives.
    unsafe {
        assert_eq!(fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        assert_eq!(fmi2ExitInitializationMode(c), OK);
    }
    c
}

#[test]
fn values_go_in_and_out_through_memory_of_the_importer() {
    let c = instance(FMI2_CO_SIMULATION);
    let reals = [real::COLLECTIVE.number(), real::RPM.number()];
    // SAFETY: the pointers are valid for their counts; results go into memory that nobody wrote.
    unsafe {
        assert_eq!(fmi2SetReal(c, reals.as_ptr(), 2, [0.1, 500.0].as_ptr()), OK);
        let flaps = boolean::FLAPPING__ENABLED.number();
        assert_eq!(fmi2SetBoolean(c, &flaps, 1, &1), OK);
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        let mut values = [const { MaybeUninit::<f64>::uninit() }; 2];
        assert_eq!(
            fmi2GetReal(c, reals.as_ptr(), 2, values.as_mut_ptr().cast()),
            OK
        );
        assert_eq!(values.map(|value| value.assume_init()), [0.1, 500.0]);
        let mut value = MaybeUninit::<i32>::uninit();
        assert_eq!(fmi2GetBoolean(c, &flaps, 1, value.as_mut_ptr()), OK);
        assert_eq!(value.assume_init(), 1);
        let elements = integer::NUMERICS__ELEMENTS.number();
        assert_eq!(fmi2GetInteger(c, &elements, 1, value.as_mut_ptr()), OK);
        assert_eq!(value.assume_init(), 1);
        let files = [
            string::AIRFOIL__FILE.number(),
            string::GEOMETRY__FILE.number(),
        ];
        let mut texts = [ptr::null(); 2];
        assert_eq!(fmi2GetString(c, files.as_ptr(), 2, texts.as_mut_ptr()), OK);
        let texts = texts.map(|text| CStr::from_ptr(text).to_str().unwrap().to_owned());
        assert_eq!(texts, ["circle.polar", ""]);
        assert_eq!(fmi2SetDebugLogging(c, 1, 1, &c"logEvents".as_ptr()), OK);
        fmi2FreeInstance(c);
    }
}

#[test]
fn states_are_copied_serialized_and_freed() {
    let (c, other) = (
        initialized(FMI2_CO_SIMULATION),
        instance(FMI2_CO_SIMULATION),
    );
    let (mut state, mut read, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
    // SAFETY: the instances live; the pointers are valid for their counts.
    unsafe {
        assert_eq!(fmi2DoStep(c, 0.0, 1e-3, 1), OK);
        assert_eq!(fmi2GetFMUstate(c, &mut state), OK);
        // Into the same place.
        assert_eq!(fmi2GetFMUstate(c, &mut state), OK);
        assert_eq!(fmi2SerializedFMUstateSize(c, state, &mut size), OK);
        let mut bytes = vec![MaybeUninit::<u8>::uninit(); size];
        let room = bytes.as_mut_ptr().cast();
        assert_eq!(fmi2SerializeFMUstate(c, state, room, size - 1), ERROR);
        assert_eq!(fmi2SerializeFMUstate(c, state, room, size), OK);
        assert_eq!(fmi2DeSerializeFMUstate(other, room, size, &mut read), OK);
        assert_eq!(fmi2SetFMUstate(other, read), OK);
        assert_eq!(fmi2DoStep(other, 1e-3, 1e-3, 1), OK);
        let mut time = 0.0;
        assert_eq!(
            fmi2GetRealStatus(other, FMI2_LAST_SUCCESSFUL_TIME, &mut time),
            OK
        );
        assert_eq!(time, 2e-3);
        let mut text = ptr::null();
        assert_eq!(
            fmi2GetStringStatus(other, FMI2_PENDING_STATUS, &mut text),
            OK
        );
        assert_eq!(CStr::from_ptr(text), c"");
        // A state is no instance, and an instance no state.
        assert_eq!(fmi2SetFMUstate(other, c), ERROR);
        assert_eq!(fmi2Terminate(state), ERROR);
        assert_eq!(fmi2FreeFMUstate(other, &mut read), OK);
        assert_eq!(fmi2FreeFMUstate(other, &mut read), OK);
        fmi2FreeInstance(other);
        assert_eq!(fmi2FreeFMUstate(c, &mut state), OK);
        fmi2FreeInstance(c);
    }
}

#[test]
fn vectors_of_model_exchange_and_derivatives_stay_in_their_memory() {
    let c = initialized(FMI2_MODEL_EXCHANGE);
    let n = STATES.len();
    let mut x = vec![MaybeUninit::<f64>::uninit(); n];
    let x: *mut f64 = x.as_mut_ptr().cast();
    let (mut event, mut seed, mut derivative) = (9, 1.0, f64::NAN);
    let (thrust, rpm) = (real::THRUST.number(), real::RPM.number());
    // SAFETY: the instance lives; the pointers are valid for their counts.
    unsafe {
        assert_eq!(fmi2EnterContinuousTimeMode(c), OK);
        assert_eq!(fmi2GetContinuousStates(c, x, n), OK);
        assert_eq!(fmi2SetContinuousStates(c, x, n), OK);
        assert_eq!(fmi2SetContinuousStates(c, x, n - 1), ERROR);
        assert_eq!(fmi2GetDerivatives(c, x, n), OK);
        assert_eq!(fmi2GetNominalsOfContinuousStates(c, x, n), OK);
        assert_eq!(fmi2GetEventIndicators(c, ptr::null_mut(), 0), OK);
        // Both answers in one place, and a derivative in the place of its direction.
        let at = &raw mut event;
        assert_eq!(fmi2CompletedIntegratorStep(c, 1, at, at), OK);
        assert_eq!(event, 0);
        let direction = &raw mut seed;
        let get = fmi2GetDirectionalDerivative;
        assert_eq!(get(c, &thrust, 1, &rpm, 1, direction, &mut derivative), OK);
        assert_eq!(get(c, &thrust, 1, &rpm, 1, direction, direction), OK);
        assert_eq!(seed.to_bits(), derivative.to_bits());
        fmi2FreeInstance(c);
    }
}

#[test]
fn pointers_that_cannot_be_right_are_not_followed() {
    let c = instance(FMI2_CO_SIMULATION);
    let mut memory = [0.0_f64; 4];
    let start = memory.as_mut_ptr();
    let misaligned = start.wrapping_byte_add(1);
    let collective = real::COLLECTIVE.number();
    // SAFETY: the instance lives; what cannot be right must not be followed.
    unsafe {
        assert_eq!(fmi2EnterInitializationMode(c), OK);
        for wrong in [ptr::null_mut(), misaligned] {
            assert_eq!(fmi2GetReal(c, &collective, 1, wrong), ERROR);
            assert_eq!(fmi2SetReal(c, &collective, 1, wrong), ERROR);
            assert_eq!(fmi2GetReal(c, wrong.cast(), 1, start), ERROR);
        }
        assert_eq!(fmi2GetReal(c, &collective, usize::MAX / 4, start), ERROR);
        assert_eq!(fmi2SetString(c, &0, 1, &ptr::null()), ERROR);
        assert_eq!(fmi2GetFMUstate(c, misaligned.cast()), ERROR);
        for wrong in [ptr::null_mut(), misaligned.cast(), start.cast()] {
            assert_eq!(fmi2DoStep(wrong, 0.0, 0.1, 1), ERROR);
            assert_eq!(fmi2SetFMUstate(c, wrong), ERROR);
            fmi2FreeInstance(wrong);
        }
        fmi2FreeInstance(c);
    }
    assert_eq!(memory, [0.0; 4]);
}
