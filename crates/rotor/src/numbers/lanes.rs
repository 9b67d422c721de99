//! What numbers side by side can do.

use super::Scalar;
use core::{
    fmt::Debug,
    ops::{Add, AddAssign, BitAnd, BitOr, Div, Mul, Neg, Not, Sub},
};

/// Number of lanes of a block.
pub const LANES: usize = 4;

/// Which lanes a condition holds in.
pub trait Mask:
    Copy + Debug + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self>
{
    /// Number of lanes, 1 to `LANES`.
    const COUNT: usize;
    /// The same in all lanes.
    fn all_lanes(holds: bool) -> Self;
    /// Whether it holds in any lane.
    fn any(self) -> bool;
    /// Whether it holds in all lanes.
    fn all(self) -> bool;
    /// Whether it holds in a lane.
    fn lane(self, lane: usize) -> bool;
}

/// One number or several side by side, plain or dual. Angles are in rad.
///
/// Outside its domain a mathematical function gives NaN in that lane and does not panic. `lane`
/// needs an index below `COUNT`.
pub trait Lanes:
    Copy
    + Debug
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + AddAssign
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The number in one lane.
    type One: Scalar;
    /// The values without derivatives.
    type Real: Plain<Mask = Self::Mask>;
    /// Which lanes a condition holds in.
    type Mask: Mask;
    /// Number of lanes, 1 to `LANES`.
    const COUNT: usize;

    /// The same number in all lanes.
    fn splat(number: Self::One) -> Self;
    /// The numbers, for code outside of these lanes.
    fn per_lane(self) -> PerLane<Self::One>;
    /// The numbers in lanes.
    fn in_lanes(numbers: &PerLane<Self::One>) -> Self;
    /// The numbers that a function gives for each lane.
    fn from_lanes(number: impl FnMut(usize) -> Self::One) -> Self;
    /// The number in a lane.
    fn lane(self, lane: usize) -> Self::One;
    /// Constants: their derivatives are 0.
    fn real(values: Self::Real) -> Self;
    /// The values without derivatives.
    fn values(self) -> Self::Real;
    /// Product with constants.
    fn times(self, factor: Self::Real) -> Self;
    /// Sum with constants.
    fn plus_real(self, term: Self::Real) -> Self;
    /// Where it lies below the limits, or at them and is about to fall below.
    fn below(self, limit: Self::Real) -> Self::Mask;
    /// Where it lies above the limits, or at them and is about to rise above.
    fn above(self, limit: Self::Real) -> Self::Mask;
    /// Where its magnitude is at most `limit`, and it does not change.
    fn is_negligible(self, limit: f64) -> Self::Mask;
    /// `yes` where a condition holds, else `no`.
    fn select(condition: Self::Mask, yes: Self, no: Self) -> Self;
    /// Sine and cosine of an angle, rad.
    fn sin_cos(self) -> (Self, Self);
    /// Inverse cosine, 0 to pi rad, of -1 to 1.
    fn acos(self) -> Self;
    /// e to the power of `self`, from -708 to 709. Below it is 0; above, that of 709.
    fn exp(self) -> Self;
    /// Natural logarithm of a positive number.
    fn ln(self) -> Self;
    /// Square root of a number >= 0.
    fn sqrt(self) -> Self;
    /// sqrt(self^2 + other^2) of numbers whose squares neither overflow nor vanish, faster than
    /// [`Scalar::hypot`].
    fn length(self, other: Self) -> Self;
    /// Angle of the point (x, self), -pi to pi rad, counted from the x axis.
    fn atan2(self, x: Self) -> Self;
    /// The roots of an equation, already found at `root`, with their derivatives.
    ///
    /// Dual numbers get the derivative by the implicit function theorem,
    /// dx = -(dR/dp) dp/(dR/dx), at the root and not through the search for it. Where the root lies
    /// at a corner of the residual, the slope is that of the side to which the root moves. The
    /// derivative is NaN where the residual does not change with x.
    fn at_roots(root: Self::Real, equation: &impl Equation<Self>) -> Self;

    /// The same constant in all lanes.
    #[inline(always)]
    fn constant(value: f64) -> Self {
        Self::real(Self::Real::splat(value))
    }
    /// 0 in all lanes.
    #[inline(always)]
    fn nil() -> Self {
        Self::constant(0.0)
    }
    /// 1 in all lanes.
    #[inline(always)]
    fn unit() -> Self {
        Self::constant(1.0)
    }
    /// `below` of one limit.
    #[inline(always)]
    fn is_below(self, limit: f64) -> Self::Mask {
        self.below(Self::Real::splat(limit))
    }
    /// `above` of one limit.
    #[inline(always)]
    fn is_above(self, limit: f64) -> Self::Mask {
        self.above(Self::Real::splat(limit))
    }
    /// Sine of an angle, rad.
    #[inline(always)]
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine of an angle, rad.
    #[inline(always)]
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Magnitude. At 0 its derivative is that of the side to which the number moves.
    #[inline(always)]
    fn abs(self) -> Self {
        Self::select(self.is_below(0.0), -self, self)
    }
    /// `self` or the constant `floor`, the larger of the two.
    #[inline(always)]
    fn at_least(self, floor: f64) -> Self {
        Self::select(self.is_below(floor), Self::constant(floor), self)
    }
    /// `self` or the constant `ceiling`, the smaller of the two.
    #[inline(always)]
    fn at_most(self, ceiling: f64) -> Self {
        Self::select(self.is_above(ceiling), Self::constant(ceiling), self)
    }
    /// A function of one number in each lane: for what is needed too seldom to be worth lanes.
    #[inline(always)]
    fn each(self, mut function: impl FnMut(Self::One) -> Self::One) -> Self {
        Self::from_lanes(|lane| function(self.lane(lane)))
    }
    /// Sum of the lanes in a fixed order: of four, (1 + 2) + (3 + 4).
    #[inline(always)]
    fn sum_of_lanes(self) -> Self::One {
        const { assert!(Self::COUNT == 1 || Self::COUNT == LANES) };
        if Self::COUNT == 1 {
            return self.lane(0);
        }
        (self.lane(0) + self.lane(1)) + (self.lane(2) + self.lane(3))
    }
}

