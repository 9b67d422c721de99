//! The program as a newcomer meets it.

mod support;

use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// The program and its library in a target folder of their own, where no environment is made yet.
fn installed(name: &str) -> PathBuf {
    let folder = support::fmu::scratch().join(name).join("debug");
    fs::create_dir_all(&folder).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_helicopter-rotor"));
    let copy = folder.join(program.file_name().unwrap());
    fs::copy(program, &copy).unwrap();
    let library = "libhelicopter_rotor.so";
    let built = program.with_file_name("deps").join(library);
    let built = if built.is_file() {
        built
    } else {
        program.with_file_name(library)
    };
    fs::copy(built, folder.join(library)).unwrap();
    copy
}

#[test]
fn without_python_the_fmu_is_made_and_the_message_says_what_is_missing() {
    let program = installed("no-python");
    let output = Command::new(&program).env("PATH", "").output().unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success());
    assert!(
        words.contains("the .fmu is made") && words.contains("python3 (3.10 or later) is missing"),
        "{words}"
    );
    let fmu = program
        .parent()
        .unwrap()
        .parent()
        .unwrap()
        .join("fmu/HelicopterRotor.fmu");
    assert!(fmu.metadata().unwrap().len() > 10_000);
}

#[test]
fn help_names_the_commands_and_what_happens_without_one() {
    let output = Command::new(env!("CARGO_BIN_EXE_helicopter-rotor"))
        .arg("--help")
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stdout);
    for part in [
        "package",
        "reference",
        "python",
        "validate",
        "Without a command",
        "target/fmu/HelicopterRotor.fmu",
    ] {
        assert!(words.contains(part), "{part} is missing in\n{words}");
    }
}
