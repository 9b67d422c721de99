//! A rotor that a torque turns, and one near the ground.

use crate::support::block::{
    choose, default_block, enable_flapping, get, set, set_integer, set_string,
};
use helicopter_rotor::block::{
    RotorBlock,
    variables::{IntegerRef, RealRef, integer, real, string},
};
use std::f64::consts::PI;

fn block(choices: &[(IntegerRef, &str)], values: &[(RealRef, f64)]) -> RotorBlock {
    let mut block = default_block();
    for (reference, name) in choices {
        choose(&mut block, *reference, name);
    }
    for (reference, value) in values {
        set(&mut block, *reference, *value);
    }
    block
}

const TORQUE: (IntegerRef, &str) = (integer::DRIVE__MODE, "torque");
const SPEED: f64 = 960.0 * PI / 30.0;

#[test]
fn the_torque_that_the_rotor_absorbs_keeps_its_speed() {
    for inflow in ["annulus", "drees", "pittPetersDynamic"] {
        let model = (integer::MODELS__INFLOW, inflow);
        let mut imposed = block(&[model], &[]);
        imposed.start().unwrap();
        let torque = get(&imposed, real::TORQUE);
        let mut free = block(&[model, TORQUE], &[(real::DRIVE_TORQUE, torque)]);
        free.start().unwrap();
        for _ in 0..50 {
            free.step(0.01).unwrap();
        }
        assert!(
            (get(&free, real::ROTOR_SPEED) / 960.0 - 1.0).abs() < 1e-9,
            "{inflow}"
        );
        assert!((get(&free, real::THRUST) / get(&imposed, real::THRUST) - 1.0).abs() < 1e-8);
        assert!((get(&free, real::AZIMUTH) - SPEED * 0.5).abs() < 1e-6);
    }
}

/// J dOmega/dt = torque in air of almost no density: the speed grows linearly and the azimuth
/// quadratically with time. The reaction of the driving torque acts on the hub.
#[test]
fn torque_accelerates_the_inertia() {
    let mut rotor = block(
        &[TORQUE, (integer::AIR__ATMOSPHERE, "userDefined")],
        &[
            (real::AIR__DENSITY, 1e-6),
            (real::DRIVE__INERTIA, 2.5),
            (real::DRIVE_TORQUE, 50.0),
            (real::RPM, 300.0),
        ],
    );
    rotor.start().unwrap();
    for _ in 0..7 {
        rotor.step(0.1).unwrap();
    }
    let speed = 300.0 * PI / 30.0;
    let expected = speed + 20.0 * 0.7;
    let found = get(&rotor, real::ROTOR_SPEED) * PI / 30.0;
    assert!((found - expected).abs() < 1e-5, "{found} {expected}");
    let azimuth = speed * 0.7 + 0.5 * 20.0 * 0.7 * 0.7;
    assert!((get(&rotor, real::AZIMUTH) - azimuth).abs() < 1e-5);
    assert_eq!(get(&rotor, real::HUB_MOMENT_3), -50.0);
    assert!(get(&rotor, real::TORQUE).abs() < 1e-3);
}

/// Any communication step gives the same answer, even while the rotor slows down and the cells of
/// its grid grow.
#[test]
fn the_communication_step_does_not_change_how_the_rotor_slows_down() {
    let after = |steps: &[f64]| {
        let mut rotor = block(
            &[TORQUE, (integer::MODELS__INFLOW, "pittPetersDynamic")],
            &[(real::DRIVE__INERTIA, 0.1), (real::VELOCITY_1, 5.0)],
        );
        enable_flapping(&mut rotor);
        rotor.start().unwrap();
        steps.iter().for_each(|step| rotor.step(*step).unwrap());
        [real::ROTOR_SPEED, real::THRUST, real::CONING].map(|reference| get(&rotor, reference))
    };
    let once = after(&[0.5]);
    assert!(once[0] < 800.0, "it slows down: {once:?}");
    let mut odd = vec![0.0073; 68];
    odd.push(0.5 - 68.0 * 0.0073);
    for steps in [vec![0.001; 500], odd] {
        let cut = after(&steps);
        for (a, b) in once.iter().zip(cut) {
            assert!((a - b).abs() < 1e-7 * a.abs(), "{once:?} {cut:?}");
        }
    }
}

