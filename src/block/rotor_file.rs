//! What a rotor file gives for parameters and inputs.
//!
//! The importer's own values win: a parameter that differs from its default or that `settings`
//! assigns keeps its value, and so do `rpm` and `collective` once the importer has set them. By the
//! FMI standard a parameter that is set to its default is as if it had not been set, and many tools
//! set all of them.

use super::{
    from_file::Own,
    references::Reference,
    settings,
    setup::SetupError,
    shown::shown,
    values::Values,
    variables::{
        BOOLEANS, BooleanRef, Causality, INTEGERS, IntegerRef, REALS, RealRef, STRINGS, StringRef,
        Variable, real, string,
    },
};
use rotor::geometry::{Given, GivenValue, RotorDefinition, nearest};
use std::{fmt, path::Path};

/// The groups of parameters that a rotor file may give, besides `airfoil.file`.
const GROUPS: [&str; 4] = ["flapping.", "models.", "drive.", "numerics."];

/// What a rotor file gave, for the log.
#[derive(Debug, Default)]
pub struct Taken {
    used: Vec<String>,
    kept: Vec<String>,
}

impl Taken {
    /// The end of the sentence that says what was read from the file.
    pub fn note(&self) -> String {
        let mut note = String::new();
        if !self.used.is_empty() {
            note = format!("; from it: {}", self.used.join(", "));
        }
        if !self.kept.is_empty() {
            note += &format!("; set otherwise and kept: {}", self.kept.join(", "));
        }
        note
    }
}

/// Copies what the file says into those variables of `values` that the importer has not set.
/// `defaults`: the values when nothing is set. `path`: that of the file, for errors.
pub fn apply(
    values: &mut Values,
    defaults: &Values,
    definition: &RotorDefinition,
    path: &Path,
) -> Result<Taken, SetupError> {
    let assigned = values.strings[string::SETTINGS].clone();
    let assigned: Vec<&str> = settings::names(&assigned).collect();
    let mut taken = Taken::default();
    for given in &definition.given {
        let entry = Entry {
            given,
            is_assigned: assigned.contains(&given.name.as_str()),
        };
        let note = entry.apply(values, defaults).map_err(|problem| {
            let place = match given.line {
                0 => String::new(),
                line => format!(", line {line}"),
            };
            SetupError::RotorFileValue {
                name: values.strings[string::GEOMETRY__FILE].clone(),
                problem: format!("{}{place}: {problem}", path.display()),
            }
        })?;
        match note {
            Ok(used) => taken.used.push(used),
            Err(kept) => taken.kept.push(kept),
        }
    }
    Ok(taken)
}

/// An entry of a rotor file.
struct Entry<'a> {
    given: &'a Given,
    /// Whether `settings` assigns the parameter, which wins.
    is_assigned: bool,
}

/// What the log says of an entry: `Ok` if it was used, `Err` if the importer's value was kept.
type Note = Result<String, String>;

