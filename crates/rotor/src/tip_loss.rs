//! Loss of lift at the blade tip and root.
//!
//! A tip loss model acts in one of three ways, and each has a function here: as Prandtl's factor F
//! ([`TipLoss::factor`]), by ending the lift at a radius that the blade's shape gives
//! ([`TipLoss::fixed_end`]), or at a radius that depends on the thrust
//! ([`TipLoss::end_at_thrust`]).

use super::{
    geometry::Geometry,
    numbers::{C, Lanes, Mask, Scalar},
};
use core::f64::consts::FRAC_2_PI;

/// The tip loss model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TipLoss {
    /// Lift up to the tip.
    None,
    /// Prandtl 1919 (appendix to Betz, "Schraubenpropeller mit geringstem Energieverlust"), with
    /// the local inflow angle as Glauert 1935 (Airplane Propellers, ch. VII, eq. 5.7) writes it.
    Prandtl,
    /// Prandtl's factor for the tip times that for the root, as Ning 2014 (Wind Energy 17, p. 1327)
    /// writes it.
    PrandtlTipAndRoot,
    /// Lift ends half a tip chord before the tip, B = 1 - c/(2R): Wheatley 1934, NACA Rep. 487,
    /// p. 5; Gessow & Myers 1952, "Aerodynamics of the Helicopter"; thesis eq. (96).
    HalfTipChord,
    /// Lift ends at B = 1 - c0 (1 + 0.7 tau)/(1.5 R), with the root chord c0 and the taper ratio
    /// tau, tip chord over root chord: Sissingh 1939, as in Leishman 2006, section 3.3.10.
    Sissingh,
    /// Lift ends at B = 1 - sqrt(CT)/N: Prandtl 1919 for the inflow of hover, Leishman 2006,
    /// section 3.3.10.
    PrandtlThrust,
}

/// From this f on F differs from 1 by less than its rounding.
const NO_LOSS: f64 = 38.0;

/// What the loss of blade elements depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span<V = f64> {
    /// Number of blades N, >= 1.
    pub blades: f64,
    /// r/R of the element's middle, above that of the cutout and below 1.
    pub radius_ratio: V,
    /// r/R of the root cutout, above 0 and below 1.
    pub cutout: f64,
}

impl TipLoss {
    /// Whether the model acts by Prandtl's factor F.
    pub fn has_factor(self) -> bool {
        match self {
            Self::Prandtl | Self::PrandtlTipAndRoot => true,
            Self::None | Self::HalfTipChord | Self::Sissingh | Self::PrandtlThrust => false,
        }
    }

    /// Prandtl's factor F, 0 to 1: the mean induced velocity around the annulus over that at the
    /// blade. It is 1 for models without a factor, and where no air passes through the disc
    /// (phi = 0).
    ///
    /// At the tip F = 2/pi acos(exp(-f)), f = (N/2) (R - r)/(r |sin phi|); thesis eq. (95) is this
    /// with sin phi = lambda/r. At the root f = (N/2) (r - r0)/(r0 |sin phi|).
    ///
    /// * `sin_inflow`: sine of the inflow angle phi, -1 to 1
    #[inline(always)]
    pub fn factor<L: Lanes>(self, span: &Span<L::Real>, sin_inflow: L) -> L {
        let radius_ratio = span.radius_ratio;
        let mut distance = (L::Real::unit() - radius_ratio) / radius_ratio;
        let mut is_last = match self {
            Self::Prandtl => true,
            Self::PrandtlTipAndRoot => false,
            Self::None | Self::HalfTipChord | Self::Sissingh | Self::PrandtlThrust => {
                return L::unit();
            }
        };
        let sine = sin_inflow.abs();
        let mut factor = L::unit();
        // At the tip, and at the root: from the distance to the end of the blade over the radius of
        // the inner of the two.
        loop {
            let f = L::real(distance * (0.5 * span.blades)) / sine;
            // Infinite, with the sign of that 0, where no air passes through the disc.
            let is_lossy = f.values().abs().is_below(NO_LOSS);
            if is_lossy.any() {
                let at_end = C(FRAC_2_PI) * (-f).exp().acos();
                factor = L::select(is_lossy, factor * at_end, factor);
            }
            if is_last {
                return factor;
            }
            is_last = true;
            distance = (radius_ratio - span.cutout) / span.cutout;
        }
    }

    /// r/R at which the lift ends, for models that take it from the blade's shape alone.
    pub fn fixed_end(self, geometry: &Geometry) -> Option<f64> {
        let (tip, radius) = (geometry.tip_chord, geometry.radius);
        match self {
            Self::HalfTipChord => Some(1.0 - 0.5 * tip / radius),
            Self::Sissingh => {
                let root = geometry.stations.first().map_or(tip, |s| s.chord);
                Some(1.0 - (root + 0.7 * tip) / (1.5 * radius))
            }
            Self::None | Self::Prandtl | Self::PrandtlTipAndRoot | Self::PrandtlThrust => None,
        }
    }

