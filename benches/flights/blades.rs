//! Flapping blades in dynamic inflow without the FMU around them.

use nalgebra::Vector3;
use rotor::{
    Models, OperatingPoint, Rotor, Start, State, Workspace,
    air::Air,
    airfoil::Airfoil,
    flapping::{BladeMass, Freedom, Hinge, Stops},
    geometry::{Elements, Geometry},
    inflow::Inflow,
};
use std::{hint::black_box, path::Path};

/// A rotor of four blades with 40 elements each, at an advance ratio of 0.2.
pub struct Blades {
    rotor: Rotor,
    point: OperatingPoint,
    state: State,
    workspace: Workspace,
}

impl Blades {
    /// In their periodic state.
    pub fn new() -> Self {
        let geometry = Geometry::linear(4, 0.762, 1.0 / 6.0, 0.0508, 1.0, 0.0);
        let elements = Elements::new(&geometry, 40);
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("modelDescription/resources");
        let airfoil = Airfoil::read(&folder.join("airfoils/naca0015-knight-hefner.polar"));
        let models = Models {
            inflow: Inflow::PittPetersDynamic,
            hinge: Hinge {
                mass: BladeMass::rod(0.05, 0.762),
                freedom: Some(Freedom {
                    pitch_flap: 0.0,
                    length: 0.762,
                    stops: Stops::default(),
                }),
                ..Hinge::default()
            },
            ..Models::default()
        };
        let rotor = Rotor::new(geometry, elements, vec![airfoil.unwrap()], models);
        let point = OperatingPoint {
            airspeed: Vector3::new(15.3, 0.0, 0.0),
            ..OperatingPoint::hover(0.14, 100.5, Air::standard(0.0))
        };
        let mut workspace = Workspace::new(&rotor);
        let started = rotor.start(&point, Start::Steady, 0.05, &mut workspace);
        Self {
            state: started.unwrap().state,
            rotor,
            point,
            workspace,
        }
    }

    /// The rates of the states: one evaluation of 160 elements.
    pub fn rates(&mut self) -> State {
        let point = black_box(&self.point);
        let rates = self.rotor.rates(point, &self.state, &mut self.workspace);
        rates.unwrap()
    }
}
