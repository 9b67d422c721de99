//! Flies the FMU in FMPy beside measurements, with the examples' own scripts.

use crate::{Failure, failed, python};
use std::{path::Path, process::Command};

/// Flies Knight & Hefner's rotors through their measured range of pitch; the script prints the
/// table and writes the plot beside the FMU.
pub fn knight_hefner(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let interpreter = python::environment(target)
        .map_err(failed("the .fmu is made, but it cannot be flown here"))?;
    let script = python::examples().join("knight_hefner.py");
    let folder = fmu.parent().unwrap_or(Path::new("."));
    python::run(
        Command::new(interpreter)
            .arg(&script)
            .arg("--fmu")
            .arg(fmu)
            .arg("--out")
            .arg(folder),
        &script,
    )
}
