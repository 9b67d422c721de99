//! Edgewise flow: balances, symmetries and blade-element theory on paper. Blades are rigid; forces
//! and moments are azimuth averages.

use crate::support::{
    DENSITY, SPEED, flight, hover, ideal_models, ideal_rotor, no_loads, reference_force,
};
use nalgebra::Vector3;
use rotor::{
    Blades, Models, OperatingPoint, Rotor,
    geometry::{Geometry, Rotation},
    inflow::{ElementInflow, Inflow, Skew},
};
use std::f64::consts::PI;

const CHORD: f64 = 0.05;
const BLADES: u32 = 4;

/// Untwisted blades without drag, from near the shaft to the tip, averaged over one revolution.
fn disc(inflow: &Inflow, rotation: Rotation) -> Rotor {
    let mut geometry = Geometry::linear(BLADES, 1.0, 0.01, CHORD, 1.0, 0.0);
    geometry.rotation = rotation;
    let models = Models {
        blades: Blades::Disc,
        ..ideal_models(inflow.clone())
    };
    ideal_rotor(geometry, models, 100)
}

fn ideal(inflow: &Inflow) -> Rotor {
    disc(inflow, Rotation::CounterClockwise)
}

fn uniform() -> Rotor {
    ideal(&Inflow::Linear(Skew::Uniform))
}

/// Forward at the advance ratio `mu`.
fn forward(collective: f64, mu: f64) -> OperatingPoint {
    flight(collective, Vector3::new(mu * SPEED, 0.0, 0.0))
}

/// Flight in which controls and motion have no symmetry.
fn unsymmetrical() -> OperatingPoint {
    OperatingPoint {
        cyclic_longitudinal: 0.03,
        cyclic_lateral: -0.02,
        angular_velocity: Vector3::new(1.0, -0.5, 0.3),
        ..flight(0.1, Vector3::new(18.0, 4.0, -1.0))
    }
}

/// sigma a of thin airfoils.
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
        let rotor = ideal(&Inflow::Linear(skew));
        for mu in [0.0, 0.01, 0.1, 0.3, 0.5] {
            for climb in [-0.02, 0.0, 0.05] {
                let point = flight(0.1, Vector3::new(mu, 0.0, climb) * SPEED);
                let loads = rotor.steady(&point).unwrap();
                let resultant = (mu * SPEED).hypot(point.airspeed.z + loads.induced_velocity);
                let momentum = 2.0 * DENSITY * PI * resultant * loads.induced_velocity;
                close(
                    loads.force.z,
                    momentum,
                    1e-9,
                    &format!("{skew:?} {mu} {climb}"),
                );
            }
        }
    }
}

/// Without drag each section's force is perpendicular to the air that meets it, so that the shaft's
/// power is what the force does on the moving hub plus what the thrust gives to the induced flow.
#[test]
fn shaft_power_is_that_of_the_force_on_the_hub_and_of_the_induced_flow() {
    let rotor = uniform();
    for airspeed in [
        Vector3::new(0.0, 0.0, 0.0),
        Vector3::new(20.0, 0.0, 0.0),
        Vector3::new(30.0, -12.0, 4.0),
        Vector3::new(-5.0, 3.0, -2.0),
    ] {
        let loads = rotor.steady(&flight(0.12, airspeed)).unwrap();
        let shaft = loads.torque * SPEED;
        let given = loads.force.dot(&airspeed) + loads.force.z * loads.induced_velocity;
        close(shaft, given, 1e-10, &format!("{airspeed:?}"));
    }
}

