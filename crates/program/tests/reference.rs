//! The reference files, against which an importer is checked: they are what the FMU computes today,
//! they keep the rules of their formats, and what checks importers with them sees errors.

mod support;

use std::{
    collections::BTreeMap,
    fs,
    io::{Read, Write},
    path::Path,
    process::{Command, Output},
};
use support::{packaged_fmu, python, scratch, sources, succeeded};
use zip::{ZipArchive, ZipWriter, write::SimpleFileOptions};

const INSIDE: &str = "modelDescription/extra/org.fmi-standard.fmi-ls-ref";
const BESIDE: &str = "reference-flights/cross-check";

fn check(fmu: &Path, arguments: &[&Path]) -> Output {
    let mut command = python("fmu-examples/check_reference.py");
    command.arg("--fmu").arg(fmu).args(arguments);
    command.output().unwrap()
}

/// What the check says when it fails.
fn refusal(output: &Output) -> String {
    assert!(
        !output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stdout)
    );
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// Name and values of each column.
type Columns = Vec<(String, Vec<f64>)>;

/// The columns of a CSV file.
fn columns(text: &str) -> Columns {
    let mut table = csv::Reader::from_reader(text.as_bytes());
    let names = table.headers().unwrap().iter();
    let mut columns: Columns = names.map(|name| (name.to_owned(), Vec::new())).collect();
    for row in table.deserialize::<Vec<f64>>() {
        for ((_, column), value) in columns.iter_mut().zip(row.unwrap()) {
            column.push(value);
        }
    }
    columns
}

/// The inverse of `columns`.
fn csv(columns: &[(String, Vec<f64>)]) -> String {
    let mut table = csv::WriterBuilder::new();
    table.quote_style(csv::QuoteStyle::NonNumeric);
    let mut table = table.from_writer(Vec::new());
    table
        .write_record(columns.iter().map(|(name, _)| name))
        .unwrap();
    for row in 0..columns[0].1.len() {
        let fields = columns.iter().map(|(_, column)| column[row].to_string());
        table.write_record(fields).unwrap();
    }
    String::from_utf8(table.into_inner().unwrap()).unwrap()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, v| largest.max(v.abs()))
}

/// The committed reference outputs by experiment.
fn references() -> BTreeMap<String, Columns> {
    let files = fs::read_dir(sources().join(INSIDE)).unwrap();
    files
        .filter_map(|file| {
            let file = file.unwrap();
            let name = file.file_name().into_string().unwrap();
            let experiment = name.strip_suffix("_ref.csv")?.to_owned();
            Some((
                experiment,
                columns(&fs::read_to_string(file.path()).unwrap()),
            ))
        })
        .collect()
}

/// The committed files are those that the command makes with today's FMU. The outputs may differ by
/// a hundredth of the tolerance, which is more than another platform's rounding.
#[test]
fn the_files_are_those_of_a_fresh_converged_flight() {
    let fresh = scratch().join("fresh");
    let mut command = python("reference-flights/make.py");
    command.arg("--fmu").arg(packaged_fmu());
    println!(
        "{}",
        succeeded(&command.arg("--out").arg(&fresh).output().unwrap())
    );
    let mut count = 0;
    for folder in [INSIDE, BESIDE] {
        let names = |root: &Path| {
            let files = fs::read_dir(root.join(folder)).unwrap();
            let mut names: Vec<_> = files.map(|f| f.unwrap().file_name()).collect();
            names.sort();
            names
        };
        let made = names(&fresh);
        let mut committed = names(sources());
        committed.retain(|name| name != "README.md");
        assert_eq!(committed, made);
        for name in made {
            count += 1;
            let read = |root: &Path| fs::read_to_string(root.join(folder).join(&name)).unwrap();
            let (committed, made) = (read(sources()), read(&fresh));
            if !name.to_string_lossy().ends_with("_ref.csv") {
                assert!(committed == made, "{name:?} is not what the command makes");
                continue;
            }
            for ((a, old), (b, new)) in columns(&committed).iter().zip(&columns(&made)) {
                assert_eq!((a, old.len()), (b, new.len()), "{name:?}");
                for (was, is) in old.iter().zip(new) {
                    assert!(
                        (is - was).abs() <= 1e-4 * largest(old),
                        "{name:?}: {a} is {is}, and was {was}; if that is meant, run `cargo run --release -- reference`"
                    );
                }
            }
        }
    }
    assert_eq!(count, 16);
}

