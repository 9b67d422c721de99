//! The reference files: inputs and converged outputs of a few flights, against which an importer is checked.

use crate::{Failure, python};
use std::path::Path;

/// Flies the experiments of reference/experiments.py with the .fmu and writes the files of the source tree: those that
/// travel in the FMU, below modelDescription/extra/, and those in the form of the FMI cross-check.
pub fn make(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR"));
    let script = sources.join("reference").join("make.py");
    python::run(target, &script, fmu, sources)
}
