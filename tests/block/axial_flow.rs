//! Axial flow past the default rotor: limits, symmetries and balances that can be checked on paper.

use crate::support::block::{
    choose, computed, default_block, get, set, set_integer, set_string, thrust,
};
use helicopter_rotor::block::variables::{RealRef, integer, real, string};
use std::f64::consts::PI;

/// Hover is no special case. Some codes have no thrust, or a dip in it, at exactly V = 0.
#[test]
fn thrust_in_hover_lies_on_the_line_between_slow_climb_and_slow_descent() {
    for collective in [-0.1, 0.02, 0.14, 0.3] {
        for inflow in [1, 2] {
            let at = |climb: f64| {
                let reals = [(real::COLLECTIVE, collective), (real::VELOCITY_3, climb)];
                get(
                    &computed(&reals, &[(integer::MODELS__INFLOW, inflow)]),
                    real::THRUST,
                )
            };
            let line = 0.5 * (at(-1e-6) + at(1e-6));
            let off = (at(0.0) / line - 1.0).abs();
            assert!(
                off < 1e-9,
                "collective {collective}, inflow model {inflow}: off by {off:e}"
            );
        }
    }
}

#[test]
fn a_stopped_rotor_in_still_air_has_no_load() {
    let block = computed(&[(real::RPM, 0.0)], &[]);
    for (reference, value) in block.values().reals.iter().enumerate() {
        assert!(value.is_finite(), "{reference}");
    }
    assert_eq!(get(&block, real::THRUST), 0.0);
    assert_eq!(get(&block, real::TORQUE), 0.0);
    assert_eq!(get(&block, real::THRUST_COEFFICIENT), 0.0);
}

/// Wind from below pushes a stopped rotor with flat pitch up by the drag of its blades.
#[test]
fn wind_on_a_stopped_rotor_pushes_it_along() {
    let pushed = |wind| {
        thrust(&[
            (real::RPM, 0.0),
            (real::COLLECTIVE, 0.0),
            (real::WIND_3, wind),
        ])
    };
    let blade_area = 4.0 * 0.0508 * 0.762 * 5.0 / 6.0;
    let plate = 0.5 * 1.225 * 100.0 * blade_area * 2.0;
    // The drag coefficient of the plate is 2.01. Friction at this low Reynolds number adds to it.
    let ratio = pushed(10.0) / plate;
    assert!((1.0..1.03).contains(&ratio), "{ratio}");
    assert!((pushed(-10.0) + pushed(10.0)).abs() < 1e-9 * plate);
}

#[test]
fn negative_pitch_changes_the_sign_of_the_thrust_and_keeps_the_torque() {
    for inflow in [1, 2] {
        let at = |pitch| {
            computed(
                &[(real::COLLECTIVE, pitch)],
                &[(integer::MODELS__INFLOW, inflow)],
            )
        };
        let (up, down) = (at(0.15), at(-0.15));
        let (t, q) = (get(&up, real::THRUST), get(&up, real::TORQUE));
        assert!(t > 0.0 && q > 0.0);
        assert!((get(&down, real::THRUST) / t + 1.0).abs() < 1e-12);
        assert!((get(&down, real::TORQUE) / q - 1.0).abs() < 1e-12);
    }
}

#[test]
fn flat_pitch_has_no_thrust_and_the_torque_of_profile_drag() {
    let block = computed(&[(real::COLLECTIVE, 0.0)], &[]);
    assert_eq!(get(&block, real::THRUST), 0.0);
    // sigma cd0/8 (1 - cutout^4) with the file's cd0. The correction for Reynolds number is a
    // factor between 1 and (Re at the tip/Re at 40 % radius)^0.2.
    let solidity = 4.0 * 0.0508 / (PI * 0.762);
    let least = solidity * 0.01114 / 8.0 * (1.0 - (1.0_f64 / 6.0).powi(4));
    let ratio = get(&block, real::TORQUE_COEFFICIENT) / least;
    assert!((0.95..1.2).contains(&ratio), "{ratio}");
}

