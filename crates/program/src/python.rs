//! The Python environment of the examples and of validation/: a virtual environment in the target
//! folder. It is made again when fmu-examples/requirements.txt changes, and repaired when a package
//! is missing or broken. Examples that need more packages have environments of their own.

use crate::{
    Failure,
    draft::replace_file,
    failed,
    files::{self, make_folder, read_text},
    output, process, scripts, sources, stop,
};
use indicatif::ProgressBar;
use std::{
    fs::{self, File, TryLockError},
    path::{Path, PathBuf},
    process::{Command, Stdio},
    thread,
    time::Duration,
};

/// The folders of the scripts that run in the environment.
const SCRIPTS: [&str; 4] = [
    "fmu-examples",
    "validation",
    "reference-flights",
    "provenance/descent-law",
];

/// The interpreter in an environment.
const INTERPRETER: &str = match cfg!(windows) {
    true => "Scripts/python.exe",
    false => "bin/python",
};

/// The commands that start an interpreter, the best first. On Windows `python3` is often no
/// interpreter, but opens a shop.
const INTERPRETERS: &[&[&str]] = match cfg!(windows) {
    true => &[&["py", "-3"], &["python"], &["python3"]],
    false => &[&["python3"]],
};

/// What to do where Python makes no environment.
const NO_VENV: &str = match cfg!(target_os = "linux") {
    true => {
        "cannot make a Python environment; on Debian or Ubuntu, install the package python3-venv"
    }
    false => "cannot make a Python environment; install or repair Python",
};

/// How long an interpreter may take to say its version.
const LIMIT_OF_VERSION: Duration = Duration::from_secs(20);
/// To import the packages, also from a slow disk on which they have just been installed.
const LIMIT_OF_IMPORTS: Duration = Duration::from_secs(5 * 60);
/// To make an environment without packages.
const LIMIT_OF_VENV: Duration = Duration::from_secs(10 * 60);
/// To download and install the packages.
const LIMIT_OF_PIP: Duration = Duration::from_secs(3600);

/// The path of the environment's interpreter. Makes the environment if it is missing, incomplete or
/// was made from other requirements, and repairs it if a package cannot be imported.
pub fn environment(target: &Path) -> Result<PathBuf, Failure> {
    let scripts = SCRIPTS.map(|folder| sources().join(folder)).to_vec();
    let requirements = scripts::examples().join("requirements.txt");
    Environment::new(target.join("python"), requirements, scripts).ready(target)
}

/// The same for the scripts in a folder of the examples that has a requirements.txt of its own.
pub fn environment_of(folder: &Path, target: &Path) -> Result<PathBuf, Failure> {
    let name = format!("python-{}", files::name(folder));
    let scripts = vec![scripts::examples(), folder.to_path_buf()];
    let requirements = folder.join("requirements.txt");
    Environment::new(target.join(name), requirements, scripts).ready(target)
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
    /// The folders of the scripts that run in it.
    scripts: Vec<PathBuf>,
}

impl Environment {
    fn new(folder: PathBuf, requirements: PathBuf, scripts: Vec<PathBuf>) -> Environment {
        Environment {
            interpreter: folder.join(INTERPRETER),
            installed: folder.join("requirements.txt"),
            folder,
            requirements,
            scripts,
        }
    }

    /// The path of the interpreter, when the environment is complete.
    fn ready(self, target: &Path) -> Result<PathBuf, Failure> {
        let wanted = read_text(&self.requirements)?;
        let _lock = lock(target)?;
        if fs::read_to_string(&self.installed).is_ok_and(|found| found == wanted) {
            let Some(fault) = self.fault()? else {
                return Ok(self.interpreter);
            };
            output::note(format_args!(
                "{}: {fault}. Installing the packages again ...",
                self.folder.display()
            ));
            // While this file is missing, the environment is not complete and is made again.
            fs::remove_file(&self.installed).map_err(failed(format!(
                "cannot remove {}",
                self.installed.display()
            )))?;
            if !self.repair()? {
                self.make()?;
            }
        } else {
            self.make()?;
        }
        if let Some(fault) = self.fault()? {
            return Err(Failure(format!(
                "{}: {fault}, although the packages have just been installed; see {} for what they are",
                self.folder.display(),
                self.requirements.display()
            )));
        }
        replace_file(&self.installed, wanted.as_bytes())?;
        Ok(self.interpreter)
    }

