//! The memory behind the C interface of FMI 3.0, as `memory_rules.rs` checks it for FMI 2.0:
//! arrays, states, derivatives, and an importer's function that calls back in the middle of a step.
//! Short enough for Miri: `cargo +nightly miri test --test memory_rules_fmi3`.

use helicopter_rotor::{
    block::variables::{
        ARRAYS, BLOCK_OF_REFERENCES, INSTANTIATION_TOKEN, STATES, TIME_REFERENCE, integer, real,
        string,
    },
    fmi3::{
        co_simulation::*, creation::*, dependencies::*, derivatives::*, events::*, fmu_state::*,
        get_set::*, life_cycle::*, model_exchange::*, not_offered::*, types::*,
    },
};
use std::{
    cell::Cell,
    ffi::{CString, c_void},
    mem::MaybeUninit,
    ptr,
};

const OK: fmi3Status = fmi3Status::Ok;
const ERROR: fmi3Status = fmi3Status::Error;

/// The value reference of an integer or a string.
fn in_block(block: u32, number: u32) -> u32 {
    block * BLOCK_OF_REFERENCES + number
}

const COLLECTIVE: u32 = real::COLLECTIVE.number();
const THRUST: u32 = real::THRUST.number();
const VELOCITY: u32 = real::VELOCITY_1.number();

/// What an importer keeps: the instance, and how often its function was called.
#[derive(Default)]
struct Environment {
    instance: Cell<fmi3Instance>,
    calls: Cell<u32>,
    errors: Cell<u32>,
}

/// Sets and reads variables, and tries what is not allowed.
unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    set: u8,
    get: u8,
    _finished: u8,
    can_return: u8,
    requested: *mut u8,
    return_time: *mut f64,
) {
    // SAFETY: the address of a living environment, whose instance makes a step.
    unsafe {
        let environment = &*environment.cast::<Environment>();
        environment.calls.set(environment.calls.get() + 1);
        let c = environment.instance.get();
        let (pitch, mut thrust) = (0.1 + time, MaybeUninit::<f64>::uninit());
        let was_set = fmi3SetFloat64(c, &COLLECTIVE, 1, &pitch, 1);
        let was_read = fmi3GetFloat64(c, &THRUST, 1, thrust.as_mut_ptr(), 1);
        assert_eq!((was_set == OK, was_read == OK), (set == 1, get == 1));
        assert_eq!(fmi3Reset(c), ERROR);
        fmi3FreeInstance(c);
        if can_return == 1 {
            *requested = 1;
            *return_time = time;
        }
    }
}

/// Frees the instance when it hears of an error.
unsafe extern "C" fn free_after_error(
    environment: *mut c_void,
    status: fmi3Status,
    _category: fmi3String,
    _message: fmi3String,
) {
    // SAFETY: the address of a living environment, whose instance is not used after an error.
    unsafe {
        let environment = &*environment.cast::<Environment>();
        if status == ERROR {
            environment.errors.set(environment.errors.get() + 1);
            fmi3FreeInstance(environment.instance.get());
        }
    }
}

/// Sets a velocity with which no result would be finite.
unsafe extern "C" fn fly_too_fast(
    environment: *mut c_void,
    _time: f64,
    set: u8,
    _get: u8,
    _finished: u8,
    _can_return: u8,
    _requested: *mut u8,
    _return_time: *mut f64,
) {
    // SAFETY: the address of a living environment, whose instance makes a step.
    unsafe {
        let environment = &*environment.cast::<Environment>();
        let velocity = [1e200, 0.0, 0.0];
        let c = environment.instance.get();
        let was_set = fmi3SetFloat64(c, &VELOCITY, 1, velocity.as_ptr(), 3);
        assert_eq!(was_set == OK, set == 1);
    }
}

/// A small rotor before its initialisation.
fn instance(environment: Option<&Environment>, is_model_exchange: bool) -> fmi3Instance {
    let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources/");
    let [token, resources] =
        [INSTANTIATION_TOKEN, resources].map(|text| CString::new(text).unwrap());
    let (name, token, resources) = (c"rotor".as_ptr(), token.as_ptr(), resources.as_ptr());
    let required = [COLLECTIVE, THRUST];
    // SAFETY: the pointers are null or live during the calls.
    unsafe {
        let c = if is_model_exchange {
            fmi3InstantiateModelExchange(name, token, resources, 0, 1, ptr::null_mut(), None)
        } else {
            let (count, callback): (usize, Option<fmi3IntermediateUpdateCallback>) =
                match environment {
                    Some(_) => (2, Some(update)),
                    None => (0, None),
                };
            let place = environment.map_or(ptr::null(), ptr::from_ref).cast_mut();
            let (r, place) = (required.as_ptr(), place.cast());
            fmi3InstantiateCoSimulation(
                name, token, resources, 0, 1, 1, 1, r, count, place, None, callback,
            )
        };
        assert!(!c.is_null());
        if let Some(environment) = environment {
            environment.instance.set(c);
        }
        let references = [
            in_block(1, integer::NUMERICS__ELEMENTS.number()),
            in_block(1, integer::GEOMETRY__NUMBER_OF_BLADES.number()),
        ];
        assert_eq!(
            fmi3SetInt32(c, references.as_ptr(), 2, [1, 1].as_ptr(), 2),
            OK
        );
        let (file, text) = (
            in_block(3, string::AIRFOIL__FILE.number()),
            c"circle.polar".as_ptr(),
        );
        assert_eq!(fmi3SetString(c, &file, 1, &text, 1), OK);
        c
    }
}

