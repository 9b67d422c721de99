//! Vertical descent through the vortex ring and the turbulent wake to the windmill.
//! tests/validation.rs holds it against measurements.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "support/block.rs"]
mod support;

use helicopter_rotor::block::{
    RotorBlock,
    variables::{FlowState, RealRef, integer, real},
};
use support::{choose, default_block, set};

fn block(inflow: &str, descent: &str) -> RotorBlock {
    let mut block = default_block();
    let pairs = [
        (integer::MODELS__INFLOW, inflow),
        (integer::MODELS__DESCENT, descent),
        (integer::MODELS__BLADES, "disc"),
    ];
    for (place, name) in pairs {
        choose(&mut block, place, name);
    }
    block
}

/// An output in a vertical descent, m/s.
fn descending(block: &mut RotorBlock, speed: f64, place: RealRef) -> f64 {
    set(block, real::VELOCITY_3, -speed);
    block.update().unwrap();
    block.values().reals[place]
}

/// In climb and hover nothing depends on the law of descent (but where single annuli pull down:
/// their climb is a descent).
#[test]
fn climb_and_hover_are_momentum_theory_with_every_law() {
    for (inflow, climb) in [
        ("annulus", 0.5),
        ("uniform", 4.0),
        ("finiteBlades", 0.5),
        ("pittPetersDynamic", 4.0),
    ] {
        for speed in [0.0, -1e-9, -climb] {
            let thrust = |descent| descending(&mut block(inflow, descent), speed, real::THRUST);
            let momentum = thrust("momentum");
            for descent in ["measured", "johnson"] {
                let part = thrust(descent) / momentum - 1.0;
                assert!(part.abs() < 1e-12, "{inflow} {descent} {speed}: {part}");
            }
        }
    }
}

/// Through the whole of descent at a collective, in steps of a thousandth of v_h.
#[test]
fn thrust_is_continuous_from_hover_to_the_windmill() {
    const STEP: f64 = 4.3e-3;
    // Low enough that no section stalls with the last two: stall folds the blades' own thrust.
    const HIGH: f64 = 0.14;
    const LOW: f64 = 0.06;
    for (inflow, descent, collective) in [
        ("uniform", "measured", HIGH),
        ("drees", "measured", HIGH),
        ("annulus", "measured", HIGH),
        ("finiteBlades", "measured", HIGH),
        ("uniform", "johnson", LOW),
    ] {
        for edgewise in [0.0, 3.0] {
            let mut block = block(inflow, descent);
            set(&mut block, real::VELOCITY_1, edgewise);
            set(&mut block, real::COLLECTIVE, collective);
            let mut thrust = |i: usize| descending(&mut block, STEP * i as f64, real::THRUST);
            let hover = thrust(0);
            let mut previous = hover;
            let mut largest = 0.0_f64;
            for i in 1..4000 {
                let next = thrust(i);
                largest = largest.max((next - previous).abs() / hover);
                previous = next;
            }
            // The step's share of the fall or rise; momentum theory jumps by tens of per cent.
            assert!(largest < 0.005, "{inflow} {descent} {edgewise}: {largest}");
        }
    }
}

#[test]
fn momentum_theory_alone_jumps_to_the_windmill() {
    let mut block = block("uniform", "momentum");
    let mut largest = 0.0_f64;
    let mut previous = descending(&mut block, 0.0, real::THRUST);
    for i in 1..4000 {
        let next = descending(&mut block, 4.3e-3 * f64::from(i), real::THRUST);
        largest = largest.max((next / previous - 1.0).abs());
        previous = next;
    }
    assert!(largest > 0.1, "{largest}");
}

/// Flow along the disc carries the wake away: at three times v_h the laws agree.
#[test]
fn the_vortex_ring_fades_with_flow_along_the_disc() {
    for inflow in ["uniform", "annulus"] {
        let thrust = |descent, edgewise: f64| {
            let mut block = block(inflow, descent);
            set(&mut block, real::VELOCITY_1, edgewise);
            descending(&mut block, 4.0, real::THRUST)
        };
        let apart = |descent, edgewise| {
            (thrust(descent, edgewise) / thrust("momentum", edgewise) - 1.0).abs()
        };
        for descent in ["measured", "johnson"] {
            assert!(apart(descent, 0.0) > 0.1);
            assert!(
                apart(descent, 13.0) < 0.02,
                "{descent} {}",
                apart(descent, 13.0)
            );
        }
    }
}

#[test]
fn the_state_of_the_flow_goes_through_its_names_in_descent() {
    let mut block = block("uniform", "measured");
    let mut seen = Vec::new();
    for i in 0..400 {
        descending(&mut block, 0.05 * f64::from(i) - 1.0, real::THRUST);
        let state = FlowState::from_integer(block.values().integers[integer::FLOW_STATE]).unwrap();
        if seen.last() != Some(&state) {
            seen.push(state);
        }
    }
    let expected = [
        FlowState::Normal,
        FlowState::VortexRing,
        FlowState::TurbulentWake,
        FlowState::WindmillBrake,
    ];
    assert_eq!(seen, expected);
    // Forward, level or in autorotation.
    set(&mut block, real::VELOCITY_1, 20.0);
    for (speed, expected) in [(0.0, FlowState::Normal), (8.0, FlowState::WindmillBrake)] {
        descending(&mut block, speed, real::THRUST);
        let state = block.values().integers[integer::FLOW_STATE];
        assert_eq!(FlowState::from_integer(state), Some(expected));
    }
}

/// In time, from hover to the windmill and back in a minute: no step of 20 ms changes the thrust by
/// more than a smooth way through would, and the thrust does not go up and down.
#[test]
fn nothing_chatters_on_the_way_through_the_vortex_ring() {
    // Per step, and turns of the whole way there and back; the many states of Peters & He swing as
    // they enter the vortex ring.
    for (inflow, change, most_turns) in [
        ("annulus", 0.005, 5),
        ("pittPetersDynamic", 0.005, 13),
        ("petersHe", 0.05, 20),
    ] {
        let mut block = block(inflow, "measured");
        let elements = integer::NUMERICS__ELEMENTS;
        block.set_integers(&[elements], &[12]).unwrap();
        block.start().unwrap();
        let mut on_the_way = Vec::new();
        for i in 0..=3000 {
            let part = 1.0 - (f64::from(i) / 1500.0 - 1.0).abs();
            set(&mut block, real::VELOCITY_3, -14.0 * part);
            block.step(0.02).unwrap();
            on_the_way.push(block.values().reals[real::THRUST]);
        }
        let hover = on_the_way[0];
        let steps = on_the_way.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let largest = steps.fold(0.0, f64::max) / hover;
        assert!(largest < change, "{inflow}: {largest}");
        let slopes: Vec<f64> = on_the_way
            .windows(2)
            .map(|pair| pair[1] - pair[0])
            .collect();
        let counted = slopes.iter().filter(|s| s.abs() > 1e-6 * hover);
        let signs: Vec<bool> = counted.map(|s| *s > 0.0).collect();
        let turns = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert!(turns <= most_turns, "{inflow}: {turns} turns");
    }
}
