//! The course of a simulation: time, errors that never latch, reset.

use crate::support::{
    Instance,
    c::{self, Status},
    instance::{bits, reference},
};
use helicopter_rotor::block::variables::{BOOLEANS, INTEGERS, REALS, STRINGS};

/// Something done with an instance.
type Action = fn(&Instance) -> Status;

/// Asserts that a step is refused, and that the simulation goes on as if it had not been asked for.
#[track_caller]
fn step_refused(parts: &[&str], time: f64, size: f64) {
    let run = |bad_step: bool| {
        let instance = Instance::new();
        assert_eq!(instance.set_up(10.0, Some(10.25)), c::OK);
        assert_eq!(instance.enter_initialization(), c::OK);
        assert_eq!(instance.exit_initialization(), c::OK);
        assert_eq!(instance.set_real("collective", 0.2), c::OK);
        assert_eq!(instance.step(10.0, 0.1), c::OK);
        assert_eq!(instance.set_real("collective", 0.1), c::OK);
        if bad_step {
            let before = bits(&instance.reals());
            let message = instance.refused(instance.step(time, size));
            for part in parts {
                assert!(message.contains(part), "{part:?} is not in: {message}");
            }
            assert_eq!(instance.last_time(), 10.1, "{message}");
            assert_eq!(bits(&instance.reals()), before, "{message}");
        }
        assert_eq!(instance.step(10.1, 0.1), c::OK);
        assert_eq!(instance.last_time(), 10.2);
        bits(&instance.reals())
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn steps_that_make_no_sense_are_refused() {
    for size in [0.0, -0.0, -0.1, f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        step_refused(
            &["fmi2DoStep", "communicationStepSize", "positive and finite"],
            10.1,
            size,
        );
    }
    for time in [0.0, 10.0, 10.11, -10.1, f64::NAN, f64::INFINITY, 1e300] {
        step_refused(
            &["currentCommunicationPoint", "10.1 s", "continue from there"],
            time,
            0.1,
        );
    }
    for size in [0.16, 1.0, 1e300] {
        step_refused(&["stopTime = 10.25 s", "shorten it"], 10.1, size);
    }
}

#[test]
fn an_importer_may_add_its_steps_up_with_rounding_errors() {
    let instance = Instance::new();
    assert_eq!(instance.set_up(0.0, Some(1.0)), c::OK);
    assert_eq!(instance.enter_initialization(), c::OK);
    assert_eq!(instance.exit_initialization(), c::OK);
    let mut time = 0.0;
    for i in 0..1000 {
        // Some importers add, some multiply.
        let point = if i % 2 == 0 {
            time
        } else {
            0.001 * f64::from(i)
        };
        assert_eq!(
            instance.step(point, 0.001),
            c::OK,
            "step {i}: {:?}",
            instance.take_log()
        );
        time += 0.001;
    }
    assert!((instance.last_time() - 1.0).abs() < 1e-12);
}

#[test]
fn experiments_that_make_no_sense_are_refused() {
    for (start, stop, part) in [
        (f64::NAN, None, "startTime"),
        (f64::INFINITY, None, "startTime"),
        (0.0, Some(f64::NAN), "stopTime"),
        (1.0, Some(0.5), "stopTime = 0.5 s is before startTime = 1 s"),
    ] {
        let instance = Instance::new();
        let message = instance.refused(instance.set_up(start, stop));
        assert!(
            message.contains(part) && message.contains("pass"),
            "{message}"
        );
        instance.initialize();
        assert_eq!(instance.last_time(), 0.0);
        assert_eq!(instance.step(0.0, 2.0), c::OK);
    }
}

#[test]
fn inputs_may_be_set_before_the_experiment_is_set_up_and_setting_it_up_may_be_left_out() {
    let instance = Instance::new();
    assert_eq!(instance.set_real("collective", 0.2), c::OK);
    assert_eq!(instance.enter_initialization(), c::OK);
    assert_eq!(instance.exit_initialization(), c::OK);
    assert_eq!(instance.real("collective"), 0.2);
    assert_eq!(instance.step(0.0, 0.1), c::OK);
}

#[test]
fn model_exchange_needs_no_experiment_either_and_resets_to_every_default() {
    let fresh = Instance::for_model_exchange();
    fresh.begin_integration();
    let instance = Instance::for_model_exchange();
    assert_eq!(instance.set_real("collective", 0.2), c::OK);
    assert_eq!(instance.enter_initialization(), c::OK);
    assert_eq!(instance.exit_initialization(), c::OK);
    assert_eq!(instance.enter_continuous_time(), c::OK);
    assert_eq!(instance.set_time(3.0), c::OK);
    let mut x = instance.states();
    x[0] = 7.0;
    assert_eq!(instance.set_states(&x), c::OK);
    assert_ne!(bits(&instance.reals()), bits(&fresh.reals()));
    for end in [|_: &Instance| c::OK, |i: &Instance| i.terminate()] {
        assert_eq!(end(&instance), c::OK);
        assert_eq!(instance.reset(), c::OK);
        instance.begin_integration();
        assert_eq!(bits(&instance.reals()), bits(&fresh.reals()));
        assert_eq!(instance.state().serialize(), fresh.state().serialize());
    }
}

#[test]
fn outputs_in_initialization_mode_are_those_of_the_values_set_before() {
    let sets: [Action; 4] = [
        |i| i.set_real("collective", 0.2),
        |i| i.set_real("geometry.radius", 0.8),
        |i| i.set_integer("geometry.numberOfBlades", 3),
        |i| i.set_string("airfoil.file", "naca0015.polar"),
    ];
    let instance = Instance::new();
    instance.begin_initialization();
    let mut thrusts = vec![instance.real("thrust")];
    for set in sets {
        assert_eq!(set(&instance), c::OK);
        let thrust = instance.real("thrust");
        assert!(
            thrust > 0.0 && !thrusts.contains(&thrust),
            "{thrust} after {thrusts:?}"
        );
        thrusts.push(thrust);
    }
    assert_eq!(instance.exit_initialization(), c::OK);
    let reals = bits(&instance.reals());

    // Without reading in between it is the same.
    let instance = Instance::new();
    for set in sets {
        assert_eq!(set(&instance), c::OK);
    }
    instance.initialize();
    assert_eq!(bits(&instance.reals()), reals);
}

#[test]
fn a_failed_initialisation_can_be_mended() {
    let files = STRINGS.iter().filter(|v| v.name.ends_with(".file"));
    for (name, default) in files.map(|v| (v.name, v.start)) {
        let instance = Instance::new();
        assert_eq!(instance.set_string(name, "no-such-file"), c::OK);
        instance.begin_initialization();
        for _ in 0..2 {
            let message = instance.refused(instance.exit_initialization());
            assert!(
                message.contains(name) && message.contains("no-such-file"),
                "{message}"
            );
        }
        let thrust = reference(&REALS, "thrust");
        let message = instance.refused(instance.get_reals(&[thrust], &mut [0.0]));
        assert!(message.contains(name), "{message}");
        assert_eq!(instance.set_string(name, default), c::OK);
        assert_eq!(
            instance.exit_initialization(),
            c::OK,
            "{:?}",
            instance.take_log()
        );
        assert_eq!(instance.step(0.0, 0.1), c::OK);
        let undisturbed = Instance::running();
        assert_eq!(undisturbed.step(0.0, 0.1), c::OK);
        assert_eq!(bits(&instance.reals()), bits(&undisturbed.reals()));
    }
}

#[test]
fn a_reset_restores_every_default_and_the_time_from_every_state() {
    let fresh = Instance::new();
    fresh.begin_initialization();
    let fresh = all_values(&fresh);
    let ways: [(&str, Action); 4] = [
        ("instantiated", |_| c::OK),
        ("Initialization Mode", |i| i.enter_initialization()),
        ("stepComplete", |i| {
            i.enter_initialization() | i.exit_initialization() | i.step(5.0, 1.0)
        }),
        ("terminated", |i| {
            i.enter_initialization() | i.exit_initialization() | i.terminate()
        }),
    ];
    for (state, way) in ways {
        let instance = Instance::new();
        assert_eq!(instance.set_up(5.0, Some(6.0)), c::OK);
        change_everything(&instance);
        if state != "instantiated" {
            // What was set would be refused at the start: a seesaw with a hinge offset.
            assert_eq!(instance.set_integer("flapping.hub", 1), c::OK);
        }
        assert_eq!(way(&instance), c::OK, "{state}: {:?}", instance.take_log());
        assert_eq!(instance.reset(), c::OK, "{state}");
        assert_eq!(instance.enter_initialization(), c::OK, "{state}");
        assert_eq!(all_values(&instance), fresh, "{state}");
        assert_eq!(instance.exit_initialization(), c::OK, "{state}");
        assert_eq!(instance.last_time(), 0.0, "{state}");
        // Nor does the stop time last.
        assert_eq!(instance.step(0.0, 10.0), c::OK, "{state}");
    }
}

/// Sets every input and parameter to another value.
fn change_everything(instance: &Instance) {
    for v in REALS.iter().filter(|v| !v.causality.is_computed()) {
        let other = if v.max.is_finite() {
            v.start + 1e-3 * (v.max - v.start)
        } else {
            0.1
        };
        assert_ne!(other, v.start, "{}", v.name);
        assert_eq!(instance.set_real(v.name, other), c::OK, "{}", v.name);
    }
    for v in INTEGERS.iter().filter(|v| !v.causality.is_computed()) {
        // The last choices go together; some of the others do not.
        let other = match v.choices.len() as i32 {
            0 => v.start - 1,
            last if v.start == last => 1,
            last => last,
        };
        assert_eq!(instance.set_integer(v.name, other), c::OK, "{}", v.name);
    }
    for v in &BOOLEANS {
        let status = instance.set_boolean(v.name, i32::from(!v.start));
        assert_eq!(status, c::OK, "{}", v.name);
    }
    // The last choice of models.lift needs a file of lift slopes.
    for (name, file) in [
        ("geometry.file", "thesis.toml"),
        ("airfoil.file", "naca0015.txt"),
    ] {
        assert_eq!(instance.set_string(name, file), c::OK);
    }
}

/// All variables, outputs as well, in Initialization Mode; inputs and parameters must be at their
/// defaults.
fn all_values(instance: &Instance) -> (Vec<u64>, Vec<i32>, Vec<String>) {
    let reals = instance.reals();
    for (v, value) in REALS.iter().zip(&reals) {
        assert!(
            v.causality.is_computed() || v.start == *value,
            "{} = {value}",
            v.name
        );
    }
    let integers: Vec<i32> = INTEGERS.iter().map(|v| instance.integer(v.name)).collect();
    assert_eq!(integers, INTEGERS.map(|v| v.start));
    let booleans: Vec<i32> = BOOLEANS.iter().map(|v| instance.boolean(v.name)).collect();
    assert_eq!(booleans, BOOLEANS.map(|v| i32::from(v.start)));
    let strings: Vec<String> = STRINGS.iter().map(|v| instance.string(v.name)).collect();
    assert_eq!(strings, STRINGS.map(|v| v.start));
    (bits(&reals), [integers, booleans].concat(), strings)
}

#[test]
fn what_was_set_can_be_read_in_initialization_mode_although_a_file_is_missing() {
    let instance = Instance::new();
    assert_eq!(instance.set_string("airfoil.file", "nowhere.polar"), c::OK);
    instance.begin_initialization();
    assert_eq!(instance.real("geometry.radius"), 0.762);
    let mut thrust = [0.0];
    let thrust_place = reference(&REALS, "thrust");
    assert_eq!(instance.get_reals(&[thrust_place], &mut thrust), c::ERROR);
    assert!(instance.take_log()[0].message.contains("nowhere.polar"));
    assert_eq!(instance.set_string("airfoil.file", "naca0015.polar"), c::OK);
    assert!(instance.real("thrust") > 0.0);
}