    /// What is wrong with it: packages that the scripts cannot import, or its interpreter.
    fn fault(&self) -> Result<Option<String>, Failure> {
        let mut command = Command::new(&self.interpreter);
        command
            .args(["-c", include_str!("imports.py")])
            .args(&self.scripts)
            // Matplotlib needs no screen.
            .env("MPLBACKEND", "Agg")
            .stderr(Stdio::piped());
        match process::output(&mut command, LIMIT_OF_IMPORTS) {
            Ok((status, _, _)) if status.success() => Ok(None),
            Ok((_, packages, _)) if !packages.trim().is_empty() => {
                let packages: Vec<_> = packages.lines().collect();
                Ok(Some(format!("cannot import {}", packages.join(", "))))
            }
            Ok((status, _, errors)) => Ok(Some(format!(
                "cannot import the packages ({status}): {errors}"
            ))),
            Err(failure) => {
                stop::check()?;
                Ok(Some(format!("its interpreter fails: {failure}")))
            }
        }
    }

    /// Installs the packages again, first those that are missing, then all. True if all can be
    /// imported then.
    fn repair(&self) -> Result<bool, Failure> {
        for options in [&[][..], &["--force-reinstall"]] {
            if self.install(options).is_ok() && self.fault()?.is_none() {
                return Ok(true);
            }
            stop::check()?;
        }
        Ok(false)
    }

    /// Makes the environment anew, with all packages.
    fn make(&self) -> Result<(), Failure> {
        let python = system_python()?;
        let spinner = spinner("making the Python environment (only once) ...");
        if self.folder.exists() {
            fs::remove_dir_all(&self.folder)
                .map_err(failed(format!("cannot replace {}", self.folder.display())))?;
        }
        let mut venv = command(python);
        process::run_quietly(venv.args(["-m", "venv"]).arg(&self.folder), LIMIT_OF_VENV)
            .map_err(failed(NO_VENV))?;
        spinner.finish_and_clear();
        self.install(&[])
    }

    fn install(&self, options: &[&str]) -> Result<(), Failure> {
        let spinner = spinner("installing Python packages (only once, about a minute) ...");
        let mut pip = Command::new(&self.interpreter);
        pip.args(["-m", "pip", "install", "--quiet"])
            .args(["--disable-pip-version-check", "--no-input"])
            .args(options)
            .arg("-r")
            .arg(&self.requirements);
        process::run_quietly(&mut pip, LIMIT_OF_PIP).map_err(failed(format!(
            "cannot install the Python packages in {}; check the connection to PyPI",
            self.requirements.display()
        )))?;
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

/// The command of an interpreter of version 3.10 or later. If there is none, the error is that of
/// the best.
fn system_python() -> Result<&'static [&'static str], Failure> {
    let mut first_failure = None;
    for interpreter in INTERPRETERS {
        match check_version(interpreter) {
            Ok(()) => return Ok(interpreter),
            Err(failure) => {
                stop::check()?;
                first_failure.get_or_insert(failure);
            }
        }
    }
    Err(first_failure.unwrap_or_else(|| Failure(NEEDED.into())))
}

const NEEDED: &str = "python3 (3.10 or later) is needed, in which FMPy flies the FMU";

fn check_version(interpreter: &[&str]) -> Result<(), Failure> {
    let check = "import sys; print(sys.version.split()[0]); sys.exit(sys.version_info < (3, 10))";
    let mut command = command(interpreter);
    command.args(["-c", check]).stderr(Stdio::piped());
    let (status, version, errors) =
        process::output(&mut command, LIMIT_OF_VERSION).map_err(failed(format!(
            "{NEEDED}; install or repair the one on the PATH and run this again"
        )))?;
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "{NEEDED}; the one on the PATH is {}; install a later one and run this again",
        (version + &errors).trim()
    )))
}

fn command(words: &[&str]) -> Command {
    let mut command = Command::new(words.first().unwrap_or(&"python3"));
    command.args(words.iter().skip(1));
    command
}
