//! Shared by the tests of the program: the packaged .fmu, a folder for files, the Python
//! environment, and running commands.

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::OnceLock,
};

/// The source tree.
pub fn sources() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .unwrap()
}

/// The program under test.
pub fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_helicopter-rotor"))
}

/// Runs a command that must succeed, and returns its output.
#[track_caller]
pub fn succeed(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}\n{errors}");
    text
}

/// Runs a command that must fail, and returns its error message.
#[track_caller]
pub fn fail(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(!output.status.success(), "{text}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder for the files of this test process. Folders of ended processes are removed.
pub fn scratch() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let prefix = concat!(env!("CARGO_CRATE_NAME"), "-");
        if Path::new("/proc/self").exists() {
            for entry in fs::read_dir(all).into_iter().flatten().flatten() {
                let name = entry.file_name().to_string_lossy().into_owned();
                let process = name
                    .strip_prefix(prefix)
                    .and_then(|id| id.parse::<u32>().ok());
                if process.is_some_and(|id| !Path::new(&format!("/proc/{id}")).exists()) {
                    // Another process may remove it at the same time.
                    let _ = fs::remove_dir_all(entry.path());
                }
            }
        }
        let folder = all.join(format!("{prefix}{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    })
}

/// The .fmu, packaged once in each process.
pub fn packaged_fmu() -> &'static Path {
    static FILE: OnceLock<PathBuf> = OnceLock::new();
    FILE.get_or_init(|| {
        let file = scratch().join("HelicopterRotor.fmu");
        succeed(program().args(["package", "--out"]).arg(&file));
        file
    })
}

/// The interpreter of the examples' environment, which is made if it is missing.
pub fn interpreter() -> &'static Path {
    static INTERPRETER: OnceLock<PathBuf> = OnceLock::new();
    INTERPRETER.get_or_init(|| {
        let path = succeed(program().arg("python"));
        PathBuf::from(path.trim())
    })
}

/// Runs a script of the source tree in that environment.
pub fn python(script: &str) -> Command {
    let mut command = Command::new(interpreter());
    command.arg(sources().join(script));
    command
}
