//! Blades one by one against means over the turn, and what both owe to momentum and energy.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "support/block.rs"]
mod support;

use helicopter_rotor::block::{
    RotorBlock,
    variables::{IntegerRef, RealRef, boolean, integer, real},
};
use nalgebra::Vector3;
use rotor::{
    Blades, Drive, Models, Operation, Performance, Rotor, State,
    air::Air,
    airfoil::{Airfoil, Lift, SectionModel},
    compressibility::Compressibility,
    flapping::Hinge,
    geometry::{Geometry, Station},
    inflow::{Descent, Inflow, Skew, ground::GroundEffect},
    tip_loss::TipLoss,
};
use std::f64::consts::PI;
use support::{choice, default_block, project, set};

const SPEED: f64 = 100.0;

fn models(inflow: Inflow, blades: Blades) -> Models {
    Models {
        inflow,
        descent: Descent::Momentum,
        ground_effect: GroundEffect::None,
        blades,
        hinge: Hinge::default(),
        tip_loss: TipLoss::Prandtl,
        section: SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::PrandtlGlauert,
            drag_reynolds_exponent: 0.2,
        },
    }
}

/// Three real blades with twist and taper.
fn rotor(inflow: Inflow, blades: Blades) -> Rotor {
    let file = project().join("modelDescription/resources/airfoils/naca0015.polar");
    let geometry = Geometry::linear(3, 1.0, 0.15, 0.08, 0.7, -0.14);
    let airfoil = Airfoil::read(&file).unwrap();
    Rotor::new(geometry, vec![airfoil], models(inflow, blades), 40)
}

fn flight(collective: f64, airspeed: Vector3<f64>) -> Operation {
    Operation {
        collective,
        cyclic_longitudinal: 0.0,
        cyclic_lateral: 0.0,
        speed: SPEED,
        airspeed,
        angular_velocity: Vector3::zeros(),
        gravity: Vector3::zeros(),
        hinge_spring: 0.0,
        height: 0.0,
        drive: Drive::Speed,
        air: Air::new(1.2, 288.15),
    }
}

const INFLOWS: [Inflow; 6] = [
    Inflow::Annulus,
    Inflow::Disc(Skew::Uniform),
    Inflow::Disc(Skew::Howlett),
    Inflow::FiniteBlades,
    Inflow::PittPetersDynamic,
    Inflow::PetersHe { order: 4 },
];

/// Mean of force, moment and torque over a turn of the blades, in a given state.
fn mean_over_a_turn(rotor: &mut Rotor, operation: &Operation, state: &State) -> Performance {
    const COUNT: usize = 120;
    let mut mean = Performance::default();
    for i in 0..COUNT {
        let mut state = *state;
        state.azimuth = 2.0 * PI * i as f64 / COUNT as f64;
        let p = rotor.performance(operation, &state).unwrap();
        mean.force += p.force / COUNT as f64;
        mean.moment += p.moment / COUNT as f64;
        mean.torque += p.torque / COUNT as f64;
    }
    mean
}

