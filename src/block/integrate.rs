//! Time integration of the rotor's states.
//!
//! The steps of the rotor lie on a grid of azimuth. The grid begins at the start of the simulation,
//! and again where the inputs change. A communication point between two grid points is reached
//! exactly, by a shorter step from the grid point before it. While the inputs stay constant, the
//! next step continues from that grid point and not from the communication point. So constant
//! inputs give the same result, up to the rounding of times, for every communication step. Inputs
//! that move within a communication step begin a grid of their own at its beginning.

use super::known_rates::KnownRates;
use rotor::{Drive, OperatingPoint, Rotor, SolveError, State, Workspace};
use std::sync::Arc;

/// The states, and the position on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// The present states.
    pub state: State,
    /// None if the next step begins a grid at the present states.
    pub since: Option<Since>,
}

/// The last grid point: where the grid begins, or the end of its last full step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Since {
    /// The operating point of the whole grid.
    pub point: OperatingPoint,
    /// The states at the grid point.
    pub state: State,
    /// Time from the grid point to the present, s.
    pub elapsed: f64,
}

/// The operating point during a communication step.
pub enum Inputs<F> {
    Constant(OperatingPoint),
    /// A function of the time since the beginning of the communication step, s.
    Moving(F),
}

impl<F: FnMut(f64) -> OperatingPoint> Inputs<F> {
    fn at(&mut self, offset: f64) -> OperatingPoint {
        match self {
            Self::Constant(point) => *point,
            Self::Moving(point_at) => point_at(offset),
        }
    }
}

/// Maximum time between grid points, s. It holds for slow rotors.
pub const LONGEST_CELL: f64 = 0.02;

/// Maximum number of steps within one communication step.
const MAX_STEPS: u32 = 100_000;

/// Largest change of settled states in a step, as a fraction of tip speed plus airspeed.
const SETTLED: f64 = 1e-15;

/// The same for a stopped rotor in still air, m/s. Its wake decays more and more slowly.
const SETTLED_IN_STILL_AIR: f64 = 1e-8;

impl Memory {
    /// The memory of a simulation that starts with these states.
    pub fn starting(state: State) -> Self {
        Self { state, since: None }
    }
}

/// An integration of a rotor.
pub struct Integration<'a> {
    pub rotor: &'a Arc<Rotor>,
    pub workspace: &'a mut Workspace,
    pub known_rates: &'a mut KnownRates,
    /// Maximum step of azimuth, rad.
    pub azimuth_step: f64,
}