fn initialize(c: fmi3Instance) {
    // SAFETY: the instance lives.
    unsafe {
        assert_eq!(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi3ExitInitializationMode(c), OK);
        let mut flags = [9_u8; 5];
        let [a, b, d, e, f] = flags.each_mut();
        assert_eq!(fmi3UpdateDiscreteStates(c, a, b, d, e, f, &mut 0.0), OK);
        assert_eq!(flags, [0; 5]);
    }
}

#[test]
fn the_importer_calls_back_in_the_middle_of_a_step() {
    let environment = Environment::default();
    let c = instance(Some(&environment), false);
    initialize(c);
    let (mut flag, mut time) = ([9_u8; 3], f64::NAN);
    let [event, end, early] = flag.each_mut();
    // SAFETY: the instance lives; the pointers are valid.
    unsafe {
        assert_eq!(fmi3EnterStepMode(c), OK);
        assert_eq!(
            fmi3DoStep(c, 0.0, 1e-3, 1, event, end, early, &mut time),
            OK
        );
        assert_eq!((environment.calls.get(), time), (2, 1e-3));
        let mut pitch = 0.0;
        assert_eq!(fmi3GetFloat64(c, &COLLECTIVE, 1, &mut pitch, 1), OK);
        assert_eq!(pitch, 0.1 + 1e-3);
        // One place for all flags.
        assert_eq!(
            fmi3DoStep(c, time, 1e-3, 1, event, event, event, &mut time),
            OK
        );
        fmi3FreeInstance(c);
    }
}

/// The instance has ended its step before the importer hears of the error, and is not touched
/// afterwards.
#[test]
fn the_importer_frees_an_instance_whose_step_has_failed() {
    let environment = Environment::default();
    let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources/");
    let [token, resources] =
        [INSTANTIATION_TOKEN, resources].map(|text| CString::new(text).unwrap());
    let (name, token, resources) = (c"rotor".as_ptr(), token.as_ptr(), resources.as_ptr());
    let place = ptr::from_ref(&environment).cast_mut().cast();
    let [elements, blades] = [
        integer::NUMERICS__ELEMENTS,
        integer::GEOMETRY__NUMBER_OF_BLADES,
    ]
    .map(|reference| in_block(1, reference.number()));
    let file = in_block(3, string::AIRFOIL__FILE.number());
    let (log, callback): (fmi3LogMessageCallback, fmi3IntermediateUpdateCallback) =
        (free_after_error, fly_too_fast);
    let (mut flags, mut time) = ([9_u8; 3], f64::NAN);
    let [event, end, early] = flags.each_mut();
    // SAFETY: the pointers live during the calls; the logger frees the instance.
    unsafe {
        let c = fmi3InstantiateCoSimulation(
            name,
            token,
            resources,
            0,
            1,
            0,
            0,
            &VELOCITY,
            1,
            place,
            Some(log),
            Some(callback),
        );
        environment.instance.set(c);
        let r = [elements, blades];
        assert_eq!(fmi3SetInt32(c, r.as_ptr(), 2, [1, 1].as_ptr(), 2), OK);
        assert_eq!(fmi3SetString(c, &file, 1, &c"circle.polar".as_ptr(), 1), OK);
        assert_eq!(fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0), OK);
        assert_eq!(fmi3ExitInitializationMode(c), OK);
        let status = fmi3DoStep(c, 0.0, 1e-3, 1, event, end, early, &mut time);
        assert_eq!((status, environment.errors.get()), (ERROR, 1));
    }
}

