//! Where the FMU's resources are: where the importer says, else beside this library.

use crate::{block::path_from_uri, host::library_file::library_file};
use std::path::PathBuf;

/// A folder in our resources, by which they are recognised.
const AIRFOILS: &str = "airfoils";

/// The folder of the resources: the importer's URI (or plain path) if our files are in it, else
/// `resources` beside `binaries/<platform>/`, where this library is.
pub fn resources(location: Option<&str>) -> PathBuf {
    let given = location.map(|text| path_from_uri(text).unwrap_or_else(|| PathBuf::from(text)));
    let ours = given.filter(|path| path.join(AIRFOILS).is_dir());
    if let Some(folder) = ours {
        // Made absolute, so that it stays the same folder if the importer changes the current one.
        return std::path::absolute(&folder).unwrap_or(folder);
    }
    let beside = library_file().and_then(|file| {
        let unpacked = file.parent()?.parent()?.parent()?;
        Some(unpacked.join("resources"))
    });
    beside.unwrap_or_else(|| PathBuf::from("resources"))
}
