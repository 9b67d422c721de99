//! Four plain numbers in a register of AVX2. `run` makes them only where the processor has it.

use super::{LANES, Lanes, Mask, Plain, alike_in_plain_lanes, elementary};
use core::{
    arch::x86_64::*,
    fmt,
    ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub},
};

/// Four numbers.
#[derive(Clone, Copy)]
pub struct Avx2(__m256d);

/// All bits set in the lanes where a condition holds, else none.
#[derive(Clone, Copy)]
pub struct Avx2Mask(__m256d);

impl fmt::Debug for Avx2 {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.store().fmt(f)
    }
}

impl fmt::Debug for Avx2Mask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        core::array::from_fn::<_, LANES, _>(|lane| self.lane(lane)).fmt(f)
    }
}

impl PartialEq for Avx2 {
    fn eq(&self, other: &Self) -> bool {
        self.store() == other.store()
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $instruction:ident),*) => {$(
        impl $operator for Avx2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: `run` makes lanes of this kind only on processors with AVX2.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
        impl $operator<f64> for Avx2 {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(Self::splat(other))
            }
        }
    )*};
}
operators!(Add add _mm256_add_pd, Sub sub _mm256_sub_pd, Mul mul _mm256_mul_pd, Div div _mm256_div_pd);

impl Neg for Avx2 {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_xor_pd(self.0, _mm256_set1_pd(-0.0)) })
    }
}

impl AddAssign for Avx2 {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl BitAnd for Avx2Mask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_and_pd(self.0, other.0) })
    }
}

impl BitOr for Avx2Mask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_or_pd(self.0, other.0) })
    }
}

impl Not for Avx2Mask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_andnot_pd(self.0, Self::all_lanes(true).0) })
    }
}

impl Avx2Mask {
    /// One bit for each lane.
    #[inline(always)]
    fn bits(self) -> i32 {
        // SAFETY: as above.
        unsafe { _mm256_movemask_pd(self.0) }
    }
}

impl Mask for Avx2Mask {
    const COUNT: usize = LANES;
    #[inline(always)]
    fn all_lanes(holds: bool) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_castsi256_pd(_mm256_set1_epi64x(-i64::from(holds))) })
    }
    #[inline(always)]
    fn any(self) -> bool {
        self.bits() != 0
    }
    #[inline(always)]
    fn all(self) -> bool {
        self.bits() == 0b1111
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        self.bits() >> lane & 1 != 0
    }
}

impl Lanes for Avx2 {
    type One = f64;
    type Real = Self;
    type Mask = Avx2Mask;
    const COUNT: usize = LANES;

    alike_in_plain_lanes!(elementary);

    #[inline(always)]
    fn splat(number: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_set1_pd(number) })
    }
    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        Self::load(&[number(0), number(1), number(2), number(3)])
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        self.store()[lane]
    }
    #[inline(always)]
    fn below(self, limit: Self) -> Avx2Mask {
        // SAFETY: as above.
        Avx2Mask(unsafe { _mm256_cmp_pd::<_CMP_LT_OQ>(self.0, limit.0) })
    }
    #[inline(always)]
    fn above(self, limit: Self) -> Avx2Mask {
        // SAFETY: as above.
        Avx2Mask(unsafe { _mm256_cmp_pd::<_CMP_GT_OQ>(self.0, limit.0) })
    }
    #[inline(always)]
    fn is_negligible(self, limit: f64) -> Avx2Mask {
        // SAFETY: as above.
        Avx2Mask(unsafe { _mm256_cmp_pd::<_CMP_LE_OQ>(self.abs().0, _mm256_set1_pd(limit)) })
    }
    #[inline(always)]
    fn select(condition: Avx2Mask, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_blendv_pd(no.0, yes.0, condition.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_sqrt_pd(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { _mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0) })
    }
}

impl Plain for Avx2 {
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: as above; the array has four numbers.
        Self(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }
    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        let mut values = [0.0; LANES];
        // SAFETY: as above; the array has room for four numbers.
        unsafe { _mm256_storeu_pd(values.as_mut_ptr(), self.0) };
        values
    }
    #[inline(always)]
    fn with_sign_of(self, sign: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            let bit = _mm256_set1_pd(-0.0);
            _mm256_or_pd(_mm256_andnot_pd(bit, self.0), _mm256_and_pd(bit, sign.0))
        })
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            let shifted = _mm256_castpd_si256((self + elementary::INTEGERS).0);
            let one = _mm256_set1_epi64x(1.0_f64.to_bits() as i64);
            _mm256_castsi256_pd(_mm256_add_epi64(_mm256_slli_epi64::<52>(shifted), one))
        })
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: as above.
        unsafe {
            let constant = |bits: u64| _mm256_set1_epi64x(bits as i64);
            let bits = _mm256_castpd_si256(self.0);
            let bits = _mm256_add_epi64(bits, constant(elementary::TO_SQRT_HALF));
            let mantissa = _mm256_and_si256(bits, constant(elementary::MANTISSA));
            let mantissa = _mm256_add_epi64(mantissa, constant(elementary::SQRT_HALF));
            let exponent = _mm256_srli_epi64::<52>(bits);
            let exponent = _mm256_add_epi64(exponent, constant(elementary::TO_EXPONENT));
            (
                Self(_mm256_castsi256_pd(mantissa)),
                Self(_mm256_castsi256_pd(exponent)) - elementary::INTEGERS,
            )
        }
    }
    #[inline(always)]
    fn to_index(self) -> [usize; LANES] {
        // SAFETY: as above.
        let (low, high) = unsafe {
            let index = _mm256_cvttpd_epi32(self.0);
            let both = (_mm_cvtsi128_si64(index), _mm_extract_epi64::<1>(index));
            (both.0 as u64, both.1 as u64)
        };
        [
            low as u32 as usize,
            (low >> 32) as usize,
            high as u32 as usize,
            (high >> 32) as usize,
        ]
    }
    #[inline(always)]
    fn rows(table: &[[f64; 4]], index: &[usize; LANES]) -> [Self; 4] {
        // Not by `index.map`: where little is inlined it is called, 12,000 instructions of an
        // azimuth step.
        let row = [
            &table[index[0]],
            &table[index[1]],
            &table[index[2]],
            &table[index[3]],
        ];
        // SAFETY: as above; a row has four numbers.
        unsafe {
            let row = [
                _mm256_loadu_pd(row[0].as_ptr()),
                _mm256_loadu_pd(row[1].as_ptr()),
                _mm256_loadu_pd(row[2].as_ptr()),
                _mm256_loadu_pd(row[3].as_ptr()),
            ];
            let even = (
                _mm256_unpacklo_pd(row[0], row[1]),
                _mm256_unpacklo_pd(row[2], row[3]),
            );
            let odd = (
                _mm256_unpackhi_pd(row[0], row[1]),
                _mm256_unpackhi_pd(row[2], row[3]),
            );
            [
                Self(_mm256_permute2f128_pd::<0x20>(even.0, even.1)),
                Self(_mm256_permute2f128_pd::<0x20>(odd.0, odd.1)),
                Self(_mm256_permute2f128_pd::<0x31>(even.0, even.1)),
                Self(_mm256_permute2f128_pd::<0x31>(odd.0, odd.1)),
            ]
        }
    }
}
