//! The number type of the physics: a plain double or, where derivatives are wanted, a dual number.
//!
//! The elementary functions come from `numbers::elementary` and from the `libm` crate: those of the
//! standard library differ in their last bits between platforms, and the same FMU must give the
//! same bits on all of them.
//!
//! A dual number carries the derivative along one direction. Where the physics has a corner, in a
//! table or in a magnitude, it carries the one-sided derivative towards the side to which the
//! direction leads. So a branch whose two sides meet asks [`Lanes::is_below`] or
//! [`Lanes::is_above`] and not the value. The decision record
//! `docs/decisions/0001-one-sided-derivatives.md` says why.

use super::{Dual, Dual64, Equation, LANES, Lanes, Plain};
use core::{cell::RefCell, fmt::Debug};
use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_traits::{One, Zero};
use std::iter::Sum;

/// One real number, plain or dual. Angles are in rad.
///
/// Outside its domain a function gives NaN, as the functions of `libm` do; no function panics.
pub trait Scalar:
    Lanes<One = Self, Real = f64, Mask = bool>
    + nalgebra::Scalar
    + Zero
    + One
    + Sum
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
{
    /// Several, one for each lane.
    type PerLane: Copy + Debug;
    /// The same kind of number in the lanes of `V`.
    type In<V: Plain>: Lanes<One = Self, Real = V, Mask = V::Mask>;
    /// The value without the derivative.
    fn value(self) -> f64;
    /// `self` (>= 0) to a constant power.
    fn power(self, exponent: f64) -> Self;
    /// Distance of the point (self, other) from the origin.
    fn hypot(self, other: Self) -> Self;
    /// Cosine and sine of the direction of the point (x, y). A point at the origin has the
    /// direction into which it leaves it, or none if it stays there.
    fn direction(x: Self, y: Self) -> Option<(Self, Self)>;
    /// The root of an equation, already found at `root`, with its derivative: [`Lanes::at_roots`].
    fn at_root(root: f64, residual: impl FnMut(Self) -> Self) -> Self {
        Self::at_roots(root, &Residual(RefCell::new(residual)))
    }
}

/// An equation given by a function.
struct Residual<F>(RefCell<F>);

impl<S, F: FnMut(S) -> S> Equation<S> for Residual<F> {
    fn residual(&self, unknown: S) -> S {
        (self.0.borrow_mut())(unknown)
    }
}

impl Scalar for f64 {
    type PerLane = [f64; LANES];
    type In<V: Plain> = V;
    fn value(self) -> f64 {
        self
    }
    fn power(self, exponent: f64) -> Self {
        libm::pow(self, exponent)
    }
    fn hypot(self, other: Self) -> Self {
        libm::hypot(self, other)
    }
    fn direction(x: Self, y: Self) -> Option<(Self, Self)> {
        let distance = libm::hypot(x, y);
        (distance != 0.0).then(|| (x / distance, y / distance))
    }
}

impl Scalar for Dual64 {
    type PerLane = Dual<[f64; LANES]>;
    type In<V: Plain> = Dual<V>;
    fn value(self) -> f64 {
        self.re
    }
    fn power(self, exponent: f64) -> Self {
        let slope = exponent * libm::pow(self.re, exponent - 1.0);
        self.chain(libm::pow(self.re, exponent), slope)
    }
    fn hypot(self, other: Self) -> Self {
        let distance = libm::hypot(self.re, other.re);
        let change = if distance == 0.0 {
            libm::hypot(self.eps, other.eps)
        } else {
            self.re / distance * self.eps + other.re / distance * other.eps
        };
        Self::new(distance, change)
    }
    fn direction(x: Self, y: Self) -> Option<(Self, Self)> {
        if x.re != 0.0 || y.re != 0.0 {
            let distance = x.hypot(y);
            return Some((x / distance, y / distance));
        }
        let direction = f64::direction(x.eps, y.eps);
        direction.map(|(cos, sin)| (Self::from_re(cos), Self::from_re(sin)))
    }
}

#[cfg(test)]
mod tests {
    use super::{super::C, *};

    /// Functions of one variable at places without corners, against their differences.
    #[test]
    fn derivatives_are_those_of_differences() {
        fn functions<S: Scalar>(x: S) -> [S; 13] {
            let two = S::constant(2.0);
            [
                x.sin(),
                x.cos(),
                (x * 0.3).acos(),
                x.exp(),
                x.abs().ln(),
                x.abs().sqrt(),
                x.abs().power(1.7),
                x.atan2(two),
                two.atan2(x),
                x.hypot(x * x),
                (x - 0.5).abs(),
                x / (x * x + 1.0),
                S::direction(x, two).unwrap_or((x, x)).0,
            ]
        }
        for x in [-1.3, 0.2, 1.1, 2.9] {
            let step = 1e-6;
            let (above, below) = (functions(x + step), functions(x - step));
            let exact = functions(Dual64::new(x, 1.0));
            for (i, dual) in exact.into_iter().enumerate() {
                let difference = (above[i] - below[i]) / (2.0 * step);
                assert!((dual.re - functions(x)[i]).abs() < 1e-15, "{i} at {x}");
                assert!((dual.eps - difference).abs() < 1e-8, "{i} at {x}: {dual:?}");
            }
        }
    }

