//! The states from which a rotor starts.

mod balance;
mod collocation;
mod periodic;
mod steady_inflow;
mod unknowns;

use super::{
    disc::Flap,
    error::SolveError,
    hub_loads::HubLoads,
    newton,
    operating_point::{Drive, OperatingPoint},
    rotor::Rotor,
    state::State,
    workspace::Workspace,
};
use crate::numbers::Dual64;
use collocation::Collocation;
use core::f64::consts::PI;
use unknowns::Unknowns;

/// How a rotor starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// In a periodic state, in which each blade repeats the motion of the one before it, or, with
    /// loads averaged over one revolution, in a steady state. Blades of a stopped rotor are in
    /// balance where they are.
    Steady,
    /// Without induced velocity, the blades at the precone angle.
    Rest,
}

/// The state from which a rotor starts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Started {
    /// The state, with blade 1 at the tail.
    pub state: State,
    /// Whether it is what `Start` asks for. If not, none was found, and this is the inflow of
    /// momentum theory with the blades at rest: at the precone angle or, where they would lie on a
    /// stop, on it.
    pub is_found: bool,
}

/// Distance to a stop within which the blades may hit it elsewhere in the revolution, rad.
const NEAR_STOP: f64 = 0.1;

/// Depth beyond a stop that no blade of a rotor reaches, rad.
const FAR_BEYOND_STOP: f64 = 0.2;

/// Tolerance of the states, each divided by its scale in `Unknowns`.
const TOLERANCE: f64 = 1e-10;

impl Rotor {
    /// The state at the start. `azimuth_step` (rad) is the maximum step. The work of the search is
    /// bounded, also by what the workspace allows: then nothing is found. Fails where a momentum
    /// equation has no solution.
    pub fn start(
        &self,
        point: &OperatingPoint,
        start: Start,
        azimuth_step: f64,
        workspace: &mut Workspace,
    ) -> Result<Started, SolveError> {
        let precone = Flap::rigid(self.models().hinge.precone);
        let mut state = State::default();
        state.flaps[..self.flapping_blades()].fill(precone);
        let point = &at_imposed_speed(point);
        state.speed = point.speed;
        let found = |state| Started {
            state,
            is_found: true,
        };
        if start == Start::Rest || !self.has_memory(point) {
            return Ok(found(state));
        }
        let mut has_inflow = true;
        if self.models().inflow.state_count() > 0 {
            let steady = steady_inflow::find(self, point, workspace)?;
            (state.inflow, has_inflow) = (steady.states, steady.is_found);
        }
        if !self.evaluate(point, &state).is_individual() {
            let is_found = has_inflow;
            return Ok(Started { state, is_found });
        }
        let Some(collocation) = Collocation::new(self, point) else {
            // A stopped rotor has no motion that repeats itself.
            return Ok(found(balance::find(self, point, &state, workspace)?));
        };
        let balanced = balance::without_air(self, point, &state);
        if self.reaches_stops(&balanced, 0.0) {
            state = balanced;
        }
        let (motion, is_motion) = collocation.find(point, &state, workspace);
        // Exactly periodic with the steps of the simulation, where that is not too much work.
        let mut exact = periodic::find(self, point, motion, is_motion, azimuth_step, workspace);
        if !is_motion && exact.is_none() && self.reaches_stops(&motion, -NEAR_STOP) {
            exact = periodic::turn(self, point, motion, azimuth_step, workspace);
        }
        let exact = exact.or(is_motion.then_some(motion));
        // Blades much too light for their lift balance far beyond the stops: no motion of a rotor.
        let exact = exact.filter(|found| !self.reaches_stops(found, FAR_BEYOND_STOP));
        let is_found = exact.is_some();
        let mut state = exact.unwrap_or(state);
        state.speed = point.speed;
        Ok(Started { state, is_found })
    }

