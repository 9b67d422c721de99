//! What the tests of the program share: the .fmu that it packages, a folder for files, and its
//! Python environment.

// Each test program uses a part of this.
#![allow(dead_code)]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
    sync::OnceLock,
};

/// The source tree.
pub fn sources() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .unwrap()
}

pub fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_helicopter-rotor"))
}

/// What a command prints; the test fails if the command does.
#[track_caller]
pub fn succeeded(output: &Output) -> String {
    let words = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{words}\n{errors}");
    words
}

/// A folder of this process for the files of its tests; those of ended processes are removed.
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
        succeeded(
            &program()
                .arg("package")
                .arg("--out")
                .arg(&file)
                .output()
                .unwrap(),
        );
        file
    })
}

/// The interpreter of the examples' environment, which is made if need be.
pub fn interpreter() -> &'static Path {
    static INTERPRETER: OnceLock<PathBuf> = OnceLock::new();
    INTERPRETER.get_or_init(|| {
        let words = succeeded(&program().arg("python").output().unwrap());
        PathBuf::from(words.trim())
    })
}

/// A script of the source tree in that environment.
pub fn python(script: &str) -> Command {
    let mut command = Command::new(interpreter());
    command.arg(sources().join(script));
    command
}
