//! Asking the compiler, and other programs that build, for paths and versions.

use crate::{Failure, failed, process};
use std::{
    env,
    path::PathBuf,
    process::{Command, Stdio},
    time::Duration,
};

/// How long such a program may take, also if cargo must first download crates.
pub const LIMIT: Duration = Duration::from_secs(600);

/// The command rustc.
pub fn command() -> Command {
    Command::new(env::var_os("RUSTC").unwrap_or_else(|| "rustc".into()))
}

/// The folder of the compiler's own libraries and programs.
pub fn sysroot() -> Result<PathBuf, Failure> {
    said_by(command().args(["--print", "sysroot"])).map(PathBuf::from)
}

/// The commit of the compiler's source, if it names one.
pub fn commit() -> Result<Option<String>, Failure> {
    let version = said_by(command().arg("-vV"))?;
    let mut lines = version.lines();
    let commit = lines.find_map(|line| line.strip_prefix("commit-hash: "));
    Ok(commit.map(str::to_owned))
}

/// What a program prints. Fails if its exit status is not 0.
pub fn said_by(command: &mut Command) -> Result<String, Failure> {
    let sentence = format!("cannot run {}", command.get_program().display());
    let (status, said, errors) =
        process::output(command.stderr(Stdio::piped()), LIMIT).map_err(failed(&sentence))?;
    if !status.success() {
        return Err(Failure(format!("{sentence} ({status}): {errors}")));
    }
    Ok(said.trim().to_owned())
}
