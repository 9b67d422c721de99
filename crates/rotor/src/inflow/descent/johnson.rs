//! Johnson's model of the mean inflow in the vortex ring state: Johnson 2005, "Model for Vortex
//! Ring State Influence on Rotorcraft Flight Dynamics", NASA/TP-2005-213477, pp. 14, 23 and 24.
//!
//! In units of v_h, with V_z the climb and V_x the edgewise flow. The baseline is momentum
//! theory with its two branches joined by a cubic between the points A and B,
//! v = b V_z + c V_z^2 + d V_z^3, from v and slope at A and v at B. To the baseline is added a
//! piecewise cubic, which is 0 at D and E and brings V_z + v to given values at N and X. These are
//! the boundaries of instability in climb, where V_z + v has no slope. The points move with V_x and
//! meet at V_xM; beyond V_xM there is no vortex ring.
//!
//! Ours: the slopes at N and X fade with V_x as the values do, so that nothing jumps at V_xM.
//!
//! (The report was not at hand; its numbers are those in the open-source implementation of TU
//! Braunschweig, which cites the pages.)

use crate::{
    numbers::{C, Dual64, Scalar},
    root::{End, bracketed},
};

// Baseline, p. 24.

/// V_z at which momentum theory's upper branch ends.
const A: f64 = -1.5;
/// V_z at which momentum theory's lower branch begins.
const B: f64 = -2.1;
/// V_x at which A and B meet.
const V_XC: f64 = 0.75;

// Vortex ring, p. 24.

/// V_z at which the vortex ring begins.
const D: f64 = -0.2;
/// V_z of the upper boundary of instability, and V_z + v there.
const N: f64 = -0.45;
const THROUGH_N: f64 = 0.85;
/// V_z of the lower boundary of instability, and V_z + v there.
const X: f64 = -1.5;
const THROUGH_X: f64 = 1.25;
/// V_z at which the vortex ring ends.
const E: f64 = -2.0;
/// V_x at which the boundaries of instability meet.
const V_XM: f64 = 0.95;

/// Bound on the steps towards v_h; seven are usual.
const MAX_STEPS: u32 = 200;

/// The search for v_h ends at a step of this part of it.
const TOLERANCE: f64 = 1e-13;

/// Bound on Newton's steps; about six are usual. Beyond the bound a bracket takes over.
const MAX_NEWTON_STEPS: u32 = 30;

/// The boundary of instability at one V_x, in units of v_h.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary<S = f64> {
    /// V_z of its upper side, < 0.
    pub upper: S,
    /// V_z of its lower side, at or below `upper`.
    pub lower: S,
    /// V_z below which the model is the windmill of momentum theory.
    pub end: S,
}

impl<S: Scalar> Boundary<S> {
    /// The boundary at V_x = `edgewise` (>= 0, in units of v_h); none from V_xM on.
    pub fn at(edgewise: S) -> Option<Self> {
        if edgewise.value().is_nan() || edgewise.value() >= V_XM {
            return None;
        }
        let share = edgewise / V_XM;
        let part = C(1.0) - share * share;
        let (middle, half) = (0.5 * (N + X), 0.5 * (N - X));
        let upper = C(middle) + C(half) * part.power(0.2);
        let lower = C(middle) - C(half) * part * part.sqrt();
        Some(Self {
            upper,
            lower,
            end: C(E) + (lower - X),
        })
    }
}

/// V' = v_h^2/v, m/s, with the v_h at which the model gives v.
///
/// * `edgewise`: V_x, >= 0, m/s
/// * `climb`: V_c, <= 0, m/s
/// * `induced`: v, >= 0, m/s
pub fn speed<S: Scalar>(edgewise: S, climb: S, induced: S) -> S {
    if induced.value() == 0.0 {
        return edgewise.hypot(climb);
    }
    let values = (edgewise.value(), climb.value(), induced.value());
    let Some(hover) = hover_velocity(values) else {
        // Never seen. The solution of the inflow then fails with an error.
        return S::constant(f64::NAN);
    };
    let surplus = |hover: S| hover * ratio(edgewise / hover, climb / hover) - induced;
    let hover = S::at_root(hover, surplus);
    hover * hover / induced
}

/// The v_h, m/s, at which the model gives v from V_x, V_c and v, m/s. Newton's method, halving the
/// bracket where it leaves that or hardly gets on (Press et al. 1992, "Numerical Recipes", ch.
/// 9.4): the slope jumps at the knots.
fn hover_velocity((edgewise, climb, induced): (f64, f64, f64)) -> Option<f64> {
    let surplus = |hover: f64| {
        let hover = Dual64::new(hover, 1.0);
        hover * ratio(C(edgewise) / hover, C(climb) / hover) - induced
    };
    let (mut low, mut high) = (0.0, f64::INFINITY);
    // Where nearly all the flow is the rotor's own, or nearly none, this is v_h.
    let mut hover = libm::sqrt(induced * (libm::hypot(edgewise, climb) + induced));
    let mut last_step = f64::INFINITY;
    for _ in 0..MAX_STEPS {
        let at = surplus(hover);
        let step = at.re / at.eps;
        if step.abs() <= TOLERANCE * hover || high - low <= TOLERANCE * hover {
            return Some(hover);
        }
        if at.re < 0.0 {
            low = hover;
        } else {
            high = hover;
        }
        let next = hover - step;
        let is_good = low < next && next < high && step.abs() <= 0.5 * last_step;
        let next = if is_good {
            next
        } else if high == f64::INFINITY {
            2.0 * hover
        } else {
            0.5 * (low + high)
        };
        last_step = (next - hover).abs();
        hover = next;
    }
    None
}

