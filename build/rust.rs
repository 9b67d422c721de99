//! The Rust constants that the code uses: one static array of variables for each FMI base type, the
//! value references by name, and a Rust enumeration for each enumeration of the table.

use crate::{
    arrays::{BLOCK, Grouped, TIME},
    dependencies::{Dependency, Phase, of_grouped},
    table::{Base, Enumeration, Table, Variable},
};
use std::{
    collections::BTreeMap,
    fmt::{self, Write},
};

pub fn constants(
    table: &Table,
    grouped: &[Grouped],
    guid: &str,
    token: &str,
) -> Result<String, fmt::Error> {
    let mut text = String::new();
    let out = &mut text;
    identification(out, table, guid, token)?;
    variables(out, table)?;
    continuous_states(out, table)?;
    arrays(out, grouped)?;
    dependencies(out, table, grouped)?;
    for enumeration in &table.enumerations {
        rust_enumeration(out, enumeration)?;
    }
    Ok(text)
}

/// The GUID and the token, the model identifier and the log categories.
fn identification(out: &mut String, table: &Table, guid: &str, token: &str) -> fmt::Result {
    writeln!(out, "/// Fingerprint of modelDescription.xml of FMI 2.0.")?;
    writeln!(out, "pub const GUID: &str = {guid:?};")?;
    writeln!(out, "/// Fingerprint of modelDescription.xml of FMI 3.0.")?;
    writeln!(out, "pub const INSTANTIATION_TOKEN: &str = {token:?};")?;
    writeln!(out, "/// `modelIdentifier` of modelDescription.xml.")?;
    writeln!(
        out,
        "pub const MODEL_IDENTIFIER: &str = {:?};",
        table.model.model_name
    )?;
    let categories: Vec<&str> = table
        .log_categories
        .iter()
        .map(|c| c.name.as_str())
        .collect();
    writeln!(out, "/// The log categories of modelDescription.xml.")?;
    writeln!(
        out,
        "pub const LOG_CATEGORIES: [&str; {}] = {categories:?};",
        categories.len()
    )
}

/// For each base type the array of its variables, and a module of their value references.
fn variables(out: &mut String, table: &Table) -> fmt::Result {
    for (base, module, array, rust_type, reference) in [
        (Base::Real, "real", "REALS", "f64", "RealRef"),
        (Base::Integer, "integer", "INTEGERS", "i32", "IntegerRef"),
        (Base::Boolean, "boolean", "BOOLEANS", "bool", "BooleanRef"),
        (
            Base::String,
            "string",
            "STRINGS",
            "&'static str",
            "StringRef",
        ),
    ] {
        let variables: Vec<&Variable> = table.of_base(base).collect();
        writeln!(out, "/// Variables of this base type, by value reference.")?;
        writeln!(
            out,
            "pub static {array}: [Variable<{rust_type}>; {}] = [",
            variables.len()
        )?;
        for v in &variables {
            writeln!(out, "    {},", row(table, v))?;
        }
        writeln!(out, "];")?;
        writeln!(out, "/// Value references, which are indices of `{array}`.")?;
        writeln!(out, "pub mod {module} {{")?;
        writeln!(out, "    use super::{reference};")?;
        references(out, reference, &variables)?;
        writeln!(out, "}}")?;
    }
    writeln!(out, "/// Number of the Real inputs, which come first.")?;
    let inputs = table.of_base(Base::Real);
    writeln!(
        out,
        "pub const INPUTS: usize = {};",
        inputs.filter(|v| v.causality == "input").count()
    )
}

/// A constant for the value reference of each variable, and one for those of each array.
fn references(out: &mut String, reference: &str, variables: &[&Variable]) -> fmt::Result {
    for (i, v) in variables.iter().enumerate() {
        writeln!(out, "    /// {}", doc(&v.description))?;
        writeln!(
            out,
            "    pub const {}: {reference} = {reference}::at({i});",
            constant_name(&v.name)
        )?;
        let Some(array) = &v.element_of else {
            continue;
        };
        let is_first = i == 0 || variables[i - 1].element_of.as_ref() != Some(array);
        if !is_first {
            continue;
        }
        let elements = variables
            .iter()
            .filter(|other| other.element_of.as_ref() == Some(array));
        let names: Vec<String> = elements.map(|v| constant_name(&v.name)).collect();
        writeln!(out, "    /// {}", doc(&v.description))?;
        writeln!(
            out,
            "    pub const {}: [{reference}; {}] = [{}];",
            constant_name(&array.replace("[#]", "")),
            names.len(),
            names.join(", ")
        )?;
    }
    Ok(())
}

