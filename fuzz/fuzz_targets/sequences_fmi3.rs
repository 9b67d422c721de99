//! Sequences of calls of FMI 3.0, legal or not, with good and bad value references, counts and
//! values: no crash, only sentences in the log, only finite numbers with fmi3OK, and after a reset
//! the instance is as new. The importer's function makes the same calls in the middle of steps.

#![no_main]

use arbitrary::Arbitrary;
use fuzz::{finite, promise};
use helicopter_rotor::{
    block::variables::{BLOCK_OF_REFERENCES, INSTANTIATION_TOKEN, STATES, integer, real},
    fmi3::{
        co_simulation::*, creation::*, dependencies::*, derivatives::*, events::*, fmu_state::*,
        get_set::*, life_cycle::*, model_exchange::*, not_offered::*, types::*,
    },
};
use libfuzzer_sys::fuzz_target;
use std::{
    cell::{Cell, RefCell},
    ffi::{CStr, CString, c_char, c_void},
    ptr,
};

const MAX_CALLS: usize = 40;
const MAX_COSTLY: usize = 8;
const OK: fmi3Status = fmi3Status::Ok;

/// A value reference: in one of the blocks, or any number.
#[derive(Debug, Arbitrary, Clone, Copy)]
enum Reference {
    Of(u8, u16),
    Any(u32),
}

impl Reference {
    fn number(self) -> u32 {
        match self {
            Self::Of(block, index) => {
                u32::from(block % 5) * BLOCK_OF_REFERENCES + u32::from(index % 360)
            }
            Self::Any(number) => number,
        }
    }
}

#[derive(Debug, Arbitrary, Clone)]
enum Call {
    Floats(bool, Vec<Reference>, u8, i8),
    Integers(bool, Vec<Reference>, u8, i8),
    Enumerations(bool, Vec<Reference>, u8, i64),
    Booleans(bool, Vec<Reference>, u8, u8),
    Strings(bool, Vec<Reference>, u8),
    Derivative(bool, Vec<Reference>, Vec<Reference>, u8, u8),
    OutputDerivatives(Vec<Reference>, u8, i32),
    Dependencies(Reference, u8),
    Step(i8),
    Mode(u8),
    State(bool),
    States(u8, i8),
    NotOffered(u8),
}

#[derive(Debug, Arbitrary)]
struct Sequence {
    is_model_exchange: bool,
    event_mode: bool,
    early_return: bool,
    has_callback: bool,
    is_initialized: bool,
    in_updates: Vec<Call>,
    calls: Vec<Call>,
}

/// What the callbacks find behind the instance's environment.
struct Importer {
    instance: Cell<fmi3Instance>,
    time: Cell<f64>,
    costly: Cell<usize>,
    in_updates: RefCell<Vec<Call>>,
}

unsafe extern "C" fn check(
    _: *mut c_void,
    _: fmi3Status,
    category: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the strings live during this call, as the standard demands.
    let (category, message) = unsafe { (CStr::from_ptr(category), CStr::from_ptr(message)) };
    promise(
        category.to_str().is_ok_and(|c| c.starts_with("log")),
        || format!("category {category:?}"),
    );
    let message = message.to_str().unwrap_or("internal error: not UTF-8");
    let unescaped = message.replace("##", "");
    promise(!unescaped.contains('#'), || {
        format!("a reference: {message}")
    });
    let is_sentence = !message.is_empty() && !message.contains("internal error");
    promise(is_sentence, || message.to_owned());
}

unsafe extern "C" fn update(
    importer: *mut c_void,
    time: f64,
    _: u8,
    _: u8,
    _: u8,
    can_return: u8,
    requested: *mut u8,
    return_time: *mut f64,
) {
    promise(time.is_finite(), || format!("an update at {time}"));
    // SAFETY: the address of a living importer.
    let importer = unsafe { &*importer.cast::<Importer>() };
    let Some(call) = importer.in_updates.borrow_mut().pop() else {
        return;
    };
    if let Call::Step(size) = call
        && can_return == 1
    {
        // SAFETY: places for these answers.
        unsafe {
            *requested = 1;
            *return_time = f64::from(size) * 1e-3;
        }
    }
    importer.make(&call);
}

