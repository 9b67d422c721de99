//! The validation: the program's own command flies all measured cases with the packaged FMU in
//! FMPy. The errors keep to these bounds, and docs/validation.md and the README agree with the
//! results.

use crate::support::{
    self, fail, install_interpreter, installed, interpreter, program, scratch, succeed, target,
};
use serde::Deserialize;
use std::{
    fs,
    os::unix::fs::symlink,
    path::{Path, PathBuf},
    process::{Command, Output},
    sync::OnceLock,
};

/// The run of the command for all tests: its output, and the folder that it wrote.
fn run() -> &'static (Output, PathBuf) {
    static RUN: OnceLock<(Output, PathBuf)> = OnceLock::new();
    RUN.get_or_init(|| {
        let folder = scratch().join("validation");
        let mut command = program();
        command.args(["validate", "--check", "--out"]).arg(&folder);
        (command.output().unwrap(), folder)
    })
}

/// Errors of a quantity with a model in a case: deg for angles, no unit for inflow ratios, % for
/// others.
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

/// The rows of a quantity in the cases whose name begins with `case`. There must be at least one.
fn errors_of(case: &str, quantity: &str) -> Vec<Errors> {
    let rows: Vec<_> = errors()
        .into_iter()
        .filter(|e| e.case.starts_with(case) && e.quantity == quantity)
        .collect();
    assert!(!rows.is_empty(), "{case}: {quantity}");
    rows
}

/// The one row of a model.
fn error_of(case: &str, quantity: &str, model: &str) -> Errors {
    let mut rows = errors_of(case, quantity);
    rows.retain(|e| e.model == model);
    assert_eq!(rows.len(), 1, "{case}, {quantity}, {model}");
    rows.remove(0)
}

#[test]
fn the_page_and_the_readme_agree_with_the_results() {
    let (output, folder) = run();
    let message = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{message}");
    let page = fs::read_to_string(folder.join("validation.md")).unwrap();
    for figure in fs::read_dir(folder.join("validation")).unwrap() {
        let name = figure.unwrap().file_name().into_string().unwrap();
        assert!(
            page.contains(&format!("](validation/{name})")),
            "{name} is not on the page"
        );
    }
}

/// Hover at 4 deg of pitch and above, with the measured section data.
#[test]
fn thrust_of_knight_and_hefners_rotors() {
    let thrust = error_of("Knight & Hefner", "CT", "table");
    assert!(thrust.mean_absolute <= 4.0, "{thrust:?}");
}

#[test]
fn torque_of_knight_and_hefners_rotors() {
    let torque = error_of("Knight & Hefner", "CQ", "table");
    assert!(torque.mean_absolute <= 5.0, "{torque:?}");
}

/// From 4 deg of pitch to stall. Single measurements scatter by nearly 5 %.
#[test]
fn thrust_of_castles_and_grays_rotor_in_hover() {
    let thrust = error_of("Castles & Gray 1951, hover", "CT", "both speeds");
    assert!(thrust.mean_absolute <= 8.0, "{thrust:?}");
}

/// On short blades the tip loss that takes away all lift at the tip gives the better thrust, but
/// not the better loads along the blade.
#[test]
fn thrust_of_caradonna_and_tungs_short_blades() {
    let case = "Caradonna & Tung";
    let own = error_of(case, "CT", "prandtlGlauert with gessowMyers");
    let prandtl = error_of(case, "CT", "prandtlGlauert");
    assert!(own.mean_absolute <= 15.0, "{own:?}");
    assert!(
        prandtl.mean_absolute > 2.0 * own.mean_absolute,
        "{own:?} {prandtl:?}"
    );
    let [own, prandtl] = ["prandtlGlauert with gessowMyers", "prandtlGlauert"]
        .map(|model| error_of(case, "section lift", model));
    assert!(
        own.mean_absolute > prandtl.mean_absolute,
        "{own:?} {prandtl:?}"
    );
}

/// The default inflow varies over the disc as measured, nearly as well as the best linear model and
/// much better than uniform inflow.
#[test]
fn inflow_over_the_disc_in_forward_flight() {
    for mu in ["0.15", "0.35"] {
        let quantity = format!("inflow ratio less its mean, mu {mu}");
        let rms = |model: &str| error_of("Elliott & Althoff", &quantity, model).rms;
        let linear = [
            "coleman",
            "drees",
            "payne",
            "whiteBlake",
            "pittPeters",
            "howlett",
            "glauertHighSpeed",
        ];
        let best = linear.map(rms).into_iter().fold(f64::INFINITY, f64::min);
        let annulus = rms("annulus");
        assert!(annulus <= 1.15 * best, "mu {mu}: {annulus} {best}");
        let uniform = rms("uniform");
        assert!(uniform > 1.4 * annulus, "mu {mu}: {annulus} {uniform}");
        // The assumed shaft angle, trim and thrust do not decide.
        for assumed in [
            "with the shaft upright",
            "without cyclic pitch",
            "with 10 % more thrust",
        ] {
            let other = rms(&format!("annulus {assumed}"));
            assert!(
                (other / annulus - 1.0).abs() < 0.1,
                "mu {mu}: {annulus}, {assumed} {other}"
            );
        }
    }
}

