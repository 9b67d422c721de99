//! The rotor with flow along its disc: balances, symmetries and blade-element theory on paper. Blades
//! are rigid, forces and moments are means over a turn.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

use helicopter_rotor::block::{
    RotorBlock,
    variables::{RealRef, integer, real},
};
use nalgebra::Vector3;
use rotor::{
    Blades, Drive, Models, Operation, Performance, Rotor,
    air::Air,
    airfoil::{Airfoil, Lift, SectionModel},
    compressibility::Compressibility,
    flapping::Hinge,
    geometry::{Geometry, Rotation},
    inflow::{Descent, Inflow, Skew, ground::GroundEffect},
    tip_loss::TipLoss,
};
use std::{f64::consts::PI, fs, path::PathBuf};

const SPEED: f64 = 100.0;
const DENSITY: f64 = 1.2;
const CHORD: f64 = 0.05;
const BLADES: u32 = 4;

/// A section of thin-airfoil lift without drag.
fn frictionless() -> Airfoil {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let thread = std::thread::current().id();
    let file = folder.join(format!("forward-{}-{thread:?}.polar", std::process::id()));
    fs::write(
        &file,
        "polar 1\nname none\nreynolds 1e6\n-180 0 0\n0 0 0\n180 0 0\n",
    )
    .unwrap();
    let airfoil = Airfoil::read(&file).unwrap();
    fs::remove_file(file).unwrap();
    airfoil
}

fn models(inflow: Inflow) -> Models {
    Models {
        inflow,
        descent: Descent::Momentum,
        ground_effect: GroundEffect::None,
        blades: Blades::Disc,
        hinge: Hinge::default(),
        tip_loss: TipLoss::None,
        section: SectionModel {
            lift: Lift::TwoPi,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.0,
        },
    }
}

/// R = 1 m, from almost the shaft to the tip, without drag and tip loss.
fn ideal(inflow: Inflow) -> Rotor {
    let geometry = Geometry::linear(BLADES, 1.0, 0.01, CHORD, 1.0, 0.0);
    Rotor::new(geometry, vec![frictionless()], models(inflow), 100)
}

fn flight(collective: f64, airspeed: Vector3<f64>) -> Operation {
    Operation {
        collective,
        cyclic_longitudinal: 0.0,
        cyclic_lateral: 0.0,
        speed: SPEED,
        airspeed,
        angular_velocity: Vector3::zeros(),
        gravity: Vector3::zeros(),
        hinge_spring: 0.0,
        height: 0.0,
        drive: Drive::Speed,
        air: Air::new(DENSITY, 288.15),
    }
}

/// Forward at the advance ratio `mu`.
fn forward(collective: f64, mu: f64) -> Operation {
    flight(collective, Vector3::new(mu * SPEED, 0.0, 0.0))
}

/// rho A (Omega R)^2, which is a moment's reference too, with R = 1 m.
fn reference() -> f64 {
    DENSITY * PI * SPEED * SPEED
}

fn solidity_slope() -> f64 {
    f64::from(BLADES) * CHORD / PI * 2.0 * PI
}

fn close(found: f64, expected: f64, part: f64, what: &str) {
    let scale = expected.abs();
    assert!(
        (found - expected).abs() <= part * scale,
        "{what}: {found:e}, expected {expected:e}"
    );
}

/// Glauert: the thrust is the momentum of the resultant flow through the disc.
#[test]
fn glauerts_equation_holds_between_thrust_and_mean_inflow() {
    for skew in Skew::ALL {
        let mut rotor = ideal(Inflow::Disc(skew));
        for mu in [0.0, 0.01, 0.1, 0.3, 0.5] {
            for climb in [-0.02, 0.0, 0.05] {
                let mut operation = forward(0.1, mu);
                operation.airspeed.z = climb * SPEED;
                let p = rotor.steady(&operation).unwrap();
                let resultant = (mu * SPEED).hypot(operation.airspeed.z + p.induced_velocity);
                let momentum = 2.0 * DENSITY * PI * resultant * p.induced_velocity;
                close(p.force.z, momentum, 1e-9, &format!("{skew:?} {mu} {climb}"));
            }
        }
    }
}

