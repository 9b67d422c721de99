//! Two plain numbers in a register of SSE2, which every x86-64 processor has.

use super::{
    LANES, Lanes, Mask, Plain, alike_in_plain_lanes,
    elementary::{self, compiled},
};
use core::{
    arch::x86_64::*,
    fmt,
    ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub},
};

/// Two numbers.
#[derive(Clone, Copy)]
pub struct Sse2(__m128d);

/// All bits set in the lanes where a condition holds, else none.
#[derive(Clone, Copy)]
pub struct Sse2Mask(__m128d);

impl fmt::Debug for Sse2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.store()[..2].fmt(f)
    }
}

impl fmt::Debug for Sse2Mask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        [self.lane(0), self.lane(1)].fmt(f)
    }
}

impl PartialEq for Sse2 {
    fn eq(&self, other: &Self) -> bool {
        self.store()[..2] == other.store()[..2]
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $instruction:ident),*) => {$(
        impl $operator for Sse2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: every x86-64 processor has SSE2.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
        impl $operator<f64> for Sse2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(Self::splat(other))
            }
        }
    )*};
}
operators!(Add add _mm_add_pd, Sub sub _mm_sub_pd, Mul mul _mm_mul_pd, Div div _mm_div_pd);

impl Neg for Sse2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_xor_pd(self.0, _mm_set1_pd(-0.0)) })
    }
}

impl AddAssign for Sse2 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl BitAnd for Sse2Mask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_and_pd(self.0, other.0) })
    }
}

impl BitOr for Sse2Mask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_or_pd(self.0, other.0) })
    }
}

impl Not for Sse2Mask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_andnot_pd(self.0, Self::all_lanes(true).0) })
    }
}

impl Sse2Mask {
    /// One bit for each lane.
    #[inline(always)]
    fn bits(self) -> i32 {
        // SAFETY: as above.
        unsafe { _mm_movemask_pd(self.0) }
    }
}

impl Mask for Sse2Mask {
    const COUNT: usize = 2;
    #[inline(always)]
    fn all_lanes(holds: bool) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_castsi128_pd(_mm_set1_epi64x(-i64::from(holds))) })
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.bits() == 0b11
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.bits() >> lane & 1 != 0
    }
}

impl Lanes for Sse2 {
    type One = f64;
    type Real = Self;
    type Mask = Sse2Mask;
    const COUNT: usize = 2;

    alike_in_plain_lanes!(compiled);

    #[inline(always)]
    fn splat(number: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_set1_pd(number) })
    }
    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        Self::load(&[number(0), number(1), 0.0, 0.0])
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.store()[lane]
    }
    #[inline(always)]
    fn below(self, limit: Self) -> Sse2Mask {
        // SAFETY: as above.
        Sse2Mask(unsafe { _mm_cmplt_pd(self.0, limit.0) })
    }
    #[inline(always)]
    fn above(self, limit: Self) -> Sse2Mask {
        // SAFETY: as above.
        Sse2Mask(unsafe { _mm_cmpgt_pd(self.0, limit.0) })
    }
    #[inline(always)]
    fn is_negligible(self, limit: f64) -> Sse2Mask {
        // SAFETY: as above.
        Sse2Mask(unsafe { _mm_cmple_pd(self.abs().0, _mm_set1_pd(limit)) })
    }
    #[inline(always)]
    fn select(condition: Sse2Mask, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            let yes = _mm_and_pd(condition.0, yes.0);
            _mm_or_pd(yes, _mm_andnot_pd(condition.0, no.0))
        })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm_andnot_pd(_mm_set1_pd(-0.0), self.0) })
    }
}

impl Plain for Sse2 {
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: as above; the array has two numbers or more.
        Self(unsafe { _mm_loadu_pd(values.as_ptr()) })
    }
    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        let mut values = [0.0; LANES];
        // SAFETY: as above; the array has room for two numbers.
        unsafe { _mm_storeu_pd(values.as_mut_ptr(), self.0) };
        values
    }
    #[inline(always)]
    fn with_sign_of(self, sign: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            let bit = _mm_set1_pd(-0.0);
            _mm_or_pd(_mm_andnot_pd(bit, self.0), _mm_and_pd(bit, sign.0))
        })
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            let shifted = _mm_castpd_si128((self + elementary::INTEGERS).0);
            let one = _mm_set1_epi64x(1.0_f64.to_bits() as i64);
            _mm_castsi128_pd(_mm_add_epi64(_mm_slli_epi64::<52>(shifted), one))
        })
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: as above.
        unsafe {
            let constant = |bits: u64| _mm_set1_epi64x(bits as i64);
            let bits = _mm_castpd_si128(self.0);
            let bits = _mm_add_epi64(bits, constant(elementary::TO_SQRT_HALF));
            let mantissa = _mm_and_si128(bits, constant(elementary::MANTISSA));
            let mantissa = _mm_add_epi64(mantissa, constant(elementary::SQRT_HALF));
            let exponent = _mm_srli_epi64::<52>(bits);
            let exponent = _mm_add_epi64(exponent, constant(elementary::TO_EXPONENT));
            (
                Self(_mm_castsi128_pd(mantissa)),
                Self(_mm_castsi128_pd(exponent)) - elementary::INTEGERS,
            )
        }
    }
    #[inline(always)]
    fn to_index(self) -> [usize; LANES] {
        // SAFETY: as above.
        let both = unsafe { _mm_cvtsi128_si64(_mm_cvttpd_epi32(self.0)) } as u64;
        [both as u32 as usize, (both >> 32) as usize, 0, 0]
    }
    #[inline(always)]
    fn rows(table: &[[f64; 4]], index: &[usize; LANES]) -> [Self; 4] {
        let (a, b) = (&table[index[0]], &table[index[1]]);
        // SAFETY: as above; a row has four numbers.
        unsafe {
            let (a, b) = (a.as_ptr(), b.as_ptr());
            let (a01, a23) = (_mm_loadu_pd(a), _mm_loadu_pd(a.add(2)));
            let (b01, b23) = (_mm_loadu_pd(b), _mm_loadu_pd(b.add(2)));
            [
                Self(_mm_unpacklo_pd(a01, b01)),
                Self(_mm_unpackhi_pd(a01, b01)),
                Self(_mm_unpacklo_pd(a23, b23)),
                Self(_mm_unpackhi_pd(a23, b23)),
            ]
        }
    }
}