/// In a fast descent the air turns a rotor without an engine. In still air a stopped rotor stays
/// stopped.
#[test]
fn wind_from_below_turns_a_rotor_without_an_engine() {
    let run = |descent: f64, rpm: f64| {
        let mut rotor = block(
            &[TORQUE],
            &[
                (real::RPM, rpm),
                (real::VELOCITY_3, -descent),
                (real::COLLECTIVE, 0.0),
                (real::DRIVE__INERTIA, 0.05),
            ],
        );
        rotor.start().unwrap();
        for _ in 0..400 {
            rotor.step(0.05).unwrap();
        }
        get(&rotor, real::ROTOR_SPEED)
    };
    assert_eq!(run(0.0, 0.0), 0.0);
    let settled = run(9.0, 600.0);
    assert!(settled > 300.0, "{settled}");
    assert!(
        (run(9.0, 1200.0) / settled - 1.0).abs() < 1e-3,
        "from a higher speed, too"
    );
}

/// The PCA-2 autogiro (Wheatley 1934, NACA Report 487, fig. 7) at the measured speed along the
/// disc. The shaft angle is chosen for the measured thrust. Up to mu = 0.4 the rotor settles within
/// 8 % of the measured speed.
///
/// Above, the thrust coefficient explains the difference. Rotor speed is proportional to
/// sqrt(T/CT), and at mu = 0.52 and 0.68 the CT of the autorotating model is too low at the
/// measured mu. The cause is drag that the assumed section does not have, see autogiro.rs.
#[test]
fn an_autogiro_without_an_engine_turns_as_fast_as_measured() {
    let rotor = |rpm: f64, edgewise: f64, alpha: f64| {
        let mut rotor = block(
            &[
                TORQUE,
                (integer::MODELS__INFLOW, "pittPetersDynamic"),
                (integer::MODELS__TIP_LOSS, "wheatley"),
                (integer::AIR__ATMOSPHERE, "userDefined"),
            ],
            &[
                (real::FLAPPING__INERTIA, 452.8),
                (real::DRIVE__INERTIA, 4.0 * 452.8),
                (real::AIR__DENSITY, 1.0823),
                (real::COLLECTIVE, 0.0497),
                (real::RPM, rpm),
                (real::VELOCITY_1, edgewise),
                (real::VELOCITY_3, -edgewise * alpha.tan()),
            ],
        );
        set_string(&mut rotor, string::GEOMETRY__FILE, "pca-2.toml");
        set_integer(&mut rotor, integer::NUMERICS__ELEMENTS, 16);
        enable_flapping(&mut rotor);
        rotor.start().unwrap();
        rotor
    };
    // mu, measured rev/min and CT, and the largest accepted error of the speed.
    for (mu, rpm, thrust_coefficient, within) in [
        (0.113, 141.6, 0.00752, 0.08),
        (0.194, 141.1, 0.00685, 0.08),
        (0.274, 140.2, 0.00668, 0.08),
        (0.399, 140.2, 0.00593, 0.08),
        (0.518, 133.0, 0.00573, 0.1),
        (0.684, 116.8, 0.00557, 0.17),
    ] {
        let tip_speed = rpm * PI / 30.0 * 6.858;
        let wanted = thrust_coefficient * 1.0823 * PI * (6.858 * tip_speed).powi(2);
        // Speed after 15 s, and the mean thrust over the next 0.4 s.
        let settled = |alpha: f64| {
            let mut rotor = rotor(rpm, mu * tip_speed, alpha);
            rotor.step(15.0).unwrap();
            let mut thrust = 0.0;
            for _ in 0..20 {
                rotor.step(0.02).unwrap();
                thrust += get(&rotor, real::THRUST) / 20.0;
            }
            (get(&rotor, real::ROTOR_SPEED), thrust)
        };
        let (mut a, mut b) = (0.42 - 0.5 * mu, 0.40 - 0.5 * mu);
        let mut at_a = settled(a);
        let mut at_b = settled(b);
        for _ in 0..8 {
            if (at_b.1 / wanted - 1.0).abs() < 0.005 {
                break;
            }
            let next = b - (at_b.1 - wanted) * (b - a) / (at_b.1 - at_a.1);
            (a, at_a) = (b, at_b);
            b = next.clamp(b - 0.1, b + 0.1);
            at_b = settled(b);
        }
        let (found, thrust) = at_b;
        let error = found / rpm - 1.0;
        println!(
            "mu {mu}: {found:.1} rev/min, measured {rpm}: {:+.1} %; shaft {:.1} deg, thrust {:.0} N of {wanted:.0}",
            100.0 * error,
            b.to_degrees(),
            thrust
        );
        assert!((thrust / wanted - 1.0).abs() < 0.01, "mu {mu}");
        assert!(error.abs() < within, "mu {mu}: {error}");
    }
}

