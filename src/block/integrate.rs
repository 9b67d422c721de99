//! Time integration of the rotor's states.
//!
//! Heun's method (order 2; Heun 1900, Z. Math. Phys. 45, p. 23) on a grid of azimuth that begins where
//! the simulation does, and anew where the inputs change. A communication point between two grid
//! points is met exactly, by a shorter step from the grid point before; the next step goes on from that
//! grid point, not from the communication point, as long as the inputs stay the same. So constant
//! inputs give the same answer, to the rounding of times, whatever the communication step.

use crate::rotor::{Operation, Rotor, SolveError, inflow::Field};

/// The states, and the place on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// At present.
    pub inflow: Field,
    since: Option<Since>,
}

/// The beginning of the stretch with the present inputs, or the last grid point in it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Since {
    operation: Operation,
    inflow: Field,
    /// Time from there to the present, s.
    elapsed: f64,
}

/// Longest grid cell, s, for slow rotors.
const LONGEST_CELL: f64 = 0.02;

/// Largest product of a step and the states' fastest rate: Heun's method is stable below 2.
const LARGEST_PRODUCT: f64 = 0.5;

/// Most steps within one communication step.
const MOST_STEPS: u32 = 100_000;

/// A change of the states within a step, as a part of the speeds in the problem, from which on they
/// stand still.
const STANDSTILL: f64 = 1e-15;

/// The same, m/s, for a rotor that stands in still air, whose own wake dies away ever more slowly.
const STILL_AIR: f64 = 1e-8;

impl Memory {
    /// States to start from.
    pub fn starting(inflow: Field) -> Self {
        Self {
            inflow,
            ..Self::default()
        }
    }
}

/// The states after `duration` s (> 0) with constant inputs. `azimuth_step` in rad.
pub fn advance(
    rotor: &mut Rotor,
    operation: &Operation,
    memory: &Memory,
    duration: f64,
    azimuth_step: f64,
) -> Result<Memory, SolveError> {
    // Infinite for a rotor at rest.
    let cell = (azimuth_step / operation.speed).min(LONGEST_CELL);
    let mut since = match memory.since {
        Some(since) if since.operation == *operation => since,
        _ => Since {
            operation: *operation,
            inflow: memory.inflow,
            elapsed: 0.0,
        },
    };
    let speeds = operation.speed * rotor.geometry().radius + operation.airspeed.norm();
    let still = if speeds > 0.0 {
        STANDSTILL * speeds
    } else {
        STILL_AIR
    };
    let mut left = since.elapsed + duration;
    let mut steps = 0;
    loop {
        let reaches_grid = left >= cell * (1.0 - 1e-9);
        let part = if reaches_grid { cell } else { left };
        let inflow = integrate(rotor, operation, &since.inflow, part, &mut steps)
            .and_then(|inflow| inflow.ok_or(SolveError::StepTooLong(duration)))?;
        if !reaches_grid {
            since.elapsed = left;
            return Ok(Memory {
                inflow,
                since: Some(since),
            });
        }
        let change = inflow.plus(-1.0, &since.inflow).to_array();
        let stands_still = change.iter().all(|c| c.abs() <= still);
        left = if stands_still {
            0.0
        } else {
            (left - part).max(0.0)
        };
        since.inflow = inflow;
        since.elapsed = left;
        if left == 0.0 {
            return Ok(Memory {
                inflow,
                since: Some(since),
            });
        }
    }
}

/// The states after `part` s, in steps that are short enough for the states' fastest rate; none if
/// that makes more than `MOST_STEPS` in all.
fn integrate(
    rotor: &mut Rotor,
    operation: &Operation,
    start: &Field,
    part: f64,
    steps: &mut u32,
) -> Result<Option<Field>, SolveError> {
    let fastest = rotor.fastest_rate(operation, start);
    let count = libm::ceil((part * fastest / LARGEST_PRODUCT).max(1.0));
    if count > f64::from(MOST_STEPS - *steps) {
        return Ok(None);
    }
    *steps += count as u32;
    let mut inflow = *start;
    for _ in 0..count as u32 {
        inflow = heun(rotor, operation, &inflow, part / count)?;
    }
    Ok(Some(inflow))
}

fn heun(
    rotor: &mut Rotor,
    operation: &Operation,
    field: &Field,
    step: f64,
) -> Result<Field, SolveError> {
    let first = rotor.rate(operation, field)?;
    let second = rotor.rate(operation, &field.plus(step, &first))?;
    Ok(field.plus(0.5 * step, &first).plus(0.5 * step, &second))
}
