//! Flapping blades by way of the variables: their motion in time, the stations along a blade, and
//! the combinations of models that are refused.

use crate::support::block::{
    choice, choose, default_block, enable_flapping, get, set, set_integer,
};
use helicopter_rotor::block::{
    Note, RotorBlock,
    variables::{IntegerRef, RealRef, integer, real},
};
use std::f64::consts::PI;

/// A rotor with flapping blades in forward flight.
fn flapping_block(inflow: &str) -> RotorBlock {
    let mut block = default_block();
    choose(&mut block, integer::MODELS__INFLOW, inflow);
    enable_flapping(&mut block);
    set(&mut block, real::VELOCITY_1, 15.0);
    block
}

const OUTPUTS: [RealRef; 6] = [
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
        let out = |reference: RealRef| get(&block, reference);
        let expected = out(real::TORQUE) * 960.0 * PI / 30.0;
        assert!((out(real::POWER) / expected - 1.0).abs() < 1e-12);
        assert!((out(real::HUB_MOMENT_3) + out(real::TORQUE)).abs() < 1e-12);
        assert_eq!(out(real::ROTOR_SPEED), 960.0);
    }
}

/// A jump of collective and cyclic pitch after a steady start, in steps of different lengths.
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
        OUTPUTS.map(|reference| get(&block, reference))
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

