//! The number type of the physics: a plain double or, where derivatives are wanted, a dual number.
//!
//! The elementary functions of `f64` come from the `libm` crate: those of the standard library
//! differ in their last bits between platforms, and the same FMU must give the same bits on all.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number with the arithmetic and functions that the physics uses. Angles are radians.
pub trait Scalar:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// A constant.
    fn constant(value: f64) -> Self;
    /// The value without derivatives.
    fn value(self) -> f64;
    fn sin(self) -> Self;
    fn cos(self) -> Self;
    fn acos(self) -> Self;
    fn exp(self) -> Self;
    fn ln(self) -> Self;
    fn sqrt(self) -> Self;

    fn abs(self) -> Self {
        if self.value() < 0.0 { -self } else { self }
    }
    /// `self` or the constant `floor`, whichever is larger.
    fn at_least(self, floor: f64) -> Self {
        if self.value() < floor {
            Self::constant(floor)
        } else {
            self
        }
    }
    /// `self` or the constant `ceiling`, whichever is smaller.
    fn at_most(self, ceiling: f64) -> Self {
        if self.value() > ceiling {
            Self::constant(ceiling)
        } else {
            self
        }
    }
}

impl Scalar for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
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
}
