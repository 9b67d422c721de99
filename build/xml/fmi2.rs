//! modelDescription.xml of FMI 2.0 (fmi2ModelDescription.xsd) from the table.

use super::common::*;
use crate::{
    dependencies::{initial_knowns, knowns},
    table::{Table, Variable},
};
use std::{collections::BTreeSet, io};

pub fn model_description(table: &Table, version: &str, guid: &str) -> io::Result<Vec<u8>> {
    let tool = format!("helicopter-rotor {version}");
    document(|xml| {
        xml.create_element("fmiModelDescription")
            .with_attributes([("fmiVersion", "2.0"), ("guid", guid)])
            .with_attributes(model(table, version, &tool))
            .with_attribute(("numberOfEventIndicators", "0"))
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
        Ok(())
    })
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

fn types(xml: &mut Xml, table: &Table) -> io::Result<()> {
    xml.create_element("TypeDefinitions")
        .write_inner_content(|xml| {
            for enumeration in &table.enumerations {
                xml.create_element("SimpleType")
                    .with_attribute(("name", enumeration.name.as_str()))
                    .with_attribute(("description", enumeration.description.as_str()))
                    .write_inner_content(|xml| {
                        xml.create_element("Enumeration")
                            .write_inner_content(|xml| items(xml, enumeration))?;
                        Ok(())
                    })?;
            }
            Ok(())
        })?;
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
        for (name, value) in units_and_range(v) {
            inner = inner.with_attribute((name, value.as_str()));
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
