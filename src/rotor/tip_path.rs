//! The cone of flapping blades as the block's outputs have it.

use super::{Operation, Rotor, State, TipPath, flapping::Flap, loads::Sums, scene::Scene};
use core::f64::consts::PI;

/// Lean of the tip path beyond which one or two blades count as swinging, rad.
const LARGEST_LEAN: f64 = 1.0;

impl Rotor {
    /// The cone of the blades, in the axes of the hub.
    ///
    /// From three blades on, the mean of the flap angles and twice their means with cos psi and sin psi (the
    /// multiblade coordinates, Johnson 1980, ch. 8.4). One or two blades say too little: for each, beta =
    /// a0 - a1 cos psi - b1 sin psi with its first two derivatives gives the cone, and the mean is taken. Blades
    /// that swing too fast for that are on no cone: their angle counts as coning.
    pub(super) fn tip_path(
        &self,
        operation: &Operation,
        state: &State,
        scene: &Scene,
        sums: &Sums,
    ) -> TipPath {
        let Some(freedom) = &self.models.hinge.freedom else {
            return TipPath {
                coning: self.models.hinge.precone,
                ..TipPath::default()
            };
        };
        let count = scene.places.len() as f64;
        let mut path = TipPath::default();
        for (k, place) in scene.places.iter().enumerate() {
            let psi = state.azimuth + 2.0 * PI * k as f64 / count;
            let (sin, cos) = (libm::sin(psi), libm::cos(psi));
            let Flap { angle, rate } = place.flap;
            let (coning, longitudinal, lateral) = if count > 2.0 {
                (angle, -2.0 * angle * cos, -2.0 * angle * sin)
            } else {
                let action = self.action(operation, scene, sums.hinge_moments[k]);
                let hinge = &self.models.hinge;
                let second = freedom.acceleration(hinge, &scene.flow, place, &action)
                    / (operation.speed * operation.speed);
                let first = rate / operation.speed;
                // Not so where the rotor stands still, either.
                if libm::hypot(first, second) < LARGEST_LEAN {
                    (
                        angle + second,
                        second * cos + first * sin,
                        second * sin - first * cos,
                    )
                } else {
                    (angle, 0.0, 0.0)
                }
            };
            path.coning += coning / count;
            path.longitudinal += longitudinal / count;
            path.lateral += lateral / count;
        }
        path
    }
}
