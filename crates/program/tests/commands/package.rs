//! The archive: its content.

use crate::support;
use roxmltree::{Document, Node};
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
};

/// The command that writes the .fmu.
fn package(out: &Path) -> Command {
    let mut command = support::program();
    command.args(["package", "--out"]).arg(out);
    command
}

fn scratch(name: &str) -> PathBuf {
    support::scratch().join(name)
}

#[test]
fn the_archive_holds_what_an_importer_and_a_reader_expect() {
    let files = support::content(support::packaged_fmu());
    for name in [
        "modelDescription.xml",
        "binaries/linux64/HelicopterRotor.so",
        "documentation/index.html",
        "documentation/diagram.svg",
        "documentation/diagram.png",
        "terminalsAndIcons/terminalsAndIcons.xml",
        "terminalsAndIcons/icon.svg",
        "terminalsAndIcons/icon.png",
        "documentation/fmi-ls-ref.html",
        "documentation/licenses/LICENSE-MIT.txt",
        "documentation/licenses/LICENSE-APACHE.txt",
        "documentation/licenses/THIRD-PARTY.txt",
        "model.png",
        "resources/airfoils/naca0015-knight-hefner.polar",
        "resources/airfoils/naca0015-knight-hefner-reynolds.polar",
        "resources/airfoils/naca0015.polar",
        "resources/airfoils/naca0015.txt",
        "resources/airfoils/naca0012.polar",
        "resources/airfoils/goettingen429.polar",
        "resources/airfoils/wheatley-1934.polar",
        "resources/airfoils/naca4412.polar",
        "resources/rotors/knight-hefner-3.toml",
        "resources/rotors/pca-2.toml",
        "resources/rotors/castles-gray-6ft.toml",
        "resources/rotors/castles-gray-6ft-twist12.toml",
        "resources/rotors/caradonna-tung.toml",
        "resources/rotors/thesis.toml",
        "resources/rotors/apc-10x7sf.toml",
        "resources/rotors/harrington-1.toml",
        "resources/rotors/uh-60a.toml",
        "resources/rotors/bo-105.toml",
        "resources/rotors/hart-ii.toml",
        "resources/rotors/light-teetering.toml",
        "extra/org.fmi-standard.fmi-ls-ref/fmi-ls-manifest.xml",
    ] {
        assert!(
            files.get(name).is_some_and(|f| !f.is_empty()),
            "{name} is missing or empty"
        );
    }
    for name in files.keys() {
        assert!(!name.starts_with("./") && !name.contains('\\'), "{name}");
    }
    let page = String::from_utf8(files["documentation/index.html"].clone()).unwrap();
    for name in [
        "collective",
        "geometry.file",
        "hubMoment[3]",
        "<td>Knight &amp; Hefner 1937, hover</td><td>CT</td>",
        "karmanTsien",
        "<code>flapping.enabled</code></td><td>Boolean</td><td>false</td>",
    ] {
        assert!(page.contains(name), "the page has no {name}");
    }
    // Not there without `--page`.
    assert!(!page.contains("rotor.html") && !files.contains_key("documentation/rotor.html"));
    assert!(
        !page.contains("<!--"),
        "a mark in the page was not replaced"
    );
}

#[test]
fn the_same_content_makes_the_same_archive() {
    let (one, other) = (scratch("same-1.fmu"), scratch("same-2.fmu"));
    support::succeed(&mut package(&one));
    support::succeed(&mut package(&other));
    assert!(fs::read(one).unwrap() == fs::read(other).unwrap());
}

