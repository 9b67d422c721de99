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

/// A dual number for the tests: a value and its derivative by one variable.
#[cfg(test)]
pub mod dual {
    use super::Scalar;
    use std::ops::{Add, Div, Mul, Neg, Sub};

    #[derive(Debug, Clone, Copy)]
    pub struct Dual {
        pub value: f64,
        pub slope: f64,
    }

    impl Dual {
        /// The variable itself.
        pub fn variable(value: f64) -> Self {
            Self { value, slope: 1.0 }
        }

        fn chain(self, value: f64, slope: f64) -> Self {
            Self {
                value,
                slope: slope * self.slope,
            }
        }
    }

    impl Neg for Dual {
        type Output = Self;
        fn neg(self) -> Self {
            self.chain(-self.value, -1.0)
        }
    }
    impl Add for Dual {
        type Output = Self;
        fn add(self, o: Self) -> Self {
            Self {
                value: self.value + o.value,
                slope: self.slope + o.slope,
            }
        }
    }
    impl Sub for Dual {
        type Output = Self;
        fn sub(self, o: Self) -> Self {
            self + -o
        }
    }
    impl Mul for Dual {
        type Output = Self;
        fn mul(self, o: Self) -> Self {
            let slope = self.slope * o.value + self.value * o.slope;
            Self {
                value: self.value * o.value,
                slope,
            }
        }
    }
    impl Div for Dual {
        type Output = Self;
        fn div(self, o: Self) -> Self {
            self * o.chain(1.0 / o.value, -1.0 / (o.value * o.value))
        }
    }
    impl Add<f64> for Dual {
        type Output = Self;
        fn add(self, o: f64) -> Self {
            self.chain(self.value + o, 1.0)
        }
    }
    impl Sub<f64> for Dual {
        type Output = Self;
        fn sub(self, o: f64) -> Self {
            self.chain(self.value - o, 1.0)
        }
    }
    impl Mul<f64> for Dual {
        type Output = Self;
        fn mul(self, o: f64) -> Self {
            self.chain(self.value * o, o)
        }
    }
    impl Div<f64> for Dual {
        type Output = Self;
        fn div(self, o: f64) -> Self {
            self.chain(self.value / o, 1.0 / o)
        }
    }

    impl Scalar for Dual {
        fn constant(value: f64) -> Self {
            Self { value, slope: 0.0 }
        }
        fn value(self) -> f64 {
            self.value
        }
        fn sin(self) -> Self {
            self.chain(libm::sin(self.value), libm::cos(self.value))
        }
        fn cos(self) -> Self {
            self.chain(libm::cos(self.value), -libm::sin(self.value))
        }
        fn acos(self) -> Self {
            let slope = -1.0 / libm::sqrt(1.0 - self.value * self.value);
            self.chain(libm::acos(self.value), slope)
        }
        fn exp(self) -> Self {
            let value = libm::exp(self.value);
            self.chain(value, value)
        }
        fn ln(self) -> Self {
            self.chain(libm::log(self.value), 1.0 / self.value)
        }
        fn sqrt(self) -> Self {
            let value = libm::sqrt(self.value);
            self.chain(value, 0.5 / value)
        }
    }
}
