//! One coefficient over angle of attack and, in layers, over Reynolds or Mach number.

use super::{
    Similarity,
    curve::{Coefficient, Curve, CurveError},
    layers::Layers,
    lookup::Lookup,
};
use crate::{
    numbers::{C, LANES, Lanes, Mask, PerLane, Portable, Scalar},
    text_file::{collect, push},
};
use core::f64::consts::PI;
use thiserror::Error;

/// One curve for each Reynolds or Mach number.
///
/// Between layers the value is linear in ln Re or in Mach number; outside, the nearest layer holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    layers: Layers,
    curve: Vec<Curve>,
    lookup: Lookup,
}

/// Why points do not make a table.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
#[error("{error}")]
pub struct TableError {
    /// Index of the first layer without a curve.
    pub layer: usize,
    /// What is wrong with its points.
    pub error: CurveError,
}

impl Table {
    /// A table with the points (angle of attack in deg, coefficient) that `points_of` gives for
    /// each layer, by its index.
    ///
    /// # Errors
    ///
    /// The first layer whose points make no curve.
    pub fn try_new<P: Iterator<Item = (f64, f64)>>(
        layers: Layers,
        coefficient: Coefficient,
        points_of: impl Fn(usize) -> P,
    ) -> Result<Self, TableError> {
        let mut curves = Vec::new();
        for layer in 0..layers.count() {
            collect(points_of(layer), "the points")
                .map_err(CurveError::from)
                .and_then(|points| Curve::try_from_degrees(coefficient, &points))
                .and_then(|curve| Ok(push(&mut curves, curve, "the curves")?))
                .map_err(|error| TableError { layer, error })?;
        }
        let lookup = Lookup::try_new(&curves).map_err(|error| TableError {
            layer: 0,
            error: error.into(),
        })?;
        Ok(Self {
            layers,
            curve: curves,
            lookup,
        })
    }

    /// The Reynolds or Mach numbers of the curves.
    pub fn layers(&self) -> &Layers {
        &self.layers
    }

    /// The curves of the layers.
    pub fn curves(&self) -> impl Iterator<Item = &Curve> {
        self.curve.iter()
    }

    /// Whether the coefficient differs from 0 at some angle.
    pub fn is_anywhere(&self) -> bool {
        self.curve.iter().any(Curve::is_anywhere)
    }

    /// Whether there is only one layer.
    #[inline(always)]
    pub fn is_single(&self) -> bool {
        self.curve.len() == 1
    }

    /// The coefficient in the first layer at an angle of attack, rad, any value.
    #[inline(always)]
    pub fn single<L: Lanes>(&self, alpha: L) -> L {
        self.lookup.value(&[0; LANES], wrapped(alpha))
    }

    /// The coefficient at an angle of attack, rad, any value.
    #[inline(always)]
    pub fn value<L: Lanes>(&self, alpha: L, flow: Similarity<L>) -> L {
        let alpha = wrapped(alpha);
        let Some(place) = self.layers.find(flow) else {
            return self.lookup.value(&[0; LANES], alpha);
        };
        let lower = self.lookup.value(&place.layer, alpha);
        if !place.is_between() {
            return lower;
        }
        lower + place.weight * (self.lookup.value(&place.next, alpha) - lower)
    }

    /// The line through the lift at -3 and +3 deg: its slope, 1/rad, and its angle of zero lift,
    /// rad, which is 0 for a line without slope.
    pub fn line<L: Lanes>(&self, flow: Similarity<L>) -> (L, L) {
        let edge = 3.0_f64.to_radians();
        let at = |alpha: f64| self.value(L::constant(alpha), flow);
        let (low, high) = (at(-edge), at(edge));
        let slope = (high - low) / (2.0 * edge);
        let zero_lift = C(-0.5) * (high + low) / slope;
        let is_flat = slope.values().is_negligible(0.0);
        (slope, L::select(is_flat, L::nil(), zero_lift))
    }

    /// Angles of attack (negative, positive) at which the lift reaches its first peak; -pi and pi
    /// without lift. rad.
    pub fn stall_angles<S: Scalar>(&self, flow: Similarity<S>) -> (S, S) {
        let mixed = |side: fn((f64, f64)) -> f64| {
            let of_layer = |layer: usize| S::constant(side(self.curve[layer].stall_angles()));
            self.layers.mixed(flow, |layer, _| of_layer(layer))
        };
        (mixed(|stall| stall.0), mixed(|stall| stall.1))
    }
}

/// The same angle between -pi and pi. rad.
#[inline(always)]
pub fn wrapped<L: Lanes>(alpha: L) -> L {
    if !is_outside(alpha).any() {
        return alpha;
    }
    L::in_lanes(&turned::<L::One>(&alpha.per_lane()))
}

/// Where an angle is not between -pi and pi.
#[inline(always)]
fn is_outside<L: Lanes>(alpha: L) -> L::Mask {
    alpha.is_below(-PI) | alpha.is_above(PI)
}

/// The same angles between -pi and pi. rad.
#[cold]
#[inline(never)]
fn turned<S: Scalar>(alpha: &PerLane<S>) -> PerLane<S> {
    let alpha = S::In::<Portable>::in_lanes(alpha);
    let turns = (alpha.values() / (2.0 * PI)).each(libm::round);
    let turned = alpha.plus_real(-(turns * 2.0 * PI));
    let turned = turned.at_least(-PI).at_most(PI);
    Lanes::select(is_outside(alpha), turned, alpha).per_lane()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::airfoil::Axis;

    fn table() -> Table {
        let scaled = |scale: f64| {
            [
                (-180.0, 0.0),
                (-10.0, -scale),
                (0.0, 0.0),
                (10.0, scale),
                (14.0, 0.9 * scale),
                (20.0, 1.5 * scale),
                (180.0, 0.0),
            ]
        };
        let layers = Layers::try_new(Axis::Reynolds, [1e5, 1e6]).unwrap();
        let points = |i: usize| scaled([1.0, 2.0][i]).into_iter();
        Table::try_new(layers, Coefficient::Lift, points).unwrap()
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
        let circle = |_| [(-180.0, 0.0), (0.0, 0.0), (180.0, 0.0)].into_iter();
        let layers = Layers::try_new(Axis::Reynolds, [1e5]).unwrap();
        let circle = Table::try_new(layers, Coefficient::Lift, circle).unwrap();
        assert_eq!(circle.stall_angles(flow), (-PI, PI), "no lift, no stall");
    }
}
