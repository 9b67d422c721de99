//! The files of a rotor: in WebAssembly, where there are no files, those of the FMU's resources are
//! in the library.

use rotor::{
    airfoil::{Airfoil, AirfoilError},
    geometry::{RotorDefinition, RotorFileError},
    hash_of_text,
};
use std::{fs, path::Path};

/// Name below the folder of the resources, and text.
#[cfg(any(target_family = "wasm", test))]
mod built_in {
    include!(concat!(env!("OUT_DIR"), "/resources.rs"));
}

#[cfg(not(any(target_family = "wasm", test)))]
mod built_in {
    pub const TEXTS: &[(&str, &str)] = &[];
}

/// The folder of the resources in the library.
#[cfg(target_family = "wasm")]
const BUILT_IN: Option<&str> = Some("resources");
#[cfg(not(target_family = "wasm"))]
const BUILT_IN: Option<&str> = None;

/// The text of the file at this path, if it is in the library.
fn built_in(folder: Option<&str>, path: &Path) -> Option<&'static str> {
    let name = path.strip_prefix(folder?).ok()?;
    let mut texts = built_in::TEXTS.iter();
    let found = texts.find(|(known, _)| Path::new(known) == name)?;
    Some(found.1)
}

/// The airfoil in a file, and the hash of its text.
pub fn airfoil(path: &Path) -> Result<(Airfoil, u64), AirfoilError> {
    match built_in(BUILT_IN, path) {
        Some(text) => Ok((Airfoil::from_text(text, path)?, hash_of_text(text))),
        None => Airfoil::read_with_hash(path),
    }
}

/// The rotor in a file.
pub fn rotor(path: &Path) -> Result<RotorDefinition, RotorFileError> {
    match built_in(BUILT_IN, path) {
        Some(text) => RotorDefinition::from_text(text, path),
        None => RotorDefinition::read(path),
    }
}

pub fn is_file(path: &Path) -> bool {
    built_in(BUILT_IN, path).is_some() || path.is_file()
}

/// The names of the files in a folder of the resources; none if it cannot be read.
pub fn names(resources: &Path, folder: &str) -> Vec<String> {
    if BUILT_IN.is_some() {
        return built_in_names(folder);
    }
    let entries = fs::read_dir(resources.join(folder)).into_iter().flatten();
    let names = entries.flatten().map(|entry| entry.file_name());
    names.filter_map(|name| name.into_string().ok()).collect()
}

fn built_in_names(folder: &str) -> Vec<String> {
    let names = built_in::TEXTS.iter().map(|(name, _)| name.split_once('/'));
    let inside = names.flatten().filter(|(parent, _)| *parent == folder);
    inside.map(|(_, name)| name.to_owned()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// In WebAssembly the texts are read instead of the files.
    #[test]
    fn the_texts_in_the_library_are_those_of_the_files() {
        let resources = Path::new(concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/modelDescription/resources"
        ));
        for folder in ["airfoils", "rotors"] {
            let mut files = names(resources, folder);
            files.sort();
            assert!(!files.is_empty());
            assert_eq!(built_in_names(folder), files);
            for name in files {
                let text = fs::read_to_string(resources.join(folder).join(&name)).unwrap();
                let path = Path::new("resources").join(folder).join(&name);
                assert_eq!(built_in(Some("resources"), &path), Some(&*text), "{name}");
            }
        }
        for path in ["airfoils/naca0012.polar", "resources/airfoils/none.polar"] {
            assert_eq!(built_in(Some("resources"), Path::new(path)), None);
        }
    }
}
