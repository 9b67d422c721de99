//! The Python environment of the examples and of validation/: a virtual environment in the target
//! folder, made again when fmu-examples/requirements.txt changes.

use crate::{
    Failure,
    draft::replace_file,
    failed,
    files::{make_folder, read_text},
    scripts::examples,
};
use indicatif::ProgressBar;
use std::{
    fs::{self, File},
    path::{Path, PathBuf},
    process::Command,
    time::Duration,
};

/// The path of the environment's interpreter. Makes the environment if it is missing or was made
/// from other requirements.
pub fn environment(target: &Path) -> Result<PathBuf, Failure> {
    let folder = target.join("python");
    let interpreter = folder.join("bin").join("python");
    let installed = folder.join("requirements.txt");
    let requirements = examples().join("requirements.txt");
    let wanted = read_text(&requirements)?;

    let _lock = lock(target)?;
    let is_current = fs::read_to_string(&installed).is_ok_and(|found| found == wanted);
    if is_current && interpreter.is_file() {
        return Ok(interpreter);
    }
    make(&folder, &interpreter, &requirements)?;
    // Written last: an environment without this file is not complete and is made again.
    replace_file(&installed, wanted.as_bytes())?;
    Ok(interpreter)
}

/// Waits until no other process makes the environment. The lock ends when it is dropped.
fn lock(target: &Path) -> Result<File, Failure> {
    make_folder(target)?;
    let path = target.join("python.lock");
    let file = File::create(&path).map_err(failed(format!("cannot make {}", path.display())))?;
    file.lock()
        .map_err(failed(format!("cannot lock {}", path.display())))?;
    Ok(file)
}

/// Makes the environment in a folder and installs the requirements.
fn make(folder: &Path, interpreter: &Path, requirements: &Path) -> Result<(), Failure> {
    let python = system_python()?;
    let spinner = ProgressBar::new_spinner();
    spinner.enable_steady_tick(Duration::from_millis(120));
    spinner.set_message("making the Python environment (only once) ...");
    if folder.exists() {
        fs::remove_dir_all(folder)
            .map_err(failed(format!("cannot replace {}", folder.display())))?;
    }
    run_quietly(
        Command::new(python).args(["-m", "venv"]).arg(folder),
        "cannot make a Python environment; on Debian or Ubuntu, install the package python3-venv",
    )?;
    spinner.set_message("installing FMPy, Matplotlib and SciPy (only once, about a minute) ...");
    run_quietly(
        Command::new(interpreter)
            .args(["-m", "pip", "install", "--quiet"])
            .args(["--disable-pip-version-check", "-r"])
            .arg(requirements),
        "cannot install the Python packages in fmu-examples/requirements.txt; check the connection to PyPI",
    )?;
    spinner.finish_and_clear();
    Ok(())
}

/// The name of an interpreter of version 3.10 or later.
fn system_python() -> Result<&'static str, Failure> {
    const MISSING: &str = "python3 (3.10 or later) is missing, in which FMPy flies the FMU";
    let check = "import sys; print(sys.version.split()[0]); sys.exit(sys.version_info < (3, 10))";
    let found = Command::new("python3").args(["-c", check]).output();
    match found {
        Ok(output) if output.status.success() => Ok("python3"),
        Ok(output) => {
            let version = String::from_utf8_lossy(&output.stdout).trim().to_owned();
            Err(Failure(format!(
                "{MISSING}; the one on the PATH is {version}; install a later one and run this again"
            )))
        }
        Err(error) => Err(Failure(format!(
            "{MISSING} ({error}); install it and run this again"
        ))),
    }
}

/// Runs a command. If it fails, the error is `sentence` followed by the output of the command.
fn run_quietly(command: &mut Command, sentence: &str) -> Result<(), Failure> {
    let output = command.output().map_err(failed(sentence))?;
    if output.status.success() {
        return Ok(());
    }
    let words = [output.stdout.as_slice(), output.stderr.as_slice()].concat();
    Err(Failure(format!(
        "{sentence}\n{}",
        String::from_utf8_lossy(&words).trim()
    )))
}