/// Leishman 2006, section 3.5.2 (Gessow & Myers 1952, ch. 8), for small angles, uniform inflow and
/// no reversed flow, with sigma a written s:
///
/// ```text
/// CT = s/2 (theta (1/3 + mu^2/2) - lambda/2)
/// CMx = -s/4 (2 mu theta/3 - mu lambda/2)
/// ```
///
/// CMx is the rolling moment of rigid blades to the retreating side; it comes from the sine part of
/// the integrand of CT.
#[test]
fn thrust_and_rolling_moment_are_those_of_small_angle_blade_element_theory() {
    let rotor = uniform();
    for mu in [0.0, 0.1, 0.2] {
        let theta = 0.05;
        let loads = rotor.steady(&forward(theta, mu)).unwrap();
        let lambda = loads.induced_velocity / SPEED;
        let ct = solidity_slope() / 2.0 * (theta * (1.0 / 3.0 + mu * mu / 2.0) - lambda / 2.0);
        close(
            loads.force.z / reference_force(),
            ct,
            0.01,
            &format!("CT at mu {mu}"),
        );
        if mu > 0.0 {
            let roll = -solidity_slope() / 4.0 * mu * (2.0 * theta / 3.0 - lambda / 2.0);
            close(
                loads.moment.x / reference_force(),
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
    let rotor = uniform();
    let unit = solidity_slope() / 16.0 * reference_force();
    let small = 1e-3;
    let with = |change: &dyn Fn(&mut OperatingPoint)| {
        let mut point = hover(0.08);
        change(&mut point);
        rotor.steady(&point).unwrap().moment / (unit * small)
    };
    for (moment, expected, what) in [
        // Pitch is lower on the right, psi = 90 deg: the rotor rolls to the right.
        (
            with(&|point| point.cyclic_longitudinal = small),
            Vector3::<f64>::x(),
            "longitudinal cyclic",
        ),
        // Pitch is lower at the tail, psi = 0: it pitches nose up.
        (
            with(&|point| point.cyclic_lateral = small),
            -Vector3::<f64>::y(),
            "lateral cyclic",
        ),
        (
            with(&|point| point.angular_velocity.x = small * SPEED),
            -Vector3::<f64>::x(),
            "roll rate",
        ),
        (
            with(&|point| point.angular_velocity.y = small * SPEED),
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
    let point = unsymmetrical();
    let (sin, cos) = 0.7_f64.sin_cos();
    let turned = |v: Vector3<f64>| Vector3::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos, v.z);
    let cyclic = turned(Vector3::new(
        point.cyclic_lateral,
        point.cyclic_longitudinal,
        0.0,
    ));
    let other = OperatingPoint {
        cyclic_lateral: cyclic.x,
        cyclic_longitudinal: cyclic.y,
        airspeed: turned(point.airspeed),
        angular_velocity: turned(point.angular_velocity),
        ..point
    };
    for inflow in &[
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Linear(Skew::Drees),
    ] {
        let rotor = ideal(inflow);
        let (a, b) = (rotor.steady(&point).unwrap(), rotor.steady(&other).unwrap());
        assert!((turned(a.force) - b.force).norm() < 1e-12 * a.force.norm());
        assert!((turned(a.moment) - b.moment).norm() < 1e-12 * a.moment.norm());
    }
}

#[test]
fn a_clockwise_rotor_is_the_mirror_image() {
    let point = unsymmetrical();
    // In the plane x z: vectors change the sign of y, vectors of rotation change those of x and z.
    let mirrored = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
    let other = OperatingPoint {
        airspeed: mirrored(point.airspeed),
        angular_velocity: -mirrored(point.angular_velocity),
        ..point
    };
    for inflow in &[
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Linear(Skew::Drees),
        Inflow::PittPetersDynamic,
    ] {
        let rotor = ideal(inflow);
        let a = rotor.steady(&point).unwrap();
        let b = disc(inflow, Rotation::Clockwise).steady(&other).unwrap();
        assert_eq!(mirrored(a.force), b.force);
        assert_eq!(-mirrored(a.moment), b.moment);
        assert_eq!(a.torque, b.torque);
    }
}

/// A rotor that runs down in wind ends with the loads of a stopped one, with every distribution.
#[test]
fn the_linear_models_go_over_to_a_rotor_at_rest_without_a_jump() {
    for skew in Skew::ALL {
        let rotor = ideal(&Inflow::Linear(skew));
        let at = |speed: f64| {
            let point = OperatingPoint {
                speed,
                ..flight(0.14, Vector3::new(15.0, 0.0, 0.0))
            };
            rotor.steady(&point).unwrap()
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

/// So that hover goes over into forward flight without a jump.
#[test]
fn slow_edgewise_flow_changes_the_hover_by_its_square_only() {
    for inflow in &[
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Linear(Skew::Uniform),
        Inflow::Linear(Skew::Coleman),
    ] {
        let rotor = ideal(inflow);
        let thrust = |mu: f64| rotor.steady(&forward(0.1, mu)).unwrap().force.z;
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
        let thrust = |inflow| ideal(&inflow).steady(&forward(0.1, mu)).unwrap().force.z;
        let ratio = thrust(Inflow::Elements(ElementInflow::Annulus))
            / thrust(Inflow::Linear(Skew::Uniform));
        assert!((0.95..1.05).contains(&ratio), "mu {mu}: {ratio}");
    }
}

/// Inflow that grows towards the rear lowers the lift there and pitches the rotor nose up.
#[test]
fn inflow_that_grows_towards_the_rear_pitches_the_rotor_nose_up() {
    let pitch = |skew| {
        ideal(&Inflow::Linear(skew))
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

#[test]
fn a_disc_at_rest_in_still_air_has_no_loads() {
    let point = OperatingPoint {
        speed: 0.0,
        ..hover(0.1)
    };
    for inflow in &[
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Elements(ElementInflow::AnnulusClosedForm),
        Inflow::Linear(Skew::Drees),
    ] {
        assert_eq!(ideal(inflow).steady(&point).unwrap(), no_loads());
    }
}
