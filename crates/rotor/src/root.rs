//! Bracketed roots of equations in one unknown, side by side.

use super::numbers::{Mask, Plain};
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

/// One end of a bracket in each lane: a value of the unknown, and the residual there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End<V = f64> {
    /// The value, in the unit of the unknown.
    pub at: V,
    /// The residual there, in any unit.
    pub residual: V,
}

impl<V: Plain> End<V> {
    /// `yes` where a condition holds, else `no`.
    pub fn select(condition: V::Mask, yes: Self, no: Self) -> Self {
        Self {
            at: V::select(condition, yes.at, no.at),
            residual: V::select(condition, yes.residual, no.residual),
        }
    }
}

/// Root of `residual` between two ends where it has different signs, in each lane, by
/// Chandrupatla's method (1997, "A new hybrid quadratic/bisection algorithm for finding the zero of
/// a nonlinear function without using derivatives", Adv. Eng. Softw. 28(3), p. 145): inverse
/// quadratic interpolation where the last three points allow it, else bisection.
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
/// [`RootError::NotFinite`] if an end or a residual is NaN or infinite in any lane;
/// [`RootError::NoSignChange`] if the residuals at both ends of a lane have the same sign.
pub fn bracketed<V: Plain>(
    mut residual: impl FnMut(V) -> V,
    first: End<V>,
    last: End<V>,
    tolerance: V,
) -> Result<V, RootError> {
    let is_finite = |x: V| x.is_negligible(f64::MAX);
    let same_sign = |a: V, b: V| {
        let (a, b) = (a.is_above(0.0), b.is_above(0.0));
        (a & b) | (!a & !b)
    };
    let larger = |a: V, b: V| V::select(a.below(b), b, a);
    let ends_are_finite = is_finite(first.at)
        & is_finite(first.residual)
        & is_finite(last.at)
        & is_finite(last.residual);
    if !ends_are_finite.all() {
        return Err(RootError::NotFinite);
    }
    let is_first = first.residual.is_negligible(0.0) | (first.at - last.at).is_negligible(0.0);
    let mut is_found = is_first | last.residual.is_negligible(0.0);
    let mut found = V::select(is_first, first.at, last.at);
    if is_found.all() {
        return Ok(found);
    }
    if (same_sign(first.residual, last.residual) & !is_found).any() {
        return Err(RootError::NoSignChange);
    }
    let rounding = larger(first.at.abs(), last.at.abs()) * (2.0 * f64::EPSILON);
    let tolerance = larger(tolerance, rounding);
    let bisections = {
        let widths = (last.at - first.at).abs() / tolerance;
        let width = widths.store()[..V::COUNT]
            .iter()
            .fold(1.0, |a, b| f64::max(a, *b));
        libm::ceil(libm::log2(width)) as u32 + 1
    };
    // The root lies between `new` and `other`; `old` is the point that `new` replaced.
    let (mut new, mut other) = (first, last);
    let mut part = V::splat(0.5);
    for step in 0..2 * bisections {
        let at = new.at + part * (other.at - new.at);
        let next = End {
            at,
            residual: residual(at),
        };
        if !(is_found | is_finite(next.residual)).all() {
            return Err(RootError::NotFinite);
        }
        let is_same = same_sign(next.residual, new.residual);
        let old = End::select(is_same, new, other);
        other = End::select(is_same, other, new);
        new = next;
        let is_new = new.residual.abs().below(other.residual.abs());
        let best = End::select(is_new, new, other);
        let span = (other.at - new.at).abs();
        let is_close = !span.above(tolerance * 2.0);
        let ends = (best.residual.is_negligible(0.0) | is_close) & !is_found;
        found = V::select(ends, best.at, found);
        is_found = is_found | ends;
        if is_found.all() {
            return Ok(found);
        }
        part = if step < bisections {
            interpolation(new, other, old)
        } else {
            V::splat(0.5)
        };
        let margin = tolerance / span;
        let far = V::splat(1.0) - margin;
        part = V::select(part.below(margin), margin, part);
        part = V::select(part.above(far), far, part);
    }
    Err(RootError::OutOfIterations)
}

/// Where the root is expected, as a part of the way from `new` to `other` (Chandrupatla 1997,
/// eqs. 6 to 8).
fn interpolation<V: Plain>(new: End<V>, other: End<V>, old: End<V>) -> V {
    let one = V::splat(1.0);
    let xi = (new.at - other.at) / (old.at - other.at);
    let phi = (new.residual - other.residual) / (old.residual - other.residual);
    let is_safe = (phi * phi).below(xi) & ((one - phi) * (one - phi)).below(one - xi);
    let (a, b, c) = (new.residual, other.residual, old.residual);
    let near = a / (b - a) * c / (b - c);
    let far = (old.at - new.at) / (other.at - new.at) * a / (c - a) * b / (c - b);
    V::select(is_safe, near + far, V::splat(0.5))
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
