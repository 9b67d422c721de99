//! The mass flow in descent as Castles & Gray measured it: 1951, NACA TN 2474, Tables I and III
//! (rotors of 6 ft, without twist and with 12 deg of washout, vertical descent to V_d/v_h = 2.46
//! and 3.17).
//!
//! Before the peak of the induced velocity all rotors lie on one curve v/v_h over V_d/v_h, and far
//! beyond nearly so. Where the peak and the drop come depends on the rotor, by the stretch s of
//! `thrust_radius`. With x = -k = V_d/v
//!
//! ```text
//! V_d/v_h = x/sqrt(g0) w,   w = 1 + (s - 1) b(x),   so that g(k) = g0(k)/w^2.
//! ```
//!
//! g0 is a piecewise cubic through the knots below with a continuous slope. In climb, and from the
//! first knot down (V_d/v_h = 3.6), it is momentum theory's |1 + k|. The bump b rises from 0 before
//! the peak to 1 at it and falls to 0 over ln x. The values of g0 are a fit to the untwisted rotor
//! alone; provenance/descent-law/fit.py makes it, judges it on the twisted rotor, and compares it
//! with published laws and with fits to halves of the runs. Beyond V_d/v_h = 2.46 nothing is
//! fitted. V_c/v_h = k/sqrt(g) grows with k everywhere, for each s within its limits.
//!
//! Edgewise flow. No measurements in it are fitted: v g(k) replaces V_c + v in Glauert's resultant,
//! in which either matters less the faster the edgewise flow.

use crate::numbers::{C, Scalar};

/// k, g0, dg0/dk.
const KNOTS: [(f64, f64, f64); 11] = [
    (-12.0, 11.0000, -1.0000),
    (-2.6, 1.0967, -0.6339),
    (-1.8, 0.6823, -0.4780),
    (-1.3, 0.4582, -0.4456),
    (-0.95, 0.3030, -0.4657),
    (-0.72, 0.1910, -0.3973),
    (-0.64, 0.1629, 0.0000),
    (-0.56, 0.2392, 1.0905),
    (-0.48, 0.3411, 1.1343),
    (-0.3, 0.5199, 1.2026),
    (0.0, 1.0000, 1.0000),
];

/// x at which the bump begins.
const BUMP_BEGIN: f64 = 0.56;
/// x at its top.
const BUMP_TOP: f64 = 0.64;
/// x at its end.
const BUMP_END: f64 = 4.0;

/// g and its slope dg/dk at k = V_c/v <= 0 and the stretch s.
pub fn gain<S: Scalar>(ratio: S, stretch: S) -> (S, S) {
    let (gain, slope) = unstretched(ratio);
    let place = -ratio.value();
    if !(BUMP_BEGIN < place && place < BUMP_END) {
        return (gain, slope);
    }
    let (bump, rise) = bump(-ratio);
    let factor = C(1.0) + (stretch - 1.0) * bump;
    let factor_slope = -(stretch - 1.0) * rise;
    let square = factor * factor;
    (
        gain / square,
        (slope - C(2.0) * gain * factor_slope / factor) / square,
    )
}

/// b and db/dx at an x between the bump's begin and end.
fn bump<S: Scalar>(x: S) -> (S, S) {
    if x.value() < BUMP_TOP {
        let width = BUMP_TOP - BUMP_BEGIN;
        let (step, slope) = smooth_step((x - BUMP_BEGIN) / width);
        (step, slope / width)
    } else {
        let width = libm::log(BUMP_END / BUMP_TOP);
        let (step, slope) = smooth_step((x / BUMP_TOP).ln() / width);
        (C(1.0) - step, -slope / (x * width))
    }
}

/// 3 t^2 - 2 t^3 and its slope.
pub(super) fn smooth_step<S: Scalar>(t: S) -> (S, S) {
    (t * t * (C(3.0) - C(2.0) * t), C(6.0) * t * (C(1.0) - t))
}

