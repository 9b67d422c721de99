//! Dual numbers: values with the derivative along one direction (Clifford 1873), in any lanes.

use super::{Equation, LANES, Lanes, Mask, Plain};
use core::{
    iter::Sum,
    ops::{Add, AddAssign, Div, DivAssign, Mul, MulAssign, Neg, Sub, SubAssign},
};

/// A number re + eps e with e^2 = 0: a value and its derivative along a direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dual<V = f64> {
    /// The value.
    pub re: V,
    /// The derivative.
    pub eps: V,
}

/// One dual number.
pub type Dual64 = Dual<f64>;

impl<V: Plain> Dual<V> {
    /// A value with a derivative.
    #[inline(always)]
    pub fn new(re: V, eps: V) -> Self {
        Self { re, eps }
    }

    /// A constant.
    #[inline(always)]
    pub fn from_re(re: V) -> Self {
        Self::new(re, V::nil())
    }

    /// A function from its value and slope here. A number that does not change gives a result that
    /// does not change, even where the slope is infinite; so does a slope of 0, even where the
    /// change is infinite.
    #[inline(always)]
    pub(crate) fn chain(self, value: V, slope: V) -> Self {
        let is_still = self.eps.is_negligible(0.0) | slope.is_negligible(0.0);
        Self::new(value, V::select(is_still, V::nil(), slope * self.eps))
    }
}

impl<V: Plain> Neg for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.re, -self.eps)
    }
}

impl<V: Plain> Add for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self::new(self.re + other.re, self.eps + other.eps)
    }
}

impl<V: Plain> Sub for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self::new(self.re - other.re, self.eps - other.eps)
    }
}

impl<V: Plain> Mul for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        let change = self.eps * other.re + self.re * other.eps;
        Self::new(self.re * other.re, change)
    }
}

impl<V: Plain> Div for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: Self) -> Self {
        let ratio = self.re / other.re;
        Self::new(ratio, (self.eps - ratio * other.eps) / other.re)
    }
}

impl<V: Plain> Add<f64> for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: f64) -> Self {
        Self::new(self.re + other, self.eps)
    }
}

impl<V: Plain> Sub<f64> for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: f64) -> Self {
        Self::new(self.re - other, self.eps)
    }
}

impl<V: Plain> Mul<f64> for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, other: f64) -> Self {
        Self::new(self.re * other, self.eps * other)
    }
}

impl<V: Plain> Div<f64> for Dual<V> {
    type Output = Self;
    #[inline(always)]
    fn div(self, other: f64) -> Self {
        Self::new(self.re / other, self.eps / other)
    }
}

macro_rules! assign {
    ($($operator:ident $method:ident $by:tt),*) => {$(
        impl<V: Plain> $operator for Dual<V> {
            #[inline(always)]
            fn $method(&mut self, other: Self) {
                *self = *self $by other;
            }
        }
    )*};
}
assign!(AddAssign add_assign +, SubAssign sub_assign -, MulAssign mul_assign *, DivAssign div_assign /);

impl<V: Plain> Sum for Dual<V> {
    fn sum<I: Iterator<Item = Self>>(numbers: I) -> Self {
        numbers.fold(Self::from_re(V::nil()), Add::add)
    }
}

impl num_traits::Zero for Dual {
    fn zero() -> Self {
        Self::from_re(0.0)
    }
    fn is_zero(&self) -> bool {
        *self == Self::zero()
    }
}

impl num_traits::One for Dual {
    fn one() -> Self {
        Self::from_re(1.0)
    }
}

/// Bound on the steps of the secant method that finds the change of a root at a corner. Without a
/// corner the first step is the implicit function theorem, and ends the search.
const MAX_SECANTS: u32 = 30;

/// The search ends where this part of the residual's change is left, which is rounding.
const ROUNDING: f64 = 1e-10;

impl<V: Plain> Lanes for Dual<V> {
    type One = Dual;
    type Real = V;
    type Mask = V::Mask;
    const COUNT: usize = V::COUNT;