#[test]
fn in_axial_flow_blades_over_a_turn_are_the_disc() {
    for inflow in INFLOWS {
        for climb in [-1.0, 0.0, 1e-6, 4.0] {
            let operation = flight(0.2, Vector3::new(0.0, 0.0, climb));
            let mut disc = rotor(inflow, Blades::Disc);
            let expected = disc.steady(&operation).unwrap();
            let state = disc.start(&operation, rotor::Start::Steady, 0.05).unwrap();
            let mut blades = rotor(inflow, Blades::Individual);
            let mean = mean_over_a_turn(&mut blades, &operation, &state);
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

/// Static inflow follows the loads of the moment, of which the mean is taken last: not quite the same.
#[test]
fn in_forward_flight_blades_over_a_turn_are_near_the_disc() {
    for inflow in INFLOWS {
        let operation = flight(0.2, Vector3::new(20.0, 3.0, 0.5));
        let mut disc = rotor(inflow, Blades::Disc);
        let expected = disc.steady(&operation).unwrap();
        let state = disc.start(&operation, rotor::Start::Steady, 0.05).unwrap();
        let mean = mean_over_a_turn(&mut rotor(inflow, Blades::Individual), &operation, &state);
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
    for inflow in INFLOWS {
        let hover = flight(0.2, Vector3::zeros());
        let state = State::default();
        let by = |blades, operation: &Operation| {
            let mut rotor = rotor(inflow, blades);
            let p = rotor.performance(operation, &state).unwrap();
            (p, rotor.shows_blades(operation, &state))
        };
        assert_eq!(by(Blades::Automatic, &hover), by(Blades::Disc, &hover));
        let mut cyclic = hover;
        cyclic.cyclic_lateral = 0.01;
        let mut rolling = hover;
        rolling.angular_velocity.x = 0.1;
        for other in [flight(0.2, Vector3::new(1.0, 0.0, 0.0)), cyclic, rolling] {
            assert_eq!(
                by(Blades::Automatic, &other),
                by(Blades::Individual, &other)
            );
            assert!(by(Blades::Automatic, &other).1);
        }
    }
}

/// Leishman 2006, section 3.3.3: pitch that grows like 1/r makes the inflow uniform, and without drag and tip
/// loss the power is that of momentum theory: the figure of merit is 1.
#[test]
fn ideal_twist_without_drag_has_a_figure_of_merit_of_1() {
    let cutout = 0.02;
    let mut geometry = Geometry::linear(4, 1.0, cutout, 0.02, 1.0, 0.0);
    let tip_pitch = 0.04;
    geometry.stations = (0..=2000)
        .map(|i| {
            let radius_ratio = cutout + (1.0 - cutout) * f64::from(i) / 2000.0;
            Station {
                radius_ratio,
                chord: 0.02,
                twist: tip_pitch / radius_ratio,
                airfoil: 0,
            }
        })
        .collect();
    geometry.pitch_reference_radius = 1.0;
    let airfoil = Airfoil::read(&project().join("tests/data/frictionless.polar")).unwrap();
    for (inflow, below) in [
        // What remains is the cutout, of which the disc's momentum does not know.
        (Inflow::Disc(Skew::Uniform), 1e-3),
        (Inflow::FiniteBlades, 2e-3),
        // And the swirl that the annulus has and momentum theory has not.
        (Inflow::Annulus, 5e-3),
    ] {
        let mut models = models(inflow, Blades::Automatic);
        models.tip_loss = TipLoss::None;
        models.section.lift = Lift::TwoPi;
        models.section.compressibility = Compressibility::None;
        let mut rotor = Rotor::new(geometry.clone(), vec![airfoil.clone()], models, 400);
        let p = rotor.steady(&flight(tip_pitch, Vector3::zeros())).unwrap();
        let reference = 1.2 * PI * SPEED * SPEED;
        let (ct, cp) = (p.force.z / reference, p.torque / reference);
        let merit = ct.powf(1.5) / (2.0_f64.sqrt() * cp);
        assert!((1.0 - merit).abs() < below, "{inflow:?}: {merit}");
    }
}

/// A block in forward flight with flapping.
fn flapping_block(inflow: &str) -> RotorBlock {
    let mut block = default_block();
    block
        .set_integers(
            &[integer::MODELS__INFLOW],
            &[choice(integer::MODELS__INFLOW, inflow)],
        )
        .unwrap();
    block
        .set_booleans(&[boolean::FLAPPING__ENABLED], &[1])
        .unwrap();
    set(&mut block, real::VELOCITY_1, 15.0);
    block
}

const ANSWER: [RealRef; 6] = [
    real::THRUST,
    real::HUB_MOMENT_1,
    real::CONING,
    real::LONGITUDINAL_FLAPPING,
    real::LATERAL_FLAPPING,
    real::AZIMUTH,
];

#[test]
fn power_is_torque_times_speed_and_rotor_speed_is_rpm() {
    let mut block = flapping_block("drees");
    block.start().unwrap();
    for _ in 0..10 {
        block.step(0.0031).unwrap();
        let out = |place: RealRef| block.values().reals[place];
        let expected = out(real::TORQUE) * 960.0 * PI / 30.0;
        assert!((out(real::POWER) / expected - 1.0).abs() < 1e-12);
        assert!((out(real::HUB_MOMENT_3) + out(real::TORQUE)).abs() < 1e-12);
        assert_eq!(out(real::ROTOR_SPEED), 960.0);
    }
}

/// A jump of collective after a steady start, with the time cut in different ways.
#[test]
fn the_communication_step_does_not_change_the_motion_of_the_blades() {
    let after = |steps: &[f64]| {
        let mut block = flapping_block("pittPetersDynamic");
        block.start().unwrap();
        set(&mut block, real::COLLECTIVE, 0.2);
        set(&mut block, real::CYCLIC_LONGITUDINAL, 0.05);
        for step in steps {
            block.step(*step).unwrap();
        }
        ANSWER.map(|place| block.values().reals[place])
    };
    let once = after(&[0.1]);
    let mut odd = vec![0.0073; 13];
    odd.push(0.1 - 13.0 * 0.0073);
    for steps in [vec![0.001; 100], odd] {
        let cut = after(&steps);
        for (a, b) in once.iter().zip(cut) {
            assert!((a - b).abs() < 1e-9 * a.abs().max(1.0), "{once:?} {cut:?}");
        }
    }
}

/// The integrator's order shows on smooth sections: thin-airfoil lift.
#[test]
fn the_motion_of_the_blades_is_of_third_order_in_the_azimuth_step() {
    let lift = choice(integer::MODELS__LIFT, "twoPi");
    let after = |degrees: f64| {
        let mut block = flapping_block("pittPetersDynamic");
        let places = [
            integer::MODELS__LIFT,
            integer::INITIALIZATION,
            integer::MODELS__TIP_LOSS,
        ];
        let rest = choice(integer::INITIALIZATION, "rest");
        block.set_integers(&places, &[lift, rest, 1]).unwrap();
        set(&mut block, real::VELOCITY_1, 5.0);
        set(
            &mut block,
            real::NUMERICS__AZIMUTH_STEP,
            degrees.to_radians(),
        );
        block.start().unwrap();
        // 120 degrees.
        block.step(120.0 / 360.0 / 16.0).unwrap();
        block.values().reals[real::CONING]
    };
    let reference = after(0.25);
    let (coarse, fine) = (
        (after(8.0) - reference).abs(),
        (after(4.0) - reference).abs(),
    );
    let order = (coarse / fine).log2();
    assert!(order > 2.5, "order {order}: {coarse:e} {fine:e}");
}

#[test]
fn flapping_with_models_that_cannot_flap_is_refused_with_the_remedy() {
    let refused = |place: IntegerRef, value: i32| {
        let mut block = flapping_block("annulus");
        block.set_integers(&[place], &[value]).unwrap();
        block.start().unwrap_err().to_string()
    };
    let disc = refused(
        integer::MODELS__BLADES,
        choice(integer::MODELS__BLADES, "disc"),
    );
    assert!(
        disc.contains("set models.blades to automatic or individual"),
        "{disc}"
    );
    let many = refused(integer::GEOMETRY__NUMBER_OF_BLADES, 9);
    assert!(many.contains("at most 8 can flap"), "{many}");
    let closed = choice(integer::MODELS__INFLOW, "annulusClosedForm");
    let closed = refused(integer::MODELS__INFLOW, closed);
    assert!(closed.contains("set another inflow model"), "{closed}");
}

/// What the stations show of blade 1 is what it meets: on the advancing side faster air than on the other.
#[test]
fn stations_show_blade_1_on_its_way() {
    let mut block = flapping_block("drees");
    let rpm = 960.0;
    block.start().unwrap();
    let mach = |block: &RotorBlock| block.values().reals[real::STATION_20__MACH];
    let tail = mach(&block);
    block.step(15.0 / rpm).unwrap(); // 90 deg
    let advancing = mach(&block);
    block.step(30.0 / rpm).unwrap();
    let retreating = mach(&block);
    // What flapping and inflow add to the speed is a few per cent.
    let difference = 15.0 / 340.29;
    assert!((advancing - tail - difference).abs() < 0.05 * difference);
    assert!((retreating - tail + difference).abs() < 0.05 * difference);
    let azimuth = block.values().reals[real::AZIMUTH];
    assert!((azimuth - 1.5 * PI).abs() < 1e-9, "{azimuth}");
}

/// A step of hours is refused at once, and a shorter one goes on from where the rotor was.
#[test]
fn a_step_that_is_too_long_is_refused_at_once() {
    let mut block = flapping_block("pittPetersDynamic");
    block.start().unwrap();
    let mut other = flapping_block("pittPetersDynamic");
    other.start().unwrap();
    let begin = std::time::Instant::now();
    let error = block.step(1e4).unwrap_err().to_string();
    assert!(error.contains("a step of 10000 s is too long"), "{error}");
    assert!(begin.elapsed().as_secs_f64() < 1.0);
    block.step(0.01).unwrap();
    other.step(0.01).unwrap();
    let answer = |block: &RotorBlock| ANSWER.map(|place| block.values().reals[place].to_bits());
    assert_eq!(answer(&block), answer(&other));
}
