//! What the models with states share: the flow through the rotor, and the loading of the disc that
//! drives the states.

use super::{
    InflowStates,
    descent::{DescentLaw, MassFlow},
    linear::SkewedWake,
};
use crate::numbers::Scalar;

/// The flow through a rotor of radius R, m/s: edgewise, and down through the disc without induced
/// velocity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stream<S = f64> {
    /// Edgewise flow, >= 0.
    pub edgewise: S,
    /// Flow down through the disc, positive in climb.
    pub climb: S,
    /// R, m.
    pub radius: f64,
    /// What momentum theory becomes in descent.
    pub descent: DescentLaw<S>,
}

/// The loading of the disc in wind axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DiscLoading<S = f64> {
    /// N.
    pub thrust: S,
    /// Moments of the air about x and y, N.m.
    pub moment_x: S,
    /// See `moment_x`.
    pub moment_y: S,
    /// rho A, kg/m.
    pub density_area: S,
    /// tau of Peters & He, m2/s2; 0 in other models.
    pub series: InflowStates<S>,
}

impl<S: Scalar> Stream<S> {
    /// The air that takes up momentum at an induced velocity, m/s.
    pub(super) fn mass_flow(&self, induced: S) -> MassFlow<S> {
        self.descent.mass_flow(self.edgewise, self.climb, induced)
    }

    /// X = tan(chi/2), chi the skew of the wake; 0 in still air.
    pub(super) fn skew(&self, induced: S) -> S {
        SkewedWake::new(self.edgewise, self.climb + induced)
            .map_or(S::zero(), |wake| wake.along / (wake.flow + wake.down))
    }
}