impl Importer {
    fn make(&self, call: &Call) {
        let is_costly = matches!(
            call,
            Call::Step(_) | Call::Derivative(..) | Call::OutputDerivatives(..) | Call::Mode(_)
        );
        if is_costly {
            if self.costly.get() >= MAX_COSTLY {
                return;
            }
            self.costly.set(self.costly.get() + 1);
        }
        let c = self.instance.get();
        let numbers =
            |all: &[Reference]| all.iter().take(8).map(|r| r.number()).collect::<Vec<u32>>();
        // SAFETY: the instance lives, and the buffers are as long as the counts.
        unsafe {
            match call {
                Call::Floats(set, of, count, x) => {
                    let r = numbers(of);
                    let mut values = vec![f64::from(*x) / 16.0; usize::from(*count)];
                    let n = values.len();
                    if *set {
                        fmi3SetFloat64(c, r.as_ptr(), r.len(), values.as_ptr(), n);
                    } else if fmi3GetFloat64(c, r.as_ptr(), r.len(), values.as_mut_ptr(), n) == OK {
                        finite(&values);
                    }
                }
                Call::Integers(set, of, count, x) => {
                    let (r, mut values) = (numbers(of), vec![i32::from(*x); usize::from(*count)]);
                    let n = values.len();
                    match set {
                        true => fmi3SetInt32(c, r.as_ptr(), r.len(), values.as_ptr(), n),
                        false => fmi3GetInt32(c, r.as_ptr(), r.len(), values.as_mut_ptr(), n),
                    };
                }
                Call::Enumerations(set, of, count, x) => {
                    let (r, mut values) = (numbers(of), vec![*x; usize::from(*count)]);
                    let n = values.len();
                    match set {
                        true => fmi3SetInt64(c, r.as_ptr(), r.len(), values.as_ptr(), n),
                        false => fmi3GetInt64(c, r.as_ptr(), r.len(), values.as_mut_ptr(), n),
                    };
                }
                Call::Booleans(set, of, count, x) => {
                    let (r, mut values) = (numbers(of), vec![*x; usize::from(*count)]);
                    let n = values.len();
                    match set {
                        true => fmi3SetBoolean(c, r.as_ptr(), r.len(), values.as_ptr(), n),
                        false => fmi3GetBoolean(c, r.as_ptr(), r.len(), values.as_mut_ptr(), n),
                    };
                }
                Call::Strings(set, of, count) => {
                    let text = c"models.inflow = petersHe".as_ptr();
                    let (r, mut values) = (numbers(of), vec![text; usize::from(*count)]);
                    let n = values.len();
                    match set {
                        true => fmi3SetString(c, r.as_ptr(), r.len(), values.as_ptr(), n),
                        false => fmi3GetString(c, r.as_ptr(), r.len(), values.as_mut_ptr(), n),
                    };
                }
                Call::Derivative(adjoint, of, by, seeds, results) => {
                    let (u, k) = (numbers(of), numbers(by));
                    let seed = vec![0.5; usize::from(*seeds)];
                    let mut result = vec![0.0; usize::from(*results)];
                    let (s, n) = (seed.as_ptr(), seed.len());
                    let (x, m) = (result.as_mut_ptr(), result.len());
                    let (u, nu, k, nk) = (u.as_ptr(), u.len(), k.as_ptr(), k.len());
                    let status = match adjoint {
                        true => fmi3GetAdjointDerivative(c, u, nu, k, nk, s, n, x, m),
                        false => fmi3GetDirectionalDerivative(c, u, nu, k, nk, s, n, x, m),
                    };
                    if status == OK {
                        finite(&result);
                    }
                }
                Call::OutputDerivatives(of, count, order) => {
                    let (r, mut values) = (numbers(of), vec![0.0; usize::from(*count)]);
                    let orders = vec![*order; r.len()];
                    let (x, n) = (values.as_mut_ptr(), values.len());
                    let (r, o, l) = (r.as_ptr(), orders.as_ptr(), orders.len());
                    if fmi3GetOutputDerivatives(c, r, l, o, x, n) == OK {
                        finite(&values);
                    }
                }
                Call::Dependencies(of, extra) => {
                    let (of, mut n) = (of.number(), 0);
                    if fmi3GetNumberOfVariableDependencies(c, of, &mut n) == OK {
                        let count = n + usize::from(extra % 2);
                        let (mut a, mut b) = (vec![0; count], vec![0; count]);
                        let (mut d, mut e) = (vec![0; count], vec![0; count]);
                        let (a, b) = (a.as_mut_ptr(), b.as_mut_ptr());
                        let (d, e) = (d.as_mut_ptr(), e.as_mut_ptr());
                        let status = fmi3GetVariableDependencies(c, of, a, b, d, e, count);
                        promise((status == OK) == (count == n), || "a wrong count".into());
                    }
                }
                Call::Step(size) => {
                    let (mut flags, mut time) = ([0; 3], 0.0);
                    let [a, b, d] = flags.each_mut();
                    let (point, size) = (self.time.get(), f64::from(*size) * 2e-4);
                    if fmi3DoStep(c, point, size, 1, a, b, d, &mut time) == OK {
                        promise((point..=point + size).contains(&time), || {
                            format!("from {point} s to {time} s")
                        });
                        self.time.set(time);
                    }
                }
                Call::Mode(which) => self.change_mode(which % 10),
                Call::State(serialize) => self.save_and_set(*serialize),
                Call::States(count, x) => {
                    let mut states = vec![f64::from(*x) / 64.0; usize::from(*count) % 64];
                    let (p, n) = (states.as_mut_ptr(), states.len());
                    fmi3SetContinuousStates(c, p, n);
                    let derivatives = fmi3GetContinuousStateDerivatives(c, p, n);
                    promise(derivatives != OK || n == STATES.len(), || {
                        format!("{n} states")
                    });
                    if derivatives == OK {
                        finite(&states);
                    }
                }
                Call::NotOffered(which) => {
                    let (r, mut x) = (real::RPM.number(), 0.0);
                    let status = match which % 4 {
                        0 => fmi3GetUInt64(c, &r, 1, &mut 0, 1),
                        1 => fmi3GetClock(c, &r, 1, &mut 0),
                        2 => fmi3GetShiftDecimal(c, &r, 1, &mut x),
                        _ => fmi3ActivateModelPartition(c, r, 0.0),
                    };
                    promise(status != OK, || "offered after all".into());
                }
            }
        }
    }

