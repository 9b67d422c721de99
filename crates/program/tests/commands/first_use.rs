//! The program in its first use: its help, and its messages when something is missing.

use crate::support::{self, installed};
use std::{fs, process::Command};

#[test]
fn without_python_the_fmu_is_made_and_the_message_names_python() {
    let program = installed("no-python");
    let mut command = Command::new(&program);
    command
        .env("PATH", "")
        .arg("--library")
        .arg(support::library());
    let message = support::fail(&mut command);
    assert!(
        message.contains("the .fmu is made")
            && message.contains("python3 (3.10 or later) is needed"),
        "{message}"
    );
    let target = program.ancestors().nth(2).unwrap();
    let fmu = target.join("fmu/HelicopterRotor.fmu");
    assert!(fmu.metadata().unwrap().len() > 10_000);
}

#[test]
fn help_names_the_commands_and_what_happens_without_one() {
    let help = support::succeed(support::program().arg("--help"));
    for part in [
        "package",
        "reference",
        "python",
        "validate",
        "Without a command",
        "target/fmu/HelicopterRotor.fmu",
        "the link stays",
        "130  ended by Ctrl-C",
    ] {
        assert!(help.contains(part), "{part} is missing in\n{help}");
    }
}

#[test]
fn without_cargo_the_message_says_what_to_do() {
    let program = installed("no-cargo");
    let mut command = Command::new(&program);
    command.env("PATH", "").env_remove("CARGO").arg("package");
    let message = support::fail(&mut command);
    assert!(
        message.contains("cannot run cargo") && message.contains("--library"),
        "{message}"
    );
}

#[test]
fn a_file_that_is_no_library_is_refused() {
    let other = support::scratch().join("other.so");
    fs::write(&other, "no library").unwrap();
    let out = support::scratch().join("other.fmu");
    let mut command = support::program();
    command
        .arg("package")
        .arg("--library")
        .arg(&other)
        .arg("--out")
        .arg(&out);
    let message = support::fail(&mut command);
    assert!(!out.exists());
    assert!(
        message.contains("other.so is not a shared library that can be read"),
        "{message}"
    );
}
