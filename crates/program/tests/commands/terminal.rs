//! The program in a pipe: an output that is full, closed or no longer read.

use crate::support::{self, scratch};
use std::{
    fs::File,
    io::pipe,
    process::{Command, Output},
};

/// A command that prints a line and does nothing that takes long.
fn package(name: &str) -> Command {
    let mut command = support::program();
    command.arg("--library").arg(support::library());
    command.args(["package", "--out"]).arg(scratch().join(name));
    command
}

fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

#[test]
fn a_full_output_ends_with_a_sentence() {
    let mut help = support::program();
    help.arg("--help");
    for mut command in [package("full.fmu"), help] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = command.stdout(full).output().unwrap();
        assert_eq!(output.status.code(), Some(1));
        let errors = errors(&output);
        assert!(
            errors.starts_with("Error: cannot write to the standard output")
                && errors.lines().count() == 1,
            "{errors}"
        );
    }
}

#[test]
fn a_full_output_for_messages_is_no_crash() {
    let full = File::options().write(true).open("/dev/full").unwrap();
    let mut command = support::program();
    let status = command
        .args(["package", "--out", "/"])
        .stderr(full)
        .status();
    assert_eq!(status.unwrap().code(), Some(1));
}

#[test]
fn a_closed_output_is_refused_with_a_sentence_before_any_work() {
    let out = scratch().join("closed.fmu");
    let mut shell = Command::new("sh");
    shell.args(["-c", r#"exec "$0" package --out "$1" >&-"#]);
    let output = shell
        .arg(env!("CARGO_BIN_EXE_helicopter-rotor"))
        .arg(&out)
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(
        errors(&output),
        "Error: the standard output is closed; redirect it to a file or to /dev/null\n"
    );
    assert!(!out.exists());
    // The one that is open and leads nowhere is not closed.
    let null = File::options().read(true).write(true).open("/dev/null");
    assert!(
        package("null.fmu")
            .stdout(null.unwrap())
            .status()
            .unwrap()
            .success()
    );
}

#[test]
fn a_reader_that_has_gone_ends_it_quietly() {
    let (reader, writer) = pipe().unwrap();
    drop(reader);
    let output = package("unread.fmu").stdout(writer).output().unwrap();
    assert_eq!((output.status.code(), &*errors(&output)), (Some(141), ""));
}