/// With the measured law of descent, for every inflow model and both rotors, and with the law
/// fitted to other runs.
#[test]
fn collective_for_a_thrust_in_descent() {
    let rows = errors_of("Castles & Gray 1951, descent", "collective");
    let (measured, others): (Vec<_>, Vec<_>) =
        rows.iter().partition(|e| e.model.starts_with("measured"));
    // Of the untwisted rotor and of the twisted one.
    assert_eq!((measured.len(), others.len()), (6, 4));
    for errors in measured {
        assert!(errors.rms <= 0.9, "{errors:?}");
    }
    for errors in others {
        assert!(
            errors.rms > 1.2,
            "not worse than the measured law: {errors:?}"
        );
    }
    for errors in errors_of(
        "Castles & Gray 1951, descent",
        "inflow, in deg of collective",
    ) {
        assert!(errors.rms <= 0.9, "{errors:?}");
    }
}

/// Number of rows of the PCA-2 that show the effect of an assumption.
const SENSITIVITIES: usize = 3;

/// Coning and longitudinal flapping agree with every inflow model. Lateral flapping needs inflow
/// that increases towards the rear, which uniform inflow and finite blades do not have, and annuli
/// have too much of at low advance ratios.
#[test]
fn the_autogiro_flaps_as_measured_in_flight() {
    for quantity in ["coning", "longitudinal flapping", "lateral flapping"] {
        let mut rows = errors_of("PCA-2", quantity);
        let all = rows.len();
        // Rows that show the effect of an assumption do not count.
        rows.retain(|e| !e.model.contains(" with "));
        assert_eq!((rows.len(), all - rows.len()), (12, SENSITIVITIES));
        for errors in rows {
            if quantity != "lateral flapping" {
                assert!(errors.rms <= 1.0, "{errors:?}");
                continue;
            }
            let agrees = !["uniform", "finiteBlades"].contains(&errors.model.as_str());
            assert_eq!(errors.rms < 0.6, agrees, "{errors:?}");
            assert!(
                errors.model != "annulus" || errors.rms <= 0.45,
                "{errors:?}"
            );
        }
    }
}

/// The measurements come without section data and tip loss. Both assumptions have a large effect.
#[test]
fn coning_depends_on_the_assumed_section_and_tip_loss() {
    let own = error_of("PCA-2", "coning", "pittPetersDynamic");
    for (assumed, at_least) in [
        ("pittPetersDynamic with Prandtl's tip loss", 2.0),
        ("pittPetersDynamic with Goettingen 429 computed", 1.5),
    ] {
        let other = error_of("PCA-2", "coning", assumed);
        assert!(other.rms > at_least * own.rms, "{own:?} {other:?}");
    }
}

/// A case that cannot be flown stops the scripts with a sentence that names it.
#[test]
fn a_case_that_fails_is_named_and_no_results_are_written() {
    let folder = scratch().join("broken");
    let fmu = fs::File::open(support::packaged_fmu()).unwrap();
    zip::ZipArchive::new(fmu).unwrap().extract(&folder).unwrap();
    fs::remove_file(folder.join("resources/rotors/pca-2.toml")).unwrap();
    let fmu = scratch().join("broken.fmu");
    succeed(
        Command::new(interpreter())
            .args(["-m", "zipfile", "-c"])
            .arg(&fmu)
            .args(["modelDescription.xml", "binaries", "resources"].map(|part| folder.join(part))),
    );
    let out = scratch().join("broken-validation");
    let mut command = support::python("validation");
    command.arg("--fmu").arg(&fmu).arg("--out").arg(&out);
    let message = fail(&mut command);
    assert!(
        message.starts_with("autogiro, ") && message.contains("pca-2.toml"),
        "{message}"
    );
    assert_eq!(message.trim().lines().count(), 1, "{message}");
    assert!(!out.exists());
}

/// A run replaces the whole folder. So a folder with other files is refused and not changed.
#[test]
fn a_folder_with_other_files_is_refused() {
    let folder = scratch().join("my-own");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("notes.txt"), "mine").unwrap();
    let message = fail(
        program()
            .args(["validate", "--check", "--out"])
            .arg(&folder),
    );
    assert!(
        message.contains("notes.txt") && message.contains("name a folder of its own"),
        "{message}"
    );
    assert_eq!(
        fs::read_to_string(folder.join("notes.txt")).unwrap(),
        "mine"
    );
}

/// The flights are a script that writes one file, so that the comparison fails afterwards.
#[test]
fn new_results_replace_the_whole_older_folder_to_which_a_link_leads() {
    let program = installed("older-results");
    install_interpreter(&program, r#"echo new >"$6/errors.csv""#);
    let older = target(&program).join("older");
    let link = target(&program).join("link");
    fs::create_dir(&older).unwrap();
    fs::write(older.join("summary.md"), "old").unwrap();
    symlink("older", &link).unwrap();
    let mut command = Command::new(&program);
    command.arg("--library").arg(support::library());
    fail(command.args(["validate", "--check", "--out"]).arg(&link));
    let names = |folder: &Path| {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<_> = entries.map(|e| e.unwrap().file_name()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&older), ["HelicopterRotor.fmu", "errors.csv"]);
    assert_eq!(
        names(target(&program)),
        ["debug", "link", "older", "python", "python.lock"]
    );
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
}
