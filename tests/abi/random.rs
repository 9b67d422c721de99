//! Random sequences of calls, legal or not, with random values: no crash, only the statuses that
//! this FMU answers, and every number that is read with fmi2OK is finite.

use crate::support::{
    Instance,
    c::{self, Reference},
};
use helicopter_rotor::block::variables::{BOOLEANS, INTEGERS, REALS};
use proptest::prelude::*;
use std::ffi::{CString, c_int};

/// One call.
#[derive(Debug, Clone)]
enum Call {
    SetUp(f64, Option<f64>),
    Enter,
    Exit,
    Step { offset: f64, size: f64 },
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
    ]
}

/// Makes a call; `time` is where the last step ended. Numbers that were read go to `read`.
fn make(instance: &Instance, call: &Call, time: &mut f64, read: &mut Vec<f64>) -> c::Status {
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
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_calls_never_crash_and_never_read_what_is_not_finite(
        initialized in any::<bool>(),
        calls in prop::collection::vec(calls(), 1..60),
    ) {
        let instance = Instance::new();
        if initialized {
            instance.initialize();
        }
        let mut time = 0.0;
        for call in &calls {
            let mut read = Vec::new();
            let status = make(&instance, call, &mut time, &mut read);
            prop_assert!([c::OK, c::WARNING, c::ERROR].contains(&status), "{:?}: {}", call, status);
            prop_assert!(status != c::WARNING || matches!(call, Call::Log(..)), "{:?}", call);
            if status == c::OK {
                prop_assert!(read.iter().all(|v| v.is_finite()), "{:?}: {:?}", call, read);
            }
            for line in instance.take_log() {
                prop_assert!(!line.message.contains("internal error"), "{:?}: {:?}", call, line);
            }
        }
        // Whatever happened: after a reset the instance is as new.
        prop_assert_eq!(instance.reset(), c::OK);
        instance.initialize();
        prop_assert_eq!(instance.real("thrust"), Instance::running().real("thrust"));
    }
}
