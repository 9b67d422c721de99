//! Momentum theory as the inflow models use it, with the effects of descent and of the ground.

use super::{Descent, DescentLaw, Ground, InflowStates};
use crate::{
    induced::{Field, Induced},
    numbers::{Lanes, Mask, Scalar},
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

    /// The same for annuli side by side, from the velocity induced far from the ground.
    #[inline(always)]
    pub(crate) fn at_the_annuli<L: Lanes<One = S>>(
        &self,
        edgewise: S,
        far: Induced<L>,
    ) -> Induced<L> {
        if self.ground.is_far() {
            return far;
        }
        let factor = far.axial.each(|axial| self.ground.factor(edgewise, axial));
        far.scaled(factor)
    }

    /// Where the mass flow is that of momentum theory: in climb and hover with every model, in
    /// descent only with `Descent::Momentum`. Only the sign of `induced` matters, so that the lift
    /// that induces it may be given instead.
    #[inline(always)]
    pub(crate) fn is_plain<L: Lanes<One = S>>(&self, climb: L, induced: L) -> L::Mask {
        match self.descent.model {
            Descent::Momentum => L::Mask::all_lanes(true),
            Descent::Measured | Descent::Johnson => !(climb * induced).values().is_below(0.0),
        }
    }

    /// Speed at which the wake leaves the disc, along the shaft, m/s: V_c + v where `is_plain`,
    /// either way, and V' in descent, which does not pass through 0.
    pub(crate) fn wake_speed<L: Lanes<One = S>>(&self, climb: L, induced: L) -> L {
        let is_plain = self.is_plain(climb, induced);
        let plain = climb + induced;
        if is_plain.all() {
            return plain;
        }
        let speed = self.descent.speeds(L::nil(), climb, induced);
        L::select(is_plain, plain, speed)
    }

    /// Sine of the angle at which the wake leaves the disc, for Prandtl's F, where `is_plain` is
    /// false. There the mass flow is V' and not |V_c + v|, which passes through 0: with it F would
    /// rise to 1 in a narrow peak, and the momentum balance would have several roots.
    ///
    /// `climb` and `induced` (axial): m/s; `speed`: of the flow at the blade, m/s.
    pub(crate) fn wake_sine_in_descent<L: Lanes<One = S>>(
        &self,
        climb: L,
        induced: L,
        speed: L,
    ) -> L {
        let leaves = self.descent.speeds(L::nil(), climb, induced);
        let is_flat = leaves.below(speed.values());
        L::select(is_flat, leaves / speed, L::unit())
    }
}
