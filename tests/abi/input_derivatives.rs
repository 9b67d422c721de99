//! Inputs that move within a step, by fmi2SetRealInputDerivatives.

use crate::support::{
    Instance,
    c::{self, Status},
    instance::{bits, reference},
};
use helicopter_rotor::block::variables::{Causality, INTEGERS, REALS};
use std::{f64::consts::PI, ptr};

/// Runs after the choices of inflow by name, flapping, and drive by torque.
fn running(inflow: &str, flapping: bool, is_driven: bool) -> Instance<'static> {
    let instance = Instance::new();
    let choices = INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices;
    let number = choices.iter().position(|c| *c == inflow).unwrap() as i32 + 1;
    assert_eq!(instance.set_integer("models.inflow", number), c::OK);
    assert_eq!(
        instance.set_boolean("flapping.enabled", flapping.into()),
        c::OK
    );
    assert_eq!(
        instance.set_integer("drive.mode", 1 + i32::from(is_driven)),
        c::OK
    );
    assert_eq!(instance.set_real("driveTorque", 3.0), c::OK);
    assert_eq!(instance.set_real("velocity[1]", 10.0), c::OK);
    // Large steps inside, so that their error shows.
    assert_eq!(instance.set_real("numerics.azimuthStep", 0.2), c::OK);
    instance.initialize();
    instance
}

/// Every input's slope per second: collective, cyclic, speed, tilt, flight and torque all move.
const RAMP: [(&str, f64); 8] = [
    ("collective", 0.4),
    ("cyclicLongitudinal", 0.3),
    ("rpm", 900.0),
    ("tilt", -0.5),
    ("velocity[1]", 20.0),
    ("wind[3]", -8.0),
    ("angularVelocity[1]", 1.0),
    ("driveTorque", 20.0),
];

const DURATION: f64 = 0.08;

/// States and loads at the end of the ramp, made in `steps` steps, with the derivatives or as a
/// staircase with the inputs of the middle of each step, which is of second order.
fn ramped(instance: &Instance, steps: u32, is_smooth: bool) -> Vec<f64> {
    let size = DURATION / f64::from(steps);
    let starts = RAMP.map(|(name, _)| instance.real(name));
    for i in 0..steps {
        let begin = f64::from(i) * size;
        for ((name, slope), start) in RAMP.into_iter().zip(starts) {
            let at = if is_smooth { begin } else { begin + 0.5 * size };
            assert_eq!(instance.set_real(name, start + slope * at), c::OK);
            if is_smooth {
                assert_eq!(instance.set_slope(name, slope), c::OK);
            }
        }
        assert_eq!(
            instance.step(begin, size),
            c::OK,
            "{:?}",
            instance.take_log()
        );
    }
    watched(instance)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a - b).abs())
        .fold(0.0, f64::max)
}

/// The answer along a ramp is the limit of ever shorter steps with constant inputs, and each
/// halving of the steps brings it closer by the third order of the method, which only inputs at the
/// method's own moments do.
#[test]
fn steps_along_a_ramp_converge_with_order_three_to_the_staircase_of_ever_shorter_steps() {
    for (inflow, is_driven) in [("pittPetersDynamic", true), ("uniform", false)] {
        let fly = |steps, smooth| ramped(&running(inflow, true, is_driven), steps, smooth);
        let limit = fly(2048, true);
        let errors = [64, 128, 256].map(|steps| distance(&fly(steps, true), &limit));
        // The kinks of the airfoil table, which is linear between its points, disturb a single
        // halving.
        let order = libm::log2(errors[0] / errors[2]) / 2.0;
        let held = distance(&held(&running(inflow, true, is_driven), 256), &limit);
        println!("{inflow}: {errors:?}, order {order}, held {held}");
        // A difference in the limit itself would keep the errors from falling so.
        assert!((2.7..3.7).contains(&order), "{inflow}: {order}");
        // Constant inputs of the beginning of each step are far off.
        assert!(errors[2] < 0.3 * held, "{inflow}: {errors:?} {held}");
        let staircase = distance(&fly(1024, false), &limit);
        assert!(staircase < 0.01 * held, "{inflow}: {staircase} {held}");
    }
}

/// The fast states of Peters & He shorten the internal steps, so that one long step is close
/// already.
#[test]
fn one_step_along_a_ramp_is_close_to_the_staircase_of_short_steps_in_the_dynamic_wake() {
    for (flapping, is_driven) in [(true, false), (false, true)] {
        let instance = || running("petersHe", flapping, is_driven);
        let staircase = ramped(&instance(), 1024, false);
        let one = distance(&ramped(&instance(), 1, true), &staircase);
        let held = distance(&held(&instance(), 32), &staircase);
        println!("{one} {held}");
        assert!(one < 0.02 * held, "{one} {held}");
    }
}

