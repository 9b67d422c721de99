//! Flies every measured case with the packaged FMU in FMPy and keeps docs/validation.md, its
//! figures and the README's summary as they come out: validation/ has the cases, this the way from
//! there into the docs.
//!
//! * `cases.rs`: runs the scripts, with a progress bar
//! * `publish.rs`: the files in docs/ and the README that follow from a run
//! * `compare.rs`: two texts with numbers, within the rounding of what is printed

mod cases;
mod compare;
mod publish;

use crate::{Failure, failed, package, python};
use std::{
    fs,
    path::{Path, PathBuf},
};

/// What is done with the fresh page.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Purpose {
    /// docs/validation.md, docs/validation/ and the README are written anew.
    Write,
    /// They are compared with it, number by number within the last printed digit; nothing of them
    /// is written.
    Check,
}

/// Flies all cases. `out` gets the FMU that was flown, the page, figures, errors.csv and
/// element-times.csv: all of a run that succeeded, or what it had before.
pub fn run(out: &Path, library: &Path, target: &Path, purpose: Purpose) -> Result<(), Failure> {
    publish::ready()?;
    only_a_run(out)?;
    let interpreter = python::environment(target)?;
    let fresh = beside(out)?;
    let done = fly_into(&fresh, library, &interpreter);
    let done = done.and_then(|()| replace_folder(&fresh, out));
    if fresh.exists() {
        // What went wrong is told; a left-over that cannot be removed adds nothing to it.
        let _ = fs::remove_dir_all(&fresh);
    }
    done?;
    match purpose {
        Purpose::Write => publish::write(out)?,
        Purpose::Check => publish::check(out)?,
    }
    println!("Errors, one a row: {}", out.join("errors.csv").display());
    println!(
        "Time per solve by elements: {}",
        out.join("element-times.csv").display()
    );
    Ok(())
}

fn fly_into(folder: &Path, library: &Path, interpreter: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(failed(format!("cannot make {}", folder.display())))?;
    let fmu = folder.join("HelicopterRotor.fmu");
    package::write(&fmu, library)?;
    cases::fly_all(interpreter, &fmu, folder)
}

/// Refuses a folder that has other things than a run's, because it is replaced as a whole.
fn only_a_run(folder: &Path) -> Result<(), Failure> {
    const OF_A_RUN: [&str; 6] = [
        "HelicopterRotor.fmu",
        "errors.csv",
        "element-times.csv",
        "summary.md",
        "validation.md",
        "validation",
    ];
    let cannot = || format!("cannot list {}", folder.display());
    if !folder.exists() {
        return Ok(());
    }
    for entry in fs::read_dir(folder).map_err(failed(cannot()))? {
        let name = entry.map_err(failed(cannot()))?.file_name();
        if !OF_A_RUN.iter().any(|known| name == *known) {
            return Err(Failure(format!(
                "{} has {}, which is not of an earlier run; name a folder of its own, because it is replaced",
                folder.display(),
                name.to_string_lossy()
            )));
        }
    }
    Ok(())
}

/// A folder of this process beside another, on the same file system.
fn beside(folder: &Path) -> Result<PathBuf, Failure> {
    let name = folder
        .file_name()
        .ok_or_else(|| Failure(format!("{} names no folder", folder.display())))?;
    let id = std::process::id();
    Ok(folder.with_file_name(format!(".{}.{id}.tmp", name.to_string_lossy())))
}

/// Puts a folder in the place of another.
fn replace_folder(from: &Path, to: &Path) -> Result<(), Failure> {
    let cannot = || format!("cannot put {} in its place", to.display());
    let old = to.with_extension(format!("{}.old", std::process::id()));
    let had = to.exists();
    if had {
        fs::rename(to, &old).map_err(failed(cannot()))?;
    }
    if let Err(error) = fs::rename(from, to) {
        if had {
            // The error below is what matters; the old folder is still there under its other name.
            let _ = fs::rename(&old, to);
        }
        return Err(failed(cannot())(error));
    }
    if had {
        fs::remove_dir_all(&old)
            .map_err(failed(format!("cannot remove the old {}", old.display())))?;
    }
    Ok(())
}
