//! The Reynolds or Mach numbers for which a file has data, and where a flow lies among them.

use super::Similarity;
use crate::{
    numbers::{LANES, Lanes, Mask, Plain},
    text_file::{NoMemory, push},
};
use std::{fmt, ops::RangeInclusive};
use thiserror::Error;

/// What the layers of a table are numbered by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Axis {
    /// Reynolds number of the chord, 1 to 1e10.
    Reynolds,
    /// Mach number, 0 to 10.
    Mach,
}

impl Axis {
    /// The numbers that a file may have; no rotor comes near the highest.
    fn permitted(self) -> RangeInclusive<f64> {
        match self {
            Self::Reynolds => 1.0..=1e10,
            Self::Mach => 0.0..=10.0,
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Reynolds => "Reynolds number",
            Self::Mach => "Mach number",
        })
    }
}

/// Maximum number of Reynolds or Mach numbers of a table: the widest C81 tables have two digits of
/// them.
pub const MAX_LAYERS: usize = 999;

/// Reynolds or Mach numbers: one or more, finite, strictly increasing.
#[derive(Debug, Clone, PartialEq)]
pub struct Layers {
    axis: Axis,
    number: Vec<f64>,
    /// ln Re or Mach number, strictly increasing.
    position: Vec<f64>,
}

/// Why numbers do not make layers.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
#[error("{problem}")]
pub struct LayersError {
    /// Index of the first wrong number; 0 if there are none.
    pub layer: usize,
    /// What is wrong with it.
    pub problem: LayersProblem,
}

/// What is wrong with a Reynolds or Mach number.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum LayersProblem {
    /// No numbers at all.
    #[error("there is no {0}; one or more are needed")]
    Empty(Axis),
    /// More than `MAX_LAYERS`.
    #[error("there are more than {MAX_LAYERS} {0}s; leave some out")]
    TooMany(Axis),
    /// There is no memory for the layers.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    /// NaN, infinite, too small or too large.
    #[error("{axis} {number:?} must lie between {} and {}", axis.permitted().start(), axis.permitted().end())]
    OutOfRange {
        /// What the number is.
        axis: Axis,
        /// The number.
        number: f64,
    },
    /// Numbers increase, by more than rounding.
    #[error("{axis} {number} must be above the one before ({before})")]
    NotIncreasing {
        /// What the number is.
        axis: Axis,
        /// The number.
        number: f64,
        /// The number before it.
        before: f64,
    },
}

/// Refuses tables with more than `MAX_LAYERS` numbers: each is a curve with its own memory.
pub fn check_count(axis: Axis, count: usize) -> Result<(), LayersProblem> {
    if count > MAX_LAYERS {
        return Err(LayersProblem::TooMany(axis));
    }
    Ok(())
}

impl Layers {
    /// Layers at the given numbers.
    ///
    /// # Errors
    ///
    /// The first wrong number: there must be one to `MAX_LAYERS`, strictly increasing, Reynolds
    /// numbers from 1 to 1e10 and Mach numbers from 0 to 10.
    pub fn try_new(
        axis: Axis,
        numbers: impl IntoIterator<Item = f64>,
    ) -> Result<Self, LayersError> {
        let mut layers = Self {
            axis,
            number: Vec::new(),
            position: Vec::new(),
        };
        for (layer, number) in numbers.into_iter().enumerate() {
            layers
                .add(number)
                .map_err(|problem| LayersError { layer, problem })?;
        }
        if layers.number.is_empty() {
            let problem = LayersProblem::Empty(axis);
            return Err(LayersError { layer: 0, problem });
        }
        Ok(layers)
    }

