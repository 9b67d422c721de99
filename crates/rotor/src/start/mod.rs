//! The states from which a rotor starts.

mod balance;
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
use core::f64::consts::PI;
use num_dual::Dual64;
use unknowns::Unknowns;

/// How a rotor starts.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Start {
    /// In a periodic state, in which each blade repeats the motion of the one before it, or, with
    /// loads averaged over one revolution, in a steady state. Blades of a rotor that is stopped or
    /// turns very slowly are in balance where they are.
    Steady,
    /// Without induced velocity, the blades at the precone angle.
    Rest,
}

/// Tolerance of the states, each divided by its scale in `Unknowns`.
const TOLERANCE: f64 = 1e-10;

impl Rotor {
    /// The state at the start, with blade 1 at the tail. `azimuth_step` (rad) is the maximum step.
    /// Fails if no steady or periodic state is found.
    pub fn start(
        &self,
        point: &OperatingPoint,
        start: Start,
        azimuth_step: f64,
        workspace: &mut Workspace,
    ) -> Result<State, SolveError> {
        let precone = Flap::rigid(self.models().hinge.precone);
        let mut state = State::default();
        state.flaps[..self.flapping_blades()].fill(precone);
        let point = &at_imposed_speed(point);
        state.speed = point.speed;
        if start == Start::Rest || !self.has_memory(point) {
            return Ok(state);
        }
        if self.models().inflow.state_count() > 0 {
            state.inflow = steady_inflow::find(self, point, workspace)?;
        }
        if !self.evaluate(point, &state).is_individual() {
            return Ok(state);
        }
        let mut state = periodic::find(self, point, state, azimuth_step, workspace)?;
        state.speed = point.speed;
        Ok(state)
    }

    /// Hub loads in steady flight. Where they vary with azimuth, they are those with blade 1 at the
    /// tail. Allocates a workspace; fails as `start` and `respond` do.
    pub fn steady(&self, point: &OperatingPoint) -> Result<HubLoads, SolveError> {
        let mut workspace = Workspace::new(self);
        let state = self.start(point, Start::Steady, PI / 60.0, &mut workspace)?;
        Ok(self.respond(point, &state, &mut workspace)?.hub)
    }

    /// The state at the start with its derivatives in the direction of those of `dual`. `plain` is
    /// the operating point with the values of `dual`, and `found` the state that `start` returned
    /// for it. Fails as `start` does.
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
        let steps = if self.evaluate(dual, &state).is_individual() {
            periodic::steps(self, plain, found, azimuth_step)
        } else {
            None
        };
        if steps.is_none() {
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
        let moves = unknowns.state(&moves.ok_or(SolveError::NoSteadyState)?);
        for (value, change) in state.inflow.iter_mut().zip(moves.inflow) {
            value.eps = change;
        }
        if steps.is_some() {
            for (flap, change) in state.flaps.iter_mut().zip(moves.flaps) {
                (flap.angle.eps, flap.rate.eps) = (change.angle, change.rate);
            }
        }
        Ok(state)
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
