//! The program at a terminal and in a pipe: an output that is full, closed or no longer read, and
//! Ctrl-C.

use crate::support::{self, drafts, install_interpreter, installed, scratch, succeed, target};
use std::{
    fs::{self, File},
    io::{BufRead, BufReader, pipe},
    path::Path,
    process::{Command, Output, Stdio},
    thread,
    time::{Duration, Instant},
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

#[test]
fn a_reader_that_goes_during_a_flight_ends_the_flight() {
    let program = installed("unread-flight");
    let mark = scratch().join("unread-flight.pid");
    let script = format!(
        "trap 'echo Traceback >&2; exit 1' INT PIPE; echo $$ >'{}'; while :; do echo row; done",
        mark.display()
    );
    install_interpreter(&program, &script);
    let mut command = Command::new(&program);
    command.arg("--library").arg(support::library());
    let mut child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut lines = BufReader::new(child.stdout.take().unwrap()).lines();
    for _ in 0..2 {
        assert!(lines.next().unwrap().unwrap().starts_with("Made "));
    }
    assert_eq!(lines.next().unwrap().unwrap(), "row");
    drop(lines);
    let output = child.wait_with_output().unwrap();
    assert_eq!((output.status.code(), &*errors(&output)), (Some(141), ""));
    assert_has_ended(&mark);
}

/// The process whose number is in a file does not run.
#[track_caller]
fn assert_has_ended(mark: &Path) {
    let id = fs::read_to_string(mark).unwrap();
    let stat = fs::read_to_string(format!("/proc/{}/stat", id.trim()));
    // An orphan may be a zombie for a moment.
    assert!(
        stat.as_ref().map_or(true, |s| s.contains(") Z ")),
        "{stat:?}"
    );
}

/// Starts a program, sends it a signal when its flight has begun, and returns what it said.
fn interrupted(command: &mut Command, mark: &Path, signal: &str) -> Output {
    let child = command
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let deadline = Instant::now() + Duration::from_secs(60);
    while !fs::read_to_string(mark).is_ok_and(|id| id.ends_with('\n')) {
        assert!(Instant::now() < deadline, "the flight has not begun");
        thread::sleep(Duration::from_millis(10));
    }
    let id = child.id().to_string();
    succeed(Command::new("sh").args(["-c", "kill -s $0 $1", signal, &id]));
    child.wait_with_output().unwrap()
}

#[test]
fn ctrl_c_during_a_flight_ends_the_flight_too() {
    let program = installed("interrupted-flight");
    let mark = scratch().join("interrupted-flight.pid");
    // What it starts is ended, too.
    let script = format!(
        "trap 'echo Traceback >&2; exit 1' INT; sleep 1000 & echo $! >'{}'; wait",
        mark.display()
    );
    install_interpreter(&program, &script);
    let mut command = Command::new(&program);
    command.arg("--library").arg(support::library());
    let output = interrupted(&mut command, &mark, "INT");
    assert_eq!(
        (output.status.code(), &*errors(&output)),
        (Some(130), "Interrupted; nothing incomplete is left.\n")
    );
    assert_has_ended(&mark);
}

/// So that Ctrl-C cannot leave half of one.
#[test]
fn table_and_plot_of_a_flight_appear_whole() {
    let folder = scratch().join("whole");
    let calls = scratch().join("whole.calls");
    let mut command = support::python("fmu-examples/knight_hefner.py");
    command.arg("--fmu").arg(support::packaged_fmu());
    support::observe(command.arg("--out").arg(&folder), &calls);
    succeed(&mut command);
    let calls = fs::read_to_string(calls).unwrap();
    for name in ["knight-hefner.csv", "knight-hefner.png"] {
        let rename = format!("rename to {}", folder.join(name).display());
        assert!(calls.lines().any(|line| line == rename), "{calls}");
    }
}

#[test]
fn ctrl_c_during_the_validation_leaves_the_older_results_and_nothing_else() {
    for signal in ["INT", "TERM"] {
        let name = format!("interrupted-validation-{signal}");
        let program = installed(&name);
        let mark = scratch().join(format!("{name}.pid"));
        // It has written half of a file, and does not end by itself.
        let script = format!(
            "trap '' INT; echo half >\"$6/errors.csv\"; echo $$ >'{}'; while :; do sleep 1; done",
            mark.display()
        );
        install_interpreter(&program, &script);
        let results = target(&program).join("results");
        fs::create_dir_all(&results).unwrap();
        fs::write(results.join("errors.csv"), "old").unwrap();
        let mut command = Command::new(&program);
        command.arg("--library").arg(support::library());
        command.args(["validate", "--check", "--out"]).arg(&results);
        let output = interrupted(&mut command, &mark, signal);
        assert_eq!(output.status.code(), Some(130), "{}", errors(&output));
        assert_has_ended(&mark);
        let old = fs::read_to_string(results.join("errors.csv")).unwrap();
        assert_eq!(old, "old");
        assert_eq!(drafts(target(&program)), [] as [&Path; 0]);
    }
}
