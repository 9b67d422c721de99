//! The validation page: the packaged FMU, flown in FMPy through all measured cases by the program's
//! own command, keeps to these bounds, and docs/validation.md and the README say what comes out.

mod support;

use serde::Deserialize;
use std::{
    fs,
    path::PathBuf,
    process::{Command, Output},
    sync::OnceLock,
};
use support::program;

/// One run of the command for all tests, its answer, and the folder that it wrote.
fn run() -> &'static (Output, PathBuf) {
    static RUN: OnceLock<(Output, PathBuf)> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = support::scratch().join("validation");
        let mut command = program();
        command.args(["validate", "--check", "--out"]).arg(&folder);
        (command.output().unwrap(), folder)
    })
}

/// Errors of a quantity with a model in a case; angles in deg, others in %.
#[derive(Debug, Deserialize)]
struct Errors {
    case: String,
    quantity: String,
    model: String,
    mean_absolute: f64,
    rms: f64,
}

/// The rows of errors.csv.
fn errors() -> Vec<Errors> {
    let (output, folder) = run();
    let table = csv::Reader::from_path(folder.join("errors.csv"));
    let mut table = table.unwrap_or_else(|error| {
        panic!("{error}: {}", String::from_utf8_lossy(&output.stderr));
    });
    assert_eq!(
        table.headers().unwrap(),
        "case,quantity,model,unit,points,mean,mean_absolute,rms,worst,scatter"
            .split(',')
            .collect::<Vec<_>>()
    );
    table.deserialize().map(Result::unwrap).collect()
}

/// The rows of a quantity in the cases whose name begins so; at least one.
fn of(case: &str, quantity: &str) -> Vec<Errors> {
    let rows: Vec<_> = errors()
        .into_iter()
        .filter(|e| e.case.starts_with(case) && e.quantity == quantity)
        .collect();
    assert!(!rows.is_empty(), "{case}: {quantity}");
    rows
}

fn only(case: &str, quantity: &str, model: &str) -> Errors {
    let mut rows = of(case, quantity);
    rows.retain(|e| e.model == model);
    assert_eq!(rows.len(), 1, "{case}, {quantity}, {model}");
    rows.remove(0)
}

#[test]
fn the_page_and_the_readme_say_what_the_fmu_computes() {
    let (output, folder) = run();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{words}");
    let page = fs::read_to_string(folder.join("validation.md")).unwrap();
    for figure in fs::read_dir(folder.join("validation")).unwrap() {
        let name = figure.unwrap().file_name().into_string().unwrap();
        assert!(
            page.contains(&format!("](validation/{name})")),
            "{name} is on no page"
        );
    }
}

/// Hover, 4 deg of pitch and above, lift from the measured section data.
#[test]
fn thrust_of_knight_and_hefners_rotors() {
    let thrust = only("Knight & Hefner", "CT", "table");
    assert!(thrust.mean_absolute <= 4.0, "{thrust:?}");
}

#[test]
fn torque_of_knight_and_hefners_rotors() {
    let torque = only("Knight & Hefner", "CQ", "table");
    assert!(torque.mean_absolute <= 5.0, "{torque:?}");
}

/// From 4 deg to stall; single measurements scatter by nearly 5 %.
#[test]
fn thrust_of_castles_and_grays_rotor_in_hover() {
    let thrust = only("Castles & Gray 1951, hover", "CT", "both speeds");
    assert!(thrust.mean_absolute <= 8.0, "{thrust:?}");
}

/// With the law that is measured, whichever inflow model has it; also where the law was fitted to
/// other runs.
#[test]
fn collective_for_a_thrust_in_descent() {
    let rows = of("Castles & Gray 1951, descent", "collective");
    let (measured, others): (Vec<_>, Vec<_>) =
        rows.iter().partition(|e| e.model.starts_with("measured"));
    assert_eq!((measured.len(), others.len()), (3, 2));
    for errors in measured {
        assert!(errors.rms <= 0.9, "{errors:?}");
    }
    for errors in others {
        assert!(errors.rms > 1.2, "worse than the law measured: {errors:?}");
    }
    for errors in of(
        "Castles & Gray 1951, descent",
        "inflow, in deg of collective",
    ) {
        assert!(errors.rms <= 0.9, "{errors:?}");
    }
}