/// The largest deviation in each experiment, %, of what FMPy flies through an interface with the
/// options; all outputs were compared and found within the tolerance.
fn worst_deviations(options: &[&str]) -> BTreeMap<String, f64> {
    let options: Vec<&Path> = options.iter().map(Path::new).collect();
    let words = succeeded(&check(packaged_fmu(), &options));
    println!("{words}");
    assert!(words.trim_end().ends_with("All within 1 %."));
    let references = references();
    assert!(references.len() >= 4);
    let mut found = BTreeMap::new();
    for (experiment, columns) in references {
        let mut worst: f64 = 0.0;
        for (output, _) in columns.iter().filter(|(name, _)| name != "time") {
            let mut lines = words
                .lines()
                .map(|l| l.split_whitespace().collect::<Vec<_>>());
            let line = lines
                .find(|l| l.len() == 4 && l[0] == experiment && l[1] == output)
                .unwrap_or_else(|| panic!("{experiment}: {output} was not compared"));
            worst = worst.max(line[2].parse().unwrap());
        }
        found.insert(experiment, worst);
    }
    found
}

/// With the communication steps that the experiments name, FMPy is off by the lag of the held
/// inputs: by less than the tolerance, and by more than nothing.
#[test]
fn fmpy_repeats_the_experiments_within_the_tolerance() {
    for (experiment, worst) in worst_deviations(&[]) {
        assert!((0.1..1.0).contains(&worst), "{experiment}: {worst} %");
    }
}

/// The references, which Co-Simulation made, hold for Model Exchange. Where there are states,
/// FMPy's held inputs leave a lag there, too; where there are none, nothing.
#[test]
fn fmpy_repeats_the_experiments_in_model_exchange() {
    for (experiment, worst) in worst_deviations(&["--interface", "ModelExchange"]) {
        let bound = match experiment.as_str() {
            "hover" | "descent" => 1e-3,
            _ => 0.6,
        };
        assert!(worst <= bound, "{experiment}: {worst} %");
    }
}

/// Of another importer's results: right ones pass, and what is wrong is named.
#[test]
fn results_of_another_importer_are_judged() {
    let folder = scratch().join("results");
    fs::create_dir_all(&folder).unwrap();
    let judge = || check(packaged_fmu(), &[Path::new("--results"), &folder]);
    let missing = refusal(&judge());
    assert!(missing.contains("hover.csv"), "{missing}");

    let references = references();
    let write = |experiment: &str, columns: &[(String, Vec<f64>)]| {
        fs::write(folder.join(format!("{experiment}.csv")), csv(columns)).unwrap();
    };
    for (experiment, columns) in &references {
        write(experiment, columns);
    }
    succeeded(&judge());

    let with = |change: &dyn Fn(&mut Columns)| {
        let mut columns = references["forward"].clone();
        change(&mut columns);
        write("forward", &columns);
        judge()
    };
    let off_by = |part: f64| {
        with(&|columns| {
            let (name, values) = &mut columns[3];
            assert_eq!(name, "hubForce[1]");
            let change = part * largest(values);
            values[20] += change;
        })
    };
    succeeded(&off_by(0.0099));
    let words = refusal(&off_by(0.0101));
    assert!(
        words.contains("forward: hubForce[1] is off by 1.01 % at 0.8 s"),
        "{words}"
    );
    let words = refusal(&off_by(f64::NAN));
    assert!(
        words.contains("forward: hubForce[1] is off by nan %"),
        "{words}"
    );
    let words = refusal(&with(&|columns| {
        for (_, values) in columns {
            values.remove(7);
        }
    }));
    assert!(
        words.contains("forward: there is no row at 0.28 s"),
        "{words}"
    );
    let words = refusal(&with(&|columns| {
        columns.remove(3);
    }));
    assert!(
        words.contains("forward: there is no column \"hubForce[1]\""),
        "{words}"
    );
}

