//! The cone of flapping blades as the block's outputs have it.

use super::{
    Operation, Rotor, State, TipPath, flapping::Flap, loads::Sums, scalar::Scalar, scene::Scene,
};
use core::f64::consts::PI;

/// Lean of the tip path beyond which one or two blades count as swinging, rad.
const LARGEST_LEAN: f64 = 1.0;

impl<S: Scalar> Rotor<S> {
    /// The cone of the blades, in the axes of the hub.
    ///
    /// From three blades on, the mean of the flap angles and twice their means with cos psi and sin psi (the
    /// multiblade coordinates, Johnson 1980, ch. 8.4). One or two blades say too little: for each, beta =
    /// a0 - a1 cos psi - b1 sin psi with its first two derivatives gives the cone, and the mean is taken. Blades
    /// that swing too fast for that are on no cone: their angle counts as coning.
    pub(super) fn tip_path(
        &self,
        operation: &Operation<S>,
        state: &State<S>,
        scene: &Scene<S>,
        sums: &Sums<S>,
    ) -> TipPath<S> {
        let Some(freedom) = &self.models.hinge.freedom else {
            return TipPath {
                coning: S::constant(self.models.hinge.precone),
                longitudinal: S::zero(),
                lateral: S::zero(),
            };
        };
        let count = scene.places.len() as f64;
        let mut path = TipPath {
            coning: S::zero(),
            longitudinal: S::zero(),
            lateral: S::zero(),
        };
        for (k, place) in scene.places.iter().enumerate() {
            let psi = state.azimuth + 2.0 * PI * k as f64 / count;
            let (sin, cos) = (psi.sin(), psi.cos());
            let Flap { angle, rate } = place.flap;
            let (coning, longitudinal, lateral) = if count > 2.0 {
                (angle, angle * -2.0 * cos, angle * -2.0 * sin)
            } else {
                let action = self.action(operation, scene, sums.hinge_moments[k]);
                let hinge = &self.models.hinge;
                let second = freedom.acceleration(hinge, &scene.flow, place, &action)
                    / (operation.speed * operation.speed);
                let first = rate / operation.speed;
                // Not so where the rotor stands still, either.
                if first.hypot(second).value() < LARGEST_LEAN {
                    (
                        angle + second,
                        second * cos + first * sin,
                        second * sin - first * cos,
                    )
                } else {
                    (angle, S::zero(), S::zero())
                }
            };
            path.coning += coning / count;
            path.longitudinal += longitudinal / count;
            path.lateral += lateral / count;
        }
        path
    }
}
