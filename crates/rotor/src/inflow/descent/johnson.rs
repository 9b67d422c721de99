//! Johnson's model of the mean inflow in the vortex ring state: Johnson 2005, "Model for Vortex Ring State
//! Influence on Rotorcraft Flight Dynamics", NASA/TP-2005-213477, pp. 14, 23 and 24.
//!
//! In units of v_h, with V_z the climb and V_x the flow along the disc. The baseline is momentum theory with
//! its two branches joined by a cubic between the points A and B (v = b V_z + c V_z^2 + d V_z^3: v and slope
//! at A, v at B). To V_z + v comes a piecewise cubic, from nothing at D to given values at N and X,
//! where V_z + v has no slope, the boundaries of instability in climb, and back to nothing at E. The points move
//! with V_x and meet at V_xM, beyond which there is no vortex ring.
//!
//! Ours: the slopes at N and X fade with V_x as the values do, so that nothing jumps at V_xM.
//!
//! (The report was not at hand; its numbers are those in the open-source implementation of TU
//! Braunschweig, which cites the pages.)

use crate::{
    root::{End, RootError, bracketed},
    scalar::Scalar,
};

/// Baseline, p. 24.
const A: f64 = -1.5;
const B: f64 = -2.1;
const V_XC: f64 = 0.75;
/// Vortex ring, p. 24.
const D: f64 = -0.2;
const N: f64 = -0.45;
const THROUGH_N: f64 = 0.85;
const X: f64 = -1.5;
const THROUGH_X: f64 = 1.25;
const E: f64 = -2.0;
const V_XM: f64 = 0.95;

/// Bound on Newton's steps, of which it takes about six; then a bracket takes over.
const MAX_NEWTON_STEPS: u32 = 30;

/// The boundary of instability at a V_x, all V_z in units of v_h.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary<S = f64> {
    pub upper: S,
    pub lower: S,
    /// Where the model has gone over to the windmill.
    pub end: S,
}

impl<S: Scalar> Boundary<S> {
    /// None beyond V_xM.
    pub fn at(edgewise: S) -> Option<Self> {
        if edgewise.value().is_nan() || edgewise.value() >= V_XM {
            return None;
        }
        let share = edgewise / V_XM;
        let part = S::one() - share * share;
        let (middle, half) = (0.5 * (N + X), 0.5 * (N - X));
        let upper = part.power(0.2) * half + middle;
        let lower = S::constant(middle) - part.power(1.5) * half;
        Some(Self {
            upper,
            lower,
            end: (lower - X) + E,
        })
    }
}

/// V' at V_x (>= 0), V_c (<= 0) and v (>= 0), m/s: v_h^2/v, v_h such that the model gives v.
pub fn speed<S: Scalar>(edgewise: S, climb: S, induced: S) -> S {
    if induced.value() == 0.0 {
        return edgewise.hypot(climb);
    }
    let surplus = |hover: S| hover * ratio(edgewise / hover, climb / hover) - induced;
    match hover_velocity(
        |hover| surplus(S::constant(hover)).value(),
        libm::hypot(edgewise.value(), climb.value()),
        induced.value(),
    ) {
        Ok(hover) => {
            let hover = S::at_root(hover, surplus);
            hover * hover / induced
        }
        // Not seen; the rotor's solution then fails with an error.
        Err(_) => S::constant(f64::NAN),
    }
}

/// The v_h at which nothing is left of `surplus`; `flow` and `induced`, m/s.
fn hover_velocity(surplus: impl Fn(f64) -> f64, flow: f64, induced: f64) -> Result<f64, RootError> {
    let end = |at: f64| End {
        at,
        residual: surplus(at),
    };
    // Fast flow past a hardly loaded rotor induces little; a loaded one in slow flow induces its v_h.
    let scale = flow + induced;
    let (mut low, mut high) = (end(1e-3 * libm::sqrt(induced * scale)), end(induced));
    for _ in 0..60 {
        if low.residual <= 0.0 {
            break;
        }
        low = end(0.5 * low.at);
    }
    for _ in 0..60 {
        if high.residual >= 0.0 {
            break;
        }
        high = end(2.0 * high.at);
    }
    bracketed(surplus, low, high, 1e-13 * scale)
}

