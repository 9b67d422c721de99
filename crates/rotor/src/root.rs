//! A bracketed root of one equation in one unknown.

use thiserror::Error;

/// Why no root was returned. A finite residual that changes its sign always has one.
#[derive(Debug, Error, Clone, Copy, PartialEq, Eq)]
pub enum RootError {
    /// The residual or an end of the bracket is NaN or infinite.
    #[error("the residual is not a finite number inside the bracket")]
    NotFinite,
    /// The bracket does not enclose a root.
    #[error("the residual has the same sign at both ends of the bracket")]
    NoSignChange,
    /// More evaluations than twice those of bisection.
    #[error("the bracket did not close within the method's bound on evaluations")]
    OutOfIterations,
}

/// One end of a bracket: a value of the unknown, and the residual there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// The value, in the unit of the unknown.
    pub at: f64,
    /// The residual there, in any unit.
    pub residual: f64,
}

/// Root of `residual` between two ends where it has different signs, by Chandrupatla's method
/// (1997, "A new hybrid quadratic/bisection algorithm for finding the zero of a nonlinear function
/// without using derivatives", Adv. Eng. Softw. 28(3), p. 145): inverse quadratic interpolation
/// where the last three points allow it, else bisection.
///
/// Bound: after as many steps as bisection alone would need, only bisection is used. So there are
/// never more than twice as many steps.
///
/// * `first`, `last`: the ends, in either order. Their residuals steer only the first steps: where
///   just the sign at an end is known, any value of that sign will do.
/// * `tolerance`: of the root, > 0, in the unit of the unknown; at least the rounding of the ends
///
/// # Errors
///
/// [`RootError::NotFinite`] if an end or a residual is NaN or infinite; [`RootError::NoSignChange`]
/// if the residuals at both ends have the same sign.
pub fn bracketed(
    mut residual: impl FnMut(f64) -> f64,
    first: End,
    last: End,
    tolerance: f64,
) -> Result<f64, RootError> {
    if ![first.at, first.residual, last.at, last.residual]
        .iter()
        .all(|x| x.is_finite())
    {
        return Err(RootError::NotFinite);
    }
    if first.residual == 0.0 || first.at == last.at {
        return Ok(first.at);
    }
    if last.residual == 0.0 {
        return Ok(last.at);
    }
    if (first.residual > 0.0) == (last.residual > 0.0) {
        return Err(RootError::NoSignChange);
    }
    let tolerance = tolerance.max(2.0 * f64::EPSILON * first.at.abs().max(last.at.abs()));
    let bisections = {
        let width = (last.at - first.at).abs();
        libm::ceil(libm::log2((width / tolerance).max(1.0))) as u32 + 1
    };
    // The root lies between `new` and `other`; `old` is the point that `new` replaced.
    let (mut new, mut other) = (first, last);
    let mut part = 0.5;
    for step in 0..2 * bisections {
        let at = new.at + part * (other.at - new.at);
        let next = End {
            at,
            residual: residual(at),
        };
        if !next.residual.is_finite() {
            return Err(RootError::NotFinite);
        }
        let old;
        if (next.residual > 0.0) == (new.residual > 0.0) {
            old = new;
        } else {
            (old, other) = (other, new);
        }
        new = next;
        let best = if new.residual.abs() < other.residual.abs() {
            new
        } else {
            other
        };
        let span = (other.at - new.at).abs();
        if best.residual == 0.0 || span <= 2.0 * tolerance {
            return Ok(best.at);
        }
        part = if step < bisections {
            interpolation(new, other, old)
        } else {
            0.5
        };
        let margin = tolerance / span;
        part = part.clamp(margin, 1.0 - margin);
    }
    Err(RootError::OutOfIterations)
}

/// Where the root is expected, as a part of the way from `new` to `other` (Chandrupatla 1997,
/// eqs. 6 to 8).
fn interpolation(new: End, other: End, old: End) -> f64 {
    let xi = (new.at - other.at) / (old.at - other.at);
    let phi = (new.residual - other.residual) / (old.residual - other.residual);
    let is_safe = phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
    if !is_safe {
        return 0.5;
    }
    let (a, b, c) = (new.residual, other.residual, old.residual);
    a / (b - a) * c / (b - c) + (old.at - new.at) / (other.at - new.at) * a / (c - a) * b / (c - b)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Root and the number of evaluations that it takes, from the values at both ends.
    fn counted(f: impl Fn(f64) -> f64, a: f64, b: f64) -> (f64, u32) {
        counted_to(f, a, b, 1e-13)
    }

    fn counted_to(f: impl Fn(f64) -> f64, a: f64, b: f64, tolerance: f64) -> (f64, u32) {
        let mut count = 0;
        let counting = |x| {
            count += 1;
            f(x)
        };
        let end = |at| End {
            at,
            residual: f(at),
        };
        let x = bracketed(counting, end(a), end(b), tolerance).unwrap();
        (x, count)
    }

    #[test]
    fn finds_known_roots_in_either_direction_within_the_bound() {
        // Bisection from a width of 2 to 1e-13 takes 45 evaluations; the bound is twice that.
        for (a, b) in [(0.0, 2.0), (2.0, 0.0)] {
            let (x, count) = counted(|x| x * x * x - 2.0, a, b);
            assert!((x - 1.259_921_049_894_873_2).abs() < 2e-13, "{x}");
            assert!(count <= 9, "{count} evaluations on a smooth residual");
            let (x, count) = counted(|x| if x > 0.3 { 1.0 } else { -1e-9 }, a, b);
            assert!((x - 0.3).abs() < 2e-13, "{x}");
            assert!(count <= 90, "{count} evaluations on a step");
        }
    }

    #[test]
    fn a_tolerance_below_the_rounding_of_the_places_is_raised_to_it() {
        let (x, count) = counted_to(|x| (x - 1e6) - 3e-10, 1e6 - 1e-9, 1e6 + 1e-9, 1e-30);
        assert!((x - 1e6).abs() < 1e-9);
        assert!(count <= 6, "{count}");
    }

    #[test]
    fn an_end_with_a_known_sign_only_is_not_taken_for_the_root() {
        // sin(x)(x - 1) vanishes at pi too, but changes its sign at 1.
        let residual = |x: f64| libm::sin(x) * (x - 1.0);
        let first = End {
            at: 0.5,
            residual: residual(0.5),
        };
        let last = End {
            at: core::f64::consts::PI,
            residual: 1.0,
        };
        let x = bracketed(residual, first, last, 1e-13).unwrap();
        assert!((x - 1.0).abs() < 2e-13, "{x}");
    }

    #[test]
    fn ends_of_one_sign_and_residuals_that_are_not_finite_are_errors() {
        let first = End {
            at: 0.0,
            residual: -1.0,
        };
        let last = End {
            at: 1.0,
            residual: 1.0,
        };
        assert_eq!(
            bracketed(|_| f64::NAN, first, last, 1e-13),
            Err(RootError::NotFinite)
        );
        assert_eq!(
            bracketed(|x| x, first, first, 1e-13),
            Ok(0.0),
            "an empty bracket is its end"
        );
        let same = End {
            residual: -2.0,
            ..last
        };
        assert_eq!(
            bracketed(|x| x, first, same, 1e-13),
            Err(RootError::NoSignChange)
        );
        let nowhere = End {
            at: f64::NAN,
            residual: 1.0,
        };
        assert_eq!(
            bracketed(|x| x - 0.5, first, nowhere, 1e-13),
            Err(RootError::NotFinite)
        );
    }
}
