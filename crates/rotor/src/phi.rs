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
/// phi_1 and phi_2 of `matrix`: the power series for a part of it, doubled until the matrix is
/// whole again. With z doubled, phi_1 and phi_2 become (e^z + 1) phi_1/2 and (e^z phi_2 + phi_1 +
/// phi_2)/4. NaN if the matrix is not finite.
///
/// The matrix is balanced first: with a unit of the second quantity in which the two numbers beside
/// the diagonal have the same size, the norm is that of the motion, and few doublings are needed.
pub fn phi(matrix: &Matrix2<f64>) -> Phi {
    let unit = libm::sqrt((matrix[(1, 0)] / matrix[(0, 1)]).abs());
    if !(unit.is_finite() && unit > 0.0) {
        return of_balanced(matrix);
    }
    let change = |m: &Matrix2<f64>, unit: f64| {
        Matrix2::new(m[(0, 0)], m[(0, 1)] * unit, m[(1, 0)] / unit, m[(1, 1)])
    };
    let phi = of_balanced(&change(matrix, unit));
    Phi {
        first: change(&phi.first, 1.0 / unit),
        second: change(&phi.second, 1.0 / unit),
    }
}

fn of_balanced(matrix: &Matrix2<f64>) -> Phi {
    let norm = matrix.norm();
    if !norm.is_finite() {
        let none = Matrix2::from_element(f64::NAN);
        return Phi {
            first: none,
            second: none,
        };
    }
    // At most 1026 times, as the norm is finite.
    let mut doublings = 0;
    let mut part = 1.0;
    while norm * part > SMALL {
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

    /// Of a blade: damped oscillations whose eigenvalues, x (-z +- i sqrt(1 - z^2)), give the
    /// functions in complex numbers. phi_1 of the lower left number is sin(b)/b e^a c, and so on.
    #[test]
    fn of_a_damped_blade_they_satisfy_their_equations() {
        for (frequency, damping) in [
            (10.0, 0.1),
            (50.0, 0.5),
            (5e3, 0.01),
            (5e4, 0.9),
            (300.0, 3.0),
        ] {
            let h = 1e-3;
            let (x, c) = (frequency * h, 2.0 * damping * frequency * h);
            let m = Matrix2::new(0.0, h, -x * frequency, -c);
            let Phi { first, second } = phi(&m);
            // e^M = 1 + M phi_1 in closed form.
            let half = 0.5 * c;
            let root = x * x - half * half;
            let (cos, sinc) = if root > 0.0 {
                let b = libm::sqrt(root);
                (libm::cos(b), libm::sin(b) / b)
            } else {
                let b = libm::sqrt(-root);
                (libm::cosh(b), libm::sinh(b) / b)
            };
            let decay = libm::exp(-half);
            let corner = decay * (cos + half * sinc);
            let exponential = Matrix2::identity() + m * first;
            assert!((exponential[(0, 0)] - corner).abs() < 1e-9, "{frequency}");
            let lower = -x * frequency * sinc * decay;
            let off = (exponential[(1, 0)] - lower).abs() / frequency;
            assert!(off < 1e-9, "{frequency}: {off:e}");
            // phi_1 = 1 + M phi_2.
            let rest = Matrix2::identity() + m * second - first;
            assert!(rest[(0, 0)].abs() < 1e-9, "{frequency}: {rest}");
        }
    }

    #[test]
    fn a_matrix_that_is_not_finite_has_none() {
        let Phi { first, .. } = phi(&Matrix2::new(f64::INFINITY, 0.0, 0.0, 0.0));
        assert!(first[(0, 0)].is_nan());
    }
}