/// Cheeseman & Bennett: at the same power the ground increases the thrust by the factor
/// 1/(1 - (R/(4 z))^2). An ideal rotor (uniform inflow, no drag) has exactly this factor.
#[test]
fn thrust_near_the_ground_at_the_same_power() {
    for (model, inflow) in [
        ("cheesemanBennett", "uniform"),
        ("cheesemanBennett", "pittPetersDynamic"),
        ("hayden", "uniform"),
    ] {
        let mut rotor = block(
            &[
                (integer::MODELS__INFLOW, inflow),
                (integer::MODELS__GROUND_EFFECT, model),
                (integer::MODELS__LIFT, "twoPi"),
            ],
            &[],
        );
        // Thrust, and the induced power T v, with the induced velocity that the ground reduces.
        let mut ideal = |height: f64, collective: f64| {
            set(&mut rotor, real::HEIGHT_ABOVE_GROUND, height * 0.762);
            set(&mut rotor, real::COLLECTIVE, collective);
            rotor.update().unwrap();
            let thrust = get(&rotor, real::THRUST);
            (thrust, thrust * get(&rotor, real::INDUCED_VELOCITY))
        };
        let (far, power) = ideal(10.0, 0.12);
        for height in [0.5, 1.0, 1.7] {
            let (mut low, mut high) = (0.05, 0.3);
            for _ in 0..60 {
                let middle = 0.5 * (low + high);
                if ideal(height, middle).1 < power {
                    low = middle;
                } else {
                    high = middle;
                }
            }
            let ratio = ideal(height, low).0 / far;
            let expected = if model == "hayden" {
                (0.9926_f64 + 0.0379 * (2.0 / height).powi(2)).powf(2.0 / 3.0)
            } else {
                1.0 / (1.0 - (0.25 / height).powi(2))
            };
            assert!(
                (ratio / expected - 1.0).abs() < 1e-6,
                "{model} {height}: {ratio} {expected}"
            );
        }
    }
}

/// With every inflow model the thrust grows near the ground, continuously with height, and hardly
/// at all in fast flight.
#[test]
fn every_inflow_model_feels_the_ground() {
    for inflow in integer::MODELS__INFLOW.variable().choices {
        let model = (integer::MODELS__INFLOW, *inflow);
        let ground = (integer::MODELS__GROUND_EFFECT, "cheesemanBennett");
        let mut rotor = block(&[model, ground, (integer::MODELS__BLADES, "disc")], &[]);
        if *inflow == "annulusClosedForm" {
            let error = rotor.start().unwrap_err().to_string();
            assert!(error.contains("set another inflow model"), "{error}");
            continue;
        }
        let mut thrust = |height: f64, speed: f64| {
            set(&mut rotor, real::HEIGHT_ABOVE_GROUND, height * 0.762);
            set(&mut rotor, real::VELOCITY_1, speed);
            rotor.update().unwrap();
            get(&rotor, real::THRUST)
        };
        let far = thrust(3.0, 0.0);
        assert_eq!(far, thrust(100.0, 0.0), "{inflow}");
        let mut previous = far;
        for i in (0..60).rev() {
            let near = thrust(0.05 * f64::from(i), 0.0);
            assert!(
                near >= previous && near < 1.06 * previous,
                "{inflow} {i}: {near} {previous}"
            );
            previous = near;
        }
        assert!(previous > 1.1 * far, "{inflow}: {previous} {far}");
        let fast = thrust(0.5, 20.0) / thrust(100.0, 20.0);
        assert!((1.0..1.01).contains(&fast), "{inflow}: {fast}");
    }
}

/// A rotor near the ground that is tilted: half of the gain is gone before 45 deg, and none is left
/// when the shaft lies, nor when the rotor is inverted and blows its wake upwards.
#[test]
fn only_a_wake_that_blows_at_the_ground_feels_it() {
    for inflow in [
        "annulus",
        "uniform",
        "finiteBlades",
        "pittPetersDynamic",
        "petersHe",
    ] {
        let gain = |degrees: f64| {
            let [near, far] = [0.8, 1000.0].map(|height| {
                let model = (integer::MODELS__INFLOW, inflow);
                let ground = (integer::MODELS__GROUND_EFFECT, "cheesemanBennett");
                let mut rotor = block(&[model, ground], &[]);
                set(&mut rotor, real::TILT, degrees.to_radians());
                set(&mut rotor, real::HEIGHT_ABOVE_GROUND, height);
                rotor.update().unwrap();
                get(&rotor, real::THRUST)
            });
            near / far - 1.0
        };
        let upright = gain(0.0);
        assert!((0.02..0.10).contains(&upright), "{inflow}: {upright}");
        let tilted = gain(45.0) / upright;
        assert!((0.2..0.6).contains(&tilted), "{inflow}: {tilted}");
        for degrees in [90.0, 120.0, 180.0] {
            assert!(gain(degrees).abs() < 1e-12, "{inflow} at {degrees} deg");
        }
    }
}
