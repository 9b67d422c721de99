//! The tables of variables and units, read from their TOML files and checked.

use serde::Deserialize;
use std::{collections::BTreeMap, error::Error, fs};

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Table {
    pub model: Model,
    pub default_experiment: Experiment,
    #[serde(rename = "logCategory")]
    pub log_categories: Vec<LogCategory>,
    /// The arrays of FMI 3.0 whose elements have rows of their own.
    #[serde(rename = "array")]
    pub arrays: Vec<Array>,
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
    pub author: String,
    pub copyright: String,
    pub license: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Experiment {
    pub start_time: f64,
    pub stop_time: f64,
    pub step_size: f64,
    /// Relative tolerance for solvers of Model Exchange.
    pub tolerance: f64,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LogCategory {
    pub name: String,
    pub description: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Array {
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
    /// The integer that FMI passes for it.
    pub value: i32,
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
    pub nominal: Option<f64>,
    pub starts_from: Option<Vec<String>>,
    pub rate_depends_on: Option<Vec<String>>,
    pub count: Option<usize>,
    pub description: String,
    /// Name of the state whose derivative this is. Such a variable is not in the file.
    #[serde(skip)]
    pub derivative_of: Option<String>,
    /// Name of the array that this is an element of, with its `#`.
    #[serde(skip)]
    pub element_of: Option<String>,
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
#[serde(deny_unknown_fields, rename_all = "camelCase")]
pub struct Unit {
    pub name: String,
    #[serde(default)]
    pub base: BTreeMap<String, i32>,
    pub factor: Option<f64>,
    pub per_second: Option<String>,
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

/// The base types of the arrays in which the code keeps values. Enumerations are integers.
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
        let derivatives = table.states().map(|state| table.derivative(state));
        let derivatives = derivatives
            .collect::<Result<Vec<_>, _>>()
            .map_err(|e| format!("{variables}: {e}"))?;
        // The derivatives follow the last state. What is added after it does not change their value
        // references.
        let last = table.variables.iter().rposition(|v| v.nominal.is_some());
        let end = last.map_or(table.variables.len(), |i| i + 1);
        table.variables.splice(end..end, derivatives);
        table.check().map_err(|e| format!("{variables}: {e}"))?;
        Ok(table)
    }

    /// The continuous states, in their order.
    pub fn states(&self) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(|v| v.nominal.is_some())
    }

    /// The derivatives of the states, in their order.
    pub fn derivatives(&self) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(|v| v.derivative_of.is_some())
    }

    pub fn inputs(&self) -> impl Iterator<Item = &Variable> {
        self.variables.iter().filter(|v| v.causality == "input")
    }

    /// The variable that holds the derivative of a state.
    fn derivative(&self, state: &Variable) -> Result<Variable, String> {
        let unit = self
            .units
            .iter()
            .find(|u| Some(&u.name) == state.unit.as_ref());
        let unit = unit.and_then(|u| u.per_second.clone()).ok_or(format!(
            "{}: units.toml has no perSecond for the unit {:?} of this state; add it, for the derivative",
            state.name, state.unit
        ))?;
        Ok(Variable {
            name: format!("der({})", state.name),
            causality: "local".into(),
            unit: Some(unit),
            display_unit: None,
            depends_on: state.rate_depends_on.clone(),
            // Without a list of its own it depends on all inputs, states and parameters. With one
            // it depends on parameters by way of its states only.
            parameter_groups: state.rate_depends_on.as_ref().map(|_| Vec::new()),
            nominal: None,
            starts_from: None,
            rate_depends_on: None,
            description: "Derivative in time of the state named in the brackets".into(),
            derivative_of: Some(state.name.clone()),
            element_of: state.element_of.as_ref().map(|row| format!("der({row})")),
            ..state.clone()
        })
    }

    pub fn enumeration(&self, name: &str) -> Option<&Enumeration> {
        self.enumerations.iter().find(|e| e.name == name)
    }

    /// Value reference: the variable's index among those of its base type.
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

    /// The integer for the start value of an enumeration variable.
    pub fn enumeration_start(&self, variable: &Variable) -> Option<i32> {
        let name = variable.start.as_ref()?.as_str()?;
        let items = &self.enumeration(&variable.kind)?.items;
        items.iter().find(|i| i.name == name).map(|i| i.value)
    }

    /// The parameters, or those of one group (the part of the name before the dot).
    pub fn parameters<'a>(&'a self, group: Option<&'a str>) -> impl Iterator<Item = &'a Variable> {
        self.variables.iter().filter(move |v| {
            let own = v.name.split('.').next();
            v.causality == "parameter" && (group.is_none() || own == group)
        })
    }

    fn check(&self) -> Result<(), String> {
        let reals: Vec<&Variable> = self.of_base(Base::Real).collect();
        if !reals.is_sorted_by_key(|v| v.causality != "input") {
            return Err("the Real inputs must come first".into());
        }
        for enumeration in &self.enumerations {
            let numbers = enumeration.items.iter().map(|item| item.value);
            if !numbers.eq(1..=enumeration.items.len() as i32) {
                return Err(format!(
                    "the items of {} must have the numbers 1, 2, 3 ... in this order",
                    enumeration.name
                ));
            }
        }
        for variable in &self.variables {
            let checked = self
                .check_kind(variable)
                .and_then(|()| self.check_start(variable))
                .and_then(|()| self.check_unit(variable))
                .and_then(|()| self.check_dependencies(variable));
            checked.map_err(|e| format!("{}: {e}", variable.name))?;
        }
        Ok(())
    }

    /// Name, type, causality and variability.
    fn check_kind(&self, v: &Variable) -> Result<(), String> {
        if self.variables.iter().filter(|o| o.name == v.name).count() > 1 {
            return Err("the name is used twice".into());
        }
        let is_base_type = ["Real", "Integer", "Boolean", "String"].contains(&v.kind.as_str());
        if !is_base_type && self.enumeration(&v.kind).is_none() {
            return Err(format!(
                "type {:?} is neither a base type nor an enumeration",
                v.kind
            ));
        }
        if !["input", "output", "local", "parameter"].contains(&v.causality.as_str()) {
            return Err(format!("causality {:?} is not known", v.causality));
        }
        if !["continuous", "discrete", "fixed", "tunable"].contains(&v.variability()) {
            return Err(format!("variability {:?} is not known", v.variability()));
        }
        Ok(())
    }

    /// The start value, against type, causality and range.
    fn check_start(&self, v: &Variable) -> Result<(), String> {
        if ["output", "local"].contains(&v.causality.as_str()) == v.start.is_some() {
            return Err("inputs and parameters have a start value, others do not".into());
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
            return Err(format!("start {:?} is not of type {}", v.start, v.kind));
        }
        let start = v.start.as_ref();
        let number = start.and_then(|s| s.as_float().or(s.as_integer().map(|i| i as f64)));
        if let Some(x) = number
            && (v.min.is_some_and(|min| x < min) || v.max.is_some_and(|max| x > max))
        {
            return Err(format!("start {x} is outside min and max"));
        }
        Ok(())
    }

    fn check_unit(&self, v: &Variable) -> Result<(), String> {
        if v.kind != "Real" {
            return Ok(());
        }
        let unit = v.unit.as_ref().ok_or("a Real needs a unit")?;
        let unit = self.units.iter().find(|u| &u.name == unit);
        let unit = unit.ok_or("units.toml does not define its unit")?;
        if let Some(d) = &v.display_unit
            && !unit.display.iter().any(|u| &u.name == d)
        {
            return Err(format!("unit {} has no display unit {d}", unit.name));
        }
        Ok(())
    }

    fn check_dependencies(&self, v: &Variable) -> Result<(), String> {
        let is_state = v.nominal.is_some();
        let is_unknown = v.causality == "output" || is_state || v.derivative_of.is_some();
        let mut dependencies = v.depends_on.iter().chain(&v.rate_depends_on).flatten();
        let is_known = |name: &String| self.inputs().chain(self.states()).any(|k| &k.name == name);
        if let Some(name) = dependencies.find(|name| !is_known(name)) {
            return Err(format!(
                "depends on {name}, which is neither an input nor a state"
            ));
        }
        let mut inputs = v.starts_from.iter().flatten();
        if let Some(name) = inputs.find(|name| !self.inputs().any(|i| &i.name == *name)) {
            return Err(format!("starts from {name}, which is not an input"));
        }
        if !is_unknown && (v.depends_on.is_some() || v.parameter_groups.is_some()) {
            return Err("only outputs and states have dependsOn or parameterGroups".into());
        }
        if !is_state && (v.starts_from.is_some() || v.rate_depends_on.is_some()) {
            return Err(
                "only a state, which has a nominal value, has startsFrom or rateDependsOn".into(),
            );
        }
        if v.nominal.is_some_and(|n| n <= 0.0) || (is_state && v.variability() != "continuous") {
            return Err("a state is a continuous Real with a positive nominal value".into());
        }
        for group in v.parameter_groups.iter().flatten() {
            if self.parameters(Some(group)).next().is_none() {
                return Err(format!(
                    "depends on parameters of the group {group}, which has no parameters"
                ));
            }
        }
        Ok(())
    }
}

impl Variable {
    /// The variables of a row: one, or `count` of them with 1, 2 ... for `#` in the name.
    fn elements(&self) -> Vec<Self> {
        let Some(count) = self.count else {
            return vec![self.clone()];
        };
        let element = |i: usize| {
            let numbered = |name: &String| name.replace('#', &i.to_string());
            let list = |names: &Option<Vec<String>>| {
                names.as_ref().map(|n| n.iter().map(numbered).collect())
            };
            Self {
                name: numbered(&self.name),
                element_of: Some(self.name.clone()),
                depends_on: list(&self.depends_on),
                rate_depends_on: list(&self.rate_depends_on),
                ..self.clone()
            }
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
