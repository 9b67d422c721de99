//! Publishes a validation run: docs/validation.md, docs/validation/ with the figures, and the
//! README's summary.

use super::compare;
use crate::{
    Failure,
    draft::{Draft, place_of_folder, replace_file},
    failed,
    files::{self, read_text},
    output, sources, summary,
};
use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
};

const PAGE: &str = "validation.md";
const FIGURES: &str = "validation";
const SUMMARY: &str = "summary.md";

fn docs() -> PathBuf {
    sources().join("docs")
}

/// Checks that the README has its marks for the summary, before the flights, which take minutes.
pub fn check_readme() -> Result<(), Failure> {
    summary::read().map(|_| ())
}

/// Writes the page, the figures and the summary of a run.
pub fn write(run: &Path) -> Result<(), Failure> {
    let readme = summary::replaced(&read_text(&run.join(SUMMARY))?)?;
    let page = read_text(&run.join(PAGE))?;

    // All contents are known to be good before the first file is replaced.
    let figures = Draft::new(place_of_folder(&docs().join(FIGURES))?)?;
    copy_figures(&run.join(FIGURES), &figures.path())?;
    figures.publish()?;
    replace_file(&docs().join(PAGE), page.as_bytes())?;
    replace_file(&summary::readme(), readme.as_bytes())?;
    output::print(format_args!(
        "Wrote {}, its figures, and the summary in {}",
        docs().join(PAGE).display(),
        summary::readme().display()
    ))
}

/// Compares the page and the summary of a run with the published ones.
pub fn check(run: &Path) -> Result<(), Failure> {
    const REMEDY: &str = "run `cargo run --release -- validate` and look at what changed";
    let page = docs().join(PAGE);
    for (name, published, computed) in [
        (
            "docs/validation.md",
            &*read_text(&page)?,
            read_text(&run.join(PAGE))?,
        ),
        (
            "README.md",
            &*summary::read()?,
            read_text(&run.join(SUMMARY))?,
        ),
    ] {
        let differences = compare::differences(published, computed.trim_end());
        if let Some((published, computed)) = differences.first() {
            return Err(Failure(format!(
                "{} lines of {name} differ from what was just computed; the first is\n  {published}\nand should be\n  {computed}\n{REMEDY}",
                differences.len()
            )));
        }
    }
    let published = names(&docs().join(FIGURES))?;
    let computed = names(&run.join(FIGURES))?;
    if published != computed {
        return Err(Failure(format!(
            "docs/validation has the figures {published:?} and should have {computed:?}; {REMEDY}"
        )));
    }
    output::print("docs/validation.md and README.md agree with what was just computed")
}

fn copy_figures(from: &Path, to: &Path) -> Result<(), Failure> {
    files::make_folder(to)?;
    for name in names(from)? {
        fs::copy(from.join(&name), to.join(&name))
            .map_err(failed(format!("cannot write {name} into {}", to.display())))?;
    }
    Ok(())
}

/// The names of the files in a folder.
fn names(folder: &Path) -> Result<BTreeSet<String>, Failure> {
    let paths = files::entries(folder)?;
    Ok(paths.iter().map(|path| files::name(path)).collect())
}
