//! An .fmu of one rotor: its defaults are those of a rotor file, which lies in it together with the
//! airfoils beside that file.

use crate::{Failure, failed, files, rotor_file};
use clap::Args;
use helicopter_rotor::block::{
    Reference, Values,
    packaged::{self, Packaged},
    variables::{BooleanRef, IntegerRef, MODEL_IDENTIFIER, RealRef, StringRef},
};
use helicopter_rotor::fmi::legality::Version;
use quick_xml::{
    Reader, Writer,
    escape::unescape,
    events::{BytesStart, Event},
};
use rotor::geometry::{GivenValue, RotorDefinition};
use sha2::{Digest, Sha256};
use std::path::{Component, Path, PathBuf};

#[derive(Args)]
pub struct OwnRotor {
    /// Make an .fmu whose defaults are the rotor in this file, and that contains the file
    #[arg(long, value_name = "FILE")]
    rotor: Option<PathBuf>,
    /// Name of that .fmu and of its model: letters, digits and underscores [default: the rotor
    /// file's name]
    #[arg(long, requires = "rotor")]
    name: Option<String>,
}

/// What makes an .fmu that of one rotor.
#[derive(Debug)]
pub struct Own {
    /// Model name and identifier.
    pub name: String,
    /// The name that the rotor file gives.
    title: Option<String>,
    values: Values,
    /// File name of the rotor file.
    file: String,
    /// What is added to the resources, with the names there.
    pub files: Vec<(String, Vec<u8>)>,
}

impl OwnRotor {
    /// None for the general .fmu.
    pub fn read(&self, resources: &Path) -> Result<Option<Own>, Failure> {
        let Some(path) = &self.rotor else {
            return Ok(None);
        };
        let path =
            std::path::absolute(path).map_err(failed(format!("cannot find {}", path.display())))?;
        let name = match &self.name {
            Some(name) => name.clone(),
            None => identifier(&path),
        };
        check_name(&name)?;
        let definition = RotorDefinition::read(&path).map_err(|e| Failure(e.to_string()))?;
        let file = format!("{name}.toml");
        let values = packaged::defaults_of(&path, &file).map_err(|e| Failure(e.to_string()))?;
        let in_resources = |name: &str| format!("{}/{name}", packaged::FOLDER);
        let mut content = vec![(in_resources(&file), files::read(&path)?)];
        for airfoil in airfoils(&definition) {
            if let Some(own) = packaged::beside(&path, airfoil) {
                check_inside(airfoil, &path)?;
                let name = airfoil.replace('\\', "/");
                content.push((in_resources(&name), files::read(&own)?));
            } else if !is_in(resources, airfoil) {
                return Err(Failure(format!(
                    "{}: the airfoil {airfoil:?} is neither beside the rotor file nor among those of the FMU; put it beside the file, so that it goes into the .fmu",
                    path.display()
                )));
            }
        }
        // What the FMU refuses is no .fmu.
        let mut block = rotor_file::block(&path)?;
        block.start().map_err(|e| Failure(e.to_string()))?;
        Ok(Some(Own {
            name,
            title: definition.name,
            values,
            file,
            files: content,
        }))
    }
}

impl Own {
    /// The description of this .fmu, made from that of the general one, and the text of
    /// `packaged::FILE`, by which the library knows it.
    pub fn describe(&self, xml: &str, version: Version) -> Result<(String, String), Failure> {
        let unnamed = self.rewrite(xml, "")?;
        let guid = guid(&unnamed);
        let packaged = Packaged {
            guid: guid.clone(),
            library: version.token().to_owned(),
            rotor: self.file.clone(),
        };
        Ok((self.rewrite(xml, &guid)?, packaged.text()))
    }

    /// The description with the names, the GUID and the start values of this .fmu.
    fn rewrite(&self, xml: &str, guid: &str) -> Result<String, Failure> {
        let cannot = || "cannot write modelDescription.xml for the rotor";
        let mut reader = Reader::from_str(xml);
        let mut writer = Writer::new(Vec::new());
        let mut variable = String::new();
        loop {
            let event = reader.read_event().map_err(failed(cannot()))?;
            let event = match event {
                Event::Eof => break,
                Event::Start(element) => {
                    Event::Start(self.element(element, guid, &mut variable)?)
                }
                Event::Empty(element) => {
                    Event::Empty(self.element(element, guid, &mut variable)?)
                }
                other => other,
            };
            writer.write_event(event).map_err(failed(cannot()))?;
        }
        String::from_utf8(writer.into_inner()).map_err(failed(cannot()))
    }

