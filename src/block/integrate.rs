//! Time integration of the rotor's states.
//!
//! The steps of the rotor lie on a grid of azimuth. The grid begins at the start of the simulation,
//! and again where the inputs change. Each cell of it is divided into equal steps that are short
//! enough for the states.
//!
//! While the inputs stay constant, a communication step goes on from the last point that the steps
//! reached, and a communication point between two of these is read off the motion between them, for
//! which the step ahead is computed and kept. So after the first communication step no step is
//! computed twice, however short the communication steps are, and the results hardly depend on
//! them. The first communication step after a change of the inputs ends with a shorter step
//! instead, because the inputs may change again at once. Inputs that move within a communication
//! step begin a grid of their own at its beginning.

use super::known_rates::KnownRates;
use rotor::{Division, Drive, OperatingPoint, Rotor, SolveError, State, StiffStep, Workspace};
use std::sync::Arc;

/// The states, and the position on the grid.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Memory {
    /// The present states.
    pub state: State,
    /// None if the next step begins a grid at the present states.
    pub since: Option<Since>,
}

/// The last point that the steps reached.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Since {
    /// The operating point of the whole grid.
    pub point: OperatingPoint,
    /// The states there.
    pub state: State,
    /// Time from there to the present, s.
    pub elapsed: f64,
    /// The step from there.
    pub step: Step,
    /// Number of steps to the end of the cell, that step included; 0 at the end, where the next
    /// step is not known yet.
    pub left: u32,
}

/// The steps into which a cell is divided.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Step {
    /// Duration, s.
    pub duration: f64,
    /// Whether the blades flap too fast for plain steps.
    pub is_stiff: bool,
}

/// A step that was taken.
#[expect(clippy::large_enum_variant, reason = "a step must not allocate")]
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stepped {
    /// The states at its end.
    Plain(State),
    Stiff(StiffStep),
}

impl Stepped {
    /// The states at its end.
    pub fn end(&self) -> State {
        match self {
            Self::Plain(end) => *end,
            Self::Stiff(step) => step.end,
        }
    }
}

/// The operating point during a communication step.
pub enum Inputs<F> {
    Constant(OperatingPoint),
    /// A function of the time since the beginning of the communication step, s, and the mean of the
    /// imposed rotor speed in it, rad/s.
    Moving(F, f64),
}

impl<F: FnMut(f64) -> OperatingPoint> Inputs<F> {
    fn at(&mut self, offset: f64) -> OperatingPoint {
        match self {
            Self::Constant(point) => *point,
            Self::Moving(point_at, _) => point_at(offset),
        }
    }
}

/// Maximum time between grid points, s. It holds for slow rotors.
pub const LONGEST_CELL: f64 = 0.02;

/// Maximum number of halved steps in a cell.
const MAX_STEPS_IN_CELL: u32 = 1 << 24;

/// How many times as much work as is allowed is hopeless: rotors may need short steps only at
/// first.
const HOPELESS: f64 = 4.0;

/// Fraction of a step after which its end counts as reached.
const REACHED: f64 = 1.0 - 1e-9;

/// Largest change of settled states in a step, as a fraction of tip speed plus airspeed.
const SETTLED: f64 = 1e-15;

/// The same for a stopped rotor in still air, m/s. Its wake decays more and more slowly.
const SETTLED_IN_STILL_AIR: f64 = 1e-8;

impl Step {
    /// A step half as long, and the number of them in the time of `left` such steps.
    fn halved(self, left: u32) -> Result<(Self, u32), SolveError> {
        if left > MAX_STEPS_IN_CELL / 2 {
            return Err(SolveError::FlappingTooFast);
        }
        let half = Self {
            duration: 0.5 * self.duration,
            ..self
        };
        Ok((half, 2 * left))
    }
}

