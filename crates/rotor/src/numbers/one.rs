//! One plain number.

use super::{LANES, Lanes, Mask, Plain, alike_in_plain_lanes, elementary};

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

    alike_in_plain_lanes!(elementary);

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
    fn below(self, limit: Self) -> bool {
        self < limit
    }
    #[inline(always)]
    fn above(self, limit: Self) -> bool {
        self > limit
    }
    #[inline(always)]
    fn is_negligible(self, limit: f64) -> bool {
        f64::abs(self) <= limit
    }
    #[inline(always)]
    fn select(condition: bool, yes: Self, no: Self) -> Self {
        if condition { yes } else { no }
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // The hardware's, which IEEE 754 rounds correctly.
        #[allow(clippy::disallowed_methods)]
        f64::sqrt(self)
    }
    #[inline(always)]
    fn abs(self) -> Self {
        f64::abs(self)
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
