//! Event Mode in Co-Simulation and in Model Exchange, for the one discrete output, `flowState`.

use crate::support::{
    Instance3,
    instance3::{Creation3, OnUpdate, Update},
};

fn made(event_mode: bool, early_return: bool) -> Instance3 {
    let creation = Creation3 {
        event_mode,
        early_return,
        required: vec!["velocity"],
        has_callback: true,
        ..Creation3::default()
    };
    let instance = creation.make().unwrap();
    // With states, so that steps go in parts.
    instance.ok(instance.choose("models.inflow", 12));
    instance.initialize();
    if event_mode {
        instance.update_discrete_states();
        instance.enter_step_mode();
    }
    instance
}

/// The rotor descends ever faster, into the vortex ring.
fn descend() -> Option<OnUpdate> {
    Some(Box::new(|instance: &Instance3, update: Update| {
        if update.asks_for_inputs {
            let speed = -40.0 * update.time;
            instance.ok(instance.set_floats(&["velocity"], &[0.0, 0.0, speed]));
        }
        None
    }))
}

#[test]
fn a_step_returns_early_at_an_event_and_the_new_value_comes_in_event_mode() {
    let instance = made(true, true);
    let (status, stepped) = instance.step_with(0.0, 0.2, descend());
    instance.ok(status);
    assert!(stepped.needs_event && stepped.is_early, "{stepped:?}");
    assert!(stepped.time > 0.001 && stepped.time < 0.19, "{stepped:?}");
    assert_eq!(
        instance.choice("flowState"),
        1,
        "it changes in Event Mode only"
    );
    assert_eq!(instance.float("time"), stepped.time);
    instance.enter_event_mode();
    instance.update_discrete_states();
    assert_eq!(instance.choice("flowState"), 2);
    instance.enter_step_mode();
    let (status, next) = instance.step_with(stepped.time, 0.01, descend());
    instance.ok(status);
    assert!(!next.is_early && !next.needs_event, "{next:?}");

    // The event is where it is in steps that are a hundredth as long.
    let fine = made(true, false);
    let mut time = 0.0;
    loop {
        let (status, stepped) = fine.step_with(time, 1e-4, descend());
        fine.ok(status);
        time = stepped.time;
        if stepped.needs_event {
            break;
        }
    }
    assert!(
        (time - stepped.time).abs() < 5e-4,
        "{time} {}",
        stepped.time
    );
}

/// While the inputs are held the wake grows, and with it the thrust and the flow state change.
#[test]
fn a_step_with_held_inputs_returns_early_at_an_event_too() {
    let early = (4..100).find_map(|quarters| {
        let creation = Creation3 {
            event_mode: true,
            early_return: true,
            ..Creation3::default()
        };
        let instance = creation.make().unwrap();
        instance.ok(instance.choose("models.inflow", 12));
        instance.initialize();
        instance.update_discrete_states();
        let climb = -0.25 * f64::from(quarters);
        instance.ok(instance.set_floats(&["velocity"], &[0.0, 0.0, climb]));
        instance.update_discrete_states();
        let before = instance.choice("flowState");
        instance.enter_step_mode();
        let stepped = instance.step(0.0, 0.2);
        stepped.is_early.then_some((instance, stepped, before))
    });
    let (instance, stepped, before) = early.expect("in some descent the flow state changes");
    assert!(stepped.needs_event, "{stepped:?}");
    assert!(stepped.time > 0.0 && stepped.time < 0.2, "{stepped:?}");
    assert_eq!(instance.float("time"), stepped.time);
    assert_eq!(instance.choice("flowState"), before);
    instance.enter_event_mode();
    instance.update_discrete_states();
    assert_ne!(instance.choice("flowState"), before);
}

#[test]
fn without_early_return_the_event_is_told_at_the_end_of_the_step() {
    let instance = made(true, false);
    let (status, stepped) = instance.step_with(0.0, 0.2, descend());
    instance.ok(status);
    assert!(stepped.needs_event && !stepped.is_early);
    assert_eq!(stepped.time, 0.2);
    assert_eq!(instance.choice("flowState"), 1);
    // An importer that does not handle it gets on, and is told again.
    let again = instance.step(0.2, 0.01);
    assert!(again.needs_event && !again.is_early);
}

#[test]
fn without_event_mode_the_value_changes_by_itself() {
    let instance = made(false, true);
    let (status, stepped) = instance.step_with(0.0, 0.2, descend());
    instance.ok(status);
    assert!(!stepped.needs_event && !stepped.is_early);
    assert!(instance.choice("flowState") > 1);
    // SAFETY: the instance lives.
    let status = unsafe { (instance.functions.fmi3EnterEventMode)(instance.pointer) };
    assert!(instance.refused(status).contains("eventModeUsed"));
}

