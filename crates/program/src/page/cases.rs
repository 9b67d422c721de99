//! The scripts in validation/, run with a progress bar.

use crate::{Failure, failed, sources};
use indicatif::{ProgressBar, ProgressStyle};
use std::{
    io::{BufRead, BufReader, Read},
    path::Path,
    process::{Command, Stdio},
    thread,
    time::Duration,
};

/// Flies all cases and writes what they found into a folder.
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
    let words = thread::spawn(move || {
        let mut words = Vec::new();
        // What could be read of them is shown.
        let _ = errors.read_to_end(&mut words);
        String::from_utf8_lossy(&words).trim().to_owned()
    });

    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{elapsed} {wide_bar} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(250));
    for line in BufReader::new(output).lines() {
        let line = line.map_err(failed(cannot()))?;
        if let Some((done, all, name)) = progress(&line) {
            bar.set_length(all);
            bar.set_position(done);
            bar.set_message(name.to_owned());
        } else {
            bar.println(line);
        }
    }
    bar.finish_and_clear();
    let status = child.wait().map_err(failed(cannot()))?;
    let words = words.join().unwrap_or_default();
    if status.success() {
        return Ok(());
    }
    Err(Failure(format!(
        "a case could not be flown, nothing was written: {words}"
    )))
}

/// The parts of a line `progress DONE TOTAL NAME`.
fn progress(line: &str) -> Option<(u64, u64, &str)> {
    let mut parts = line.strip_prefix("progress ")?.splitn(3, ' ');
    let mut number = || parts.next()?.parse().ok();
    let (done, all) = (number()?, number()?);
    Some((done, all, parts.next()?))
}
