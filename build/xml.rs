//! modelDescription.xml of FMI 2.0 (fmi2ModelDescription.xsd) from the table.

use crate::table::{Base, Table, Variable};
use quick_xml::{
    Writer,
    events::{BytesDecl, Event},
};
use sha2::{Digest, Sha256};
use std::{collections::BTreeSet, io};

/// GUID: the SHA-256 of the description with an empty GUID, in the usual 8-4-4-4-12 digits. The
/// same content gives the same GUID on every platform.
pub fn fingerprint(table: &Table, version: &str) -> io::Result<String> {
    let digest = Sha256::digest(model_description(table, version, "")?);
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    Ok(format!(
        "{{{}-{}-{}-{}-{}}}",
        &hex[0..8],
        &hex[8..12],
        &hex[12..16],
        &hex[16..20],
        &hex[20..32]
    ))
}

type Xml = Writer<Vec<u8>>;

pub fn model_description(table: &Table, version: &str, guid: &str) -> io::Result<Vec<u8>> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    xml.create_element("fmiModelDescription")
        .with_attributes([
            ("fmiVersion", "2.0"),
            ("modelName", table.model.model_name.as_str()),
            ("guid", guid),
            ("description", table.model.description.as_str()),
            ("version", version),
            ("license", table.model.license.as_str()),
            (
                "generationTool",
                format!("helicopter-rotor {version}").as_str(),
            ),
            ("variableNamingConvention", "structured"),
            ("numberOfEventIndicators", "0"),
        ])
        .write_inner_content(|xml| {
            model_exchange(xml, table)?;
            co_simulation(xml, table)?;
            units(xml, table)?;
            types(xml, table)?;
            log_categories(xml, table)?;
            default_experiment(xml, table)?;
            xml.create_element("ModelVariables")
                .write_inner_content(|xml| {
                    table
                        .variables
                        .iter()
                        .try_for_each(|v| variable(xml, table, v))
                })?;
            model_structure(xml, table)
        })?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}

/// The capability flags of both interfaces.
const FLAGS: [(&str, &str); 6] = [
    ("needsExecutionTool", "false"),
    ("canBeInstantiatedOnlyOncePerProcess", "false"),
    ("canNotUseMemoryManagementFunctions", "true"),
    ("canGetAndSetFMUstate", "true"),
    ("canSerializeFMUstate", "true"),
    ("providesDirectionalDerivative", "true"),
];

fn model_exchange(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("ModelExchange")
        .with_attribute(("modelIdentifier", table.model.model_name.as_str()))
        .with_attribute(("completedIntegratorStepNotNeeded", "false"))
        .with_attributes(FLAGS)
        .write_empty()?;
    Ok(())
}

fn co_simulation(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("CoSimulation")
        .with_attributes([
            ("modelIdentifier", table.model.model_name.as_str()),
            ("canHandleVariableCommunicationStepSize", "true"),
            ("canInterpolateInputs", "true"),
            ("maxOutputDerivativeOrder", "1"),
            ("canRunAsynchronuously", "false"),
        ])
        .with_attributes(FLAGS)
        .write_empty()?;
    Ok(())
}

fn units(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("UnitDefinitions")
        .write_inner_content(|xml| {
            for unit in &table.units {
                xml.create_element("Unit")
                    .with_attribute(("name", unit.name.as_str()))
                    .write_inner_content(|xml| {
                        let mut base = xml.create_element("BaseUnit");
                        for (name, exponent) in &unit.base {
                            base =
                                base.with_attribute((name.as_str(), exponent.to_string().as_str()));
                        }
                        if let Some(factor) = unit.factor {
                            base = base.with_attribute(("factor", number(factor).as_str()));
                        }
                        base.write_empty()?;
                        for display in &unit.display {
                            let mut element = xml
                                .create_element("DisplayUnit")
                                .with_attribute(("name", display.name.as_str()))
                                .with_attribute(("factor", number(display.factor).as_str()));
                            if let Some(offset) = display.offset {
                                element =
                                    element.with_attribute(("offset", number(offset).as_str()));
                            }
                            element.write_empty()?;
                        }
                        Ok(())
                    })?;
            }
            Ok(())
        })?;
    Ok(())
}

