//! The Python environment of the examples and of validation/: a venv under the target folder, made
//! once for each content of fmu-examples/requirements.txt.

use crate::{Failure, failed, sources};
use indicatif::ProgressBar;
use std::{
    fs::{self, File},
    path::{Path, PathBuf},
    process::{Command, Output},
    time::Duration,
};

/// The examples' folder, in the source tree that this program was built from.
pub fn examples() -> PathBuf {
    sources().join("fmu-examples")
}

/// Path of the environment's interpreter; makes the environment if it is not there, or not there
/// with the present requirements.
pub fn environment(target: &Path) -> Result<PathBuf, Failure> {
    let folder = target.join("python");
    let interpreter = folder.join("bin").join("python");
    let stamp = folder.join("requirements.txt");
    let requirements = examples().join("requirements.txt");
    let wanted = fs::read_to_string(&requirements)
        .map_err(failed(format!("cannot read {}", requirements.display())))?;

    // One process makes it, others wait for it.
    fs::create_dir_all(target).map_err(failed(format!("cannot make {}", target.display())))?;
    let lock_path = target.join("python.lock");
    let lock =
        File::create(&lock_path).map_err(failed(format!("cannot make {}", lock_path.display())))?;
    lock.lock()
        .map_err(failed(format!("cannot lock {}", lock_path.display())))?;
    if fs::read_to_string(&stamp).is_ok_and(|found| found == wanted) && interpreter.is_file() {
        return Ok(interpreter);
    }

    let python = system_python()?;
    let spinner = ProgressBar::new_spinner();
    spinner.enable_steady_tick(Duration::from_millis(120));
    spinner.set_message("making the Python environment (once) ...");
    if folder.exists() {
        fs::remove_dir_all(&folder)
            .map_err(failed(format!("cannot replace {}", folder.display())))?;
    }
    succeed(
        Command::new(python).args(["-m", "venv"]).arg(&folder),
        "cannot make a Python environment; on Debian or Ubuntu, install the package python3-venv",
    )?;
    spinner.set_message("installing FMPy, Matplotlib and SciPy into it (once, about a minute) ...");
    succeed(
        Command::new(&interpreter)
            .args([
                "-m",
                "pip",
                "install",
                "--quiet",
                "--disable-pip-version-check",
                "-r",
            ])
            .arg(&requirements),
        "cannot install the Python packages in fmu-examples/requirements.txt; is PyPI within reach?",
    )?;
    // Written last: an environment without it is made anew.
    fs::write(&stamp, wanted).map_err(failed(format!("cannot write {}", stamp.display())))?;
    spinner.finish_and_clear();
    Ok(interpreter)
}

/// Flies Knight & Hefner's rotors through their measured range of pitch; the script prints the
/// table and writes the plot beside the FMU.
pub fn fly_knight_hefner(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let folder = fmu.parent().unwrap_or(Path::new("."));
    run(target, &examples().join("knight_hefner.py"), fmu, folder)
}

/// Makes the reference inputs and outputs of a few flights, against which an importer is checked:
/// writes the files of the source tree, those that travel in the FMU and those in the form of the
/// FMI cross-check.
pub fn make_reference_flights(fmu: &Path, target: &Path) -> Result<(), Failure> {
    let script = sources().join("reference-flights").join("make.py");
    run(target, &script, fmu, sources())
}

/// Runs a script that flies an FMU and writes into a folder; its words go to the terminal.
fn run(target: &Path, script: &Path, fmu: &Path, out: &Path) -> Result<(), Failure> {
    let interpreter =
        environment(target).map_err(failed("the .fmu is made, but it cannot be flown here"))?;
    let mut command = Command::new(interpreter);
    let status = command
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
        "{} failed ({status}); its own words stand above",
        script.display()
    )))
}

/// The name of an interpreter of version 3.10 or later.
fn system_python() -> Result<&'static str, Failure> {
    const NEEDED: &str = "python3 (3.10 or later) is missing, which flies the FMU in FMPy";
    let check = "import sys; print(sys.version.split()[0]); sys.exit(sys.version_info < (3, 10))";
    let found = Command::new("python3").args(["-c", check]).output();
    match found {
        Ok(output) if output.status.success() => Ok("python3"),
        Ok(output) => {
            let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
            Err(Failure(format!(
                "{NEEDED}; the one on the PATH is {version}"
            )))
        }
        Err(error) => Err(Failure(format!(
            "{NEEDED} ({error}); install it and run this again"
        ))),
    }
}

/// Runs a command to its end; its own words are shown only if it fails.
fn succeed(command: &mut Command, what: &str) -> Result<Output, Failure> {
    let output = command.output().map_err(failed(what))?;
    if output.status.success() {
        return Ok(output);
    }
    let words = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
    Err(Failure(format!(
        "{what}\n{}",
        String::from_utf8_lossy(&words).trim()
    )))
}
