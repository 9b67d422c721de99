//! Model Exchange: states, derivatives, modes, and what may be set when.

use crate::support::{
    Instance,
    c::{self, Status},
    instance::{bits, reference},
};
use helicopter_rotor::block::variables::{INTEGERS, REALS, STATES};
use std::ptr;

/// Forward flight with flapping blades in dynamic inflow, turned by a torque: every kind of state
/// is in use.
fn forward_flight(instance: &Instance) {
    for (name, choice) in [
        ("models.inflow", "pittPetersDynamic"),
        ("drive.mode", "torque"),
    ] {
        choose(instance, name, choice);
    }
    assert_eq!(instance.set_boolean("flapping.enabled", 1), c::OK);
    for (name, value) in [("velocity[1]", 15.0), ("tilt", 0.05), ("driveTorque", 4.0)] {
        assert_eq!(instance.set_real(name, value), c::OK);
    }
}

fn choose(instance: &Instance, name: &str, choice: &str) {
    let choices = INTEGERS[reference(&INTEGERS, name) as usize].choices;
    let number = choices.iter().position(|c| *c == choice).unwrap() as i32 + 1;
    assert_eq!(instance.set_integer(name, number), c::OK);
}

/// In Continuous-Time Mode in forward flight.
fn flying() -> Instance<'static> {
    let instance = Instance::for_model_exchange();
    forward_flight(&instance);
    instance.begin_integration();
    instance
}

/// All Real and flow state values as they are in an instance that goes there directly.
fn values(instance: &Instance) -> (Vec<u64>, i32) {
    (bits(&instance.reals()), instance.integer("flowState"))
}

#[test]
fn the_states_begin_as_those_of_co_simulation_and_their_variables_hold_them() {
    let co_simulation = Instance::new();
    forward_flight(&co_simulation);
    co_simulation.initialize();
    let instance = Instance::for_model_exchange();
    forward_flight(&instance);
    instance.begin_initialization();
    let early = (instance.states(), instance.derivatives());
    assert_eq!(instance.exit_initialization(), c::OK);
    instance.new_discrete_states();
    assert_eq!(bits(&instance.reals()), bits(&co_simulation.reals()));
    assert_eq!(instance.enter_continuous_time(), c::OK);
    let (states, derivatives) = (instance.states(), instance.derivatives());
    assert_eq!(early, (states.clone(), derivatives.clone()));
    let reals = instance.reals();
    for (i, row) in STATES.iter().enumerate() {
        assert_eq!(
            states[i],
            reals[row.value.number() as usize],
            "{}",
            row.value.variable().name
        );
        assert_eq!(
            derivatives[i],
            reals[row.derivative.number() as usize],
            "{}",
            row.value.variable().name
        );
    }
    let nominals = STATES.map(|row| row.nominal);
    assert_eq!(instance.nominals(), nominals);
    // Of 24 and 8 places 3 and 4 are in use; the others are 0 and stay so.
    let in_use = [0, 1, 2, 3, 4, 26, 27, 28, 29, 34, 35, 36, 37];
    for i in 0..STATES.len() {
        let used = in_use.contains(&i);
        assert_eq!(
            derivatives[i] != 0.0,
            used,
            "{}",
            STATES[i].value.variable().name
        );
        assert!(used || states[i] == 0.0);
    }
}

#[test]
fn the_derivative_of_an_angle_is_its_rate_and_the_azimuth_turns_at_the_speed() {
    let instance = flying();
    let mut x = instance.states();
    x[1] = 90.0;
    x[26..30].copy_from_slice(&[0.01, 0.02, 0.03, 0.04]);
    x[34..38].copy_from_slice(&[1.0, -2.0, 3.0, -4.0]);
    assert_eq!(instance.set_states(&x), c::OK);
    assert_eq!(instance.states(), x);
    let rates = instance.derivatives();
    assert_eq!(rates[0], 90.0);
    assert_eq!(rates[26..30], x[34..38]);
    let speed = 90.0 * 30.0 / std::f64::consts::PI;
    assert!((instance.real("rotorSpeed") - speed).abs() < 1e-9);
    assert!((instance.real("coning") - 0.025).abs() < 1e-15);
    // Newton's law for the shaft.
    let torque = instance.real("driveTorque") - instance.real("torque");
    assert!((rates[1] - torque / 1.0).abs() < 1e-12 * torque.abs());
}

