//! The thesis' lift slopes, stall angles and drag polynomials by way of the variables.

use crate::support::block::{default_block, set, set_integer, set_string};
use helicopter_rotor::block::{
    RotorBlock,
    variables::{
        CompressibilityModel, InflowModel, IntegerRef, LiftModel, TipLossModel, integer, real,
        string,
    },
};
use std::{fs, path::PathBuf};

/// A file with the slopes 6 (A) and 4 (C), stall at 0.2 rad and drag 0.01 + 0.5 alpha^2.
fn constant_laws() -> String {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let file = folder.join(format!("laws-{:?}.txt", std::thread::current().id()));
    fs::write(
        &file,
        "#1\ndouble airfoil(1, 7)\n1e5, 6, 4, 0.2, 0.01, 0, 0.5\n",
    )
    .unwrap();
    file.to_str().unwrap().to_owned()
}

/// A block with an airfoil file and values of parameters.
fn block(file: &str, integers: &[(IntegerRef, i32)]) -> RotorBlock {
    let mut block = default_block();
    set_string(&mut block, string::AIRFOIL__FILE, file);
    for (reference, value) in integers {
        set_integer(&mut block, *reference, *value);
    }
    block
}

const LIFT: (IntegerRef, i32) = (integer::MODELS__LIFT, LiftModel::SlopesByReynolds as i32);
const INCOMPRESSIBLE: (IntegerRef, i32) = (
    integer::MODELS__COMPRESSIBILITY,
    CompressibilityModel::None as i32,
);
const WITHOUT_TIP_LOSS: (IntegerRef, i32) = (integer::MODELS__TIP_LOSS, TipLossModel::None as i32);
/// The number of stations in the outputs, so that each element is one of them.
const ELEMENTS: (IntegerRef, i32) = (integer::NUMERICS__ELEMENTS, 20);

/// Angle of attack, lift and drag coefficient at the stations.
fn stations(block: &RotorBlock) -> Vec<(f64, f64, f64)> {
    let reals = &block.values().reals;
    (0..20)
        .map(|i| {
            (
                reals[real::STATION__ANGLE_OF_ATTACK[i]],
                reals[real::STATION__LIFT_COEFFICIENT[i]],
                reals[real::STATION__DRAG_COEFFICIENT[i]],
            )
        })
        .collect()
}

/// Line A up to 3 deg of pitch and line B above, for every angle of attack.
#[test]
fn the_pitch_chooses_the_slope() {
    for inflow in [
        InflowModel::Annulus,
        InflowModel::AnnulusClosedForm,
        InflowModel::Uniform,
    ] {
        for (collective, slope) in [
            (1.0, 6.0),
            (-2.0, 6.0),
            (3.0, 6.0),
            (3.1, 5.0),
            (8.0, 5.0),
            (-8.0, 5.0),
        ] {
            let inflow = (integer::MODELS__INFLOW, inflow as i32);
            let mut block = block(
                &constant_laws(),
                &[LIFT, INCOMPRESSIBLE, WITHOUT_TIP_LOSS, ELEMENTS, inflow],
            );
            set(&mut block, real::COLLECTIVE, f64::to_radians(collective));
            set(&mut block, real::AIRFOIL__DRAG_REYNOLDS_EXPONENT, 0.0);
            block.update().unwrap();
            for (alpha, lift, drag) in stations(&block) {
                assert!(alpha.abs() < 0.2);
                assert!(
                    (lift - slope * alpha).abs() < 1e-12,
                    "{collective}: {lift} at {alpha}"
                );
                assert!(drag >= 0.01, "{collective}: {drag}");
            }
        }
    }
}

/// With washout the inner elements of a blade may have more than 3 deg of pitch and the outer ones
/// less.
#[test]
fn each_element_has_the_slope_of_its_own_pitch() {
    let mut block = block(
        &constant_laws(),
        &[LIFT, INCOMPRESSIBLE, WITHOUT_TIP_LOSS, ELEMENTS],
    );
    set(&mut block, real::GEOMETRY__TWIST, f64::to_radians(-8.0));
    set(&mut block, real::COLLECTIVE, f64::to_radians(8.0));
    block.update().unwrap();
    let (mut count_a, mut count_b) = (0, 0);
    for (i, (alpha, lift, _)) in stations(&block).into_iter().enumerate() {
        let radius = block.values().reals[real::STATION__RADIUS[i]];
        let above = 8.0 - 8.0 * radius > 3.0;
        *(if above { &mut count_b } else { &mut count_a }) += 1;
        let slope = if above { 5.0 } else { 6.0 };
        assert!((lift - slope * alpha).abs() < 1e-12, "r/R {radius}");
    }
    assert!(count_a > 3 && count_b > 3);
}