/// Without drag each section's force is perpendicular to the air that meets it, so that the shaft's
/// power is what the force does on the moving hub plus what the thrust gives to the induced flow.
#[test]
fn shaft_power_is_that_of_the_force_on_the_hub_and_of_the_induced_flow() {
    let mut rotor = ideal(Inflow::Disc(Skew::Uniform));
    for airspeed in [
        Vector3::new(0.0, 0.0, 0.0),
        Vector3::new(20.0, 0.0, 0.0),
        Vector3::new(30.0, -12.0, 4.0),
        Vector3::new(-5.0, 3.0, -2.0),
    ] {
        let p = rotor.steady(&flight(0.12, airspeed)).unwrap();
        let shaft = p.torque * SPEED;
        let given = p.force.dot(&airspeed) + p.force.z * p.induced_velocity;
        close(shaft, given, 1e-10, &format!("{airspeed:?}"));
    }
}

/// Leishman 2006, section 3.5.2 (Gessow & Myers 1952, ch. 8), for small angles, uniform inflow and no
/// reversed flow, with sigma a written s:
///
/// ```text
/// CT = s/2 (theta (1/3 + mu^2/2) - lambda/2)
/// CMx = -s/4 (2 mu theta/3 - mu lambda/2)
/// ```
///
/// the latter, the rolling moment of rigid blades to the retreating side, from the sine part of the
/// same integrand.
#[test]
fn thrust_and_rolling_moment_are_those_of_small_angle_blade_element_theory() {
    let mut rotor = ideal(Inflow::Disc(Skew::Uniform));
    for mu in [0.0, 0.1, 0.2] {
        let theta = 0.05;
        let p = rotor.steady(&forward(theta, mu)).unwrap();
        let lambda = p.induced_velocity / SPEED;
        let ct = solidity_slope() / 2.0 * (theta * (1.0 / 3.0 + mu * mu / 2.0) - lambda / 2.0);
        close(p.force.z / reference(), ct, 0.01, &format!("CT at mu {mu}"));
        if mu > 0.0 {
            let roll = -solidity_slope() / 4.0 * mu * (2.0 * theta / 3.0 - lambda / 2.0);
            close(
                p.moment.x / reference(),
                roll,
                0.03,
                &format!("roll at mu {mu}"),
            );
        }
    }
}

/// In hover the blade's moment about the hub is the integral of x^3: sigma a/16 times the cyclic
/// pitch, or times the hub's rate over Omega, which it damps.
#[test]
fn cyclic_pitch_and_hub_rates_make_the_moments_of_blade_element_theory_in_hover() {
    let mut rotor = ideal(Inflow::Disc(Skew::Uniform));
    let unit = solidity_slope() / 16.0 * reference();
    let small = 1e-3;
    let mut with = |change: &dyn Fn(&mut Operation)| {
        let mut operation = forward(0.08, 0.0);
        change(&mut operation);
        rotor.steady(&operation).unwrap().moment / (unit * small)
    };
    for (moment, expected, what) in [
        // Pitch is lower on the right, psi = 90 deg: the rotor rolls to the right.
        (
            with(&|o| o.cyclic_longitudinal = small),
            Vector3::<f64>::x(),
            "longitudinal cyclic",
        ),
        // Pitch is lower at the tail, psi = 0: it pitches nose up.
        (
            with(&|o| o.cyclic_lateral = small),
            -Vector3::<f64>::y(),
            "lateral cyclic",
        ),
        (
            with(&|o| o.angular_velocity.x = small * SPEED),
            -Vector3::<f64>::x(),
            "roll rate",
        ),
        (
            with(&|o| o.angular_velocity.y = small * SPEED),
            -Vector3::<f64>::y(),
            "pitch rate",
        ),
    ] {
        let difference = Vector3::new(moment.x - expected.x, moment.y - expected.y, 0.0).norm();
        assert!(difference < 0.02, "{what}: {moment:?}");
    }
}

/// Everything turned about the shaft by the same angle.
#[test]
fn turning_the_whole_problem_turns_forces_and_moments() {
    let operation = Operation {
        cyclic_longitudinal: 0.03,
        cyclic_lateral: -0.02,
        angular_velocity: Vector3::new(1.0, -0.5, 0.3),
        ..flight(0.1, Vector3::new(18.0, 4.0, -1.0))
    };
    let (sin, cos) = 0.7_f64.sin_cos();
    let turned = |v: Vector3<f64>| Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
    let cyclic = turned(Vector3::new(
        operation.cyclic_lateral,
        operation.cyclic_longitudinal,
        0.0,
    ));
    let other = Operation {
        cyclic_lateral: cyclic.x,
        cyclic_longitudinal: cyclic.y,
        airspeed: turned(operation.airspeed),
        angular_velocity: turned(operation.angular_velocity),
        ..operation
    };
    for inflow in [Inflow::Annulus, Inflow::Disc(Skew::Drees)] {
        let mut rotor = ideal(inflow);
        let (a, b) = (
            rotor.steady(&operation).unwrap(),
            rotor.steady(&other).unwrap(),
        );
        assert!((turned(a.force) - b.force).norm() < 1e-12 * a.force.norm());
        assert!((turned(a.moment) - b.moment).norm() < 1e-12 * a.moment.norm());
    }
}