    fn change_mode(&self, which: u8) {
        let c = self.instance.get();
        let (mut flags, mut time) = ([0; 5], 0.0);
        let [a, b, d, e, f] = flags.each_mut();
        // SAFETY: the instance lives, and the results may be written.
        unsafe {
            match which {
                0 => fmi3EnterInitializationMode(c, 0, 0.0, self.time.get(), 0, 0.0),
                1 => fmi3ExitInitializationMode(c),
                2 => fmi3EnterEventMode(c),
                3 => fmi3UpdateDiscreteStates(c, a, b, d, e, f, &mut time),
                4 => fmi3EnterStepMode(c),
                5 => fmi3EnterContinuousTimeMode(c),
                6 => fmi3EnterConfigurationMode(c),
                7 => fmi3ExitConfigurationMode(c),
                8 => fmi3CompletedIntegratorStep(c, 1, a, b),
                _ => fmi3Terminate(c),
            };
        }
    }

    fn save_and_set(&self, serialize: bool) {
        let c = self.instance.get();
        let (mut state, mut read, mut size) = (ptr::null_mut(), ptr::null_mut(), 0);
        // SAFETY: the instance lives, and the buffers are as long as the counts.
        unsafe {
            if fmi3GetFMUState(c, &mut state) != OK {
                return;
            }
            if serialize {
                fmi3SerializedFMUStateSize(c, state, &mut size);
                let mut bytes = vec![0; size];
                let p = bytes.as_mut_ptr();
                promise(fmi3SerializeFMUState(c, state, p, size) == OK, || {
                    "bytes".into()
                });
                let status = fmi3DeserializeFMUState(c, p, size, &mut read);
                promise(status == OK, || "its own state is refused".into());
                promise(fmi3SetFMUState(c, read) == OK, || "not set".into());
                fmi3FreeFMUState(c, &mut read);
            }
            promise(fmi3SetFMUState(c, state) == OK, || "not set".into());
            fmi3FreeFMUState(c, &mut state);
        }
    }

