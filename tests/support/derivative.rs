//! Exact derivatives of the block, and the scales on which they are compared with differences.

// Each test program uses a part of this.
#![allow(dead_code)]

use helicopter_rotor::block::{
    RotorBlock,
    variables::{Causality, REALS, STATES, is_state, real},
};

pub fn inputs_and_states() -> Vec<usize> {
    let is_known = |i: &usize| REALS[*i].causality == Causality::Input || is_state(*i as u32);
    (0..REALS.len()).filter(is_known).collect()
}

pub fn outputs_and_rates() -> Vec<usize> {
    let is_rate = |i: usize| STATES.iter().any(|row| row.derivative == i);
    let is_unknown = |i: &usize| REALS[*i].causality == Causality::Output || is_rate(*i);
    (0..REALS.len()).filter(is_unknown).collect()
}

/// A change of a known that counts as one: its order of magnitude.
pub fn known_scale(place: usize) -> f64 {
    if let Some(state) = STATES.iter().find(|row| row.place == place) {
        return state.nominal;
    }
    match (place, REALS[place].unit) {
        (real::ALTITUDE, _) => 1000.0,
        (_, "rad") => 0.1,
        (_, "rev/min") => 1000.0,
        (_, "m/s") => 10.0,
        (_, "N.m") => 5.0,
        _ => 1.0,
    }
}

/// A change of an unknown that counts as one, at least.
pub fn unknown_scale(place: usize) -> f64 {
    match REALS[place].unit {
        "N" | "N.m" | "W" => 1.0,
        "m/s2" | "rad/s2" => 1.0,
        "1" => 1e-4,
        _ => 0.01,
    }
}

/// The exact derivatives of unknowns by one known.
pub fn exact(block: &mut RotorBlock, unknowns: &[usize], known: usize) -> Vec<f64> {
    exact_along(block, unknowns, known, 1.0)
}

/// The same times a seed, whose sign tells to which side of a corner the direction leads.
pub fn exact_along(
    block: &mut RotorBlock,
    unknowns: &[usize],
    known: usize,
    seed: f64,
) -> Vec<f64> {
    let references: Vec<u32> = unknowns.iter().map(|u| *u as u32).collect();
    let mut out = vec![f64::NAN; unknowns.len()];
    block
        .directional_derivative(&references, &[known as u32], &[seed], &mut out)
        .unwrap_or_else(|error| panic!("{}: {error}", REALS[known].name));
    out
}