/// If the inflow is uniform, momentum theory for the whole disc, T = 2 rho A (V + v) v, holds for
/// the sum over annuli. With constant chord and pitch the inflow is nearly uniform.
#[test]
fn induced_velocity_in_hover_is_near_that_of_the_actuator_disc() {
    let block = computed(&[], &[(integer::MODELS__TIP_LOSS, 1)]);
    let area = PI * 0.762 * 0.762 * (1.0 - 1.0 / 36.0);
    let disc = (get(&block, real::THRUST) / (2.0 * 1.225 * area)).sqrt();
    let ratio = get(&block, real::INDUCED_VELOCITY) / disc;
    assert!((0.93..1.0).contains(&ratio), "{ratio}");
}

#[test]
fn coefficients_follow_their_definitions() {
    let block = computed(&[], &[]);
    let out = |reference| get(&block, reference);
    let tip_speed = 960.0 * PI / 30.0 * 0.762;
    let force = out(real::AIR_DENSITY) * PI * 0.762 * 0.762 * tip_speed * tip_speed;
    let ct = out(real::THRUST) / force;
    let cp = out(real::POWER) / (force * tip_speed);
    for (reference, expected) in [
        (real::THRUST_COEFFICIENT, ct),
        (real::POWER_COEFFICIENT, cp),
        (real::TORQUE_COEFFICIENT, cp),
        (real::FIGURE_OF_MERIT, ct.powf(1.5) / (2.0_f64.sqrt() * cp)),
        (real::POWER, out(real::TORQUE) * 960.0 * PI / 30.0),
        (real::INFLOW_RATIO, out(real::INDUCED_VELOCITY) / tip_speed),
    ] {
        let name = reference.variable().name;
        assert!((out(reference) / expected - 1.0).abs() < 1e-12, "{name}");
    }
}

#[test]
fn more_elements_change_the_third_digit_at_most() {
    for inflow in [1, 2] {
        let ct = |elements| {
            let models = [
                (integer::NUMERICS__ELEMENTS, elements),
                (integer::MODELS__INFLOW, inflow),
            ];
            get(&computed(&[], &models), real::THRUST_COEFFICIENT)
        };
        let (standard, fine) = (ct(40), ct(1000));
        assert!(
            (standard / fine - 1.0).abs() < 5e-3,
            "{inflow}: {standard} {fine}"
        );
    }
}

#[test]
fn thrust_is_continuous_in_climb_above_the_windmill_state() {
    // From fast climb to a descent at 1.5 times the induced velocity in hover.
    let at = |climb: f64| thrust(&[(real::VELOCITY_3, climb)]);
    let mut previous = at(10.0);
    for i in 1..=310 {
        let next = at(10.0 - 0.05 * f64::from(i));
        assert!(
            (next - previous).abs() < 0.8,
            "a jump at {} m/s",
            10.0 - 0.05 * f64::from(i)
        );
        previous = next;
    }
}

#[test]
fn the_rotor_file_replaces_the_geometry_and_its_planform_counts() {
    let mut block = default_block();
    block.update().unwrap();
    let rectangular = get(&block, real::THRUST);
    set_string(&mut block, string::GEOMETRY__FILE, "knight-hefner-4.toml");
    block.update().unwrap();
    let rounded = get(&block, real::THRUST);
    assert!(
        rounded < rectangular && rounded > 0.97 * rectangular,
        "{rounded} {rectangular}"
    );
    set_string(&mut block, string::GEOMETRY__FILE, "knight-hefner-3.toml");
    block.update().unwrap();
    assert!(
        get(&block, real::THRUST) < 0.9 * rounded,
        "three blades instead of four"
    );
}

#[test]
fn stall_spreads_with_pitch() {
    let stalled = |degrees: f64| {
        let block = computed(&[(real::COLLECTIVE, degrees.to_radians())], &[]);
        (
            get(&block, real::STALLED_RADIUS),
            get(&block, real::STALLED_FRACTION),
        )
    };
    assert_eq!(stalled(8.0), (0.0, 0.0));
    let (partial, full) = (stalled(18.0), stalled(30.0));
    assert!(
        partial.1 > 0.0 && partial.1 < 1.0 && partial.0 < 1.0,
        "{partial:?}"
    );
    assert!(full.1 > partial.1, "{partial:?} {full:?}");
}