#[test]
fn arrays_dependencies_and_derivatives_go_through_memory_of_the_importer() {
    let c = instance(None, true);
    // SAFETY: the instance lives; results go into memory that nobody wrote.
    unsafe {
        assert_eq!(
            fmi3SetFloat64(c, &VELOCITY, 1, [1.0, 2.0, 3.0].as_ptr(), 3),
            OK
        );
        initialize(c);
        let mut values = [const { MaybeUninit::<f64>::uninit() }; 4];
        let references = [VELOCITY, TIME_REFERENCE];
        let out = values.as_mut_ptr().cast();
        assert_eq!(fmi3GetFloat64(c, references.as_ptr(), 2, out, 3), ERROR);
        assert_eq!(fmi3GetFloat64(c, references.as_ptr(), 2, out, 4), OK);
        assert_eq!(values.map(|v| v.assume_init()), [1.0, 2.0, 3.0, 0.0]);

        // Seed and sensitivity may be the same memory.
        let mut x = [1.0, 0.0, 0.0];
        let place = x.as_mut_ptr();
        let derivative = fmi3GetDirectionalDerivative;
        let status = derivative(c, &VELOCITY, 0, &VELOCITY, 1, place, 3, place, 0);
        assert_eq!(status, OK);
        let status = derivative(c, &THRUST, 1, &VELOCITY, 1, place, 3, place, 1);
        assert_eq!(status, OK);
        assert_eq!(
            fmi3GetAdjointDerivative(c, &THRUST, 1, &VELOCITY, 1, [1.0].as_ptr(), 1, place, 3),
            OK
        );

        let mut n = 0;
        assert_eq!(fmi3GetNumberOfVariableDependencies(c, THRUST, &mut n), OK);
        let mut elements = vec![MaybeUninit::<usize>::uninit(); 2 * n];
        let mut knowns = vec![MaybeUninit::<u32>::uninit(); n];
        let mut kinds = vec![MaybeUninit::<i32>::uninit(); n];
        let (first, second) = elements.split_at_mut(n);
        let status = fmi3GetVariableDependencies(
            c,
            THRUST,
            first.as_mut_ptr().cast(),
            knowns.as_mut_ptr().cast(),
            second.as_mut_ptr().cast(),
            kinds.as_mut_ptr().cast(),
            n,
        );
        assert_eq!(status, OK);
        assert!(knowns.iter().any(|known| known.assume_init() == VELOCITY));

        // One place for all answers, of which the last stays.
        let place = first.as_mut_ptr();
        let status = fmi3GetVariableDependencies(
            c,
            THRUST,
            place.cast(),
            place.cast(),
            place.cast(),
            place.cast(),
            n,
        );
        assert_eq!(status, OK);
        assert_eq!(place.cast::<i32>().read(), FMI3_DEPENDENT);

        // Values over their own value references.
        let mut place = [0.0; 3];
        let out = place.as_mut_ptr();
        out.cast::<u32>().write(VELOCITY);
        assert_eq!(fmi3GetFloat64(c, out.cast(), 1, out, 3), OK);
        assert_eq!(place, [1.0, 2.0, 3.0]);

        let mut states = [const { MaybeUninit::<f64>::uninit() }; STATES.len()];
        let out = states.as_mut_ptr().cast();
        assert_eq!(fmi3GetContinuousStates(c, out, STATES.len()), OK);
        assert_eq!(fmi3GetFloat32(c, &THRUST, 1, ptr::dangling_mut(), 1), ERROR);
        fmi3FreeInstance(c);
    }
    assert!(ARRAYS.len() > 10);
}

#[test]
fn states_are_copied_serialized_and_freed() {
    let (c, other) = (instance(None, false), instance(None, false));
    initialize(c);
    let (mut state, mut read, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
    // SAFETY: the instances live; the pointers are valid for their counts.
    unsafe {
        assert_eq!(fmi3GetFMUState(c, &mut state), OK);
        assert_eq!(fmi3SerializedFMUStateSize(c, state, &mut size), OK);
        let mut bytes = vec![MaybeUninit::<u8>::uninit(); size];
        let room = bytes.as_mut_ptr().cast();
        assert_eq!(fmi3SerializeFMUState(c, state, room, size - 1), ERROR);
        assert_eq!(fmi3SerializeFMUState(c, state, room, size), OK);
        assert_eq!(fmi3DeserializeFMUState(other, room, size, &mut read), OK);
        assert_eq!(fmi3SetFMUState(other, read), OK);
        assert_eq!(fmi3EnterStepMode(other), OK);
        assert_eq!(fmi3SetFMUState(other, c), ERROR);
        assert_eq!(fmi3FreeFMUState(other, &mut read), OK);
        assert_eq!(fmi3FreeFMUState(c, &mut state), OK);
        fmi3FreeInstance(other);
        fmi3FreeInstance(c);
        fmi3FreeInstance(ptr::null_mut());
    }
}
