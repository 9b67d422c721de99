//! The reference files: inputs and converged outputs of a few flights, against which an importer is checked.

use crate::{Failure, python};
use std::{path::Path, process::Command};

/// Flies the experiments of reference/experiments.py with the .fmu and writes the files of the source tree: those that
/// travel in the FMU, below modelDescription/extra/, and those in the form of the FMI cross-check.
pub fn make(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let interpreter = python::environment(target)?;
    let sources = Path::new(env!("CARGO_MANIFEST_DIR"));
    let script = sources.join("reference").join("make.py");
    python::run(
        Command::new(interpreter)
            .arg(&script)
            .arg("--fmu")
            .arg(fmu)
            .arg("--out")
            .arg(sources),
        &script,
    )
}
