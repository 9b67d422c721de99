//! The phi functions of exponential integrators, of a matrix M of two rows (Hochbruck & Ostermann
//! 2010, Acta Numerica 19, p. 209, eq. 2.10):
//!
//! ```text
//! phi_1(M) = integral from 0 to 1 of e^((1 - s) M) ds
//! phi_2(M) = integral from 0 to 1 of e^((1 - s) M) s ds
//! ```
//!
//! They are 1 and 1/2 where M vanishes.

use nalgebra::Matrix2;

/// phi_1 and phi_2 of a matrix.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Phi {
    /// phi_1.
    pub first: Matrix2<f64>,
    /// phi_2.
    pub second: Matrix2<f64>,
}

/// Norm up to which the power series is used.
const SMALL: f64 = 0.5;
/// Terms of the series, which leave out less than one part in 1e17.
const TERMS: u32 = 14;
/// Bound on the doublings: beyond it the numbers are not finite.
const MAX_DOUBLINGS: u32 = 1100;

/// phi_1 and phi_2 of `matrix`: the power series for a part of it, doubled until the matrix is
/// whole again. With z doubled, phi_1 and phi_2 become (e^z + 1) phi_1/2 and (e^z phi_2 + phi_1 +
/// phi_2)/4. NaN if the matrix is not finite.
pub fn phi(matrix: &Matrix2<f64>) -> Phi {
    let norm = matrix.norm();
    if !norm.is_finite() {
        let none = Matrix2::from_element(f64::NAN);
        return Phi {
            first: none,
            second: none,
        };
    }
    let mut doublings = 0;
    let mut part = 1.0;
    while norm * part > SMALL && doublings < MAX_DOUBLINGS {
        part *= 0.5;
        doublings += 1;
    }
    let small = matrix * part;
    // Horner's scheme: phi_2 = sum of M^k/(k + 2)!, phi_1 = 1 + M phi_2, e^M = 1 + M phi_1.
    let one = Matrix2::identity();
    let mut second = Matrix2::zeros();
    for k in (0..TERMS).rev() {
        second = small * second / f64::from(k + 3) + one;
    }
    second *= 0.5;
    let mut first = one + small * second;
    let mut exponential = one + small * first;
    for _ in 0..doublings {
        second = (exponential * second + first + second) * 0.25;
        first = (exponential * first + first) * 0.5;
        exponential *= exponential;
    }
    Phi { first, second }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a diagonal matrix: the functions of its numbers, (e^z - 1)/z and (e^z - 1 - z)/z^2.
    #[test]
    fn of_numbers_they_are_quotients_of_the_exponential() {
        for z in [-1e6, -30.0, -1.0, -0.3, 0.4, 2.0] {
            let Phi { first, second } = phi(&Matrix2::new(z, 0.0, 0.0, 0.0));
            let expected = libm::expm1(z) / z;
            assert!((first[(0, 0)] / expected - 1.0).abs() < 1e-13, "{z}");
            let expected = (libm::expm1(z) - z) / (z * z);
            assert!((second[(0, 0)] / expected - 1.0).abs() < 1e-12, "{z}");
            assert_eq!((first[(1, 1)], second[(1, 1)]), (1.0, 0.5));
        }
    }

    /// Of an undamped oscillation: phi_1 has sin(x)/x, and phi_2 has (1 - cos(x))/x^2.
    #[test]
    fn of_an_oscillation_they_have_its_sine_and_cosine() {
        for x in [1e-9, 0.1, 1.0, 3.0, 40.0, 1e4] {
            let Phi { first, second } = phi(&Matrix2::new(0.0, x, -x, 0.0));
            assert!((first[(0, 0)] - libm::sin(x) / x).abs() < 1e-12, "{x}");
            let half = libm::sin(0.5 * x) / x;
            assert!((first[(0, 1)] - 2.0 * half * half * x).abs() < 1e-12, "{x}");
            assert!((second[(0, 0)] - 2.0 * half * half).abs() < 1e-12, "{x}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_none() {
        let Phi { first, .. } = phi(&Matrix2::new(f64::INFINITY, 0.0, 0.0, 0.0));
        assert!(first[(0, 0)].is_nan());
    }
}