const SENSITIVITIES: usize = 3;

/// Coning and longitudinal flapping with every inflow model. Lateral flapping needs inflow that
/// grows towards the rear, which uniform inflow, the annuli and the finite blades do not have.
#[test]
fn the_autogiro_flaps_as_measured_in_flight() {
    for quantity in ["coning", "longitudinal flapping", "lateral flapping"] {
        let mut rows = of("PCA-2", quantity);
        let all = rows.len();
        // Those that show what an assumption is worth are no validation.
        rows.retain(|e| !e.model.contains(" with "));
        assert_eq!((rows.len(), all - rows.len()), (12, SENSITIVITIES));
        for errors in rows {
            if quantity != "lateral flapping" {
                assert!(errors.rms <= 1.0, "{errors:?}");
                continue;
            }
            let skewed = !["uniform", "annulus", "finiteBlades"].contains(&errors.model.as_str());
            assert_eq!(errors.rms < 0.6, skewed, "{errors:?}");
        }
    }
}

/// What the section data and the tip loss, of which the case knows neither, are worth.
#[test]
fn coning_depends_on_what_is_assumed_of_section_and_tip() {
    let own = only("PCA-2", "coning", "pittPetersDynamic");
    for (assumed, at_least) in [
        ("pittPetersDynamic with Prandtl's tip loss", 2.0),
        ("pittPetersDynamic with Goettingen 429 computed", 1.5),
    ] {
        let other = only("PCA-2", "coning", assumed);
        assert!(other.rms > at_least * own.rms, "{own:?} {other:?}");
    }
}

/// A case that cannot be flown stops the command with a sentence that names it, and nothing is
/// written.
#[test]
fn a_case_that_fails_is_named_and_nothing_is_written() {
    let folder = support::scratch().join("broken");
    let fmu = fs::File::open(support::packaged_fmu()).unwrap();
    zip::ZipArchive::new(fmu).unwrap().extract(&folder).unwrap();
    fs::remove_file(folder.join("resources/rotors/pca-2.toml")).unwrap();
    let fmu = support::scratch().join("broken.fmu");
    let python = program().arg("python").output().unwrap();
    let python = String::from_utf8_lossy(&python.stdout).trim().to_owned();
    let zipped = Command::new(&python)
        .args(["-m", "zipfile", "-c"])
        .arg(&fmu)
        .args(["modelDescription.xml", "binaries", "resources"].map(|part| folder.join(part)))
        .output()
        .unwrap();
    assert!(zipped.status.success(), "{zipped:?}");
    let out = support::scratch().join("broken-validation");
    let output = Command::new(&python)
        .arg(support::sources().join("validation"))
        .arg("--fmu")
        .arg(&fmu)
        .arg("--out")
        .arg(&out)
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success());
    assert!(
        words.starts_with("autogiro, ") && words.contains("pca-2.toml"),
        "{words}"
    );
    assert_eq!(words.trim().lines().count(), 1, "{words}");
    assert!(!out.exists());
}

/// The folder is replaced as a whole: one that has other things is left alone.
#[test]
fn a_folder_with_other_things_is_refused() {
    let folder = support::scratch().join("my-own");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("notes.txt"), "mine").unwrap();
    let output = program()
        .args(["validate", "--check", "--out"])
        .arg(&folder)
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(!output.status.success());
    assert!(
        words.contains("notes.txt") && words.contains("name a folder of its own"),
        "{words}"
    );
    assert_eq!(
        fs::read_to_string(folder.join("notes.txt")).unwrap(),
        "mine"
    );
}
