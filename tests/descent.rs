//! Vertical descent through the vortex ring state and the turbulent wake state to the windmill
//! brake state. crates/program/tests/validation.rs compares it with measurements.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "support/block.rs"]
mod support;

use helicopter_rotor::block::{
    RotorBlock,
    variables::{FlowState, RealRef, integer, real},
};
use support::{choose, default_block, set, set_integer};

fn block(inflow: &str, descent: &str) -> RotorBlock {
    let mut block = default_block();
    let pairs = [
        (integer::MODELS__INFLOW, inflow),
        (integer::MODELS__DESCENT, descent),
        (integer::MODELS__BLADES, "disc"),
    ];
    for (reference, name) in pairs {
        choose(&mut block, reference, name);
    }
    block
}

/// An output at a rate of descent, m/s.
fn descending(block: &mut RotorBlock, speed: f64, reference: RealRef) -> f64 {
    set(block, real::VELOCITY_3, -speed);
    block.update().unwrap();
    block.values().reals[reference]
}

/// Hover and slow climb do not depend on the law of descent. In a faster climb single annuli have
/// negative thrust, which for them is a descent.
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

/// All rates of descent at one collective, in steps of a thousandth of v_h.
#[test]
fn thrust_is_continuous_from_hover_to_the_windmill() {
    const STEP: f64 = 4.3e-3;
    // Low enough that no section stalls in the last case. With stall there can be several thrusts
    // at one rate of descent.
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
            // A share of the fall or rise. Momentum theory jumps by tens of per cent.
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

/// Edgewise flow carries the wake away. At three times v_h the laws agree.
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
fn the_flow_state_passes_through_all_its_values_in_descent() {
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
    // Forward flight, level and in autorotation.
    set(&mut block, real::VELOCITY_1, 20.0);
    for (speed, expected) in [(0.0, FlowState::Normal), (8.0, FlowState::WindmillBrake)] {
        descending(&mut block, speed, real::THRUST);
        let state = block.values().integers[integer::FLOW_STATE];
        assert_eq!(FlowState::from_integer(state), Some(expected));
    }
}

/// From hover to the windmill brake state and back in a minute: in no step of 20 ms does the thrust
/// jump, and it rises and falls only a few times.
#[test]
fn thrust_does_not_chatter_in_the_vortex_ring() {
    // Largest relative change per step, and maximum number of turns from rise to fall or back. The
    // many states of Peters & He oscillate when they enter the vortex ring.
    for (inflow, change, max_turns) in [
        ("annulus", 0.005, 5),
        ("pittPetersDynamic", 0.005, 13),
        ("petersHe", 0.05, 20),
    ] {
        let mut block = block(inflow, "measured");
        set_integer(&mut block, integer::NUMERICS__ELEMENTS, 12);
        block.start().unwrap();
        let mut thrusts = Vec::new();
        for i in 0..=3000 {
            let part = 1.0 - (f64::from(i) / 1500.0 - 1.0).abs();
            set(&mut block, real::VELOCITY_3, -14.0 * part);
            block.step(0.02).unwrap();
            thrusts.push(block.values().reals[real::THRUST]);
        }
        let hover = thrusts[0];
        let steps = thrusts.windows(2).map(|pair| (pair[1] - pair[0]).abs());
        let largest = steps.fold(0.0, f64::max) / hover;
        assert!(largest < change, "{inflow}: {largest}");
        let slopes: Vec<f64> = thrusts.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let counted = slopes.iter().filter(|s| s.abs() > 1e-6 * hover);
        let signs: Vec<bool> = counted.map(|s| *s > 0.0).collect();
        let turns = signs.windows(2).filter(|pair| pair[0] != pair[1]).count();
        assert!(turns <= max_turns, "{inflow}: {turns} turns");
    }
}
