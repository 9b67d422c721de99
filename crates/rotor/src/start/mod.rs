//! The states from which a rotor starts.

mod periodic;
mod still_inflow;
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
    /// In the state that repeats from blade to blade, or in the disc does not change.
    Steady,
    /// Without induced velocity, the blades at the precone angle.
    Rest,
}

/// Tolerance of the states in their own scales.
const TOLERANCE: f64 = 1e-10;

impl Rotor {
    /// The state at the start, with blade 1 at the tail. `azimuth_step` (rad) is the largest step.
    /// Fails if no steady state is found.
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
            state.inflow = still_inflow::find(self, point, workspace)?;
        }
        if !self.evaluate(point, &state).shows_blades() {
            return Ok(state);
        }
        let mut state = periodic::find(self, point, state, azimuth_step, workspace)?;
        state.speed = point.speed;
        Ok(state)
    }

    /// Hub loads in steady flight. Where blades show at their azimuths, they are those at the
    /// azimuth of the start. Allocates a workspace; fails as `start` and `respond` do.
    pub fn steady(&self, point: &OperatingPoint) -> Result<HubLoads, SolveError> {
        let mut workspace = Workspace::new(self);
        let state = self.start(point, Start::Steady, PI / 60.0, &mut workspace)?;
        Ok(self.respond(point, &state, &mut workspace)?.hub)
    }

    /// The state at the start with its derivatives along those of `dual`: `found` is what `start`
    /// has found at `plain`, which has the values of `dual`.
    ///
    /// The conditions of the start, inflow that does not change or a state that repeats, are
    /// differentiated where they hold.
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
        let steps = if self.evaluate(dual, &state).shows_blades() {
            periodic::steps(self, plain, found, azimuth_step)
        } else {
            None
        };
        let unknowns = match steps {
            Some(_) => Unknowns::of_periodic_state(self, plain),
            None => Unknowns::of_inflow(self, 1.0),
        };
        let moves = newton::derivative_at_root(&unknowns.of(found), |x| {
            let state = unknowns.state(x);
            match steps {
                Some(steps) => {
                    let passed = periodic::passed(self, dual, &state, steps, workspace)?;
                    Ok(unknowns.of(&passed) - x)
                }
                None => Ok(unknowns.of(&still_inflow::rates(self, dual, &state, workspace)?)),
            }
        })?;
        let moves = unknowns.state(&moves.ok_or(SolveError::NoSteadyState)?);
        for (value, change) in state.inflow.iter_mut().zip(moves.inflow) {
            value.eps = change;
        }
        for (flap, change) in state.flaps.iter_mut().zip(moves.flaps) {
            (flap.angle.eps, flap.rate.eps) = (change.angle, change.rate);
        }
        Ok(state)
    }
}

/// The operating point with the speed imposed: a torque that does not balance the rotor's leaves no
/// speed steady, so that the start is steady at the speed that the rotor has there.
fn at_imposed_speed(point: &OperatingPoint) -> OperatingPoint {
    OperatingPoint {
        drive: Drive::Speed,
        ..*point
    }
}