    /// Adds the next number.
    fn add(&mut self, number: f64) -> Result<(), LayersProblem> {
        let axis = self.axis;
        check_count(axis, self.number.len() + 1)?;
        if !axis.permitted().contains(&number) {
            return Err(LayersProblem::OutOfRange { axis, number });
        }
        let next = match axis {
            Axis::Reynolds => Lanes::ln(number),
            Axis::Mach => number,
        };
        if let Some((position, before)) = self.position.last().zip(self.number.last())
            && next <= *position
        {
            return Err(LayersProblem::NotIncreasing {
                axis,
                number,
                before: *before,
            });
        }
        push(&mut self.number, number, "the layers")?;
        push(&mut self.position, next, "the layers")?;
        Ok(())
    }

    /// Number of layers, 1 or more.
    pub fn count(&self) -> usize {
        self.number.len()
    }

    /// Lowest and highest number of an axis, if the layers are numbered by it.
    pub fn range(&self, axis: Axis) -> Option<(f64, f64)> {
        let ends = (self.number[0], self.number[self.number.len() - 1]);
        (self.axis == axis).then_some(ends)
    }

    /// Whether two or more Mach numbers tell how the coefficients change with it.
    pub fn resolves_mach(&self) -> bool {
        match self.axis {
            Axis::Mach => self.number.len() > 1,
            Axis::Reynolds => false,
        }
    }

    /// Where the numbers of a flow lie among the layers; nowhere if there is only one layer.
    /// Outside the range the nearest layer holds.
    #[inline(always)]
    pub fn find<L: Lanes>(&self, flow: Similarity<L>) -> Option<Place<L>> {
        if self.position.len() == 1 {
            return None;
        }
        let number = match self.axis {
            Axis::Reynolds => flow.reynolds.at_least(1.0).ln(),
            Axis::Mach => flow.mach,
        };
        let last = self.position.len() - 1;
        let value = number.values().store();
        let mut layer = [0; LANES];
        for lane in 0..L::COUNT {
            // NaN has no place among the numbers; it comes from states that have diverged.
            let next = self.position.partition_point(|p| *p <= value[lane]);
            layer[lane] = next.saturating_sub(1);
        }
        // A number at a layer that is about to fall below it.
        let falls = number.below(self.positions(&layer));
        for (lane, layer) in layer.iter_mut().enumerate().take(L::COUNT) {
            *layer = layer.saturating_sub(usize::from(falls.lane(lane)));
        }
        let mut next = layer;
        for next in &mut next {
            *next = (*next + 1).min(last);
        }
        let (low, high) = (self.positions(&layer), self.positions(&next));
        let is_between = number.above(low) & low.below(high);
        let weight = number.plus_real(-low).times(L::Real::unit() / (high - low));
        Some(Place {
            layer,
            next,
            weight: L::select(is_between, weight, L::nil()),
        })
    }

    /// The positions of layers.
    #[inline(always)]
    fn positions<V: Plain>(&self, layer: &[usize; LANES]) -> V {
        let mut positions = [0.0; LANES];
        for lane in 0..V::COUNT {
            positions[lane] = self.position[layer[lane]];
        }
        V::load(&positions)
    }

    /// A quantity of each layer at the numbers of a flow, by the layer's index and the lane: linear
    /// between layers, and exact at a layer.
    #[inline(always)]
    pub fn mixed<L: Lanes>(
        &self,
        flow: Similarity<L>,
        of_layer: impl Fn(usize, usize) -> L::One,
    ) -> L {
        let Some(place) = self.find(flow) else {
            return L::from_lanes(|lane| of_layer(0, lane));
        };
        let lower = L::from_lanes(|lane| of_layer(place.layer[lane], lane));
        if !place.is_between() {
            return lower;
        }
        let upper = L::from_lanes(|lane| of_layer(place.next[lane], lane));
        lower + place.weight * (upper - lower)
    }
}

/// Where the numbers of a flow lie among the layers.
#[derive(Debug)]
pub struct Place<L> {
    /// The layer at or below each number.
    pub layer: [usize; LANES],
    /// The next layer.
    pub next: [usize; LANES],
    /// How far, 0 to 1, the number lies towards the next layer.
    pub weight: L,
}

