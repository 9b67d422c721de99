//! The PCA-2 autogiro of Wheatley 1934 (NACA Rep. 487) in autorotation.
#![allow(clippy::disallowed_methods)]

use helicopter_rotor::block::{
    RotorBlock,
    variables::{INTEGERS, boolean, integer, real, string},
};
use std::{f64::consts::PI, path::PathBuf};

const RADIUS: f64 = 6.858;

fn choice(place: usize, name: &str) -> i32 {
    let choices = INTEGERS[place].choices;
    choices.iter().position(|c| *c == name).unwrap() as i32 + 1
}

fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

struct Flight {
    mu: f64,
    rpm: f64,
    inflow: &'static str,
}

#[derive(Default, Debug, Clone, Copy)]
struct Answer {
    torque: f64,
    ct: f64,
    a0: f64,
    a1: f64,
    b1: f64,
}

fn fly(flight: &Flight, alpha: f64) -> Answer {
    let mut block = RotorBlock::new(project().join("modelDescription/resources"));
    let set = |b: &mut RotorBlock, p: usize, v: f64| b.set_reals(&[p as u32], &[v]).unwrap();
    block
        .set_strings(
            &[string::GEOMETRY__FILE as u32],
            &[&std::env::var("ROTOR").unwrap_or("pca-2.toml".into())],
        )
        .unwrap();
    block
        .set_integers(
            &[
                integer::MODEL__INFLOW,
                integer::NUMERICS__ELEMENTS,
                integer::AIR__MODEL,
                integer::MODEL__LIFT,
                integer::MODEL__TIP_LOSS,
            ]
            .map(|p| p as u32),
            &[
                choice(integer::MODEL__INFLOW, flight.inflow),
                24,
                choice(integer::AIR__MODEL, "constant"),
                choice(
                    integer::MODEL__LIFT,
                    &std::env::var("LIFT").unwrap_or("table".into()),
                ),
                choice(
                    integer::MODEL__TIP_LOSS,
                    &std::env::var("TIP").unwrap_or("prandtl".into()),
                ),
            ],
        )
        .unwrap();
    block
        .set_booleans(&[boolean::FLAPPING__ENABLED as u32], &[1])
        .unwrap();
    if let Ok(file) = std::env::var("AIRFOIL") {
        block
            .set_strings(&[string::AIRFOIL__FILE as u32], &[&file])
            .unwrap();
    }
    set(&mut block, real::FLAPPING__INERTIA, 452.8);
    set(&mut block, real::AIR__DENSITY, 1.0823);
    set(&mut block, real::COLLECTIVE, 0.0497);
    set(&mut block, real::RPM, flight.rpm);
    let tip = flight.rpm * PI / 30.0 * RADIUS;
    set(&mut block, real::VELOCITY_1, flight.mu * tip);
    set(&mut block, real::VELOCITY_3, -flight.mu * tip * alpha.tan());
    block.start().unwrap();
    let mut mean = Answer::default();
    for _ in 0..30 {
        block.step(60.0 / flight.rpm / 120.0).unwrap();
        let out = |p: usize| block.values().reals[p];
        mean.torque += out(real::TORQUE) / 30.0;
        mean.ct += out(real::THRUST_COEFFICIENT) / 30.0;
        mean.a0 += out(real::CONING).to_degrees() / 30.0;
        mean.a1 += out(real::LONGITUDINAL_FLAPPING).to_degrees() / 30.0;
        mean.b1 += out(real::LATERAL_FLAPPING).to_degrees() / 30.0;
    }
    mean
}

#[test]
fn look() {
    let wanted = std::env::var("MODELS").unwrap_or("drees".into());
    for inflow in wanted.split(',') {
        let inflow: &'static str = Box::leak(inflow.to_owned().into_boxed_str());
        for (mu, rpm, a0, a1, b1, ct, al) in [
            (0.113, 141.6, 6.99, 1.14, 2.58, 0.00752, 0.0),
            (0.192, 141.1, 6.82, 1.84, 3.06, 0.0069, 11.1),
            (0.275, 140.2, 6.49, 2.43, 3.48, 0.00668, 6.3),
            (0.4, 140.2, 5.79, 3.99, 3.5, 0.00593, 3.45),
            (0.517, 133.0, 5.10, 5.05, 3.97, 0.00573, 2.3),
            (0.682, 116.8, 4.51, 6.84, 4.43, 0.00557, 1.3),
        ] {
            let flight = Flight { mu, rpm, inflow };
            let (mut x0, mut x1) = (0.02_f64, 0.12_f64);
            let (mut f0, mut last) = (fly(&flight, x0), fly(&flight, x1));
            for _ in 0..12 {
                let x2 = x1 - last.torque * (x1 - x0) / (last.torque - f0.torque);
                (x0, f0) = (x1, last);
                x1 = x2.clamp(-0.2, 0.7);
                last = fly(&flight, x1);
                if last.torque.abs() < 1.0 {
                    break;
                }
            }
            println!(
                "{inflow:18} mu {mu:.3}: alpha {:5.2} ({al}) Q {:.1} CT {:.5} ({ct}) a0 {:.2} ({a0}) a1 {:.2} ({a1}) b1 {:.2} ({b1})",
                x1.to_degrees(),
                last.torque,
                last.ct,
                last.a0,
                last.a1,
                last.b1
            );
        }
    }
}
