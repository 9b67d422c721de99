//! Rotor files: checking one, writing a new one, and an .fmu of one rotor.

use crate::support;
use roxmltree::Document;
use std::{
    collections::BTreeMap,
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
    assert_eq!(support::drafts(&folder), [] as [PathBuf; 0]);
}

/// `new` makes the rotor as the FMU does before it writes the file.
#[test]
fn new_refuses_what_the_fmu_refuses_and_names_the_file_that_the_user_named() {
    let folder = folder("new-refused");
    fs::write(folder.join("broken.polar"), "polar 1\nno numbers\n").unwrap();
    for (options, parts) in [
        (
            &["--hub", "teetering", "--blades", "3"][..],
            &["flapping.hub = teetering with 3 blades: a seesaw has two"][..],
        ),
        (
            &["--hub", "hinged", "--blades", "9"],
            &["with 9 blades: at most 8 can flap"],
        ),
        (
            &["--precone", "80"],
            &[
                "wrong.toml, line ",
                "flapping.precone is 80 deg, which is out of range",
            ],
        ),
        (&["--rpm=-400"], &["rpm is -400 rev/min"]),
        (&["--radius", "0"], &["wrong.toml", "radius"]),
        (&["--airfoil", "broken.polar"], &["broken.polar"]),
        (
            &["--hub", "hinged", "--undersling", "0.1"],
            &["--undersling belongs to a teetering hub, and the hub is hinged"],
        ),
    ] {
        let file = folder.join("wrong.toml");
        let error = support::fail(program(&["new", file.to_str().unwrap()]).args(options));
        for part in parts {
            assert!(error.contains(part), "{part:?} is not in: {error}");
        }
        assert!(!error.contains(".tmp"), "{error}");
        assert!(!file.exists());
    }
    assert_eq!(support::drafts(&folder), [] as [PathBuf; 0]);
}

#[test]
fn new_asks_a_teetering_rotor_for_its_undersling_and_no_hinge_offset() {
    let folder = folder("teetering");
    let file = new(&folder, "own.toml", &["--hub", "teetering"]);
    let text = fs::read_to_string(&file).unwrap();
    let table: toml::Table = text.parse().unwrap();
    // Half the radius of 1 m times the precone of 2.5 deg.
    assert_eq!(table["flapping"]["precone"].as_float(), Some(2.5));
    assert_eq!(table["flapping"]["undersling"].as_float(), Some(0.0218));
    assert!(!text.contains("hingeOffset"), "{text}");
    let options = [
        "--hub",
        "teetering",
        "--undersling",
        "0.05",
        "--precone",
        "3",
    ];
    let file = new(&folder, "given.toml", &options);
    let shown = support::succeed(&mut program(&["check", &file]));
    let hub =
        "Hub: teetering, undersling 0.05 m, spring 0.0 N.m/rad, precone 3.00 deg, delta3 0.0 deg";
    assert!(shown.contains(hub), "{shown}");
}

/// The lines between two marks of docs/rotor-files.md, and the rotor file that it shows.
fn of_the_page(mark: &str) -> (Vec<String>, String) {
    let page = fs::read_to_string(support::sources().join("docs/rotor-files.md")).unwrap();
    let mark = format!("<!-- {mark} -->\n");
    let shown = page.split(&mark).nth(1).unwrap();
    let lines = shown.lines().map(|line| line.trim_start().to_owned());
    let lines = lines.filter(|line| !line.is_empty()).collect();
    let file = page.split("```toml\n").nth(1).unwrap();
    (lines, file.split("```").next().unwrap().to_owned())
}

