//! Momentum theory as the inflow models use it: with what descent and the ground do to it.

use super::{Descent, DescentLaw, Ground, InflowStates};
use crate::{
    induced::{Field, Induced},
    scalar::Scalar,
};

/// Momentum theory in descent and near the ground.
#[derive(Debug, Clone, Copy)]
pub struct Momentum<S = f64> {
    /// What momentum theory becomes in descent.
    pub descent: DescentLaw<S>,
    /// The rotor near the ground.
    pub ground: Ground<S>,
}

/// An induced velocity in any of the forms that the models have.
pub(crate) trait Scale<S> {
    /// `factor * self`.
    fn scale(self, factor: S) -> Self;
}

impl<S: Scalar> Scale<S> for Induced<S> {
    fn scale(self, factor: S) -> Self {
        self.scaled(factor)
    }
}

impl<S: Scalar> Scale<S> for Field<S> {
    fn scale(self, factor: S) -> Self {
        self.scaled(factor)
    }
}

impl<S: Scalar> Scale<S> for InflowStates<S> {
    fn scale(self, factor: S) -> Self {
        self.map(|state| state * factor)
    }
}

impl<S: Scalar> Momentum<S> {
    /// Ground effect: what is left at the blades of `far`, the velocity that would be induced far
    /// from the ground. `edgewise` (>= 0) is the flow along the disc and `mean` the mean of `far`,
    /// m/s.
    pub(crate) fn at_the_blades<V: Scale<S>>(&self, edgewise: S, mean: S, far: V) -> V {
        far.scale(self.ground.factor(edgewise, mean))
    }

    /// Whether the rotor takes up momentum as momentum theory says: always but where another law of
    /// descent holds and the rotor descends against what it induces. Of `induced` (or the lift that
    /// induces it) only the sign counts.
    pub(crate) fn is_plain(&self, climb: S, induced: S) -> bool {
        match self.descent.model {
            Descent::Momentum => true,
            Descent::Measured | Descent::Johnson => (climb * induced).value() >= 0.0,
        }
    }

    /// Sine of the angle at which the wake leaves the disc, for Prandtl's F, where `is_plain` says
    /// no: there the air that takes up momentum is V', not |V_c + v|, which goes through 0. F would
    /// go through 1 in a spike, and the momentum balance would fold.
    ///
    /// `climb` and `induced` (axial): m/s; `speed`: of the flow at the blade, m/s.
    pub(crate) fn wake_sine_in_descent(&self, climb: S, induced: S, speed: S) -> S {
        let leaves = self.descent.speed(S::zero(), climb, induced);
        if leaves.value() < speed.value() {
            leaves / speed
        } else {
            S::one()
        }
    }
}
