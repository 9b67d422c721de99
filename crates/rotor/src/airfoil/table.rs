//! One coefficient over angle of attack and, in layers, over Reynolds or Mach number.

use super::{
    Similarity,
    layers::{Axis, Layers},
};
use crate::scalar::Scalar;
use core::f64::consts::PI;

/// Number of equal parts of the circle for which the first interval is kept, so that a look-up
/// needs no search: half a degree each.
const PARTS: usize = 720;

/// A coefficient over angle of attack: linear between its points, exact at them.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// rad, strictly increasing from -pi to pi.
    alpha: Vec<f64>,
    value: Vec<f64>,
    /// Slope of the interval that begins at each point but the last, 1/rad.
    slope: Vec<f64>,
    /// The interval in which each part of the circle begins.
    interval: Vec<u16>,
    /// Angles of the first lift peak to either side of zero; rad.
    stall: (f64, f64),
}

/// Curves for one or more Reynolds or Mach numbers.
///
/// Between layers the value is linear in ln Re or in Mach number; outside, the nearest layer holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    layers: Layers,
    curve: Vec<Curve>,
}

impl Curve {
    /// From points in degrees, -180 to 180, which the loaders have checked.
    pub fn from_degrees(points: &[(f64, f64)]) -> Self {
        let alpha: Vec<f64> = points
            .iter()
            .map(|p| {
                if p.0.abs() == 180.0 {
                    PI.copysign(p.0)
                } else {
                    p.0.to_radians()
                }
            })
            .collect();
        let value: Vec<f64> = points.iter().map(|p| p.1).collect();
        let intervals = alpha.windows(2).zip(value.windows(2));
        let slope = intervals
            .map(|(a, v)| (v[1] - v[0]) / (a[1] - a[0]))
            .collect();
        let last = alpha.len().saturating_sub(2);
        let interval = (0..PARTS).map(|part| {
            let begin = -PI + 2.0 * PI * part as f64 / PARTS as f64;
            let next = alpha.partition_point(|a| *a <= begin);
            u16::try_from(next.saturating_sub(1).min(last)).unwrap_or(u16::MAX)
        });
        let stall = (
            -first_peak(points.iter().rev().map(|p| (-p.0, -p.1))).to_radians(),
            first_peak(points.iter().copied()).to_radians(),
        );
        Self {
            interval: interval.collect(),
            alpha,
            value,
            slope,
            stall,
        }
    }

    /// At an angle between -pi and pi.
    fn value<S: Scalar>(&self, alpha: S) -> S {
        let x = alpha.value();
        let part = ((x + PI) * (PARTS as f64 / (2.0 * PI))) as usize;
        let mut i = usize::from(self.interval[part.min(PARTS - 1)]);
        // Rounding may name the part before or behind.
        while i > 0 && alpha.is_below(self.alpha[i]) {
            i -= 1;
        }
        while i + 1 < self.slope.len() && !alpha.is_below(self.alpha[i + 1]) {
            i += 1;
        }
        if x >= self.alpha[i + 1] {
            // The last point itself, or a corner that is left downwards.
            return (alpha - self.alpha[i + 1]) * self.slope[i] + self.value[i + 1];
        }
        (alpha - self.alpha[i]) * self.slope[i] + self.value[i]
    }
}

/// Angle (deg) of the first local maximum of lift at positive angles up to 30 deg; of the largest
/// value there if the lift has no local maximum; 180 if there is no lift.
fn first_peak(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let mut best: (f64, f64) = (180.0, 0.0);
    for (alpha, lift) in points.filter(|p| p.0 > 0.0 && p.0 <= 30.0) {
        if lift > best.1 {
            best = (alpha, lift);
        } else if best.1 > 0.0 {
            break;
        }
    }
    best.0
}

impl Table {
    /// Layers as (Reynolds or Mach number, curve), at least one, numbers strictly increasing.
    pub fn new(axis: Axis, layers: Vec<(f64, Curve)>) -> Self {
        let (numbers, curve): (Vec<f64>, Vec<Curve>) = layers.into_iter().unzip();
        Self {
            layers: Layers::new(axis, numbers),
            curve,
        }
    }

    pub fn layers(&self) -> &Layers {
        &self.layers
    }

    /// Whether the coefficient differs from 0 at some angle.
    pub fn is_anywhere(&self) -> bool {
        self.curve
            .iter()
            .any(|curve| curve.value.iter().any(|v| *v != 0.0))
    }