/// Writes the FMU with a text in one of its files replaced.
fn altered(out: &Path, file: &str, from: &str, to: &str) {
    let mut archive = ZipArchive::new(fs::File::open(packaged_fmu()).unwrap()).unwrap();
    let mut copy = ZipWriter::new(fs::File::create(out).unwrap());
    for i in 0..archive.len() {
        let mut entry = archive.by_index(i).unwrap();
        let name = entry.name().unwrap().into_owned();
        let mut content = Vec::new();
        entry.read_to_end(&mut content).unwrap();
        if name.ends_with(file) {
            let text = String::from_utf8(content).unwrap();
            assert!(text.contains(from), "{file} has no {from}");
            content = text.replace(from, to).into_bytes();
        }
        copy.start_file(name, SimpleFileOptions::default()).unwrap();
        copy.write_all(&content).unwrap();
    }
    copy.finish().unwrap();
}

/// An importer that leaves out one setting is seen in that experiment and no other.
#[test]
fn each_setting_shows_in_the_outputs() {
    let fmu = scratch().join("altered.fmu");
    for (file, from, to) in [
        (
            "forward.ssv",
            "Boolean value=\"true\"",
            "Boolean value=\"false\"",
        ),
        ("forward.ssv", "pittPetersDynamic", "annulus"),
        ("forward.ssv", "Real value=\"0.04\"", "Real value=\"0\""),
        ("forward.ssv", "Real value=\"0.03\"", "Real value=\"0.05\""),
        ("forward_in.csv", "cyclicLateral", "lateralTilt"),
        ("descent.ssv", "rotors/castles-gray-6ft.toml", ""),
        ("descent.ssv", "value=\"uniform\"", "value=\"annulus\""),
        ("descent.ssv", "measured", "momentum"),
        (
            "autorotation.ssv",
            "Enumeration value=\"torque\"",
            "Enumeration value=\"speed\"",
        ),
        (
            "autorotation.ssv",
            "Real value=\"0.25\"",
            "Real value=\"1\"",
        ),
        ("autorotation.ssv", "pittPetersDynamic", "annulus"),
        ("hover_in.csv", "collective", "cyclicLateral"),
    ] {
        altered(&fmu, file, from, to);
        let words = refusal(&check(&fmu, &[]));
        let experiment = file.split(['.', '_']).next().unwrap();
        let mut complaints = words.lines().skip(1).peekable();
        assert!(complaints.peek().is_some(), "{file}: {words}");
        for line in complaints {
            assert!(
                line.starts_with(&format!("{experiment}: ")),
                "{file}: {words}"
            );
        }
    }
}

#[test]
fn the_files_keep_the_rules_of_their_formats() {
    let mut command = python("crates/program/tests/layered_standard.py");
    let words = succeeded(&command.arg(packaged_fmu()).output().unwrap());
    assert_eq!(words.trim(), "Conforms.");

    // What judges them can say no.
    let fmu = scratch().join("against-the-rules.fmu");
    for (file, from, to, complaint) in [
        (
            "fmi-ls-manifest.xml",
            "\"hover_in.csv",
            "\"hover.csv",
            "hover.csv is not in the archive",
        ),
        (
            "fmi-ls-manifest.xml",
            "role=\"result\"",
            "role=\"results\"",
            "has the role results",
        ),
        (
            "experiments.exp",
            "stepSize=\"0.008\"",
            "stepSize=\"0.01\"",
            "descent: 351 rows of inputs",
        ),
        ("forward.ssv", "<ssv:Boolean", "<ssv:Bool", "forward.ssv"),
        (
            "forward_in.csv",
            "\"tilt\"",
            "\"thrust\"",
            "thrust is no input",
        ),
        ("descent_ref.csv", "\"torque\"", "torque", "the header is"),
    ] {
        altered(&fmu, file, from, to);
        let mut command = python("crates/program/tests/layered_standard.py");
        let words = succeeded(&command.arg(&fmu).output().unwrap());
        assert!(words.contains(complaint), "{complaint}: {words}");
    }
}

