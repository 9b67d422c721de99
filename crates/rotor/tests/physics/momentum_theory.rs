//! Rotors in axial flow against momentum theory.

use crate::support::{
    DENSITY, SPEED, STEP, flight, hover, ideal_models, ideal_rotor, reference_force, steady,
};
use nalgebra::Vector3;
use rotor::{
    Models, Rotor, Start, Workspace,
    geometry::{Geometry, Station},
    inflow::{ElementInflow, Inflow, Skew},
    tip_loss::TipLoss,
};
use std::f64::consts::PI;

/// Two untwisted blades without drag.
fn two_blades(inflow: Inflow, tip_loss: TipLoss, chord: f64) -> Rotor {
    let models = Models {
        tip_loss,
        ..ideal_models(inflow)
    };
    ideal_rotor(Geometry::linear(2, 1.0, 0.1, chord, 1.0, 0.0), models, 60)
}

/// Glauert's actuator disc, annulus by annulus: the thrust is the flux of axial momentum, the
/// torque is that of angular momentum. Without drag the power is that of the thrust in the flow
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
        let rotor = two_blades(Inflow::Elements(ElementInflow::Annulus), tip_loss, 0.08);
        let point = flight(collective, Vector3::new(0.0, 0.0, climb));
        let mut workspace = Workspace::new(&rotor);
        let started = rotor.start(&point, Start::Steady, STEP, &mut workspace);
        let response = rotor.respond(&point, &started.unwrap().state, &mut workspace);
        let blade = response.unwrap().blade;
        for (radius, load) in blade.radii().iter().zip(blade.elements()) {
            let through = climb + load.induced_velocity;
            let mass = 2.0 * PI * radius * DENSITY * through.abs();
            let momentum = 2.0 * mass * load.mean_induced_velocity;
            assert!(
                (load.thrust - momentum).abs() < 1e-9 * load.thrust.abs(),
                "r = {radius}"
            );
            let rotation = SPEED * radius;
            // The flow that meets the section has the parts `through` and `in_plane`.
            let in_plane = (load.speed * load.speed - through * through).sqrt();
            let power = load.thrust * through / in_plane * rotation;
            let given = load.torque * SPEED;
            assert!(
                (power - given).abs() < 1e-9 * given.abs(),
                "r = {radius}: {power} {given}"
            );
        }
    }
}

/// For small angles the annulus becomes the closed form, thesis eq. (94): the difference in thrust
/// falls nearly as the square of the pitch. With Prandtl's F, which has a root at the tip, it falls
/// a little more slowly.
#[test]
fn the_annulus_tends_to_the_closed_form_for_small_angles() {
    for tip_loss in [TipLoss::None, TipLoss::Prandtl, TipLoss::HalfTipChord] {
        let difference = |pitch: f64| {
            // Solidity in proportion to the pitch keeps the inflow a fixed part of it.
            let thrust = |inflow| {
                let rotor = two_blades(inflow, tip_loss, 0.2 * pitch);
                steady(&rotor, &hover(pitch)).1.force.z
            };
            (thrust(Inflow::Elements(ElementInflow::Annulus))
                / thrust(Inflow::Elements(ElementInflow::AnnulusClosedForm))
                - 1.0)
                .abs()
        };
        let (coarse, fine) = (difference(0.2), difference(0.1));
        assert!(coarse < 0.03, "{tip_loss:?}: {coarse}");
        assert!(
            fine < coarse / 3.0,
            "{tip_loss:?}: {coarse} at 0.2 rad, {fine} at 0.1 rad"
        );
    }
}

/// Leishman 2006, section 3.3.3: pitch that grows like 1/r makes the inflow uniform. Without drag
/// and tip loss the power is that of momentum theory: the figure of merit is 1.
#[test]
fn ideal_twist_without_drag_has_a_figure_of_merit_of_1() {
    let cutout = 0.02;
    let mut geometry = Geometry::linear(4, 1.0, cutout, 0.02, 1.0, 0.0);
    let tip_pitch = 0.04;
    geometry.stations = (0..=2000)
        .map(|i| {
            let radius_ratio = cutout + (1.0 - cutout) * f64::from(i) / 2000.0;
            Station {
                radius_ratio,
                chord: 0.02,
                twist: tip_pitch / radius_ratio,
                airfoil: 0,
            }
        })
        .collect();
    geometry.pitch_reference_radius = 1.0;
    for (inflow, below) in [
        // What is left is the cutout: momentum theory knows a whole disc.
        (Inflow::Linear(Skew::Uniform), 1e-3),
        (Inflow::Elements(ElementInflow::FiniteBlades), 2e-3),
        // The annulus also has swirl, which momentum theory leaves out.
        (Inflow::Elements(ElementInflow::Annulus), 5e-3),
    ] {
        let rotor = ideal_rotor(geometry.clone(), ideal_models(inflow.clone()), 400);
        let (_, loads) = steady(&rotor, &hover(tip_pitch));
        let reference = reference_force();
        let (ct, cp) = (loads.force.z / reference, loads.torque / reference);
        let merit = ct.powf(1.5) / (2.0_f64.sqrt() * cp);
        assert!((1.0 - merit).abs() < below, "{inflow:?}: {merit}");
    }
}