    /// Whether a blade lies this far beyond a stop, rad, or further; negative before the stop.
    fn reaches_stops(&self, state: &State, depth: f64) -> bool {
        let flaps = &state.flaps[..self.flapping_blades()];
        let freedom = self.models().hinge.freedom;
        freedom.is_some_and(|f| flaps.iter().any(|flap| f.stops.excess(flap.angle) > depth))
    }

    /// Hub loads in steady flight. Where they vary with azimuth, they are those with blade 1 at the
    /// tail. Allocates a workspace; fails as `start` and `respond` do.
    pub fn steady(&self, point: &OperatingPoint) -> Result<HubLoads, SolveError> {
        let mut workspace = Workspace::new(self);
        let started = self.start(point, Start::Steady, PI / 60.0, &mut workspace)?;
        Ok(self.respond(point, &started.state, &mut workspace)?.hub)
    }

    /// The state at the start with its derivatives in the direction of those of `dual`. `plain` is
    /// the operating point with the values of `dual`, and `found` the state that `start` returned
    /// for it, as steady or periodic. Fails as `start` does, or where the condition cannot be
    /// differentiated.
    ///
    /// The condition of the start, steady inflow or a periodic state, is differentiated at its
    /// solution.
    pub fn start_along(
        &self,
        (plain, dual): (&OperatingPoint, &OperatingPoint<Dual64>),
        found: &State,
        start: Start,
        azimuth_step: f64,
        workspace: &mut Workspace<Dual64>,
    ) -> Result<State<Dual64>, SolveError> {
        let plain = &at_imposed_speed(plain);
        let dual = &OperatingPoint {
            drive: Drive::Speed,
            ..*dual
        };
        let mut state = found.map(Dual64::from_re);
        state.speed = dual.speed;
        if start == Start::Rest || !self.has_memory(plain) {
            return Ok(state);
        }
        let is_individual = self.evaluate(dual, &state).is_individual();
        let steps = if is_individual {
            periodic::steps(self, plain, found, azimuth_step)
        } else {
            None
        };
        if is_individual
            && steps.is_none()
            && let Some(collocation) = Collocation::new(self, plain)
        {
            let moves = collocation.derivative((plain, dual), found, workspace);
            add_changes(&mut state, &moves.ok_or(SolveError::NoSteadyState)?);
            return Ok(state);
        }
        if is_individual && steps.is_none() {
            state = balance::find(self, dual, &state, workspace)?;
        }
        let unknowns = match steps {
            Some(_) => Unknowns::of_periodic_state(self, plain),
            None => Unknowns::of_inflow(self, 1.0),
        };
        let moves = newton::derivative_at_root(&unknowns.of(found), |x| {
            let state = unknowns.state(x);
            match steps {
                Some(steps) => {
                    let passed = periodic::after_passage(self, dual, &state, steps, workspace)?;
                    Ok(unknowns.of(&passed) - x)
                }
                None => Ok(unknowns.of(&steady_inflow::rates(self, dual, &state, workspace)?)),
            }
        })?;
        let mut moves = unknowns.state(&moves.ok_or(SolveError::NoSteadyState)?);
        if steps.is_none() {
            // Those of the balance, or 0.
            moves.flaps = state.flaps.map(|flap| Flap {
                angle: flap.angle.eps,
                rate: flap.rate.eps,
            });
        }
        add_changes(&mut state, &moves);
        Ok(state)
    }
}

/// Gives the inflow and the flapping of a state their derivatives.
fn add_changes(state: &mut State<Dual64>, changes: &State) {
    for (value, change) in state.inflow.iter_mut().zip(changes.inflow) {
        value.eps = change;
    }
    for (flap, change) in state.flaps.iter_mut().zip(changes.flaps) {
        (flap.angle.eps, flap.rate.eps) = (change.angle, change.rate);
    }
}

/// The operating point with the speed imposed. Under a torque that differs from the rotor's no
/// speed is steady, so that the other states are made steady at the speed of the start.
fn at_imposed_speed(point: &OperatingPoint) -> OperatingPoint {
    OperatingPoint {
        drive: Drive::Speed,
        ..*point
    }
}