    #[test]
    fn corners_have_the_derivative_of_the_side_to_which_the_direction_leads() {
        let at = |value: f64, change: f64| Dual64::new(value, change);
        assert_eq!(at(0.0, -2.0).abs().eps, 2.0);
        assert_eq!(at(0.0, 3.0).hypot(at(0.0, -4.0)).eps, 5.0);
        assert_eq!(at(1.0, -1.0).at_least(1.0).eps, 0.0);
        assert_eq!(at(1.0, 1.0).at_least(1.0).eps, 1.0);
        assert_eq!(at(1.0, 1.0).at_most(1.0).eps, 0.0);
        let (cos, sin) = Dual64::direction(at(0.0, 0.0), at(0.0, -3.0)).unwrap();
        assert_eq!((cos.re, sin.re), (0.0, -1.0));
        assert!(Dual64::direction(at(0.0, 0.0), at(0.0, 0.0)).is_none());
        assert_eq!(at(0.0, 0.0).sqrt().eps, 0.0, "what stays, stays");
    }

    /// x^2 = p at p = 4: dx = dp/(2 x).
    #[test]
    fn a_root_moves_as_the_implicit_function_does() {
        let p = Dual64::new(4.0, 3.0);
        let x = Dual64::at_root(2.0, |x| x * x - p);
        assert_eq!((x.re, x.eps), (2.0, 0.75));
        assert_eq!(f64::at_root(2.0, |x| x * x - 4.0), 2.0);
    }

    /// x + |x|/2 = p, and x + |x - p|/2 = 2 p, whose corner moves with p, at p = 0.
    #[test]
    fn a_root_at_a_corner_moves_by_the_side_to_which_it_goes() {
        let moves = |change: f64, residual: fn(Dual64, Dual64) -> Dual64| {
            let p = Dual64::new(0.0, change);
            Dual64::at_root(0.0, |x| residual(x, p)).eps
        };
        let bent = |x: Dual64, p: Dual64| x + x.abs() * 0.5 - p;
        assert!((moves(3.0, bent) - 2.0).abs() < 1e-9);
        assert!((moves(-3.0, bent) + 6.0).abs() < 1e-9);
        let both = |x: Dual64, p: Dual64| x + (x - p).abs() * 0.5 - p * 2.0;
        assert!((moves(3.0, both) - 5.0).abs() < 1e-8);
        assert!((moves(-3.0, both) + 9.0).abs() < 1e-8);
    }

    /// Each operator of `C` against the same formula with the constant on the right, bit for bit.
    #[test]
    fn constants_on_the_left_have_the_bits_of_those_on_the_right() {
        for (a, x) in [(3.0, 0.1), (0.1, -7.3), (1.2e-7, 1e9), (0.0, -0.0)] {
            assert_eq!((C(a) + x).to_bits(), (x + a).to_bits());
            assert_eq!((C(a) - x).to_bits(), (a - x).to_bits());
            assert_eq!((C(a) * x).to_bits(), (x * a).to_bits());
            assert_eq!((C(a) / x).to_bits(), (a / x).to_bits());
            let bits = |dual: Dual64| (dual.re.to_bits(), dual.eps.to_bits());
            for change in [0.7, 0.0, -0.0] {
                let x = Dual64::new(x, change);
                assert_eq!(bits(C(a) + x), bits(x + a));
                assert_eq!(bits(C(a) - x), bits(Dual64::from_re(a) - x));
                assert_eq!(bits(C(a) * x), bits(x * a));
                let (found, expected) = (C(a) / x, Dual64::from_re(a) / x);
                assert_eq!(bits(found), bits(expected));
            }
        }
    }

    /// By hand at x = 2, dx = 1: 3 + x, 3 - x, 3 x and 3/x.
    #[test]
    fn constants_on_the_left_have_the_derivatives_of_calculus() {
        let x = Dual64::new(2.0, 1.0);
        for (found, value, slope) in [
            (C(3.0) + x, 5.0, 1.0),
            (C(3.0) - x, 1.0, -1.0),
            (C(3.0) * x, 6.0, 3.0),
            (C(3.0) / x, 1.5, -0.75),
        ] {
            assert_eq!((found.re, found.eps), (value, slope));
        }
    }

    #[test]
    fn a_function_without_slope_does_not_change_even_under_an_infinite_change() {
        assert_eq!(Dual64::new(-f64::INFINITY, f64::INFINITY).exp().eps, 0.0);
    }
}
