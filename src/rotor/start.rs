//! The states from which a rotor starts.

use super::{
    Blades, Drive, Models, Operation, Rotor, SolveError, State,
    flapping::{Flap, Hinge},
    inflow::{Inflow, Skew},
    newton,
};
use core::f64::consts::PI;
use nalgebra::DVector;

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
        if self.models.hinge.freedom.is_some() {
            let count = self.geometry.blades as usize;
            state
                .flaps
                .iter_mut()
                .take(count)
                .for_each(|f| *f = precone);
        }
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
        let models = self.models;
        self.models = Models {
            blades: Blades::Disc,
            hinge: Hinge {
                freedom: None,
                ..models.hinge
            },
            ..models
        };
        let found = self.still_inflow(operation);
        self.models = models;
        found
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
        let start = DVector::from_iterator(count, state.inflow[..count].iter().map(|v| v / speed));
        let per_rate = radius / (speed * speed);
        let mut at = state;
        let found = newton::solve(start, TOLERANCE, |x, _| {
            set_scaled(&mut at.inflow, x.as_slice(), speed);
            let rates = self.rates(operation, &at)?;
            let scaled = rates.inflow[..count].iter().map(|r| r * per_rate);
            Ok(DVector::from_iterator(count, scaled))
        })?;
        let found = found.ok_or(SolveError::NoSteadyState)?;
        set_scaled(&mut state.inflow, found.as_slice(), speed);
        Ok(state)
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
        if operation.speed == 0.0 {
            return Ok(start);
        }
        let blades = self.geometry.blades as usize;
        let passage = 2.0 * PI / (blades as f64 * operation.speed);
        let steps = |longest: f64| {
            let cells = libm::ceil(passage * operation.speed / longest * (1.0 - 1e-9)).max(1.0);
            cells * self.steps(operation, &start, passage / cells)
        };
        let steps_for_slopes = steps(azimuth_step.max(STEP_FOR_SLOPES));
        let steps = steps(azimuth_step);
        if steps.is_nan() || steps > MOST_STEPS {
            return Ok(start);
        }
        let flapping = if self.models.hinge.freedom.is_some() {
            blades
        } else {
            0
        };
        let scale = Scale {
            inflow: self.inflow_states(),
            flapping,
            speed: operation.speed * self.geometry.radius,
            rotation: operation.speed,
        };
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
            let mut state = scale.state(x);
            for _ in 0..steps as u32 {
                state = self.step(|_| *operation, &state, passage / steps)?;
            }
            if flapping > 0 {
                state.flaps[..flapping].rotate_right(1);
            }
            Ok(scale.unknowns(&state) - x)
        };
        let found = newton::solve(scale.unknowns(&start), TOLERANCE, passed)?;
        let found = found.ok_or(SolveError::NoSteadyState)?;
        Ok(scale.state(&found))
    }
}

fn set_scaled(values: &mut [f64], scaled: &[f64], scale: f64) {
    for (value, x) in values.iter_mut().zip(scaled) {
        *value = x * scale;
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
    fn unknowns(&self, state: &State) -> DVector<f64> {
        let inflow = state.inflow[..self.inflow].iter().map(|v| v / self.speed);
        let flaps = &state.flaps[..self.flapping];
        let flaps = flaps.iter().flat_map(|f| [f.angle, f.rate / self.rotation]);
        DVector::from_iterator(self.inflow + 2 * self.flapping, inflow.chain(flaps))
    }

    fn state(&self, unknowns: &DVector<f64>) -> State {
        let mut state = State::default();
        let (inflow, flaps) = unknowns.as_slice().split_at(self.inflow);
        set_scaled(&mut state.inflow, inflow, self.speed);
        for (flap, x) in state.flaps.iter_mut().zip(flaps.chunks_exact(2)) {
            *flap = Flap {
                angle: x[0],
                rate: x[1] * self.rotation,
            };
        }
        state
    }
}
