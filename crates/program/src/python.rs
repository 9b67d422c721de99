//! The Python environment of the examples and of validation/: a virtual environment in the target
//! folder, made again when fmu-examples/requirements.txt changes.

use crate::{
    Failure,
    draft::replace_file,
    failed,
    files::{make_folder, read_text},
    process, scripts, stop,
};
use indicatif::ProgressBar;
use std::{
    fs::{self, File, TryLockError},
    path::{Path, PathBuf},
    process::{Command, Stdio},
    thread,
    time::Duration,
};

/// How long an interpreter may take to say its version.
const LIMIT_OF_VERSION: Duration = Duration::from_secs(20);
/// To make an environment without packages.
const LIMIT_OF_VENV: Duration = Duration::from_secs(10 * 60);
/// To download and install the packages.
const LIMIT_OF_PIP: Duration = Duration::from_secs(3600);

/// The path of the environment's interpreter. Makes the environment if it is missing, incomplete or
/// was made from other requirements.
pub fn environment(target: &Path) -> Result<PathBuf, Failure> {
    let environment = Environment {
        folder: target.join("python"),
        interpreter: target.join("python").join("bin").join("python"),
        installed: target.join("python").join("requirements.txt"),
        requirements: scripts::examples().join("requirements.txt"),
    };
    let wanted = read_text(&environment.requirements)?;

    let _lock = lock(target)?;
    let is_current = fs::read_to_string(&environment.installed).is_ok_and(|found| found == wanted);
    if is_current && environment.interpreter.is_file() {
        return Ok(environment.interpreter);
    }
    environment.make()?;
    // Written last: an environment without this file is not complete and is made again.
    replace_file(&environment.installed, wanted.as_bytes())?;
    Ok(environment.interpreter)
}

/// Waits until no other process makes the environment. The lock ends when it is dropped.
fn lock(target: &Path) -> Result<File, Failure> {
    make_folder(target)?;
    let path = target.join("python.lock");
    let file = File::create(&path).map_err(failed(format!("cannot make {}", path.display())))?;
    loop {
        match file.try_lock() {
            Ok(()) => return Ok(file),
            Err(TryLockError::WouldBlock) => stop::check()?,
            Err(TryLockError::Error(error)) => {
                return Err(failed(format!("cannot lock {}", path.display()))(error));
            }
        }
        thread::sleep(process::TICK);
    }
}

struct Environment {
    folder: PathBuf,
    interpreter: PathBuf,
    /// The requirements that are installed.
    installed: PathBuf,
    /// Those that should be.
    requirements: PathBuf,
}

impl Environment {
    /// Makes the environment anew, with all packages.
    fn make(&self) -> Result<(), Failure> {
        let python = system_python()?;
        let spinner = spinner("making the Python environment (only once) ...");
        if self.folder.exists() {
            fs::remove_dir_all(&self.folder)
                .map_err(failed(format!("cannot replace {}", self.folder.display())))?;
        }
        let mut venv = Command::new(python);
        process::run_quietly(venv.args(["-m", "venv"]).arg(&self.folder), LIMIT_OF_VENV).map_err(
            failed("cannot make a Python environment; on Debian or Ubuntu, install the package python3-venv"),
        )?;
        spinner.finish_and_clear();
        self.install()
    }

    fn install(&self) -> Result<(), Failure> {
        let spinner =
            spinner("installing FMPy, Matplotlib and SciPy (only once, about a minute) ...");
        let mut pip = Command::new(&self.interpreter);
        pip.args(["-m", "pip", "install", "--quiet"])
            .args(["--disable-pip-version-check", "--no-input"])
            .arg("-r")
            .arg(&self.requirements);
        process::run_quietly(&mut pip, LIMIT_OF_PIP).map_err(failed(
            "cannot install the Python packages in fmu-examples/requirements.txt; check the connection to PyPI",
        ))?;
        spinner.finish_and_clear();
        Ok(())
    }
}

fn spinner(message: &'static str) -> ProgressBar {
    let spinner = ProgressBar::new_spinner();
    spinner.enable_steady_tick(Duration::from_millis(120));
    spinner.set_message(message);
    spinner
}

/// The name of an interpreter of version 3.10 or later.
fn system_python() -> Result<&'static str, Failure> {
    const NEEDED: &str = "python3 (3.10 or later) is needed, in which FMPy flies the FMU";
    let check = "import sys; print(sys.version.split()[0]); sys.exit(sys.version_info < (3, 10))";
    let mut command = Command::new("python3");
    command.args(["-c", check]).stderr(Stdio::piped());
    let (status, version, errors) =
        process::output(&mut command, LIMIT_OF_VERSION).map_err(failed(format!(
            "{NEEDED}; install or repair the one on the PATH and run this again"
        )))?;
    if status.success() {
        return Ok("python3");
    }
    Err(Failure(format!(
        "{NEEDED}; the one on the PATH is {}; install a later one and run this again",
        (version + &errors).trim()
    )))
}