#[test]
fn the_page_on_rotor_files_shows_what_check_prints() {
    let folder = folder("page");
    let airfoils = support::sources().join("modelDescription/resources/airfoils");
    let section = folder.join("my-section.polar");
    fs::copy(airfoils.join("naca0012.polar"), section).unwrap();
    let (shown, text) = of_the_page("check");
    let file = folder.join("my-rotor.toml").to_str().unwrap().to_owned();
    fs::write(&file, &text).unwrap();
    let printed = support::succeed(&mut program(&["check", &file]));
    let printed: Vec<&str> = printed.lines().map(str::trim_start).collect();
    assert!(shown.len() > 5);
    for line in &shown {
        assert!(printed.contains(&line.as_str()), "{line}\n{printed:#?}");
    }

    let (errors, _) = of_the_page("errors");
    let changes = [
        ("hingeOffset = 0.05", "hingeofset = 0.05"),
        ("hingeOffset = 0.05", "hingeOffset = 0.95"),
        ("pittPeters", "pitPeters"),
        ("\"hinged\"", "\"teetering\""),
    ];
    assert_eq!(errors.len(), changes.len());
    for (error, (from, to)) in errors.iter().zip(changes) {
        assert!(text.contains(from));
        fs::write(&file, text.replacen(from, to, 1)).unwrap();
        let printed = support::fail(&mut program(&["check", &file]));
        let printed = printed.replace(&file, "my-rotor.toml");
        assert_eq!(printed, format!("Error: {error}\n"));
    }
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

/// The text of an entry in resources/packaged.txt.
fn packaged(files: &BTreeMap<String, Vec<u8>>, name: &str) -> String {
    let text = str::from_utf8(&files["resources/packaged.txt"]).unwrap();
    let begin = format!("{name} = \"");
    let mut values = text.lines().filter_map(|line| line.strip_prefix(&begin));
    let value = values.next().unwrap().strip_suffix("\";").unwrap();
    value.to_owned()
}

#[test]
fn the_file_of_fmi_3_is_that_of_the_rotor_too_and_flies_to_the_same_bits() {
    let folder = folder("fmi3");
    let airfoils = support::sources().join("modelDescription/resources/airfoils");
    fs::copy(airfoils.join("naca0015.polar"), folder.join("own.polar")).unwrap();
    let rotor = new(
        &folder,
        "rotor.toml",
        &[
            "--hub",
            "teetering",
            "--radius",
            "2",
            "--airfoil",
            "own.polar",
        ],
    );
    let fmus = ["Own.fmu", "Own-fmi3.fmu"].map(|name| folder.join(name));
    let mut package = program(&["package", "--rotor", &rotor, "--name", "Own", "--out"]);
    support::succeed(package.arg(&fmus[0]));

    let [two, three] = [0, 1].map(|i| support::content(&fmus[i]));
    assert!(three.contains_key("binaries/x86_64-linux/Own.so"));
    assert_eq!(
        three["resources/rotors/Own.toml"],
        fs::read(&rotor).unwrap()
    );
    let xml = str::from_utf8(&three["modelDescription.xml"]).unwrap();
    let document = Document::parse(xml).unwrap();
    let root = document.root_element();
    assert_eq!(root.attribute("fmiVersion"), Some("3.0"));
    assert_eq!(root.attribute("modelName"), Some("Own"));
    let identifiers = document
        .descendants()
        .filter_map(|node| node.attribute("modelIdentifier"));
    assert!(identifiers.clone().count() >= 2 && identifiers.into_iter().all(|name| name == "Own"));

    // Its token is its own: neither that of the other file nor that of the general FMU.
    let token = root.attribute("instantiationToken").unwrap();
    assert_eq!(packaged(&three, "guid"), token);
    assert_ne!(packaged(&two, "guid"), token);
    let general = support::packaged_fmu().with_file_name("HelicopterRotor-fmi3.fmu");
    let general = support::content(&general);
    let general = Document::parse(str::from_utf8(&general["modelDescription.xml"]).unwrap())
        .unwrap()
        .root_element()
        .attribute("instantiationToken")
        .unwrap()
        .to_owned();
    assert_eq!(packaged(&three, "library"), general);
    assert_ne!(token, general);

    let start = |name: &str| {
        let mut all = document.descendants();
        let variable = all.find(|n| n.attribute("name") == Some(name)).unwrap();
        let child = || variable.children().find(|n| n.has_tag_name("Start"));
        let own = variable.attribute("start");
        let text = own.or_else(|| child().and_then(|n| n.attribute("value")));
        text.unwrap().to_owned()
    };
    for (name, value) in [
        ("geometry.file", "Own.toml"),
        ("geometry.radius", "2.0"),
        ("geometry.numberOfBlades", "2"),
        ("airfoil.file", "rotors/own.polar"),
        ("rpm", "955.0"),
        ("flapping.enabled", "true"),
        ("flapping.hub", "2"),
        ("flapping.undersling", "0.0436"),
    ] {
        assert_eq!(start(name), value, "{name}");
    }

    let mut python = support::python("crates/program/tests/own_rotor.py");
    let text = support::succeed(python.args(&fmus));
    let lines: Vec<Vec<&str>> = text
        .lines()
        .map(|line| line.split_whitespace().collect())
        .collect();
    assert_eq!(lines[..2], [["problems", "0", "[]"]; 2], "{text}");
    for (line, interface) in lines[2..].iter().zip(["CoSimulation", "ModelExchange"]) {
        let [numbers, moving] = [line[1], line[2]].map(|word| word.parse::<u32>().unwrap());
        let thrust: f64 = line[4].parse().unwrap();
        assert_eq!([line[0], line[3]], [interface, "True"], "{text}");
        assert!(numbers > 100 && moving >= 4 && thrust > 100.0, "{text}");
    }
    assert_eq!(lines.len(), 4, "{text}");
}

#[test]
fn an_fmu_of_one_rotor_has_a_name_and_all_its_files_or_is_not_made() {
    let folder = folder("refused");
    let missing = new(&folder, "missing.toml", &["--airfoil", "nowhere.polar"]);
    let outside = new(&folder, "outside.toml", &["--airfoil", "../outside.polar"]);
    fs::write(folder.join("../outside.polar"), "polar 1\n").unwrap();
    let good = new(&folder, "good.toml", &[]);
    let seesaw = folder.join("seesaw.toml").to_str().unwrap().to_owned();
    let text = fs::read_to_string(new(&folder, "two.toml", &["--hub", "teetering"])).unwrap();
    fs::write(
        &seesaw,
        text.replace("numberOfBlades = 2", "numberOfBlades = 3"),
    )
    .unwrap();
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
    refused(&seesaw, "Good", "with 3 blades: a seesaw has two");
    refused(&good, "1st", "is no name of a model");
    refused(&good, "my rotor", "is no name of a model");
    refused(&good, "HelicopterRotor", "is the name of the general FMU");
    let error = support::fail(&mut program(&["package", "--name", "Good"]));
    assert!(error.contains("--rotor"), "{error}");
}