    pub fn value<S: Scalar>(&self, alpha: S, flow: Similarity<S>) -> S {
        let alpha = wrapped(alpha);
        self.layers.mixed(flow, |i| self.curve[i].value(alpha))
    }

    pub fn stall_angles<S: Scalar>(&self, flow: Similarity<S>) -> (S, S) {
        let mixed = |side: fn((f64, f64)) -> f64| {
            self.layers
                .mixed(flow, |i| S::constant(side(self.curve[i].stall)))
        };
        (mixed(|stall| stall.0), mixed(|stall| stall.1))
    }
}

/// The same angle between -pi and pi.
pub fn wrapped<S: Scalar>(alpha: S) -> S {
    if !(alpha.is_below(-PI) || alpha.is_above(PI)) {
        return alpha;
    }
    let turns = libm::round(alpha.value() / (2.0 * PI));
    (alpha - turns * 2.0 * PI).at_least(-PI).at_most(PI)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let curve = |scale: f64| {
            Curve::from_degrees(&[
                (-180.0, 0.0),
                (-10.0, -scale),
                (0.0, 0.0),
                (10.0, scale),
                (14.0, 0.9 * scale),
                (20.0, 1.5 * scale),
                (180.0, 0.0),
            ])
        };
        Table::new(Axis::Reynolds, vec![(1e5, curve(1.0)), (1e6, curve(2.0))])
    }

    fn at(alpha_deg: f64, reynolds: f64) -> f64 {
        let flow = Similarity {
            reynolds,
            mach: 0.0,
        };
        table().value(alpha_deg.to_radians(), flow)
    }

    #[test]
    fn points_are_exact_and_between_them_the_value_is_linear() {
        assert_eq!(at(10.0, 1e5), 1.0);
        assert_eq!(at(-10.0, 1e5), -1.0);
        assert_eq!(at(10.0, 1e6), 2.0);
        assert_eq!(at(14.0, 1e5), 0.9);
        assert_eq!(at(-180.0, 1e5), 0.0);
        assert!((at(5.0, 1e5) - 0.5).abs() < 1e-15);
        assert!(
            (at(10.0, libm::sqrt(1e11)) - 1.5).abs() < 1e-14,
            "half way in ln Re"
        );
    }

    /// Against a search through all points.
    #[test]
    fn the_interval_is_found_at_every_angle() {
        let points = [
            (-180.0, 0.0),
            (-90.3, 2.0),
            (-90.2, 1.0),
            (0.1, 3.0),
            (0.2, -1.0),
            (180.0, 0.0),
        ];
        let curve = Curve::from_degrees(&points);
        for i in -36_000..=36_000 {
            let degrees = f64::from(i) / 200.0;
            let after = points
                .iter()
                .position(|p| p.0 > degrees)
                .unwrap_or(points.len() - 1);
            let (a, b) = (points[after - 1], points[after]);
            let expected = a.1 + (degrees - a.0) / (b.0 - a.0) * (b.1 - a.1);
            let found = curve.value(degrees.to_radians());
            assert!(
                (found - expected).abs() < 1e-11,
                "{degrees}: {found} {expected}"
            );
        }
    }

    #[test]
    fn outside_the_reynolds_range_the_nearest_layer_holds() {
        assert_eq!(at(10.0, 0.0), 1.0);
        assert_eq!(at(10.0, 1e9), 2.0);
    }

    #[test]
    fn angles_repeat_after_a_turn() {
        assert!((at(370.0, 1e5) - 1.0).abs() < 1e-12);
        assert!((at(-350.0, 1e5) - 1.0).abs() < 1e-12);
        assert!(at(180.0, 1e5).abs() < 1e-15 && at(540.0, 1e5).abs() < 1e-12);
    }

    #[test]
    fn stall_is_the_first_peak_of_lift() {
        let flow = Similarity {
            reynolds: 1e5,
            mach: 0.0,
        };
        let (negative, positive) = table().stall_angles(flow);
        assert!((positive.to_degrees() - 10.0).abs() < 1e-12);
        assert!((negative.to_degrees() + 10.0).abs() < 1e-12);
        let circle = Curve::from_degrees(&[(-180.0, 0.0), (0.0, 0.0), (180.0, 0.0)]);
        let circle = Table::new(Axis::Reynolds, vec![(1e5, circle)]);
        assert_eq!(circle.stall_angles(flow), (-PI, PI), "no lift, no stall");
    }
}
