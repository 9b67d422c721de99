//! Loss of lift at the blade tip.

use super::scalar::Scalar;
use core::f64::consts::FRAC_2_PI;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipLoss {
    None,
    /// Prandtl 1919 (appendix to Betz, "Schraubenpropeller mit geringstem Energieverlust"), with
    /// the local inflow angle as Glauert 1935 (Airplane Propellers, ch. VII, eq. 5.7) writes it.
    Prandtl,
    /// Gessow & Myers 1952, "Aerodynamics of the Helicopter": lift ends at B = 1 - c/(2R).
    GessowMyers,
}

impl TipLoss {
    /// Ratio of the annulus' mean induced velocity to that at the blade, 0 to 1.
    ///
    /// Prandtl: F = 2/pi acos(exp(-f)), f = (N/2) (R - r)/(r |sin phi|); thesis eq. (95) is this
    /// with sin phi = lambda/r. `radius_ratio` is r/R in (0, 1). F = 1 where the air does not pass
    /// through the disc (phi = 0).
    pub fn factor<S: Scalar>(self, blades: f64, radius_ratio: f64, sin_inflow: S) -> S {
        if self != Self::Prandtl || sin_inflow.value() == 0.0 {
            return S::constant(1.0);
        }
        let exponent =
            S::constant(0.5 * blades * (1.0 - radius_ratio) / radius_ratio) / sin_inflow.abs();
        (-exponent).exp().acos() * FRAC_2_PI
    }

    /// Share of a blade element's width that carries lift. Radii and chord in m.
    ///
    /// Gessow & Myers: thesis eq. (96); the element across BR counts in part, so that the thrust
    /// does not jump with the number of elements. The other models give 1.
    pub fn lifting_share(self, inner: f64, outer: f64, tip_radius: f64, tip_chord: f64) -> f64 {
        if self != Self::GessowMyers {
            return 1.0;
        }
        let end = tip_radius - 0.5 * tip_chord;
        ((end - inner) / (outer - inner)).clamp(0.0, 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn prandtl_tends_to_1_for_many_blades_and_to_0_at_the_tip() {
        let f = |blades, r| TipLoss::Prandtl.factor::<f64>(blades, r, 0.1);
        assert!((f(1000.0, 0.9) - 1.0).abs() < 1e-12);
        assert!(f(4.0, 1.0 - 1e-12) < 1e-5);
        assert!(f(4.0, 0.5) > f(4.0, 0.9) && f(4.0, 0.9) > f(2.0, 0.9));
        // By hand: N = 2, r = 0.9, sin phi = 0.1: f = 1.1111, F = 2/pi acos(0.329193).
        assert!((f(2.0, 0.9) - 0.786_447).abs() < 1e-5, "{}", f(2.0, 0.9));
        assert_eq!(TipLoss::Prandtl.factor::<f64>(2.0, 0.9, 0.0), 1.0);
    }

    #[test]
    fn gessow_myers_ends_the_lift_half_a_chord_before_the_tip() {
        let share = |a, b| TipLoss::GessowMyers.lifting_share(a, b, 1.0, 0.1);
        assert_eq!(share(0.8, 0.9), 1.0);
        assert!((share(0.9, 1.0) - 0.5).abs() < 1e-12);
        assert_eq!(share(0.96, 1.0), 0.0);
        assert_eq!(TipLoss::Prandtl.lifting_share(0.96, 1.0, 1.0, 0.1), 1.0);
    }
}
