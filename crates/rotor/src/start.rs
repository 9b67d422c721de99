//! The states from which a rotor starts.

use super::{
    Blades, Drive, Models, Operation, Rotor, SolveError, State,
    flapping::{Flap, Hinge},
    inflow::{Inflow, Skew},
    newton,
    scalar::Scalar,
};
use core::f64::consts::PI;
use nalgebra::DVector;
use num_dual::Dual64;

/// How a rotor starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// In the state that repeats itself from blade to blade, or stands still in the disc.
    Steady,
    /// Without inflow, the blades at the precone.
    Rest,
}

/// To which states in their own measures are found.
const TOLERANCE: f64 = 1e-10;

/// Step, rad, that is short enough for the slopes with which Newton's method finds the periodic state: the third
/// order leaves them an error of some 1e-4. What it finds is that of the steps in flight.
const STEP_FOR_SLOPES: f64 = PI / 12.0;

/// Most steps from blade to blade for which flapping is found that repeats itself; blades of rotors that
/// turn more slowly start from rest.
const MOST_STEPS: f64 = 3000.0;

/// Most steps of the search for it in all. Those that end well take a tenth.
const MOST_STEPS_IN_ALL: f64 = 20_000.0;

impl Rotor {
    /// The state at the start, with blade 1 at the tail. `azimuth_step` (rad): the largest step.
    pub fn start(
        &mut self,
        operation: &Operation,
        start: Start,
        azimuth_step: f64,
    ) -> Result<State, SolveError> {
        let precone = Flap::rigid(self.models.hinge.precone);
        let mut state = State::default();
        state.flaps[..self.flapping_blades()].fill(precone);
        // A torque that the rotor does not need leaves no speed as it is: the states are those at the speed of
        // the start, as if it were imposed.
        let operation = &Operation {
            drive: Drive::Speed,
            ..*operation
        };
        state.speed = operation.speed;
        if start == Start::Rest || !self.has_memory(operation) {
            return Ok(state);
        }
        if self.inflow_states() > 0 {
            state.inflow = self.equilibrium(operation)?.inflow;
        }
        if !self.scene(operation, &state).is_blades {
            return Ok(state);
        }
        let mut state = self.periodic(operation, state, azimuth_step)?;
        state.speed = operation.speed;
        Ok(state)
    }

    /// The rotor in steady flight. In the disc, and for blades that do not flap in inflow without states, that
    /// is all; else at the azimuth of the start.
    pub fn steady(&mut self, operation: &Operation) -> Result<super::Performance, SolveError> {
        let state = self.start(operation, Start::Steady, PI / 60.0)?;
        self.performance(operation, &state)
    }

    /// The inflow that stands still, as a mean over a turn of rigid blades.
    fn equilibrium(&mut self, operation: &Operation) -> Result<State, SolveError> {
        self.as_disc(|rotor| rotor.still_inflow(operation))
    }

    fn still_inflow(&mut self, operation: &Operation) -> Result<State, SolveError> {
        let count = self.inflow_states();
        let mut state = State::default();
        let scene = self.scene(operation, &state);
        let radius = self.geometry.radius;
        let speed =
            scene.flow.rotation.abs() * radius + scene.flow.edgewise + scene.flow.climb.abs();
        if speed == 0.0 {
            return Ok(state);
        }
        // Slopes that vanish with the axial symmetry have the static model's values to start from.
        let field = self.field(Skew::PittPeters, &scene, operation)?;
        let field = scene.axes.field_out_of_wind(&field);
        match (&self.models.inflow, &self.peters_he) {
            (Inflow::PittPetersDynamic, _) => state.set_field(&field),
            (_, Some(wake)) => state.inflow = wake.like(&field),
            _ => {}
        }
        let per_rate = radius / (speed * speed);
        let scale = Scale {
            inflow: count,
            flapping: 0,
            speed,
            rotation: 1.0,
        };
        let found = newton::solve(scale.unknowns(&state), TOLERANCE, |x, _| {
            let rates = self.rates(operation, &scale.state(x))?;
            let scaled = rates.inflow[..count].iter().map(|r| r * per_rate);
            Ok(DVector::from_iterator(count, scaled))
        })?;
        let found = found.ok_or(SolveError::NoSteadyState)?;
        state.inflow = scale.state(&found).inflow;
        Ok(state)
    }

    /// The number of steps from blade to blade in which the state that repeats itself is looked for; none for a
    /// rotor that does not turn, or hardly.
    fn steps_of_passage(&self, operation: &Operation, state: &State, longest: f64) -> Option<f64> {
        if operation.speed == 0.0 {
            return None;
        }
        let passage = self.passage(operation);
        let cells = libm::ceil(passage * operation.speed / longest * (1.0 - 1e-9)).max(1.0);
        let steps = cells * self.steps(operation, state, passage / cells);
        (steps <= MOST_STEPS).then_some(steps)
    }

