//! The Python scripts of the source tree that fly the FMU and write into a folder.

use crate::{
    Failure,
    draft::{self, Draft},
    failed, files, output, process, python, sources,
};
use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Duration,
};

/// How long a script may fly. They need less than five minutes.
pub const LIMIT: Duration = Duration::from_secs(2 * 3600);

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

/// Runs a script, and prints what it prints.
fn run(target: &Path, script: &Path, fmu: &Path, out: &Path) -> Result<(), Failure> {
    let interpreter = python::environment(target)
        .map_err(failed("the .fmu is made, but it cannot be flown here"))?;
    let mut command = Command::new(interpreter);
    command
        // Each line is to appear when it is printed.
        .arg("-u")
        .arg(script)
        .arg("--fmu")
        .arg(fmu)
        .arg("--out")
        .arg(out)
        // Not shown if the script is ended: a traceback would say nothing.
        .stderr(Stdio::piped());
    let (status, message) = process::run(&mut command, LIMIT, |line| output::print(line))
        .map_err(failed(format!("cannot run {}", script.display())))?;
    if !message.is_empty() {
        output::note(message);
    }
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "{} failed ({status}); see its message above",
        script.display()
    )))
}