#[test]
fn drag_and_stall_angle_are_those_of_the_file() {
    let mut block = block(
        &constant_laws(),
        &[LIFT, INCOMPRESSIBLE, WITHOUT_TIP_LOSS, ELEMENTS],
    );
    set(&mut block, real::AIRFOIL__DRAG_REYNOLDS_EXPONENT, 0.0);
    block.update().unwrap();
    for (alpha, _, drag) in stations(&block) {
        assert!((drag - 0.01 - 0.5 * alpha * alpha).abs() < 1e-12);
    }
    assert_eq!(block.values().reals[real::STALLED_FRACTION], 0.0);
    set(&mut block, real::COLLECTIVE, 0.6);
    block.update().unwrap();
    let beyond = stations(&block).iter().filter(|s| s.0 > 0.2).count();
    let stalled = block.values().reals[real::STALLED_FRACTION];
    assert!(beyond > 0 && (stalled - beyond as f64 / 20.0).abs() < 1e-12);
}

/// With `table` the same file gives lift along line A and then line C.
#[test]
fn the_shipped_lift_slopes_are_near_the_polar_that_they_were_made_from() {
    let thrust = |file: &str, collective: f64, lift: LiftModel| {
        let mut block = block(file, &[(integer::MODELS__LIFT, lift as i32)]);
        set(&mut block, real::COLLECTIVE, f64::to_radians(collective));
        block.update().unwrap();
        block.values().reals[real::THRUST]
    };
    for (collective, tolerance) in [(2.0, 0.02), (5.0, 0.02), (8.0, 0.04), (12.0, 0.07)] {
        let polar = thrust("naca0015.polar", collective, LiftModel::Table);
        let laws = thrust("naca0015.txt", collective, LiftModel::Table);
        assert!(
            (laws / polar - 1.0).abs() < tolerance,
            "{collective}: {laws} {polar}"
        );
    }
    // At small angles of attack line B lies below line A, which `table` uses there.
    let (a, b) = (
        thrust("naca0015.txt", 5.0, LiftModel::Table),
        thrust("naca0015.txt", 5.0, LiftModel::SlopesByReynolds),
    );
    assert!(b < a && b > 0.85 * a, "{a} {b}");
}

/// The shipped file in many flights, with every inflow model that has no states.
#[test]
fn outputs_are_finite_in_every_flight() {
    let choices = integer::MODELS__INFLOW.variable().choices;
    for (i, inflow) in choices.iter().enumerate() {
        if matches!(*inflow, "pittPetersDynamic" | "petersHe") {
            continue;
        }
        for lift in [LiftModel::SlopesByReynolds, LiftModel::Table] {
            let models = [
                (integer::MODELS__LIFT, lift as i32),
                (integer::MODELS__INFLOW, i as i32 + 1),
                (integer::NUMERICS__ELEMENTS, 8),
            ];
            let mut block = block("naca0015.txt", &models);
            for collective in [
                -180.0, -90.0, -20.0, -3.0, 0.0, 3.0, 10.0, 17.0, 45.0, 90.0, 180.0,
            ] {
                for (rpm, forward, climb) in [
                    (960.0, 0.0, 0.0),
                    (960.0, 40.0, 3.0),
                    (960.0, 0.0, -20.0),
                    (0.0, 20.0, -5.0),
                    (0.0, 0.0, 0.0),
                    (20_000.0, 10.0, 0.0),
                ] {
                    set(&mut block, real::COLLECTIVE, f64::to_radians(collective));
                    set(&mut block, real::RPM, rpm);
                    set(&mut block, real::VELOCITY_1, forward);
                    set(&mut block, real::VELOCITY_3, climb);
                    // Outputs that are not finite are an error.
                    if let Err(error) = block.update() {
                        panic!("{inflow} {collective} {rpm} {forward} {climb}: {error}");
                    }
                }
            }
        }
    }
}

#[test]
fn a_file_without_lift_slopes_is_refused_with_the_remedy() {
    for file in ["naca0015.polar", "wheatley-1934.polar"] {
        let mut block = block(file, &[LIFT]);
        let message = block.update().unwrap_err().to_string();
        for part in [
            "models.lift = slopesByReynolds",
            file,
            "set airfoil.file to a Modelica CombiTable file such as airfoils/naca0015.txt",
            "models.lift to table",
        ] {
            assert!(message.contains(part), "{part:?} is not in: {message}");
        }
    }
    let mut block = block("naca0015.txt", &[LIFT]);
    set_string(&mut block, string::GEOMETRY__FILE, "knight-hefner-3.toml");
    let message = block.update().unwrap_err().to_string();
    assert!(
        message.contains("circle.polar")
            && message.contains("a station's airfoil in geometry.file"),
        "{message}"
    );
}