impl Integration<'_> {
    /// The states after `duration` s (> 0).
    pub fn advance<F: FnMut(f64) -> OperatingPoint>(
        &mut self,
        mut inputs: Inputs<F>,
        memory: &Memory,
        duration: f64,
    ) -> Result<Memory, SolveError> {
        let point = inputs.at(0.0);
        let is_constant = matches!(inputs, Inputs::Constant(_));
        if !self.rotor.has_memory(&point) {
            let speed = mean_speed(&mut inputs, duration);
            let mut state = memory.state;
            state.azimuth += speed * duration;
            return Ok(Memory::starting(state));
        }
        let mut since = match memory.since {
            Some(since) if is_constant && since.point == point => since,
            _ => Since {
                point,
                state: memory.state,
                elapsed: 0.0,
            },
        };
        let mut remaining = since.elapsed + duration;
        let mut steps = 0;
        loop {
            // Inputs that move have their values at the time of the grid point.
            let begin = duration - remaining;
            let point = inputs.at(begin);
            let speed = point.at_speed_of(&since.state).speed;
            let cell = self.cell(&point, speed);
            // Fail at once instead of exhausting the step budget.
            if steps == 0
                && remaining / cell * self.rotor.stable_steps(&point, &since.state, cell)
                    > f64::from(MAX_STEPS)
                && self.rotor.evaluate(&point, &since.state).never_settles()
            {
                return Err(SolveError::StepTooLong(duration));
            }
            let reaches_grid = remaining >= cell * (1.0 - 1e-9);
            let part = if reaches_grid { cell } else { remaining };
            let stretch = Stretch { begin, part };
            let state = self
                .integrate(&mut inputs, &since.state, stretch, &mut steps)?
                .ok_or(SolveError::StepTooLong(duration))?;
            if !reaches_grid {
                since.elapsed = remaining;
                return Ok(Memory {
                    state,
                    since: is_constant.then_some(since),
                });
            }
            remaining = (remaining - part).max(0.0);
            // A rotor that a torque drives never settles: even a small torque moves it in the end.
            let has_settled = is_constant
                && !point.is_driven()
                && state.largest_change(&since.state) <= settled(self.rotor, &point);
            since.state = state;
            if has_settled {
                since.state.azimuth += speed * remaining;
                remaining = 0.0;
            }
            since.elapsed = remaining;
            if remaining == 0.0 {
                return Ok(Memory {
                    state: since.state,
                    since: is_constant.then_some(since),
                });
            }
        }
    }

    /// The time to the next grid point, s.
    fn cell(&self, point: &OperatingPoint, speed: f64) -> f64 {
        // The quotient is infinite for a stopped rotor.
        let cell = (self.azimuth_step / speed.abs()).min(LONGEST_CELL);
        match point.drive {
            Drive::Speed => cell,
            // The azimuth gained by the acceleration is limited to the azimuth step, too.
            Drive::Torque { torque, inertia } => {
                cell.min(libm::sqrt(2.0 * self.azimuth_step * inertia / torque.abs()))
            }
        }
    }

    /// The states after a stretch. The steps are short enough for the fastest rate of the states at
    /// its beginning and, if inputs move, at its end. None if that needs more than `MAX_STEPS` in
    /// the communication step.
    fn integrate<F: FnMut(f64) -> OperatingPoint>(
        &mut self,
        inputs: &mut Inputs<F>,
        start: &State,
        Stretch { begin, part }: Stretch,
        steps: &mut u32,
    ) -> Result<Option<State>, SolveError> {
        let mut count = self.rotor.stable_steps(&inputs.at(begin), start, part);
        if matches!(inputs, Inputs::Moving(_)) {
            let at_end = self
                .rotor
                .stable_steps(&inputs.at(begin + part), start, part);
            count = count.max(at_end);
        }
        if count.is_nan() || count > f64::from(MAX_STEPS - *steps) {
            return Ok(None);
        }
        *steps += count as u32;
        let step = part / count;
        let mut state = *start;
        for i in 0..count as u32 {
            let from = begin + f64::from(i) * step;
            let first = match i {
                0 => self.first_rates(&inputs.at(from), &state)?,
                _ => self.rotor.rates(&inputs.at(from), &state, self.workspace)?,
            };
            let point_at = |offset| inputs.at(from + offset);
            state = self
                .rotor
                .step_from(&first, point_at, &state, step, self.workspace)?;
        }
        Ok(Some(state))
    }

    /// The rates at the beginning of a stretch.
    fn first_rates(&mut self, point: &OperatingPoint, state: &State) -> Result<State, SolveError> {
        if let Some(rates) = self.known_rates.find(self.rotor, point, state) {
            return Ok(rates);
        }
        let rates = self.rotor.rates(point, state, self.workspace)?;
        self.known_rates.keep_grid(self.rotor, point, state, &rates);
        Ok(rates)
    }
}

/// A part of the communication step.
#[derive(Clone, Copy)]
struct Stretch {
    /// Time since the beginning of the communication step, s.
    begin: f64,
    /// Duration of the part, s.
    part: f64,
}

/// The mean rotor speed in a communication step, in which it changes linearly.
fn mean_speed<F: FnMut(f64) -> OperatingPoint>(inputs: &mut Inputs<F>, duration: f64) -> f64 {
    let speed = inputs.at(0.0).speed;
    match inputs {
        Inputs::Constant(_) => speed,
        Inputs::Moving(_) => 0.5 * (speed + inputs.at(duration).speed),
    }
}

/// Largest change of settled states in a step.
fn settled(rotor: &Rotor, point: &OperatingPoint) -> f64 {
    let speeds = point.speed * rotor.geometry().radius + point.airspeed.norm();
    if speeds > 0.0 {
        SETTLED * speeds
    } else {
        SETTLED_IN_STILL_AIR
    }
}
