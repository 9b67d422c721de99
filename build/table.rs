//! The tables of variables and units as read from their TOML files, and what they must satisfy.

use serde::Deserialize;
use std::{collections::BTreeMap, error::Error, fs};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Table {
    pub model: Model,
    pub default_experiment: Experiment,
    #[serde(rename = "logCategory")]
    pub log_categories: Vec<LogCategory>,
    #[serde(rename = "enumeration")]
    pub enumerations: Vec<Enumeration>,
    #[serde(rename = "variable")]
    pub variables: Vec<Variable>,
    #[serde(skip)]
    pub units: Vec<Unit>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Model {
    pub model_name: String,
    pub description: String,
    pub license: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Experiment {
    pub start_time: f64,
    pub stop_time: f64,
    pub step_size: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogCategory {
    pub name: String,
    pub description: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Enumeration {
    pub name: String,
    pub description: String,
    pub items: Vec<Item>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Item {
    pub name: String,
    pub description: String,
}

#[derive(Deserialize, Clone)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Variable {
    pub name: String,
    #[serde(rename = "type", default = "real")]
    pub kind: String,
    pub causality: String,
    pub variability: Option<String>,
    pub unit: Option<String>,
    pub display_unit: Option<String>,
    pub start: Option<toml::Value>,
    pub min: Option<f64>,
    pub max: Option<f64>,
    pub depends_on: Option<Vec<String>>,
    pub parameter_groups: Option<Vec<String>>,
    pub count: Option<usize>,
    pub description: String,
}

fn real() -> String {
    "Real".to_owned()
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct UnitFile {
    unit: Vec<Unit>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Unit {
    pub name: String,
    #[serde(default)]
    pub base: BTreeMap<String, i32>,
    pub factor: Option<f64>,
    #[serde(default)]
    pub display: Vec<DisplayUnit>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DisplayUnit {
    pub name: String,
    pub factor: f64,
    pub offset: Option<f64>,
}

/// The FMI base type of a variable: the arrays of values that the code keeps.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Base {
    Real,
    Integer,
    Boolean,
    String,
}

impl Table {
    pub fn read(variables: &str, units: &str) -> Result<Self, Box<dyn Error>> {
        let mut table: Self = toml::from_str(&fs::read_to_string(variables)?)
            .map_err(|e| format!("{variables}: {e}"))?;
        let units: UnitFile =
            toml::from_str(&fs::read_to_string(units)?).map_err(|e| format!("{units}: {e}"))?;
        table.units = units.unit;
        table.variables = table
            .variables
            .iter()
            .flat_map(Variable::elements)
            .collect();
        for variable in &table.variables {
            table
                .check(variable)
                .map_err(|e| format!("{variables}: {}: {e}", variable.name))?;
        }
        Ok(table)
    }

    pub fn enumeration(&self, name: &str) -> Option<&Enumeration> {
        self.enumerations.iter().find(|e| e.name == name)
    }

    /// Value reference: the variable's place among those of its base type.
    pub fn value_reference(&self, variable: &Variable) -> usize {
        self.of_base(variable.base())
            .position(|v| v.name == variable.name)
            .expect("the variable is one of the table's")
    }

    pub fn of_base(&self, base: Base) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(move |v| v.base() == base)
    }

    /// One-based index in ModelVariables, as ModelStructure counts.
    pub fn index(&self, name: &str) -> Option<usize> {
        self.variables
            .iter()
            .position(|v| v.name == name)
            .map(|i| i + 1)
    }

    /// The integer behind an enumeration's start value (items count from 1).
    pub fn enumeration_start(&self, variable: &Variable) -> Option<usize> {
        let name = variable.start.as_ref()?.as_str()?;
        let items = &self.enumeration(&variable.kind)?.items;
        items.iter().position(|i| i.name == name).map(|i| i + 1)
    }

    /// The parameters, or those of one group (the part of the name before the dot).
    pub fn parameters<'a>(&'a self, group: Option<&'a str>) -> impl Iterator<Item = &'a Variable> {
        self.variables.iter().filter(move |v| {
            let own = v.name.split('.').next();
            v.causality == "parameter" && (group.is_none() || own == group)
        })
    }

    fn check(&self, v: &Variable) -> Result<(), String> {
        if self.variables.iter().filter(|o| o.name == v.name).count() > 1 {
            return Err("is written twice".into());
        }
        if !["input", "output", "local", "parameter"].contains(&v.causality.as_str()) {
            return Err(format!("causality {:?} is not known", v.causality));
        }
        if ["output", "local"].contains(&v.causality.as_str()) == v.start.is_some() {
            return Err("inputs and parameters have a start value, others have none".into());
        }
        let start_fits = match (v.kind.as_str(), &v.start) {
            (_, None) => true,
            ("Real", Some(s)) => s.is_float(),
            ("Integer", Some(s)) => s.is_integer(),
            ("Boolean", Some(s)) => s.is_bool(),
            ("String", Some(s)) => s.is_str(),
            _ => self.enumeration_start(v).is_some(),
        };
        if !start_fits {
            return Err(format!("start {:?} is no {}", v.start, v.kind));
        }
        if v.kind == "Real" {
            let unit = v.unit.as_ref().ok_or("has no unit")?;
            let unit = self.units.iter().find(|u| &u.name == unit);
            let unit = unit.ok_or("names a unit that units.toml does not define")?;
            if let Some(d) = &v.display_unit
                && !unit.display.iter().any(|u| &u.name == d)
            {
                return Err(format!("unit {} has no display unit {d}", unit.name));
            }
        }
        for name in v.depends_on.iter().flatten() {
            let inputs = || self.variables.iter().filter(|i| i.causality == "input");
            if v.causality != "output" || !inputs().any(|i| &i.name == name) {
                return Err(format!(
                    "depends on {name}, which only an output may, and on inputs"
                ));
            }
        }
        for group in v.parameter_groups.iter().flatten() {
            if v.causality != "output" || self.parameters(Some(group)).next().is_none() {
                return Err(format!(
                    "depends on parameters of the group {group}, which has none"
                ));
            }
        }
        if !["continuous", "discrete", "fixed", "tunable"].contains(&v.variability()) {
            return Err(format!("variability {:?} is not known", v.variability()));
        }
        let known = ["Real", "Integer", "Boolean", "String"].contains(&v.kind.as_str());
        if !known && self.enumeration(&v.kind).is_none() {
            return Err(format!(
                "type {:?} is neither a base type nor an enumeration",
                v.kind
            ));
        }
        let start = v.start.as_ref();
        let number = start.and_then(|s| s.as_float().or(s.as_integer().map(|i| i as f64)));
        if let Some(x) = number
            && (v.min.is_some_and(|min| x < min) || v.max.is_some_and(|max| x > max))
        {
            return Err(format!("start {x} is out of its own range"));
        }
        Ok(())
    }
}

impl Variable {
    /// The variables behind a row: one, or `count` with 1, 2 ... in place of `#` in the name.
    fn elements(&self) -> Vec<Self> {
        let Some(count) = self.count else {
            return vec![self.clone()];
        };
        let element = |i: usize| Self {
            name: self.name.replace('#', &i.to_string()),
            ..self.clone()
        };
        (1..=count).map(element).collect()
    }

    pub fn base(&self) -> Base {
        match self.kind.as_str() {
            "Real" => Base::Real,
            "Boolean" => Base::Boolean,
            "String" => Base::String,
            _ => Base::Integer,
        }
    }

    pub fn variability(&self) -> &str {
        let default = match (self.causality.as_str(), self.base()) {
            ("parameter", _) => "fixed",
            (_, Base::Real) => "continuous",
            _ => "discrete",
        };
        self.variability.as_deref().unwrap_or(default)
    }
}
