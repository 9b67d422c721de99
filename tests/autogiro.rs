//! The rotor of the PCA-2 autogiro in autorotation against flight measurements: Wheatley, J. B. (1934), NACA
//! Report 487, figs. 7 and 8.
//!
//! Flown: rotors/pca-2.toml at the pitch of the report, in air of the tests' mean density (p. 13), at the
//! measured rotor speed, at the shaft angle at which the mean torque is 0. Flapping with the report's
//! inertia (p. 12), no offset (not known; the report neglects it), the weight of uniform blades.
//!
//! Section data are assumed, not measured: those of the report's own analysis (wheatley-1934.polar) with its
//! tip loss, and for comparison those computed for the section's name (goettingen429.polar).

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "support/block.rs"]
mod support;

use helicopter_rotor::block::variables::{boolean, integer, real, string};
use std::{
    f64::consts::PI,
    fs,
    path::PathBuf,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};
use support::{choice, default_block, project};

const RADIUS: f64 = 6.858;
const COLLECTIVE: f64 = 0.0497;
const INERTIA: f64 = 452.8;
const DENSITY: f64 = 1.0823;
/// Steps of 3 deg from blade to blade.
const STEPS: usize = 30;

/// (mu, value) of a quantity in one of the two files.
fn measured(file: &str, quantity: &str) -> Vec<(f64, f64)> {
    let name = format!("fmu-examples/data/wheatley-1934-tr487-pca2-{file}-digitised.csv");
    let text = fs::read_to_string(project().join(name)).unwrap();
    let rows = text.lines().filter_map(|line| {
        let mut cells = line.split(',');
        (cells.next() == Some(quantity)).then(|| {
            let mut number = || cells.next().unwrap().parse::<f64>().unwrap();
            (number(), number())
        })
    });
    rows.collect()
}

/// Linear between the measured points, constant beyond.
fn between(points: &[(f64, f64)], mu: f64) -> f64 {
    let outer = points
        .partition_point(|p| p.0 <= mu)
        .clamp(1, points.len() - 1);
    let ((a, u), (b, v)) = (points[outer - 1], points[outer]);
    u + ((mu - a) / (b - a)).clamp(0.0, 1.0) * (v - u)
}

/// Means over a blade passage; angles in deg.
#[derive(Debug, Default, Clone, Copy)]
struct Answer {
    alpha: f64,
    torque: f64,
    thrust_coefficient: f64,
    coning: f64,
    longitudinal: f64,
    lateral: f64,
}

/// What the measurement leaves open.
#[derive(Debug, Clone, Copy)]
struct Case<'a> {
    rotor: &'a str,
    inflow: &'a str,
    tip_loss: &'a str,
}

impl Default for Case<'_> {
    /// The section and the tip loss of the report's own analysis.
    fn default() -> Self {
        Self {
            rotor: "pca-2.toml",
            inflow: "pittPetersDynamic",
            tip_loss: "wheatley",
        }
    }
}

/// A flight at a shaft angle, rad.
fn fly(case: &Case, mu: f64, rpm: f64, alpha: f64) -> Answer {
    let mut block = default_block();
    block
        .set_strings(&[string::GEOMETRY__FILE as u32], &[case.rotor])
        .unwrap();
    block
        .set_integers(
            &[
                integer::MODEL__INFLOW,
                integer::NUMERICS__ELEMENTS,
                integer::AIR__MODEL,
                integer::MODEL__TIP_LOSS,
            ]
            .map(|p| p as u32),
            &[
                choice(integer::MODEL__INFLOW, case.inflow),
                20,
                choice(integer::AIR__MODEL, "constant"),
                choice(integer::MODEL__TIP_LOSS, case.tip_loss),
            ],
        )
        .unwrap();
    block
        .set_booleans(&[boolean::FLAPPING__ENABLED as u32], &[1])
        .unwrap();
    let edgewise = mu * rpm * PI / 30.0 * RADIUS;
    for (place, value) in [
        (real::FLAPPING__INERTIA, INERTIA),
        (real::AIR__DENSITY, DENSITY),
        (real::COLLECTIVE, COLLECTIVE),
        (real::RPM, rpm),
        (real::VELOCITY_1, edgewise),
        // The air comes from below the disc: the shaft leans back by alpha.
        (real::VELOCITY_3, -edgewise * alpha.tan()),
    ] {
        block.set_reals(&[place as u32], &[value]).unwrap();
    }
    block.start().unwrap();
    let mut mean = Answer {
        alpha: alpha.to_degrees(),
        ..Answer::default()
    };
    for _ in 0..STEPS {
        block.step(60.0 / rpm / 120.0).unwrap();
        let share = |place: usize| block.values().reals[place] / STEPS as f64;
        mean.torque += share(real::TORQUE);
        mean.thrust_coefficient += share(real::THRUST_COEFFICIENT);
        mean.coning += share(real::CONING).to_degrees();
        mean.longitudinal += share(real::LONGITUDINAL_FLAPPING).to_degrees();
        mean.lateral += share(real::LATERAL_FLAPPING).to_degrees();
    }
    mean
}

