//! Rotor files: checking one, writing a new one, and an .fmu of one rotor.

use crate::support;
use roxmltree::Document;
use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Stdio},
};

fn folder(test: &str) -> PathBuf {
    let folder = support::scratch().join("rotor-file").join(test);
    fs::create_dir_all(&folder).unwrap();
    folder
}

/// The command without a terminal, in which `new` asks nothing.
fn program(arguments: &[&str]) -> Command {
    let mut command = support::program();
    command.args(arguments).stdin(Stdio::null());
    command
}

fn preset(name: &str) -> String {
    let rotors = support::sources().join("modelDescription/resources/rotors");
    rotors.join(name).to_str().unwrap().to_owned()
}

/// A rotor file that `new` wrote into a folder.
fn new(folder: &Path, name: &str, options: &[&str]) -> String {
    let file = folder.join(name).to_str().unwrap().to_owned();
    support::succeed(program(&["new", &file]).args(options));
    file
}

#[test]
fn check_shows_blade_solidity_lock_number_and_hover() {
    let text = support::succeed(&mut program(&[
        "check",
        &preset("pca-2.toml"),
        "--rpm",
        "140",
    ]));
    for part in [
        "Pitcairn PCA-2 autogiro (",
        "Source: NACA Rep. 487",
        "4 blades, radius 6.858 m, cutout 0.052 R (0.3566 m), counter-clockwise",
        "  0.3945    2.7055    0.5587     -1.776   0.0815  A airfoils/wheatley-1934.polar",
        "Planform, leading edge above",
        "AAAAAAAAAA",
        "Solidity 0.0871",
        "Lock number 19.058: inertia of a blade 452.80000 kg.m2",
        "Hover at sea level, 140.0 rev/min, collective 8.00 deg: thrust ",
        "figure of merit 0.",
    ] {
        assert!(text.contains(part), "{part:?} is not in:\n{text}");
    }
    let error = support::fail(&mut program(&["check", "/no/such/rotor.toml"]));
    assert!(error.contains("give a file that exists"), "{error}");
}

#[test]
fn new_writes_a_file_that_check_reads_and_replaces_none() {
    let folder = folder("new");
    let options = [
        "--hub",
        "hingeless",
        "--rotation",
        "CW",
        "--radius",
        "2",
        "--twist",
        "-10",
    ];
    let file = new(&folder, "rotor.toml", &options);
    let text = fs::read_to_string(&file).unwrap();
    let table: toml::Table = text.parse().unwrap();
    assert_eq!(table["radius"].as_float(), Some(2.0));
    assert_eq!(table["flapping"]["hub"].as_str(), Some("hingeless"));
    assert!(
        text.lines().filter(|line| line.contains(" # ")).count() > 15,
        "{text}"
    );
    let shown = support::succeed(&mut program(&["check", &file]));
    assert!(shown.contains("clockwise seen from above") && shown.contains("Lock number 8.000"));
    let error = support::fail(&mut program(&["new", &file]));
    assert!(error.contains("exists; remove it"), "{error}");
    let other = folder.join("wrong.toml");
    let error = support::fail(&mut program(&[
        "new",
        other.to_str().unwrap(),
        "--hub",
        "swash",
    ]));
    assert!(
        error.contains("describe no rotor") && error.contains("hub is \"swash\""),
        "{error}"
    );
    assert!(!other.exists());
}

#[test]
fn two_rotors_with_fmus_of_their_own_fly_in_one_process() {
    let folder = folder("two");
    let first = new(&folder, "first.toml", &["--hub", "hinged", "--radius", "2"]);
    let second = new(
        &folder,
        "second.toml",
        &["--blades", "3", "--airfoil", "own.polar"],
    );
    let airfoils = support::sources().join("modelDescription/resources/airfoils");
    fs::copy(airfoils.join("naca0015.polar"), folder.join("own.polar")).unwrap();
    let fmus = ["First.fmu", "second.fmu"].map(|name| folder.join(name));
    let package = |rotor: &str, out: &Path, options: &[&str]| {
        let mut command = program(&["package", "--rotor", rotor, "--out"]);
        support::succeed(command.arg(out).args(options));
    };
    package(&first, &fmus[0], &["--name", "First"]);
    package(&second, &fmus[1], &[]);

    let files = support::content(&fmus[1]);
    for name in [
        "binaries/linux64/second.so",
        "resources/rotors/second.toml",
        "resources/rotors/own.polar",
        "resources/packaged.txt",
    ] {
        assert!(
            files.contains_key(name),
            "{name} is not in {:?}",
            files.keys()
        );
    }
    assert!(!files.keys().any(|name| name.starts_with("extra/")));
    let xml = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
    let document = Document::parse(&xml).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("modelName"), Some("second"));
    let identifiers = document
        .descendants()
        .filter_map(|node| node.attribute("modelIdentifier"));
    assert_eq!(identifiers.collect::<Vec<_>>(), ["second", "second"]);
    let start = |name: &str| {
        let variable = document
            .descendants()
            .find(|n| n.attribute("name") == Some(name));
        let kind = variable.unwrap().first_element_child().unwrap();
        kind.attribute("start").unwrap().to_owned()
    };
    for (name, value) in [
        ("geometry.file", "second.toml"),
        ("geometry.numberOfBlades", "3"),
        ("airfoil.file", "rotors/own.polar"),
        ("rpm", "1910.0"),
        ("models.inflow", "2"),
    ] {
        assert_eq!(start(name), value, "{name}");
    }

    let script = "crates/program/tests/two_rotors.py";
    let mut python = support::python(script);
    python.arg(support::packaged_fmu());
    for (fmu, file) in fmus.iter().zip([&first, &second]) {
        python.arg(fmu).arg(file);
    }
    let text = support::succeed(&mut python);
    assert!(text.contains("thrust, N:"), "{text}");
}

#[test]
fn an_fmu_of_one_rotor_has_a_name_and_all_its_files_or_is_not_made() {
    let folder = folder("refused");
    let missing = new(&folder, "missing.toml", &["--airfoil", "nowhere.polar"]);
    let outside = new(&folder, "outside.toml", &["--airfoil", "../outside.polar"]);
    fs::write(folder.join("../outside.polar"), "polar 1\n").unwrap();
    let good = new(&folder, "good.toml", &[]);
    let out = folder.join("never.fmu");
    let refused = |rotor: &str, name: &str, part: &str| {
        let mut command = program(&["package", "--rotor", rotor, "--name", name, "--out"]);
        let error = support::fail(command.arg(&out));
        assert!(error.contains(part), "{error}");
        assert!(!out.exists());
    };
    refused(
        &missing,
        "Good",
        "\"nowhere.polar\" is neither beside the rotor file nor",
    );
    refused(&outside, "Good", "copy it into that folder");
    refused(&good, "1st", "is no name of a model");
    refused(&good, "my rotor", "is no name of a model");
    refused(&good, "HelicopterRotor", "is the name of the general FMU");
    let error = support::fail(&mut program(&["package", "--name", "Good"]));
    assert!(error.contains("--rotor"), "{error}");
}
