//! Exact derivatives of the block, and the scales on which they are compared with differences.

use helicopter_rotor::block::{
    RotorBlock,
    variables::{Causality, RealRef, STATES, real},
};

pub fn inputs_and_states() -> Vec<RealRef> {
    let is_known = |r: &RealRef| r.variable().causality == Causality::Input || r.is_state();
    RealRef::all().filter(is_known).collect()
}

pub fn outputs_and_rates() -> Vec<RealRef> {
    let is_rate = |r: RealRef| STATES.iter().any(|row| row.derivative == r);
    let is_unknown = |r: &RealRef| r.variable().causality == Causality::Output || is_rate(*r);
    RealRef::all().filter(is_unknown).collect()
}

/// The order of magnitude of changes of a known.
pub fn known_scale(reference: RealRef) -> f64 {
    if let Some(state) = STATES.iter().find(|row| row.value == reference) {
        return state.nominal;
    }
    match (reference, reference.variable().unit) {
        (real::ALTITUDE, _) => 1000.0,
        (_, "rad") => 0.1,
        (_, "rev/min") => 1000.0,
        (_, "m/s") => 10.0,
        (_, "N.m") => 5.0,
        _ => 1.0,
    }
}

/// The smallest change of an unknown that counts as large.
pub fn unknown_scale(reference: RealRef) -> f64 {
    match reference.variable().unit {
        "N" | "N.m" | "W" => 1.0,
        "m/s2" | "rad/s2" => 1.0,
        "1" => 1e-4,
        _ => 0.01,
    }
}

/// The exact derivatives of unknowns by one known.
pub fn exact(block: &mut RotorBlock, unknowns: &[RealRef], known: RealRef) -> Vec<f64> {
    exact_along(block, unknowns, known, 1.0)
}

/// The same times a seed. Its sign says to which side of a corner the direction points.
pub fn exact_along(
    block: &mut RotorBlock,
    unknowns: &[RealRef],
    known: RealRef,
    seed: f64,
) -> Vec<f64> {
    block
        .directional_derivative(unknowns, &[known], &[seed])
        .unwrap_or_else(|error| panic!("{}: {error}", known.variable().name))
        .collect()
}