/// The order of the integrator can be seen with smooth section data only, here thin-airfoil lift.
#[test]
fn the_motion_of_the_blades_is_of_third_order_in_the_azimuth_step() {
    let lift = choice(integer::MODELS__LIFT, "twoPi");
    let after = |degrees: f64| {
        let mut block = flapping_block("pittPetersDynamic");
        let references = [
            integer::MODELS__LIFT,
            integer::INITIALIZATION,
            integer::MODELS__TIP_LOSS,
        ];
        let rest = choice(integer::INITIALIZATION, "rest");
        block.set_integers(&references, &[lift, rest, 1]).unwrap();
        set(&mut block, real::VELOCITY_1, 5.0);
        set(
            &mut block,
            real::NUMERICS__AZIMUTH_STEP,
            degrees.to_radians(),
        );
        block.start().unwrap();
        // 120 deg of azimuth.
        block.step(120.0 / 360.0 / 16.0).unwrap();
        get(&block, real::CONING)
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
    let refused = |reference: IntegerRef, value: i32| {
        let mut block = flapping_block("annulus");
        set_integer(&mut block, reference, value);
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

/// The stations are those of blade 1 at its azimuth. On the advancing side it meets faster air than
/// on the retreating side.
#[test]
fn the_stations_are_those_of_blade_1_at_its_azimuth() {
    let mut block = flapping_block("drees");
    let rpm = 960.0;
    block.start().unwrap();
    let mach = |block: &RotorBlock| get(block, real::STATION_20__MACH);
    let tail = mach(&block);
    block.step(15.0 / rpm).unwrap(); // 90 deg
    let advancing = mach(&block);
    block.step(30.0 / rpm).unwrap();
    let retreating = mach(&block);
    // Flapping and inflow change the speed by a few per cent.
    let difference = 15.0 / 340.29;
    assert!((advancing - tail - difference).abs() < 0.05 * difference);
    assert!((retreating - tail + difference).abs() < 0.05 * difference);
    let azimuth = get(&block, real::AZIMUTH);
    assert!((azimuth - 1.5 * PI).abs() < 1e-9, "{azimuth}");
}

/// A step of hours is refused at once. A shorter step then continues from the state before it.
#[test]
fn a_step_that_is_too_long_is_refused_at_once() {
    let mut block = flapping_block("pittPetersDynamic");
    block.start().unwrap();
    let mut other = flapping_block("pittPetersDynamic");
    other.start().unwrap();
    let begin = std::time::Instant::now();
    let error = block.step(1e4).unwrap_err().to_string();
    let part = "more work than numerics.budget = 5000000";
    assert!(error.contains(part), "{error}");
    assert!(begin.elapsed().as_secs_f64() < 1.0);
    block.step(0.01).unwrap();
    other.step(0.01).unwrap();
    let outputs = |block: &RotorBlock| OUTPUTS.map(|reference| get(block, reference).to_bits());
    assert_eq!(outputs(&block), outputs(&other));
}

/// Coning, longitudinal and lateral flapping, rad, with which flapping blades start.
fn tip_path_at_start(start: &str, blades: i32, wind: f64, rpm: f64) -> [f64; 3] {
    let mut block = default_block();
    enable_flapping(&mut block);
    set_integer(&mut block, integer::NUMERICS__ELEMENTS, 5);
    set_integer(&mut block, integer::GEOMETRY__NUMBER_OF_BLADES, blades);
    choose(&mut block, integer::INITIALIZATION, start);
    set(&mut block, real::RPM, rpm);
    set(&mut block, real::VELOCITY_1, wind);
    block.start().unwrap();
    [
        real::CONING,
        real::LONGITUDINAL_FLAPPING,
        real::LATERAL_FLAPPING,
    ]
    .map(|reference| get(&block, reference))
}

/// From standstill on, with one, two and four blades: wherever the tip path changes much between
/// two speeds, it changes little between speeds that lie closer together.
#[test]
fn the_tip_path_is_continuous_in_the_rotor_speed() {
    for (start, wind) in [("steady", 0.0), ("rest", 0.0), ("rest", 15.0)] {
        for blades in [1, 2, 4] {
            let at = |rpm: f64| (rpm, tip_path_at_start(start, blades, wind, rpm));
            let mut left = at(0.0);
            // The speeds still to come, the nearest last.
            let mut ahead: Vec<_> = (1..=50).rev().map(|i| at(4.0 * f64::from(i))).collect();
            ahead.insert(ahead.len(), at(0.1));
            while let Some(right) = ahead.last().copied() {
                let pairs = left.1.iter().zip(right.1);
                let change = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
                if change < 0.03 {
                    left = right;
                    ahead.pop();
                    continue;
                }
                let width = right.0 - left.0;
                assert!(
                    width > 1e-3,
                    "{start}, wind {wind}, {blades} blades: {left:?} {right:?}"
                );
                ahead.push(at(left.0 + 0.5 * width));
            }
        }
    }
}

/// A stopped rotor begins on its droop stops, and stays there. With the shaft upside down it is on
/// its flap stops.
#[test]
fn a_stopped_rotor_rests_on_its_stops() {
    for (tilt, stop) in [(0.0, -0.2), (PI, 0.3)] {
        for start in ["steady", "rest"] {
            let mut block = default_block();
            enable_flapping(&mut block);
            choose(&mut block, integer::INITIALIZATION, start);
            for (reference, value) in [
                (real::RPM, 0.0),
                (real::TILT, tilt),
                (real::FLAPPING__LOWEST_ANGLE, -0.2),
                (real::FLAPPING__HIGHEST_ANGLE, 0.3),
            ] {
                set(&mut block, reference, value);
            }
            block.start().unwrap();
            let mut angle = get(&block, real::CONING);
            if start == "rest" {
                assert_eq!(angle, 0.0);
                for _ in 0..300 {
                    block.step(0.01).unwrap();
                    let now = get(&block, real::CONING);
                    assert!((-0.3..0.4).contains(&now), "{start}: {now}");
                }
                angle = get(&block, real::CONING);
            }
            let expected = stop + 0.01 * f64::signum(stop);
            assert!((angle - expected).abs() < 1e-3, "{start}: {angle}");
        }
    }
}

#[test]
fn a_precone_beyond_the_stops_is_refused() {
    let mut block = flapping_block("annulus");
    set(&mut block, real::FLAPPING__PRECONE, 0.1);
    set(&mut block, real::FLAPPING__HIGHEST_ANGLE, 0.05);
    let error = block.start().unwrap_err().to_string();
    assert!(error.contains("lies beyond the stops"), "{error}");
}

/// Blades much too light for their lift balance far beyond the stops. That is no motion of a rotor:
/// the start says so, and has no derivatives.
#[test]
fn a_start_without_a_steady_state_is_a_warning() {
    let mut block = default_block();
    enable_flapping(&mut block);
    set(&mut block, real::FLAPPING__INERTIA, 1e-9);
    block.update().unwrap();
    let warned = block.take_notes().iter().any(|note| match note {
        Note::Warning(text) => text.contains("no state was found"),
        Note::Event(_) => false,
    });
    assert!(warned);
    assert!(get(&block, real::STATE__FLAP_ANGLE_1).abs() < 0.61);
    let mut restored = default_block();
    restored.restore(&block.snapshot()).unwrap();
    for mut block in [block, restored] {
        let error = block
            .directional_derivative(&[real::THRUST], &[real::COLLECTIVE], &[1.0])
            .map(|_| ())
            .unwrap_err();
        assert!(error.to_string().contains("initialization"), "{error}");
    }
}
