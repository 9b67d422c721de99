//! Glauert's momentum theory for the disc as a whole (Glauert 1926, ARC R&M 1111; thesis eq. 100):
//! the thrust is the flux of momentum through the disc,
//!
//! ```text
//! T = 2 rho A v0 V',   V' = sqrt(V_x^2 + (V_c + v0)^2) or that of the descent model,
//! ```
//!
//! and T is also the thrust of the blades in that inflow. So there is one bracketed unknown, the
//! mean induced velocity v0. In this form nothing divides by the inflow: hover, edgewise flight and
//! a disc at rest are no special cases.
//!
//! Descent. Where the thrust points against the flow through the disc, momentum theory has up to
//! three roots. As in the annulus, the windmill state (air passes upwards) is taken where it
//! exists: where the larger side of the equation becomes the smaller one before v0 = -V_c/2. Else
//! the root beyond -V_c/2 is taken.

use crate::{
    root::{End, RootError, bracketed},
    scalar::{C, Scalar},
};

/// Tolerance of the induced velocity, as a part of the largest speed in the problem.
const TOLERANCE: f64 = 1e-13;

/// Bound on the doublings of the bracket; no finite speed needs more.
const MAX_DOUBLINGS: u32 = 60;

/// The mean induced velocity v0, positive down, m/s.
///
/// * `mass_flow`: the speed V' of the air that takes up momentum, as a function of v0, m/s
/// * `climb`: flow down through the disc without v0, any sign, m/s
/// * `scale`: a speed > 0 of the order of the largest in the problem, m/s
/// * `thrust_per_density_area`: T/(rho A) of the blades as a function of v0, m2/s2
///
/// # Errors
///
/// Where one of the functions is not finite, or where the two sides do not balance at any v0 within
/// reach of finite speeds.
pub fn mean_velocity<S: Scalar>(
    mass_flow: impl Fn(S) -> S,
    climb: S,
    scale: f64,
    thrust_per_density_area: impl Fn(S) -> S,
) -> Result<S, RootError> {
    let equation = |v: S| C(2.0) * v * mass_flow(v) - thrust_per_density_area(v);
    let found = root(|v| equation(S::constant(v)).value(), climb.value(), scale)?;
    Ok(S::at_root(found, equation))
}

/// The v0 that solves `equation` at a climb, both in m/s.
fn root(equation: impl Fn(f64) -> f64, climb: f64, scale: f64) -> Result<f64, RootError> {
    let end = |at: f64| End {
        at,
        residual: equation(at),
    };
    let start = end(0.0);
    if start.residual == 0.0 {
        return Ok(0.0); // no thrust, nothing induced
    }
    let side = if start.residual < 0.0 { 1.0 } else { -1.0 };
    let mut from = start;
    if side * climb < 0.0 {
        let windmill = end(-0.5 * climb);
        if windmill.residual * side >= 0.0 {
            return bracketed(equation, start, windmill, TOLERANCE * scale);
        }
        from = windmill;
    }
    let mut step = 0.1 * side * scale;
    for _ in 0..MAX_DOUBLINGS {
        let to = end(from.at + step);
        if !to.residual.is_finite() {
            return Err(RootError::NotFinite);
        }
        if to.residual * side >= 0.0 {
            return bracketed(equation, from, to, TOLERANCE * scale);
        }
        from = to;
        step *= 2.0;
    }
    Err(RootError::NoSignChange)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Momentum theory at a given thrust, in units of the hover induced velocity: T/(rho A) = 2.
    fn at_unit_hover(mu: f64, climb: f64) -> f64 {
        mean_velocity(|v| libm::hypot(mu, climb + v), climb, 1.0, |_| 2.0).unwrap()
    }

    #[test]
    fn hover_gives_the_square_root_of_half_the_thrust_coefficient() {
        for ct in [1e-5, 0.005, 0.02] {
            let lambda = mean_velocity(|v: f64| v.abs(), 0.0, 1.0, |_| ct).unwrap();
            assert!((lambda - libm::sqrt(ct / 2.0)).abs() < 2e-13);
            let down = mean_velocity(|v: f64| v.abs(), 0.0, 1.0, |_| -ct).unwrap();
            assert!(
                (down + lambda).abs() < 2e-13,
                "negative thrust induces upwards"
            );
        }
    }

    #[test]
    fn glauerts_equation_is_satisfied_for_all_advance_and_climb() {
        // mu to 0.5 of the tip speed and lambda_c to 3 lambda_h, at CT = 0.005.
        let hover = libm::sqrt(0.0025);
        for i in 0..=20 {
            for j in -30..=30 {
                let (mu, climb) = (0.025 * f64::from(i), 0.1 * f64::from(j) * hover);
                let v =
                    mean_velocity(|v| libm::hypot(mu, climb + v), climb, 1.0, |_| 0.005).unwrap();
                let left = 2.0 * v * libm::hypot(mu, climb + v);
                assert!(
                    (left - 0.005).abs() < 1e-12,
                    "mu {mu}, climb {climb}: {left}"
                );
                assert!(v > 0.0);
            }
        }
    }

    #[test]
    fn climb_and_windmill_follow_the_known_roots() {
        // Leishman 2006, eqs. (2.51) and (2.67).
        let climb = 1.5;
        let up = -climb / 2.0 + libm::sqrt(climb * climb / 4.0 + 1.0);
        assert!((at_unit_hover(0.0, climb) - up).abs() < 1e-12);
        let descent: f64 = -2.5;
        let windmill = -descent / 2.0 - libm::sqrt(descent * descent / 4.0 - 1.0);
        assert!((at_unit_hover(0.0, descent) - windmill).abs() < 1e-12);
    }
}