impl Since {
    /// Halves the steps to the end of the cell.
    fn refine(&mut self) -> Result<(), SolveError> {
        (self.step, self.left) = self.step.halved(self.left)?;
        Ok(())
    }
}

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
        if !self.rotor.has_memory(&inputs.at(0.0)) {
            let speed = match inputs {
                Inputs::Constant(point) => point.speed,
                Inputs::Moving(_, mean_speed) => mean_speed,
            };
            let mut state = memory.state;
            state.azimuth += speed * duration;
            return Ok(Memory::starting(state));
        }
        match inputs {
            Inputs::Constant(point) => self.at_constant_inputs(&point, memory, duration),
            Inputs::Moving(point_at, _) => {
                let state = self.with_moving_inputs(point_at, &memory.state, duration)?;
                Ok(Memory::starting(state))
            }
        }
    }

    fn at_constant_inputs(
        &mut self,
        point: &OperatingPoint,
        memory: &Memory,
        duration: f64,
    ) -> Result<Memory, SolveError> {
        let known = memory.since.filter(|since| since.point == *point);
        let mut since = known.unwrap_or(Since {
            point: *point,
            state: memory.state,
            elapsed: 0.0,
            step: Step::default(),
            left: 0,
        });
        let mut remaining = since.elapsed + duration;
        if known.is_none() || duration > LONGEST_CELL {
            self.refuse_hopeless(point, &since.state, remaining)?;
        }
        let mut present = None;
        while remaining > 0.0 {
            if since.left == 0 {
                self.begin_cell(&mut since)?;
            }
            let is_partial = remaining < since.step.duration * REACHED;
            let stepped = if is_partial && known.is_none() {
                let part = Step {
                    duration: remaining,
                    ..since.step
                };
                self.step(&since.state, |_| *point, part)?
            } else {
                self.step_ahead(&since)?
            };
            let Some(stepped) = stepped else {
                // Until the step that was too long is out of the question.
                let refused = since.step.duration.min(remaining);
                while since.step.duration >= refused {
                    since.refine()?;
                }
                continue;
            };
            if is_partial {
                present = Some(match known {
                    Some(_) => self.between(&since, &stepped, remaining)?,
                    None => stepped.end(),
                });
                break;
            }
            // Steps that are known cost nothing, but there may be too many of them, too.
            self.workspace.work.check(1)?;
            self.workspace.work.count(1);
            let state = stepped.end();
            remaining = (remaining - since.step.duration).max(0.0);
            // A rotor that a torque drives never settles: even a small torque moves it in the end.
            let change = state.largest_change(&since.state) / since.step.duration;
            let has_settled = !point.is_driven()
                && change * self.cell(point, point.speed) <= settled(self.rotor, point);
            since.state = state;
            since.left -= 1;
            if has_settled {
                since.state.azimuth += point.speed * remaining;
                since.left = 0;
                remaining = 0.0;
            }
        }
        since.elapsed = remaining;
        Ok(Memory {
            state: present.unwrap_or(since.state),
            since: Some(since),
        })
    }

    /// Fails at once where the work of a communication step, if it goes on as it begins, far
    /// exceeds what is allowed. A rotor that can settle may stop early and is not refused.
    fn refuse_hopeless(
        &self,
        point: &OperatingPoint,
        state: &State,
        duration: f64,
    ) -> Result<(), SolveError> {
        let cell = self.cell(point, point.at_speed_of(state).speed);
        let division = self.rotor.division(point, state, cell);
        let steps = duration / cell * division.count();
        let work = steps * self.rotor.work_of_step(point, state, division.is_stiff());
        if work > HOPELESS * self.workspace.work.left() as f64
            && self.rotor.evaluate(point, state).never_settles()
        {
            return Err(self.workspace.work.exceeded());
        }
        Ok(())
    }

    /// Divides the next cell into steps.
    fn begin_cell(&self, since: &mut Since) -> Result<(), SolveError> {
        let speed = since.point.at_speed_of(&since.state).speed;
        let cell = self.cell(&since.point, speed);
        let division = self.rotor.division(&since.point, &since.state, cell);
        since.left = self.count(&division, cell)?;
        since.step = Step {
            duration: cell / f64::from(since.left),
            is_stiff: division.is_stiff(),
        };
        Ok(())
    }

    /// Number of steps in the division of a time, s.
    fn count(&self, division: &Division, time: f64) -> Result<u32, SolveError> {
        let count = division.count();
        // An infinite rotor speed makes the cell empty.
        if !count.is_finite() || time <= 0.0 {
            return Err(SolveError::RatesNotFinite);
        }
        // Each step takes some work.
        if count > self.workspace.work.left().min(u32::MAX.into()) as f64 {
            return Err(self.workspace.work.exceeded());
        }
        Ok(count as u32)
    }

    /// The states one step ahead of the last point; none if the step is too long for the flapping.
    fn step_ahead(&mut self, since: &Since) -> Result<Option<Stepped>, SolveError> {
        let known = self.known_rates.step_ahead(self.rotor, since);
        if known.is_some() {
            return Ok(known);
        }
        let stepped = self.step(&since.state, |_| since.point, since.step)?;
        if let Some(stepped) = &stepped {
            self.known_rates.keep_step_ahead(self.rotor, since, stepped);
        }
        Ok(stepped)
    }

    /// The states `elapsed` s after the last point, in the step from there: on the cubic between
    /// its ends, but for flapping that is too fast for a cubic.
    fn between(
        &mut self,
        since: &Since,
        stepped: &Stepped,
        elapsed: f64,
    ) -> Result<State, SolveError> {
        let (rotor, point, next) = (self.rotor, &since.point, &stepped.end());
        let first = self.first_rates(point, &since.state)?;
        let last = match self.known_rates.find(rotor, point, next) {
            Some(rates) => rates,
            None => rotor.rates(point, next, self.workspace)?,
        };
        self.known_rates
            .keep_last(rotor, point, &since.state, &first);
        self.known_rates.keep_next(rotor, point, next, &last);
        let duration = since.step.duration;
        let ends = (next, &last);
        let part = elapsed / duration;
        let mut state = since.state.between(&first, ends, part, duration);
        if let Stepped::Stiff(step) = stepped {
            step.replace_flapping(&mut state, elapsed);
        }
        Ok(state)
    }

    fn with_moving_inputs(
        &mut self,
        mut point_at: impl FnMut(f64) -> OperatingPoint,
        start: &State,
        duration: f64,
    ) -> Result<State, SolveError> {
        let mut state = *start;
        let mut remaining = duration;
        self.refuse_hopeless(&point_at(0.0), &state, duration)?;
        while remaining > 0.0 {
            // Inputs that move have their values at the time of the grid point.
            let begin = duration - remaining;
            let point = point_at(begin);
            let cell = self.cell(&point, point.at_speed_of(&state).speed);
            let part = if remaining >= cell * REACHED {
                cell
            } else {
                remaining
            };
            // Short enough for the fastest rates at either end.
            let division = self.rotor.division(&point, &state, part);
            let at_end = self.rotor.division(&point_at(begin + part), &state, part);
            let division = division.finer(&at_end);
            let mut left = self.count(&division, part)?;
            let mut step = Step {
                duration: part / f64::from(left),
                is_stiff: division.is_stiff(),
            };
            let mut done = 0;
            while left > 0 {
                let from = begin + f64::from(done) * step.duration;
                match self.step(&state, |offset| point_at(from + offset), step)? {
                    Some(stepped) => {
                        state = stepped.end();
                        left -= 1;
                        done += 1;
                    }
                    None => {
                        (step, left) = step.halved(left)?;
                        done *= 2;
                    }
                }
            }
            remaining = (remaining - part).max(0.0);
        }
        Ok(state)
    }

    /// The states after a step; none if it is too long for the flapping.
    fn step(
        &mut self,
        start: &State,
        mut point_at: impl FnMut(f64) -> OperatingPoint,
        step: Step,
    ) -> Result<Option<Stepped>, SolveError> {
        let first = self.first_rates(&point_at(0.0), start)?;
        let (rotor, workspace) = (self.rotor, &mut *self.workspace);
        if step.is_stiff {
            let step = rotor.stiff_step_from(&first, point_at, start, step.duration, workspace)?;
            Ok(step.map(Stepped::Stiff))
        } else {
            let end = rotor.step_from(&first, point_at, start, step.duration, workspace)?;
            Ok(Some(Stepped::Plain(end)))
        }
    }

    /// The time to the next grid point, s.
    pub fn cell(&self, point: &OperatingPoint, speed: f64) -> f64 {
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

    /// The rates where a step begins.
    fn first_rates(&mut self, point: &OperatingPoint, state: &State) -> Result<State, SolveError> {
        if let Some(rates) = self.known_rates.find(self.rotor, point, state) {
            return Ok(rates);
        }
        let rates = self.rotor.rates(point, state, self.workspace)?;
        self.known_rates.keep_last(self.rotor, point, state, &rates);
        Ok(rates)
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