fn continuous_states(out: &mut String, table: &Table) -> fmt::Result {
    writeln!(out, "/// The continuous states, in their order.")?;
    writeln!(
        out,
        "pub static STATES: [ContinuousState; {}] = [",
        table.states().count()
    )?;
    for (state, derivative) in table.states().zip(table.derivatives()) {
        writeln!(
            out,
            "    ContinuousState {{ value: real::{}, derivative: real::{}, nominal: {:?} }},",
            constant_name(&state.name),
            constant_name(&derivative.name),
            state.nominal.unwrap_or(1.0)
        )?;
    }
    writeln!(out, "];")
}

/// The value references of FMI 3.0: their blocks, and the arrays.
fn arrays(out: &mut String, grouped: &[Grouped]) -> fmt::Result {
    writeln!(out, "/// Value references of FMI 3.0 for each base type.")?;
    writeln!(out, "pub const BLOCK_OF_REFERENCES: u32 = {BLOCK};")?;
    writeln!(out, "/// The value reference of `time` in FMI 3.0.")?;
    writeln!(out, "pub const TIME_REFERENCE: u32 = {TIME};")?;
    let mut arrays: Vec<&Grouped> = grouped.iter().filter(|v| v.is_array).collect();
    arrays.sort_by_key(|array| array.reference);
    writeln!(
        out,
        "/// The arrays, by the value references of their first elements."
    )?;
    writeln!(out, "pub static ARRAYS: [Array; {}] = [", arrays.len())?;
    for array in arrays {
        writeln!(
            out,
            "    Array {{ name: {:?}, first: {}, count: {} }},",
            array.name,
            array.reference,
            array.elements.len()
        )?;
    }
    writeln!(out, "];")
}

/// The dependencies of the computed variables of FMI 3.0. Equal lists are written once.
fn dependencies(out: &mut String, table: &Table, grouped: &[Grouped]) -> fmt::Result {
    let mut lists: BTreeMap<Vec<Dependency>, usize> = BTreeMap::new();
    let mut rows = String::new();
    let is_computed =
        |v: &&Grouped| ["output", "local"].contains(&v.elements[0].causality.as_str());
    let computed = grouped.iter().filter(is_computed);
    for v in computed.clone() {
        let [initial, running] = [Phase::Initial, Phase::Running].map(|phase| {
            let number = lists.len();
            *lists
                .entry(of_grouped(table, grouped, v, phase))
                .or_insert(number)
        });
        writeln!(
            rows,
            "    Dependencies {{ of: {}, initial: &DEPENDENCIES_{initial}, running: &DEPENDENCIES_{running} }},",
            v.reference
        )?;
    }
    for (list, number) in lists {
        writeln!(
            out,
            "static DEPENDENCIES_{number}: [Dependency; {}] = [",
            list.len()
        )?;
        for Dependency {
            element,
            on,
            element_on,
        } in list
        {
            writeln!(
                out,
                "    Dependency {{ element: {element}, on: {on}, element_on: {element_on} }},"
            )?;
        }
        writeln!(out, "];")?;
    }
    writeln!(out, "/// The dependencies of the computed variables.")?;
    writeln!(
        out,
        "pub static DEPENDENCIES: [Dependencies; {}] = [\n{rows}];",
        computed.count()
    )
}

