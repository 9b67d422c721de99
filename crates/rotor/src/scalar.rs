//! The number type of the physics: a plain double or, where derivatives are wanted, a dual number.
//!
//! The elementary functions come from the `libm` crate: those of the standard library differ in
//! their last bits between platforms, and the same FMU must give the same bits on all of them.
//!
//! A dual number (of the `num-dual` crate) carries the derivative along one direction. Where the
//! physics has a corner, in a table or in a magnitude, it carries the one-sided derivative towards
//! the side to which the direction leads. So a branch whose two sides meet asks
//! [`Scalar::is_below`] or [`Scalar::is_above`] and not the value. The decision record
//! `docs/decisions/0001-one-sided-derivatives.md` says why.

use nalgebra::{ClosedAddAssign, ClosedDivAssign, ClosedMulAssign, ClosedSubAssign};
use num_dual::Dual64;
use num_traits::{One, Zero};
use std::{
    iter::Sum,
    ops::{Add, Div, Mul, Neg, Sub},
};

/// A constant in a formula, written on the left as in print: `C(3.0) - C(2.0) * t`.
///
/// Rust allows no `f64 * S` for a generic `S`, but it allows the operators of a type of our own.
/// Each operator costs one operation of `S` and rounds as the printed order says:
///
/// | written    | computed                   |
/// |------------|----------------------------|
/// | `C(a) + x` | `x + a`, the same bits     |
/// | `C(a) * x` | `x * a`, the same bits     |
/// | `C(a) - x` | `S::constant(a) - x`       |
/// | `C(a) / x` | `S::constant(a) / x`       |
///
/// Rust reads `C(a) * x * y` as `(C(a) * x) * y`; write `C(a) * (x * y)` for the other order.
///
/// ```
/// use rotor::scalar::{C, Scalar};
///
/// /// Hermite's weight of the far end, 0 to 1: s(t) = t^2 (3 - 2 t).
/// fn weight<S: Scalar>(t: S) -> S {
///     t * t * (C(3.0) - C(2.0) * t)
/// }
/// assert_eq!(weight(0.5), 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct C(pub f64);

impl<S: Scalar> Add<S> for C {
    type Output = S;
    fn add(self, other: S) -> S {
        other + self.0
    }
}

impl<S: Scalar> Sub<S> for C {
    type Output = S;
    fn sub(self, other: S) -> S {
        S::constant(self.0) - other
    }
}

impl<S: Scalar> Mul<S> for C {
    type Output = S;
    fn mul(self, other: S) -> S {
        other * self.0
    }
}

impl<S: Scalar> Div<S> for C {
    type Output = S;
    fn div(self, other: S) -> S {
        S::constant(self.0) / other
    }
}

/// A real number with the arithmetic and the functions that the physics uses. Angles are in rad.
///
/// Outside its domain a function gives NaN, as the functions of `libm` do; no function panics.
pub trait Scalar:
    nalgebra::Scalar
    + Copy
    + Zero
    + One
    + Sum
    + Neg<Output = Self>
    + ClosedAddAssign
    + ClosedSubAssign
    + ClosedMulAssign
    + ClosedDivAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A constant: its derivative is 0.
    fn constant(value: f64) -> Self;
    /// The value without the derivative.
    fn value(self) -> f64;
    /// Whether it lies below `limit`, or at `limit` and is about to fall below it.
    fn is_below(self, limit: f64) -> bool;
    /// Whether it lies above `limit`, or at `limit` and is about to rise above it.
    fn is_above(self, limit: f64) -> bool;
    /// Whether its magnitude is at most `limit`, and it does not change.
    fn is_negligible(self, limit: f64) -> bool;
    /// Sine of an angle, rad.
    fn sin(self) -> Self;
    /// Cosine of an angle, rad.
    fn cos(self) -> Self;
    /// Inverse cosine, 0 to pi rad, of -1 to 1.
    fn acos(self) -> Self;
    /// e to the power of `self`.
    fn exp(self) -> Self;
    /// Natural logarithm of a positive number.
    fn ln(self) -> Self;
    /// Square root of a number >= 0.
    fn sqrt(self) -> Self;
    /// `self` (>= 0) to a constant power.
    fn power(self, exponent: f64) -> Self;
    /// Angle of the point (x, self), -pi to pi rad, counted from the x axis.
    fn atan2(self, x: Self) -> Self;
    /// Distance of the point (self, other) from the origin.
    fn hypot(self, other: Self) -> Self;
    /// Magnitude. At 0 its derivative is that of the side to which the number moves.
    fn abs(self) -> Self {
        if self.is_below(0.0) { -self } else { self }
    }
    /// `self` or the constant `floor`, the larger of the two.
    fn at_least(self, floor: f64) -> Self {
        if self.is_below(floor) {
            Self::constant(floor)
        } else {
            self
        }
    }
    /// `self` or the constant `ceiling`, the smaller of the two.
    fn at_most(self, ceiling: f64) -> Self {
        if self.is_above(ceiling) {
            Self::constant(ceiling)
        } else {
            self
        }
    }
    /// Cosine and sine of the direction of the point (x, y). A point at the origin has the
    /// direction into which it leaves it, or none if it stays there.
    fn direction(x: Self, y: Self) -> Option<(Self, Self)>;
    /// The root of an equation, already found at `root`, with its derivative.
    ///
    /// A dual number gets the derivative by the implicit function theorem,
    /// dx = -(dR/dp) dp/(dR/dx), at the root and not through the search for it. Where the root lies
    /// at a corner of the residual, the slope is that of the side to which the root moves. The
    /// derivative is NaN where the residual does not change with x.
    fn at_root(root: f64, residual: impl FnMut(Self) -> Self) -> Self;
}