    /// Makes a new instance of a rotor that takes little time.
    fn simplify(&self) {
        let small = [integer::NUMERICS__ELEMENTS, integer::NUMERICS__BUDGET];
        let small = small.map(|r| BLOCK_OF_REFERENCES + r.number());
        // SAFETY: the instance lives, and the pointers are valid for their counts.
        unsafe {
            let c = self.instance.get();
            promise(fmi3Reset(c) == OK, || "not reset".into());
            let status = fmi3SetInt32(c, small.as_ptr(), 2, [4, 100_000].as_ptr(), 2);
            promise(status == OK, || "not set".into());
        }
    }

    /// The thrust of a small rotor after an initialisation of the instance as new.
    fn thrust_after_reset(&self) -> f64 {
        let (c, mut thrust) = (self.instance.get(), 0.0);
        self.simplify();
        // SAFETY: the instance lives.
        unsafe {
            fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0);
            promise(fmi3ExitInitializationMode(c) == OK, || "no start".into());
            fmi3GetFloat64(c, &real::THRUST.number(), 1, &mut thrust, 1);
        }
        thrust
    }
}

fuzz_target!(|sequence: Sequence| {
    let resources = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../modelDescription/resources/"
    );
    let [token, resources] =
        [INSTANTIATION_TOKEN, resources].map(|text| CString::new(text).unwrap());
    let importer = Importer {
        instance: Cell::new(ptr::null_mut()),
        time: Cell::new(0.0),
        costly: Cell::new(0),
        in_updates: RefCell::new(sequence.in_updates.into_iter().take(MAX_CALLS).collect()),
    };
    let required = [real::COLLECTIVE, real::VELOCITY_1, real::THRUST].map(|r| r.number());
    let (name, token, folder) = (c"rotor".as_ptr(), token.as_ptr(), resources.as_ptr());
    let place = ptr::from_ref(&importer).cast_mut().cast();
    // SAFETY: the pointers live during the call, and the importer outlives the instance.
    let c = unsafe {
        if sequence.is_model_exchange {
            fmi3InstantiateModelExchange(name, token, folder, 0, 1, place, Some(check))
        } else {
            let (event, early) = (sequence.event_mode.into(), sequence.early_return.into());
            let callback: Option<fmi3IntermediateUpdateCallback> =
                sequence.has_callback.then_some(update);
            let (r, n) = (required.as_ptr(), required.len());
            fmi3InstantiateCoSimulation(
                name,
                token,
                folder,
                0,
                1,
                event,
                early,
                r,
                n,
                place,
                Some(check),
                callback,
            )
        }
    };
    promise(!c.is_null(), || "no instance".into());
    importer.instance.set(c);
    let before = importer.thrust_after_reset();
    if !sequence.is_initialized {
        importer.simplify();
    } else if sequence.event_mode && !sequence.is_model_exchange {
        importer.change_mode(4);
    }
    for call in sequence.calls.iter().take(MAX_CALLS) {
        importer.make(call);
    }
    importer.in_updates.borrow_mut().clear();
    promise(importer.thrust_after_reset() == before, || {
        "after a reset the instance is not as new".into()
    });
    // SAFETY: it lives, and is not used afterwards.
    unsafe { fmi3FreeInstance(c) };
});
