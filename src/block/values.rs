//! The values of all variables, and the rules under which they may be set.

use super::{
    from_file::{FromFile, Own},
    limited_inputs::{degrees, limited},
    ramp::Slopes,
    references::{
        BooleanRef, Booleans, IntegerRef, Integers, Names, RealRef, Reals, Reference, StringRef,
        Strings,
    },
    shown::shown,
    variables::{BOOLEANS, Causality, INTEGERS, REALS, STATES, STRINGS, Variable},
};
use crate::host::memory::NO_MEMORY;
use serde::{Deserialize, Serialize};
use thiserror::Error;

/// Bytes of the longest text of a String variable.
pub const MAX_TEXT: usize = 1 << 16;

/// Why a value was not read or set. Nothing has changed.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum ValueError {
    #[error(
        "this FMU has no {base_type} variable with the value reference {reference} (they go from 0 to {last}); see modelDescription.xml"
    )]
    Unknown {
        reference: u32,
        base_type: &'static str,
        last: usize,
    },
    #[error("{name} = {value} is not a finite number; set a finite value (it keeps {kept})")]
    NotFinite {
        name: &'static str,
        value: f64,
        kept: f64,
    },
    #[error("{name} = {value} is out of range{hint}; set a value from {range} (it keeps {kept})")]
    OutOfRange {
        name: &'static str,
        value: String,
        /// Empty, or the value that was probably meant.
        hint: String,
        range: String,
        kept: String,
    },
    #[error("{name} = {value} is not allowed; set one of {choices} (it keeps {kept})")]
    NotAllowed {
        name: &'static str,
        value: i32,
        choices: String,
        kept: i32,
    },
    #[error("{name} is computed by the rotor; it cannot be set")]
    Output { name: &'static str },
    #[error(
        "{name} is a fixed parameter and keeps {kept} once the simulation runs; set it before initialisation ends, or reset the instance"
    )]
    Fixed { name: &'static str, kept: String },
    #[error("{name} is a parameter and keeps {kept} between events; enter Event Mode to set it")]
    BetweenEvents { name: &'static str, kept: String },
    #[error(
        "{name} is computed by the rotor; as a continuous state it can be set in Continuous-Time Mode only"
    )]
    State { name: &'static str },
    #[error("{name} is not an input; only the derivatives of inputs can be set")]
    NotInput { name: &'static str },
    #[error("the derivative {value} of {name} is not a finite number; set a finite one")]
    SlopeNotFinite { name: &'static str, value: f64 },
    #[error(
        "{name} would have {length} bytes, more than {MAX_TEXT}; set a shorter text (it keeps its own)"
    )]
    TooLong { name: &'static str, length: usize },
    #[error("{NO_MEMORY}")]
    NoMemory,
    #[error("{given} continuous states were passed, but this FMU has {}", STATES.len())]
    StateCount { given: usize },
}

/// Which variables may change.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Stage {
    /// Inputs and all parameters.
    Configuring,
    /// Inputs and tunable parameters.
    Running,
    /// Inputs and continuous states, while the importer integrates. Discrete variables keep their
    /// values.
    Integrating,
}

/// The values by value reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Values {
    pub reals: Reals,
    pub integers: Integers,
    pub booleans: Booleans,
    pub strings: Strings,
    /// Which of them a rotor file gave.
    pub from_file: FromFile,
}

impl Default for Values {
    fn default() -> Self {
        Self {
            reals: Reals::new(REALS.map(|v| v.start)),
            integers: Integers::new(INTEGERS.map(|v| v.start)),
            booleans: Booleans::new(BOOLEANS.map(|v| v.start)),
            strings: Strings::new(STRINGS.map(|v| v.start.to_owned())),
            from_file: FromFile::default(),
        }
    }
}

/// Whether causality and stage allow a variable to be set, to a value that differs from its present
/// one or not. `kept` is the present value for the error.
fn may_set<T>(
    variable: &Variable<T>,
    stage: Stage,
    differs: bool,
    kept: impl FnOnce() -> String,
) -> Result<(), ValueError> {
    let name = variable.name;
    match variable.causality {
        Causality::Output | Causality::Local => Err(ValueError::Output { name }),
        Causality::Parameter if !variable.tunable && differs && stage != Stage::Configuring => {
            Err(ValueError::Fixed { name, kept: kept() })
        }
        Causality::Parameter if differs && stage == Stage::Integrating => {
            Err(ValueError::BetweenEvents { name, kept: kept() })
        }
        _ => Ok(()),
    }
}

impl Values {
    /// The value of a Real variable.
    pub fn real(&self, name: impl Names<RealRef>) -> Result<f64, ValueError> {
        Ok(self.reals[name.reference()?])
    }

    /// The value of an Integer variable, or the number of an enumeration's item.
    pub fn integer(&self, name: impl Names<IntegerRef>) -> Result<i32, ValueError> {
        Ok(self.integers[name.reference()?])
    }

    /// The value of a Boolean variable.
    pub fn boolean(&self, name: impl Names<BooleanRef>) -> Result<bool, ValueError> {
        Ok(self.booleans[name.reference()?])
    }

