//! The progress bar of scripts, which print lines `progress DONE TOTAL NAME`.

use indicatif::{ProgressBar, ProgressStyle};
use std::time::Duration;

pub fn bar() -> ProgressBar {
    let bar = ProgressBar::new(0);
    if let Ok(style) = ProgressStyle::with_template("{elapsed} {wide_bar} {pos}/{len} {msg}") {
        bar.set_style(style);
    }
    bar.enable_steady_tick(Duration::from_millis(250));
    bar
}

/// Moves the bar if a line tells the progress. False for other lines.
pub fn moved(bar: &ProgressBar, line: &str) -> bool {
    let Some((done, total, name)) = progress(line) else {
        return false;
    };
    bar.set_length(total);
    bar.set_position(done);
    bar.set_message(name.to_owned());
    true
}

/// The parts of a line `progress DONE TOTAL NAME`.
fn progress(line: &str) -> Option<(u64, u64, &str)> {
    let mut parts = line.strip_prefix("progress ")?.splitn(3, ' ');
    let mut number = || parts.next()?.parse().ok();
    let (done, total) = (number()?, number()?);
    Some((done, total, parts.next()?))
}
