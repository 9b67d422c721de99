//! One step of the states in time.

use super::{
    error::SolveError, operating_point::OperatingPoint, rates, rotor::Rotor, scalar::Scalar,
    state::State, workspace::Workspace,
};

/// Maximum product of a step and the states' fastest rate; Heun's method is stable to 1.7 for
/// undamped motion and 2.5 for damped.
const MAX_PRODUCT: f64 = 1.0;

impl Rotor {
    /// The state one step of `duration` s later, by Heun's method of order 3 (Heun 1900, Z. Math.
    /// Phys. 45, p. 23). `point_at`: the operating point at a time (s) after the beginning of the
    /// step. Fails as `respond` does.
    pub fn step<S: Scalar>(
        &self,
        mut point_at: impl FnMut(S) -> OperatingPoint<S>,
        state: &State<S>,
        duration: S,
        workspace: &mut Workspace<S>,
    ) -> Result<State<S>, SolveError> {
        let first = self.rates(&point_at(S::zero()), state, workspace)?;
        self.step_from(&first, point_at, state, duration, workspace)
    }

    /// The same from the rates at the beginning of the step, `first`, where they are known.
    pub fn step_from<S: Scalar>(
        &self,
        first: &State<S>,
        mut point_at: impl FnMut(S) -> OperatingPoint<S>,
        state: &State<S>,
        duration: S,
        workspace: &mut Workspace<S>,
    ) -> Result<State<S>, SolveError> {
        let at_third = state.plus(duration / 3.0, first);
        let second = self.rates(&point_at(duration / 3.0), &at_third, workspace)?;
        let at_two_thirds = state.plus(duration * 2.0 / 3.0, &second);
        let third = self.rates(&point_at(duration * 2.0 / 3.0), &at_two_thirds, workspace)?;
        Ok(state
            .plus(duration * 0.25, first)
            .plus(duration * 0.75, &third))
    }

    /// Number of equal steps, at least 1, into which `duration` s must be divided for a stable
    /// integration; not finite where the states' rates are not.
    pub fn stable_steps(&self, point: &OperatingPoint, state: &State, duration: f64) -> f64 {
        let fastest = rates::fastest(&self.evaluate(point, state), duration);
        libm::ceil((duration * fastest / MAX_PRODUCT).max(1.0))
    }
}
