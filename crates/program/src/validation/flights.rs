//! Runs the scripts in validation/, with a progress bar.

use crate::{Failure, failed, process, progress, scripts, sources};
use std::{
    path::Path,
    process::{Command, Stdio},
};

/// Flies all cases and writes the results into a folder.
pub fn fly_all(interpreter: &Path, fmu: &Path, folder: &Path) -> Result<(), Failure> {
    let folder_of_scripts = sources().join("validation");
    let mut command = Command::new(interpreter);
    command
        .arg("-u")
        .arg(&folder_of_scripts)
        .arg("--fmu")
        .arg(fmu)
        .arg("--out")
        .arg(folder)
        .stderr(Stdio::piped());
    let bar = progress::bar();
    let (status, message) = process::run(&mut command, scripts::LIMIT, |line| {
        if !progress::moved(&bar, line) {
            bar.println(line);
        }
        Ok(())
    })
    .map_err(failed(format!(
        "cannot run {}",
        folder_of_scripts.display()
    )))?;
    bar.finish_and_clear();
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "a case failed, and no results were written: {message}"
    )))
}
