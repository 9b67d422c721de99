//! Time integration of the rotor's states.
//!
//! Steps of the rotor on a grid of azimuth that begins where the simulation does, and anew where
//! the inputs change. A communication point between two grid points is met exactly, by a shorter
//! step from the grid point before; the next step goes on from that grid point, not from the
//! communication point, as long as the inputs stay the same. So constant inputs give the same
//! answer, to the rounding of times, whatever the communication step. Inputs that move within a
//! communication step begin a grid of their own at its beginning.

use rotor::{Drive, OperatingPoint, Rotor, SolveError, State, Workspace};

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
    pub point: OperatingPoint,
    pub state: State,
    /// Time from there to the present, s.
    pub elapsed: f64,
}

/// The operating point during a communication step.
pub enum Inputs<F> {
    Constant(OperatingPoint),
    /// By the time since the beginning of the communication step, s.
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

/// Longest grid cell, s, for slow rotors.
pub const LONGEST_CELL: f64 = 0.02;

/// Maximum number of steps within one communication step.
const MAX_STEPS: u32 = 100_000;

/// Change of the states within a step below which they have settled, as a fraction of the speeds in
/// the problem.
const SETTLED: f64 = 1e-15;

/// The same, m/s, for a stopped rotor in still air, whose wake dies away ever more slowly.
const SETTLED_IN_STILL_AIR: f64 = 1e-8;

impl Memory {
    /// States to start from.
    pub fn starting(state: State) -> Self {
        Self { state, since: None }
    }
}

/// What integrates: a rotor, its workspace, and the largest step, rad.
pub struct Integration<'a> {
    pub rotor: &'a Rotor,
    pub workspace: &'a mut Workspace,
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
            // The mean of a speed that changes linearly.
            let speed = if is_constant {
                point.speed
            } else {
                0.5 * (point.speed + inputs.at(duration).speed)
            };
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
        let mut left = since.elapsed + duration;
        let mut steps = 0;
        loop {
            // Inputs that move are those at the time of the grid point.
            let begin = duration - left;
            let point = inputs.at(begin);
            // Infinite for a rotor at rest.
            let speed = point.at_speed_of(&since.state).speed;
            let mut cell = (self.azimuth_step / speed.abs()).min(LONGEST_CELL);
            if let Drive::Torque { torque, inertia } = point.drive {
                // Nor may the speed that a torque gives turn the rotor further.
                cell = cell.min(libm::sqrt(2.0 * self.azimuth_step * inertia / torque.abs()));
            }
            // Fail fast instead of exhausting the step budget.
            let steps_of_cell = |rotor: &Rotor| rotor.stable_steps(&point, &since.state, cell);
            if steps == 0
                && left / cell * steps_of_cell(self.rotor) > f64::from(MAX_STEPS)
                && self.rotor.evaluate(&point, &since.state).never_settles()
            {
                return Err(SolveError::StepTooLong(duration));
            }
            let reaches_grid = left >= cell * (1.0 - 1e-9);
            let part = if reaches_grid { cell } else { left };
            let stretch = Stretch { begin, part };
            let state = self
                .integrate(&mut inputs, &since.state, stretch, &mut steps)?
                .ok_or(SolveError::StepTooLong(duration))?;
            if !reaches_grid {
                since.elapsed = left;
                return Ok(Memory {
                    state,
                    since: is_constant.then_some(since),
                });
            }
            left = (left - part).max(0.0);
            // A torque, however small, moves the rotor in the end.
            let has_settled = is_constant
                && !point.is_driven()
                && state.largest_change(&since.state) <= settled(self.rotor, &point);
            since.state = state;
            if has_settled {
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

    /// The states after a stretch, in steps that are short enough for the states' fastest rate at
    /// its beginning and, where inputs move, at its end; none if that makes more than `MAX_STEPS`
    /// in all.
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
            let point_at = |offset| inputs.at(from + offset);
            state = self.rotor.step(point_at, &state, step, self.workspace)?;
        }
        Ok(Some(state))
    }
}

/// A part of the communication step, s, from its beginning.
#[derive(Clone, Copy)]
struct Stretch {
    begin: f64,
    part: f64,
}

/// The change of the states within a step below which they have settled.
fn settled(rotor: &Rotor, point: &OperatingPoint) -> f64 {
    let speeds = point.speed * rotor.geometry().radius + point.airspeed.norm();
    if speeds > 0.0 {
        SETTLED * speeds
    } else {
        SETTLED_IN_STILL_AIR
    }
}
