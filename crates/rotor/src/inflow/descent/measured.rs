//! The mass flow in descent as Castles & Gray measured it: 1951, NACA TN 2474, Table I (rotors of
//! 6 ft, vertical descent to V_d/v_h = 2.46).
//!
//! g(k) = (v_h/v)^2 at k = V_c/v is a piecewise cubic through the knots below with a continuous
//! slope. In climb, and from the first knot down (V_d/v_h = 3.6), it is momentum theory's |1 + k|.
//! The values are a fit to all runs; provenance/descent-law/fit.py makes it, and compares it with
//! published laws and with fits to halves of the runs. Between V_d/v_h = 2.46 and 3.6 nothing was
//! measured. V_c/v_h = k/sqrt(g) grows with k everywhere.
//!
//! Edgewise flow. No measurements in it are fitted: v g(k) replaces V_c + v in Glauert's resultant,
//! in which either matters less the faster the edgewise flow.

use crate::scalar::{C, Scalar};

/// k, g, dg/dk.
const KNOTS: [(f64, f64, f64); 10] = [
    (-12.0, 11.0000, -1.0000),
    (-2.4, 0.9911, -0.5818),
    (-1.6, 0.6180, -0.4541),
    (-1.2, 0.4401, -0.4340),
    (-0.95, 0.3338, -0.4908),
    (-0.76, 0.2252, -0.4188),
    (-0.62, 0.1780, 0.0000),
    (-0.48, 0.3535, 1.0563),
    (-0.3, 0.5159, 1.1307),
    (0.0, 1.0000, 1.0000),
];

/// g and its slope dg/dk at k = V_c/v <= 0.
pub fn gain<S: Scalar>(ratio: S) -> (S, S) {
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
    use super::*;

    #[test]
    fn the_law_joins_momentum_theory_and_has_the_slope_it_says() {
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        let (hover, rise) = gain(-1e-9);
        assert!(near(hover, 1.0) && near(rise, 1.0));
        for k in [KNOTS[0].0 - 1e-9, KNOTS[0].0 + 1e-9] {
            assert!(near(gain(k).0, -1.0 - k) && near(gain(k).1, -1.0));
        }
        for i in 1..1300 {
            let k = -0.01 * f64::from(i) + 0.003;
            let difference = (gain(k + 1e-6).0 - gain(k - 1e-6).0) / 2e-6;
            assert!((gain(k).1 - difference).abs() < 1e-5, "{k}");
        }
    }

    /// V_d/v_h = -k/sqrt(g) grows with -k, so that the inflow is unique at any thrust.
    #[test]
    fn the_inflow_is_unique() {
        let mut previous = 0.0;
        for i in 1..30_000 {
            let k = -0.0005 * f64::from(i);
            let descent = -k / gain(k).0.sqrt();
            assert!(descent > previous, "{k}");
            previous = descent;
        }
    }
}
