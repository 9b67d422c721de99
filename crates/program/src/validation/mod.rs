//! The validation: flies every measured case with the packaged FMU in FMPy, and writes or checks
//! docs/validation.md, its figures and the README's summary. The cases are in validation/.
//!
//! * `flights.rs`: runs the cases, with a progress bar
//! * `publish.rs`: the files in docs/ and the README that a run makes
//! * `compare.rs`: compares two texts with numbers, within the rounding of the printed digits

mod compare;
mod flights;
mod publish;

use crate::{
    Failure,
    draft::{Draft, place_of_folder},
    files, output, package, python,
};
use std::path::Path;

/// What is done with the page of a run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// It replaces docs/validation.md, docs/validation/ and the README's summary.
    Write,
    /// They are compared with it, number by number within the last printed digit, and not changed.
    Check,
}

/// Checks, before the flights, which take minutes, that their results can be written.
pub fn check_before(out: &Path) -> Result<(), Failure> {
    publish::check_readme()?;
    refuse_other_files(&place_of_folder(out)?)
}

/// Flies all cases. If all succeed, `out` is replaced by a folder with the FMU that was flown, the
/// page, its figures, errors.csv and element-times.csv. Otherwise `out` is not changed.
pub fn run(out: &Path, library: &Path, target: &Path, purpose: Purpose) -> Result<(), Failure> {
    let interpreter = python::environment(target)?;
    let draft = Draft::new(place_of_folder(out)?)?;
    fly_into(&draft.path(), library, &interpreter)?;
    draft.publish()?;
    match purpose {
        Purpose::Write => publish::write(out)?,
        Purpose::Check => publish::check(out)?,
    }
    output::print(format_args!(
        "Errors of each case: {}",
        out.join("errors.csv").display()
    ))?;
    output::print(format_args!(
        "Time per solution by number of elements: {}",
        out.join("element-times.csv").display()
    ))
}

fn fly_into(folder: &Path, library: &Path, interpreter: &Path) -> Result<(), Failure> {
    let fmu = folder.join("HelicopterRotor.fmu");
    package::write(&fmu, &package::Contents::of_host(library)?)?;
    flights::fly_all(interpreter, &fmu, folder)
}

/// Refuses a folder with files that no run has made, because a run replaces the whole folder.
fn refuse_other_files(folder: &Path) -> Result<(), Failure> {
    const OF_A_RUN: [&str; 6] = [
        "HelicopterRotor.fmu",
        "errors.csv",
        "element-times.csv",
        "summary.md",
        "validation.md",
        "validation",
    ];
    if !folder.exists() {
        return Ok(());
    }
    for path in files::entries(folder)? {
        let name = files::name(&path);
        if !OF_A_RUN.contains(&name.as_str()) {
            return Err(Failure(format!(
                "{} contains {name}, which no earlier run has made; name a folder of its own, because the whole folder is replaced",
                folder.display()
            )));
        }
    }
    Ok(())
}
