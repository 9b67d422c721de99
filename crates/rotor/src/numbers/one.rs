//! One plain number.

use super::{Equation, LANES, Lanes, Mask, Plain, elementary};

impl Mask for bool {
    const COUNT: usize = 1;
    #[inline(always)]
    fn all_lanes(holds: bool) -> Self {
        holds
    }
    #[inline(always)]
    fn any(self) -> bool {
        self
    }
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
    #[inline(always)]
    fn lane(self, _lane: usize) -> bool {
        self
    }
}

impl Lanes for f64 {
    type One = Self;
    type Real = Self;
    type Mask = bool;
    const COUNT: usize = 1;

    #[inline(always)]
    fn splat(number: f64) -> Self {
        number
    }
    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        number(0)
    }
    #[inline(always)]
    fn lane(self, _lane: usize) -> f64 {
        self
    }
    #[inline(always)]
    fn real(values: Self) -> Self {
        values
    }
    #[inline(always)]
    fn values(self) -> Self {
        self
    }
    #[inline(always)]
    fn times(self, factor: Self) -> Self {
        self * factor
    }
    #[inline(always)]
    fn plus_real(self, term: Self) -> Self {
        self + term
    }
    #[inline(always)]
    fn below(self, limit: Self) -> bool {
        self < limit
    }
    #[inline(always)]
    fn above(self, limit: Self) -> bool {
        self > limit
    }
    #[inline(always)]
    fn negligible(self, limit: f64) -> bool {
        f64::abs(self) <= limit
    }
    #[inline(always)]
    fn select(condition: bool, yes: Self, no: Self) -> Self {
        if condition { yes } else { no }
    }
    #[inline(always)]
    fn sin_cos(self) -> (Self, Self) {
        elementary::sin_cos(self)
    }
    #[inline(always)]
    fn acos(self) -> Self {
        elementary::acos(self)
    }
    #[inline(always)]
    fn exp(self) -> Self {
        elementary::exp(self)
    }
    #[inline(always)]
    fn ln(self) -> Self {
        elementary::ln(self)
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // The hardware's, which IEEE 754 rounds correctly.
        #[allow(clippy::disallowed_methods)]
        f64::sqrt(self)
    }
    #[inline(always)]
    fn length(self, other: Self) -> Self {
        Lanes::sqrt(self * self + other * other)
    }
    #[inline(always)]
    fn atan2(self, x: Self) -> Self {
        elementary::atan2(self, x)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
    }
    #[inline(always)]
    fn at_roots(root: Self, _equation: &impl Equation<Self>) -> Self {
        root
    }
}

impl Plain for f64 {
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        values[0]
    }
    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        [self; LANES]
    }
    #[inline(always)]
    fn with_sign_of(self, sign: Self) -> Self {
        self.copysign(sign)
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        let shifted = self + elementary::INTEGERS;
        f64::from_bits((shifted.to_bits() << 52).wrapping_add(1.0_f64.to_bits()))
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let bits = self.to_bits().wrapping_add(elementary::TO_SQRT_HALF);
        let mantissa = (bits & elementary::MANTISSA).wrapping_add(elementary::SQRT_HALF);
        let exponent = (bits >> 52).wrapping_add(elementary::TO_EXPONENT);
        (
            f64::from_bits(mantissa),
            f64::from_bits(exponent) - elementary::INTEGERS,
        )
    }
    #[inline(always)]
    fn to_index(self) -> [usize; LANES] {
        [self as usize, 0, 0, 0]
    }
    #[inline(always)]
    fn rows(table: &[[f64; 4]], index: &[usize; LANES]) -> [Self; 4] {
        table[index[0]]
    }
}
