//! The shared library that goes into the FMU: built by cargo, or given by the user.

use crate::{Failure, failed, files, process, sources};
use helicopter_rotor::block::variables::{GUID, MODEL_IDENTIFIER};
use std::{
    env::{self, consts::DLL_SUFFIX},
    path::{Path, PathBuf},
    process::Command,
    time::Duration,
};

/// How long cargo may take, also on a slow machine that must first download and compile all crates.
const LIMIT: Duration = Duration::from_secs(3600);

/// The platform's folder in an FMU (FMI 2.0.5, section 2.3).
#[cfg(all(target_os = "linux", target_arch = "x86_64"))]
const PLATFORM: &str = "linux64";
#[cfg(all(target_os = "macos", target_arch = "x86_64"))]
const PLATFORM: &str = "darwin64";
#[cfg(all(target_os = "windows", target_arch = "x86_64"))]
const PLATFORM: &str = "win64";

/// Builds the FMU's library with cargo, in the profile of this program, and returns its path.
///
/// `target` is cargo's target folder. Fails if cargo is missing or cannot build. The messages of
/// cargo go to the terminal.
pub fn build(target: &Path) -> Result<PathBuf, Failure> {
    let mut command = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()));
    command
        .args(["build", "--quiet", "--lib", "--package", "helicopter-rotor"])
        .args(["--message-format", "json-render-diagnostics"])
        .arg("--manifest-path")
        .arg(sources().join("Cargo.toml"))
        .arg("--target-dir")
        .arg(target);
    if !cfg!(debug_assertions) {
        command.arg("--release");
    }
    let (status, messages, _) = process::output(&mut command, LIMIT).map_err(failed(
        "cannot run cargo to build the FMU's library; put cargo on the PATH, or name a built library with --library",
    ))?;
    if !status.success() {
        return Err(Failure(format!(
            "cargo did not build the FMU's library ({status}); see its message above"
        )));
    }
    path_of_library(&messages).ok_or_else(|| {
        Failure(
            "cargo built the FMU's library, but its messages name no shared library; build it yourself and name it with --library".into(),
        )
    })
}

/// The path of the shared library in cargo's messages, which are one JSON object a line.
fn path_of_library(messages: &str) -> Option<PathBuf> {
    let messages = messages
        .lines()
        .filter_map(|line| serde_json::from_str::<serde_json::Value>(line).ok());
    let files = messages
        .filter(|message| {
            message["reason"] == "compiler-artifact"
                && message["target"]["name"] == "helicopter_rotor"
        })
        .flat_map(|message| message["filenames"].as_array().cloned().unwrap_or_default());
    files
        .filter_map(|file| file.as_str().map(PathBuf::from))
        .find(|file| file.to_string_lossy().ends_with(DLL_SUFFIX))
}

/// The name of the library in the FMU, and its content. It must contain the GUID of the
/// description.
pub fn read(library: &Path) -> Result<(String, Vec<u8>), Failure> {
    // A FIFO or a device may have no end.
    if library.exists() && !library.is_file() {
        return Err(Failure(format!(
            "{} is not a regular file; name a built library",
            library.display()
        )));
    }
    let content = files::read(library)?;
    if !content
        .windows(GUID.len())
        .any(|window| window == GUID.as_bytes())
    {
        return Err(Failure(format!(
            "{} was built from another modelDescription.xml than this program; build both again with `cargo build`",
            library.display()
        )));
    }
    Ok((
        format!("binaries/{PLATFORM}/{MODEL_IDENTIFIER}{DLL_SUFFIX}"),
        content,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_library_is_found_in_the_messages_of_cargo() {
        let file = format!("/target/release/libhelicopter_rotor{DLL_SUFFIX}");
        let artifact = |name: &str| {
            format!(
                r#"{{"reason":"compiler-artifact","target":{{"name":"{name}"}},"filenames":["/target/release/{name}.rlib","{file}"]}}"#
            )
        };
        let other = artifact("rotor");
        let ours = artifact("helicopter_rotor");
        let finished = r#"{"reason":"build-finished","success":true}"#;
        let messages = format!("{other}\n{ours}\nnot JSON\n{finished}\n");
        assert_eq!(path_of_library(&messages), Some(PathBuf::from(file)));
        assert_eq!(path_of_library(&other), None);
    }
}
