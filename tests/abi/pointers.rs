//! Pointers that cannot be right: misaligned, of more elements than memory can have, or to
//! something else than an instance. The tests run with debug assertions, which end the process
//! where a reference is made of such a pointer.

use crate::support::{
    Instance,
    c::{self, Component, Functions, Status},
    instance::{bits, reference},
};
use helicopter_rotor::block::variables::{REALS, STATES};
use std::{ffi::c_void, ptr};

/// Memory that is aligned for everything that is passed, and large enough for a vector of states.
#[repr(align(16))]
struct Memory([u8; 8 * STATES.len() + 16]);

impl Memory {
    fn new() -> Self {
        Self([0x55; _])
    }

    fn at(&mut self, offset: usize) -> *mut c_void {
        (&raw mut self.0[offset]).cast()
    }

    #[track_caller]
    fn is_untouched(&self) {
        assert!(self.0.iter().all(|byte| *byte == 0x55));
    }
}

/// Calls every function of Co-Simulation that takes an array, with `count` elements of it at `at`.
fn arrays(f: &Functions, c: Component, at: *mut c_void, count: usize) -> Vec<(&str, Status)> {
    let (vr, real, integer, text) = (at.cast(), at.cast(), at.cast(), at.cast());
    let first = &0;
    // SAFETY: the instance lives; the functions must not touch what cannot be right.
    unsafe {
        vec![
            ("fmi2GetReal", (f.fmi2GetReal)(c, vr, count, real)),
            ("fmi2GetInteger", (f.fmi2GetInteger)(c, vr, count, integer)),
            ("fmi2GetBoolean", (f.fmi2GetBoolean)(c, vr, count, integer)),
            ("fmi2GetString", (f.fmi2GetString)(c, vr, count, text)),
            ("fmi2SetReal", (f.fmi2SetReal)(c, vr, count, real)),
            ("fmi2SetInteger", (f.fmi2SetInteger)(c, vr, count, integer)),
            ("fmi2SetBoolean", (f.fmi2SetBoolean)(c, vr, count, integer)),
            ("fmi2SetString", (f.fmi2SetString)(c, vr, count, text)),
            (
                "fmi2SetDebugLogging",
                (f.fmi2SetDebugLogging)(c, 1, count, text),
            ),
            (
                "fmi2GetDirectionalDerivative",
                (f.fmi2GetDirectionalDerivative)(c, vr, count, first, 1, &1.0, real),
            ),
            (
                "fmi2GetDirectionalDerivative",
                (f.fmi2GetDirectionalDerivative)(c, first, 1, vr, count, real, real),
            ),
            (
                "fmi2SetRealInputDerivatives",
                (f.fmi2SetRealInputDerivatives)(c, vr, count, integer, real),
            ),
            (
                "fmi2GetRealOutputDerivatives",
                (f.fmi2GetRealOutputDerivatives)(c, vr, count, integer, real),
            ),
        ]
    }
}

/// Asserts that each call was refused with one line, which names its function and has a part.
#[track_caller]
fn all_refused(instance: &Instance, answers: &[(&str, Status)], part: &str) {
    let log = instance.take_log();
    assert_eq!(log.len(), answers.len(), "{log:?}");
    for ((name, status), line) in answers.iter().zip(log) {
        assert_eq!(*status, c::ERROR, "{name}");
        let message = line.message;
        assert!(
            message.starts_with(name) && message.contains(part),
            "{part:?} is not in: {message}"
        );
    }
}

#[test]
fn counts_that_no_memory_has_are_refused() {
    let instance = Instance::running();
    let before = bits(&instance.reals());
    let (f, component) = (instance.functions, instance.component);
    let mut memory = Memory::new();
    let most = isize::MAX as usize;
    // The smallest elements, value references, have 4 bytes; the size of the last one wraps around
    // to 4.
    for count in [
        usize::MAX,
        usize::MAX / 2 + 1,
        most,
        most / 4 + 1,
        usize::MAX / 4 + 2,
    ] {
        let answers = arrays(f, component, memory.at(0), count);
        all_refused(&instance, &answers, "no memory is that large");
    }
    let mut new = ptr::null_mut();
    // SAFETY: the instance lives; the function must not touch what cannot be right.
    let status = unsafe {
        let bytes = memory.at(0).cast();
        (f.fmi2DeSerializeFMUstate)(component, bytes, usize::MAX, &mut new)
    };
    all_refused(
        &instance,
        &[("fmi2DeSerializeFMUstate", status)],
        "no memory is that large",
    );
    assert!(new.is_null());
    memory.is_untouched();
    assert_eq!(bits(&instance.reals()), before);
}

#[test]
fn misaligned_arrays_are_refused() {
    let instance = Instance::running();
    let before = bits(&instance.reals());
    let (f, component) = (instance.functions, instance.component);
    let mut memory = Memory::new();
    for offset in [1, 2, 3] {
        let answers = arrays(f, component, memory.at(offset), 1);
        all_refused(&instance, &answers, "misaligned");
    }
    // Aligned for value references, but not for numbers.
    let at = memory.at(4).cast::<f64>();
    let thrust = &0;
    // SAFETY: as above.
    let answers = unsafe {
        [
            ("fmi2GetReal", (f.fmi2GetReal)(component, thrust, 1, at)),
            ("fmi2SetReal", (f.fmi2SetReal)(component, thrust, 1, at)),
        ]
    };
    all_refused(&instance, &answers, "value is a misaligned pointer");
    memory.is_untouched();
    assert_eq!(bits(&instance.reals()), before);
}

