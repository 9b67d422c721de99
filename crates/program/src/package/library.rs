//! The shared library that goes into the FMU, built by cargo.

use crate::{Failure, failed, process, sources};
use std::{
    env::{self, consts::DLL_SUFFIX},
    ffi::OsString,
    path::{Path, PathBuf},
    process::Command,
    time::Duration,
};

/// How long cargo may take, also on a slow machine that must first download and compile all crates.
const LIMIT: Duration = Duration::from_secs(3600);

/// Builds the FMU's library for this machine, in the profile of this program, and returns its path.
///
/// `target` is cargo's target folder. Fails if cargo is missing or cannot build. The messages of
/// cargo go to the terminal.
pub fn build(target: &Path) -> Result<PathBuf, Failure> {
    let mut command = Command::new(cargo());
    command.arg("build");
    if !cfg!(debug_assertions) {
        command.arg("--release");
    }
    run(command, target, DLL_SUFFIX)
}

/// The command cargo.
pub fn cargo() -> OsString {
    env::var_os("CARGO").unwrap_or_else(|| "cargo".into())
}

/// Runs a command of cargo that builds the library, and returns its path, which has this ending.
pub fn run(mut command: Command, target: &Path, suffix: &str) -> Result<PathBuf, Failure> {
    command
        .args(["--quiet", "--lib", "--package", "helicopter-rotor"])
        .args(["--message-format", "json-render-diagnostics"])
        .arg("--manifest-path")
        .arg(sources().join("Cargo.toml"))
        .arg("--target-dir")
        .arg(target);
    let (status, messages, _) = process::output(&mut command, LIMIT).map_err(failed(
        "cannot run cargo to build the FMU's library; put cargo on the PATH, or name a built library with --library",
    ))?;
    if !status.success() {
        return Err(Failure(format!(
            "cargo did not build the FMU's library ({status}); see its message above"
        )));
    }
    path_of_library(&messages, suffix).ok_or_else(|| {
        Failure(
            "cargo built the FMU's library, but its messages name no shared library; build it yourself and name it with --library".into(),
        )
    })
}

/// The path of the shared library in cargo's messages, which are one JSON object a line.
fn path_of_library(messages: &str, suffix: &str) -> Option<PathBuf> {
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
        .find(|file| file.to_string_lossy().ends_with(suffix))
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
        assert_eq!(
            path_of_library(&messages, DLL_SUFFIX),
            Some(PathBuf::from(file))
        );
        assert_eq!(path_of_library(&other, DLL_SUFFIX), None);
    }
}
