//! The table of docs/importers.md: each importer flies the FMU and does what the table says.

use crate::support::{interpreter, packaged_fmu, python, succeed};

/// Measures importers and compares the page with what they do. Installs them on first use.
fn measure(options: &[&str]) -> String {
    // Beside the environment of the examples, target/python.
    let target = interpreter().ancestors().nth(3).unwrap();
    let mut command = python("crates/program/tests/importers/measure.py");
    command.arg(packaged_fmu());
    command.arg("--environment").arg(target.join("importers"));
    succeed(command.args(options))
}

#[test]
fn importers_that_install_quickly_do_what_the_table_says() {
    let text = measure(&[]);
    assert!(text.ends_with("importers measured\n"), "{text}");
}

/// Builds importers in Rust, which takes minutes and needs the Debian package libclang-dev; Ecos
/// needs libtbb12.
#[test]
#[ignore = "slow, and needs Debian packages: bash .ci/run --full"]
fn all_importers_do_what_the_table_says() {
    assert_eq!(measure(&["--all"]), "10 importers measured\n");
}