/// Whatever is asked in which order, the answers are those for the present inputs and states.
#[test]
fn answers_do_not_depend_on_what_was_asked_before() {
    let instance = flying();
    let start = instance.states();
    let mut other = start.clone();
    other.iter_mut().for_each(|x| *x *= 1.01);
    let thrust = |i: &Instance| i.real("thrust");
    let direct = |x: &[f64], collective: f64| {
        let instance = flying();
        assert_eq!(instance.set_states(x), c::OK);
        assert_eq!(instance.set_real("collective", collective), c::OK);
        (thrust(&instance), instance.derivatives())
    };
    for (x, collective) in [(&other, 0.1), (&start, 0.1), (&start, 0.2), (&other, 0.2)] {
        assert_eq!(instance.set_states(x), c::OK);
        assert_eq!(instance.set_real("collective", collective), c::OK);
        let expected = direct(x, collective);
        assert_eq!(instance.derivatives(), expected.1);
        assert_eq!(thrust(&instance), expected.0);
        assert_eq!(instance.derivatives(), expected.1);
        // States one by one, as the standard allows as well.
        for (row, value) in STATES.iter().zip(&other) {
            assert_eq!(instance.set_reals(&[row.value.number()], &[*value]), c::OK);
        }
        assert_eq!(instance.states(), other);
        assert_eq!(
            (thrust(&instance), instance.derivatives()),
            direct(&other, collective)
        );
    }
}

#[test]
fn time_alone_changes_nothing() {
    let instance = flying();
    let before = values(&instance);
    for time in [0.5, 0.25, -1.0, 1e9] {
        assert_eq!(instance.set_time(time), c::OK);
        assert_eq!(values(&instance), before);
    }
    for time in [f64::NAN, f64::INFINITY] {
        assert!(
            instance
                .refused(instance.set_time(time))
                .contains("finite time")
        );
    }
}

#[test]
fn discrete_outputs_change_at_events_only_and_ask_for_them() {
    let instance = Instance::for_model_exchange();
    choose(&instance, "models.inflow", "uniform");
    instance.begin_integration();
    let normal = instance.integer("flowState");
    assert!(!instance.completed_step());
    // A fast descent is no normal flow.
    assert_eq!(instance.set_real("velocity[3]", -30.0), c::OK);
    let thrust = instance.real("thrust");
    assert_eq!(instance.integer("flowState"), normal, "held");
    assert!(instance.completed_step(), "an event is due");
    assert_eq!(instance.integer("flowState"), normal, "still held");
    assert!(instance.completed_step(), "until there is one");
    assert_eq!(instance.enter_event_mode(), c::OK);
    instance.new_discrete_states();
    let windmill = instance.integer("flowState");
    assert_ne!(windmill, normal);
    assert_eq!(
        instance.real("thrust"),
        thrust,
        "what is continuous does not jump"
    );
    assert_eq!(instance.enter_continuous_time(), c::OK);
    assert!(!instance.completed_step());
    // Back, but before the step is completed.
    assert_eq!(instance.set_real("velocity[3]", 0.0), c::OK);
    assert_eq!(instance.integer("flowState"), windmill);
    assert_eq!(instance.set_real("velocity[3]", -30.0), c::OK);
    assert!(!instance.completed_step());
    // An event without a step before it, and inputs set in it.
    assert_eq!(instance.enter_event_mode(), c::OK);
    assert_eq!(instance.set_real("velocity[3]", 0.0), c::OK);
    instance.new_discrete_states();
    assert_eq!(instance.integer("flowState"), normal);
    // Also without fmi2NewDiscreteStates the mode that follows begins with the present one.
    assert_eq!(instance.set_real("velocity[3]", -30.0), c::OK);
    assert_eq!(instance.enter_continuous_time(), c::OK);
    assert_eq!(instance.integer("flowState"), windmill);
}

#[test]
fn tunable_parameters_are_set_in_event_mode_and_fixed_ones_never() {
    let instance = Instance::for_model_exchange();
    choose(&instance, "air.atmosphere", "userDefined");
    instance.begin_integration();
    let thrust = instance.real("thrust");
    let message = instance.refused(instance.set_real("air.density", 1.0));
    assert!(
        message.contains("air.density") && message.contains("Event Mode"),
        "{message}"
    );
    assert_eq!(instance.real("thrust"), thrust);
    assert_eq!(
        instance.set_real("air.density", 1.225),
        c::OK,
        "its own value"
    );
    assert_eq!(instance.enter_event_mode(), c::OK);
    assert_eq!(instance.set_real("air.density", 1.0), c::OK);
    assert!(instance.real("thrust") < 0.9 * thrust);
    for enter in [Instance::enter_event_mode, Instance::enter_continuous_time] {
        assert_eq!(enter(&instance), c::OK);
        let message = instance.refused(instance.set_real("geometry.radius", 1.0));
        assert!(message.contains("fixed parameter"), "{message}");
        assert_eq!(instance.set_real("geometry.radius", 0.762), c::OK);
    }
}

