//! Finding the shared library that cargo built beside this program.

use crate::{Failure, failed};
use helicopter_rotor::block::variables::{GUID, MODEL_IDENTIFIER};
use std::{
    env::consts::{DLL_PREFIX, DLL_SUFFIX},
    fs,
};

/// The platform's folder in an FMU (FMI 2.0.5, section 2.3).
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
const PLATFORM: &str = "linux64";
#[cfg(all(target_os = "macos", target_arch = "x86_64"))]
const PLATFORM: &str = "darwin64";
#[cfg(all(target_os = "windows", target_arch = "x86_64"))]
const PLATFORM: &str = "win64";

/// The binary's name in the FMU, and its content.
///
/// Cargo leaves the library beside the program or in `deps/` beside it; the newer one is the one
/// that was built with this program. The GUID in it must be that of the description.
pub fn read() -> Result<(String, Vec<u8>), Failure> {
    let program = std::env::current_exe().map_err(failed("cannot find this program's own file"))?;
    let name = format!("{DLL_PREFIX}helicopter_rotor{DLL_SUFFIX}");
    let beside = program.with_file_name(&name);
    let in_deps = program.with_file_name("deps").join(&name);
    let age = |path: &std::path::PathBuf| fs::metadata(path).and_then(|m| m.modified()).ok();
    let newest = [beside, in_deps]
        .into_iter()
        .filter(|p| p.is_file())
        .max_by_key(age);
    let path = newest.ok_or_else(|| {
        Failure(format!(
            "{name} does not lie beside {}; run `cargo build`",
            program.display()
        ))
    })?;
    let content = fs::read(&path).map_err(failed(format!("cannot read {}", path.display())))?;
    if !content
        .windows(GUID.len())
        .any(|window| window == GUID.as_bytes())
    {
        return Err(Failure(format!(
            "{} was built from another modelDescription.xml; run `cargo build` again",
            path.display()
        )));
    }
    Ok((
        format!("binaries/{PLATFORM}/{MODEL_IDENTIFIER}{DLL_SUFFIX}"),
        content,
    ))
}
