//! Propellers and rotors that the wind turns: large inflow angles, where Prandtl's tip loss must
//! not take lift away that nothing induces. Where the disc is axially symmetric all inflow models
//! agree with the momentum balance of each annulus.

use crate::support::block::{choose, default_block, get, set, set_integer};
use helicopter_rotor::block::{
    RotorBlock,
    variables::{RealRef, integer, real},
};

/// All inflow models but `annulusClosedForm`, which assumes small angles.
fn models() -> impl Iterator<Item = &'static str> {
    let all = integer::MODELS__INFLOW.variable().choices.iter().copied();
    all.filter(|name| *name != "annulusClosedForm")
}

fn block(inflow: &str, values: &[(RealRef, f64)]) -> RotorBlock {
    let mut block = default_block();
    choose(&mut block, integer::MODELS__INFLOW, inflow);
    for (reference, value) in values {
        set(&mut block, *reference, *value);
    }
    block
}

/// A quantity of each model agrees with that of the annulus within 3 %.
fn agree(what: &str, of: impl Fn(&str) -> f64) {
    let expected = of("annulus");
    for model in models() {
        let ratio = of(model) / expected;
        assert!((ratio - 1.0).abs() < 0.03, "{what}, {model}: {ratio}");
    }
}

/// Two slender blades: the other models neglect swirl, which takes more than 3 % of the thrust of
/// broad blades at high pitch.
const PROPELLER: [(RealRef, f64); 6] = [
    (real::GEOMETRY__RADIUS, 0.127),
    (real::GEOMETRY__CHORD, 0.004),
    (real::GEOMETRY__ROOT_CUTOUT, 0.3),
    (real::GEOMETRY__TWIST, -0.7),
    (real::COLLECTIVE, 1.15),
    (real::RPM, 6000.0),
];

#[test]
fn a_propeller_has_the_annulus_thrust_and_torque_up_to_an_advance_ratio_of_1_5() {
    for advance in [0.0, 0.3, 0.6, 0.9, 1.2, 1.5] {
        for output in [real::THRUST, real::TORQUE] {
            let name = output.variable().name;
            agree(&format!("{name} at J = {advance}"), |inflow| {
                let mut block = block(inflow, &PROPELLER);
                set_integer(&mut block, integer::GEOMETRY__NUMBER_OF_BLADES, 2);
                set(&mut block, real::VELOCITY_3, advance * 100.0 * 0.254);
                block.update().unwrap();
                get(&block, output)
            });
        }
    }
}

/// CT = T/(rho n^2 D^4), CP = P/(rho n^3 D^5), J = V/(n D), eta = J CT/CP.
#[test]
fn a_propeller_has_the_coefficients_with_revolutions_and_diameter() {
    let mut block = block("annulus", &PROPELLER);
    set_integer(&mut block, integer::GEOMETRY__NUMBER_OF_BLADES, 2);
    let (n, d): (f64, f64) = (100.0, 0.254);
    let of = |block: &RotorBlock| {
        [
            real::PROPELLER_THRUST_COEFFICIENT,
            real::PROPELLER_POWER_COEFFICIENT,
            real::PROPELLER_ADVANCE_RATIO,
            real::PROPELLER_EFFICIENCY,
        ]
        .map(|output| get(block, output))
    };
    let close = |found: f64, expected: f64, what: &str| {
        assert!(
            (found / expected - 1.0).abs() < 1e-12,
            "{what}: {found} {expected}"
        );
    };
    for velocity in [20.0, 30.0] {
        set(&mut block, real::VELOCITY_3, velocity);
        block.update().unwrap();
        let [thrust, power, advance, efficiency] = of(&block);
        let density = get(&block, real::AIR_DENSITY);
        close(
            thrust,
            get(&block, real::THRUST) / (density * n.powi(2) * d.powi(4)),
            "CT",
        );
        close(
            power,
            get(&block, real::POWER) / (density * n.powi(3) * d.powi(5)),
            "CP",
        );
        close(advance, velocity / (n * d), "J");
        close(efficiency, advance * thrust / power, "eta");
        assert!((0.5..0.95).contains(&efficiency), "{efficiency}");
        let pi = std::f64::consts::PI;
        close(
            thrust,
            get(&block, real::THRUST_COEFFICIENT) * pi.powi(3) / 4.0,
            "CT by CT",
        );
        close(
            power,
            get(&block, real::POWER_COEFFICIENT) * pi.powi(4) / 4.0,
            "CP by CP",
        );
    }
    // Neither a static propeller nor one that is a windmill or stands still has an efficiency.
    for (velocity, rpm, turns) in [
        (0.0, 6000.0, true),
        (80.0, 6000.0, true),
        (10.0, 0.0, false),
    ] {
        set(&mut block, real::VELOCITY_3, velocity);
        set(&mut block, real::RPM, rpm);
        block.update().unwrap();
        let [thrust, power, advance, efficiency] = of(&block);
        assert_eq!(efficiency, 0.0, "{velocity} m/s, {rpm} rpm");
        assert_eq!(
            thrust != 0.0 && power != 0.0,
            turns,
            "{velocity} m/s, {rpm} rpm"
        );
        assert_eq!(advance != 0.0, turns && velocity > 0.0);
    }
}

/// The speed to which a rotor without torque settles, rev/min.
fn settled(mut block: RotorBlock, seconds: f64) -> f64 {
    choose(&mut block, integer::DRIVE__MODE, "torque");
    set_integer(&mut block, integer::NUMERICS__ELEMENTS, 10);
    block.start().unwrap();
    let mut turn = |time: f64| {
        for _ in 0..100 {
            block.step(time / 100.0).unwrap();
        }
        get(&block, real::ROTOR_SPEED)
    };
    let before = turn(0.9 * seconds);
    turn(0.1 * seconds);
    let speed = get(&block, real::ROTOR_SPEED);
    assert!((before / speed - 1.0).abs() < 0.02, "{before} {speed}");
    speed
}

#[test]
fn a_windmilling_propeller_settles_at_the_same_speed() {
    agree("windmill", |inflow| {
        let mut block = block(
            inflow,
            &[
                (real::GEOMETRY__RADIUS, 0.127),
                (real::GEOMETRY__CHORD, 0.01),
                (real::GEOMETRY__TWIST, -0.2),
                (real::COLLECTIVE, 0.35),
                (real::RPM, 1000.0),
                (real::VELOCITY_3, 10.0),
                (real::DRIVE__INERTIA, 1e-5),
            ],
        );
        set_integer(&mut block, integer::GEOMETRY__NUMBER_OF_BLADES, 2);
        settled(block, 1.0)
    });
}

#[test]
fn an_updraught_turns_a_rotor_from_rest() {
    agree("updraught", |inflow| {
        let values = [
            (real::COLLECTIVE, -0.05),
            (real::RPM, 0.0),
            (real::WIND_3, 10.0),
            (real::DRIVE__INERTIA, 0.1),
        ];
        settled(block(inflow, &values), 20.0)
    });
}