    #[inline(always)]
    fn splat(number: Dual) -> Self {
        Self::new(V::splat(number.re), V::splat(number.eps))
    }
    #[inline(always)]
    fn per_lane(self) -> Dual<[f64; LANES]> {
        Dual {
            re: self.re.store(),
            eps: self.eps.store(),
        }
    }
    #[inline(always)]
    fn in_lanes(numbers: &Dual<[f64; LANES]>) -> Self {
        Self::new(V::load(&numbers.re), V::load(&numbers.eps))
    }
    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> Dual) -> Self {
        let (mut re, mut eps) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..V::COUNT {
            let number = number(lane);
            (re[lane], eps[lane]) = (number.re, number.eps);
        }
        Self::new(V::load(&re), V::load(&eps))
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> Dual {
        Dual::new(self.re.lane(lane), self.eps.lane(lane))
    }
    #[inline(always)]
    fn real(values: V) -> Self {
        Self::from_re(values)
    }
    #[inline(always)]
    fn values(self) -> V {
        self.re
    }
    #[inline(always)]
    fn times(self, factor: V) -> Self {
        Self::new(self.re * factor, self.eps * factor)
    }
    #[inline(always)]
    fn plus_real(self, term: V) -> Self {
        Self::new(self.re + term, self.eps)
    }
    #[inline(always)]
    fn below(self, limit: V) -> V::Mask {
        let is_at = (self.re - limit).is_negligible(0.0);
        self.re.below(limit) | (is_at & self.eps.is_below(0.0))
    }
    #[inline(always)]
    fn above(self, limit: V) -> V::Mask {
        let is_at = (self.re - limit).is_negligible(0.0);
        self.re.above(limit) | (is_at & self.eps.is_above(0.0))
    }
    #[inline(always)]
    fn is_negligible(self, limit: f64) -> V::Mask {
        self.re.is_negligible(limit) & self.eps.is_negligible(0.0)
    }
    #[inline(always)]
    fn select(condition: V::Mask, yes: Self, no: Self) -> Self {
        Self::new(
            V::select(condition, yes.re, no.re),
            V::select(condition, yes.eps, no.eps),
        )
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        let (sin, cos) = self.re.sin_cos();
        (self.chain(sin, cos), self.chain(cos, -sin))
    }
    #[inline(always)]
    fn acos(self) -> Self {
        let slope = V::splat(-1.0) / (V::unit() - self.re * self.re).sqrt();
        self.chain(self.re.acos(), slope)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        let value = self.re.exp();
        self.chain(value, value)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        self.chain(self.re.ln(), V::unit() / self.re)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        let value = self.re.sqrt();
        self.chain(value, V::splat(0.5) / value)
    }
    #[inline(always)]
    fn length(self, other: Self) -> Self {
        let length = self.re.length(other.re);
        let change = (self.re * self.eps + other.re * other.eps) / length;
        let begins = length.is_negligible(0.0);
        Self::new(
            length,
            V::select(begins, self.eps.length(other.eps), change),
        )
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        let y = self;
        let turned = x.re * y.eps - y.re * x.eps;
        let square = y.re * y.re + x.re * x.re;
        let change = V::select(turned.is_negligible(0.0), V::nil(), turned / square);
        Self::new(y.re.atan2(x.re), change)
    }
    #[inline(always)]
    fn at_roots(root: V, equation: &impl Equation<Self>) -> Self {
        // The residual changes linearly with the root's change, except where corners meet at the
        // root: two trials at changes of 0 and 1, and secants from there.
        let zero = V::nil();
        let (mut last, mut at) = ((zero, zero), (zero, zero));
        let mut best = (V::splat(f64::INFINITY), V::splat(f64::NAN));
        let mut limit = zero;
        let mut open = V::Mask::all_lanes(true);
        let mut change = zero;
        for trial in 0..MAX_SECANTS + 2 {
            let surplus = equation.residual(Self::new(root, change)).eps;
            match trial {
                0 => {
                    limit = surplus.abs() * ROUNDING;
                    open = !surplus.is_negligible(0.0);
                    // A residual that does not change leaves the root where it is.
                    best.1 = V::select(open, best.1, zero);
                    (last, at) = ((zero, surplus), (zero, surplus));
                    change = V::unit();
                }
                1 => last = (change, surplus),
                _ => {
                    (last, at) = (
                        (V::select(open, at.0, last.0), V::select(open, at.1, last.1)),
                        (
                            V::select(open, change, at.0),
                            V::select(open, surplus, at.1),
                        ),
                    );
                    // NaN is no improvement.
                    open = open & surplus.abs().below(best.0);
                    best.0 = V::select(open, surplus.abs(), best.0);
                    best.1 = V::select(open, change, best.1);
                    open = open & best.0.above(limit);
                }
            }
            if trial == 0 {
                if !open.any() {
                    break;
                }
                continue;
            }
            if !open.any() {
                break;
            }
            let secant = at.0 - at.1 * (at.0 - last.0) / (at.1 - last.1);
            change = V::select(open, secant, change);
        }
        Self::new(root, best.1)
    }
}
