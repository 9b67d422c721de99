//! A bracketed root of one equation in one unknown.

use thiserror::Error;

/// Why no root was returned. Neither happens for finite input with a change of sign.
#[derive(Debug, Error, Clone, Copy, PartialEq, Eq)]
pub enum RootError {
    #[error("the residual is not a finite number inside the bracket")]
    NotFinite,
    #[error("the bracket did not close within the method's bound on evaluations")]
    OutOfIterations,
}

/// Root of `residual` between `a` and `b` by the ITP method (Oliveira & Takahashi 2020, "An
/// Enhancement of the Bisection Method Average Performance Preserving Minmax Optimality", ACM
/// Trans. Math. Softw. 47(1) 5, algorithm 1; kappa1 = 0.2/|b - a|, kappa2 = 2, n0 = 1).
///
/// Converges faster than linearly on smooth residuals, and needs never more than one evaluation
/// above bisection (two, where rounding leaves the bracket a hair too wide), which is the bound
/// that the loop enforces.
///
/// * `end_sign`: +1 if the residual rises from `a` to `b`, else -1: the sign it has at `b`, where
///   it is not evaluated (it may vanish there without a change of sign).
/// * `tolerance`: half of the bracket's width at the end, in the unit of `a` and `b`.
pub fn itp(
    mut residual: impl FnMut(f64) -> f64,
    a: f64,
    b: f64,
    end_sign: f64,
    tolerance: f64,
) -> Result<f64, RootError> {
    // Oriented so that the residual is negative at `low` and positive at `high`; `low` may lie
    // to the right of `high`.
    let start = residual(a) * end_sign;
    if !start.is_finite() || !b.is_finite() {
        return Err(RootError::NotFinite);
    }
    if start >= 0.0 || a == b {
        return Ok(a);
    }
    let (mut low, mut high) = (a, b);
    // The sign at `b` is known, its size is not: that of `a` makes the first step a bisection.
    let (mut at_low, mut at_high) = (start, -start);
    let width = (b - a).abs();
    let half = (width / (2.0 * tolerance)).max(1.0);
    let bisections = libm::ceil(libm::log2(half)) as i32;
    let bound = bisections + 1;
    let kappa1 = 0.2 / width;

    for step in 0..=bound {
        let span = high - low;
        if span.abs() <= 2.0 * tolerance {
            return Ok(0.5 * (low + high));
        }
        let middle = 0.5 * (low + high);
        let reach = tolerance * libm::exp2(f64::from(bound - step)) - 0.5 * span.abs();
        let interpolated = (at_high * low - at_low * high) / (at_high - at_low);
        let towards = if middle >= interpolated { 1.0 } else { -1.0 };
        let truncation = kappa1 * span * span;
        let truncated = if truncation <= (middle - interpolated).abs() {
            interpolated + towards * truncation
        } else {
            middle
        };
        let x = if (truncated - middle).abs() <= reach {
            truncated
        } else {
            middle - towards * reach
        };
        let value = residual(x) * end_sign;
        if !value.is_finite() {
            return Err(RootError::NotFinite);
        }
        if value > 0.0 {
            (high, at_high) = (x, value);
        } else if value < 0.0 {
            (low, at_low) = (x, value);
        } else {
            return Ok(x);
        }
    }
    if (high - low).abs() <= 2.0 * tolerance {
        return Ok(0.5 * (low + high));
    }
    Err(RootError::OutOfIterations)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Counts the evaluations that a residual needs.
    fn counted(f: impl Fn(f64) -> f64, a: f64, b: f64, sign: f64) -> (f64, u32) {
        let mut count = 0;
        let counting = |x| {
            count += 1;
            f(x)
        };
        let x = itp(counting, a, b, sign, 1e-13).unwrap();
        (x, count)
    }

    #[test]
    fn finds_known_roots_in_either_direction_within_the_bound() {
        // Bisection from a width of 2 to 2e-13 takes 44 evaluations; the bound is 1 + 44 + 2.
        for (a, b, sign) in [(0.0, 2.0, 1.0), (2.0, 0.0, -1.0)] {
            let (x, count) = counted(|x| x * x * x - 2.0, a, b, sign);
            assert!((x - 1.259_921_049_894_873_2).abs() < 2e-13, "{x}");
            assert!(count <= 14, "{count} evaluations on a smooth residual");
            let (x, count) = counted(|x| if x > 0.3 { 1.0 } else { -1e-9 }, a, b, sign);
            assert!((x - 0.3).abs() < 2e-13, "{x}");
            assert!(count <= 47, "{count} evaluations on a step");
        }
    }

    #[test]
    fn a_residual_that_vanishes_at_the_far_end_is_no_root_there() {
        // sin(x)(x - 1) vanishes at pi too, but changes sign at 1.
        let x = itp(|x| libm::sin(x) * (x - 1.0), 0.5, core::f64::consts::PI, 1.0, 1e-13).unwrap();
        assert!((x - 1.0).abs() < 2e-13, "{x}");
    }

    #[test]
    fn a_residual_that_is_no_number_is_an_error() {
        assert_eq!(
            itp(|x| if x < 0.1 { -1.0 } else { f64::NAN }, 0.0, 1.0, 1.0, 1e-13),
            Err(RootError::NotFinite)
        );
    }
}