    /// The state that repeats itself from blade to blade: after the time in which each blade comes to where
    /// the next one was, its flapping is that of the next one and the inflow is the same; of a rotor that does
    /// not turn, `start`. (Periodic shooting, as for limit cycles: Seydel 2010, "Practical Bifurcation and
    /// Stability Analysis", ch. 7.)
    fn periodic(
        &mut self,
        operation: &Operation,
        start: State,
        azimuth_step: f64,
    ) -> Result<State, SolveError> {
        let count = |longest: f64| self.steps_of_passage(operation, &start, longest);
        let Some(steps) = count(azimuth_step) else {
            return Ok(start);
        };
        let steps_for_slopes = count(azimuth_step.max(STEP_FOR_SLOPES)).unwrap_or(steps);
        let scale = self.scale(operation);
        let mut left = MOST_STEPS_IN_ALL;
        let passed = |x: &DVector<f64>, purpose| -> Result<DVector<f64>, SolveError> {
            let steps = match purpose {
                newton::Use::Value => steps,
                newton::Use::Slopes => steps_for_slopes,
            };
            left -= steps;
            if left < 0.0 {
                return Err(SolveError::NoSteadyState);
            }
            let passed = self.passed(operation, &scale.state(x), steps)?;
            Ok(scale.unknowns(&passed) - x)
        };
        let found = newton::solve(scale.unknowns(&start), TOLERANCE, passed)?;
        let found = found.ok_or(SolveError::NoSteadyState)?;
        Ok(scale.state(&found))
    }

    /// The state at the start with its derivatives along those of `operation`: of `found`, which `start` has
    /// found for the values of `operation`. `twin`: this rotor, to compute with dual numbers.
    ///
    /// The conditions of the start, inflow that stands still or a state that repeats itself, are differentiated
    /// where they hold.
    pub fn start_along(
        &mut self,
        twin: &mut Rotor<Dual64>,
        operation: (&Operation, &Operation<Dual64>),
        found: &State,
        start: Start,
        azimuth_step: f64,
    ) -> Result<State<Dual64>, SolveError> {
        let plain = &Operation {
            drive: Drive::Speed,
            ..*operation.0
        };
        let dual = &Operation {
            drive: Drive::Speed,
            ..*operation.1
        };
        let mut state = found.map(Dual64::from_re);
        state.speed = dual.speed;
        if start == Start::Rest || !self.has_memory(plain) {
            return Ok(state);
        }
        let steps = if twin.scene(dual, &state).is_blades {
            self.steps_of_passage(plain, found, azimuth_step)
        } else {
            None
        };
        let scale = match steps {
            Some(_) => self.scale(plain),
            None => Scale {
                inflow: self.inflow_states(),
                flapping: 0,
                speed: 1.0,
                rotation: 1.0,
            },
        };
        let moves = newton::derivative_at_root(&scale.unknowns(found), |x| {
            let state = scale.state(x);
            match steps {
                Some(steps) => Ok(scale.unknowns(&twin.passed(dual, &state, steps)?) - x),
                None => {
                    let rates = twin.as_disc(|twin| twin.rates(dual, &state))?;
                    Ok(scale.unknowns(&rates))
                }
            }
        })?;
        let moves = scale.state(&moves.ok_or(SolveError::NoSteadyState)?);
        for (value, change) in state.inflow.iter_mut().zip(moves.inflow) {
            value.eps = change;
        }
        for (flap, change) in state.flaps.iter_mut().zip(moves.flaps) {
            (flap.angle.eps, flap.rate.eps) = (change.angle, change.rate);
        }
        Ok(state)
    }

    fn scale(&self, operation: &Operation) -> Scale {
        Scale {
            inflow: self.inflow_states(),
            flapping: self.flapping_blades(),
            speed: operation.speed * self.geometry.radius,
            rotation: operation.speed,
        }
    }
}

impl<S: Scalar> Rotor<S> {
    /// Does something with the rotor's blades rigid and their loads averaged over the turn.
    fn as_disc<T>(&mut self, task: impl FnOnce(&mut Self) -> T) -> T {
        let models = self.models;
        self.models = Models {
            blades: Blades::Disc,
            hinge: Hinge {
                freedom: None,
                ..models.hinge
            },
            ..models
        };
        let done = task(self);
        self.models = models;
        done
    }

    /// Time in which a blade comes to where the next one was, s, negative for a rotor that turns backwards.
    fn passage(&self, operation: &Operation<S>) -> S {
        S::constant(2.0 * PI) / (operation.speed * f64::from(self.geometry.blades))
    }

    /// The state after that time, with each blade's flapping in the place of the one before it.
    fn passed(
        &mut self,
        operation: &Operation<S>,
        state: &State<S>,
        steps: f64,
    ) -> Result<State<S>, SolveError> {
        let step = self.passage(operation) / steps;
        let mut state = *state;
        for _ in 0..steps as u32 {
            state = self.step(|_| *operation, &state, step)?;
        }
        if self.models.hinge.freedom.is_some() {
            state.flaps[..self.geometry.blades as usize].rotate_right(1);
        }
        Ok(state)
    }
}

/// The states as unknowns of order 1: velocities by the tip speed, rates of flapping by the rotor's speed.
struct Scale {
    inflow: usize,
    flapping: usize,
    speed: f64,
    rotation: f64,
}

impl Scale {
    fn unknowns<S: Scalar>(&self, state: &State<S>) -> DVector<S> {
        let inflow = state.inflow[..self.inflow].iter().map(|v| *v / self.speed);
        let flaps = &state.flaps[..self.flapping];
        let flaps = flaps.iter().flat_map(|f| [f.angle, f.rate / self.rotation]);
        DVector::from_iterator(self.inflow + 2 * self.flapping, inflow.chain(flaps))
    }

    fn state<S: Scalar>(&self, unknowns: &DVector<S>) -> State<S> {
        let mut state = State::default();
        let (inflow, flaps) = unknowns.as_slice().split_at(self.inflow);
        for (value, x) in state.inflow.iter_mut().zip(inflow) {
            *value = *x * self.speed;
        }
        for (flap, x) in state.flaps.iter_mut().zip(flaps.chunks_exact(2)) {
            *flap = Flap {
                angle: x[0],
                rate: x[1] * self.rotation,
            };
        }
        state
    }
}
