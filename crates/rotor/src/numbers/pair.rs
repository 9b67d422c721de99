//! Two groups of lanes, computed one after the other.

use super::{LANES, Lanes, Mask, Plain, alike_in_plain_lanes, elementary::compiled};
use core::ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// Twice the lanes of `P`: the first ones, and those after them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pair<P>(pub P, pub P);

macro_rules! operators {
    ($($operator:ident $method:ident),*) => {$(
        impl<P: Plain> $operator for Pair<P> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                Self(self.0.$method(other.0), self.1.$method(other.1))
            }
        }
        impl<P: Plain> $operator<f64> for Pair<P> {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: f64) -> Self {
                let other = P::splat(other);
                Self(self.0.$method(other), self.1.$method(other))
            }
        }
    )*};
}
operators!(Add add, Sub sub, Mul mul, Div div);

impl<P: Plain> Neg for Pair<P> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<P: Plain> AddAssign for Pair<P> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

/// The masks of a pair.
#[derive(Debug, Clone, Copy)]
pub struct PairMask<M>(M, M);

impl<M: Mask> BitAnd for PairMask<M> {
    type Output = Self;
    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0, self.1 & other.1)
    }
}

impl<M: Mask> BitOr for PairMask<M> {
    type Output = Self;
    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0, self.1 | other.1)
    }
}

impl<M: Mask> Not for PairMask<M> {
    type Output = Self;
    #[inline(always)]
    fn not(self) -> Self {
        Self(!self.0, !self.1)
    }
}

impl<M: Mask> Mask for PairMask<M> {
    const COUNT: usize = 2 * M::COUNT;
    #[inline(always)]
    fn all_lanes(holds: bool) -> Self {
        Self(M::all_lanes(holds), M::all_lanes(holds))
    }
    #[inline(always)]
    fn any(self) -> bool {
        (self.0 | self.1).any()
    }
    #[inline(always)]
    fn all(self) -> bool {
        (self.0 & self.1).all()
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> bool {
        if lane < M::COUNT {
            self.0.lane(lane)
        } else {
            self.1.lane(lane - M::COUNT)
        }
    }
}

/// The entries for the second group, in the first places.
#[inline(always)]
fn second<P: Plain, T: Copy>(all: &[T; LANES]) -> [T; LANES] {
    core::array::from_fn(|i| all[(i + P::COUNT) % LANES])
}

/// The entries of both groups.
#[inline(always)]
fn joined<P: Plain, T: Copy>(first: [T; LANES], second: [T; LANES]) -> [T; LANES] {
    core::array::from_fn(|i| {
        if i < P::COUNT {
            first[i]
        } else {
            second[i - P::COUNT]
        }
    })
}

impl<P: Plain> Lanes for Pair<P> {
    type One = f64;
    type Real = Self;
    type Mask = PairMask<P::Mask>;
    const COUNT: usize = 2 * P::COUNT;

    alike_in_plain_lanes!(compiled);

    #[inline(always)]
    fn splat(number: f64) -> Self {
        Self(P::splat(number), P::splat(number))
    }
    #[inline(always)]
    fn from_lanes(mut number: impl FnMut(usize) -> f64) -> Self {
        let first = P::from_lanes(&mut number);
        Self(first, P::from_lanes(|lane| number(lane + P::COUNT)))
    }
    #[inline(always)]
    fn lane(self, lane: usize) -> f64 {
        if lane < P::COUNT {
            self.0.lane(lane)
        } else {
            self.1.lane(lane - P::COUNT)
        }
    }
    #[inline(always)]
    fn below(self, limit: Self) -> Self::Mask {
        PairMask(self.0.below(limit.0), self.1.below(limit.1))
    }
    #[inline(always)]
    fn above(self, limit: Self) -> Self::Mask {
        PairMask(self.0.above(limit.0), self.1.above(limit.1))
    }
    #[inline(always)]
    fn is_negligible(self, limit: f64) -> Self::Mask {
        PairMask(self.0.is_negligible(limit), self.1.is_negligible(limit))
    }
    #[inline(always)]
    fn select(condition: Self::Mask, yes: Self, no: Self) -> Self {
        Self(
            P::select(condition.0, yes.0, no.0),
            P::select(condition.1, yes.1, no.1),
        )
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        Self(self.0.sqrt(), self.1.sqrt())
    }
    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }
}

impl<P: Plain> Plain for Pair<P> {
    #[inline(always)]
    fn load(values: &[f64; LANES]) -> Self {
        Self(P::load(values), P::load(&second::<P, _>(values)))
    }
    #[inline(always)]
    fn store(self) -> [f64; LANES] {
        joined::<P, _>(self.0.store(), self.1.store())
    }
    #[inline(always)]
    fn with_sign_of(self, sign: Self) -> Self {
        Self(self.0.with_sign_of(sign.0), self.1.with_sign_of(sign.1))
    }
    #[inline(always)]
    fn exp2(self) -> Self {
        Self(self.0.exp2(), self.1.exp2())
    }
    #[inline(always)]
    fn split(self) -> (Self, Self) {
        let (first, second) = (self.0.split(), self.1.split());
        (Self(first.0, second.0), Self(first.1, second.1))
    }
    #[inline(always)]
    fn to_index(self) -> [usize; LANES] {
        joined::<P, _>(self.0.to_index(), self.1.to_index())
    }
    #[inline(always)]
    fn rows(table: &[[f64; 4]], index: &[usize; LANES]) -> [Self; 4] {
        let first = P::rows(table, index);
        let second = P::rows(table, &second::<P, _>(index));
        core::array::from_fn(|column| Self(first[column], second[column]))
    }
}
