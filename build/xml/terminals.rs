//! terminalsAndIcons.xml (fmi3TerminalsAndIcons.xsd), which FMUs of both versions carry: FMI 2.0.5
//! allows it, too.

use super::common::{Xml, document};
use crate::arrays::Grouped;
use serde::Deserialize;
use std::{error::Error, fs, io};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Terminals {
    terminal: Vec<Terminal>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Terminal {
    name: String,
    description: String,
    members: Vec<Member>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Member {
    name: String,
    variable: String,
    kind: String,
}

impl Terminals {
    pub fn read(file: &str) -> Result<Self, Box<dyn Error>> {
        let text = fs::read_to_string(file)?;
        Ok(toml::from_str(&text).map_err(|e| format!("{file}: {e}"))?)
    }

    /// The description of terminals and icon. `has_arrays`: as in FMI 3.0.
    pub fn description(&self, all: &[Grouped], has_arrays: bool) -> io::Result<Vec<u8>> {
        document(|xml| {
            xml.create_element("fmiTerminalsAndIcons")
                .with_attribute(("fmiVersion", "3.0"))
                .write_inner_content(|xml| {
                    icon(xml)?;
                    xml.create_element("Terminals").write_inner_content(|xml| {
                        for terminal in &self.terminal {
                            terminal.write(xml, all, has_arrays)?;
                        }
                        Ok(())
                    })?;
                    Ok(())
                })?;
            Ok(())
        })
    }
}

/// The icon fills the coordinate system.
fn icon(xml: &mut Xml) -> io::Result<()> {
    const CORNERS: [(&str, &str); 4] =
        [("x1", "-100"), ("y1", "-100"), ("x2", "100"), ("y2", "100")];
    xml.create_element("GraphicalRepresentation")
        .write_inner_content(|xml| {
            xml.create_element("CoordinateSystem")
                .with_attributes(CORNERS)
                .with_attribute(("suggestedScalingFactorTo_mm", "0.1"))
                .write_empty()?;
            xml.create_element("Icon")
                .with_attributes(CORNERS)
                .write_empty()?;
            Ok(())
        })?;
    Ok(())
}

impl Terminal {
    fn write(&self, xml: &mut Xml, all: &[Grouped], has_arrays: bool) -> io::Result<()> {
        let find = |name: &str| {
            let variable = all.iter().find(|v| v.name == name);
            variable.ok_or_else(|| {
                io::Error::other(format!(
                    "terminal {}: there is no variable {name}",
                    self.name
                ))
            })
        };
        let mut members: Vec<(String, &str, &str)> = Vec::new();
        for Member {
            name,
            variable,
            kind,
        } in &self.members
        {
            let variable = find(variable)?;
            if has_arrays || !variable.is_array {
                members.push((name.clone(), &variable.name, kind));
                continue;
            }
            let elements = variable.elements.iter().enumerate();
            members.extend(elements.map(|(i, element)| {
                let member = format!("{name}[{}]", i + 1);
                (member, element.name.as_str(), kind.as_str())
            }));
        }
        xml.create_element("Terminal")
            .with_attributes([
                ("name", self.name.as_str()),
                ("matchingRule", "bus"),
                ("description", self.description.as_str()),
            ])
            .write_inner_content(|xml| {
                for (member, variable, kind) in &members {
                    xml.create_element("TerminalMemberVariable")
                        .with_attributes([
                            ("variableName", *variable),
                            ("memberName", member.as_str()),
                            ("variableKind", *kind),
                        ])
                        .write_empty()?;
                }
                Ok(())
            })?;
        Ok(())
    }
}