impl Scalar for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn is_below(self, limit: f64) -> bool {
        self < limit
    }
    fn is_above(self, limit: f64) -> bool {
        self > limit
    }
    fn is_negligible(self, limit: f64) -> bool {
        f64::abs(self) <= limit
    }
    fn sin(self) -> Self {
        libm::sin(self)
    }
    fn cos(self) -> Self {
        libm::cos(self)
    }
    fn acos(self) -> Self {
        libm::acos(self)
    }
    fn exp(self) -> Self {
        libm::exp(self)
    }
    fn ln(self) -> Self {
        libm::log(self)
    }
    fn sqrt(self) -> Self {
        libm::sqrt(self)
    }
    fn power(self, exponent: f64) -> Self {
        libm::pow(self, exponent)
    }
    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
    fn hypot(self, other: Self) -> Self {
        libm::hypot(self, other)
    }
    fn direction(x: Self, y: Self) -> Option<(Self, Self)> {
        let distance = libm::hypot(x, y);
        (distance != 0.0).then(|| (x / distance, y / distance))
    }
    fn at_root(root: f64, _residual: impl FnMut(Self) -> Self) -> Self {
        root
    }
}

/// A function of `x` from its value and slope there. An `x` that does not change gives a result
/// that does not change, even where the slope is infinite; so does a slope of 0, even where the
/// change is infinite.
fn chain(x: Dual64, value: f64, slope: f64) -> Dual64 {
    let is_still = x.eps == 0.0 || slope == 0.0;
    let change = if is_still { 0.0 } else { slope * x.eps };
    Dual64::new(value, change)
}

/// Bound on the steps of the secant method that finds the change of a root at a corner. Without a
/// corner the first step is the implicit function theorem, and ends the search.
const MAX_SECANTS: u32 = 30;

/// The search ends where this part of the residual's change is left, which is rounding.
const ROUNDING: f64 = 1e-10;

impl Scalar for Dual64 {
    fn constant(value: f64) -> Self {
        Self::from_re(value)
    }
    fn value(self) -> f64 {
        self.re
    }
    fn is_below(self, limit: f64) -> bool {
        self.re < limit || (self.re == limit && self.eps < 0.0)
    }
    fn is_above(self, limit: f64) -> bool {
        self.re > limit || (self.re == limit && self.eps > 0.0)
    }
    fn is_negligible(self, limit: f64) -> bool {
        self.re.is_negligible(limit) && self.eps == 0.0
    }
    fn sin(self) -> Self {
        chain(self, libm::sin(self.re), libm::cos(self.re))
    }
    fn cos(self) -> Self {
        chain(self, libm::cos(self.re), -libm::sin(self.re))
    }
    fn acos(self) -> Self {
        let slope = -1.0 / libm::sqrt(1.0 - self.re * self.re);
        chain(self, libm::acos(self.re), slope)
    }
    fn exp(self) -> Self {
        let value = libm::exp(self.re);
        chain(self, value, value)
    }
    fn ln(self) -> Self {
        chain(self, libm::log(self.re), 1.0 / self.re)
    }
    fn sqrt(self) -> Self {
        let value = libm::sqrt(self.re);
        chain(self, value, 0.5 / value)
    }
    fn power(self, exponent: f64) -> Self {
        let slope = exponent * libm::pow(self.re, exponent - 1.0);
        chain(self, libm::pow(self.re, exponent), slope)
    }
    fn atan2(self, x: Self) -> Self {
        let (y, square) = (self, self.re * self.re + x.re * x.re);
        let turned = x.re * y.eps - y.re * x.eps;
        let change = if turned == 0.0 { 0.0 } else { turned / square };
        Self::new(libm::atan2(y.re, x.re), change)
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
    fn at_root(root: f64, mut residual: impl FnMut(Self) -> Self) -> Self {
        // Change of the residual if the root moves by `change`. It is linear in `change`,
        // except where corners meet at the root.
        let mut surplus = |change: f64| residual(Self::new(root, change)).eps;
        let still = surplus(0.0);
        if still == 0.0 {
            return Self::from_re(root);
        }
        let (mut last, mut at) = ((1.0, surplus(1.0)), (0.0, still));
        let mut best = (f64::INFINITY, f64::NAN);
        for _ in 0..MAX_SECANTS {
            let change = at.0 - at.1 * (at.0 - last.0) / (at.1 - last.1);
            (last, at) = (at, (change, surplus(change)));
            if at.1.is_nan() || at.1.abs() >= best.0 {
                break;
            }
            best = (at.1.abs(), change);
            if best.0 <= ROUNDING * still.abs() {
                break;
            }
        }
        Self::new(root, best.1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
                assert!((dual.eps - difference).abs() < 1e-8, "{i} at {x}: {dual}");
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
