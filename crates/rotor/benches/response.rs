//! What a response costs: hover in annuli, and one azimuth step of four flapping blades in dynamic
//! inflow.
//!
//!     cargo bench -p rotor
//!
//! Absolute times depend on the machine; compare them with each other in one run.

use criterion::{Criterion, criterion_group, criterion_main};
use nalgebra::Vector3;
use rotor::{
    Models, OperatingPoint, Rotor, Start, Workspace,
    air::Air,
    airfoil::Airfoil,
    flapping::{BladeMass, Freedom, Hinge, Stops},
    geometry::{Elements, Geometry},
    inflow::Inflow,
};
use std::{hint::black_box, path::Path};

const SPEED: f64 = 100.0;
const AZIMUTH_STEP: f64 = 0.05;

fn rotor(models: Models) -> Rotor {
    let geometry = Geometry::linear(4, 0.762, 1.0 / 6.0, 0.0508, 1.0, 0.0);
    let elements = Elements::new(&geometry, 40);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../modelDescription/resources");
    let airfoil = Airfoil::read(&folder.join("airfoils/naca0015-knight-hefner.polar"));
    Rotor::new(geometry, elements, vec![airfoil.unwrap()], models)
}

fn hover(criterion: &mut Criterion) {
    let rotor = rotor(Models::default());
    let mut workspace = Workspace::new(&rotor);
    let point = OperatingPoint::hover(0.14, SPEED, Air::standard(0.0));
    let state = rotor
        .start(&point, Start::Steady, AZIMUTH_STEP, &mut workspace)
        .unwrap()
        .state;
    criterion.bench_function("response in hover, annuli, 40 elements", |bencher| {
        bencher.iter(|| {
            rotor
                .respond(black_box(&point), &state, &mut workspace)
                .unwrap()
                .hub
                .force
                .z
        });
    });
}

fn azimuth_step(criterion: &mut Criterion) {
    let rotor = rotor(Models {
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
    });
    let mut workspace = Workspace::new(&rotor);
    let point = OperatingPoint {
        airspeed: Vector3::new(15.0, 0.0, 0.0),
        ..OperatingPoint::hover(0.14, SPEED, Air::standard(0.0))
    };
    let state = rotor
        .start(&point, Start::Steady, AZIMUTH_STEP, &mut workspace)
        .unwrap()
        .state;
    let step = AZIMUTH_STEP / SPEED;
    criterion.bench_function(
        "azimuth step, flapping, dynamic inflow, 4 x 40 elements",
        |bencher| {
            bencher.iter(|| {
                rotor
                    .step(|_| *black_box(&point), &state, step, &mut workspace)
                    .unwrap()
            });
        },
    );
}

criterion_group!(benches, hover, azimuth_step);
criterion_main!(benches);