fn rust_enumeration(out: &mut String, enumeration: &Enumeration) -> fmt::Result {
    writeln!(out, "/// {}", doc(&enumeration.description))?;
    writeln!(out, "#[derive(Clone, Copy, Debug, PartialEq, Eq)]")?;
    writeln!(out, "pub enum {} {{", enumeration.name)?;
    for item in &enumeration.items {
        writeln!(out, "    /// {}", doc(&item.description))?;
        writeln!(out, "    {} = {},", camel(&item.name), item.value)?;
    }
    writeln!(out, "}}")?;
    writeln!(out, "impl {} {{", enumeration.name)?;
    writeln!(out, "    /// The choice for the integer that FMI passes.")?;
    writeln!(
        out,
        "    pub fn from_integer(value: i32) -> Option<Self> {{"
    )?;
    writeln!(out, "        match value {{")?;
    for item in &enumeration.items {
        writeln!(
            out,
            "            {} => Some(Self::{}),",
            item.value,
            camel(&item.name)
        )?;
    }
    writeln!(out, "            _ => None,\n        }}\n    }}\n}}")
}

/// The `Variable` of the array for a variable of the table.
fn row(table: &Table, v: &Variable) -> String {
    let (start, min, max) = match v.base() {
        Base::Real => (
            format!(
                "{:?}",
                v.start.as_ref().and_then(|s| s.as_float()).unwrap_or(0.0)
            ),
            v.min
                .map_or("f64::NEG_INFINITY".into(), |x| format!("{x:?}")),
            v.max.map_or("f64::INFINITY".into(), |x| format!("{x:?}")),
        ),
        Base::Boolean => (
            v.start
                .as_ref()
                .and_then(|s| s.as_bool())
                .unwrap_or(false)
                .to_string(),
            "false".into(),
            "true".into(),
        ),
        Base::String => (
            format!(
                "{:?}",
                v.start.as_ref().and_then(|s| s.as_str()).unwrap_or("")
            ),
            "\"\"".into(),
            "\"\"".into(),
        ),
        Base::Integer => {
            let enumeration = table.enumeration(&v.kind);
            let start = match table.enumeration_start(v) {
                Some(value) => i64::from(value),
                // Before it is computed, an output of an enumeration type is its first item.
                None if enumeration.is_some() => 1,
                None => v.start.as_ref().and_then(|s| s.as_integer()).unwrap_or(0),
            };
            let last = enumeration.map(|e| e.items.len() as f64);
            let first = enumeration.map(|_| 1.0);
            (
                start.to_string(),
                (first.or(v.min).unwrap_or(f64::from(i32::MIN)) as i32).to_string(),
                (last.or(v.max).unwrap_or(f64::from(i32::MAX)) as i32).to_string(),
            )
        }
    };
    let choices: Vec<&str> = table
        .enumeration(&v.kind)
        .map(|e| e.items.iter().map(|i| i.name.as_str()).collect())
        .unwrap_or_default();
    format!(
        "Variable {{ name: {:?}, causality: Causality::{}, tunable: {}, is_state: {}, unit: {:?}, start: {start}, min: {min}, max: {max}, choices: &{choices:?} }}",
        v.name,
        camel(&v.causality),
        v.variability() == "tunable",
        v.nominal.is_some(),
        v.unit.as_deref().unwrap_or(""),
    )
}

/// `geometry.radius` -> `GEOMETRY__RADIUS`, `airDensity` -> `AIR_DENSITY`, `force[1]` -> `FORCE_1`,
/// `der(azimuth)` -> `DER_AZIMUTH`. The two underscores distinguish `air.density` from
/// `airDensity`.
fn constant_name(name: &str) -> String {
    let mut constant = String::new();
    for c in name.chars() {
        match c {
            '.' => constant.push_str("__"),
            '[' | '(' => constant.push('_'),
            ']' | ')' => {}
            c if c.is_uppercase() => {
                constant.push('_');
                constant.push(c);
            }
            c => constant.extend(c.to_uppercase()),
        }
    }
    constant
}

/// `karmanTsien` -> `KarmanTsien`.
fn camel(name: &str) -> String {
    let mut chars = name.chars();
    chars
        .next()
        .map(|first| first.to_uppercase().chain(chars).collect())
        .unwrap_or_default()
}

/// A description as documentation of Rust, in which brackets are no links.
fn doc(description: &str) -> String {
    description.replace('[', "\\[").replace(']', "\\]")
}
