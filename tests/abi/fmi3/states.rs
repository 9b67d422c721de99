//! The complete state: saved, set and serialized in every state of the call sequence.

use crate::support::{Instance3, c, instance3::Creation3};

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

#[test]
fn every_state_of_the_call_sequence_is_saved_and_returned_to() {
    type Walk = fn(&Instance3);
    let event_mode = Creation3 {
        event_mode: true,
        ..Creation3::default()
    };
    let model_exchange = Creation3 {
        is_model_exchange: true,
        ..Creation3::default()
    };
    let configuration: Walk = |instance| {
        // SAFETY: the instance lives.
        instance.ok(unsafe { (instance.functions.fmi3EnterConfigurationMode)(instance.pointer) });
    };
    let terminate: Walk = |instance| {
        // SAFETY: the instance lives.
        instance.ok(unsafe { (instance.functions.fmi3Terminate)(instance.pointer) });
    };
    let nothing: Walk = |_| {};
    // The last is terminated.
    let all: [(&Creation3, [Walk; 7]); 2] = [
        (
            &event_mode,
            [
                nothing,
                configuration,
                Instance3::begin_initialization,
                Instance3::initialize,
                |instance| {
                    instance.initialize();
                    instance.enter_step_mode();
                },
                |instance| {
                    instance.initialize();
                    instance.enter_step_mode();
                    let enter = instance.functions.fmi3EnterConfigurationMode;
                    // SAFETY: the instance lives.
                    instance.ok(unsafe { enter(instance.pointer) });
                },
                |instance| instance.initialize(),
            ],
        ),
        (
            &model_exchange,
            [
                nothing,
                configuration,
                Instance3::begin_initialization,
                Instance3::initialize,
                |instance| {
                    instance.initialize();
                    instance.enter_continuous_time();
                },
                |instance| {
                    instance.initialize();
                    let enter = instance.functions.fmi3EnterConfigurationMode;
                    // SAFETY: the instance lives.
                    instance.ok(unsafe { enter(instance.pointer) });
                },
                |instance| {
                    instance.initialize();
                    instance.enter_continuous_time();
                },
            ],
        ),
    ];
    for (creation, walks) in all {
        for (i, walk) in walks.into_iter().enumerate() {
            let instance = creation.make().unwrap();
            configure(&instance);
            walk(&instance);
            if i == 6 {
                terminate(&instance);
            }
            let bytes = instance.serialized();
            let other = creation.make().unwrap();
            other.ok(other.continue_from(&bytes));
            assert_eq!(other.serialized(), bytes, "state {i}");
            // The same call is legal or not in both.
            let step = |instance: &Instance3| instance.step_with(0.0, 0.01, None).0;
            assert_eq!(step(&instance), step(&other), "state {i}");
        }
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