    /// Sets all of the values or, if one is refused, none. Inputs are limited to their range.
    pub fn set_reals(
        &mut self,
        stage: Stage,
        names: &[impl Names<RealRef>],
        values: &[f64],
    ) -> Result<(), ValueError> {
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let variable = reference.variable();
            let kept = self.reals[reference];
            let name = variable.name;
            if !reference.is_state() {
                let differs = *value != kept && !self.is_own(stage, reference, *value);
                may_set(variable, stage, differs, || shown(kept))?;
            } else if stage != Stage::Integrating {
                return Err(ValueError::State { name });
            }
            if !value.is_finite() {
                return Err(ValueError::NotFinite {
                    name,
                    value: *value,
                    kept,
                });
            }
            let counts = limited(variable, *value);
            if counts < variable.min || counts > variable.max {
                let unit = |x: f64| {
                    format!("{} {}", shown(x), variable.unit)
                        .trim_end()
                        .to_owned()
                };
                return Err(ValueError::OutOfRange {
                    name,
                    value: unit(*value),
                    hint: degrees(variable, *value),
                    range: format!("{} to {}", shown(variable.min), unit(variable.max)),
                    kept: unit(kept),
                });
            }
        }
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            if !self.is_own(stage, reference, *value) {
                self.reals[reference] = limited(reference.variable(), *value);
                self.from_file.set_by_importer(reference);
            }
        }
        Ok(())
    }

    /// Whether a fixed parameter that has the value of a rotor file is written again, after
    /// initialisation, with the value that it had before: it keeps the file's.
    fn is_own(&self, stage: Stage, reference: RealRef, value: f64) -> bool {
        let is_fixed = stage != Stage::Configuring && !reference.variable().tunable;
        is_fixed && self.from_file.replaced(&Own::Real(reference.into(), value))
    }

    /// Puts the derivatives in time of inputs into `slopes`: all of them or, if one is refused,
    /// none.
    pub fn set_slopes(
        names: &[impl Names<RealRef>],
        values: &[f64],
        slopes: &mut Slopes,
    ) -> Result<(), ValueError> {
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let variable = reference.variable();
            let name = variable.name;
            if variable.causality != Causality::Input {
                return Err(ValueError::NotInput { name });
            }
            if !value.is_finite() {
                let value = *value;
                return Err(ValueError::SlopeNotFinite { name, value });
            }
        }
        for (name, value) in names.iter().zip(values) {
            slopes[name.reference()?.index()] = *value;
        }
        Ok(())
    }

    /// Sets all of the values or, if one is refused, none.
    pub fn set_integers(
        &mut self,
        stage: Stage,
        names: &[impl Names<IntegerRef>],
        values: &[i32],
    ) -> Result<(), ValueError> {
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let variable = reference.variable();
            let kept = self.integers[reference];
            let own = Own::Integer(reference.into(), *value);
            let differs = *value != kept && !self.from_file.replaced(&own);
            may_set(variable, stage, differs, || kept.to_string())?;
            let name = variable.name;
            if (variable.min..=variable.max).contains(value) {
                continue;
            }
            if variable.choices.is_empty() {
                return Err(ValueError::OutOfRange {
                    name,
                    value: value.to_string(),
                    hint: String::new(),
                    range: format!("{} to {}", variable.min, variable.max),
                    kept: kept.to_string(),
                });
            }
            let choices = variable.choices.iter().enumerate();
            let choices: Vec<String> = choices.map(|(i, c)| format!("{} ({c})", i + 1)).collect();
            return Err(ValueError::NotAllowed {
                name,
                value: *value,
                choices: choices.join(", "),
                kept,
            });
        }
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let own = Own::Integer(reference.into(), *value);
            if !self.from_file.replaced(&own) {
                self.integers[reference] = *value;
            }
        }
        Ok(())
    }

    /// Sets all of the values, 0 being false and 1 true, or, if one is refused, none.
    pub fn set_booleans(
        &mut self,
        stage: Stage,
        names: &[impl Names<BooleanRef>],
        values: &[i32],
    ) -> Result<(), ValueError> {
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let variable = reference.variable();
            let kept = i32::from(self.booleans[reference]);
            let own = Own::Boolean(reference.into(), *value == 1);
            let differs = *value != kept && !self.from_file.replaced(&own);
            may_set(variable, stage, differs, || kept.to_string())?;
            if ![0, 1].contains(value) {
                return Err(ValueError::NotAllowed {
                    name: variable.name,
                    value: *value,
                    choices: "0 (false), 1 (true)".to_owned(),
                    kept,
                });
            }
        }
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let own = Own::Boolean(reference.into(), *value == 1);
            if !self.from_file.replaced(&own) {
                self.booleans[reference] = *value == 1;
            }
        }
        Ok(())
    }

    /// Sets all of the values or, if one is refused, none.
    pub fn set_strings(
        &mut self,
        stage: Stage,
        names: &[impl Names<StringRef>],
        values: &[&str],
    ) -> Result<(), ValueError> {
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            let variable = reference.variable();
            let kept = &self.strings[reference];
            let is_own = self.from_file.replaced_text(reference.into(), value);
            may_set(variable, stage, value != kept && !is_own, || {
                format!("{kept:?}")
            })?;
            if value.len() > MAX_TEXT {
                let (name, length) = (variable.name, value.len());
                return Err(ValueError::TooLong { name, length });
            }
        }
        for (name, value) in names.iter().zip(values) {
            let reference = name.reference()?;
            if !self.from_file.replaced_text(reference.into(), value) {
                (*value).clone_into(&mut self.strings[reference]);
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::super::variables::{boolean, integer, real, string};
    use super::*;

    #[test]
    fn defaults_lie_in_their_own_ranges() {
        let defaults = Values::default();
        for (v, value) in REALS.iter().zip(defaults.reals) {
            assert!(
                v.causality.is_computed() || (v.min..=v.max).contains(&value),
                "{}",
                v.name
            );
        }
        for (v, value) in INTEGERS.iter().zip(defaults.integers) {
            assert!((v.min..=v.max).contains(&value), "{}", v.name);
        }
    }

    #[test]
    fn a_refused_value_changes_nothing_and_says_what_is_right() {
        let mut values = Values::default();
        let before = values.clone();
        let refs = [real::COLLECTIVE, real::GEOMETRY__RADIUS];
        for (bad, part) in [
            (
                -1.0,
                "geometry.radius = -1 m is out of range; set a value from 0.001 to 1000 m (it keeps 0.762 m)",
            ),
            (f64::NAN, "geometry.radius = NaN is not a finite number"),
            (
                f64::INFINITY,
                "geometry.radius = inf is not a finite number",
            ),
        ] {
            let error = values
                .set_reals(Stage::Configuring, &refs, &[0.1, bad])
                .unwrap_err();
            assert!(error.to_string().contains(part), "{error}");
            assert_eq!(values, before);
        }
        for (reference, bad, part) in [
            (
                real::FLAPPING__PRECONE,
                8.0,
                "flapping.precone = 8 rad is out of range (degrees? 8 deg = 0.1396 rad); set",
            ),
            (
                real::GEOMETRY__TWIST,
                -12.5,
                "(degrees? -12.5 deg = -0.2182 rad)",
            ),
            (
                real::GEOMETRY__TWIST,
                1e300,
                "1e300 rad is out of range; set",
            ),
            (
                real::FLAPPING__PRECONE,
                45.0,
                "45 rad is out of range; set a value from -0.5",
            ),
        ] {
            let error = values.set_reals(Stage::Configuring, &[reference], &[bad]);
            let error = error.unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
        let error = values.set_integers(Stage::Configuring, &[integer::MODELS__INFLOW], &[99]);
        let error = error.unwrap_err().to_string();
        assert!(
            error.contains(
                "models.inflow = 99 is not allowed; set one of 1 (annulusClosedForm), 2 (annulus), 3"
            ),
            "{error}"
        );
        let refs = [boolean::FLAPPING__ENABLED; 2];
        let error = values.set_booleans(Stage::Configuring, &refs, &[1, 2]);
        assert_eq!(
            error.unwrap_err().to_string(),
            "flapping.enabled = 2 is not allowed; set one of 0 (false), 1 (true) (it keeps 0)"
        );
        assert_eq!(values, before);
        let error = values
            .set_reals(Stage::Configuring, &[9999_u32], &[0.0])
            .unwrap_err();
        assert!(
            error
                .to_string()
                .contains("no Real variable with the value reference 9999"),
            "{error}"
        );
    }

    #[test]
    fn fixed_parameters_keep_their_values_while_running_and_outputs_always() {
        let mut values = Values::default();
        let set = |v: &mut Values, r, x| v.set_reals(Stage::Running, &[r], &[x]);
        assert!(set(&mut values, real::COLLECTIVE, 0.2).is_ok());
        assert!(set(&mut values, real::AIR__DENSITY, 1.0).is_ok(), "tunable");
        assert!(
            set(&mut values, real::GEOMETRY__RADIUS, 0.762).is_ok(),
            "its own value"
        );
        let error = set(&mut values, real::GEOMETRY__RADIUS, 0.8).unwrap_err();
        assert!(
            error
                .to_string()
                .contains("geometry.radius is a fixed parameter and keeps 0.762")
        );
        let error = set(&mut values, real::THRUST, 1.0).unwrap_err();
        assert_eq!(error, ValueError::Output { name: "thrust" });
        let enabled = boolean::FLAPPING__ENABLED;
        let error = values.set_booleans(Stage::Running, &[enabled], &[1]);
        assert!(
            error
                .unwrap_err()
                .to_string()
                .contains("flapping.enabled is a fixed parameter and keeps 0")
        );
        let error = values.set_strings(Stage::Running, &[string::AIRFOIL__FILE], &["x"]);
        assert!(
            error
                .unwrap_err()
                .to_string()
                .contains("airfoil.file is a fixed parameter")
        );
    }
}