#[test]
fn misaligned_places_for_answers_are_refused() {
    let instance = Instance::running();
    let state = instance.state();
    let (f, component) = (instance.functions, instance.component);
    let mut memory = Memory::new();
    let at = memory.at(1);
    // SAFETY: the instance and the state live; the functions must not touch what cannot be right.
    let answers = unsafe {
        [
            (
                "fmi2GetStatus",
                (f.fmi2GetStatus)(component, c::DO_STEP_STATUS, at.cast()),
            ),
            (
                "fmi2GetRealStatus",
                (f.fmi2GetRealStatus)(component, c::LAST_SUCCESSFUL_TIME, at.cast()),
            ),
            (
                "fmi2GetBooleanStatus",
                (f.fmi2GetBooleanStatus)(component, c::TERMINATED, at.cast()),
            ),
            (
                "fmi2GetStringStatus",
                (f.fmi2GetStringStatus)(component, c::PENDING_STATUS, at.cast()),
            ),
            ("fmi2GetFMUstate", (f.fmi2GetFMUstate)(component, at.cast())),
            (
                "fmi2FreeFMUstate",
                (f.fmi2FreeFMUstate)(component, at.cast()),
            ),
            (
                "fmi2SerializedFMUstateSize",
                (f.fmi2SerializedFMUstateSize)(component, state.pointer, at.cast()),
            ),
        ]
    };
    all_refused(&instance, &answers, "misaligned");
    let bytes = state.serialize();
    // SAFETY: as above.
    let status = unsafe {
        let read = f.fmi2DeSerializeFMUstate;
        read(component, bytes.as_ptr().cast(), bytes.len(), at.cast())
    };
    all_refused(
        &instance,
        &[("fmi2DeSerializeFMUstate", status)],
        "misaligned",
    );
    memory.is_untouched();
}

#[test]
fn misaligned_vectors_of_model_exchange_are_refused() {
    let instance = Instance::for_model_exchange();
    instance.begin_integration();
    let (f, component, n) = (instance.functions, instance.component, STATES.len());
    let (mut memory, mut flag) = (Memory::new(), 9);
    let (x, misaligned) = (memory.at(4).cast::<f64>(), memory.at(1).cast());
    // SAFETY: the instance lives; the functions must not touch what cannot be right.
    let answers = unsafe {
        let completed = f.fmi2CompletedIntegratorStep;
        let mut answers = vec![
            (
                "fmi2SetContinuousStates",
                (f.fmi2SetContinuousStates)(component, x, n),
            ),
            (
                "fmi2GetContinuousStates",
                (f.fmi2GetContinuousStates)(component, x, n),
            ),
            (
                "fmi2GetDerivatives",
                (f.fmi2GetDerivatives)(component, x, n),
            ),
            (
                "fmi2GetNominalsOfContinuousStates",
                (f.fmi2GetNominalsOfContinuousStates)(component, x, n),
            ),
            (
                "fmi2CompletedIntegratorStep",
                completed(component, 1, misaligned, &mut flag),
            ),
            (
                "fmi2CompletedIntegratorStep",
                completed(component, 1, &mut flag, misaligned),
            ),
        ];
        assert_eq!((f.fmi2EnterEventMode)(component), c::OK);
        let info = memory.at(4).cast();
        answers.push((
            "fmi2NewDiscreteStates",
            (f.fmi2NewDiscreteStates)(component, info),
        ));
        answers
    };
    all_refused(&instance, &answers, "misaligned");
    assert_eq!(flag, 9);
    memory.is_untouched();
}

/// An importer that does not need an answer may pass the place of another, and derivatives may
/// replace their direction.
#[test]
fn answers_may_share_their_place() {
    let instance = Instance::for_model_exchange();
    instance.begin_integration();
    let (f, component) = (instance.functions, instance.component);
    let (mut flag, mut along) = (9, 1.0);
    let (at, rpm, thrust) = (
        &raw mut flag,
        reference(&REALS, "rpm"),
        reference(&REALS, "thrust"),
    );
    // SAFETY: the instance lives, and all pointers are to living numbers.
    let expected = unsafe {
        let status = (f.fmi2CompletedIntegratorStep)(component, 1, at, at);
        assert_eq!((status, flag), (c::OK, 0));
        let mut expected = 9.0;
        let derivative = f.fmi2GetDirectionalDerivative;
        let status = derivative(component, &thrust, 1, &rpm, 1, &along, &mut expected);
        assert_eq!(status, c::OK);
        let at = &raw mut along;
        let status = derivative(component, &thrust, 1, &rpm, 1, at, at);
        assert_eq!(status, c::OK);
        expected
    };
    assert_eq!(along.to_bits(), expected.to_bits());
}

/// Whatever an importer mixes up: the functions answer an error, and have no logger to say more.
#[test]
fn what_is_no_instance_is_recognised() {
    let instance = Instance::running();
    let state = instance.state();
    let f = instance.functions;
    let mut memory = Memory::new();
    for wrong in [
        memory.at(0),
        memory.at(1),
        state.pointer,
        instance.component.wrapping_byte_add(8),
    ] {
        let mut value = 9.0;
        // SAFETY: 8 bytes may be read where the pointer is aligned; the functions must not touch
        // more.
        unsafe {
            assert_eq!((f.fmi2DoStep)(wrong, 0.0, 0.1, 1), c::ERROR);
            assert_eq!((f.fmi2GetReal)(wrong, &0, 1, &mut value), c::ERROR);
            (f.fmi2FreeInstance)(wrong);
        }
        assert_eq!(value, 9.0);
    }
    // An instance is not a state, either.
    // SAFETY: the instance lives.
    let status = unsafe { (f.fmi2SetFMUstate)(instance.component, instance.component) };
    let message = instance.refused(status);
    assert!(message.contains("not a state of this FMU"), "{message}");
    memory.is_untouched();
    assert_eq!(instance.set_state(&state), c::OK);
    assert_eq!(instance.step(0.0, 0.1), c::OK);
}