/// Plain numbers side by side.
pub trait Plain: Lanes<One = f64, Real = Self> + PartialEq + 'static {
    /// The first numbers of an array.
    fn load(values: &[f64; LANES]) -> Self;
    /// The numbers, in the first places of an array.
    fn store(self) -> [f64; LANES];
    /// The magnitudes with the signs of other numbers.
    fn with_sign_of(self, sign: Self) -> Self;
    /// 2 to the power of integers from -1022 to 1023.
    fn exp2(self) -> Self;
    /// A positive normal number as m 2^k: m from sqrt(1/2) to sqrt(2), and k.
    fn split(self) -> (Self, Self);
    /// The integer part of numbers from 0 to 2^31 - 1, in the first places of an array. Where the
    /// number is NaN or out of this range the place is any number.
    fn to_index(self) -> [usize; LANES];
    /// The columns of rows of a table, by their index. Panics beyond the table.
    fn rows(table: &[[f64; 4]], index: &[usize; LANES]) -> [Self; 4];
}

/// What all kinds of plain lanes have alike: functions of `Lanes` in terms of the others, and of
/// the elementary functions in a module `$compiled`.
macro_rules! alike_in_plain_lanes {
    ($compiled:ident) => {
        #[inline(always)]
        fn real(values: Self) -> Self {
            values
        }
        #[inline(always)]
        fn values(self) -> Self {
            self
        }
        #[inline(always)]
        fn per_lane(self) -> [f64; $crate::numbers::LANES] {
            self.store()
        }
        #[inline(always)]
        fn in_lanes(numbers: &[f64; $crate::numbers::LANES]) -> Self {
            Self::load(numbers)
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
        fn sin_cos(self) -> (Self, Self) {
            $compiled::sin_cos(self)
        }
        #[inline(always)]
        fn acos(self) -> Self {
            $compiled::acos(self)
        }
        #[inline(always)]
        fn exp(self) -> Self {
            $compiled::exp(self)
        }
        #[inline(always)]
        fn ln(self) -> Self {
            $compiled::ln(self)
        }
        #[inline(always)]
        fn length(self, other: Self) -> Self {
            Lanes::sqrt(self * self + other * other)
        }
        #[inline(always)]
        fn atan2(self, x: Self) -> Self {
            $compiled::atan2(self, x)
        }
        #[inline(always)]
        fn at_roots(root: Self, _equation: &impl $crate::numbers::Equation<Self>) -> Self {
            root
        }
    };
}
pub(super) use alike_in_plain_lanes;

/// An equation in one unknown, in every lane: its residual.
pub trait Equation<L> {
    /// The residual.
    fn residual(&self, unknown: L) -> L;
}

/// Numbers, one for each lane: how they are handed to code outside of the lanes.
pub type PerLane<S> = <S as Scalar>::PerLane;

/// The same numbers in other lanes.
#[inline(always)]
pub fn converted<L: Lanes, M: Lanes<One = L::One>>(numbers: L) -> M {
    M::in_lanes(&numbers.per_lane())
}