#[test]
fn states_are_set_in_continuous_time_mode_only() {
    let instance = Instance::for_model_exchange();
    let refused = |instance: &Instance| {
        for row in &STATES {
            let message = instance.refused(instance.set_reals(&[row.value.number()], &[0.1]));
            assert!(message.contains("Continuous-Time Mode"), "{message}");
        }
    };
    refused(&instance);
    instance.begin_initialization();
    refused(&instance);
    assert_eq!(instance.exit_initialization(), c::OK);
    refused(&instance);
    assert_eq!(instance.enter_continuous_time(), c::OK);
    assert_eq!(instance.set_real("state.inflow[3]", 0.1), c::OK);
    let message = instance.refused(instance.set_real("der(azimuth)", 0.1));
    assert!(message.contains("computed by the rotor"), "{message}");
    let together = [reference(&REALS, "azimuth"), reference(&REALS, "rpm")];
    assert_eq!(instance.set_reals(&together, &[1.0, 500.0]), c::OK);
    assert_eq!((instance.states()[0], instance.real("rpm")), (1.0, 500.0));
}

#[test]
fn wrong_states_are_refused_and_leave_the_old_ones() {
    let instance = flying();
    let x = instance.states();
    let before = values(&instance);
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for i in [0, 1, 2, 41] {
            let mut wrong = x.clone();
            wrong[i] = bad;
            let message = instance.refused(instance.set_states(&wrong));
            assert!(
                message.contains(STATES[i].value.variable().name),
                "{message}"
            );
        }
    }
    for count in [0, 1, 41, 43] {
        let message = instance.refused(instance.set_states(&vec![0.0; count]));
        assert!(
            message.contains(&count.to_string()) && message.contains("42"),
            "{message}"
        );
    }
    assert_eq!(values(&instance), before);
    // States that no rotor has: refused when something is asked for, and forgotten with better
    // ones.
    let mut wild = x.clone();
    wild.iter_mut().for_each(|v| *v = 1e300);
    assert_eq!(instance.set_states(&wild), c::OK);
    let status = instance.get_reals(&[reference(&REALS, "thrust")], &mut [0.0]);
    let message = instance.refused(status);
    assert!(message.contains("check the inputs"), "{message}");
    assert_eq!(
        instance.integer("flowState"),
        before.1,
        "what is held can be read"
    );
    assert_eq!(instance.states(), wild);
    assert_eq!(instance.set_states(&x), c::OK);
    assert_eq!(values(&instance), before);
}

#[test]
fn vectors_of_the_wrong_length_and_null_pointers_are_refused() {
    let instance = flying();
    let (f, component) = (instance.functions, instance.component);
    let before = values(&instance);
    let check = |status: Status| {
        let message = instance.refused(status);
        let reasons = ["null pointer", "this FMU has 42", "this FMU has 0"];
        assert!(reasons.iter().any(|r| message.contains(r)), "{message}");
        assert_eq!(values(&instance), before, "{message}");
    };
    let (mut x, mut flag) = ([0.0; 43], 9);
    let (x, null, n) = (x.as_mut_ptr(), ptr::null_mut(), STATES.len());
    let nowhere = ptr::null_mut();
    // SAFETY: the instance lives; the functions must not touch what is null nor go beyond a count.
    unsafe {
        check((f.fmi2GetContinuousStates)(component, x, n + 1));
        check((f.fmi2GetContinuousStates)(component, null, n));
        check((f.fmi2GetDerivatives)(component, x, n - 1));
        check((f.fmi2GetDerivatives)(component, null, n));
        check((f.fmi2GetNominalsOfContinuousStates)(component, x, 0));
        check((f.fmi2GetNominalsOfContinuousStates)(component, null, n));
        check((f.fmi2SetContinuousStates)(component, null, n));
        check((f.fmi2GetEventIndicators)(component, x, 1));
        check((f.fmi2CompletedIntegratorStep)(
            component, 1, nowhere, &mut flag,
        ));
        check((f.fmi2CompletedIntegratorStep)(
            component, 1, &mut flag, nowhere,
        ));
        assert_eq!((f.fmi2GetEventIndicators)(component, null, 0), c::OK);
        assert_eq!((f.fmi2EnterEventMode)(component), c::OK);
        check((f.fmi2NewDiscreteStates)(component, ptr::null_mut()));
    }
    assert_eq!(flag, 9);
}

#[test]
fn the_final_values_can_be_read_after_the_end() {
    let instance = flying();
    let mut x = instance.states();
    x[1] *= 0.9;
    assert_eq!(instance.set_states(&x), c::OK);
    // Nothing was asked of these states before.
    assert_eq!(instance.terminate(), c::OK);
    assert_eq!(instance.states(), x);
    let undisturbed = flying();
    assert_eq!(undisturbed.set_states(&x), c::OK);
    assert_eq!(bits(&instance.reals()), bits(&undisturbed.reals()));
    assert_eq!(instance.reset(), c::OK);
    forward_flight(&instance);
    instance.begin_integration();
    assert_eq!(values(&instance), values(&flying()));
}
