//! Random sequences of calls, legal or not, with random values: no crash, only the statuses that
//! this FMU answers, and every number that is read with fmi2OK is finite.

use crate::support::{
    Instance,
    c::{self, Reference},
};
use helicopter_rotor::block::variables::{BOOLEANS, INTEGERS, REALS, STATES};
use proptest::prelude::*;
use std::{
    ffi::{CString, c_int},
    ptr,
};

/// One call.
#[derive(Debug, Clone)]
enum Call {
    SetUp(f64, Option<f64>),
    Enter,
    Exit,
    Step {
        offset: f64,
        size: f64,
    },
    Terminate,
    Reset,
    SetReals(Vec<(Reference, f64)>),
    SetInteger(Reference, c_int),
    SetBoolean(Reference, c_int),
    SetString(Reference, String),
    GetReals(Vec<Reference>),
    GetInteger(Reference),
    GetBoolean(Reference),
    Log(bool, Vec<&'static str>),
    SetSlope(Reference, c_int, f64),
    EnterEventMode,
    NewDiscreteStates,
    EnterContinuousTime,
    CompletedStep,
    SetTime(f64),
    /// Moves some of the states.
    SetStates(Vec<(usize, f64)>),
    GetDerivatives,
    /// Takes the complete state, over the one that was taken before.
    TakeState,
    /// Goes back to the state that was taken.
    SetState,
    /// Through bytes.
    SerializeState,
    FreeState,
}

fn reals() -> impl Strategy<Value = f64> {
    prop_oneof![
        4 => -10.0..10.0,
        2 => -3000.0..3000.0,
        1 => any::<f64>(),
        1 => prop::sample::select(vec![
            0.0, -0.0, f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, f64::MAX,
            f64::MIN_POSITIVE, 5e-324, 1e6,
        ]),
    ]
}

/// Mostly good value references.
fn references(count: usize) -> impl Strategy<Value = Reference> {
    prop_oneof![20 => 0..count as Reference, 1 => any::<Reference>()]
}

/// A value reference with a value that is in its range more often than not.
fn setting() -> impl Strategy<Value = (Reference, f64)> {
    prop_oneof![
        1 => (references(REALS.len()), reals()),
        3 => (0..REALS.len(), 0.0..=1.0).prop_map(|(i, fraction)| {
            let v = &REALS[i];
            let (low, high) = (v.min.max(-100.0), v.max.min(1000.0));
            (i as Reference, low + fraction * (high - low))
        }),
    ]
}

fn calls() -> impl Strategy<Value = Call> {
    let names = vec![
        "",
        "naca0015.polar",
        "airfoils/circle.polar",
        "knight-hefner-3.toml",
        "missing %s",
        "ü",
    ];
    let categories = vec!["logStatusError", "logEvents", "%n"];
    prop_oneof![
        1 => (reals(), prop::option::of(reals())).prop_map(|(start, stop)| Call::SetUp(start, stop)),
        2 => Just(Call::Enter),
        2 => Just(Call::Exit),
        // Mostly from where the last step ended.
        6 => (prop_oneof![9 => Just(0.0), 1 => reals()], prop_oneof![9 => 1e-4..1.0, 1 => reals()])
            .prop_map(|(offset, size)| Call::Step { offset, size }),
        1 => prop::sample::select(vec![Call::Terminate, Call::Reset]),
        8 => prop::collection::vec(setting(), 0..4).prop_map(Call::SetReals),
        2 => (references(INTEGERS.len()), prop_oneof![9 => 0..5_i32, 1 => any::<c_int>()])
            .prop_map(|(reference, value)| Call::SetInteger(reference, value)),
        1 => (references(BOOLEANS.len()), prop_oneof![9 => 0..=1_i32, 1 => any::<c_int>()])
            .prop_map(|(reference, value)| Call::SetBoolean(reference, value)),
        1 => (references(2), prop::sample::select(names))
            .prop_map(|(reference, name)| Call::SetString(reference, name.to_owned())),
        6 => prop::collection::vec(references(REALS.len()), 0..6).prop_map(Call::GetReals),
        1 => references(INTEGERS.len()).prop_map(Call::GetInteger),
        1 => references(BOOLEANS.len()).prop_map(Call::GetBoolean),
        1 => (any::<bool>(), prop::sample::subsequence(categories, 0..=3))
            .prop_map(|(on, chosen)| Call::Log(on, chosen)),
        3 => (references(20), prop_oneof![9 => Just(1), 1 => any::<c_int>()], reals())
            .prop_map(|(reference, order, value)| Call::SetSlope(reference, order, value)),
        6 => prop::sample::select(vec![
            Call::EnterEventMode, Call::NewDiscreteStates, Call::EnterContinuousTime,
            Call::EnterContinuousTime, Call::CompletedStep, Call::GetDerivatives,
        ]),
        1 => reals().prop_map(Call::SetTime),
        6 => prop::collection::vec((0..STATES.len(), reals()), 0..5).prop_map(Call::SetStates),
        4 => prop::sample::select(vec![
            Call::TakeState, Call::SetState, Call::SerializeState, Call::FreeState,
        ]),
    ]
}

/// What an importer keeps beside the instance.
#[derive(Default)]
struct Importer {
    /// Where the last step ended.
    time: f64,
    taken: Option<(c::FmuState, f64)>,
    /// The numbers that the last call answered.
    read: Vec<f64>,
}

/// Makes a call.
fn make(instance: &Instance, call: &Call, importer: &mut Importer) -> c::Status {
    let (f, component) = (instance.functions, instance.component);
    let Importer { time, taken, read } = importer;
    match call {
        Call::SetUp(start, stop) => {
            let status = instance.set_up(*start, *stop);
            if status == c::OK {
                *time = *start;
            }
            status
        }
        Call::Enter => instance.enter_initialization(),
        Call::Exit => instance.exit_initialization(),
        Call::Step { offset, size } => {
            let status = instance.step(*time + offset, *size);
            if status == c::OK {
                *time = instance.last_time();
            }
            status
        }
        Call::Terminate => instance.terminate(),
        Call::Reset => {
            *time = 0.0;
            instance.reset()
        }
        Call::SetReals(settings) => {
            let (references, values): (Vec<_>, Vec<_>) = settings.iter().copied().unzip();
            instance.set_reals(&references, &values)
        }
        Call::SetInteger(reference, value) => instance.set_integer_at(*reference, *value),
        Call::SetBoolean(reference, value) => instance.set_booleans(&[*reference], &[*value]),
        Call::SetString(reference, value) => {
            instance.set_string_at(*reference, &CString::new(value.as_str()).unwrap())
        }
        Call::GetReals(references) => {
            read.resize(references.len(), f64::NAN);
            instance.get_reals(references, read)
        }
        Call::GetInteger(reference) => instance.get_integer_at(*reference, &mut 0),
        Call::GetBoolean(reference) => {
            let mut value = 0;
            let status = instance.get_boolean_at(*reference, &mut value);
            assert!([0, 1].contains(&value), "{value}");
            status
        }
        Call::Log(on, categories) => instance.set_debug_logging(*on, categories),
        Call::SetSlope(reference, order, value) => {
            instance.set_input_derivatives(&[*reference], &[*order], &[*value])
        }
        Call::EnterEventMode => instance.enter_event_mode(),
        Call::NewDiscreteStates => {
            let mut info = c::EventInfo::default();
            // SAFETY: the instance lives, and the answer has its room (also below).
            unsafe { (f.fmi2NewDiscreteStates)(component, &mut info) }
        }
        Call::EnterContinuousTime => instance.enter_continuous_time(),
        Call::CompletedStep => {
            let (mut event, mut end) = (0, 0);
            // SAFETY: see above.
            unsafe { (f.fmi2CompletedIntegratorStep)(component, 1, &mut event, &mut end) }
        }
        Call::SetTime(time) => instance.set_time(*time),
        Call::SetStates(changes) => {
            let mut x = vec![0.0; STATES.len()];
            // SAFETY: see above.
            unsafe { (f.fmi2GetContinuousStates)(component, x.as_mut_ptr(), x.len()) };
            instance.take_log();
            changes.iter().for_each(|(i, value)| x[*i] = *value);
            instance.set_states(&x)
        }
        Call::GetDerivatives => {
            read.resize(STATES.len(), f64::NAN);
            // SAFETY: see above.
            unsafe { (f.fmi2GetDerivatives)(component, read.as_mut_ptr(), read.len()) }
        }
        Call::TakeState => {
            let mut pointer = taken.map_or(ptr::null_mut(), |(pointer, _)| pointer);
            let status = instance.get_state(&mut pointer);
            *taken = Some((pointer, *time));
            status
        }
        Call::SetState => {
            let (pointer, then) = taken.unwrap_or((ptr::null_mut(), *time));
            // SAFETY: the instance lives, and the state is null or lives.
            let status = unsafe { (f.fmi2SetFMUstate)(component, pointer) };
            if status == c::OK {
                *time = then;
            }
            status
        }
        Call::SerializeState => {
            let state = instance.state();
            let again = instance.deserialize(&state.serialize());
            again.map_or_else(|status| status, |again| instance.set_state(&again))
        }
        Call::FreeState => {
            let mut pointer = taken.take().map_or(ptr::null_mut(), |(pointer, _)| pointer);
            // SAFETY: the instance lives, and the state is null or lives.
            unsafe { (f.fmi2FreeFMUstate)(component, &mut pointer) }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_calls_never_crash_and_never_read_what_is_not_finite(
        is_model_exchange in any::<bool>(),
        initialized in any::<bool>(),
        calls in prop::collection::vec(calls(), 1..60),
    ) {
        let instance = if is_model_exchange {
            Instance::for_model_exchange()
        } else {
            Instance::new()
        };
        if initialized {
            instance.initialize();
        }
        let mut importer = Importer::default();
        for call in &calls {
            importer.read.clear();
            let status = make(&instance, call, &mut importer);
            let read = &importer.read;
            prop_assert!([c::OK, c::WARNING, c::ERROR].contains(&status), "{:?}: {}", call, status);
            prop_assert!(status != c::WARNING || matches!(call, Call::Log(..)), "{:?}", call);
            if status == c::OK {
                prop_assert!(read.iter().all(|v| v.is_finite()), "{:?}: {:?}", call, read);
            }
            for line in instance.take_log() {
                prop_assert!(!line.message.contains("internal error"), "{:?}: {:?}", call, line);
            }
        }
        make(&instance, &Call::FreeState, &mut importer);
        // Whatever happened: after a reset the instance is as new.
        prop_assert_eq!(instance.reset(), c::OK);
        instance.initialize();
        prop_assert_eq!(instance.real("thrust"), Instance::running().real("thrust"));
    }
}
