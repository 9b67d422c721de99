//! The parameter `settings`: a text that assigns values to parameters of any type, for tools that
//! can set strings but no enumerations or Booleans.
//!
//! The text is `name = value; name = value`. Each value is set as if the importer had set it
//! directly, under the same rules and with the same errors.

use super::{
    references::{BooleanRef, IntegerRef, RealRef, StringRef},
    shown::shown,
    values::{Stage, ValueError, Values},
    variables::{BOOLEANS, Causality, INTEGERS, REALS, STRINGS, Variable, string},
};
use core::iter;
use thiserror::Error;

/// Why String variables were not set. Nothing has changed.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum SetStringsError {
    #[error(transparent)]
    Value(#[from] ValueError),
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

/// Why the assignments in `settings` were not made.
#[derive(Debug, Error, Clone, PartialEq)]
#[error("settings: {0}; no assignment in settings was made")]
pub struct SettingsError(#[from] Refusal);

/// What is wrong with an assignment.
#[derive(Debug, Error, Clone, PartialEq)]
enum Refusal {
    #[error("{0:?} is no assignment; write NAME = VALUE, with ; between assignments")]
    NoAssignment(String),
    #[error("the value of {0} begins with a quotation mark, but none ends it; add one")]
    OpenQuotation(String),
    #[error("{text:?} follows the quoted value of {name}; write ; between assignments")]
    AfterQuotation { name: String, text: String },
    #[error("there is no parameter {name:?}{hint}")]
    Unknown { name: String, hint: String },
    #[error(
        "{name} is an input, which is no parameter; connect it or set its start value in your tool"
    )]
    Input { name: &'static str },
    #[error("settings cannot assign to itself; write its assignments one after the other")]
    Itself,
    #[error("{name} is assigned twice; remove one of the assignments")]
    Twice { name: String },
    #[error("{name} = {value} is not {what}; {remedy} (it keeps {kept})")]
    Malformed {
        name: &'static str,
        value: String,
        what: &'static str,
        remedy: String,
        kept: String,
    },
    #[error(transparent)]
    Value(#[from] ValueError),
}

/// Makes all assignments in a text or, if one is refused, none.
pub fn assign(values: &mut Values, text: &str) -> Result<(), SettingsError> {
    let mut changed = values.clone();
    let mut names = Vec::new();
    for assignment in assignments(text) {
        let assignment = assignment?;
        let name = assignment.name;
        if names.contains(&name) {
            Err(Refusal::Twice { name: short(name) })?;
        }
        assignment.make(&mut changed)?;
        names.push(name);
    }
    *values = changed;
    Ok(())
}

/// The names that a text of assignments assigns, up to the first that cannot be read.
pub fn names(text: &str) -> impl Iterator<Item = &str> {
    assignments(text)
        .flatten()
        .map(|assignment| assignment.name)
}

/// The value that a text of assignments gives a name.
pub fn value<'a>(text: &'a str, name: &str) -> Option<&'a str> {
    let mut made = assignments(text).flatten();
    made.find(|assignment| assignment.name == name)
        .map(|assignment| assignment.value)
}

/// A warning for each assignment in `settings` that no longer holds, because its parameter was set
/// directly afterwards.
pub fn replaced(values: &Values) -> Vec<String> {
    let is_replaced = |assignment: &Assignment| {
        let mut wanted = values.clone();
        assignment.make(&mut wanted).is_ok() && wanted != *values
    };
    let made = assignments(&values.strings[string::SETTINGS]).flatten();
    made.filter(is_replaced)
        .map(|Assignment { name, value }| {
            format!(
                "settings has {name} = {}, but {name} was set to another value afterwards, which \
                 holds; set settings last, or remove the assignment",
                short(value)
            )
        })
        .collect()
}

// ------------------------------------------------------------------ the text

#[derive(Debug, PartialEq)]
struct Assignment<'a> {
    name: &'a str,
    value: &'a str,
}

/// The assignments in a text, up to the first that cannot be read.
fn assignments(text: &str) -> impl Iterator<Item = Result<Assignment<'_>, Refusal>> {
    let mut rest = text;
    iter::from_fn(move || {
        rest = rest.trim_start_matches(|c: char| c == ';' || c.is_whitespace());
        if rest.is_empty() {
            return None;
        }
        let read = first_assignment(rest);
        rest = read.as_ref().map_or("", |(_, rest)| rest);
        Some(read.map(|(assignment, _)| assignment))
    })
}

