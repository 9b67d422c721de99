//! Vertical descent through the vortex ring and the turbulent wake to the windmill, against Castles & Gray
//! (1951, NACA TN 2474, Table I) and against itself.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "support/block.rs"]
mod support;

use helicopter_rotor::block::{
    RotorBlock,
    variables::{FlowState, integer, real, string},
};
use std::{f64::consts::PI, fs};
use support::{choose, default_block, project, set};

fn block(inflow: &str, descent: &str) -> RotorBlock {
    let mut block = default_block();
    let pairs = [
        (integer::MODEL__INFLOW, inflow),
        (integer::MODEL__DESCENT, descent),
        (integer::MODEL__BLADES, "disc"),
    ];
    for (place, name) in pairs {
        choose(&mut block, place, name);
    }
    block
}

/// An output in a vertical descent, m/s.
fn descending(block: &mut RotorBlock, speed: f64, place: usize) -> f64 {
    set(block, real::VELOCITY_3, -speed);
    block.update().unwrap();
    block.values().reals[place]
}

/// Rows of the table: CT, rpm, collective in deg, V_d/v_h.
fn measured() -> Vec<[f64; 4]> {
    let file = "fmu-examples/data/castles-gray-1951-tn2474-tableI-descent-6ft.csv";
    let text = fs::read_to_string(project().join(file)).unwrap();
    let lines = text.lines().filter(|l| !l.starts_with('#')).skip(1);
    let rows = lines.filter_map(|line| {
        let cell = |i: usize| line.split(',').nth(i)?.parse::<f64>().ok();
        Some([cell(1)?, cell(2)?, cell(4)?, cell(6)?])
    });
    rows.collect()
}

/// RMS difference, deg, between the collective that the rotor needs for the measured thrust and the measured
/// collective, over all rows.
fn collective_error(inflow: &str, descent: &str) -> f64 {
    let mut block = block(inflow, descent);
    block
        .set_strings(&[string::GEOMETRY__FILE as u32], &["castles-gray-6ft.toml"])
        .unwrap();
    let (mut sum, mut count) = (0.0, 0.0);
    for [thrust_coefficient, rpm, degrees, descent_ratio] in measured() {
        let hover = rpm * PI / 30.0 * 0.9144 * (thrust_coefficient / 2.0).sqrt();
        set(&mut block, real::RPM, rpm);
        let mut surplus = |degrees: f64| {
            set(&mut block, real::COLLECTIVE, degrees.to_radians());
            descending(&mut block, descent_ratio * hover, real::THRUST_COEFFICIENT)
                - thrust_coefficient
        };
        let (mut low, mut high) = (-12.0, 25.0);
        assert!(surplus(low) < 0.0 && surplus(high) > 0.0);
        while high - low > 1e-3 {
            let middle = 0.5 * (low + high);
            if surplus(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        sum += (low - degrees).powi(2);
        count += 1.0;
    }
    assert_eq!(count, 143.0);
    (sum / count).sqrt()
}

/// The README's table: law, and its errors with the inflow models of the columns.
fn published() -> Vec<(String, f64)> {
    let readme = fs::read_to_string(project().join("README.md")).unwrap();
    let table = readme.split("<!-- descent -->").nth(1).unwrap();
    let rows = table.lines().filter_map(|line| {
        let mut cells = line.split('|').map(str::trim).skip(1);
        Some((
            cells.next()?.trim_matches('`').to_owned(),
            cells.next()?.parse().ok()?,
        ))
    });
    rows.collect()
}

#[test]
fn the_collective_for_a_thrust_in_descent_is_the_measured_one() {
    let published = published();
    assert_eq!(published.len(), 5);
    for (name, said) in published {
        let (descent, inflow) = name.split_once(", ").unwrap();
        let error = collective_error(inflow, descent);
        println!("{descent:9} {inflow:12} {error:.2} deg RMS");
        assert!((error - said).abs() < 0.006, "README.md, {name}: {error}");
        if descent == "measured" {
            assert!(error < 0.9, "{inflow}: {error}");
        }
    }
}

/// In climb and hover nothing depends on the law of descent (but where single annuli pull down: their climb is
/// a descent).
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

/// In time, from hover to the windmill and back in a minute: no step of 20 ms changes the thrust by more than a
/// smooth way through would, and the thrust does not go up and down.
#[test]
fn nothing_chatters_on_the_way_through_the_vortex_ring() {
    // Per step, and turns of the whole way there and back; the many states of Peters & He swing as they enter
    // the vortex ring.
    for (inflow, change, most_turns) in [
        ("annulus", 0.005, 5),
        ("pittPetersDynamic", 0.005, 13),
        ("petersHe", 0.05, 20),
    ] {
        let mut block = block(inflow, "measured");
        let elements = integer::NUMERICS__ELEMENTS as u32;
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
