//! Correction of a section's lift coefficient for Mach number.
//!
//! The rules were made for pressure coefficients. Like the thesis (section 3.4) we apply them to
//! the lift coefficient, with its magnitude in place of Cp so that the correction has no
//! preferred sign. With a positive Cp in their denominators, Karman & Tsien's and Laitone's rules
//! then raise the lift less than Prandtl & Glauert's; on the suction that makes most of a real
//! section's lift they raise it more. At Mach 0 no rule changes the lift.

use super::numbers::{C, Lanes};

/// Above this Mach number the rules are held: Prandtl & Glauert's is singular at Mach 1, and no
/// rule is meant for transonic flow.
const MAX_MACH: f64 = 0.9;

/// Ratio of specific heats of air.
const HEAT_RATIO: f64 = 1.4;

/// The rule that takes an incompressible lift coefficient to a Mach number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compressibility {
    /// The lift coefficient does not depend on the Mach number.
    None,
    /// Prandtl & Glauert: Glauert 1928, Proc. R. Soc. A 118, p. 113; thesis eq. (52).
    PrandtlGlauert,
    /// Karman & Tsien: von Karman 1941, J. Aeronaut. Sci. 8, p. 337, eq. (60); thesis eq. (53).
    KarmanTsien,
    /// Laitone 1951, J. Aeronaut. Sci. 18, p. 350; thesis eq. (54).
    Laitone,
}

impl Compressibility {
    /// Lift coefficient at the Mach number `mach` (>= 0, held above 0.9) from the incompressible
    /// one, `lift` (any value).
    #[inline(always)]
    pub fn correct<S: Lanes>(self, lift: S, mach: S) -> S {
        match self {
            Self::None => lift,
            Self::PrandtlGlauert | Self::KarmanTsien | Self::Laitone => {
                lift / self.divisor(lift, mach)
            }
        }
    }

    /// The number > 0 by which a rule divides the incompressible lift coefficient `lift` (any
    /// value) at the Mach number `mach` (>= 0, held above 0.9):
    ///
    /// * Prandtl & Glauert: beta = sqrt(1 - M^2)
    /// * Karman & Tsien: beta + M^2/(1 + beta) cl/2
    /// * Laitone: beta + M^2 (1 + (gamma - 1)/2 M^2)/beta cl/2
    #[inline(always)]
    pub fn divisor<S: Lanes>(self, lift: S, mach: S) -> S {
        let mach_squared = {
            let held = mach.at_most(MAX_MACH);
            held * held
        };
        let beta = (C(1.0) - mach_squared).sqrt();
        let half_lift = C(0.5) * lift.abs();
        match self {
            Self::None => S::unit(),
            Self::PrandtlGlauert => beta,
            Self::KarmanTsien => beta + mach_squared / (C(1.0) + beta) * half_lift,
            Self::Laitone => {
                let stagnation = C(1.0) + C(0.5 * (HEAT_RATIO - 1.0)) * mach_squared;
                beta + mach_squared * stagnation / beta * half_lift
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use Compressibility::*;

    #[test]
    fn the_rules_at_mach_0_and_half() {
        let beta = 0.75_f64.sqrt();
        for rule in [None, PrandtlGlauert, KarmanTsien, Laitone] {
            assert_eq!(rule.correct(0.6, 0.0), 0.6);
            assert_eq!(rule.correct(-0.6, 0.5), -rule.correct(0.6, 0.5));
        }
        for (rule, denominator) in [
            (None, 1.0),
            (PrandtlGlauert, beta),
            (KarmanTsien, beta + 0.25 / (1.0 + beta) * 0.3),
            (Laitone, beta + 0.25 * 1.05 / (2.0 * beta) * 0.6),
        ] {
            assert!(
                (rule.correct(0.6, 0.5) - 0.6 / denominator).abs() < 1e-15,
                "{rule:?}"
            );
        }
    }

    #[test]
    fn the_rules_stay_finite_at_and_beyond_the_speed_of_sound() {
        for rule in [PrandtlGlauert, KarmanTsien, Laitone] {
            for mach in [0.9, 1.0, 3.0] {
                assert_eq!(rule.correct(1.0, mach), rule.correct(1.0, 0.9));
                assert!(rule.correct(1.0, mach).is_finite());
            }
        }
    }
}