/// The first assignment in a text, and the text after it.
fn first_assignment(text: &str) -> Result<(Assignment<'_>, &str), Refusal> {
    let no_assignment = || {
        let end = text.find(';').unwrap_or(text.len());
        Refusal::NoAssignment(short(text[..end].trim()))
    };
    let (name, value) = text.split_once('=').ok_or_else(no_assignment)?;
    let (name, value) = (name.trim(), value.trim_start());
    if name.is_empty() || name.contains(';') {
        return Err(no_assignment());
    }
    let Some(quoted) = value.strip_prefix('"') else {
        let (value, rest) = value.split_once(';').unwrap_or((value, ""));
        let value = value.trim();
        return Ok((Assignment { name, value }, rest));
    };
    let open = || Refusal::OpenQuotation(short(name));
    let (value, rest) = quoted.split_once('"').ok_or_else(open)?;
    let (after, rest) = rest.split_once(';').unwrap_or((rest, ""));
    if !after.trim().is_empty() {
        let (name, text) = (short(name), short(after.trim()));
        return Err(Refusal::AfterQuotation { name, text });
    }
    Ok((Assignment { name, value }, rest))
}

/// A text as a message shows it: on one line, and not longer than that.
fn short(text: &str) -> String {
    const LONGEST: usize = 80;
    let shown = text.chars().take(LONGEST);
    let mut shown: String = shown
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if text.chars().nth(LONGEST).is_some() {
        shown.push_str("...");
    }
    shown
}

// ------------------------------------------------------------------ the values

impl Assignment<'_> {
    fn make(&self, values: &mut Values) -> Result<(), Refusal> {
        let real = RealRef::all().find(|r| r.variable().name == self.name);
        let integer = IntegerRef::all().find(|r| r.variable().name == self.name);
        let boolean = BooleanRef::all().find(|r| r.variable().name == self.name);
        let string = StringRef::all().find(|r| r.variable().name == self.name);
        match (real, integer, boolean, string) {
            (Some(real), ..) => self.set_real(values, real),
            (_, Some(integer), ..) => self.set_integer(values, integer),
            (_, _, Some(boolean), _) => self.set_boolean(values, boolean),
            (_, _, _, Some(string)) => self.set_string(values, string),
            _ => Err(unknown(self.name)),
        }
    }

    fn set_real(&self, values: &mut Values, real: RealRef) -> Result<(), Refusal> {
        let Variable { name, unit, .. } = *real.variable();
        if real.variable().causality == Causality::Input {
            return Err(Refusal::Input { name });
        }
        let Ok(value) = self.value.parse() else {
            let kept = format!("{} {unit}", shown(values.reals[real]));
            let remedy = format!("write the number alone, with a decimal point, in {unit}");
            return Err(self.malformed(name, "a number", remedy, kept));
        };
        Ok(values.set_reals(Stage::Configuring, &[real], &[value])?)
    }

    /// An enumeration by the number or the name of its item.
    fn set_integer(&self, values: &mut Values, integer: IntegerRef) -> Result<(), Refusal> {
        let Variable { name, choices, .. } = *integer.variable();
        let place = choices.iter().position(|choice| *choice == self.value);
        let number = place.map_or_else(
            || self.value.parse().ok(),
            |place| i32::try_from(place + 1).ok(),
        );
        let Some(number) = number else {
            let kept = values.integers[integer];
            if choices.is_empty() {
                let remedy = "write an integer alone".to_owned();
                return Err(self.malformed(name, "an integer", remedy, kept.to_string()));
            }
            let list: Vec<String> = (1..)
                .zip(choices)
                .map(|(number, choice)| format!("{number} ({choice})"))
                .collect();
            let meant = did_you_mean(self.value, choices.iter().copied());
            let remedy = format!("set one of {}{meant}", list.join(", "));
            return Err(self.malformed(name, "allowed", remedy, kept.to_string()));
        };
        Ok(values.set_integers(Stage::Configuring, &[integer], &[number])?)
    }

    /// `true` and `false`, however they are capitalised, 1 and 0.
    fn set_boolean(&self, values: &mut Values, boolean: BooleanRef) -> Result<(), Refusal> {
        let name = boolean.variable().name;
        let number = match self.value.to_ascii_lowercase().as_str() {
            "true" => Some(1),
            "false" => Some(0),
            other => other.parse().ok(),
        };
        let Some(number) = number else {
            let kept = values.booleans[boolean].to_string();
            let remedy = "set true or false".to_owned();
            return Err(self.malformed(name, "allowed", remedy, kept));
        };
        Ok(values.set_booleans(Stage::Configuring, &[boolean], &[number])?)
    }

    fn set_string(&self, values: &mut Values, string: StringRef) -> Result<(), Refusal> {
        if string == string::SETTINGS {
            return Err(Refusal::Itself);
        }
        Ok(values.set_strings(Stage::Configuring, &[string], &[self.value])?)
    }

    fn malformed(
        &self,
        name: &'static str,
        what: &'static str,
        mut remedy: String,
        kept: String,
    ) -> Refusal {
        if self.value.contains('=') {
            remedy.push_str("; write ; between assignments");
        }
        Refusal::Malformed {
            name,
            value: short(self.value),
            what,
            remedy,
            kept,
        }
    }
}

