//! A test run alone in a process of its own, for what the tests beside it would disturb.

use super::fmu::{Fmu, UNPACKED};
use std::{
    io::Write,
    process::{Command, Output},
};

/// The command, if any, by which an emulator runs these tests: the system cannot start a child
/// without it.
const EMULATOR: &str = "HELICOPTER_ROTOR_EMULATOR";
const CHILD: &str = "HELICOPTER_ROTOR_CHILD";
/// Printed before and after the part of a child that must print nothing.
const MARK: &str = "<the part that is watched>";

/// In the parent: runs the test `name` (its full path) again in a child process, and answers what
/// that printed, all of it and the watched part of stdout and stderr. In the child: none.
pub fn run_alone(name: &str) -> Option<Printed> {
    run_with(name, |_| ())
}

/// The same in a process that counts its allocations (see `allocations`).
#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub fn run_counting(name: &str) -> Option<Printed> {
    run_with(name, |command| {
        command.env("LD_PRELOAD", super::allocations::library());
    })
}

fn run_with(name: &str, prepare: impl FnOnce(&mut Command)) -> Option<Printed> {
    if std::env::var_os(CHILD).is_some() {
        return None;
    }
    let tests = std::env::current_exe().unwrap();
    let mut command = Command::new(&tests);
    if let Ok(emulator) = std::env::var(EMULATOR) {
        let mut words = emulator.split_whitespace();
        command = Command::new(words.next().unwrap());
        command.args(words).arg(&tests);
    }
    command
        .args(["--exact", name, "--nocapture", "--test-threads=1"])
        .env(CHILD, "1")
        .env(UNPACKED, &Fmu::shared().folder);
    prepare(&mut command);
    let output = command.output().unwrap();
    let printed = Printed(output);
    assert!(
        printed.0.status.success(),
        "{name} in a child process: {}",
        printed.all()
    );
    assert!(
        printed.all().contains("1 passed"),
        "{name} did not run: {}",
        printed.all()
    );
    Some(printed)
}

/// In the child: runs a part of which the parent gets to know what it prints.
pub fn watched<T>(part: impl FnOnce() -> T) -> T {
    mark();
    let answer = part();
    mark();
    answer
}

fn mark() {
    let (mut stdout, mut stderr) = (std::io::stdout(), std::io::stderr());
    writeln!(stdout, "{MARK}")
        .and_then(|()| stdout.flush())
        .unwrap();
    writeln!(stderr, "{MARK}").unwrap();
}

/// What a child printed.
pub struct Printed(Output);

impl Printed {
    pub fn all(&self) -> String {
        let [stdout, stderr] = [&self.0.stdout, &self.0.stderr].map(|b| String::from_utf8_lossy(b));
        format!("{stdout}\n{stderr}")
    }

    /// What it printed to stdout and to stderr in its `watched` part.
    pub fn watched(&self) -> [String; 2] {
        [&self.0.stdout, &self.0.stderr].map(|bytes| {
            let text = String::from_utf8_lossy(bytes).into_owned();
            let parts: Vec<&str> = text.split(MARK).collect();
            assert_eq!(parts.len(), 3, "the child must watch one part: {text}");
            parts[1].trim_start_matches('\n').to_owned()
        })
    }
}
