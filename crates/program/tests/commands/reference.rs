//! The reference files, against which importers are checked: they agree with what the FMU computes,
//! they keep the rules of their formats, and the check of importers detects errors.

use crate::support::{fail, interpreter, packaged_fmu, python, scratch, sources, succeed};
use std::{
    collections::BTreeMap,
    fs,
    io::{Read, Write},
    path::Path,
    process::Command,
};
use zip::{ZipArchive, ZipWriter, write::SimpleFileOptions};

/// The folder of the files that travel in the FMU.
const IN_THE_FMU: &str = "modelDescription/extra/org.fmi-standard.fmi-ls-ref";
/// The folder of the files in the form of the FMI cross-check.
const CROSS_CHECK: &str = "reference-flights/cross-check";

/// The command that checks an importer.
fn check(fmu: &Path, arguments: &[&Path]) -> Command {
    let mut command = python("fmu-examples/check_reference.py");
    command.arg("--fmu").arg(fmu).args(arguments);
    command
}

/// The judgement on the files in an FMU by the rules of their formats.
fn judge_formats(fmu: &Path) -> String {
    succeed(python("crates/program/tests/layered_standard.py").arg(fmu))
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

/// The text of a CSV file with these columns.
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

/// The largest magnitude.
fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest, v| largest.max(v.abs()))
}

/// The committed reference outputs, by experiment.
fn references() -> BTreeMap<String, Columns> {
    let files = fs::read_dir(sources().join(IN_THE_FMU)).unwrap();
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

/// The committed files are those that the command makes with the present FMU. The outputs may
/// differ by a hundredth of the tolerance, which is more than the rounding of another platform.
#[test]
fn the_committed_files_are_those_of_a_new_converged_flight() {
    let fresh = scratch().join("fresh");
    let mut command = python("reference-flights/make.py");
    command.arg("--fmu").arg(packaged_fmu());
    println!("{}", succeed(command.arg("--out").arg(&fresh)));
    let mut count = 0;
    for folder in [IN_THE_FMU, CROSS_CHECK] {
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
                        "{name:?}: {a} is {is}, and was {was}; if that is intended, run `cargo run --release -- reference`"
                    );
                }
            }
        }
    }
    assert_eq!(count, 16);
}

