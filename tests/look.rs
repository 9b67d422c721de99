#![allow(clippy::disallowed_methods)]
use helicopter_rotor::block::{
    RotorBlock,
    variables::{INTEGERS, boolean, integer, real, string},
};
use std::{f64::consts::PI, path::PathBuf};
fn choice(place: usize, name: &str) -> i32 {
    let choices = INTEGERS[place].choices;
    choices.iter().position(|c| *c == name).unwrap() as i32 + 1
}
#[test]
fn look() {
    let project = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let inflow = std::env::var("MODELS").unwrap_or("pittPetersDynamic".into());
    let tip_loss = std::env::var("TIP").unwrap_or("wheatley".into());
    for (mu, rpm, alpha) in [
        (0.2, 141.0, 10.75_f64),
        (0.25, 142.0, 7.35),
        (0.3, 141.0, 5.45),
        (0.35, 141.0, 4.2),
        (0.4, 140.2, 3.45),
        (0.5, 134.0, 2.4),
        (0.6, 125.0, 1.6),
    ] {
        let mut block = RotorBlock::new(project.join("modelDescription/resources"));
        block
            .set_strings(&[string::GEOMETRY__FILE as u32], &["pca-2.toml"])
            .unwrap();
        block
            .set_integers(
                &[
                    integer::MODEL__INFLOW,
                    integer::NUMERICS__ELEMENTS,
                    integer::AIR__MODEL,
                    integer::MODEL__TIP_LOSS,
                    integer::DRIVE_MODE,
                ]
                .map(|p| p as u32),
                &[
                    choice(integer::MODEL__INFLOW, &inflow),
                    20,
                    2,
                    choice(integer::MODEL__TIP_LOSS, &tip_loss),
                    2,
                ],
            )
            .unwrap();
        block
            .set_booleans(&[boolean::FLAPPING__ENABLED as u32], &[1])
            .unwrap();
        let tip = rpm * PI / 30.0 * 6.858;
        let v = mu * tip;
        block
            .set_reals(
                &[
                    real::FLAPPING__INERTIA,
                    real::AIR__DENSITY,
                    real::COLLECTIVE,
                    real::RPM,
                    real::VELOCITY_1,
                    real::VELOCITY_3,
                    real::DRIVE_INERTIA,
                ]
                .map(|p| p as u32),
                &[
                    452.8,
                    1.0823,
                    0.0497,
                    rpm,
                    v,
                    -v * alpha.to_radians().tan(),
                    4.0 * 452.8,
                ],
            )
            .unwrap();
        block.start().unwrap();
        let mut speeds = vec![];
        for _ in 0..60 {
            block.step(0.5).unwrap();
            speeds.push(block.values().reals[real::ROTOR_SPEED]);
        }
        let out = |p: usize| block.values().reals[p];
        println!(
            "mu {mu}: measured {rpm} settles {:.1} ({:+.1} %) mid {:.1}; CT {:.5} a0 {:.2}",
            speeds[59],
            (speeds[59] / rpm - 1.0) * 100.0,
            speeds[39],
            out(real::THRUST_COEFFICIENT),
            out(real::CONING).to_degrees()
        );
    }
}
