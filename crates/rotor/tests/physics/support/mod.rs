//! Rotors and operating points that the tests of the physics share: R = 1 m and 100 rad/s.

use nalgebra::Vector3;
use rotor::{
    HubLoads, Models, OperatingPoint, Rotor, Start, Started, State, TipPath, Workspace,
    air::Air,
    airfoil::{Airfoil, Lift, SectionModel},
    compressibility::Compressibility,
    geometry::{Elements, Geometry},
    inflow::{Descent, FlowState, Inflow},
    tip_loss::TipLoss,
};
use std::{
    f64::consts::PI,
    path::{Path, PathBuf},
};

/// Omega, rad/s; with R = 1 m the tip speed, m/s, too.
pub const SPEED: f64 = 100.0;
/// Density of the air, kg/m3.
pub const DENSITY: f64 = 1.2;
/// Largest step of the azimuth in the search of a steady start, rad.
pub const STEP: f64 = PI / 180.0;

fn package() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// An airfoil without drag. The lift comes from `Lift::TwoPi`.
pub fn frictionless() -> Airfoil {
    read(package().join("tests/data/frictionless.polar"))
}

/// An airfoil of the FMU.
pub fn published_airfoil(name: &str) -> Airfoil {
    let folder = package().join("../../modelDescription/resources/airfoils");
    read(folder.join(name))
}

fn read(file: PathBuf) -> Airfoil {
    Airfoil::read(&file).unwrap_or_else(|error| panic!("{error}"))
}

/// Thin-airfoil lift, momentum theory in descent, and no corrections: models whose results are
/// known on paper.
pub fn ideal_models(inflow: Inflow) -> Models {
    Models {
        inflow,
        descent: Descent::Momentum,
        tip_loss: TipLoss::None,
        section: SectionModel {
            lift: Lift::TwoPi,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.0,
        },
        ..Models::default()
    }
}

/// A rotor without drag.
pub fn ideal_rotor(geometry: Geometry, models: Models, elements: usize) -> Rotor {
    let elements = Elements::new(&geometry, elements);
    Rotor::new(geometry, elements, vec![frictionless()], models)
}

/// Peters & He's wake up to the power `order` of the radius, for a rotor of this shape cut into so
/// many elements.
pub fn peters_he(order: usize, geometry: &Geometry, elements: usize) -> Inflow {
    let radius_ratios = Elements::new(geometry, elements).radius_ratios(geometry.radius);
    Inflow::peters_he(order, geometry.blades as usize, &radius_ratios)
}

/// Air of a density, kg/m3, at 15 degrees Celsius.
pub fn air(density: f64) -> Air {
    Air::new(density, 288.15)
}

/// Hover in still air. Gravity does not act on the blades.
pub fn hover(collective: f64) -> OperatingPoint {
    OperatingPoint {
        gravity: Vector3::zeros(),
        ..OperatingPoint::hover(collective, SPEED, air(DENSITY))
    }
}

/// The same while the hub moves through the air.
pub fn flight(collective: f64, airspeed: Vector3<f64>) -> OperatingPoint {
    OperatingPoint {
        airspeed,
        ..hover(collective)
    }
}

/// rho A (Omega R)^2, to which force coefficients refer; with R = 1 m it is the reference of
/// moments, too.
pub fn reference_force() -> f64 {
    DENSITY * PI * SPEED * SPEED
}

/// The steady start, and the hub loads there.
pub fn steady(rotor: &Rotor, point: &OperatingPoint) -> (State, HubLoads) {
    let mut workspace = Workspace::new(rotor);
    let started = rotor.start(point, Start::Steady, STEP, &mut workspace);
    let Started { state, is_found } = started.unwrap();
    assert!(is_found);
    let response = rotor.respond(point, &state, &mut workspace).unwrap();
    (state, response.hub)
}

/// The hub loads in a state.
pub fn hub_loads(rotor: &Rotor, point: &OperatingPoint, state: &State) -> HubLoads {
    let mut workspace = Workspace::new(rotor);
    rotor.respond(point, state, &mut workspace).unwrap().hub
}

/// The hub loads of a rotor that feels nothing.
pub fn no_loads() -> HubLoads {
    HubLoads {
        force: Vector3::zeros(),
        moment: Vector3::zeros(),
        torque: 0.0,
        induced_velocity: 0.0,
        stalled_radius: 0.0,
        stalled_fraction: 0.0,
        tip_path: TipPath {
            coning: 0.0,
            longitudinal: 0.0,
            lateral: 0.0,
        },
        flow_state: FlowState::Normal,
    }
}
