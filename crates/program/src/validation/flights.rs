//! Runs the scripts in validation/, with a progress bar.

use crate::{Failure, failed, process, scripts, sources};
use indicatif::{ProgressBar, ProgressStyle};
use std::{
    path::Path,
    process::{Command, Stdio},
    time::Duration,
};

/// Flies all cases and writes the results into a folder.
pub fn fly_all(interpreter: &Path, fmu: &Path, folder: &Path) -> Result<(), Failure> {
    let folder_of_scripts = sources().join("validation");
    let mut command = Command::new(interpreter);
    command
        .arg("-u")
        .arg(&folder_of_scripts)
        .arg("--fmu")
        .arg(fmu)
        .arg("--out")
        .arg(folder)
        .stderr(Stdio::piped());
    let bar = progress_bar();
    let (status, message) = process::run(&mut command, scripts::LIMIT, |line| {
        show(&bar, line);
        Ok(())
    })
    .map_err(failed(format!(
        "cannot run {}",
        folder_of_scripts.display()
    )))?;
    bar.finish_and_clear();
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "a case failed, and no results were written: {message}"
    )))
}

fn progress_bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{elapsed} {wide_bar} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(250));
    bar
}

/// Shows a line of the scripts: the progress in the bar, others above it.
fn show(bar: &ProgressBar, line: &str) {
    if let Some((done, total, name)) = progress(line) {
        bar.set_length(total);
        bar.set_position(done);
        bar.set_message(name.to_owned());
    } else {
        bar.println(line);
    }
}

/// The parts of a line `progress DONE TOTAL NAME`.
fn progress(line: &str) -> Option<(u64, u64, &str)> {
    let mut parts = line.strip_prefix("progress ")?.splitn(3, ' ');
    let mut number = || parts.next()?.parse().ok();
    let (done, total) = (number()?, number()?);
    Some((done, total, parts.next()?))
}