fn types(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("TypeDefinitions")
        .write_inner_content(|xml| {
            for enumeration in &table.enumerations {
                xml.create_element("SimpleType")
                    .with_attribute(("name", enumeration.name.as_str()))
                    .with_attribute(("description", enumeration.description.as_str()))
                    .write_inner_content(|xml| {
                        xml.create_element("Enumeration")
                            .write_inner_content(|xml| {
                                for item in &enumeration.items {
                                    xml.create_element("Item")
                                        .with_attribute(("name", item.name.as_str()))
                                        .with_attribute(("value", item.value.to_string().as_str()))
                                        .with_attribute(("description", item.description.as_str()))
                                        .write_empty()?;
                                }
                                Ok(())
                            })?;
                        Ok(())
                    })?;
            }
            Ok(())
        })?;
    Ok(())
}

fn log_categories(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("LogCategories")
        .write_inner_content(|xml| {
            for category in &table.log_categories {
                xml.create_element("Category")
                    .with_attribute(("name", category.name.as_str()))
                    .with_attribute(("description", category.description.as_str()))
                    .write_empty()?;
            }
            Ok(())
        })?;
    Ok(())
}

fn default_experiment(xml: &mut Xml, table: &Table) -> io::Result<()> {
    let experiment = &table.default_experiment;
    xml.create_element("DefaultExperiment")
        .with_attribute(("startTime", number(experiment.start_time).as_str()))
        .with_attribute(("stopTime", number(experiment.stop_time).as_str()))
        .with_attribute(("tolerance", number(experiment.tolerance).as_str()))
        .with_attribute(("stepSize", number(experiment.step_size).as_str()))
        .write_empty()?;
    Ok(())
}

fn variable(xml: &mut Xml, table: &Table, v: &Variable) -> io::Result<()> {
    let reference = table.value_reference(v).to_string();
    let mut element = xml.create_element("ScalarVariable").with_attributes([
        ("name", v.name.as_str()),
        ("valueReference", reference.as_str()),
        ("description", v.description.as_str()),
        ("causality", v.causality.as_str()),
        ("variability", v.variability()),
    ]);
    match v.causality.as_str() {
        "output" | "local" => element = element.with_attribute(("initial", "calculated")),
        "parameter" => element = element.with_attribute(("initial", "exact")),
        _ => {}
    }
    element.write_inner_content(|xml| {
        let is_enumeration = table.enumeration(&v.kind).is_some();
        let tag = if is_enumeration {
            "Enumeration"
        } else {
            v.kind.as_str()
        };
        let mut inner = xml.create_element(tag);
        if is_enumeration {
            inner = inner.with_attribute(("declaredType", v.kind.as_str()));
        }
        for (name, value) in [("unit", &v.unit), ("displayUnit", &v.display_unit)] {
            if let Some(value) = value {
                inner = inner.with_attribute((name, value.as_str()));
            }
        }
        for (name, value) in [("min", v.min), ("max", v.max), ("nominal", v.nominal)] {
            if let Some(value) = value {
                let text = match v.base() {
                    Base::Integer => (value as i32).to_string(),
                    _ => number(value),
                };
                inner = inner.with_attribute((name, text.as_str()));
            }
        }
        if let Some(state) = &v.derivative_of {
            let index = table.index(state).unwrap_or_default().to_string();
            inner = inner.with_attribute(("derivative", index.as_str()));
        }
        if let Some(start) = start_text(table, v) {
            inner = inner.with_attribute(("start", start.as_str()));
        }
        inner.write_empty()?;
        Ok(())
    })?;
    Ok(())
}

fn start_text(table: &Table, v: &Variable) -> Option<String> {
    let start = v.start.as_ref()?;
    Some(match v.base() {
        Base::Real => number(start.as_float()?),
        Base::Boolean => start.as_bool()?.to_string(),
        Base::String => start.as_str()?.to_owned(),
        Base::Integer => match table.enumeration_start(v) {
            Some(item) => item.to_string(),
            None => start.as_integer()?.to_string(),
        },
    })
}