impl Entry<'_> {
    /// An error is the end of a sentence that begins with the file.
    fn apply(&self, values: &mut Values, defaults: &Values) -> Result<Note, String> {
        let name = self.given.name.as_str();
        let real = RealRef::all().find(|r| r.variable().name == name);
        let integer = IntegerRef::all().find(|r| r.variable().name == name);
        let boolean = BooleanRef::all().find(|r| r.variable().name == name);
        let text = StringRef::all().find(|r| r.variable().name == name);
        if let Some(reference) = real.filter(|r| may_give(r.variable())) {
            let value = self.real(reference.variable())?;
            let own = values.reals[reference];
            let is_set = if reference.variable().causality == Causality::Input {
                values.from_file.is_set(reference)
            } else {
                own != defaults.reals[reference]
            };
            return Ok(self.take(
                is_set,
                reference,
                values,
                Own::Real(reference.into(), own),
                |v| {
                    v.reals[reference] = value;
                },
            ));
        }
        if let Some(reference) = integer.filter(|r| may_give(r.variable())) {
            let value = self.integer(reference.variable())?;
            let own = values.integers[reference];
            let is_set = own != defaults.integers[reference];
            let kept = Own::Integer(reference.into(), own);
            return Ok(self.take(is_set, reference, values, kept, |v| {
                v.integers[reference] = value;
            }));
        }
        if let Some(reference) = boolean.filter(|r| may_give(r.variable())) {
            let GivenValue::Boolean(value) = self.given.value else {
                return Err(self.wrong("true or false"));
            };
            let own = values.booleans[reference];
            let is_set = own != defaults.booleans[reference];
            let kept = Own::Boolean(reference.into(), own);
            return Ok(self.take(is_set, reference, values, kept, |v| {
                v.booleans[reference] = value;
            }));
        }
        if let Some(reference) = text.filter(|r| *r == string::AIRFOIL__FILE) {
            let GivenValue::Text(value) = &self.given.value else {
                return Err(self.wrong("a text"));
            };
            let own = values.strings[reference].clone();
            let is_set = own != defaults.strings[reference];
            let kept = Own::Text(reference.into(), own);
            return Ok(self.take(is_set, reference, values, kept, |v| {
                v.strings[reference].clone_from(value);
            }));
        }
        Err(self.unknown())
    }

    /// Replaces a value that the importer has not set, and keeps it.
    fn take<R: Reference>(
        &self,
        is_set: bool,
        reference: R,
        values: &mut Values,
        own: Own,
        replace: impl FnOnce(&mut Values),
    ) -> Note {
        let Variable { name, unit, .. } = *reference.variable();
        if is_set || self.is_assigned {
            return Err(name.to_owned());
        }
        values.from_file.push(own);
        replace(values);
        Ok(format!("{name} = {}", with_unit(&self.given.value, unit)))
    }

    /// A number in the unit of the variable and in its range. Angles of rotor files are in degrees.
    fn real(&self, variable: &Variable<f64>) -> Result<f64, String> {
        let given = match self.given.value {
            GivenValue::Number(value) => value,
            GivenValue::Integer(value) => value as f64,
            GivenValue::Boolean(_) | GivenValue::Text(_) => return Err(self.wrong("a number")),
        };
        let is_angle = variable.unit == "rad";
        let value = if is_angle { given.to_radians() } else { given };
        if (variable.min..=variable.max).contains(&value) && value.is_finite() {
            return Ok(value);
        }
        let limit = |x: f64| shown(if is_angle { x.to_degrees().round() } else { x });
        Err(format!(
            "{} is {}, which is out of range; give a value from {} to {}",
            variable.name,
            with_unit(&self.given.value, variable.unit),
            limit(variable.min),
            with_unit(limit(variable.max), variable.unit)
        ))
    }

    /// An integer in the range of the variable, or the number of a choice.
    fn integer(&self, variable: &Variable<i32>) -> Result<i32, String> {
        if variable.choices.is_empty() {
            let GivenValue::Integer(value) = self.given.value else {
                return Err(self.wrong("an integer"));
            };
            let value = i32::try_from(value).ok();
            let fits = value.filter(|v| (variable.min..=variable.max).contains(v));
            return fits.ok_or_else(|| {
                format!(
                    "{} is {}, which is out of range; give a value from {} to {}",
                    variable.name, self.given.value, variable.min, variable.max
                )
            });
        }
        let word = match &self.given.value {
            GivenValue::Text(word) => word.as_str(),
            GivenValue::Boolean(_) | GivenValue::Integer(_) | GivenValue::Number(_) => {
                return Err(self.wrong("the name of a choice, in quotes"));
            }
        };
        let place = variable.choices.iter().position(|choice| *choice == word);
        let number = place.and_then(|place| i32::try_from(place + 1).ok());
        number.ok_or_else(|| {
            let meant = nearest(word, variable.choices.iter().copied());
            format!(
                "{} is {:?}, which is no choice; write one of {}{}",
                variable.name,
                short(word),
                variable.choices.join(", "),
                meant.map_or_else(String::new, |name| format!("; did you mean {name}?"))
            )
        })
    }

    fn wrong(&self, what: &str) -> String {
        let value = short(&self.given.value.to_string());
        format!("{} is {value}; give {what}", self.given.name)
    }

    fn unknown(&self) -> String {
        let (table, key) = self.given.name.split_once('.').unwrap_or_default();
        let of_table = move |name: &'static str| name.split_once('.').filter(|(t, _)| *t == table);
        let known = parameters().filter_map(move |name| of_table(name).map(|(_, key)| key));
        let meant = nearest(key, known.clone());
        format!(
            "[{table}] has no key {:?}{}; its keys are {}",
            short(key),
            meant.map_or_else(String::new, |name| format!("; did you mean {name}?")),
            known.collect::<Vec<_>>().join(", ")
        )
    }
}

/// A value as in rotor files, with its unit: angles are in degrees, and ratios have none.
fn with_unit(value: impl fmt::Display, unit: &str) -> String {
    match unit {
        "rad" => format!("{value} deg"),
        "1" | "" => value.to_string(),
        unit => format!("{value} {unit}"),
    }
}

/// Whether a rotor file may give this variable.
fn may_give<T>(variable: &Variable<T>) -> bool {
    let name = variable.name;
    let is_input = [real::RPM, real::COLLECTIVE]
        .iter()
        .any(|input| input.variable().name == name);
    let is_parameter = variable.causality == Causality::Parameter;
    is_input || (is_parameter && GROUPS.iter().any(|group| name.starts_with(group)))
}

fn parameters() -> impl Iterator<Item = &'static str> + Clone {
    fn names<T: 'static>(
        table: &'static [Variable<T>],
    ) -> impl Iterator<Item = &'static str> + Clone {
        table.iter().filter(|v| may_give(v)).map(|v| v.name)
    }
    let numbers = names(&REALS).chain(names(&INTEGERS));
    numbers.chain(names(&BOOLEANS)).chain(names(&STRINGS))
}

fn short(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(80).collect()
}
