//! The Reynolds or Mach numbers for which a file has data, and where a flow lies among them.

use super::Similarity;
use crate::scalar::Scalar;

/// What the layers of a table are numbered by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    Reynolds,
    Mach,
}

/// Reynolds or Mach numbers, at least one, strictly increasing.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    axis: Axis,
    number: Vec<f64>,
    /// ln Re or Mach number.
    position: Vec<f64>,
}

impl Layers {
    pub fn new(axis: Axis, number: Vec<f64>) -> Self {
        let position = match axis {
            Axis::Reynolds => number.iter().map(|n| Scalar::ln(*n)).collect(),
            Axis::Mach => number.clone(),
        };
        Self {
            axis,
            number,
            position,
        }
    }

    /// Lowest and highest number of an axis, if the layers are numbered by it.
    pub fn range(&self, axis: Axis) -> Option<(f64, f64)> {
        let ends = self
            .number
            .first()
            .copied()
            .zip(self.number.last().copied());
        ends.filter(|_| self.axis == axis)
    }

    /// Whether more than one Mach number tells how the coefficients change with it.
    pub fn resolves_mach(&self) -> bool {
        self.axis == Axis::Mach && self.number.len() > 1
    }

    /// The layer at or below the flow's number, and how far (0 to 1) the number lies towards the
    /// next one; no weight where a single layer holds: outside, the nearest.
    pub fn find<S: Scalar>(&self, flow: Similarity<S>) -> (usize, Option<S>) {
        let last = self.position.len() - 1;
        if last == 0 {
            return (0, None);
        }
        let number = match self.axis {
            Axis::Reynolds => flow.reynolds.at_least(1.0).ln(),
            Axis::Mach => flow.mach,
        };
        // A flow that is no number has no place among them: it comes from states out of all bounds.
        if number.value().is_nan() || !number.is_above(self.position[0]) {
            return (0, None);
        }
        if !number.is_below(self.position[last]) {
            return (last, None);
        }
        let upper = self.position.partition_point(|p| !number.is_below(*p));
        let (p0, p1) = (self.position[upper - 1], self.position[upper]);
        (upper - 1, Some((number - p0) / (p1 - p0)))
    }

    /// Mixes what two neighbouring layers say; linear, and exact at a layer.
    pub fn mixed<S: Scalar>(&self, flow: Similarity<S>, of_layer: impl Fn(usize) -> S) -> S {
        let (layer, weight) = self.find(flow);
        let lower = of_layer(layer);
        match weight {
            None => lower,
            Some(weight) => lower + weight * (of_layer(layer + 1) - lower),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;

    fn at(layers: &Layers, reynolds: f64, mach: f64) -> f64 {
        layers.mixed(Similarity { reynolds, mach }, |i| [1.0, 3.0, 4.0][i])
    }

    #[test]
    fn the_numbers_of_a_file_are_met_exactly_and_beyond_them_the_nearest_holds() {
        let layers = Layers::new(Axis::Reynolds, vec![2e4, 1.7e5, 1e6]);
        for (reynolds, value) in [
            (0.0, 1.0),
            (2e4, 1.0),
            (1.7e5, 3.0),
            (1e6, 4.0),
            (1e12, 4.0),
        ] {
            assert_eq!(at(&layers, reynolds, 0.0), value);
        }
        let half = libm::sqrt(2e4 * 1.7e5);
        assert!((at(&layers, half, 0.0) - 2.0).abs() < 1e-14);
        assert_eq!(at(&layers, f64::NAN, 0.0), 1.0);
        let layers = Layers::new(Axis::Mach, vec![0.1, 0.3, 0.7]);
        for (mach, value) in [(0.0, 1.0), (0.1, 1.0), (0.2, 2.0), (0.3, 3.0), (2.0, 4.0)] {
            assert!((at(&layers, 1e5, mach) - value).abs() < 1e-15);
        }
    }

    /// At a number of the file the slope is that of the side to which the flow leads, and none beyond the ends.
    #[test]
    fn slopes_at_the_numbers_of_a_file() {
        let layers = Layers::new(Axis::Mach, vec![0.1, 0.3, 0.7]);
        let slope = |mach: f64, change: f64| {
            let flow = Similarity {
                reynolds: Dual64::from_re(1e5),
                mach: Dual64::new(mach, change),
            };
            let mixed = layers.mixed(flow, |i| Dual64::from_re([1.0, 3.0, 4.0][i]));
            mixed.eps / change
        };
        for (mach, below, above) in [(0.1, 0.0, 10.0), (0.3, 10.0, 2.5), (0.7, 2.5, 0.0)] {
            assert!((slope(mach, -1.0) - below).abs() < 1e-12, "{mach}");
            assert!((slope(mach, 1.0) - above).abs() < 1e-12, "{mach}");
        }
    }
}
