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
    numbers::{C, Equation, Lanes, Mask, Plain},
    root::{End, RootError, bracketed},
};

/// Tolerance of the induced velocity, as a part of the largest speed in the problem.
const TOLERANCE: f64 = 1e-13;

/// The induced velocity is found where its last change is at most this part of the largest speed in
/// the problem: what is left is that times the relative error of the chord's slope.
const LAST_STEP: f64 = 1e-9;

/// Bound on the chords that stand for the thrust; a few are usual.
const MAX_CHORDS: u32 = 8;

/// Bound on the secants of the momentum equation, and the relative change that is rounding.
const MAX_SECANTS: u32 = 30;
const SECANT_ROUNDING: f64 = 1e-14;

/// Bound on the doublings of the bracket; no finite speed needs more.
const MAX_DOUBLINGS: u32 = 60;

/// The mean induced velocity v0, positive down, m/s, of a disc or of an annulus in each lane.
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
pub fn mean_velocity<L: Lanes>(
    mass_flow: impl Fn(L) -> L,
    climb: L,
    scale: L::Real,
    thrust_per_density_area: impl Fn(L) -> L,
) -> Result<L, RootError> {
    let balance = Balance(|v: L| C(2.0) * v * mass_flow(v) - thrust_per_density_area(v));
    let mass_flow = |v: L::Real| mass_flow(L::real(v)).values();
    let thrust = |v: L::Real| thrust_per_density_area(L::real(v)).values();
    let found = match by_linear_thrust(mass_flow, thrust, climb.values(), scale) {
        Some(found) => found,
        None => root(
            |v| balance.residual(L::real(v)).values(),
            climb.values(),
            scale,
        )?,
    };
    Ok(L::at_roots(found, &balance))
}

/// v0 in hover and climb, from a chord through the last two values of the thrust, which is
/// expensive and nearly linear in v0. None in descent, where a chord does not fall, or without
/// convergence; the bracket then decides. Where stalled blades give several balances, it may find
/// another one than the bracket.
fn by_linear_thrust<V: Plain>(
    mass_flow: impl Fn(V) -> V,
    thrust: impl Fn(V) -> V,
    climb: V,
    scale: V,
) -> Option<V> {
    let mut last = (V::nil(), thrust(V::nil()));
    let is_simple = !(last.1 * climb).is_below(0.0) & last.1.abs().is_above(0.0);
    if !is_simple.all() {
        return None;
    }
    // First guess: the inflow takes away about half of the thrust at v0 = 0.
    let start = (last.1.abs() * 0.5).sqrt().with_sign_of(last.1);
    let mut at = by_secants(|v| v * 2.0 * mass_flow(v) - last.1 * 0.5, start)?;
    let first_thrust = last.1;
    let mut is_found = V::Mask::all_lanes(false);
    for _ in 0..MAX_CHORDS {
        let here = thrust(at);
        let slope = (here - last.1) / (at - last.0);
        if !(is_found | slope.is_below(0.0)).all() {
            return None;
        }
        // What is found stays.
        let slope = V::select(is_found, V::splat(-1.0), slope);
        let chord = |v: V| here + slope * (v - at);
        let next = by_secants(|v| v * 2.0 * mass_flow(v) - chord(v), at)?;
        let next = V::select(is_found, at, next);
        is_found = is_found | !(next - at).abs().above(scale * LAST_STEP);
        (last, at) = ((at, here), next);
        if is_found.all() {
            let has_sign = (at * first_thrust).is_above(0.0);
            return has_sign.all().then_some(at);
        }
    }
    None
}

/// The root of a function near `start` by the secant method, in every lane; none if it does not
/// converge.
fn by_secants<V: Plain>(function: impl Fn(V) -> V, start: V) -> Option<V> {
    let mut last = (start * 1.1, function(start * 1.1));
    let mut at = start;
    let mut is_found = !(start.abs().is_above(0.0));
    for _ in 0..MAX_SECANTS {
        let here = function(at);
        let step = here * (at - last.0) / (here - last.1);
        let is_exact = here.is_negligible(0.0);
        is_found = is_found | is_exact;
        last = (
            V::select(is_found, last.0, at),
            V::select(is_found, last.1, here),
        );
        at = V::select(is_found, at, at - step);
        is_found = is_found | !step.abs().above(at.abs() * SECANT_ROUNDING);
        if is_found.all() {
            return at.is_negligible(f64::MAX).all().then_some(at);
        }
    }
    None
}

/// The balance of momentum and thrust.
struct Balance<F>(F);

impl<L, F: Fn(L) -> L> Equation<L> for Balance<F> {
    fn residual(&self, induced: L) -> L {
        (self.0)(induced)
    }
}

/// The v0 that solves `equation` at a climb, both in m/s.
fn root<V: Plain>(equation: impl Fn(V) -> V, climb: V, scale: V) -> Result<V, RootError> {
    let end = |at: V| End {
        at,
        residual: equation(at),
    };
    let start = end(V::nil());
    let is_nothing = start.residual.is_negligible(0.0); // no thrust, nothing induced
    if is_nothing.all() {
        return Ok(V::nil());
    }
    let side = V::select(start.residual.is_below(0.0), V::splat(1.0), V::splat(-1.0));
    let reached = |end: End<V>| !(end.residual * side).is_below(0.0);
    let (mut from, mut to) = (start, start);
    let mut is_closed = is_nothing;
    let is_descent = (side * climb).is_below(0.0) & !is_nothing;
    if is_descent.any() {
        let windmill = end(climb * -0.5);
        let is_windmill = is_descent & reached(windmill);
        to = End::select(is_windmill, windmill, to);
        is_closed = is_closed | is_windmill;
        from = End::select(is_descent & !is_windmill, windmill, from);
    }
    let mut step = scale * 0.1 * side;
    for _ in 0..MAX_DOUBLINGS {
        if is_closed.all() {
            return bracketed(equation, from, to, scale * TOLERANCE);
        }
        let next = end(from.at + step);
        if !(is_closed | next.residual.is_negligible(f64::MAX)).all() {
            return Err(RootError::NotFinite);
        }
        let closes = reached(next) & !is_closed;
        to = End::select(closes, next, to);
        is_closed = is_closed | closes;
        from = End::select(is_closed, from, next);
        step = step * 2.0;
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
