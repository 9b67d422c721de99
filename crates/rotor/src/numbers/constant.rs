//! Constants in formulas.

use super::Lanes;
use std::ops::{Add, Div, Mul, Sub};

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
/// use rotor::numbers::{C, Lanes};
///
/// /// Hermite's weight of the far end, 0 to 1: s(t) = t^2 (3 - 2 t).
/// fn weight<S: Lanes>(t: S) -> S {
///     t * t * (C(3.0) - C(2.0) * t)
/// }
/// assert_eq!(weight(0.5), 0.5);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct C(pub f64);

impl<S: Lanes> Add<S> for C {
    type Output = S;
    #[inline(always)]
    fn add(self, other: S) -> S {
        other + self.0
    }
}

impl<S: Lanes> Sub<S> for C {
    type Output = S;
    #[inline(always)]
    fn sub(self, other: S) -> S {
        S::constant(self.0) - other
    }
}

impl<S: Lanes> Mul<S> for C {
    type Output = S;
    #[inline(always)]
    fn mul(self, other: S) -> S {
        other * self.0
    }
}

impl<S: Lanes> Div<S> for C {
    type Output = S;
    #[inline(always)]
    fn div(self, other: S) -> S {
        S::constant(self.0) / other
    }
}
