//! Momentum theory as the inflow models use it, with the effects of descent and of the ground.

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
    /// The induced velocity at the blades with ground effect. `far` is the velocity that would be
    /// induced far from the ground and `mean` its mean over the disc, m/s; `edgewise` is the
    /// edgewise flow, >= 0, m/s.
    pub(crate) fn at_the_blades<V: Scale<S>>(&self, edgewise: S, mean: S, far: V) -> V {
        far.scale(self.ground.factor(edgewise, mean))
    }

    /// Whether the mass flow is that of momentum theory: in climb and hover with every model, in
    /// descent only with `Descent::Momentum`. Only the sign of `induced` matters, so that the lift
    /// that induces it may be given instead.
    pub(crate) fn is_plain(&self, climb: S, induced: S) -> bool {
        match self.descent.model {
            Descent::Momentum => true,
            Descent::Measured | Descent::Johnson => (climb * induced).value() >= 0.0,
        }
    }

    /// Speed at which the wake leaves the disc, along the shaft, m/s: V_c + v where `is_plain`,
    /// either way, and V' in descent, which does not pass through 0.
    pub(crate) fn wake_speed(&self, climb: S, induced: S) -> S {
        if self.is_plain(climb, induced) {
            climb + induced
        } else {
            self.descent.speed(S::zero(), climb, induced)
        }
    }

    /// Sine of the angle at which the wake leaves the disc, for Prandtl's F, where `is_plain` is
    /// false. There the mass flow is V' and not |V_c + v|, which passes through 0: with it F would
    /// rise to 1 in a narrow peak, and the momentum balance would have several roots.
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