/// Outputs and derivatives, with the inputs and states on which they depend. Then the initial
/// unknowns, which are outputs, derivatives and states, with the inputs and parameters on which
/// they depend at the start.
fn model_structure(xml: &mut Xml, table: &Table) -> io::Result<()> {
    let is_output = |v: &&Variable| v.causality == "output";
    let is_initial =
        |v: &&Variable| v.causality == "output" || v.nominal.is_some() || v.derivative_of.is_some();
    let variables = || table.variables.iter();
    xml.create_element("ModelStructure")
        .write_inner_content(|xml| {
            xml.create_element("Outputs").write_inner_content(|xml| {
                let mut outputs = variables().filter(is_output);
                outputs.try_for_each(|v| unknown(xml, table, v, &knowns(table, v)))
            })?;
            xml.create_element("Derivatives")
                .write_inner_content(|xml| {
                    let mut derivatives = table.derivatives();
                    derivatives.try_for_each(|v| unknown(xml, table, v, &knowns(table, v)))
                })?;
            xml.create_element("InitialUnknowns")
                .write_inner_content(|xml| {
                    let mut initial = variables().filter(is_initial);
                    initial.try_for_each(|v| unknown(xml, table, v, &initial_knowns(table, v)))
                })?;
            Ok(())
        })?;
    Ok(())
}

/// The inputs and states on which an output or a derivative depends.
fn knowns<'a>(table: &'a Table, v: &Variable) -> Vec<&'a Variable> {
    let all = table.inputs().chain(table.states());
    all.filter(|known| contains(&v.depends_on, known)).collect()
}

/// The inputs and parameters on which a variable depends at the start, directly or by way of
/// states.
fn initial_knowns<'a>(table: &'a Table, v: &Variable) -> Vec<&'a Variable> {
    if v.nominal.is_some() {
        return from_start(table, v);
    }
    let of_groups = parameters(table, &v.parameter_groups);
    let mut found: Vec<&Variable> = of_groups.collect();
    for known in knowns(table, v) {
        if known.nominal.is_some() {
            found.extend(from_start(table, known));
        } else {
            found.push(known);
        }
    }
    found
}

/// The inputs and parameters on which a state depends at the start.
fn from_start<'a>(table: &'a Table, state: &Variable) -> Vec<&'a Variable> {
    let inputs = table.inputs().filter(|i| contains(&state.starts_from, i));
    inputs
        .chain(parameters(table, &state.parameter_groups))
        .collect()
}

/// Whether a list contains a variable. Without a list all variables are meant.
fn contains(list: &Option<Vec<String>>, variable: &Variable) -> bool {
    list.as_ref().is_none_or(|l| l.contains(&variable.name))
}

/// The parameters of a list of groups, or all parameters without a list.
fn parameters<'a>(
    table: &'a Table,
    groups: &Option<Vec<String>>,
) -> impl Iterator<Item = &'a Variable> {
    table.parameters(None).filter(move |p| {
        let own = p.name.split('.').next().unwrap_or_default();
        groups.as_ref().is_none_or(|g| g.iter().any(|g| g == own))
    })
}

/// Writes an unknown with the indices of its dependencies, in ascending order and each once.
fn unknown(xml: &mut Xml, table: &Table, v: &Variable, known: &[&Variable]) -> io::Result<()> {
    let index = table.index(&v.name).unwrap_or_default().to_string();
    let known: BTreeSet<usize> = known.iter().filter_map(|k| table.index(&k.name)).collect();
    let known: Vec<String> = known.iter().map(usize::to_string).collect();
    xml.create_element("Unknown")
        .with_attribute(("index", index.as_str()))
        .with_attribute(("dependencies", known.join(" ").as_str()))
        .write_empty()?;
    Ok(())
}

/// The shortest text that reads back as the same double.
fn number(value: f64) -> String {
    format!("{value:?}")
}
