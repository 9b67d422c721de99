//! Inputs that move linearly within a step, where the importer has set their derivatives.

use super::{
    BlockError, Values,
    shown::shown,
    variables::{INPUTS, REALS},
};

/// Part of its change by which an input may exceed its limit at the end of a step: rounding.
const ROUNDING: f64 = 1e-9;

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

    /// Ends a step.
    pub fn end(&mut self) {
        self.past = self.slopes;
        self.slopes = [0.0; INPUTS];
    }

    /// Begins a step of `duration` s at the values `start`. An error if an input would leave its
    /// range.
    pub fn begin(&mut self, start: &Values, duration: f64) -> Result<(), BlockError> {
        self.moment.reals = start.reals;
        self.moment.integers = start.integers;
        self.moment.booleans = start.booleans;
        for ((variable, slope), from) in REALS.iter().zip(self.slopes).zip(start.reals) {
            if slope == 0.0 {
                continue;
            }
            let change = slope * duration;
            let (value, off) = (from + change, ROUNDING * change.abs());
            let range = variable.min - off..=variable.max + off;
            if !range.contains(&value) || !value.is_finite() {
                return Err(BlockError::LeavesRange {
                    name: variable.name,
                    value: shown(value),
                    min: shown(variable.min),
                    max: shown(variable.max),
                });
            }
        }
        Ok(())
    }

    /// The values `offset` s after the beginning of the step.
    pub fn at(&mut self, start: &Values, offset: f64) -> &Values {
        let reals = self.moment.reals.iter_mut().zip(start.reals);
        for ((variable, slope), (value, from)) in REALS.iter().zip(self.slopes).zip(reals) {
            if slope != 0.0 {
                *value = (from + slope * offset).clamp(variable.min, variable.max);
            }
        }
        &self.moment
    }
}
