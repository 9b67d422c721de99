//! The rotor in axial flow: limits, symmetries and balances that a reader can check on paper.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

use helicopter_rotor::block::{
    RotorBlock,
    variables::{IntegerRef, RealRef, integer, real, string},
};
use nalgebra::Vector3;
use rotor::{
    Blades, Drive, Models, Operation, Performance, Rotor,
    air::Air,
    airfoil::{Airfoil, Lift, SectionModel},
    compressibility::Compressibility,
    flapping::Hinge,
    geometry::Geometry,
    inflow::{Descent, Inflow, ground::GroundEffect},
    tip_loss::TipLoss,
};
use std::{f64::consts::PI, fs, path::PathBuf};

fn resources() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("modelDescription/resources")
}

/// The block with default values and these changes, computed.
fn computed(reals: &[(RealRef, f64)], integers: &[(IntegerRef, i32)]) -> RotorBlock {
    let mut block = RotorBlock::new(resources());
    for (place, value) in reals {
        block.set_reals(&[*place], &[*value]).unwrap();
    }
    for (place, value) in integers {
        block.set_integers(&[*place], &[*value]).unwrap();
    }
    block.update().unwrap();
    block
}

fn output(block: &RotorBlock, place: RealRef) -> f64 {
    block.values().reals[place]
}

fn thrust(reals: &[(RealRef, f64)]) -> f64 {
    output(&computed(reals, &[]), real::THRUST)
}

/// An airfoil without drag, for balances in which drag has no part.
fn frictionless() -> Airfoil {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join(format!(
        "frictionless-{:?}.polar",
        std::thread::current().id()
    ));
    fs::write(
        &file,
        "polar 1\nname none\nreynolds 1e6\n-180 0 0\n0 0 0\n180 0 0\n",
    )
    .unwrap();
    Airfoil::read(&file).unwrap()
}

/// A rotor of flat plates without drag: two blades, R = 1 m, 100 rad/s.
fn ideal(inflow: Inflow, tip_loss: TipLoss, chord: f64) -> Rotor {
    let models = Models {
        inflow,
        descent: Descent::Momentum,
        ground_effect: GroundEffect::None,
        blades: Blades::Automatic,
        hinge: Hinge::default(),
        tip_loss,
        section: SectionModel {
            lift: Lift::TwoPi,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.0,
        },
    };
    Rotor::new(
        Geometry::linear(2, 1.0, 0.1, chord, 1.0, 0.0),
        vec![frictionless()],
        models,
        60,
    )
}

fn fly(rotor: &mut Rotor, collective: f64, climb: f64) -> Performance {
    let operation = Operation {
        collective,
        cyclic_longitudinal: 0.0,
        cyclic_lateral: 0.0,
        speed: 100.0,
        airspeed: Vector3::new(0.0, 0.0, climb),
        angular_velocity: Vector3::zeros(),
        gravity: Vector3::zeros(),
        hinge_spring: 0.0,
        height: 0.0,
        drive: Drive::Speed,
        air: Air::new(1.2, 288.15),
    };
    rotor.steady(&operation).unwrap()
}