#[test]
fn a_clockwise_rotor_is_the_mirror_image() {
    let operation = Operation {
        cyclic_longitudinal: 0.03,
        cyclic_lateral: -0.02,
        angular_velocity: Vector3::new(1.0, -0.5, 0.3),
        ..flight(0.1, Vector3::new(18.0, 4.0, -1.0))
    };
    // In the plane of symmetry x z: vectors lose the sign of y, those of rotation of x and z.
    let mirrored = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
    let other = Operation {
        airspeed: mirrored(operation.airspeed),
        angular_velocity: -mirrored(operation.angular_velocity),
        ..operation
    };
    for inflow in [
        Inflow::Annulus,
        Inflow::Disc(Skew::Drees),
        Inflow::PittPetersDynamic,
    ] {
        let mut rotor = ideal(inflow);
        let a = rotor.steady(&operation).unwrap();
        let mut geometry = rotor.geometry().clone();
        geometry.rotation = Rotation::Clockwise;
        let mut clockwise = Rotor::new(geometry, vec![frictionless()], models(inflow), 100);
        let b = clockwise.steady(&other).unwrap();
        assert_eq!(mirrored(a.force), b.force);
        assert_eq!(-mirrored(a.moment), b.moment);
        assert_eq!(a.torque, b.torque);
    }
}

/// A rotor that runs down in wind comes to rest as a rotor at rest, with every distribution.
#[test]
fn the_linear_models_go_over_to_a_rotor_at_rest_without_a_jump() {
    for skew in Skew::ALL {
        let mut rotor = ideal(Inflow::Disc(skew));
        let mut at = |speed: f64| {
            let mut operation = flight(0.14, Vector3::new(15.0, 0.0, 0.0));
            operation.speed = speed;
            rotor.steady(&operation).unwrap()
        };
        let rest = at(0.0);
        for speed in [1e-9, 1e-3, 0.1] {
            let slow = at(speed);
            let thrust = slow.force.z / rest.force.z - 1.0;
            let moment = (slow.moment - rest.moment).norm() / rest.force.z;
            assert!(
                thrust.abs() < 0.05 && moment < 0.05,
                "{skew:?} at {speed}: {thrust} {moment}"
            );
        }
    }
}

/// The default model goes over from hover to forward flight without a jump.
#[test]
fn slow_flow_along_the_disc_changes_the_hover_by_its_square_only() {
    for inflow in [
        Inflow::Annulus,
        Inflow::Disc(Skew::Uniform),
        Inflow::Disc(Skew::Coleman),
    ] {
        let mut rotor = ideal(inflow);
        let mut thrust = |mu: f64| rotor.steady(&forward(0.1, mu)).unwrap().force.z;
        let hover = thrust(0.0);
        assert!((thrust(1e-9) / hover - 1.0).abs() < 1e-12, "{inflow:?}");
        let (near, far) = (thrust(1e-4) / hover - 1.0, thrust(2e-4) / hover - 1.0);
        assert!(
            near > 0.0 && (far / near - 4.0).abs() < 0.1,
            "{inflow:?}: {near:e} {far:e}"
        );
    }
}

/// Two theories of the same rotor: the annulus model's thrust is near that of uniform inflow.
#[test]
fn the_annulus_and_the_uniform_disc_agree_on_thrust_in_forward_flight() {
    for mu in [0.0, 0.05, 0.15, 0.3] {
        let thrust = |inflow| ideal(inflow).steady(&forward(0.1, mu)).unwrap().force.z;
        let ratio = thrust(Inflow::Annulus) / thrust(Inflow::Disc(Skew::Uniform));
        assert!((0.95..1.05).contains(&ratio), "mu {mu}: {ratio}");
    }
}

