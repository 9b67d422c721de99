//! Time integration of the rotor's states.
//!
//! Steps of the rotor on a grid of azimuth that begins where the simulation does, and anew where the
//! inputs change. A communication point between two grid points is met exactly, by a shorter step from
//! the grid point before; the next step goes on from that grid point, not from the communication point,
//! as long as the inputs stay the same. So constant inputs give the same answer, to the rounding of
//! times, whatever the communication step. Inputs that move within a communication step begin a grid of their
//! own at its beginning.

use rotor::{Drive, Operation, Rotor, SolveError, State};

/// The states, and the place on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// At present.
    pub state: State,
    pub since: Option<Since>,
}

/// The beginning of the stretch with the present inputs, or the last grid point in it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Since {
    pub operation: Operation,
    pub state: State,
    /// Time from there to the present, s.
    pub elapsed: f64,
}

/// What the inputs ask of the rotor during a communication step.
pub enum Inputs<F> {
    Constant(Operation),
    /// By the time since the beginning of the communication step, s.
    Moving(F),
}

impl<F: FnMut(f64) -> Operation> Inputs<F> {
    fn at(&mut self, offset: f64) -> Operation {
        match self {
            Self::Constant(operation) => *operation,
            Self::Moving(operation_at) => operation_at(offset),
        }
    }
}

/// Longest grid cell, s, for slow rotors.
pub const LONGEST_CELL: f64 = 0.02;

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

/// The states after `duration` s (> 0). `azimuth_step` in rad.
pub fn advance<F: FnMut(f64) -> Operation>(
    rotor: &mut Rotor,
    mut inputs: Inputs<F>,
    memory: &Memory,
    duration: f64,
    azimuth_step: f64,
) -> Result<Memory, SolveError> {
    let operation = inputs.at(0.0);
    let is_constant = matches!(inputs, Inputs::Constant(_));
    if !rotor.has_memory(&operation) {
        // The mean of a speed that changes linearly.
        let speed = if is_constant {
            operation.speed
        } else {
            0.5 * (operation.speed + inputs.at(duration).speed)
        };
        let mut state = memory.state;
        state.azimuth += speed * duration;
        return Ok(Memory::starting(state));
    }
    let mut since = match memory.since {
        Some(since) if is_constant && since.operation == operation => since,
        _ => Since {
            operation,
            state: memory.state,
            elapsed: 0.0,
        },
    };
    let mut left = since.elapsed + duration;
    let mut steps = 0;
    loop {
        // Of the grid point, where inputs that move are those of its time.
        let begin = duration - left;
        let operation = inputs.at(begin);
        // Infinite for a rotor at rest.
        let speed = operation.at_speed_of(&since.state).speed;
        let mut cell = (azimuth_step / speed.abs()).min(LONGEST_CELL);
        if let Drive::Torque { torque, inertia } = operation.drive {
            // Nor may the speed that a torque gives turn the rotor further.
            cell = cell.min(libm::sqrt(2.0 * azimuth_step * inertia / torque.abs()));
        }
        // Rather at once than after all the work that is allowed.
        if steps == 0
            && left / cell * rotor.steps(&operation, &since.state, cell) > f64::from(MOST_STEPS)
            && rotor.never_rests(&operation, &since.state)
        {
            return Err(SolveError::StepTooLong(duration));
        }
        let reaches_grid = left >= cell * (1.0 - 1e-9);
        let part = if reaches_grid { cell } else { left };
        let stretch = Stretch { begin, part };
        let state = integrate(rotor, &mut inputs, &since.state, stretch, &mut steps)
            .and_then(|state| state.ok_or(SolveError::StepTooLong(duration)))?;
        if !reaches_grid {
            since.elapsed = left;
            return Ok(Memory {
                state,
                since: is_constant.then_some(since),
            });
        }
        left = (left - part).max(0.0);
        // A torque, however faint, moves the rotor in the end.
        let is_free = operation.drive != Drive::Speed;
        let stands_still = is_constant
            && !is_free
            && state.largest_change(&since.state) <= still(rotor, &operation);
        since.state = state;
        if stands_still {
            since.state.azimuth += speed * left;
            left = 0.0;
        }
        since.elapsed = left;
        if left == 0.0 {
            return Ok(Memory {
                state: since.state,
                since: is_constant.then_some(since),
            });
        }
    }
}

/// The change of the states within a step from which on they stand still.
fn still(rotor: &Rotor, operation: &Operation) -> f64 {
    let speeds = operation.speed * rotor.geometry().radius + operation.airspeed.norm();
    if speeds > 0.0 {
        STANDSTILL * speeds
    } else {
        STILL_AIR
    }
}

/// A part of the communication step, s, from its beginning.
#[derive(Clone, Copy)]
struct Stretch {
    begin: f64,
    part: f64,
}

/// The states after a stretch, in steps that are short enough for the states' fastest rate at its beginning
/// and, where inputs move, at its end; none if that makes more than `MOST_STEPS` in all.
fn integrate<F: FnMut(f64) -> Operation>(
    rotor: &mut Rotor,
    inputs: &mut Inputs<F>,
    start: &State,
    Stretch { begin, part }: Stretch,
    steps: &mut u32,
) -> Result<Option<State>, SolveError> {
    let mut count = rotor.steps(&inputs.at(begin), start, part);
    if matches!(inputs, Inputs::Moving(_)) {
        count = count.max(rotor.steps(&inputs.at(begin + part), start, part));
    }
    if count.is_nan() || count > f64::from(MOST_STEPS - *steps) {
        return Ok(None);
    }
    *steps += count as u32;
    let step = part / count;
    let mut state = *start;
    for i in 0..count as u32 {
        let from = begin + f64::from(i) * step;
        state = rotor.step(|offset| inputs.at(from + offset), &state, step)?;
    }
    Ok(Some(state))
}
