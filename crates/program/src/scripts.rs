//! The Python scripts of the source tree that fly the FMU and write into a folder.

use crate::{
    Failure,
    draft::{self, Draft},
    failed, files, python, sources,
};
use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// The folder of the examples.
pub fn examples() -> PathBuf {
    sources().join("fmu-examples")
}

/// Flies Knight & Hefner's rotors through their measured range of pitch. The script prints the
/// table and draws the plot beside the FMU.
pub fn fly_knight_hefner(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let folder = fmu.parent().unwrap_or(Path::new("."));
    run(target, &examples().join("knight_hefner.py"), fmu, folder)
}

/// Flies the reference flights, against which importers are checked, and writes their files in the
/// source tree: those that travel in the FMU, and those in the form of the FMI cross-check.
pub fn make_reference_flights(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let script = sources().join("reference-flights").join("make.py");
    // Never published as a whole: its files are, one by one, when all are made.
    let draft = Draft::new(target.join("reference-flights"))?;
    run(target, &script, fmu, &draft.path())?;
    for name in files::names_below(&draft.path())? {
        let content = files::read(&draft.path().join(&name))?;
        draft::replace_file(&sources().join(&name), &content)?;
    }
    Ok(())
}

/// Runs a script. Its output goes to the terminal.
fn run(target: &Path, script: &Path, fmu: &Path, out: &Path) -> Result<(), Failure> {
    let interpreter = python::environment(target)
        .map_err(failed("the .fmu is made, but it cannot be flown here"))?;
    let status = Command::new(interpreter)
        .arg(script)
        .arg("--fmu")
        .arg(fmu)
        .arg("--out")
        .arg(out)
        .status()
        .map_err(failed(format!("cannot run {}", script.display())))?;
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "{} failed ({status}); see its message above",
        script.display()
    )))
}
