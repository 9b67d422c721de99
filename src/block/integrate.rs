//! Time integration of the rotor's states.
//!
//! Steps of the rotor on a grid of azimuth that begins where the simulation does, and anew where the
//! inputs change. A communication point between two grid points is met exactly, by a shorter step from
//! the grid point before; the next step goes on from that grid point, not from the communication point,
//! as long as the inputs stay the same. So constant inputs give the same answer, to the rounding of
//! times, whatever the communication step.

use crate::rotor::{Drive, Operation, Rotor, SolveError, State};

/// The states, and the place on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// At present.
    pub state: State,
    since: Option<Since>,
}

/// The beginning of the stretch with the present inputs, or the last grid point in it.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Since {
    operation: Operation,
    state: State,
    /// Time from there to the present, s.
    elapsed: f64,
}

/// Longest grid cell, s, for slow rotors.
const LONGEST_CELL: f64 = 0.02;

/// Most steps within one communication step.
const MOST_STEPS: u32 = 100_000;

/// A change of the states within a step, as a part of the speeds in the problem, from which on they
/// stand still.
const STANDSTILL: f64 = 1e-15;

/// The same, m/s, for a rotor that stands in still air, whose own wake dies away ever more slowly.
const STILL_AIR: f64 = 1e-8;

impl Memory {
    /// States to start from.
    pub fn starting(state: State) -> Self {
        Self { state, since: None }
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
    if !rotor.has_memory(operation) {
        let mut state = memory.state;
        state.azimuth += operation.speed * duration;
        return Ok(Memory::starting(state));
    }
    let mut since = match memory.since {
        Some(since) if since.operation == *operation => since,
        _ => Since {
            operation: *operation,
            state: memory.state,
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
        // Of the speed at the grid point; infinite for a rotor at rest.
        let speed = operation.at_speed_of(&since.state).speed;
        let mut cell = (azimuth_step / speed.abs()).min(LONGEST_CELL);
        if let Drive::Torque { torque, inertia } = operation.drive {
            // Nor may the speed that a torque gives turn the rotor further.
            cell = cell.min(libm::sqrt(2.0 * azimuth_step * inertia / torque.abs()));
        }
        // Rather at once than after all the work that is allowed.
        if steps == 0
            && left / cell * rotor.steps(operation, &since.state, cell) > f64::from(MOST_STEPS)
            && rotor.never_rests(operation, &since.state)
        {
            return Err(SolveError::StepTooLong(duration));
        }
        let reaches_grid = left >= cell * (1.0 - 1e-9);
        let part = if reaches_grid { cell } else { left };
        let state = integrate(rotor, operation, &since.state, part, &mut steps)
            .and_then(|state| state.ok_or(SolveError::StepTooLong(duration)))?;
        if !reaches_grid {
            since.elapsed = left;
            return Ok(Memory {
                state,
                since: Some(since),
            });
        }
        left = (left - part).max(0.0);
        // A torque, however faint, moves the rotor in the end.
        let is_free = operation.drive != Drive::Speed;
        let stands_still = !is_free && state.largest_change(&since.state) <= still;
        since.state = state;
        if stands_still {
            since.state.azimuth += speed * left;
            left = 0.0;
        }
        since.elapsed = left;
        if left == 0.0 {
            return Ok(Memory {
                state: since.state,
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
    start: &State,
    part: f64,
    steps: &mut u32,
) -> Result<Option<State>, SolveError> {
    let count = rotor.steps(operation, start, part);
    if count.is_nan() || count > f64::from(MOST_STEPS - *steps) {
        return Ok(None);
    }
    *steps += count as u32;
    let mut state = *start;
    for _ in 0..count as u32 {
        state = rotor.step(operation, &state, part / count)?;
    }
    Ok(Some(state))
}