/// The shaft angle at which the torque vanishes, by false position (Illinois) below what the last mu had. The
/// more the shaft leans back, the more the air drives the rotor.
fn autorotate(case: &Case, mu: f64, rpm: f64, guess: f64) -> Answer {
    let driven = |alpha: f64| (alpha, fly(case, mu, rpm, alpha));
    let (mut low, mut high) = (driven(guess - 0.06), driven(guess + 0.005));
    while low.1.torque < 0.0 {
        low = driven(low.0 - 0.06);
    }
    while high.1.torque > 0.0 {
        high = driven(high.0 + 0.03);
    }
    let (mut at_low, mut at_high) = (low.1.torque, high.1.torque);
    for _ in 0..15 {
        let next = driven((low.0 * at_high - high.0 * at_low) / (at_high - at_low));
        // 5 N.m are a thousandth of what drives one side of the rotor and brakes the other.
        if next.1.torque.abs() < 5.0 {
            return next.1;
        }
        if next.1.torque > 0.0 {
            (low, at_low) = (next, next.1.torque);
            at_high *= 0.5;
        } else {
            (high, at_high) = (next, next.1.torque);
            at_low *= 0.5;
        }
    }
    panic!("{case:?} does not autorotate at mu = {mu}: {low:?} {high:?}");
}

impl Case<'_> {
    /// The rotor at the measured advance ratios, from the slowest up.
    fn autorotations(&self) -> Vec<Answer> {
        let speed = measured("CT-rpm", "N_rpm");
        let mut guess = 0.42;
        let flown = ratios().into_iter().map(|mu| {
            let answer = autorotate(self, mu, between(&speed, mu), guess);
            guess = answer.alpha.to_radians();
            answer
        });
        flown.collect()
    }

    fn report(&self, answers: &[Answer]) {
        let [a0, a1, b1] = ["a0", "a1", "b1"].map(|name| measured("flapping", name));
        let thrust = measured("CT-rpm", "CT");
        let mut text = format!("{self:?}: computed (measured)\n");
        for (i, a) in answers.iter().enumerate() {
            let (mu, coning) = a0[i];
            let ct = between(&thrust, mu);
            text += &format!(
                "  mu {mu:.3}  alpha {:5.1}  CT {:.5} ({ct:.5})  a0 {:4.2} ({coning:4.2})  a1 {:4.2} ({:4.2})  b1 {:4.2} ({:4.2})\n",
                a.alpha,
                a.thrust_coefficient,
                a.coning,
                a.longitudinal,
                a1[i].1,
                a.lateral,
                b1[i].1
            );
        }
        let [a0, a1, b1] = errors(answers);
        println!("{text}  RMS error, deg: a0 {a0:.2}, a1 {a1:.2}, b1 {b1:.2}");
    }
}

fn rms(errors: impl Iterator<Item = f64>) -> f64 {
    let (sum, count) = errors.fold((0.0, 0), |(sum, n), e| (sum + e * e, n + 1));
    (sum / f64::from(count)).sqrt()
}

/// RMS errors, deg, of coning, longitudinal and lateral flapping over the measured advance ratios.
fn errors(answers: &[Answer]) -> [f64; 3] {
    let of = |name: &str, quantity: fn(&Answer) -> f64| {
        let points = measured("flapping", name);
        rms(points
            .iter()
            .zip(answers)
            .map(|((_, value), a)| quantity(a) - value))
    };
    [
        of("a0", |a| a.coning),
        of("a1", |a| a.longitudinal),
        of("b1", |a| a.lateral),
    ]
}

/// The advance ratios of the coning points; those of the other two lie within 0.004 of them.
fn ratios() -> Vec<f64> {
    measured("flapping", "a0").iter().map(|p| p.0).collect()
}

/// The README's table of these errors: (model, errors).
fn published() -> Vec<(String, [f64; 3])> {
    let readme = fs::read_to_string(project().join("README.md")).unwrap();
    let table = readme.split("<!-- PCA-2 -->").nth(1).unwrap();
    let rows = table.lines().filter_map(|line| {
        let mut cells = line.split('|').map(str::trim).skip(1);
        let name = cells.next()?.trim_matches('`').to_owned();
        let mut number = || cells.next()?.parse().ok();
        Some((name, [number()?, number()?, number()?]))
    });
    rows.collect()
}