/// The largest deviation of FMPy's flight in each experiment, %. All outputs must be compared and
/// lie within the tolerance. `options` choose the interface.
fn worst_deviations(options: &[&str]) -> BTreeMap<String, f64> {
    let options: Vec<&Path> = options.iter().map(Path::new).collect();
    let words = succeed(&mut check(packaged_fmu(), &options));
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

/// FMPy holds the inputs constant in each communication step, which is a lag. With the steps of the
/// experiments the lag is visible, and smaller than the tolerance.
#[test]
fn fmpy_repeats_the_experiments_within_the_tolerance() {
    for (experiment, worst) in worst_deviations(&[]) {
        assert!((0.1..1.0).contains(&worst), "{experiment}: {worst} %");
    }
}

/// The references, which Co-Simulation made, hold for Model Exchange, too. Rotors with states have
/// the lag of FMPy's held inputs, and rotors without states have none.
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

/// Correct results of another importer pass, and errors in them are named.
#[test]
fn results_of_another_importer_are_judged() {
    let folder = scratch().join("results");
    fs::create_dir_all(&folder).unwrap();
    let judge = || check(packaged_fmu(), &[Path::new("--results"), &folder]);
    let missing = fail(&mut judge());
    assert!(missing.contains("hover.csv"), "{missing}");

    let references = references();
    let write = |experiment: &str, columns: &[(String, Vec<f64>)]| {
        fs::write(folder.join(format!("{experiment}.csv")), csv(columns)).unwrap();
    };
    for (experiment, columns) in &references {
        write(experiment, columns);
    }
    succeed(&mut judge());

    let judge_with = |change: &dyn Fn(&mut Columns)| {
        let mut columns = references["forward"].clone();
        change(&mut columns);
        write("forward", &columns);
        judge()
    };
    let off_by = |part: f64| {
        judge_with(&|columns| {
            let (name, values) = &mut columns[3];
            assert_eq!(name, "hubForce[1]");
            let change = part * largest(values);
            values[20] += change;
        })
    };
    succeed(&mut off_by(0.0099));
    let words = fail(&mut off_by(0.0101));
    assert!(
        words.contains("forward: hubForce[1] is off by 1.01 % at 0.8 s"),
        "{words}"
    );
    let words = fail(&mut off_by(f64::NAN));
    assert!(
        words.contains("forward: hubForce[1] is off by nan %"),
        "{words}"
    );
    let words = fail(&mut judge_with(&|columns| {
        for (_, values) in columns {
            values.remove(7);
        }
    }));
    assert!(
        words.contains("forward: there is no row at 0.28 s"),
        "{words}"
    );
    let words = fail(&mut judge_with(&|columns| {
        columns.remove(3);
    }));
    assert!(
        words.contains("forward: there is no column \"hubForce[1]\""),
        "{words}"
    );
}

/// Writes a copy of the FMU in which a text in one of its files is replaced.
fn write_altered(out: &Path, file: &str, from: &str, to: &str) {
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

/// If an importer leaves out one setting, the check fails for that experiment and no other.
#[test]
fn each_setting_changes_the_outputs_of_its_experiment() {
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
        write_altered(&fmu, file, from, to);
        let words = fail(&mut check(&fmu, &[]));
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
    assert_eq!(judge_formats(packaged_fmu()).trim(), "Conforms.");

    // The judgement detects errors.
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
        write_altered(&fmu, file, from, to);
        let words = judge_formats(&fmu);
        assert!(words.contains(complaint), "{complaint}: {words}");
    }
}

/// The form of the FMI cross-check has the first experiment, in which all parameters have their
/// defaults.
#[test]
fn the_cross_check_has_the_experiment_with_defaults() {
    let read =
        |folder: &str, name: &str| fs::read_to_string(sources().join(folder).join(name)).unwrap();
    assert_eq!(
        read(CROSS_CHECK, "HelicopterRotor_in.csv"),
        read(IN_THE_FMU, "hover_in.csv")
    );
    assert_eq!(
        read(CROSS_CHECK, "HelicopterRotor_ref.csv"),
        read(IN_THE_FMU, "hover_ref.csv")
    );
    assert!(!sources().join(IN_THE_FMU).join("hover.ssv").exists());
    let options = read(CROSS_CHECK, "HelicopterRotor_ref.opt");
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
    assert!(!read(CROSS_CHECK, "README.md").is_empty());

    // FMPy checks the rules of the cross-check's repository for a submission.
    let folder = scratch().join("2.0/cs/linux64/HelicopterRotor/0.2.0/HelicopterRotor");
    fs::create_dir_all(&folder).unwrap();
    fs::copy(packaged_fmu(), folder.join("HelicopterRotor.fmu")).unwrap();
    for suffix in ["in.csv", "ref.csv", "ref.opt"] {
        let name = format!("HelicopterRotor_{suffix}");
        fs::write(folder.join(&name), read(CROSS_CHECK, &name)).unwrap();
    }
    let judge = "import sys; from fmpy.cross_check.validate_vendor_repo import validate_test_fmu; \
        print(*validate_test_fmu(sys.argv[1]), sep='\\n')";
    let validate = || {
        let mut command = Command::new(interpreter());
        let words = succeed(command.args(["-c", judge]).arg(&folder));
        words.trim().to_owned()
    };
    assert_eq!(validate(), "");
    fs::remove_file(folder.join("HelicopterRotor_ref.opt")).unwrap();
    assert!(validate().contains("HelicopterRotor_ref.opt"));

    // FMPy's own command reads the inputs and flies the experiment.
    let out = scratch().join("cross-check.csv");
    let inputs = sources().join(CROSS_CHECK).join("HelicopterRotor_in.csv");
    succeed(
        Command::new(interpreter())
            .args(["-m", "fmpy", "simulate", "--interface-type", "CoSimulation"])
            .args(["--stop-time", "1.0", "--output-interval", "0.004"])
            .args([Path::new("--input-file"), &inputs])
            .args([Path::new("--output-file"), &out])
            .arg(packaged_fmu()),
    );
    let flown = columns(&fs::read_to_string(out).unwrap());
    for (name, expected) in columns(&read(CROSS_CHECK, "HelicopterRotor_ref.csv")) {
        let (_, values) = flown.iter().find(|(n, _)| *n == name).unwrap();
        for (value, expected) in values.iter().step_by(10).zip(&expected) {
            assert!((value - expected).abs() <= 0.01 * largest(values), "{name}");
        }
        assert_eq!(values.len().div_ceil(10), expected.len());
    }
}
