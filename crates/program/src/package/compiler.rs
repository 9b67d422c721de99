//! What the compiler and other programs for building say of themselves.

use crate::{Failure, failed, process};
use std::{
    env,
    path::PathBuf,
    process::{Command, Stdio},
    time::Duration,
};

/// How long a program may take to say something, also if cargo must first download crates.
pub const LIMIT: Duration = Duration::from_secs(600);

/// The command rustc.
pub fn command() -> Command {
    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// The folder of the compiler's own libraries and programs.
pub fn sysroot() -> Result<PathBuf, Failure> {
    said_by(command().args(["--print", "sysroot"])).map(PathBuf::from)
}

/// What the compiler says of itself under a heading such as `host`.
pub fn about(heading: &str) -> Result<Option<String>, Failure> {
    let all = said_by(command().arg("-vV"))?;
    let mut entries = all.lines().filter_map(|line| line.split_once(": "));
    Ok(entries
        .find(|(name, _)| *name == heading)
        .map(|(_, entry)| entry.to_owned()))
}

/// What a program prints.
pub fn said_by(command: &mut Command) -> Result<String, Failure> {
    let sentence = format!("cannot run {}", command.get_program().display());
    let (status, said, errors) =
        process::output(command.stderr(Stdio::piped()), LIMIT).map_err(failed(&sentence))?;
    if !status.success() {
        return Err(Failure(format!("{sentence} ({status}): {errors}")));
    }
    Ok(said.trim().to_owned())
}
