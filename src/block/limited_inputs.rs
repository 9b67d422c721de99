//! Inputs outside their range. They are limited to it, because solvers, landings and stopping
//! rotors pass an end by a rounding error, which must not end a simulation.

use super::{
    plausibility::in_degrees,
    references::Reference,
    shown::shown,
    variables::{Causality, INPUTS, RealRef, Variable},
};

/// The inputs of which a warning has been given: one for each input.
#[derive(Debug, Clone, Copy)]
pub struct LimitedInputs {
    warned: [bool; INPUTS],
}

impl Default for LimitedInputs {
    fn default() -> Self {
        Self {
            warned: [false; INPUTS],
        }
    }
}

/// The value in effect: for an input, the nearest in its range.
pub fn limited(variable: &Variable<f64>, value: f64) -> f64 {
    if variable.causality != Causality::Input {
        value
    } else if value < variable.min {
        variable.min
    } else if value > variable.max {
        variable.max
    } else {
        value
    }
}

impl LimitedInputs {
    /// A warning if an input was given a value outside its range, unless there has been one of this
    /// input. Allocates only if it returns one.
    pub fn next(&mut self, reference: RealRef, given: f64) -> Option<String> {
        let variable = reference.variable();
        let counts = limited(variable, given);
        let warned = self.warned.get_mut(reference.index())?;
        if counts == given || *warned {
            return None;
        }
        *warned = true;
        let unit = variable.unit;
        Some(format!(
            "{} = {} {unit} is out of range{}; it counts as {} {unit}, the end of the range from {} to {} {unit}; this is said once",
            variable.name,
            shown(given),
            degrees(variable, given),
            shown(counts),
            shown(variable.min),
            shown(variable.max),
        ))
    }
}

/// A hint for an angle that would be in its range if it had been given in degrees.
pub fn degrees(variable: &Variable<f64>, value: f64) -> String {
    let is_plausible = (variable.min..=variable.max).contains(&value.to_radians());
    if variable.unit == "rad" && is_plausible {
        format!(" (degrees? {})", in_degrees(value))
    } else {
        String::new()
    }
}
