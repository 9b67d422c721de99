//! Blades at their azimuths against azimuth averages.

use crate::support::{flight, hover, hub_loads, no_loads, peters_he, published_airfoil, steady};
use nalgebra::Vector3;
use rotor::{
    Blades, HubLoads, Models, OperatingPoint, Rotor, State,
    geometry::{Elements, Geometry},
    inflow::{Descent, ElementInflow, Inflow, Skew},
};
use std::f64::consts::PI;

const ELEMENTS: usize = 40;

/// Three blades with twist and taper.
fn geometry() -> Geometry {
    Geometry::linear(3, 1.0, 0.15, 0.08, 0.7, -0.14)
}

/// With the drag, stall and tip loss of real blades.
fn rotor(inflow: &Inflow, blades: Blades) -> Rotor {
    let models = Models {
        inflow: inflow.clone(),
        blades,
        descent: Descent::Momentum,
        ..Models::default()
    };
    let elements = Elements::new(&geometry(), ELEMENTS);
    let airfoil = published_airfoil("naca0015.polar");
    Rotor::new(geometry(), elements, vec![airfoil], models)
}

fn inflows() -> [Inflow; 6] {
    [
        Inflow::Elements(ElementInflow::Annulus),
        Inflow::Linear(Skew::Uniform),
        Inflow::Linear(Skew::Howlett),
        Inflow::Elements(ElementInflow::FiniteBlades),
        Inflow::PittPetersDynamic,
        peters_he(4, &geometry(), ELEMENTS),
    ]
}

/// Azimuth averages of force, moment and torque, at a given inflow and flapping.
fn azimuth_average(rotor: &Rotor, point: &OperatingPoint, state: &State) -> HubLoads {
    const COUNT: usize = 120;
    let mut mean = no_loads();
    for i in 0..COUNT {
        let mut state = *state;
        state.azimuth = 2.0 * PI * i as f64 / COUNT as f64;
        let loads = hub_loads(rotor, point, &state);
        mean.force += loads.force / COUNT as f64;
        mean.moment += loads.moment / COUNT as f64;
        mean.torque += loads.torque / COUNT as f64;
    }
    mean
}

#[test]
fn in_axial_flow_the_blades_average_to_the_disc() {
    for inflow in &inflows() {
        for climb in [-1.0, 0.0, 1e-6, 4.0] {
            let point = flight(0.2, Vector3::new(0.0, 0.0, climb));
            let (state, expected) = steady(&rotor(inflow, Blades::Disc), &point);
            let mean = azimuth_average(&rotor(inflow, Blades::Individual), &point, &state);
            let part = |a: f64, b: f64| (a / b - 1.0).abs();
            assert!(
                part(mean.force.z, expected.force.z) < 1e-6,
                "{inflow:?} {climb}"
            );
            assert!(
                part(mean.torque, expected.torque) < 1e-6,
                "{inflow:?} {climb}"
            );
            assert!(mean.force.xy().norm() < 1e-9 * expected.force.z);
            assert!(mean.moment.xy().norm() < 1e-9 * expected.force.z);
        }
    }
}

/// Inflow without states follows the loads at each azimuth, and the loads are averaged afterwards.
/// In the disc it follows the averaged loads, which is nearly the same.
#[test]
fn in_forward_flight_the_blades_average_nearly_to_the_disc() {
    for inflow in &inflows() {
        let point = flight(0.2, Vector3::new(20.0, 3.0, 0.5));
        let (state, expected) = steady(&rotor(inflow, Blades::Disc), &point);
        let mean = azimuth_average(&rotor(inflow, Blades::Individual), &point, &state);
        let scale = expected.force.z;
        assert!(
            (mean.force - expected.force).norm() < 0.005 * scale,
            "{inflow:?}"
        );
        assert!(
            (mean.moment - expected.moment).norm() < 0.005 * scale,
            "{inflow:?}"
        );
    }
}

#[test]
fn automatic_is_the_disc_in_axial_flow_and_the_blades_elsewhere() {
    for inflow in &inflows() {
        let state = State::default();
        let by = |blades, point: &OperatingPoint| {
            let rotor = rotor(inflow, blades);
            let loads = hub_loads(&rotor, point, &state);
            (loads, rotor.evaluate(point, &state).is_individual())
        };
        let still = hover(0.2);
        assert_eq!(by(Blades::Automatic, &still), by(Blades::Disc, &still));
        let cyclic = OperatingPoint {
            cyclic_lateral: 0.01,
            ..still
        };
        let rolling = OperatingPoint {
            angular_velocity: Vector3::new(0.1, 0.0, 0.0),
            ..still
        };
        for other in [flight(0.2, Vector3::new(1.0, 0.0, 0.0)), cyclic, rolling] {
            assert_eq!(
                by(Blades::Automatic, &other),
                by(Blades::Individual, &other)
            );
            assert!(by(Blades::Automatic, &other).1);
        }
    }
}
