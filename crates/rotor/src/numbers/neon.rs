//! Two plain numbers in a register of NEON, which every 64-bit ARM processor has.

use super::{
    LANES, Lanes, Mask, Plain, alike_in_plain_lanes,
    elementary::{self, compiled},
};
use core::{
    arch::aarch64::*,
    fmt,
    ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub},
};

/// Two numbers.
#[derive(Clone, Copy)]
pub struct Neon(float64x2_t);

/// All bits set in the lanes where a condition holds, else none.
#[derive(Clone, Copy)]
pub struct NeonMask(uint64x2_t);

impl fmt::Debug for Neon {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.store()[..2].fmt(f)
    }
}

impl fmt::Debug for NeonMask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        [self.lane(0), self.lane(1)].fmt(f)
    }
}

impl PartialEq for Neon {
    fn eq(&self, other: &Self) -> bool {
        self.store()[..2] == other.store()[..2]
    }
}

macro_rules! operators {
    ($($operator:ident $method:ident $instruction:ident),*) => {$(
        impl $operator for Neon {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                // SAFETY: every 64-bit ARM processor has NEON.
                Self(unsafe { $instruction(self.0, other.0) })
            }
        }
        impl $operator<f64> for Neon {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                self.$method(Self::splat(other))
            }
        }
    )*};
}
operators!(Add add vaddq_f64, Sub sub vsubq_f64, Mul mul vmulq_f64, Div div vdivq_f64);

impl Neg for Neon {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vnegq_f64(self.0) })
    }
}

impl AddAssign for Neon {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl BitAnd for NeonMask {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vandq_u64(self.0, other.0) })
    }
}

impl BitOr for NeonMask {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vorrq_u64(self.0, other.0) })
    }
}

impl Not for NeonMask {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { veorq_u64(self.0, Self::all_lanes(true).0) })
    }
}

impl Mask for NeonMask {
    const COUNT: usize = 2;
    #[inline(always)]
    fn all_lanes(holds: bool) -> Self {
        // SAFETY: as above.
        Self(unsafe { vdupq_n_u64(u64::from(holds).wrapping_neg()) })
    }
    #[inline(always)]
    fn any(self) -> bool {
        // SAFETY: as above.
        unsafe { vmaxvq_u32(vreinterpretq_u32_u64(self.0)) != 0 }
    }
    #[inline(always)]
    fn all(self) -> bool {
        // SAFETY: as above.
        unsafe { vminvq_u32(vreinterpretq_u32_u64(self.0)) != 0 }
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        // SAFETY: as above.
        let lanes = unsafe { [vgetq_lane_u64::<0>(self.0), vgetq_lane_u64::<1>(self.0)] };
        lanes[lane] != 0
    }
}

impl Lanes for Neon {
    type One = f64;
    type Real = Self;
    type Mask = NeonMask;
    const COUNT: usize = 2;

    alike_in_plain_lanes!(compiled);

    #[inline(always)]
    fn splat(number: f64) -> Self {
        // SAFETY: as above.
        Self(unsafe { vdupq_n_f64(number) })
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
    fn below(self, limit: Self) -> NeonMask {
        // SAFETY: as above.
        NeonMask(unsafe { vcltq_f64(self.0, limit.0) })
    }
    #[inline(always)]
    fn above(self, limit: Self) -> NeonMask {
        // SAFETY: as above.
        NeonMask(unsafe { vcgtq_f64(self.0, limit.0) })
    }
    #[inline(always)]
    fn is_negligible(self, limit: f64) -> NeonMask {
        // SAFETY: as above.
        NeonMask(unsafe { vcleq_f64(self.abs().0, vdupq_n_f64(limit)) })
    }
    #[inline(always)]
    fn select(condition: NeonMask, yes: Self, no: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vbslq_f64(condition.0, yes.0, no.0) })
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vsqrtq_f64(self.0) })
    }
    #[inline(always)]
    fn abs(self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vabsq_f64(self.0) })
    }
}

impl Plain for Neon {
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        // SAFETY: as above; the array has two numbers or more.
        Self(unsafe { vld1q_f64(values.as_ptr()) })
    }
    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        let mut values = [0.0; LANES];
        // SAFETY: as above; the array has room for two numbers.
        unsafe { vst1q_f64(values.as_mut_ptr(), self.0) };
        values
    }
    #[inline(always)]
    fn with_sign_of(self, sign: Self) -> Self {
        // SAFETY: as above.
        Self(unsafe { vbslq_f64(vdupq_n_u64((-0.0_f64).to_bits()), sign.0, self.0) })
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        // SAFETY: as above.
        Self(unsafe {
            let shifted = vreinterpretq_u64_f64((self + elementary::INTEGERS).0);
            let one = vdupq_n_u64(1.0_f64.to_bits());
            vreinterpretq_f64_u64(vaddq_u64(vshlq_n_u64::<52>(shifted), one))
        })
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        // SAFETY: as above.
        unsafe {
            let bits = vreinterpretq_u64_f64(self.0);
            let bits = vaddq_u64(bits, vdupq_n_u64(elementary::TO_SQRT_HALF));
            let mantissa = vandq_u64(bits, vdupq_n_u64(elementary::MANTISSA));
            let mantissa = vaddq_u64(mantissa, vdupq_n_u64(elementary::SQRT_HALF));
            let exponent = vshrq_n_u64::<52>(bits);
            let exponent = vaddq_u64(exponent, vdupq_n_u64(elementary::TO_EXPONENT));
            (
                Self(vreinterpretq_f64_u64(mantissa)),
                Self(vreinterpretq_f64_u64(exponent)) - elementary::INTEGERS,
            )
        }
    }
    #[inline(always)]
    fn to_index(self) -> [usize; LANES] {
        // SAFETY: as above.
        unsafe {
            let index = vcvtq_u64_f64(self.0);
            let (a, b) = (vgetq_lane_u64::<0>(index), vgetq_lane_u64::<1>(index));
            [a as usize, b as usize, 0, 0]
        }
    }
    #[inline(always)]
    fn rows(table: &[[f64; 4]], index: &[usize; LANES]) -> [Self; 4] {
        let (a, b) = (&table[index[0]], &table[index[1]]);
        // SAFETY: as above; a row has four numbers.
        unsafe {
            let (a, b) = (a.as_ptr(), b.as_ptr());
            let (a01, a23) = (vld1q_f64(a), vld1q_f64(a.add(2)));
            let (b01, b23) = (vld1q_f64(b), vld1q_f64(b.add(2)));
            [
                Self(vzip1q_f64(a01, b01)),
                Self(vzip2q_f64(a01, b01)),
                Self(vzip1q_f64(a23, b23)),
                Self(vzip2q_f64(a23, b23)),
            ]
        }
    }
}