/// As `ramped` without derivatives and with the inputs of the beginning of each step.
fn held(instance: &Instance, steps: u32) -> Vec<f64> {
    let size = DURATION / f64::from(steps);
    let starts = RAMP.map(|(name, _)| instance.real(name));
    for i in 0..steps {
        let begin = f64::from(i) * size;
        for ((name, slope), start) in RAMP.into_iter().zip(starts) {
            assert_eq!(instance.set_real(name, start + slope * begin), c::OK);
        }
        assert_eq!(instance.step(begin, size), c::OK);
    }
    watched(instance)
}

fn watched(instance: &Instance) -> Vec<f64> {
    let names = [
        "azimuth",
        "state.rotorSpeed",
        "state.inflow[1]",
        "state.inflow[2]",
    ];
    let flaps = ["state.flapAngle[1]", "state.flapRate[2]"];
    names
        .iter()
        .chain(&flaps)
        .map(|name| instance.real(name))
        .collect()
}

#[test]
fn the_azimuth_is_the_exact_integral_of_a_speed_that_changes_linearly() {
    for (inflow, flapping) in [
        ("annulus", false),
        ("uniform", false),
        ("pittPetersDynamic", false),
        ("petersHe", true),
    ] {
        let instance = running(inflow, flapping, false);
        let mut time = 0.0;
        let mut azimuth = 0.0;
        for (size, slope) in [(0.1, 1000.0), (0.03, -400.0), (0.05, 0.0)] {
            let rpm = instance.real("rpm");
            assert_eq!(instance.set_slope("rpm", slope), c::OK);
            assert_eq!(instance.step(time, size), c::OK);
            time += size;
            azimuth += (rpm + 0.5 * slope * size) * PI / 30.0 * size;
            let found = instance.real("azimuth");
            assert!(
                (found / azimuth - 1.0).abs() < 1e-13,
                "{inflow}: {found} {azimuth}"
            );
            assert!((instance.real("rotorSpeed") - rpm - slope * size).abs() < 1e-9);
        }
    }
}

#[test]
fn after_the_step_the_inputs_stand_at_its_end_and_the_outputs_belong_to_them() {
    let instance = running("uniform", false, false);
    let start = instance.real("collective");
    assert_eq!(instance.set_slope("collective", 0.5), c::OK);
    assert_eq!(instance.real("collective"), start, "not before the step");
    assert_eq!(instance.step(0.0, 0.1), c::OK);
    let end = start + 0.5 * 0.1;
    assert_eq!(instance.real("collective"), end);
    let loads = |i: &Instance| {
        let names = ["thrust", "torque", "azimuth", "hubMoment[1]"];
        names.map(|name| i.real(name).to_bits())
    };
    let other = running("uniform", false, false);
    assert_eq!(other.set_real("collective", end), c::OK);
    assert_eq!(other.step(0.0, 0.1), c::OK);
    assert_eq!(loads(&instance), loads(&other));
    // The derivative belonged to that step alone.
    assert_eq!(instance.step(0.1, 0.1), c::OK);
    assert_eq!(instance.real("collective"), end);
    assert_eq!(other.step(0.1, 0.1), c::OK);
    assert_eq!(loads(&instance), loads(&other));
}

#[test]
fn derivatives_of_zero_are_constant_inputs_to_the_bit() {
    let (one, other) = (
        running("petersHe", true, true),
        running("petersHe", true, true),
    );
    for i in 0..5 {
        for (name, _) in RAMP {
            assert_eq!(one.set_slope(name, 0.0), c::OK);
        }
        for instance in [&one, &other] {
            assert_eq!(instance.step(0.013 * f64::from(i), 0.013), c::OK);
        }
        assert_eq!(bits(&one.reals()), bits(&other.reals()));
    }
}

#[test]
fn derivatives_may_be_set_before_the_value_and_before_the_initialisation() {
    let set = |early: bool| {
        let instance = Instance::new();
        if early {
            assert_eq!(instance.set_slope("collective", 0.3), c::OK);
            assert_eq!(instance.set_real("collective", 0.1), c::OK);
            instance.initialize();
        } else {
            assert_eq!(instance.set_real("collective", 0.1), c::OK);
            instance.begin_initialization();
            assert_eq!(instance.set_slope("collective", 0.3), c::OK);
            assert_eq!(instance.exit_initialization(), c::OK);
        }
        assert_eq!(instance.step(0.0, 0.1), c::OK);
        assert_eq!(instance.real("collective"), 0.1 + 0.3 * 0.1);
        bits(&instance.reals())
    };
    assert_eq!(set(true), set(false));
}

