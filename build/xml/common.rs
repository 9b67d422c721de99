//! What modelDescription.xml of FMI 2.0 and of FMI 3.0 share.

use crate::table::{Base, Enumeration, Table, Variable};
use quick_xml::{
    Writer,
    events::{BytesDecl, Event},
};
use sha2::{Digest, Sha256};
use std::io;

pub type Xml = Writer<Vec<u8>>;

/// GUID or token: the SHA-256 of the description without it, in the usual 8-4-4-4-12 digits. The
/// same content gives the same on every platform.
pub fn fingerprint(description: Vec<u8>) -> String {
    let digest = Sha256::digest(description);
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    format!(
        "{{{}-{}-{}-{}-{}}}",
        &hex[0..8],
        &hex[8..12],
        &hex[12..16],
        &hex[16..20],
        &hex[20..32]
    )
}

/// A document, from the function that writes its content.
pub fn document(content: impl FnOnce(&mut Xml) -> io::Result<()>) -> io::Result<Vec<u8>> {
    let mut xml = Writer::new_with_indent(Vec::new(), b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))?;
    content(&mut xml)?;
    let mut bytes = xml.into_inner();
    bytes.push(b'\n');
    Ok(bytes)
}

/// The attributes that the root element has in both versions.
pub fn model<'a>(table: &'a Table, version: &'a str, tool: &'a str) -> [(&'a str, &'a str); 8] {
    [
        ("modelName", &table.model.model_name),
        ("description", &table.model.description),
        ("author", &table.model.author),
        ("version", version),
        ("copyright", &table.model.copyright),
        ("license", &table.model.license),
        ("generationTool", tool),
        ("variableNamingConvention", "structured"),
    ]
}

/// The units, as both versions define them.
pub fn units(xml: &mut Xml, table: &Table) -> io::Result<()> {
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

pub fn log_categories(xml: &mut Xml, table: &Table) -> io::Result<()> {
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

pub fn default_experiment(xml: &mut Xml, table: &Table) -> io::Result<()> {
    let experiment = &table.default_experiment;
    xml.create_element("DefaultExperiment")
        .with_attribute(("startTime", number(experiment.start_time).as_str()))
        .with_attribute(("stopTime", number(experiment.stop_time).as_str()))
        .with_attribute(("tolerance", number(experiment.tolerance).as_str()))
        .with_attribute(("stepSize", number(experiment.step_size).as_str()))
        .write_empty()?;
    Ok(())
}

/// The start value of a variable.
pub fn start_text(table: &Table, v: &Variable) -> Option<String> {
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

/// The shortest text that reads back as the same double.
pub fn number(value: f64) -> String {
    format!("{value:?}")
}

/// The items of an enumeration.
pub fn items(xml: &mut Xml, enumeration: &Enumeration) -> io::Result<()> {
    for item in &enumeration.items {
        xml.create_element("Item")
            .with_attribute(("name", item.name.as_str()))
            .with_attribute(("value", item.value.to_string().as_str()))
            .with_attribute(("description", item.description.as_str()))
            .write_empty()?;
    }
    Ok(())
}

/// The attributes for units, range and nominal value that a variable has.
pub fn units_and_range(v: &Variable) -> Vec<(&'static str, String)> {
    let units = [("unit", &v.unit), ("displayUnit", &v.display_unit)];
    let units = units.map(|(name, unit)| (name, unit.clone()));
    let text = |value: f64| match v.base() {
        Base::Integer => (value as i32).to_string(),
        _ => number(value),
    };
    let range = [("min", v.min), ("max", v.max), ("nominal", v.nominal)];
    let range = range.map(|(name, value)| (name, value.map(text)));
    let all = units.into_iter().chain(range);
    all.filter_map(|(name, value)| Some((name, value?)))
        .collect()
}
