//! modelDescription.xml of FMI 3.0 (fmi3ModelDescription.xsd) from the table.

use super::common::*;
use crate::{
    arrays::{Grouped, TIME},
    dependencies::{Phase, of_grouped},
    table::{Base, Table, Variable},
};
use std::{collections::BTreeSet, io};

pub fn model_description(
    table: &Table,
    variables: &[Grouped],
    version: &str,
    token: &str,
) -> io::Result<Vec<u8>> {
    let tool = format!("helicopter-rotor {version}");
    document(|xml| {
        xml.create_element("fmiModelDescription")
            .with_attributes([("fmiVersion", "3.0"), ("instantiationToken", token)])
            .with_attributes(model(table, version, &tool))
            .write_inner_content(|xml| {
                interfaces(xml, table)?;
                units(xml, table)?;
                types(xml, table)?;
                log_categories(xml, table)?;
                default_experiment(xml, table)?;
                xml.create_element("ModelVariables")
                    .write_inner_content(|xml| {
                        time(xml)?;
                        variables
                            .iter()
                            .try_for_each(|v| variable(xml, table, variables, v))
                    })?;
                model_structure(xml, table, variables)
            })?;
        Ok(())
    })
}

/// The capability flags of both interfaces.
const FLAGS: [(&str, &str); 8] = [
    ("needsExecutionTool", "false"),
    ("canBeInstantiatedOnlyOncePerProcess", "false"),
    ("canGetAndSetFMUState", "true"),
    ("canSerializeFMUState", "true"),
    ("providesDirectionalDerivatives", "true"),
    ("providesAdjointDerivatives", "true"),
    ("providesPerElementDependencies", "true"),
    ("providesEvaluateDiscreteStates", "false"),
];

fn interfaces(xml: &mut Xml, table: &Table) -> io::Result<()> {
    let identifier = ("modelIdentifier", table.model.model_name.as_str());
    xml.create_element("ModelExchange")
        .with_attribute(identifier)
        .with_attributes(FLAGS)
        .with_attribute(("needsCompletedIntegratorStep", "true"))
        .write_empty()?;
    xml.create_element("CoSimulation")
        .with_attribute(identifier)
        .with_attributes(FLAGS)
        .with_attributes([
            ("canHandleVariableCommunicationStepSize", "true"),
            ("maxOutputDerivativeOrder", "1"),
            ("recommendedIntermediateInputSmoothness", "0"),
            ("providesIntermediateUpdate", "true"),
            ("mightReturnEarlyFromDoStep", "true"),
            ("canReturnEarlyAfterIntermediateUpdate", "true"),
            ("hasEventMode", "true"),
        ])
        .write_empty()?;
    Ok(())
}

fn types(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("TypeDefinitions")
        .write_inner_content(|xml| {
            for enumeration in &table.enumerations {
                xml.create_element("EnumerationType")
                    .with_attribute(("name", enumeration.name.as_str()))
                    .with_attribute(("description", enumeration.description.as_str()))
                    .write_inner_content(|xml| items(xml, enumeration))?;
            }
            Ok(())
        })?;
    Ok(())
}

fn time(xml: &mut Xml) -> io::Result<()> {
    xml.create_element("Float64")
        .with_attributes([
            ("name", "time"),
            ("valueReference", TIME.to_string().as_str()),
            ("description", "Time"),
            ("causality", "independent"),
            ("variability", "continuous"),
            ("unit", "s"),
        ])
        .write_empty()?;
    Ok(())
}

fn variable(xml: &mut Xml, table: &Table, all: &[Grouped], grouped: &Grouped) -> io::Result<()> {
    let v = grouped.elements[0];
    let is_enumeration = table.enumeration(&v.kind).is_some();
    let tag = match v.base() {
        Base::Real => "Float64",
        Base::Integer if is_enumeration => "Enumeration",
        Base::Integer => "Int32",
        Base::Boolean => "Boolean",
        Base::String => "String",
    };
    let mut element = xml.create_element(tag).with_attributes([
        ("name", grouped.name.as_str()),
        ("valueReference", grouped.reference.to_string().as_str()),
        ("description", grouped.description),
        ("causality", v.causality.as_str()),
        ("variability", v.variability()),
    ]);
    match v.causality.as_str() {
        "output" | "local" => element = element.with_attribute(("initial", "calculated")),
        "parameter" => element = element.with_attribute(("initial", "exact")),
        _ => {}
    }
    if is_enumeration {
        element = element.with_attribute(("declaredType", v.kind.as_str()));
    }
    if v.variability() == "continuous" && ["input", "output"].contains(&v.causality.as_str()) {
        element = element.with_attribute(("intermediateUpdate", "true"));
    }
    for (name, value) in units_and_range(v) {
        element = element.with_attribute((name, value.as_str()));
    }
    if let Some(state) = &v.derivative_of {
        let has_state = |other: &&Grouped| other.elements[0].name == *state;
        let state = all
            .iter()
            .find(has_state)
            .map_or(0, |other| other.reference);
        element = element.with_attribute(("derivative", state.to_string().as_str()));
    }
    let starts: Vec<String> = grouped
        .elements
        .iter()
        .filter_map(|v| start_text(table, v))
        .collect();
    if v.base() == Base::String {
        element.write_inner_content(|xml| {
            for start in &starts {
                xml.create_element("Start")
                    .with_attribute(("value", start.as_str()))
                    .write_empty()?;
            }
            Ok(())
        })?;
        return Ok(());
    }
    if !starts.is_empty() {
        let are_equal = starts.iter().all(|start| *start == starts[0]);
        let count = if are_equal { 1 } else { starts.len() };
        element = element.with_attribute(("start", starts[..count].join(" ").as_str()));
    }
    if grouped.is_array {
        let length = grouped.elements.len().to_string();
        element.write_inner_content(|xml| {
            xml.create_element("Dimension")
                .with_attribute(("start", length.as_str()))
                .write_empty()?;
            Ok(())
        })?;
    } else {
        element.write_empty()?;
    }
    Ok(())
}

/// Outputs, derivatives and initial unknowns, each with the variables on which it depends.
fn model_structure(xml: &mut Xml, table: &Table, all: &[Grouped]) -> io::Result<()> {
    fn is_output(v: &Variable) -> bool {
        v.causality == "output"
    }
    fn is_derivative(v: &Variable) -> bool {
        v.derivative_of.is_some()
    }
    fn is_initial(v: &Variable) -> bool {
        is_output(v) || is_derivative(v) || v.nominal.is_some()
    }
    type IsListed = fn(&Variable) -> bool;
    const LISTS: [(&str, Phase, IsListed); 3] = [
        ("Output", Phase::Running, is_output),
        ("ContinuousStateDerivative", Phase::Running, is_derivative),
        ("InitialUnknown", Phase::Initial, is_initial),
    ];
    xml.create_element("ModelStructure")
        .write_inner_content(|xml| {
            for (tag, phase, is_listed) in LISTS {
                for unknown in all.iter().filter(|v| is_listed(v.elements[0])) {
                    let knowns = of_grouped(table, all, unknown, phase);
                    let knowns: BTreeSet<u32> = knowns.iter().map(|known| known.on).collect();
                    let knowns: Vec<String> = knowns.iter().map(u32::to_string).collect();
                    xml.create_element(tag)
                        .with_attribute(("valueReference", unknown.reference.to_string().as_str()))
                        .with_attribute(("dependencies", knowns.join(" ").as_str()))
                        .write_empty()?;
                }
            }
            Ok(())
        })?;
    Ok(())
}