/// Inflow that grows towards the rear lowers the lift there and pitches the rotor nose up.
#[test]
fn inflow_that_grows_towards_the_rear_pitches_the_rotor_nose_up() {
    let pitch = |skew| {
        ideal(Inflow::Disc(skew))
            .steady(&forward(0.1, 0.15))
            .unwrap()
            .moment
            .y
    };
    let uniform = pitch(Skew::Uniform);
    for skew in Skew::ALL.into_iter().skip(1) {
        assert!(pitch(skew) < uniform, "{skew:?}");
    }
}

fn resources() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("modelDescription/resources")
}

#[test]
fn the_block_turns_motion_into_the_hub_frame_and_loads_out_of_it() {
    let mut block = RotorBlock::new(resources());
    let (tilt, lateral) = (0.2_f64, -0.1_f64);
    for (place, value) in [
        (real::TILT, tilt),
        (real::LATERAL_TILT, lateral),
        (real::VELOCITY_1, 12.0),
        (real::VELOCITY_2, 3.0),
        (real::WIND_3, 1.0),
        (real::ANGULAR_VELOCITY_2, 0.2),
    ] {
        block.set_reals(&[place], &[value]).unwrap();
    }
    block.update().unwrap();
    let out = |place: RealRef| block.values().reals[place];
    let axis = Vector3::new(
        tilt.sin() * lateral.cos(),
        -lateral.sin(),
        tilt.cos() * lateral.cos(),
    );
    let force = Vector3::new(out(real::FORCE_1), out(real::FORCE_2), out(real::FORCE_3));
    let moment = Vector3::new(
        out(real::MOMENT_1),
        out(real::MOMENT_2),
        out(real::MOMENT_3),
    );
    close(
        force.dot(&axis),
        out(real::THRUST),
        1e-12,
        "thrust is the force along the shaft",
    );
    close(
        moment.dot(&axis),
        -out(real::TORQUE),
        1e-12,
        "torque is the moment along the shaft",
    );
    let airspeed = Vector3::new(12.0, 3.0, -1.0);
    let edgewise = (airspeed - axis * airspeed.dot(&axis)).norm();
    close(
        out(real::ADVANCE_RATIO),
        edgewise / (960.0 * PI / 30.0 * 0.762),
        1e-12,
        "mu",
    );
    let hub = Vector3::new(
        out(real::HUB_FORCE_1),
        out(real::HUB_FORCE_2),
        out(real::HUB_FORCE_3),
    );
    close(hub.norm(), force.norm(), 1e-12, "a turn keeps the length");
}

#[test]
fn every_inflow_model_without_states_is_finite_at_every_advance_climb_pitch_and_speed() {
    let mut block = RotorBlock::new(resources());
    let set = |block: &mut RotorBlock, place: RealRef, value: f64| {
        block.set_reals(&[place], &[value]).unwrap();
    };
    block
        .set_integers(&[integer::NUMERICS__ELEMENTS], &[8])
        .unwrap();
    let mut count = 0;
    let choices = integer::MODELS__INFLOW.variable().choices;
    for (inflow, name) in (1..).zip(choices) {
        // Those with states have a start to find, which may not be there: tests/sweep.rs.
        if ["pittPetersDynamic", "petersHe"].contains(name) {
            continue;
        }
        block
            .set_integers(&[integer::MODELS__INFLOW], &[inflow])
            .unwrap();
        for rpm in [0.0, 1.0, 480.0, 1440.0] {
            set(&mut block, real::RPM, rpm);
            for edgewise in [0.0, 1e-6, 4.0, 40.0] {
                set(&mut block, real::VELOCITY_1, edgewise);
                for climb in [-12.0, -6.0, -3.0, 0.0, 3.0, 12.0] {
                    set(&mut block, real::VELOCITY_3, climb);
                    for degrees in [-20.0_f64, -3.0, 0.0, 8.0, 25.0, 90.0] {
                        set(&mut block, real::COLLECTIVE, degrees.to_radians());
                        // Outputs that are not finite are an error.
                        block.update().unwrap_or_else(|e| panic!("{name}: {e}"));
                        count += 1;
                    }
                }
            }
        }
    }
    println!("{count} flights");
}

#[test]
fn a_disc_at_rest_in_still_air_answers_nothing() {
    let mut operation = flight(0.1, Vector3::zeros());
    operation.speed = 0.0;
    for inflow in [
        Inflow::Annulus,
        Inflow::AnnulusClosedForm,
        Inflow::Disc(Skew::Drees),
    ] {
        assert_eq!(
            ideal(inflow).steady(&operation).unwrap(),
            Performance::default()
        );
    }
}
