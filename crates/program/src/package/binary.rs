//! A built library: whether it is one of this FMU for a platform.

use super::{
    macos::{self, BINARIES},
    platform::Platform,
};
use crate::{Failure, files};
use helicopter_rotor::{
    block::variables::{GUID, INSTANTIATION_TOKEN},
    fmi2, fmi3,
};
use object::{Architecture, BinaryFormat, Object};
use std::path::Path;

/// The content of a shared library that has been checked.
#[derive(Debug, Clone)]
pub struct Binary(pub Vec<u8>);

/// Reads a library. It must be one for this platform with the functions of the standard, and must
/// contain GUID and token of the descriptions.
pub fn read(platform: Platform, file: &Path) -> Result<Binary, Failure> {
    // A FIFO or a device may have no end.
    if file.exists() && !file.is_file() {
        return Err(Failure(format!(
            "{} is not a regular file; name a built library",
            file.display()
        )));
    }
    let content = files::read(file)?;
    check(platform, &content).map_err(|fault| Failure(format!("{} {fault}", file.display())))?;
    Ok(Binary(content))
}

/// Fails with what is wrong with the content of a file, as a sentence without its subject.
fn check(platform: Platform, content: &[u8]) -> Result<(), String> {
    let parts = macos::parts(content).map_err(|error| {
        format!("is not a shared library that can be read ({error}); name a built library")
    })?;
    let mut serves_platform = false;
    for part in parts {
        let file = object::File::parse(part).map_err(|error| {
            format!("is not a shared library that can be read ({error}); name a built library")
        })?;
        let (format, processor) = (file.format(), file.architecture());
        let is_wanted = processor == platform.processor();
        serves_platform |= is_wanted;
        let may_be_beside = platform == Platform::Darwin64 && processor == Architecture::Aarch64;
        if format != platform.format() || !(is_wanted || may_be_beside) {
            return Err(format!(
                "is for {}, not for {platform}; name a library that was built for {platform}",
                in_words(format, processor)
            ));
        }
        let has = |token: &str| {
            let mut windows = part.windows(token.len());
            windows.any(|window| window == token.as_bytes())
        };
        if has(BINARIES) {
            return Err("has no code: it re-exports the library in darwin64; name the one in binaries/aarch64-darwin of the .fmu of FMI 3.0".into());
        }
        if !has(GUID) || !has(INSTANTIATION_TOKEN) {
            return Err("was built from another modelDescription.xml than this program; build both again with `cargo build`".into());
        }
        let exports = exports(&file)?;
        for function in fmi2::legality::TABLE.iter().chain(fmi3::legality::TABLE) {
            if !exports.iter().any(|export| *export == function.name) {
                return Err(format!(
                    "does not export {}; name the shared library `helicopter_rotor` that cargo has built",
                    function.name
                ));
            }
        }
    }
    if !serves_platform {
        return Err(format!(
            "has no part for {platform}; name a library that was built for {platform}"
        ));
    }
    Ok(())
}

/// The names of the exported functions, as in C.
fn exports(file: &object::File<'_>) -> Result<Vec<String>, String> {
    let exports = file
        .exports()
        .map_err(|error| format!("has no readable list of exports ({error}); build it again"))?;
    let names = exports.filter_map(|export| match export.ok()?.name() {
        object::NameOrOrdinal::Name(name) => Some(String::from_utf8_lossy(name).into_owned()),
        _ => None,
    });
    // Mach-O puts an underscore before names of C.
    let underscore = match file.format() {
        BinaryFormat::MachO => "_",
        _ => "",
    };
    Ok(names
        .map(|name| name.strip_prefix(underscore).unwrap_or(&name).to_owned())
        .collect())
}

fn in_words(format: BinaryFormat, processor: Architecture) -> String {
    let system = match format {
        BinaryFormat::Elf => "Linux",
        BinaryFormat::Pe => "Windows",
        BinaryFormat::MachO => "macOS",
        _ => "another system",
    };
    format!("{system} on {processor:?}")
}