impl<L: Lanes> Place<L> {
    /// Whether any number lies between two layers.
    #[inline(always)]
    pub fn is_between(&self) -> bool {
        !self.weight.is_negligible(0.0).all()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Dual64;

    fn at(layers: &Layers, reynolds: f64, mach: f64) -> f64 {
        layers.mixed(Similarity { reynolds, mach }, |i, _| [1.0, 3.0, 4.0][i])
    }

    #[test]
    fn the_numbers_of_a_file_are_met_exactly_and_beyond_them_the_nearest_holds() {
        let layers = Layers::try_new(Axis::Reynolds, vec![2e4, 1.7e5, 1e6]).unwrap();
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
        let layers = Layers::try_new(Axis::Mach, vec![0.1, 0.3, 0.7]).unwrap();
        for (mach, value) in [(0.0, 1.0), (0.1, 1.0), (0.2, 2.0), (0.3, 3.0), (2.0, 4.0)] {
            assert!((at(&layers, 1e5, mach) - value).abs() < 1e-15);
        }
    }

    #[test]
    fn numbers_that_make_no_layers_are_refused_at_the_first_wrong_one() {
        let next_after = |x: f64| f64::from_bits(x.to_bits() + 1);
        for (axis, numbers, place, text) in [
            (
                Axis::Mach,
                vec![],
                0,
                "there is no Mach number; one or more are needed",
            ),
            (
                Axis::Mach,
                vec![-0.1],
                0,
                "Mach number -0.1 must lie between 0 and 10",
            ),
            (
                Axis::Mach,
                vec![0.0, f64::INFINITY],
                1,
                "Mach number inf must lie between 0 and 10",
            ),
            (
                Axis::Mach,
                vec![f64::NAN],
                0,
                "Mach number NaN must lie between 0 and 10",
            ),
            (
                Axis::Reynolds,
                (1..=1000).map(f64::from).collect(),
                999,
                "there are more than 999 Reynolds numbers; leave some out",
            ),
            (
                Axis::Reynolds,
                vec![0.5],
                0,
                "Reynolds number 0.5 must lie between 1 and 10000000000",
            ),
            (
                Axis::Reynolds,
                vec![1e5, 1e300],
                1,
                "Reynolds number 1e300 must lie between 1 and 10000000000",
            ),
            (
                Axis::Reynolds,
                vec![1e5, 2e5, 2e5],
                2,
                "Reynolds number 200000 must be above the one before (200000)",
            ),
            (
                Axis::Reynolds,
                vec![1e6, next_after(1e6)],
                1,
                "Reynolds number 1000000.0000000001 must be above the one before (1000000)",
            ),
        ] {
            let error = Layers::try_new(axis, numbers).unwrap_err();
            assert_eq!((error.layer, error.to_string().as_str()), (place, text));
        }
    }

    /// At a number of the file the slope is that of the side to which the flow moves; it is 0
    /// beyond the ends.
    #[test]
    fn slopes_at_the_numbers_of_a_file() {
        let layers = Layers::try_new(Axis::Mach, vec![0.1, 0.3, 0.7]).unwrap();
        let slope = |mach: f64, change: f64| {
            let flow = Similarity {
                reynolds: Dual64::from_re(1e5),
                mach: Dual64::new(mach, change),
            };
            let of_layer = |i: usize, _| Dual64::from_re([1.0, 3.0, 4.0][i]);
            let mixed: Dual64 = layers.mixed(flow, of_layer);
            mixed.eps / change
        };
        for (mach, below, above) in [(0.1, 0.0, 10.0), (0.3, 10.0, 2.5), (0.7, 2.5, 0.0)] {
            assert!((slope(mach, -1.0) - below).abs() < 1e-12, "{mach}");
            assert!((slope(mach, 1.0) - above).abs() < 1e-12, "{mach}");
        }
    }
}
