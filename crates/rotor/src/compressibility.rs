//! Correction of a section's lift coefficient for Mach number.
//!
//! The rules were made for pressure coefficients; like the thesis (section 3.4) we apply them to
//! the lift coefficient, with its magnitude in place of Cp so that the correction has no
//! preferred sign. With a positive Cp in their denominators, Karman & Tsien's and Laitone's rules
//! then raise the lift less than Prandtl & Glauert's; on the suction that makes most of a real
//! section's lift they raise it more. All rules leave the lift as it is at Mach 0.

use super::scalar::Scalar;

/// Above this Mach number the rules are held: Prandtl & Glauert's is singular at 1, and none is
/// meant for transonic flow.
const MAX_MACH: f64 = 0.9;

/// Ratio of specific heats of air.
const HEAT_RATIO: f64 = 1.4;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Compressibility {
    None,
    /// Prandtl & Glauert: Glauert 1928, Proc. R. Soc. A 118, p. 113; thesis eq. (52).
    PrandtlGlauert,
    /// Karman & Tsien: von Karman 1941, J. Aeronaut. Sci. 8, p. 337, eq. (60); thesis eq. (53).
    KarmanTsien,
    /// Laitone 1951, J. Aeronaut. Sci. 18, p. 350; thesis eq. (54).
    Laitone,
}

impl Compressibility {
    /// Lift coefficient at Mach number `mach` (>= 0) from the incompressible one.
    pub fn correct<S: Scalar>(self, lift: S, mach: S) -> S {
        if self == Self::None {
            return lift;
        }
        lift / self.divisor(lift, mach)
    }

    /// By what the incompressible lift coefficient is divided.
    pub fn divisor<S: Scalar>(self, lift: S, mach: S) -> S {
        let mach_squared = {
            let held = mach.at_most(MAX_MACH);
            held * held
        };
        let beta = (S::one() - mach_squared).sqrt();
        let half_lift = lift.abs() * 0.5;
        match self {
            Self::None => S::one(),
            Self::PrandtlGlauert => beta,
            Self::KarmanTsien => beta + mach_squared / (beta + 1.0) * half_lift,
            Self::Laitone => {
                beta + mach_squared * (mach_squared * (0.5 * (HEAT_RATIO - 1.0)) + 1.0) / beta
                    * half_lift
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