const MODELS: [&str; 12] = [
    "uniform",
    "annulus",
    "finiteBlades",
    "coleman",
    "drees",
    "payne",
    "whiteBlake",
    "pittPeters",
    "howlett",
    "glauertHighSpeed",
    "pittPetersDynamic",
    "petersHe",
];

/// Coning and longitudinal flapping within 1 deg RMS with every inflow model. The lateral flapping needs
/// inflow that grows towards the rear, which uniform inflow, the annuli and the finite blades do not have.
#[test]
fn the_autogiro_flaps_as_measured_in_flight() {
    let next = AtomicUsize::new(0);
    let found = Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..2 {
            scope.spawn(|| {
                while let Some(inflow) = MODELS.get(next.fetch_add(1, Ordering::Relaxed)) {
                    let case = Case {
                        inflow,
                        ..Case::default()
                    };
                    let answers = case.autorotations();
                    case.report(&answers);
                    found.lock().unwrap().push((*inflow, errors(&answers)));
                }
            });
        }
    });
    let published = published();
    for (inflow, errors) in found.into_inner().unwrap() {
        let [a0, a1, b1] = errors;
        assert!(a0 < 1.0 && a1 < 1.0, "{inflow}: {errors:?}");
        let skewed = !["uniform", "annulus", "finiteBlades"].contains(&inflow);
        assert_eq!(b1 < 0.6, skewed, "{inflow}: lateral flapping {b1}");
        let row = published.iter().find(|(name, _)| name == inflow);
        let (_, said) = row.unwrap_or_else(|| panic!("{inflow} is missing in README.md"));
        for (found, said) in errors.iter().zip(said) {
            assert!(
                (found - said).abs() < 0.011,
                "README.md, {inflow}: {errors:?}"
            );
        }
    }
}

/// What the section data and the tip loss, of which the case knows neither, are worth.
#[test]
fn coning_depends_on_the_lift_slope_that_is_assumed() {
    let rotor = project().join("modelDescription/resources/rotors/pca-2.toml");
    let text = fs::read_to_string(rotor).unwrap();
    let computed = text.replace("wheatley-1934", "goettingen429");
    let other = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("pca-2-goettingen429.toml");
    fs::write(&other, computed).unwrap();
    let of = |case: Case| {
        let answers = case.autorotations();
        case.report(&answers);
        errors(&answers)[0]
    };
    let own_tip_loss = of(Case {
        tip_loss: "prandtl",
        ..Case::default()
    });
    let computed_section = of(Case {
        rotor: other.to_str().unwrap(),
        ..Case::default()
    });
    let published = published();
    for (name, error) in [
        ("with Prandtl's tip loss", own_tip_loss),
        ("with Goettingen 429 computed", computed_section),
    ] {
        let row = published.iter().find(|(n, _)| n.contains(name));
        let (_, said) = row.unwrap_or_else(|| panic!("{name} is missing in README.md"));
        assert!(
            (error - said[0]).abs() < 0.011,
            "README.md, {name}: {error}"
        );
    }
}

/// Why thrust and rotor speed are off at high advance ratios: drag. The blades carried fittings and cables that the
/// section's 0.0120 does not have, and drag must be driven by air from below, with thrust: with twice
/// the drag the rotor without torque has the measured thrust at mu = 0.68. (Rep. 487's own
/// calculation with the blades' parasite drag, p. 15, has more thrust and less rotor speed as well.)
#[test]
fn the_thrust_that_is_missing_at_high_advance_ratio_is_a_matter_of_drag() {
    let resources = project().join("modelDescription/resources");
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR"));
    let section = fs::read_to_string(resources.join("airfoils/wheatley-1934.polar")).unwrap();
    let (polar, rotor) = (folder.join("drag.polar"), folder.join("pca-2-drag.toml"));
    fs::write(&polar, section.replace(" 0.01200", " 0.02400")).unwrap();
    let own = fs::read_to_string(resources.join("rotors/pca-2.toml")).unwrap();
    let other = own.replace("airfoils/wheatley-1934.polar", polar.to_str().unwrap());
    fs::write(&rotor, other).unwrap();
    let thrust = |rotor: &str| {
        let case = Case {
            rotor,
            ..Case::default()
        };
        autorotate(&case, 0.682, 116.8, 0.0).thrust_coefficient
    };
    let (smooth, draggy) = (thrust("pca-2.toml"), thrust(rotor.to_str().unwrap()));
    println!("CT at mu 0.682: {smooth:.5}, with twice the drag {draggy:.5}, measured 0.00557");
    assert!((smooth / 0.00557 - 0.68).abs() < 0.03, "{smooth}");
    assert!((draggy / 0.00557 - 1.0).abs() < 0.05, "{draggy}");
}
