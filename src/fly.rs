//! Flies the FMU in FMPy beside measurements, with the examples' own scripts.

use crate::{Failure, python};
use std::path::Path;

/// Flies Knight & Hefner's rotors through their measured range of pitch; the script prints the
/// table and writes the plot beside the FMU.
pub fn knight_hefner(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let script = python::examples().join("knight_hefner.py");
    let folder = fmu.parent().unwrap_or(Path::new("."));
    python::run(target, &script, fmu, folder)
}
