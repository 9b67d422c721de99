//! The Python environment: an interpreter that hangs, a creation that was interrupted, and packages
//! that are missing or broken.

use crate::support::{
    self, fail, installed, interpreter, scratch, succeed, target, write_executable,
};
use std::{
    env, fs,
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

/// Copies a folder with links to the files.
fn link_all(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let copy = to.join(entry.file_name());
        if entry.file_type().unwrap().is_dir() {
            link_all(&entry.path(), &copy);
        } else {
            fs::hard_link(entry.path(), copy).unwrap();
        }
    }
}

/// Matplotlib needs the package cycler.
#[test]
fn packages_that_are_missing_or_broken_are_named_and_installed_again() {
    let program = installed("without-a-package");
    let environment = target(&program).join("python");
    link_all(interpreter().ancestors().nth(2).unwrap(), &environment);
    let python = |arguments: &[&str]| {
        let mut command = Command::new(environment.join("bin/python"));
        succeed(command.args(arguments)).trim().to_owned()
    };
    let file_of_cycler = python(&["-c", "import cycler; print(cycler.__file__)"]);
    assert!(Path::new(&file_of_cycler).starts_with(&environment));

    let remove = || drop(python(&["-m", "pip", "uninstall", "--yes", "cycler"]));
    // The package is still installed for pip.
    let break_it = || fs::remove_dir_all(Path::new(&file_of_cycler).parent().unwrap()).unwrap();
    for damage in [&remove as &dyn Fn(), &break_it] {
        damage();
        let output = Command::new(&program).arg("python").output().unwrap();
        let errors = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{errors}");
        assert!(
            errors.contains("cannot import matplotlib")
                && errors.contains("No module named 'cycler'"),
            "{errors}"
        );
        python(&["-c", "import matplotlib.pyplot"]);
    }
    // A sound environment is left alone.
    let output = Command::new(&program).arg("python").output().unwrap();
    assert_eq!(String::from_utf8_lossy(&output.stderr), "");
}

#[test]
fn an_interpreter_that_no_longer_runs_is_replaced() {
    let program = installed("broken-interpreter");
    support::install_interpreter(&program, "");
    let broken = "#!/nonexistent/interpreter\n";
    write_executable(&target(&program).join("python/bin/python"), broken);
    let mut command = Command::new(&program);
    let folder = scratch().join("makes");
    // Like the one above, without the killing.
    fs::write(target(&program).join("killed"), "").unwrap();
    put_first_on_the_path(&mut command, &folder, KILLS_ONCE);
    let output = command.arg("python").output().unwrap();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(
        output.status.success() && errors.contains("its interpreter fails"),
        "{errors}"
    );
    assert!(target(&program).join("python/bin/installed").exists());
}
