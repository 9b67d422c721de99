//! One step of the states in time.

use super::{
    error::SolveError, inflow::Number, operating_point::OperatingPoint, rates, rotor::Rotor,
    state::State, workspace::Workspace,
};

/// Maximum product of a step and the states' fastest rate; Heun's method is stable to 1.7 for
/// undamped motion and 2.5 for damped.
const MAX_PRODUCT: f64 = 1.0;

/// Blades count as stiff if so many plain steps would replace one stiff step. A stiff step costs up
/// to twice as much as a plain one.
const STIFF: f64 = 8.0;

/// Into how many equal steps, at least 1, a time must be divided for a stable integration; not
/// finite where the rates of the states are not.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Division {
    /// With `step_from`.
    pub plain: f64,
    /// With `stiff_step_from`.
    pub stiff: f64,
}

impl Division {
    /// Whether to take the steps of `stiff_step_from`.
    pub fn is_stiff(&self) -> bool {
        self.plain >= STIFF * self.stiff
    }

    /// Number of steps with the method to take.
    pub fn count(&self) -> f64 {
        if self.is_stiff() {
            self.stiff
        } else {
            self.plain
        }
    }

    /// The division that is stable where either is.
    pub fn finer(&self, other: &Self) -> Self {
        // Also the one that is no number.
        let larger = |a: f64, b: f64| if a > b || a.is_nan() { a } else { b };
        Self {
            plain: larger(self.plain, other.plain),
            stiff: larger(self.stiff, other.stiff),
        }
    }
}

impl Rotor {
    /// The state one step of `duration` s later, by Heun's method of order 3 (Heun 1900, Z. Math.
    /// Phys. 45, p. 23). `point_at`: the operating point at a time (s) after the beginning of the
    /// step. Fails as `respond` does.
    pub fn step<S: Number>(
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
    pub fn step_from<S: Number>(
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

    /// How `duration` s must be divided.
    pub fn division(&self, point: &OperatingPoint, state: &State, duration: f64) -> Division {
        let fastest = rates::fastest(&self.evaluate(point, state), duration);
        let count = |rate: f64| {
            let count = libm::ceil(duration * rate / MAX_PRODUCT);
            if count < 1.0 { 1.0 } else { count }
        };
        Division {
            plain: count(fastest.flapping + fastest.others),
            stiff: count(fastest.others),
        }
    }

    /// Work of a step whose first rates are not known, without iterations of static inflow, in
    /// computations of a section's loads.
    pub fn work_of_step(&self, point: &OperatingPoint, state: &State, is_stiff: bool) -> f64 {
        let stages = if is_stiff { 5.0 } else { 3.0 };
        let positions = self.evaluate(point, state).positions.len();
        stages * (positions * self.elements().len()) as f64
    }
}