/// Asserts that a call is refused and that the next step is that of constant inputs.
#[track_caller]
fn refused(parts: &[&str], call: impl Fn(&Instance) -> Status) {
    let instance = Instance::running();
    let message = instance.refused(call(&instance));
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in: {message}");
    }
    assert_eq!(instance.step(0.0, 0.1), c::OK);
    let undisturbed = Instance::running();
    assert_eq!(undisturbed.step(0.0, 0.1), c::OK);
    assert_eq!(
        bits(&instance.reals()),
        bits(&undisturbed.reals()),
        "{message}"
    );
}

#[test]
fn only_finite_first_derivatives_of_inputs_are_taken() {
    let collective = reference(&REALS, "collective");
    for order in [0, 2, 3, -1, i32::MAX] {
        refused(&["order", &order.to_string(), "first derivatives"], |i| {
            i.set_input_derivatives(&[collective], &[order], &[0.1])
        });
    }
    refused(&["order = 2"], |i| {
        i.set_input_derivatives(&[collective, 1], &[1, 2], &[0.1, 0.1])
    });
    for v in REALS.iter().filter(|v| v.causality != Causality::Input) {
        refused(&[v.name, "not an input"], |i| i.set_slope(v.name, 0.1));
    }
    for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        refused(&["rpm", "finite"], |i| {
            i.set_input_derivatives(&[collective, 1], &[1, 1], &[0.1, value])
        });
    }
    refused(&["value reference 9999"], |i| {
        i.set_input_derivatives(&[9999], &[1], &[0.1])
    });
    let set = |i: &Instance, order: *const i32, value: *const f64| {
        let set = i.functions.fmi2SetRealInputDerivatives;
        // SAFETY: the functions must not touch what is null.
        unsafe { set(i.component, &collective, 1, order, value) }
    };
    refused(&["order is a null pointer"], |i| set(i, ptr::null(), &0.1));
    refused(&["value is a null pointer"], |i| set(i, &1, ptr::null()));
}

/// A ramp stops at the end of the input's range, with one warning.
#[test]
fn inputs_do_not_leave_their_ranges_within_a_step() {
    let instance = Instance::running();
    assert_eq!(instance.set_real("rpm", 100.0), c::OK);
    for i in 0..2 {
        assert_eq!(instance.set_slope("rpm", -1000.0), c::OK);
        assert_eq!(instance.step(0.2 * f64::from(i), 0.2), c::OK);
        assert_eq!(instance.real("rpm"), 0.0);
        let log = instance.take_log();
        assert_eq!(log.len(), 1 - i as usize, "{log:?}");
        if let [line] = &log[..] {
            assert_eq!(line.category, "logStatusWarning");
            assert!(
                line.message.contains("rpm = -100 rev/min is out"),
                "{line:?}"
            );
        }
    }
    // It stands still at the end of the step, and turned while it ran: 0.1 s at a mean of 50
    // rev/min.
    let at = [reference(&REALS, "azimuth")];
    let mut rate = [9.0];
    assert_eq!(instance.output_derivatives(&at, &[1], &mut rate), c::OK);
    assert_eq!(rate, [0.0]);
    let turned = 50.0 * PI / 30.0 * 0.1;
    assert!((instance.real("azimuth") - turned).abs() < 1e-12);
    // Very fast ones, too.
    assert_eq!(instance.set_slope("rpm", 1e308), c::OK);
    assert_eq!(instance.set_slope("heightAboveGround", -1e308), c::OK);
    assert_eq!(instance.step(0.4, 1e-3), c::OK, "{:?}", instance.take_log());
    assert_eq!(instance.real("rpm"), 1e6);
}

/// A failed step keeps what was set for it.
#[test]
fn a_refused_step_keeps_the_derivatives_for_the_next() {
    let run = |fails: bool| {
        let instance = Instance::running();
        assert_eq!(instance.set_slope("collective", 0.5), c::OK);
        if fails {
            instance.refused(instance.step(7.0, 0.1));
            instance.refused(instance.step(0.0, -0.1));
        }
        assert_eq!(instance.step(0.0, 0.1), c::OK);
        bits(&instance.reals())
    };
    assert_eq!(run(true), run(false));
}