/// v at V_x and V_z, all in units of v_h.
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
    let square = share * share;
    let fade = (C(1.0) - square * square * square).sqrt();
    let at = |v_z: S, through: f64, own: f64| Knot {
        at: v_z,
        value: fade * (through - (own + helicopter(0.0, own))),
        // The boundary lies above A, where the baseline is momentum theory.
        slope: -fade * (C(1.0) + helicopter_slope(edgewise, v_z, helicopter(edgewise, v_z))),
    };
    let n = || at(upper, THROUGH_N, N);
    let x = || at(lower, THROUGH_X, X);
    let begin = Knot {
        at: S::constant(D),
        value: S::zero(),
        slope: S::zero(),
    };
    let more = if climb.value() >= upper.value() {
        hermite(&n(), &begin, climb)
    } else if climb.value() >= lower.value() {
        hermite(&x(), &n(), climb)
    } else {
        through_origin(&x(), end, S::zero(), climb)
    };
    base + more
}

/// Momentum theory with its branches joined.
fn baseline<S: Scalar>(edgewise: S, climb: S) -> S {
    if climb.value() >= 0.0 || edgewise.value() >= V_XC {
        return helicopter(edgewise, climb);
    }
    let part = edgewise / V_XC;
    let a = C(A) + C(0.2) * part * part;
    let mut b = C(B) + C(0.2) * part * part;
    if part.value() > 0.5 {
        let beyond = C(2.0) * part - 1.0;
        b += C(0.7) * (a - b) * beyond * beyond * beyond;
    }
    if climb.value() > a.value() {
        helicopter(edgewise, climb)
    } else if climb.value() < b.value() {
        windmill(edgewise, climb)
    } else {
        let value = helicopter(edgewise, a);
        let knot = Knot {
            at: a,
            value,
            slope: helicopter_slope(edgewise, a, value),
        };
        through_origin(&knot, b, windmill(edgewise, b), climb)
    }
}

/// The largest root of v sqrt(V_x^2 + (V_z + v)^2) = 1, which continues hover. The left side is
/// convex above it.
fn helicopter<S: Scalar>(edgewise: S, climb: S) -> S {
    if edgewise.value() == 0.0 {
        return C(-0.5) * climb + (C(1.0) + C(0.25) * climb * climb).sqrt();
    }
    let begin = 1.0 + climb.value().abs();
    newton(edgewise, climb, begin)
        .unwrap_or_else(|| momentum(edgewise, climb, 0.0_f64.max(-climb.value()), begin))
}

/// A root of v sqrt(V_x^2 + (V_z + v)^2) = 1 by Newton's method, from a beginning from which it
/// approaches the root without passing it; none within the bound on its steps.
fn newton<S: Scalar>(edgewise: S, climb: S, begin: f64) -> Option<S> {
    let (v_x, v_z) = (edgewise.value(), climb.value());
    let mut v = begin;
    for _ in 0..MAX_NEWTON_STEPS {
        let through = v_z + v;
        let flow = libm::sqrt(v_x * v_x + through * through);
        let step = (v * flow - 1.0) / (flow + v * through / flow);
        v -= step;
        if step.abs() <= 1e-14 * v.abs() {
            return Some(S::at_root(v, |v| momentum_surplus(edgewise, climb, v)));
        }
    }
    None
}

/// dv/dV_z of `helicopter`, whose value is v.
fn helicopter_slope<S: Scalar>(edgewise: S, climb: S, v: S) -> S {
    let through = climb + v;
    -v * through / (edgewise * edgewise + through * through + v * through)
}

/// The root that continues fast descent: the left side is concave up to it. Where it does not
/// exist, the root that continues hover.
fn windmill<S: Scalar>(edgewise: S, climb: S) -> S {
    let middle = -0.5 * climb.value();
    if middle * libm::hypot(edgewise.value(), middle) < 1.0 {
        return helicopter(edgewise, climb);
    }
    if edgewise.value() == 0.0 {
        return C(-0.5) * climb - (C(0.25) * climb * climb - 1.0).sqrt();
    }
    newton(edgewise, climb, 0.0)
        .filter(|v| (0.0..=middle).contains(&v.value()))
        .unwrap_or_else(|| momentum(edgewise, climb, 0.0, middle))
}

/// v V' - 1.
fn momentum_surplus<S: Scalar>(edgewise: S, climb: S, v: S) -> S {
    v * edgewise.hypot(climb + v) - 1.0
}

/// The root between two velocities. The bracket begins at 0 where the root lies below `from`.
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

/// A point of a cubic.
struct Knot<S> {
    /// V_z.
    at: S,
    value: S,
    slope: S,
}

/// Hermite's cubic through two knots, a below b, with their slopes.
fn hermite<S: Scalar>(a: &Knot<S>, b: &Knot<S>, at: S) -> S {
    let width = b.at - a.at;
    if width.value() <= 0.0 {
        return a.value;
    }
    let t = (at - a.at) / width;
    let (s, u) = (t * t, C(1.0) - t);
    a.value * (C(1.0) + C(2.0) * t) * u * u
        + b.value * s * (C(3.0) - C(2.0) * t)
        + width * (a.slope * t * u * u - b.slope * s * u)
}

/// The cubic b z + c z^2 + d z^3 through a knot with its slope, and with a value at `other`.
fn through_origin<S: Scalar>(knot: &Knot<S>, other: S, value: S, at: S) -> S {
    // p(z)/z is a parabola, known at two points and with its slope at the first.
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
        // Between them faster descent lets more air through the disc: unstable.
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
