//! Runs the scripts in validation/, with a progress bar.

use crate::{Failure, failed, sources};
use indicatif::{ProgressBar, ProgressStyle};
use std::{
    io::{BufRead, BufReader, Read},
    path::Path,
    process::{Command, Stdio},
    thread,
    time::Duration,
};

/// Flies all cases and writes the results into a folder.
pub fn fly_all(interpreter: &Path, fmu: &Path, folder: &Path) -> Result<(), Failure> {
    let scripts = sources().join("validation");
    let cannot = || format!("cannot run {}", scripts.display());
    let mut child = Command::new(interpreter)
        .arg(&scripts)
        .arg("--fmu")
        .arg(fmu)
        .arg("--out")
        .arg(folder)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .map_err(failed(cannot()))?;
    let (Some(output), Some(mut errors)) = (child.stdout.take(), child.stderr.take()) else {
        return Err(Failure(cannot()));
    };
    // Both pipes are read at the same time, because a full one stops the scripts.
    let message = thread::spawn(move || {
        let mut bytes = Vec::new();
        // After an error in reading, the message is what was read until then.
        let _ = errors.read_to_end(&mut bytes);
        String::from_utf8_lossy(&bytes).trim().to_owned()
    });
    show_progress(output).map_err(failed(cannot()))?;
    let status = child.wait().map_err(failed(cannot()))?;
    let message = message.join().unwrap_or_default();
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "a case failed, and no results were written: {message}"
    )))
}

/// Shows the progress in the output of the scripts, and their other lines above it.
fn show_progress(output: impl Read) -> std::io::Result<()> {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{elapsed} {wide_bar} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(250));
    for line in BufReader::new(output).lines() {
        let line = line?;
        if let Some((done, total, name)) = progress(&line) {
            bar.set_length(total);
            bar.set_position(done);
            bar.set_message(name.to_owned());
        } else {
            bar.println(line);
        }
    }
    bar.finish_and_clear();
    Ok(())
}

/// The parts of a line `progress DONE TOTAL NAME`.
fn progress(line: &str) -> Option<(u64, u64, &str)> {
    let mut parts = line.strip_prefix("progress ")?.splitn(3, ' ');
    let mut number = || parts.next()?.parse().ok();
    let (done, total) = (number()?, number()?);
    Some((done, total, parts.next()?))
}