/// Without dependencies an importer must assume that every output depends on all inputs, which
/// makes algebraic loops.
#[test]
fn every_unknown_of_the_model_structure_states_its_dependencies() {
    let files = support::content(support::packaged_fmu());
    let xml = String::from_utf8(files["modelDescription.xml"].clone()).unwrap();
    let description = Document::parse(&xml).unwrap();
    let with = |tag: &'static str| {
        description
            .descendants()
            .filter(move |node| node.has_tag_name(tag))
    };
    let unknowns: Vec<_> = with("Unknown").collect();
    let is_output = |node: &Node| node.attribute("causality") == Some("output");
    let outputs = with("ScalarVariable").filter(is_output).count();
    let states = with("Real")
        .filter(|node| node.has_attribute("derivative"))
        .count();
    // One of the outputs, the azimuth, is a state.
    assert_eq!(
        unknowns.len(),
        outputs + states + (outputs + 2 * states - 1)
    );
    for unknown in unknowns {
        assert!(unknown.has_attribute("dependencies"), "{unknown:?}");
    }
}

/// The crates that are linked into the library.
fn linked_crates() -> Vec<String> {
    let mut command = Command::new(env!("CARGO"));
    command
        .current_dir(support::sources())
        .args(["tree", "--offline", "--locked"])
        .args(["--package", "helicopter-rotor"])
        .args(["--edges", "normal,no-proc-macro", "--prefix", "none"]);
    let tree = support::succeed(&mut command);
    let names = tree.lines().filter_map(|l| l.split_whitespace().next());
    let ours = ["helicopter-rotor", "rotor"];
    names
        .filter(|n| !ours.contains(n))
        .map(str::to_owned)
        .collect()
}

#[test]
fn the_library_links_no_crate_of_the_program() {
    let linked = linked_crates();
    assert!(linked.contains(&"nalgebra".to_owned()));
    let manifest = concat!(env!("CARGO_MANIFEST_DIR"), "/Cargo.toml");
    let manifest: toml::Table = fs::read_to_string(manifest).unwrap().parse().unwrap();
    let of_program = manifest["dependencies"].as_table().unwrap().keys();
    for name in of_program.filter(|name| *name != "helicopter-rotor") {
        assert!(!linked.contains(name), "{name} is linked");
    }
}

/// The version of a locked package, without the metadata after a `+`.
fn version(package: &toml::Value) -> &str {
    let version = package["version"].as_str().unwrap();
    version.split('+').next().unwrap()
}

/// The licence file names every linked crate, with the linked version.
#[test]
fn the_third_party_licences_name_the_source_of_every_rotor_and_section() {
    let text = support::sources().join("modelDescription/licenses/THIRD-PARTY.txt");
    let text = fs::read_to_string(text).unwrap();
    let files = support::content(support::packaged_fmu());
    let data = files.keys().filter(|name| name.starts_with("resources/"));
    assert!(data.clone().count() > 20);
    for name in data {
        assert!(text.contains(name), "THIRD-PARTY.txt does not name {name}");
    }
}

#[test]
fn the_third_party_licences_are_those_of_the_lock_file() {
    let root = support::sources();
    let lock: toml::Table = fs::read_to_string(root.join("Cargo.lock"))
        .unwrap()
        .parse()
        .unwrap();
    let locked: Vec<(&str, &str)> = lock["package"]
        .as_array()
        .unwrap()
        .iter()
        .map(|p| (p["name"].as_str().unwrap(), version(p)))
        .collect();
    let text = root.join("modelDescription/licenses/THIRD-PARTY.txt");
    let text = fs::read_to_string(text).unwrap();
    let rows = text
        .lines()
        .skip_while(|line| !line.trim_start().starts_with("crate "))
        .skip(1)
        .take_while(|line| !line.trim().is_empty());
    let mut listed = Vec::new();
    for row in rows {
        let mut words = row.split_whitespace();
        let (name, version) = (words.next().unwrap(), words.next().unwrap());
        assert!(
            locked.contains(&(name, version)),
            "{name} {version} is not what is linked"
        );
        listed.push(name.to_owned());
    }
    for name in linked_crates() {
        assert!(
            listed.contains(&name),
            "{name} is linked, but THIRD-PARTY.txt does not name it"
        );
    }
}
