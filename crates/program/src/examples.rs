//! Runs the examples of fmu-examples/, each as a user runs it: `python SCRIPT --fmu FMU --out
//! FOLDER`.

use crate::{Failure, failed, files, output, process, progress, python, scripts, stop};
use std::{
    path::{Path, PathBuf},
    process::{Command, Stdio},
    time::Instant,
};

/// The name of each example, and its script in fmu-examples/. In a folder that has a
/// requirements.txt of its own, the script runs with these packages.
const EXAMPLES: &[(&str, &str)] = &[
    ("knight-hefner", "knight_hefner.py"),
    ("hover-trim", "hover_trim.py"),
    ("engine-off", "engine_off.py"),
    ("solver-accuracy", "solver_accuracy.py"),
    ("climbing-disc", "climbing_disc/climb.py"),
    ("climbing-disc-ssp", "climbing_disc/ssp.py"),
    ("helicopter", "helicopter/fly.py"),
    ("quadrotor", "quadrotor/quadrotor.py"),
    ("rotor-map", "rotor_map/rotor_map.py"),
    // It takes the map of rotor-map.
    ("surrogate", "rotor_map/surrogate.py"),
    ("modelica", "modelica/check.py"),
    ("notebook", "notebook/execute.py"),
    ("complete-model", "complete_model.py"),
    ("forward-flight", "forward_flight.py"),
];

pub fn names() -> impl Iterator<Item = &'static str> {
    EXAMPLES.iter().map(|&(name, _)| name)
}

/// Runs the named examples, or all if none is named. Each writes into the folder of its name in
/// `out`. One that fails does not keep the others from running.
pub fn run(chosen: &[String], fmu: &Path, out: &Path, target: &Path) -> Result<(), Failure> {
    let is_chosen = |name: &str| chosen.is_empty() || chosen.iter().any(|c| c == name);
    let mut failures = Vec::new();
    for &(name, script) in EXAMPLES.iter().filter(|(name, _)| is_chosen(name)) {
        output::print(format_args!("== {name}: fmu-examples/{script}"))?;
        let start = Instant::now();
        let folder = out.join(name);
        match run_script(&scripts::examples().join(script), fmu, &folder, target) {
            Ok(()) => output::print(format_args!(
                "== {name}: {:.0} s; results are in {}",
                start.elapsed().as_secs_f64(),
                folder.display()
            ))?,
            Err(failure) => {
                stop::check()?;
                if output::reader_has_gone() {
                    return Err(failure);
                }
                output::note(format_args!("Error: {failure}"));
                failures.push(name);
            }
        }
    }
    if failures.is_empty() {
        return Ok(());
    }
    Err(Failure(format!(
        "these examples failed: {}; see their messages above",
        failures.join(", ")
    )))
}

/// Shows the progress that the script prints as a bar, and prints all else.
fn run_script(script: &Path, fmu: &Path, out: &Path, target: &Path) -> Result<(), Failure> {
    let interpreter = interpreter_for(script, target)?;
    files::make_folder(out)?;
    let mut command = Command::new(interpreter);
    command.arg("-u").arg(script);
    command.arg("--fmu").arg(fmu).arg("--out").arg(out);
    let bar = progress::bar();
    let (status, message) =
        process::run(
            command.stderr(Stdio::piped()),
            scripts::LIMIT,
            |line| match progress::moved(&bar, line) {
                true => Ok(()),
                false => bar.suspend(|| output::print(line)),
            },
        )
        .map_err(failed(format!("cannot run {}", script.display())))?;
    bar.finish_and_clear();
    if !message.is_empty() {
        output::note(message);
    }
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "{} failed ({status}); see its message above",
        script.display()
    )))
}

fn interpreter_for(script: &Path, target: &Path) -> Result<PathBuf, Failure> {
    match script.parent() {
        Some(folder)
            if folder != scripts::examples() && folder.join("requirements.txt").is_file() =>
        {
            python::environment_of(folder, target)
        }
        _ => python::environment(target),
    }
}
