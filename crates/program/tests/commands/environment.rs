//! The Python environment: an interpreter that hangs, and a creation that was interrupted.

use crate::support::{fail, installed, scratch, target, write_executable};
use std::{
    env,
    os::unix::process::ExitStatusExt,
    path::Path,
    process::Command,
    time::{Duration, Instant},
};

/// Makes a shell script the first python3 on the PATH of a command.
fn put_first_on_the_path(command: &mut Command, folder: &Path, script: &str) {
    write_executable(&folder.join("python3"), &format!("#!/bin/sh\n{script}\n"));
    let path = env::var("PATH").unwrap();
    command.env("PATH", format!("{}:{path}", folder.display()));
}

#[test]
fn a_python3_that_hangs_ends_with_a_sentence() {
    let mut command = Command::new(installed("hanging-python"));
    // What it starts keeps the output open.
    put_first_on_the_path(&mut command, &scratch().join("hanging"), "sleep 1000; :");
    let start = Instant::now();
    let message = fail(command.arg("python"));
    assert!(
        message.contains("python3 (3.10 or later) is needed")
            && message.contains("it did not end within 20 s"),
        "{message}"
    );
    assert!(start.elapsed() < Duration::from_secs(60));
}

#[test]
fn a_python3_that_is_too_old_is_named() {
    let mut command = Command::new(installed("old-python"));
    put_first_on_the_path(&mut command, &scratch().join("old"), "echo 3.9.2; exit 1");
    let message = fail(command.arg("python"));
    assert!(
        message.contains("the one on the PATH is 3.9.2"),
        "{message}"
    );
}

/// A python3 whose environments are made in no time. The first installation of packages kills the
/// program.
const KILLS_ONCE: &str = r#"
case "$*" in
"-m venv "*)
    mkdir -p "$3/bin"
    cp "$0" "$3/bin/python"
    ;;
*"-m pip"*)
    here=$(dirname "$0")
    if [ ! -e "$here/../../killed" ]; then
        touch "$here/half-installed" "$here/../../killed"
        kill -KILL $PPID
    fi
    touch "$here/installed"
    ;;
esac"#;

#[test]
fn an_environment_whose_creation_was_killed_is_made_anew() {
    let program = installed("half-made");
    let make = || {
        let mut command = Command::new(&program);
        put_first_on_the_path(&mut command, &scratch().join("kills-once"), KILLS_ONCE);
        command.arg("python").output().unwrap()
    };
    assert_eq!(make().status.signal(), Some(9));
    let bin = target(&program).join("python/bin");
    assert!(bin.join("half-installed").exists());
    let path = String::from_utf8(make().stdout).unwrap();
    assert_eq!(path.trim(), bin.join("python").display().to_string());
    assert!(bin.join("installed").exists() && !bin.join("half-installed").exists());
}
