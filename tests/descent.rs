//! Vertical descent
#![allow(clippy::disallowed_methods)]
use helicopter_rotor::block::{
    RotorBlock,
    variables::{INTEGERS, integer, real, string},
};
use std::{f64::consts::PI, fs, path::PathBuf};
fn choice(place: usize, name: &str) -> i32 {
    let choices = INTEGERS[place].choices;
    choices.iter().position(|c| *c == name).unwrap() as i32 + 1
}
#[test]
fn look() {
    let project = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let text = fs::read_to_string(
        project.join("fmu-examples/data/castles-gray-1951-tn2474-tableI-descent-6ft.csv"),
    )
    .unwrap();
    for inflow in ["annulus", "uniform", "finiteBlades"] {
        for descent in ["momentum", "measured", "johnson"] {
            let (mut sum, mut n, mut hov, mut nh, mut mean) = (0.0, 0.0, 0.0, 0.0, 0.0);
            let verbose = std::env::var("V").is_ok();
            for line in text
                .lines()
                .filter(|l| !l.starts_with('#') && !l.starts_with("run"))
            {
                let c: Vec<f64> = line
                    .split(',')
                    .map(|x| x.parse().unwrap_or(f64::NAN))
                    .collect();
                let (ct, rpm, theta, x) = (c[1], c[2], c[4], c[6]);
                if x.is_nan() {
                    continue;
                }
                let mut block = RotorBlock::new(project.join("modelDescription/resources"));
                block
                    .set_strings(&[string::GEOMETRY__FILE as u32], &["castles-gray-6ft.toml"])
                    .unwrap();
                block
                    .set_integers(
                        &[
                            integer::MODEL__INFLOW as u32,
                            integer::MODEL__DESCENT as u32,
                            integer::MODEL__BLADES as u32,
                        ],
                        &[
                            choice(integer::MODEL__INFLOW, inflow),
                            choice(integer::MODEL__DESCENT, descent),
                            2,
                        ],
                    )
                    .unwrap();
                let tip = rpm * PI / 30.0 * 0.9144;
                let vd = x * tip * (ct / 2.0_f64).sqrt();
                block
                    .set_reals(&[real::RPM as u32, real::VELOCITY_3 as u32], &[rpm, -vd])
                    .unwrap();
                let mut f = |deg: f64| {
                    block
                        .set_reals(&[real::COLLECTIVE as u32], &[deg.to_radians()])
                        .unwrap();
                    block.update().unwrap();
                    block.values().reals[real::THRUST_COEFFICIENT] - ct
                };
                let (mut a, mut b) = (-12.0, 25.0);
                let (fa, fb) = (f(a), f(b));
                if fa * fb > 0.0 {
                    println!("no bracket {line}");
                    continue;
                }
                for _ in 0..40 {
                    let m = 0.5 * (a + b);
                    if f(m) < 0.0 { a = m } else { b = m }
                }
                let e = 0.5 * (a + b) - theta;
                if verbose {
                    println!("{x:.2} {ct} {theta:.2} {:.2} {e:.2}", theta + e);
                }
                if x == 0.0 {
                    hov += e;
                    nh += 1.0;
                }
                sum += e * e;
                n += 1.0;
                mean += e;
            }
            println!(
                "{inflow} {descent}: rms {:.3} deg over {n}, mean {:.2}, hover mean error {:.2}",
                (sum / n as f64).sqrt(),
                mean / n,
                hov / nh
            );
        }
    }
}
