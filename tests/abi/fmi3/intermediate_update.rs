//! Inputs that the importer sets within a step, and outputs that it reads there.

use crate::support::{
    Fmu, Instance, Instance3, c,
    instance3::{Creation3, OnUpdate, Update, variable},
};
use std::{cell::RefCell, rc::Rc};

fn made(required: &[&'static str], early_return: bool) -> Instance3 {
    let creation = Creation3 {
        required: required.to_vec(),
        has_callback: true,
        early_return,
        ..Creation3::default()
    };
    creation.make().unwrap()
}

/// A rotor whose inflow has states, in forward flight.
fn dynamic(instance: &Instance3) {
    instance.ok(instance.choose("models.inflow", 12));
    instance.ok(instance.set_floats(&["velocity"], &[8.0, 0.0, 0.0]));
    instance.initialize();
}

/// Sets the collective pitch as a function of time.
fn moving(collective: fn(f64) -> f64) -> Option<OnUpdate> {
    Some(Box::new(move |instance: &Instance3, update: Update| {
        if update.asks_for_inputs {
            instance.set("collective", collective(update.time));
        }
        None
    }))
}

/// Thrust after 0.2 s in steps of this size; the inputs move within the steps.
fn thrust(size: f64, collective: fn(f64) -> f64) -> f64 {
    let instance = made(&["collective"], false);
    instance.set("collective", collective(0.0));
    dynamic(&instance);
    for i in 0..(0.2 / size).round() as u32 {
        let (status, _) = instance.step_with(f64::from(i) * size, size, moving(collective));
        instance.ok(status);
    }
    instance.float("thrust")
}

/// As `thrust`, in FMI 2.0 with the inputs' derivatives at the beginnings of the steps.
fn thrust_of_fmi2(size: f64, collective: fn(f64) -> f64) -> f64 {
    let instance = Instance::new();
    assert_eq!(instance.set_integer("models.inflow", 12), c::OK);
    assert_eq!(instance.set_real("velocity[1]", 8.0), c::OK);
    assert_eq!(instance.set_real("collective", collective(0.0)), c::OK);
    instance.initialize();
    for i in 0..(0.2 / size).round() as u32 {
        let time = f64::from(i) * size;
        let slope = (collective(time + size) - collective(time)) / size;
        assert_eq!(instance.set_slope("collective", slope), c::OK);
        assert_eq!(instance.step(time, size), c::OK);
    }
    instance.real("thrust")
}

#[test]
fn inputs_that_move_linearly_are_as_accurate_as_with_the_derivatives_of_fmi_2() {
    let linear = |time: f64| 0.14 + 0.3 * time;
    let exact = thrust_of_fmi2(1e-4, linear);
    for size in [0.02, 0.1] {
        let (three, two) = (
            thrust(size, linear) - exact,
            thrust_of_fmi2(size, linear) - exact,
        );
        assert!(
            three.abs() < 1.1 * two.abs() + 1e-5 * exact,
            "steps of {size} s: {three} and {two} of {exact} N"
        );
        assert!(three.abs() < 2e-4 * exact, "{three} of {exact} N");
    }
    // Held at their first values, they would not be.
    let held = |_: f64| 0.14;
    assert!((thrust(0.1, held) - exact).abs() > 0.1 * exact);
}

/// Rigid static inflow: nothing is integrated, and the end of the step is what was set there.
#[test]
fn without_states_linear_inputs_give_the_same_bits_as_the_derivatives_of_fmi_2() {
    let two = Instance::running();
    let three = made(&["collective"], false);
    three.initialize();
    // Numbers with few digits, so that no step rounds.
    assert_eq!(two.set_real("collective", 0.125), c::OK);
    three.set("collective", 0.125);
    assert_eq!(two.set_slope("collective", 0.25), c::OK);
    assert_eq!(two.step(0.0, 0.125), c::OK);
    let (status, _) = three.step_with(0.0, 0.125, moving(|time| 0.125 + 0.25 * time));
    three.ok(status);
    assert_eq!(three.float("collective"), 0.15625);
    assert_eq!(three.float("thrust"), two.real("thrust"));
    assert_eq!(three.float("azimuth"), two.real("azimuth"));
}

#[test]
fn curved_inputs_are_followed_within_a_step() {
    let curved = |time: f64| 0.14 + 0.05 * (30.0 * time).sin();
    let exact = thrust(1e-3, curved);
    let within = (thrust(0.1, curved) - exact).abs();
    let by_slopes = (thrust_of_fmi2(0.1, curved) - exact).abs();
    assert!(
        within < 2e-3 * exact && by_slopes > 10.0 * within,
        "{within} and {by_slopes} of {exact} N"
    );
}

#[test]
fn the_calls_of_a_step_go_forward_and_name_their_purpose() {
    let instance = made(&["collective", "thrust"], true);
    dynamic(&instance);
    let updates = Rc::new(RefCell::new(Vec::new()));
    let seen = Rc::clone(&updates);
    let record: OnUpdate = Box::new(move |instance, update| {
        assert_ne!(update.asks_for_inputs, update.may_read);
        if update.may_read {
            let (status, values) = instance.get_floats(&["thrust"], 1);
            instance.ok(status);
            assert!(values[0] > 0.0);
        }
        seen.borrow_mut().push(update);
        None
    });
    let (status, stepped) = instance.step_with(0.0, 0.02, Some(record));
    instance.ok(status);
    assert_eq!((stepped.time, stepped.is_early), (0.02, false));
    let updates = updates.borrow();
    assert!(
        updates.len() > 10 && updates.len() % 2 == 0,
        "{}",
        updates.len()
    );
    for pair in updates.chunks(2) {
        let [asked, finished] = pair else { panic!() };
        assert!(asked.asks_for_inputs && !asked.is_finished && !asked.can_return);
        assert!(finished.may_read && finished.is_finished && finished.can_return);
        assert_eq!(asked.time, finished.time);
    }
    assert!(updates.windows(2).all(|pair| pair[0].time <= pair[1].time));
    assert_eq!(updates.last().unwrap().time, 0.02);
}

#[test]
fn the_importer_ends_a_step_early_at_the_time_that_it_names() {
    for (wanted, expected) in [
        (0.0, None),
        (0.013, Some(0.013)),
        (5.0, Some(0.05)),
        (f64::NAN, None),
    ] {
        let instance = made(&["thrust"], true);
        dynamic(&instance);
        let ask: OnUpdate = Box::new(move |_, update| update.may_read.then_some(wanted));
        let (status, stepped) = instance.step_with(0.0, 0.05, Some(ask));
        instance.ok(status);
        match expected {
            Some(time) => assert_eq!(stepped.time, time),
            None => assert!(stepped.time > 0.0 && stepped.time < 0.005, "{stepped:?}"),
        }
        assert_eq!(stepped.is_early, stepped.time < 0.05);
        instance.step(stepped.time, 0.01);
    }
    // Nothing is ended early for an importer that has not allowed it.
    let instance = made(&["thrust"], false);
    dynamic(&instance);
    let ask: OnUpdate = Box::new(|_, update| {
        assert!(!update.can_return);
        Some(update.time)
    });
    let (status, stepped) = instance.step_with(0.0, 0.05, Some(ask));
    instance.ok(status);
    assert_eq!((stepped.time, stepped.is_early), (0.05, false));
}

#[test]
fn a_step_that_fails_half_way_leaves_everything_as_it_was() {
    let instance = made(&["collective"], false);
    // Enough work for a few parts only.
    let budget = variable("numerics.budget").reference;
    let set = instance.functions.fmi3SetInt32;
    // SAFETY: the instance lives.
    instance.ok(unsafe { set(instance.pointer, &budget, 1, &3000, 1) });
    instance.set("collective", 0.14);
    dynamic(&instance);
    // The start has used its budget up, which is a warning.
    instance.take_log();
    let before = instance.all_floats();
    let serialized = instance.serialized();
    let count = Rc::new(RefCell::new(0));
    let calls = Rc::clone(&count);
    let move_on: OnUpdate = Box::new(move |instance, update| {
        *calls.borrow_mut() += 1;
        if update.asks_for_inputs {
            instance.set("collective", 0.14 + update.time);
        }
        None
    });
    let (status, _) = instance.step_with(0.0, 0.5, Some(move_on));
    assert!(instance.refused(status).contains("numerics.budget"));
    assert!(*count.borrow() > 2, "some parts were done");
    assert_eq!(instance.all_floats(), before);
    assert_eq!(instance.serialized(), serialized);
    let (status, stepped) = instance.step_with(0.0, 1e-3, None);
    instance.ok(status);
    assert_eq!(stepped.time, 1e-3);
}

#[test]
fn nothing_but_the_named_variables_is_accessible_and_only_as_the_call_says() {
    let instance = made(&["collective", "thrust"], false);
    dynamic(&instance);
    let count = Rc::new(RefCell::new(0));
    let calls = Rc::clone(&count);
    let try_all: OnUpdate = Box::new(move |instance, update| {
        *calls.borrow_mut() += 1;
        let (f, p) = (instance.functions, instance.pointer);
        let (status, _) = instance.get_floats(&["thrust"], 1);
        let set = instance.set_floats(&["collective"], &[0.15]);
        if update.may_read {
            assert_eq!(status, c::OK);
            assert!(instance.refused(set).contains("inputs are asked for"));
            let (status, _) = instance.get_floats(&["torque"], 1);
            let message = instance.refused(status);
            assert!(message.contains("torque is not among"), "{message}");
            assert!(message.contains("name it there"), "{message}");
            for name in [
                "time",
                "geometry.radius",
                "station.mach",
                "state.rotorSpeed",
            ] {
                let (status, _) = instance.get_floats(&[name], variable(name).count);
                let message = instance.refused(status);
                let expected = format!("{name} cannot be accessed during a step");
                assert!(message.contains(&expected), "{message}");
            }
        } else {
            assert_eq!(set, c::OK);
            assert!(instance.refused(status).contains("outputs may be read"));
            let status = instance.set_floats(&["rpm"], &[1.0]);
            assert!(instance.refused(status).contains("rpm is not among"));
            let status = instance.set_floats(&["thrust"], &[1.0]);
            assert!(instance.refused(status).contains("thrust is computed"));
        }
        // SAFETY: the instance lives.
        unsafe {
            instance.refused((f.fmi3Reset)(p));
            instance.refused((f.fmi3Terminate)(p));
            (f.fmi3FreeInstance)(p);
            assert_eq!(instance.take_log().len(), 1);
            let mut state = std::ptr::null_mut();
            instance.refused((f.fmi3GetFMUState)(p, &mut state));
            let (mut b, mut t) = (0, 0.0);
            let (b, t) = (&raw mut b, &raw mut t);
            instance.refused((f.fmi3DoStep)(p, 0.0, 0.1, 1, b, b, b, t));
        }
        None
    });
    let (status, stepped) = instance.step_with(0.0, 0.002, Some(try_all));
    instance.ok(status);
    assert_eq!(stepped.time, 0.002);
    assert!(*count.borrow() >= 4);
}

/// Without variables that it would access, an importer with a callback gets the numbers of one
/// without.
#[test]
fn a_callback_without_variables_changes_no_number() {
    let (with, without) = (made(&[], false), Instance3::new());
    dynamic(&with);
    dynamic(&without);
    for i in 0..5 {
        let time = 0.01 * f64::from(i);
        let (status, stepped) = with.step_with(time, 0.01, Some(Box::new(|_, _| None)));
        with.ok(status);
        assert_eq!(stepped, without.step(time, 0.01));
        assert_eq!(with.all_floats(), without.all_floats());
    }
}

/// However many steps of the integration fit into a step.
#[test]
fn a_long_step_asks_for_its_inputs_a_thousand_times_at_most() {
    let instance = made(&["collective"], false);
    let (f, p) = (instance.functions, instance.pointer);
    // The cheapest rotor.
    let references = ["numerics.elements", "numerics.budget"].map(|n| variable(n).reference);
    let (r, values) = (references.as_ptr(), [1, i32::MAX]);
    // SAFETY: the instance lives; the pointers are valid for two elements.
    instance.ok(unsafe { (f.fmi3SetInt32)(p, r, 2, values.as_ptr(), 2) });
    let step = instance.float("numerics.azimuthStep");
    let speed = instance.float("rpm") * core::f64::consts::PI / 30.0;
    let duration = 1e4 * step / speed;
    dynamic(&instance);
    let count = Rc::new(RefCell::new(0));
    let calls = Rc::clone(&count);
    let (status, stepped) = instance.step_with(
        0.0,
        duration,
        Some(Box::new(move |_, _| {
            *calls.borrow_mut() += 1;
            None
        })),
    );
    instance.ok(status);
    assert_eq!(stepped.time, duration);
    let pairs = *count.borrow() / 2;
    assert!((900..=1001).contains(&pairs), "{pairs}");
}

/// FMI 2.0 would free it in the middle of its own step.
#[test]
fn a_function_of_fmi_2_cannot_free_an_instance_that_makes_a_step() {
    let instance = made(&["collective"], false);
    dynamic(&instance);
    let free: OnUpdate = Box::new(|instance, _| {
        // SAFETY: refused for an instance of the other version.
        unsafe { (Fmu::shared().functions.fmi2FreeInstance)(instance.pointer) };
        let log = instance.take_log();
        assert_eq!(log.len(), 1);
        assert!(log[0].message.contains("belongs to FMI 2.0"), "{log:?}");
        None
    });
    let (status, _) = instance.step_with(0.0, 0.01, Some(free));
    instance.ok(status);
    instance.step(0.01, 0.01);
}