/// A well-known code gives no thrust at exactly V = 0, another a dip there.
#[test]
fn thrust_in_hover_lies_on_the_line_between_slow_climb_and_slow_descent() {
    for collective in [-0.1, 0.02, 0.14, 0.3] {
        for inflow in [1, 2] {
            let at = |climb: f64| {
                let reals = [(real::COLLECTIVE, collective), (real::VELOCITY_3, climb)];
                output(
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
fn a_rotor_at_rest_in_still_air_has_no_load() {
    let block = computed(&[(real::RPM, 0.0)], &[]);
    for (place, value) in block.values().reals.iter().enumerate() {
        assert!(value.is_finite(), "{place}");
    }
    assert_eq!(output(&block, real::THRUST), 0.0);
    assert_eq!(output(&block, real::TORQUE), 0.0);
    assert_eq!(output(&block, real::THRUST_COEFFICIENT), 0.0);
}

/// Wind from below on a stopped rotor with flat pitch pushes it up by the drag of its blades.
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
    // The plate's 2.01, and the section's friction at this low Reynolds number.
    let ratio = pushed(10.0) / plate;
    assert!((1.0..1.03).contains(&ratio), "{ratio}");
    assert!((pushed(-10.0) + pushed(10.0)).abs() < 1e-9 * plate);
}

#[test]
fn pitch_of_the_other_sign_mirrors_the_thrust_and_keeps_the_torque() {
    for inflow in [1, 2] {
        let at = |pitch| {
            computed(
                &[(real::COLLECTIVE, pitch)],
                &[(integer::MODELS__INFLOW, inflow)],
            )
        };
        let (up, down) = (at(0.15), at(-0.15));
        let (t, q) = (output(&up, real::THRUST), output(&up, real::TORQUE));
        assert!(t > 0.0 && q > 0.0);
        assert!((output(&down, real::THRUST) / t + 1.0).abs() < 1e-12);
        assert!((output(&down, real::TORQUE) / q - 1.0).abs() < 1e-12);
    }
}

#[test]
fn no_pitch_no_thrust_and_the_torque_of_profile_drag() {
    let block = computed(&[(real::COLLECTIVE, 0.0)], &[]);
    assert_eq!(output(&block, real::THRUST), 0.0);
    // sigma cd0/8 (1 - cutout^4), with cd0 of the file and its correction for Reynolds number
    // between 1 and (Re at the tip/Re at 40 % radius)^0.2.
    let solidity = 4.0 * 0.0508 / (PI * 0.762);
    let least = solidity * 0.01114 / 8.0 * (1.0 - (1.0_f64 / 6.0).powi(4));
    let ratio = output(&block, real::TORQUE_COEFFICIENT) / least;
    assert!((0.95..1.2).contains(&ratio), "{ratio}");
}

/// Glauert's actuator disc, annulus by annulus: the thrust is the flux of axial momentum, the
/// torque that of angular momentum, and without drag the power is that of the thrust in the flow
/// through the disc plus that of the swirl.
#[test]
fn lift_equals_the_momentum_given_to_the_air() {
    for (tip_loss, climb, collective) in [
        (TipLoss::None, 0.0, 0.2),
        (TipLoss::Prandtl, 0.0, 0.2),
        (TipLoss::Prandtl, 5.0, 0.2),
        (TipLoss::None, -40.0, 0.05), // windmill
        (TipLoss::None, 0.0, -0.2),
    ] {
        let mut rotor = ideal(Inflow::Annulus, tip_loss, 0.08);
        fly(&mut rotor, collective, climb);
        let (radii, loads) = rotor.element_loads();
        for (radius, load) in radii.iter().zip(loads) {
            let through = climb + load.induced_velocity;
            let mass = 2.0 * PI * radius * 1.2 * through.abs();
            let momentum = 2.0 * mass * load.mean_induced_velocity;
            assert!(
                (load.thrust - momentum).abs() < 1e-9 * load.thrust.abs(),
                "r = {radius}"
            );
            let rotation = 100.0 * radius;
            // The flow that meets the section has the parts `through` and `in_plane`.
            let in_plane = (load.speed * load.speed - through * through).sqrt();
            let power = load.thrust * through / in_plane * rotation;
            let given = load.torque * 100.0;
            assert!(
                (power - given).abs() < 1e-9 * given.abs(),
                "r = {radius}: {power} {given}"
            );
        }
    }
}

/// For small angles the annulus becomes the closed form, eq. (94): the difference in thrust falls
/// nearly as the square of the pitch (Prandtl's F, with its root at the tip, a little slower).
#[test]
fn the_annulus_tends_to_the_closed_form_for_small_angles() {
    for tip_loss in [TipLoss::None, TipLoss::Prandtl, TipLoss::HalfTipChord] {
        let difference = |pitch: f64| {
            // Solidity in proportion to the pitch keeps the inflow a fixed part of it.
            let thrust = |inflow| {
                fly(&mut ideal(inflow, tip_loss, 0.2 * pitch), pitch, 0.0)
                    .force
                    .z
            };
            (thrust(Inflow::Annulus) / thrust(Inflow::AnnulusClosedForm) - 1.0).abs()
        };
        let (coarse, fine) = (difference(0.2), difference(0.1));
        assert!(coarse < 0.03, "{tip_loss:?}: {coarse}");
        assert!(
            fine < coarse / 3.0,
            "{tip_loss:?}: {coarse} at 0.2 rad, {fine} at 0.1 rad"
        );
    }
}

/// Momentum theory for the disc as a whole, T = 2 rho A (V + v) v, holds for the sum over annuli
/// to the extent that the inflow is uniform; blades of constant chord and pitch are close.
#[test]
fn induced_velocity_in_hover_is_near_that_of_the_actuator_disc() {
    let block = computed(&[], &[(integer::MODELS__TIP_LOSS, 1)]);
    let area = PI * 0.762 * 0.762 * (1.0 - 1.0 / 36.0);
    let disc = (output(&block, real::THRUST) / (2.0 * 1.225 * area)).sqrt();
    let ratio = output(&block, real::INDUCED_VELOCITY) / disc;
    assert!((0.93..1.0).contains(&ratio), "{ratio}");
}

#[test]
fn tilt_turns_the_hub_forces_into_the_ground_frame_and_the_flow_into_the_disc() {
    let tilt = 0.3_f64;
    let block = computed(&[(real::TILT, tilt)], &[]);
    let (t, q) = (output(&block, real::THRUST), output(&block, real::TORQUE));
    for (place, expected) in [
        (real::FORCE_1, t * tilt.sin()),
        (real::FORCE_2, 0.0),
        (real::FORCE_3, t * tilt.cos()),
        (real::MOMENT_1, -q * tilt.sin()),
        (real::MOMENT_3, -q * tilt.cos()),
        (real::HUB_FORCE_3, t),
        (real::HUB_MOMENT_3, -q),
    ] {
        assert!(
            (output(&block, place) - expected).abs() < 1e-12 * t,
            "{}",
            place.variable().name
        );
    }
    // Climbing along the tilted shaft is climb, up to the rounding of the flow along the disc.
    let climb = thrust(&[(real::VELOCITY_3, 3.0)]);
    let along = thrust(&[
        (real::TILT, tilt),
        (real::VELOCITY_1, 3.0 * tilt.sin()),
        (real::VELOCITY_3, 3.0 * tilt.cos()),
    ]);
    assert!((along / climb - 1.0).abs() < 1e-12);
}

#[test]
fn wind_is_the_same_as_moving_against_it_to_the_last_bit() {
    for speed in [-7.0, 0.1, 4.0] {
        let moving = thrust(&[(real::VELOCITY_3, speed), (real::TILT, 0.1)]);
        let blown = thrust(&[(real::WIND_3, -speed), (real::TILT, 0.1)]);
        assert_eq!(moving.to_bits(), blown.to_bits());
    }
}

#[test]
fn clockwise_rotation_mirrors_the_moment_only() {
    let other = computed(&[], &[(integer::GEOMETRY__ROTATION, 2)]);
    let block = computed(&[], &[]);
    for place in [real::THRUST, real::TORQUE, real::POWER, real::FORCE_3] {
        assert_eq!(output(&other, place), output(&block, place));
    }
    assert_eq!(
        output(&other, real::MOMENT_3),
        -output(&block, real::MOMENT_3)
    );
}

#[test]
fn coefficients_follow_their_definitions() {
    let block = computed(&[], &[]);
    let out = |place| output(&block, place);
    let tip_speed = 960.0 * PI / 30.0 * 0.762;
    let force = out(real::AIR_DENSITY) * PI * 0.762 * 0.762 * tip_speed * tip_speed;
    let ct = out(real::THRUST) / force;
    let cp = out(real::POWER) / (force * tip_speed);
    for (place, expected) in [
        (real::THRUST_COEFFICIENT, ct),
        (real::POWER_COEFFICIENT, cp),
        (real::TORQUE_COEFFICIENT, cp),
        (real::FIGURE_OF_MERIT, ct.powf(1.5) / (2.0_f64.sqrt() * cp)),
        (real::POWER, out(real::TORQUE) * 960.0 * PI / 30.0),
        (real::INFLOW_RATIO, out(real::INDUCED_VELOCITY) / tip_speed),
    ] {
        let name = place.variable().name;
        assert!((out(place) / expected - 1.0).abs() < 1e-12, "{name}");
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
            output(&computed(&[], &models), real::THRUST_COEFFICIENT)
        };
        let (standard, fine) = (ct(40), ct(1000));
        assert!(
            (standard / fine - 1.0).abs() < 5e-3,
            "{inflow}: {standard} {fine}"
        );
    }
}

#[test]
fn every_model_is_finite_in_every_direction_of_flow_and_pitch() {
    let mut count = 0;
    let mut block = RotorBlock::new(resources());
    block
        .set_integers(&[integer::NUMERICS__ELEMENTS], &[8])
        .unwrap();
    for models in (0..9 * 2 * 3 * 4).map(|i| [1 + i % 9, 1 + i / 9 % 2, 1 + i / 18 % 3, 1 + i / 54])
    {
        let places = [
            integer::MODELS__INFLOW,
            integer::MODELS__LIFT,
            integer::MODELS__TIP_LOSS,
            integer::MODELS__COMPRESSIBILITY,
        ];
        block.set_integers(&places, &models).unwrap();
        for rpm in [0.0, 1.0, 960.0, 1440.0, 20_000.0] {
            for climb in [-60.0, -9.0, -4.0, -1.0, 0.0, 1e-9, 2.0, 12.0, 30.0] {
                for degrees in (-168..=168).step_by(16) {
                    let reals = [f64::from(degrees).to_radians(), rpm, climb];
                    let places = [real::COLLECTIVE, real::RPM, real::VELOCITY_3];
                    block.set_reals(&places, &reals).unwrap();
                    // Outputs that are not finite are an error.
                    block
                        .update()
                        .unwrap_or_else(|e| panic!("{models:?} {reals:?}: {e}"));
                    count += 1;
                }
            }
        }
    }
    println!("{count} combinations");
}

#[test]
fn thrust_is_a_continuous_function_of_climb_outside_of_the_change_to_the_windmill() {
    // From fast climb to 1.5 hover induced velocities of descent.
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
    let mut block = RotorBlock::new(resources());
    let set = |block: &mut RotorBlock, name: &str| {
        block
            .set_strings(&[string::GEOMETRY__FILE], &[name])
            .unwrap();
    };
    block.update().unwrap();
    let rectangular = output(&block, real::THRUST);
    set(&mut block, "knight-hefner-4.toml");
    block.update().unwrap();
    let rounded = output(&block, real::THRUST);
    assert!(
        rounded < rectangular && rounded > 0.97 * rectangular,
        "{rounded} {rectangular}"
    );
    set(&mut block, "knight-hefner-3.toml");
    block.update().unwrap();
    assert!(
        output(&block, real::THRUST) < 0.9 * rounded,
        "three blades instead of four"
    );
}

#[test]
fn stall_spreads_with_pitch() {
    let stalled = |degrees: f64| {
        let block = computed(&[(real::COLLECTIVE, degrees.to_radians())], &[]);
        (
            output(&block, real::STALLED_RADIUS),
            output(&block, real::STALLED_FRACTION),
        )
    };
    assert_eq!(stalled(8.0), (0.0, 0.0));
    let (some, all) = (stalled(18.0), stalled(30.0));
    assert!(some.1 > 0.0 && some.1 < 1.0 && some.0 < 1.0, "{some:?}");
    assert!(all.1 > some.1, "{some:?} {all:?}");
}

/// The stations are the same computation: their thrust adds up to the rotor's, and each one's
/// lift and drag are those of its angle of attack.
#[test]
fn the_stations_along_the_blade_add_up_to_the_thrust() {
    let block = computed(&[], &[]);
    let at = |stations: [RealRef; 20], i: usize| output(&block, stations[i]);
    let (mut sum, length) = (0.0, 0.762 * (1.0 - 1.0 / 6.0) / 20.0);
    for i in 0..20 {
        let radius = at(real::STATION__RADIUS, i);
        let expected = 1.0 / 6.0 + (i as f64 + 0.5) / 20.0 * 5.0 / 6.0;
        assert!((radius - expected).abs() < 1e-12);
        sum += 4.0 * at(real::STATION__THRUST_PER_LENGTH, i) * length;
        let tip_part = output(&block, real::TIP_MACH) * radius;
        assert!(
            (at(real::STATION__MACH, i) / tip_part - 1.0).abs() < 0.03,
            "{i}"
        );
        let reynolds = output(&block, real::TIP_REYNOLDS) * radius;
        assert!(
            (at(real::STATION__REYNOLDS, i) / reynolds - 1.0).abs() < 0.03,
            "{i}"
        );
        assert!(at(real::STATION__DRAG_COEFFICIENT, i) > 0.01);
        let slope = at(real::STATION__LIFT_COEFFICIENT, i) / at(real::STATION__ANGLE_OF_ATTACK, i);
        assert!((5.0..6.8).contains(&slope), "{i}: {slope}");
    }
    assert!(
        (sum / output(&block, real::THRUST) - 1.0).abs() < 5e-3,
        "{sum}"
    );
}
