//! The program as a newcomer meets it.

mod support;

use std::{
    fs::{self, File},
    io,
    path::{Path, PathBuf},
    process::Command,
};

/// The program in a target folder of its own, where no environment is made yet.
fn installed(name: &str) -> PathBuf {
    let folder = support::scratch().join(name).join("debug");
    fs::create_dir_all(&folder).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_helicopter-rotor"));
    let copy = folder.join(program.file_name().unwrap());
    fs::copy(program, &copy).unwrap();
    copy
}

/// The shared library in the packaged FMU, as a file.
fn library() -> PathBuf {
    let file = support::scratch().join("library.so");
    let fmu = File::open(support::packaged_fmu()).unwrap();
    let mut archive = zip::ZipArchive::new(fmu).unwrap();
    let mut binary = archive
        .by_name("binaries/linux64/HelicopterRotor.so")
        .unwrap();
    io::copy(&mut binary, &mut File::create(&file).unwrap()).unwrap();
    file
}

#[test]
fn without_python_the_fmu_is_made_and_the_message_says_what_is_missing() {
    let program = installed("no-python");
    let mut command = Command::new(&program);
    command.env("PATH", "").arg("--library").arg(library());
    let output = command.output().unwrap();
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
    let output = support::program().arg("--help").output().unwrap();
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

#[test]
fn without_cargo_the_message_says_what_to_do() {
    let program = installed("no-cargo");
    let mut command = Command::new(&program);
    command.env("PATH", "").env_remove("CARGO").arg("package");
    let output = command.output().unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success());
    assert!(
        words.contains("cannot run cargo") && words.contains("--library"),
        "{words}"
    );
}

/// A library of another description is another FMU's.
#[test]
fn a_library_that_is_not_this_fmus_is_refused() {
    let other = support::scratch().join("other.so");
    fs::write(&other, "not a library of this FMU").unwrap();
    let out = support::scratch().join("other.fmu");
    let mut command = support::program();
    command
        .arg("package")
        .arg("--library")
        .arg(&other)
        .arg("--out")
        .arg(&out);
    let output = command.output().unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success() && !out.exists());
    assert!(
        words.contains("other.so was built from another modelDescription.xml"),
        "{words}"
    );
}