/// g0 and its slope.
fn unstretched<S: Scalar>(ratio: S) -> (S, S) {
    let k = ratio.value();
    if k.is_nan() || k <= KNOTS[0].0 {
        return (-ratio - 1.0, S::constant(-1.0));
    }
    let upper = KNOTS
        .partition_point(|knot| knot.0 <= k)
        .min(KNOTS.len() - 1);
    let ((a, value_a, slope_a), (b, value_b, slope_b)) = (KNOTS[upper - 1], KNOTS[upper]);
    let width = b - a;
    let t = (ratio - a) / width;
    let (s, u) = (t * t, C(1.0) - t);
    // Hermite's cubic and its derivative, with s = t^2 and u = 1 - t.
    let value = C(value_a) * (C(1.0) + C(2.0) * t) * u * u
        + C(value_b) * s * (C(3.0) - C(2.0) * t)
        + C(width) * (C(slope_a) * t * u * u - C(slope_b) * s * u);
    let slope = C(6.0) * t * u * (value_b - value_a) / width
        + C(slope_a) * u * (C(1.0) - C(3.0) * t)
        + C(slope_b) * t * (C(3.0) * t - 2.0);
    (value, slope)
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::{super::thrust_radius::STRETCHES, *};
    use crate::numbers::Dual64;

    /// The limits of s and some between.
    fn stretches() -> impl Iterator<Item = f64> {
        let step = 0.1 * (STRETCHES.1 - STRETCHES.0);
        (0..=10).map(move |i| STRETCHES.0 + step * f64::from(i))
    }

    #[test]
    fn the_law_joins_momentum_theory_and_has_the_slope_it_says() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        for s in stretches() {
            let (hover, rise) = gain(-1e-9, s);
            assert!(near(hover, 1.0) && near(rise, 1.0));
            for k in [KNOTS[0].0 - 1e-9, KNOTS[0].0 + 1e-9] {
                let (value, slope) = gain(k, s);
                assert!(near(value, -1.0 - k) && near(slope, -1.0));
            }
            for i in 1..1300 {
                let k = -0.01 * f64::from(i) + 0.003;
                let difference = (gain(k + 1e-6, s).0 - gain(k - 1e-6, s).0) / 2e-6;
                assert!((gain(k, s).1 - difference).abs() < 1e-5, "{k} {s}");
                let dual = gain(Dual64::new(k, 1.0), Dual64::from_re(s)).0;
                assert!((dual.eps - gain(k, s).1).abs() < 1e-12, "{k} {s}");
                let by_stretch = gain(Dual64::from_re(k), Dual64::new(s, 1.0)).0.eps;
                let difference = (gain(k, s + 1e-6).0 - gain(k, s - 1e-6).0) / 2e-6;
                assert!((by_stretch - difference).abs() < 1e-6, "{k} {s}");
            }
        }
    }

    /// V_d/v_h = -k/sqrt(g) grows with -k, so that the inflow is unique at any thrust. It is linear
    /// in s, so that the limits of s stand for all.
    #[test]
    fn the_inflow_is_unique() {
        for s in stretches() {
            let mut previous = 0.0;
            for i in 1..30_000 {
                let k = -0.0005 * f64::from(i);
                let descent = -k / gain(k, s).0.sqrt();
                // The least slope is a tenth but for rounding of the knots.
                let rise = if k > KNOTS[0].0 { 0.098 * 0.0005 } else { 0.0 };
                assert!(descent - previous > rise, "{k} {s}");
                previous = descent;
            }
        }
    }

    #[test]
    fn a_stretch_of_one_changes_nothing_and_any_other_only_the_peak_and_the_drop() {
        for i in 1..1500 {
            let k = -0.01 * f64::from(i) + 0.003;
            assert_eq!(gain(k, 1.0), unstretched(k));
            let is_at_the_bump = (BUMP_BEGIN..BUMP_END).contains(&-k);
            for s in [STRETCHES.0, STRETCHES.1] {
                assert_eq!(gain(k, s) != unstretched(k), is_at_the_bump, "{k}");
            }
        }
        let descent = |s| BUMP_TOP / gain(-BUMP_TOP, s).0.sqrt();
        assert!((descent(1.2) / descent(1.0) - 1.2).abs() < 1e-12);
    }
}