/// v in units of v_h.
fn ratio<S: Scalar>(edgewise: S, climb: S) -> S {
    if climb.value() >= 0.0 {
        return helicopter(edgewise, climb);
    }
    let base = baseline(edgewise, climb);
    let Some(boundary) = Boundary::at(edgewise) else {
        return base;
    };
    let Boundary { upper, lower, end } = boundary;
    if !(end.value() < climb.value() && climb.value() < D) {
        return base;
    }
    let share = edgewise / V_XM;
    let fade = (S::one() - share.power(6.0)).sqrt();
    let at = |v_z: S, through: f64, own: f64| Knot {
        at: v_z,
        value: fade * (through - (own + helicopter(0.0, own))),
        // The boundary lies above A, where the baseline is momentum theory.
        slope: -fade * (helicopter_slope(edgewise, v_z) + 1.0),
    };
    let n = at(upper, THROUGH_N, N);
    let x = at(lower, THROUGH_X, X);
    let nothing = Knot {
        at: S::constant(D),
        value: S::zero(),
        slope: S::zero(),
    };
    let more = if climb.value() >= upper.value() {
        hermite(&n, &nothing, climb)
    } else if climb.value() >= lower.value() {
        hermite(&x, &n, climb)
    } else {
        through_origin(&x, end, S::zero(), climb)
    };
    base + more
}

/// Momentum theory with its branches joined.
fn baseline<S: Scalar>(edgewise: S, climb: S) -> S {
    if climb.value() >= 0.0 || edgewise.value() >= V_XC {
        return helicopter(edgewise, climb);
    }
    let part = edgewise / V_XC;
    let a = part * 0.2 * part + A;
    let mut b = part * 0.2 * part + B;
    if part.value() > 0.5 {
        let beyond = part * 2.0 - 1.0;
        b += (a - b) * 0.7 * beyond * beyond * beyond;
    }
    if climb.value() > a.value() {
        helicopter(edgewise, climb)
    } else if climb.value() < b.value() {
        windmill(edgewise, climb)
    } else {
        let knot = Knot {
            at: a,
            value: helicopter(edgewise, a),
            slope: helicopter_slope(edgewise, a),
        };
        through_origin(&knot, b, windmill(edgewise, b), climb)
    }
}

/// The root of v sqrt(V_x^2 + (V_z + v)^2) = 1 that continues hover, the largest: by Newton's method from
/// above, where the left side rises ever faster.
fn helicopter<S: Scalar>(edgewise: S, climb: S) -> S {
    if edgewise.value() == 0.0 {
        return climb * -0.5 + (climb * 0.25 * climb + 1.0).sqrt();
    }
    let (v_x, v_z) = (edgewise.value(), climb.value());
    let mut v = 1.0 + v_z.abs();
    for _ in 0..MAX_NEWTON_STEPS {
        let through = v_z + v;
        let flow = libm::sqrt(v_x * v_x + through * through);
        let step = (v * flow - 1.0) / (flow + v * through / flow);
        v -= step;
        if step.abs() <= 1e-14 * v.abs() {
            return S::at_root(v, |v| momentum_surplus(edgewise, climb, v));
        }
    }
    momentum(edgewise, climb, 0.0_f64.max(-v_z), 1.0 + v_z.abs())
}

/// dv/dV_z of that root.
fn helicopter_slope<S: Scalar>(edgewise: S, climb: S) -> S {
    let v = helicopter(edgewise, climb);
    let through = climb + v;
    -v * through / (edgewise * edgewise + through * through + v * through)
}

/// The root that continues fast descent; that of hover where there is none.
fn windmill<S: Scalar>(edgewise: S, climb: S) -> S {
    let middle = -0.5 * climb.value();
    if middle * libm::hypot(edgewise.value(), middle) < 1.0 {
        return helicopter(edgewise, climb);
    }
    momentum(edgewise, climb, 0.0, middle)
}

/// v V' - 1.
fn momentum_surplus<S: Scalar>(edgewise: S, climb: S, v: S) -> S {
    v * edgewise.hypot(climb + v) - 1.0
}

/// A root between two velocities. Where the one that continues hover lies below the first, from 0.
fn momentum<S: Scalar>(edgewise: S, climb: S, from: f64, to: f64) -> S {
    let surplus = |v: f64| momentum_surplus(edgewise.value(), climb.value(), v);
    let end = |at: f64| End {
        at,
        residual: surplus(at),
    };
    let mut low = end(from);
    if low.residual > 0.0 {
        low = end(0.0);
    }
    let found = bracketed(surplus, low, end(to), 1e-13).unwrap_or(f64::NAN);
    S::at_root(found, |v| momentum_surplus(edgewise, climb, v))
}

