//! The complete state: saved, set and serialized in every state of the call sequence.

use crate::support::{
    Instance3, c,
    instance3::{Creation3, Kind},
};
use helicopter_rotor::block::variables::STATES;
use std::{collections::BTreeSet, ptr};

fn configure(instance: &Instance3) {
    instance.ok(instance.choose("models.inflow", 12));
    instance.ok(instance.set_boolean("flapping.enabled", 1));
    instance.ok(instance.set_floats(&["velocity"], &[10.0, 0.0, 1.0]));
}

#[test]
fn a_flight_goes_on_from_a_serialized_state_to_the_same_bits() {
    let instance = Instance3::new();
    configure(&instance);
    instance.initialize();
    instance.step(0.0, 0.013);
    let bytes = instance.serialized();
    let fly_on = |instance: &Instance3| {
        instance.step(0.013, 0.02);
        instance.set("collective", 0.2);
        instance.step(0.033, 0.02);
        instance.all_floats()
    };
    let expected = fly_on(&instance);
    instance.ok(instance.continue_from(&bytes));
    assert_eq!(instance.float("time"), 0.013);
    assert_eq!(fly_on(&instance), expected);
    // On another instance.
    let other = Instance3::new();
    other.ok(other.continue_from(&bytes));
    assert_eq!(fly_on(&other), expected);
    assert_eq!(instance.serialized(), other.serialized());
}

/// What a few calls answer after each other: their statuses, and what is seen then.
fn goes_on(instance: &Instance3) -> (Vec<c::Status>, Vec<f64>, i64) {
    let (f, p) = (instance.functions, instance.pointer);
    let mut answers = vec![instance.set_floats(&["velocity"], &[10.0, 0.0, -5.0])];
    let mut flags = [9; 5];
    let [a, b, d, e, g] = flags.each_mut();
    // SAFETY: the instance lives, and the pointers are valid.
    unsafe {
        answers.push((f.fmi3UpdateDiscreteStates)(p, a, b, d, e, g, &mut 0.0));
        answers.push((f.fmi3CompletedIntegratorStep)(
            p,
            1,
            &mut flags[0],
            &mut flags[1],
        ));
    }
    let (status, stepped) = instance.step_with(0.0, 0.01, None);
    answers.push(status);
    answers.push(instance.set_states(&[0.1; STATES.len()]));
    let (status, floats) = instance.get_floats(&["thrust", "time"], 2);
    answers.push(status);
    // SAFETY: the instance lives.
    answers.push(unsafe { (f.fmi3EnterInitializationMode)(p, 0, 0.0, 0.0, 0, 0.0) });
    let mut seen: Vec<f64> = flags.map(f64::from).to_vec();
    seen.extend(floats);
    if answers[3] == c::OK {
        seen.extend([stepped.time, f64::from(u8::from(stepped.needs_event))]);
    }
    (answers, seen, instance.choice("flowState"))
}

#[test]
fn every_state_of_the_call_sequence_is_saved_and_returned_to() {
    type Walk = fn(&Instance3);
    let event_mode = Creation3 {
        event_mode: true,
        ..Creation3::default()
    };
    let model_exchange = Creation3 {
        kind: Kind::ModelExchange,
        ..Creation3::default()
    };
    let terminate: Walk = |instance| {
        instance.initialize();
        // SAFETY: the instance lives.
        instance.ok(unsafe { (instance.functions.fmi3Terminate)(instance.pointer) });
    };
    let step_mode: Walk = |instance| {
        instance.initialize();
        instance.enter_step_mode();
    };
    let continuous_time: Walk = |instance| {
        instance.initialize();
        instance.enter_continuous_time();
    };
    let both: [Walk; 4] = [
        |_| {},
        Instance3::begin_initialization,
        Instance3::initialize,
        terminate,
    ];
    for (creation, third) in [(&event_mode, step_mode), (&model_exchange, continuous_time)] {
        let mut different = BTreeSet::new();
        for (i, walk) in both.into_iter().chain([third]).enumerate() {
            let instance = creation.make().unwrap();
            configure(&instance);
            walk(&instance);
            let bytes = instance.serialized();
            let copy = creation.make().unwrap();
            copy.ok(copy.continue_from(&bytes));
            assert_eq!(copy.serialized(), bytes, "state {i}");
            // A fresh one, and one that is in another state and has seen another flight.
            let other = creation.make().unwrap();
            configure(&other);
            other.ok(other.set_floats(&["velocity"], &[0.0, 0.0, -6.0]));
            third(&other);
            let expected = goes_on(&instance);
            for other in [creation.make().unwrap(), other] {
                other.ok(other.continue_from(&bytes));
                assert_eq!(goes_on(&other), expected, "state {i}");
            }
            different.insert(format!("{expected:?}"));
        }
        assert_eq!(different.len(), 5, "the calls tell the states apart");
    }
}

#[test]
fn a_state_of_one_interface_or_damaged_bytes_are_refused() {
    let (one, other) = (Instance3::new(), Instance3::for_model_exchange());
    one.initialize();
    other.initialize();
    let message = other.refused(other.continue_from(&one.serialized()));
    assert!(message.contains("other interface"), "{message}");
    let mut bytes = one.serialized();
    for place in [0, 9, 20, 60, bytes.len() - 1] {
        bytes[place] ^= 1;
        one.refused(one.continue_from(&bytes));
        bytes[place] ^= 1;
    }
    assert_eq!(one.continue_from(&bytes), c::OK);
}

#[test]
fn null_pointers_and_short_room_are_refused_in_the_words_of_fmi_3() {
    let instance = Instance3::new();
    let (f, p) = (instance.functions, instance.pointer);
    let (mut state, mut bytes) = (ptr::null_mut(), [0; 8]);
    // SAFETY: the instance and the state live; the functions must not touch what is null.
    unsafe {
        let message = instance.refused((f.fmi3SetFMUState)(p, state));
        let expected = "FMUState is a null pointer; pass a state from fmi3GetFMUState or fmi3DeserializeFMUState";
        assert!(message.contains(expected), "{message}");
        let message = instance.refused((f.fmi3GetFMUState)(p, ptr::null_mut()));
        assert!(message.contains("FMUState is a null"), "{message}");
        instance.ok((f.fmi3GetFMUState)(p, &mut state));
        let status = (f.fmi3SerializeFMUState)(p, state, bytes.as_mut_ptr(), bytes.len());
        let message = instance.refused(status);
        let expected = "ask fmi3SerializedFMUStateSize";
        assert!(message.contains(expected), "{message}");
        instance.ok((f.fmi3FreeFMUState)(p, &mut state));
    }
}