#[test]
fn in_event_mode_outputs_follow_the_inputs() {
    let instance = made(true, false);
    let before = instance.float("thrust");
    instance.set("collective", 0.2);
    assert_eq!(instance.float("thrust"), before, "that of the last step");
    instance.enter_event_mode();
    assert!(instance.float("thrust") > before);
    instance.update_discrete_states();
    instance.enter_step_mode();
}

#[test]
fn a_state_with_a_held_value_keeps_it_until_the_event() {
    let instance = made(true, false);
    instance.step_with(0.0, 0.2, descend());
    let bytes = instance.serialized();
    let other = made(true, false);
    other.ok(other.continue_from(&bytes));
    assert_eq!(other.choice("flowState"), 1);
    assert!(other.step(0.2, 0.01).needs_event);
    other.enter_event_mode();
    other.update_discrete_states();
    assert!(other.choice("flowState") > 1);
}

/// A descent into the vortex ring.
fn descending(instance: &Instance3) {
    instance.ok(instance.set_floats(&["velocity"], &[0.0, 0.0, -5.0]));
}

/// Makes another instance continue from the state of one.
fn continued(from: &Instance3, other: Instance3) -> Instance3 {
    other.ok(other.continue_from(&from.serialized()));
    other
}

fn fresh(event_mode: bool) -> Instance3 {
    let creation = Creation3 {
        event_mode,
        ..Creation3::default()
    };
    creation.make().unwrap()
}

#[test]
fn a_fresh_instance_that_continues_from_a_step_keeps_the_value_until_the_event() {
    let instance = continued(&made(true, false), fresh(true));
    descending(&instance);
    assert!(instance.step(0.0, 0.01).needs_event);
    assert_eq!(instance.choice("flowState"), 1);
}

#[test]
fn a_stepping_instance_that_continues_from_event_mode_gives_the_new_value_there() {
    let saved = fresh(true);
    saved.initialize();
    let instance = continued(&saved, made(true, false));
    descending(&instance);
    instance.update_discrete_states();
    assert_eq!(instance.choice("flowState"), 2);
}

#[test]
fn a_stepping_instance_that_continues_before_the_initialization_starts_with_the_right_value() {
    for begins in [false, true] {
        let saved = fresh(true);
        if begins {
            saved.begin_initialization();
        }
        let instance = continued(&saved, made(true, false));
        descending(&instance);
        if !begins {
            instance.begin_initialization();
        }
        instance.exit_initialization();
        assert_eq!(instance.choice("flowState"), 2);
    }
}

/// The rotor has nothing to integrate, so that a step computes no new flow state.
#[test]
fn an_instance_without_event_mode_that_continues_from_a_held_value_shows_the_present_one() {
    let saved = fresh(true);
    saved.initialize();
    saved.enter_step_mode();
    descending(&saved);
    assert!(saved.step(0.0, 0.01).needs_event);
    let instance = continued(&saved, fresh(false));
    instance.step(0.01, 0.01);
    assert_eq!(instance.choice("flowState"), 2);
}

#[test]
fn an_instance_without_event_mode_refuses_a_state_that_was_saved_there() {
    let saved = fresh(true);
    saved.initialize();
    let instance = made(false, false);
    let before = instance.serialized();
    let message = instance.refused(instance.continue_from(&saved.serialized()));
    assert!(message.contains("eventModeUsed = true"), "{message}");
    assert_eq!(instance.serialized(), before);
    instance.step(0.0, 0.01);
}

#[test]
fn model_exchange_asks_for_an_event_after_a_step_and_gives_the_new_value_in_event_mode() {
    let instance = Instance3::for_model_exchange();
    instance.initialize();
    instance.update_discrete_states();
    instance.enter_continuous_time();
    let completed = || {
        let (mut event, mut end) = (9, 9);
        let complete = instance.functions.fmi3CompletedIntegratorStep;
        // SAFETY: the instance lives.
        instance.ok(unsafe { complete(instance.pointer, 1, &mut event, &mut end) });
        assert_eq!(end, 0);
        event
    };
    assert_eq!(completed(), 0);
    instance.ok(instance.set_floats(&["velocity"], &[0.0, 0.0, -5.0]));
    assert_eq!(completed(), 1);
    assert_eq!(instance.choice("flowState"), 1);
    instance.enter_event_mode();
    instance.update_discrete_states();
    assert!(instance.choice("flowState") > 1);
    instance.enter_continuous_time();
    assert_eq!(completed(), 0);
}