fn unknown(name: &str) -> Refusal {
    let mut hint = did_you_mean(name, parameters());
    if hint.is_empty() {
        hint = "; modelDescription.xml lists the parameters".to_owned();
    }
    Refusal::Unknown {
        name: short(name),
        hint,
    }
}

/// The names of the parameters that `settings` can assign.
fn parameters() -> impl Iterator<Item = &'static str> {
    fn names<T>(table: &'static [Variable<T>]) -> impl Iterator<Item = &'static str> {
        let parameters = table.iter().filter(|v| v.causality == Causality::Parameter);
        parameters.map(|v| v.name)
    }
    let all = names(&REALS).chain(names(&INTEGERS));
    let all = all.chain(names(&BOOLEANS)).chain(names(&STRINGS));
    all.filter(|name| *name != string::SETTINGS.variable().name)
}

/// The name that was probably meant, as the end of a sentence. Empty if none is near. The last part
/// of a name counts as the name.
fn did_you_mean(given: &str, names: impl Iterator<Item = &'static str>) -> String {
    const LONGEST: usize = 64;
    if given.len() > LONGEST {
        return String::new();
    }
    let given = given.to_lowercase();
    let distance = |name: &str| {
        let name = name.to_lowercase();
        let last = name.rsplit('.').next().unwrap_or_default();
        strsim::osa_distance(&given, &name).min(strsim::osa_distance(&given, last))
    };
    let nearest = names.map(|name| (distance(name), name)).min();
    let near = nearest.filter(|(distance, _)| *distance <= 1 + given.len() / 4);
    near.map_or_else(String::new, |(_, name)| format!("; did you mean {name}?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> Result<Vec<(&str, &str)>, Refusal> {
        assignments(text)
            .map(|read| read.map(|Assignment { name, value }| (name, value)))
            .collect()
    }

    #[test]
    fn assignments_are_separated_by_semicolons_outside_of_quotation_marks() {
        for (text, expected) in [
            ("", vec![]),
            (" ; \n;", vec![]),
            ("a=1", vec![("a", "1")]),
            (" a.b = 1 ;c=x y; ", vec![("a.b", "1"), ("c", "x y")]),
            ("a = \"x;y = \" ; b = 2", vec![("a", "x;y = "), ("b", "2")]),
            ("a = x\"y; b = ", vec![("a", "x\"y"), ("b", "")]),
            ("a = \"\"", vec![("a", "")]),
            ("a = b = c", vec![("a", "b = c")]),
            ("é = ü;;ö=\"ä\"", vec![("é", "ü"), ("ö", "ä")]),
        ] {
            assert_eq!(read(text).as_ref(), Ok(&expected), "{text}");
        }
    }

    #[test]
    fn text_that_is_no_assignment_is_refused_with_the_form_of_one() {
        for (text, sentence) in [
            (
                "a",
                "\"a\" is no assignment; write NAME = VALUE, with ; between assignments",
            ),
            ("b = 1; a ; c = 2", "\"a\" is no assignment"),
            (" = 2", "\"= 2\" is no assignment"),
            (
                "a = \"x; b = 1",
                "the value of a begins with a quotation mark, but none ends it",
            ),
            (
                "a = \"x\" b = 1",
                "\"b = 1\" follows the quoted value of a; write ;",
            ),
        ] {
            let error = read(text).unwrap_err().to_string();
            assert!(error.starts_with(sentence), "{error}");
        }
    }

    #[test]
    fn a_long_text_is_shortened_in_messages() {
        let error = read(&"ü\n".repeat(1_000_000)).unwrap_err().to_string();
        assert!(error.chars().count() < 200, "{error}");
        let long = "x".repeat(1_000_000);
        let error = assign(&mut Values::default(), &format!("{long} = {long}"));
        assert!(error.unwrap_err().to_string().len() < 250);
    }

    #[test]
    fn slips_in_names_find_the_name() {
        for (given, meant) in [
            ("models.inflw", "models.inflow"),
            ("model.inflow", "models.inflow"),
            ("Geometry.Radius", "geometry.radius"),
            ("driveMode", "drive.mode"),
            ("numberOfBlades", "geometry.numberOfBlades"),
            ("enabled", "flapping.enabled"),
        ] {
            let hint = did_you_mean(given, parameters());
            assert_eq!(hint, format!("; did you mean {meant}?"), "{given}");
        }
        for given in ["", "xyz", "thrust", "propellerEfficiency"] {
            assert_eq!(did_you_mean(given, parameters()), "", "{given}");
        }
    }
}
