//! The .fmu of FMI 3.0 beside that of FMI 2.0.

use crate::support::{self, fail, packaged_fmu, succeed};
use roxmltree::Document;
use std::path::{Path, PathBuf};

/// The .fmu of FMI 3.0 that was packaged with the other.
fn packaged_for_fmi3() -> PathBuf {
    packaged_fmu().with_file_name("HelicopterRotor-fmi3.fmu")
}

#[test]
fn fmpy_validates_both_files_and_flies_them_to_the_same_bits() {
    let script = "crates/program/tests/both_versions.py";
    let mut command = support::python(script);
    let text = succeed(command.arg(packaged_fmu()).arg(packaged_for_fmi3()));
    let lines: Vec<&str> = text.lines().collect();
    let of = |name: &str| {
        let rest = lines.iter().filter_map(|line| line.strip_prefix(name));
        rest.map(str::trim).collect::<Vec<_>>()
    };
    assert_eq!(of("problems "), ["0 []", "0 []"], "{text}");
    assert_eq!(of("schemas "), ["4"], "{text}");
    for flight in ["CoSimulation ", "ModelExchange ", "events "] {
        let [line] = of(flight)[..] else {
            panic!("{text}")
        };
        let words: Vec<&str> = line.split(' ').collect();
        let [numbers, moving] = [words[0], words[1]].map(|word| word.parse::<u32>().unwrap());
        assert!(numbers > 500 && moving > 10, "{flight}: {line}");
        assert_eq!(words[2], "True", "{flight}: {line}");
    }
}

#[test]
fn the_archive_of_fmi_3_has_the_same_library_and_resources_in_the_folders_of_its_version() {
    let (two, three) = (
        support::content(packaged_fmu()),
        support::content(&packaged_for_fmi3()),
    );
    let binaries = |files: &std::collections::BTreeMap<String, Vec<u8>>| {
        let names = files.keys().filter(|name| name.starts_with("binaries/"));
        names.cloned().collect::<Vec<_>>()
    };
    assert_eq!(binaries(&two), ["binaries/linux64/HelicopterRotor.so"]);
    assert_eq!(
        binaries(&three),
        ["binaries/x86_64-linux/HelicopterRotor.so"]
    );
    assert!(two[&binaries(&two)[0]] == three[&binaries(&three)[0]]);
    for (name, content) in &two {
        let is_shared = name.starts_with("resources/")
            || name.starts_with("documentation/licenses/")
            || ["documentation/index.html", "documentation/diagram.png"].contains(&name.as_str());
        assert!(!is_shared || three.get(name) == Some(content), "{name}");
    }
    // The reference flights name the variables of FMI 2.0.
    assert!(three.keys().all(|name| !name.starts_with("extra/")));
}

/// A date in the description comes from the environment alone, so that the same source gives the
/// same files.
#[test]
fn the_date_is_that_of_the_environment_and_changes_no_library() {
    let make = |out: &Path, date: Option<&str>| {
        let mut command = support::program();
        command.args(["package", "--out"]).arg(out);
        command.arg("--library").arg(support::library());
        match date {
            Some(date) => command.env("SOURCE_DATE_EPOCH", date),
            None => command.env_remove("SOURCE_DATE_EPOCH"),
        };
        command
    };
    let attribute = |file: &Path| {
        let files = support::content(file);
        let xml = str::from_utf8(&files["modelDescription.xml"]).unwrap();
        let document = Document::parse(xml).unwrap();
        let date = document.root_element().attribute("generationDateAndTime");
        date.map(str::to_owned)
    };
    let out = support::scratch().join("dated.fmu");
    succeed(&mut make(&out, Some("1700000000")));
    for file in [out.clone(), out.with_file_name("dated-fmi3.fmu")] {
        assert_eq!(attribute(&file).as_deref(), Some("2023-11-14T22:13:20Z"));
    }
    succeed(&mut make(&out, None));
    assert_eq!(attribute(&out), None);
    for wrong in ["", "yesterday", "-1", "1e9", "99999999999999999999"] {
        let message = fail(&mut make(&out, Some(wrong)));
        assert!(message.contains("SOURCE_DATE_EPOCH"), "{message}");
    }
}
