//! Importers written in C, as most are (tests/c): they load and unload the library again and again,
//! and run it in many threads. `.ci/sanitizers` runs the same programs in Valgrind.

#![cfg(unix)]

use crate::support::{
    Fmu,
    fmu::{binary, scratch},
};
use std::{path::Path, process::Command};

/// Compiles a program of tests/c, runs it on the unpacked FMU, and answers what it prints.
fn run(program: &str, arguments: &[&str]) -> String {
    let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/c");
    let executable = scratch().join(program);
    let compiled = Command::new("cc")
        .args([
            "-std=c11",
            "-Wall",
            "-Wextra",
            "-Wpedantic",
            "-Werror",
            "-O1",
            "-o",
        ])
        .arg(&executable)
        .args([format!("{program}.c").as_str(), "fmu.c"].map(|file| sources.join(file)))
        .args(["-ldl", "-lpthread"])
        .output()
        .unwrap_or_else(|e| panic!("the C compiler cc cannot be started ({e}); install one"));
    let complaints = String::from_utf8_lossy(&compiled.stderr);
    assert!(compiled.status.success(), "{program}.c: {complaints}");

    let fmu = Fmu::shared();
    let output = Command::new(executable)
        .args(arguments)
        .arg(&fmu.folder)
        .arg(binary(&fmu.folder))
        .output()
        .unwrap();
    let [stdout, stderr] = [output.stdout, output.stderr].map(|b| String::from_utf8(b).unwrap());
    assert!(output.status.success(), "{program}: {stdout}{stderr}");
    stdout
}

#[test]
fn the_library_is_loaded_run_and_unloaded_2000_times_without_growing() {
    let printed = run("unload", &["2000"]);
    assert!(printed.starts_with("2000 cycles, "), "{printed}");
}

#[test]
fn eight_threads_with_eight_rotors_each_get_the_bits_of_one_after_the_other() {
    let printed = run("threads", &[]);
    assert!(printed.contains("64 instances in 8 threads"), "{printed}");
}