    /// r/R at which the lift ends, 0 to 1, for models in which it depends on the thrust.
    ///
    /// * `blades`: number of blades N, >= 1
    /// * `thrust_coefficient`: magnitude of CT = T/(rho A (Omega R)^2), >= 0
    pub fn end_at_thrust<S: Scalar>(self, blades: f64, thrust_coefficient: S) -> Option<S> {
        match self {
            Self::PrandtlThrust => {
                Some((C(1.0) - thrust_coefficient.sqrt() / blades).at_least(0.0))
            }
            Self::None
            | Self::Prandtl
            | Self::PrandtlTipAndRoot
            | Self::HalfTipChord
            | Self::Sissingh => None,
        }
    }
}

/// Share of a blade element's width that carries lift, 0 to 1. The element in which the lift ends
/// counts in part, so that the thrust does not jump with the number of elements.
///
/// * `inner`, `outer`: radii of the element's edges, inner below outer
/// * `end`: radius at which the lift ends, in the same unit
pub fn lifting_share<S: Scalar>(inner: f64, outer: f64, end: S) -> S {
    ((end - inner) / (outer - inner)).at_least(0.0).at_most(1.0)
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;

    fn at(blades: f64, radius_ratio: f64) -> Span {
        Span {
            blades,
            radius_ratio,
            cutout: 0.2,
        }
    }

    #[test]
    fn prandtl_tends_to_1_for_many_blades_and_to_0_at_the_tip() {
        let f = |blades, r| TipLoss::Prandtl.factor::<f64>(&at(blades, r), 0.1);
        assert!((f(1000.0, 0.9) - 1.0).abs() < 1e-12);
        assert!(f(4.0, 1.0 - 1e-12) < 1e-5);
        assert!(f(4.0, 0.5) > f(4.0, 0.9) && f(4.0, 0.9) > f(2.0, 0.9));
        // By hand: N = 2, r = 0.9, sin phi = 0.1: f = 1.1111, F = 2/pi acos(0.329193).
        assert!((f(2.0, 0.9) - 0.786_447).abs() < 1e-5, "{}", f(2.0, 0.9));
        assert_eq!(TipLoss::Prandtl.factor::<f64>(&at(2.0, 0.9), 0.0), 1.0);
    }

    #[test]
    fn the_root_loses_lift_as_the_tip_does() {
        let both = |r| TipLoss::PrandtlTipAndRoot.factor::<f64>(&at(2.0, r), 0.3);
        let tip = |r| TipLoss::Prandtl.factor::<f64>(&at(2.0, r), 0.3);
        assert!(both(0.2 + 1e-12) < 1e-5);
        // By hand at r = 0.25: f = 0.25/0.3, 2/pi acos(0.434598).
        let root = 2.0 / std::f64::consts::PI * 0.434_598_f64.acos();
        assert!((both(0.25) / tip(0.25) - root).abs() < 1e-5);
        assert!((both(0.95) / tip(0.95) - 1.0).abs() < 1e-3);
    }

    /// By hand: c0 = 0.2 m, tip 0.1 m, R = 2 m, N = 4, CT = 0.0064.
    #[test]
    fn lift_ends_where_the_published_formulas_say() {
        let geometry = Geometry::linear(4, 2.0, 0.2, 0.2, 0.5, 0.0);
        let fixed = |loss: TipLoss| loss.fixed_end(&geometry);
        assert_eq!(fixed(TipLoss::HalfTipChord), Some(0.975));
        let sissingh = 1.0 - 0.2 * (1.0 + 0.35) / 3.0;
        assert!((fixed(TipLoss::Sissingh).unwrap() - sissingh).abs() < 1e-15);
        let thrust = TipLoss::PrandtlThrust.end_at_thrust(4.0, 0.0064);
        assert!((thrust.unwrap() - 0.98).abs() < 1e-15);
        for loss in [TipLoss::None, TipLoss::Prandtl, TipLoss::PrandtlTipAndRoot] {
            assert_eq!(fixed(loss), None);
            assert_eq!(loss.end_at_thrust(4.0, 0.0064), None);
        }
    }

    #[test]
    fn the_element_at_the_end_of_the_lift_counts_in_part() {
        assert_eq!(lifting_share(0.8, 0.9, 0.95), 1.0);
        assert!((lifting_share(0.9, 1.0, 0.95) - 0.5).abs() < 1e-12);
        assert_eq!(lifting_share(0.96, 1.0, 0.95), 0.0);
    }
}