/// The thrust of the stations adds up to the thrust of the rotor, and the lift coefficient of each
/// agrees with its angle of attack.
#[test]
fn the_stations_along_the_blade_add_up_to_the_thrust() {
    let block = computed(&[], &[]);
    let at = |stations: [RealRef; 20], i: usize| get(&block, stations[i]);
    let (mut sum, length) = (0.0, 0.762 * (1.0 - 1.0 / 6.0) / 20.0);
    for i in 0..20 {
        let radius = at(real::STATION__RADIUS, i);
        let expected = 1.0 / 6.0 + (i as f64 + 0.5) / 20.0 * 5.0 / 6.0;
        assert!((radius - expected).abs() < 1e-12);
        sum += 4.0 * at(real::STATION__THRUST_PER_LENGTH, i) * length;
        let tip_part = get(&block, real::TIP_MACH) * radius;
        assert!(
            (at(real::STATION__MACH, i) / tip_part - 1.0).abs() < 0.03,
            "{i}"
        );
        let reynolds = get(&block, real::TIP_REYNOLDS) * radius;
        assert!(
            (at(real::STATION__REYNOLDS, i) / reynolds - 1.0).abs() < 0.03,
            "{i}"
        );
        assert!(at(real::STATION__DRAG_COEFFICIENT, i) > 0.01);
        let slope = at(real::STATION__LIFT_COEFFICIENT, i) / at(real::STATION__ANGLE_OF_ATTACK, i);
        assert!((5.0..6.8).contains(&slope), "{i}: {slope}");
    }
    assert!(
        (sum / get(&block, real::THRUST) - 1.0).abs() < 5e-3,
        "{sum}"
    );
}

/// In steps of 1e-4 rad through zero thrust, with every tip loss: no step of the thrust is larger
/// than twice the largest at either end of the scan.
#[test]
fn thrust_does_not_jump_near_zero_with_any_tip_loss() {
    for inflow in ["uniform", "annulus", "annulusClosedForm"] {
        for tip_loss in integer::MODELS__TIP_LOSS.variable().choices {
            // The closed form jumps where it goes over to the windmill, as the documentation says.
            let climbs: &[f64] = match inflow {
                "annulusClosedForm" => &[0.0],
                _ => &[-2.0, 0.0, 2.0],
            };
            for climb in climbs {
                let mut block = default_block();
                choose(&mut block, integer::MODELS__INFLOW, inflow);
                choose(&mut block, integer::MODELS__TIP_LOSS, tip_loss);
                set_integer(&mut block, integer::NUMERICS__ELEMENTS, 12);
                set(&mut block, real::VELOCITY_3, *climb);
                let thrusts: Vec<f64> = (-600..=600)
                    .map(|i| {
                        set(&mut block, real::COLLECTIVE, 1e-4 * f64::from(i));
                        block.update().unwrap();
                        get(&block, real::THRUST)
                    })
                    .collect();
                let steps: Vec<f64> = thrusts.windows(2).map(|t| (t[1] - t[0]).abs()).collect();
                let largest = |steps: &[f64]| steps.iter().copied().fold(0.0, f64::max);
                let ends = largest(&steps[..50]).max(largest(&steps[1150..]));
                assert!(
                    largest(&steps) < 2.0 * ends,
                    "{inflow} {tip_loss} {climb}: {} {ends}",
                    largest(&steps)
                );
            }
        }
    }
}

/// The squares of these speeds are 0.
#[test]
fn a_rotor_that_hardly_turns_has_hardly_any_load() {
    for inflow in integer::MODELS__INFLOW.variable().choices {
        for rpm in [1e-60, 1e-85, 1e-120, 1e-200] {
            let mut block = default_block();
            choose(&mut block, integer::MODELS__INFLOW, inflow);
            set(&mut block, real::RPM, rpm);
            block.update().unwrap();
            assert!(get(&block, real::THRUST).abs() < 1e-60, "{inflow} {rpm}");
        }
    }
}
