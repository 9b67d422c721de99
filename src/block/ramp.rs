//! Inputs that move linearly within a step, where the importer has set their derivatives.

use super::{
    Values,
    limited_inputs::limited,
    references::Reference,
    variables::{INPUTS, REALS, RealRef},
};

/// Derivatives of the inputs in time, per second, by value reference.
pub type Slopes = [f64; INPUTS];

/// The derivatives of the inputs in time, and their values within a step.
#[derive(Debug)]
pub struct Ramp {
    /// For the next step.
    pub slopes: Slopes,
    /// Those of the last step.
    pub past: Slopes,
    /// All values at a moment of the step. The strings are not used.
    moment: Values,
}

impl Default for Ramp {
    fn default() -> Self {
        Self {
            slopes: [0.0; INPUTS],
            past: [0.0; INPUTS],
            moment: Values::default(),
        }
    }
}

impl Ramp {
    pub fn is_moving(&self) -> bool {
        self.slopes.iter().any(|slope| *slope != 0.0)
    }

    /// Ends a step at these values. An input that has reached an end of its range moves no more.
    pub fn end(&mut self, values: &Values) {
        self.past = self.slopes;
        let inputs = self.past.iter_mut().zip(REALS.iter()).zip(values.reals);
        for ((slope, variable), value) in inputs {
            let stays =
                (*slope > 0.0 && value >= variable.max) || (*slope < 0.0 && value <= variable.min);
            if stays {
                *slope = 0.0;
            }
        }
        self.slopes = [0.0; INPUTS];
    }

    /// The mean of an input in a step of `duration` s.
    pub fn mean(&self, start: &Values, input: RealRef, duration: f64) -> f64 {
        let (from, slope) = (start.reals[input], self.slopes[input.index()]);
        let end = from + slope * duration;
        let to = limited(input.variable(), end);
        // It stays at the end of its range once it has reached that.
        let moving = if to == end {
            1.0
        } else {
            (to - from) / (end - from)
        };
        0.5 * (from + to) * moving + to * (1.0 - moving)
    }

    /// Begins a step at the values `start`.
    pub fn begin(&mut self, start: &Values) {
        self.moment.reals = start.reals;
        self.moment.integers = start.integers;
        self.moment.booleans = start.booleans;
    }

    /// The inputs that move, and where they would be after `duration` s without the limits of their
    /// ranges.
    pub fn ends(&self, start: &Values, duration: f64) -> impl Iterator<Item = (RealRef, f64)> {
        let inputs = RealRef::all().zip(self.slopes).zip(start.reals);
        inputs
            .filter(|((_, slope), _)| *slope != 0.0)
            .map(move |((input, slope), from)| (input, from + slope * duration))
    }

    /// The values `offset` s after the beginning of the step. An input that reaches an end of its
    /// range stays there.
    pub fn at(&mut self, start: &Values, offset: f64) -> &Values {
        let reals = self.moment.reals.iter_mut().zip(start.reals);
        for ((variable, slope), (value, from)) in REALS.iter().zip(self.slopes).zip(reals) {
            if slope != 0.0 {
                *value = limited(variable, from + slope * offset);
            }
        }
        &self.moment
    }
}
