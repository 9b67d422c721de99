//! Where the FMU's resources are: where the importer says, else beside this library.

use super::creation::fmi2Instantiate;
use crate::block::path_from_uri;
use std::path::PathBuf;

/// A folder in our resources, by which they are recognised.
const AIRFOILS: &str = "airfoils";

/// The folder of the resources: the importer's URI (or plain path) if our files are in it, else
/// `resources` beside `binaries/<platform>/`, where this library is.
pub fn resources(location: Option<&str>) -> PathBuf {
    let given = location.map(|text| path_from_uri(text).unwrap_or_else(|| PathBuf::from(text)));
    let ours = given.filter(|path| path.join(AIRFOILS).is_dir());
    // Made absolute, so that it stays the same folder if the importer changes the current one.
    if let Some(folder) = ours.and_then(|path| path.canonicalize().ok()) {
        return folder;
    }
    let beside = library_file().and_then(|file| {
        let unpacked = file.parent()?.parent()?.parent()?;
        Some(unpacked.join("resources"))
    });
    beside.unwrap_or_else(|| PathBuf::from("resources"))
}

/// The file of this shared library.
#[cfg(unix)]
fn library_file() -> Option<PathBuf> {
    use std::os::unix::ffi::OsStrExt;
    let address = fmi2Instantiate as *const ();
    // SAFETY: `info` is a plain C structure for which zeros are valid; dladdr writes it.
    let name = unsafe {
        let mut info: libc::Dl_info = std::mem::zeroed();
        if libc::dladdr(address.cast(), &mut info) == 0 || info.dli_fname.is_null() {
            return None;
        }
        std::ffi::CStr::from_ptr(info.dli_fname)
    };
    std::path::Path::new(std::ffi::OsStr::from_bytes(name.to_bytes()))
        .canonicalize()
        .ok()
}

#[cfg(not(unix))]
fn library_file() -> Option<PathBuf> {
    None
}