    /// An element with new attributes. `variable`: the name of the variable that it belongs to.
    fn element(
        &self,
        element: BytesStart,
        guid: &str,
        variable: &mut String,
    ) -> Result<BytesStart<'static>, Failure> {
        let cannot = || "cannot read modelDescription.xml";
        let tag = element.name().as_ref().to_owned();
        let mut new = BytesStart::new(tag.clone());
        for attribute in element.attributes() {
            let attribute = attribute.map_err(failed(cannot()))?;
            let key = attribute.key.as_ref().to_owned();
            if VARIABLES.contains(&tag.as_str()) && key == "name" {
                (*attribute.value).clone_into(variable);
            }
            let replaced = match (tag.as_str(), key.as_str()) {
                ("fmiModelDescription", "modelName") | (_, "modelIdentifier") => {
                    Some(self.name.clone())
                }
                ("fmiModelDescription", "guid" | "instantiationToken") => Some(guid.to_owned()),
                ("fmiModelDescription", "description") => {
                    let general = unescape(&attribute.value).map_err(failed(cannot()))?;
                    self.title
                        .as_ref()
                        .map(|title| format!("{title}. {general}"))
                }
                (_, "start") | ("Start", "value") => start(&self.values, variable),
                _ => None,
            };
            match replaced {
                Some(text) => new.push_attribute((key.as_str(), text.as_str())),
                None => new.push_attribute(attribute),
            }
        }
        Ok(new)
    }
}

/// The elements that name a variable, in FMI 2.0 and then in FMI 3.0.
const VARIABLES: [&str; 6] = [
    "ScalarVariable",
    "Float64",
    "Int32",
    "Enumeration",
    "Boolean",
    "String",
];

/// The start value of a variable, if it is not that of the general FMU.
fn start(values: &Values, name: &str) -> Option<String> {
    fn find<R: Reference>(
        mut all: impl Iterator<Item = R>,
        name: &str,
        of: fn(R) -> &'static str,
    ) -> Option<R> {
        all.find(|reference| of(*reference) == name)
    }
    let general = Values::default();
    if let Some(r) = find(RealRef::all(), name, |r| r.variable().name) {
        return (values.reals[r] != general.reals[r]).then(|| format!("{:?}", values.reals[r]));
    }
    if let Some(r) = find(IntegerRef::all(), name, |r| r.variable().name) {
        let value = values.integers[r];
        return (value != general.integers[r]).then(|| value.to_string());
    }
    if let Some(r) = find(BooleanRef::all(), name, |r| r.variable().name) {
        let value = values.booleans[r];
        return (value != general.booleans[r]).then(|| value.to_string());
    }
    let r = find(StringRef::all(), name, |r| r.variable().name)?;
    (values.strings[r] != general.strings[r]).then(|| values.strings[r].clone())
}

/// As that of the general FMU: the SHA-256 of the description without a GUID.
fn guid(xml: &str) -> String {
    let digest = Sha256::digest(xml.as_bytes());
    let hex: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
    let parts = [0..8, 8..12, 12..16, 16..20, 20..32].map(|range| &hex[range]);
    format!("{{{}}}", parts.join("-"))
}

/// The airfoils that a rotor file names.
pub fn airfoils(definition: &RotorDefinition) -> impl Iterator<Item = &str> {
    let stations = definition.geometry.airfoils.iter().map(String::as_str);
    let standard = definition
        .given
        .iter()
        .filter_map(|given| match &given.value {
            GivenValue::Text(text) if given.name == "airfoil.file" => Some(text.as_str()),
            _ => None,
        });
    stations.chain(standard).filter(|name| !name.is_empty())
}

/// Whether an airfoil of this name is in the FMU in any case.
pub fn is_in(resources: &Path, airfoil: &str) -> bool {
    let is_relative = Path::new(airfoil).is_relative();
    let places = [resources.join("airfoils"), resources.to_path_buf()];
    is_relative && places.iter().any(|folder| folder.join(airfoil).is_file())
}

/// Refuses an airfoil outside of the rotor file's folder, or one that is named by an absolute path.
fn check_inside(airfoil: &str, path: &Path) -> Result<(), Failure> {
    let is_inside = Path::new(airfoil)
        .components()
        .all(|part| matches!(part, Component::Normal(_) | Component::CurDir));
    if is_inside {
        return Ok(());
    }
    Err(Failure(format!(
        "{}: the airfoil {airfoil:?} is outside of the folder of the rotor file; copy it into that folder and name it by its file name, so that it goes into the .fmu",
        path.display()
    )))
}

/// A name from that of the rotor file.
fn identifier(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    let word = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
    let name: String = stem.chars().map(word).collect();
    if name.starts_with(|c: char| c.is_ascii_digit()) {
        format!("Rotor_{name}")
    } else {
        name
    }
}

/// FMI demands a name of C.
fn check_name(name: &str) -> Result<(), Failure> {
    let begins = name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_');
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    if !begins || !name.chars().all(is_word) || name.len() > 63 {
        return Err(Failure(format!(
            "--name {name:?} is no name of a model; give up to 63 letters (a to z), digits and underscores that begin with a letter"
        )));
    }
    if name == MODEL_IDENTIFIER {
        return Err(Failure(format!(
            "--name {name} is the name of the general FMU; give the rotor's .fmu another one, so that both work in one model"
        )));
    }
    Ok(())
}