/// In the form of the FMI cross-check: the first experiment, with all parameters at their defaults.
#[test]
fn the_cross_check_has_the_experiment_with_defaults() {
    let read =
        |folder: &str, name: &str| fs::read_to_string(sources().join(folder).join(name)).unwrap();
    assert_eq!(
        read(BESIDE, "HelicopterRotor_in.csv"),
        read(INSIDE, "hover_in.csv")
    );
    assert_eq!(
        read(BESIDE, "HelicopterRotor_ref.csv"),
        read(INSIDE, "hover_ref.csv")
    );
    assert!(!sources().join(INSIDE).join("hover.ssv").exists());
    let options = read(BESIDE, "HelicopterRotor_ref.opt");
    let options: Vec<_> = options
        .lines()
        .map(|l| l.split_once(", ").unwrap())
        .collect();
    let expected = [
        ("StartTime", "0.0"),
        ("StopTime", "1.0"),
        ("StepSize", "0.004"),
        ("RelTol", "0.01"),
        ("OutputIntervalLength", "0.04"),
    ];
    assert_eq!(options, expected);
    assert!(!read(BESIDE, "README.md").is_empty());

    // What the cross-check's repository asks of a submission, as FMPy checks it.
    let folder = scratch().join("2.0/cs/linux64/HelicopterRotor/0.2.0/HelicopterRotor");
    fs::create_dir_all(&folder).unwrap();
    fs::copy(packaged_fmu(), folder.join("HelicopterRotor.fmu")).unwrap();
    for suffix in ["in.csv", "ref.csv", "ref.opt"] {
        let name = format!("HelicopterRotor_{suffix}");
        fs::write(folder.join(&name), read(BESIDE, &name)).unwrap();
    }
    let judge = "import sys; from fmpy.cross_check.validate_vendor_repo import validate_test_fmu; \
        print(*validate_test_fmu(sys.argv[1]), sep='\\n')";
    let validate = || {
        let output = Command::new(support::interpreter())
            .args(["-c", judge])
            .arg(&folder)
            .output();
        succeeded(&output.unwrap()).trim().to_owned()
    };
    assert_eq!(validate(), "");
    fs::remove_file(folder.join("HelicopterRotor_ref.opt")).unwrap();
    assert!(validate().contains("HelicopterRotor_ref.opt"));

    // As FMPy's own command reads and flies it.
    let out = scratch().join("cross-check.csv");
    let inputs = sources().join(BESIDE).join("HelicopterRotor_in.csv");
    let output = Command::new(support::interpreter())
        .args(["-m", "fmpy", "simulate", "--interface-type", "CoSimulation"])
        .args(["--stop-time", "1.0", "--output-interval", "0.004"])
        .args([Path::new("--input-file"), &inputs])
        .args([Path::new("--output-file"), &out])
        .arg(packaged_fmu())
        .output();
    succeeded(&output.unwrap());
    let flown = columns(&fs::read_to_string(out).unwrap());
    for (name, expected) in columns(&read(BESIDE, "HelicopterRotor_ref.csv")) {
        let (_, values) = flown.iter().find(|(n, _)| *n == name).unwrap();
        for (value, expected) in values.iter().step_by(10).zip(&expected) {
            assert!((value - expected).abs() <= 0.01 * largest(values), "{name}");
        }
        assert_eq!(values.len().div_ceil(10), expected.len());
    }
}