struct Knot<S> {
    at: S,
    value: S,
    slope: S,
}

/// The cubic with the values and slopes of two knots, a below b.
fn hermite<S: Scalar>(a: &Knot<S>, b: &Knot<S>, at: S) -> S {
    let width = b.at - a.at;
    if width.value() <= 0.0 {
        return a.value;
    }
    let t = (at - a.at) / width;
    let (s, u) = (t * t, S::one() - t);
    a.value * (t * 2.0 + 1.0) * u * u
        + b.value * s * (S::constant(3.0) - t * 2.0)
        + width * (a.slope * t * u * u - b.slope * s * u)
}

/// The cubic b z + c z^2 + d z^3 with the value and slope of a knot and a value elsewhere.
fn through_origin<S: Scalar>(knot: &Knot<S>, other: S, value: S, at: S) -> S {
    // p(z)/z is a parabola: known at two places, with its slope at the first.
    let (first, second) = (knot.value / knot.at, value / other);
    let rise = (knot.slope - first) / knot.at;
    let width = other - knot.at;
    let bend = (second - first - rise * width) / (width * width);
    let z = at - knot.at;
    at * (first + rise * z + bend * z * z)
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;

    /// P. 24 of the report: V_z + v = 0.85 at N and 1.25 at X, without slope there.
    #[test]
    fn the_boundary_of_instability_is_where_the_air_through_the_disc_has_no_slope() {
        for (v_z, through) in [(N, THROUGH_N), (X, THROUGH_X)] {
            let at = |z: f64| z + ratio(0.0, z);
            assert!((at(v_z) - through).abs() < 1e-12, "{v_z}: {}", at(v_z));
            let slope = (at(v_z + 1e-4) - at(v_z - 1e-4)) / 2e-4;
            assert!(slope.abs() < 2e-3, "{v_z}: {slope}");
        }
        // Between them the air passes the faster the faster the descent: unstable.
        assert!(ratio(0.0, -1.0) - 1.0 > ratio(0.0, -0.9) - 0.9);
        let boundary = Boundary::at(0.0).unwrap();
        assert!((boundary.upper - N).abs() < 1e-12);
        assert_eq!((boundary.lower, boundary.end), (X, E));
        assert_eq!(Boundary::at(V_XM), None);
    }

    /// Momentum theory in climb, at speed, and in fast descent.
    #[test]
    fn outside_the_vortex_ring_it_is_momentum_theory() {
        for (v_x, v_z) in [
            (0.0, 0.5),
            (0.3, 0.0),
            (2.0, -1.0),
            (0.0, -3.0),
            (0.5, -0.1),
        ] {
            let v = ratio(v_x, v_z);
            let thrust = v * v_x.hypot(v_z + v);
            assert!((thrust - 1.0).abs() < 1e-10, "{v_x} {v_z}: {thrust}");
        }
        let fast = 1.5 - (2.25_f64 - 1.0).sqrt();
        assert!((ratio(0.0, -3.0) - fast).abs() < 1e-10);
    }

    #[test]
    fn the_speed_of_the_air_gives_the_induced_velocity_back() {
        for v_x in [0.0, 0.2, 0.6, 0.9, 1.5] {
            for i in 1..60 {
                let v_z = -0.05 * f64::from(i);
                let v = ratio(v_x, v_z);
                // In units of v_h and in others.
                for hover in [1.0, 7.0] {
                    let found = speed(v_x * hover, v_z * hover, v * hover);
                    let expected = hover / v;
                    assert!(
                        (found / expected - 1.0).abs() < 1e-6,
                        "{v_x} {v_z}: {found} {expected}"
                    );
                }
            }
        }
    }

    #[test]
    fn nothing_jumps() {
        for j in 0..=22 {
            let v_x = 0.05 * f64::from(j);
            for i in 0..300 {
                let v_z = 0.01 * f64::from(100 - i) - 1.0;
                let here = ratio(v_x, v_z);
                for there in [ratio(v_x, v_z - 1e-3), ratio(v_x + 1e-3, v_z)] {
                    assert!((there - here).abs() < 0.05, "{v_x} {v_z}: {here} {there}");
                }
            }
        }
    }
}
