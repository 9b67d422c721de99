//! The files that follow from a run: docs/validation.md, docs/validation/ with the figures, and the
//! README's summary.

use super::{beside, compare, replace_folder};
use crate::{Failure, failed, sources, summary};
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

/// Whether the README has a place for the summary: asked before the flights, which take a minute.
pub fn ready() -> Result<(), Failure> {
    summary::read().map(|_| ())
}

/// Puts a run's page, figures and summary in their places.
pub fn write(run: &Path) -> Result<(), Failure> {
    let readme = summary::replaced(&read(&run.join(SUMMARY))?)?;
    let page = read(&run.join(PAGE))?;

    // All that can go wrong with content is behind us; what is left is renaming.
    let figures = docs().join(FIGURES);
    let fresh = beside(&figures)?;
    copy_figures(&run.join(FIGURES), &fresh)?;
    replace_folder(&fresh, &figures)?;
    replace_file(&docs().join(PAGE), &page)?;
    replace_file(&summary::readme(), &readme)?;
    println!(
        "Wrote {}, its figures, and the summary in {}",
        docs().join(PAGE).display(),
        summary::readme().display()
    );
    Ok(())
}

/// Compares a run's page and summary with those that are there.
pub fn check(run: &Path) -> Result<(), Failure> {
    const REMEDY: &str = "run `cargo run --release -- validate` and look at what changed";
    let page = docs().join(PAGE);
    for (name, said, found) in [
        ("docs/validation.md", &*read(&page)?, read(&run.join(PAGE))?),
        ("README.md", &*summary::read()?, read(&run.join(SUMMARY))?),
    ] {
        let different = compare::differences(said, found.trim_end());
        if let Some((said, found)) = different.first() {
            return Err(Failure(format!(
                "{} lines of {name} are not what was just computed, the first is\n  {said}\nand should be\n  {found}\n{REMEDY}",
                different.len()
            )));
        }
    }
    let (said, found) = (names(&docs().join(FIGURES))?, names(&run.join(FIGURES))?);
    if said != found {
        return Err(Failure(format!(
            "docs/validation has the figures {said:?} and should have {found:?}; {REMEDY}"
        )));
    }
    println!("docs/validation.md and README.md say what was just computed");
    Ok(())
}

fn read(file: &Path) -> Result<String, Failure> {
    fs::read_to_string(file).map_err(failed(format!("cannot read {}", file.display())))
}

fn replace_file(file: &Path, content: &str) -> Result<(), Failure> {
    let temporary = beside(file)?;
    fs::write(&temporary, content)
        .and_then(|()| fs::rename(&temporary, file))
        .map_err(failed(format!("cannot write {}", file.display())))
}

fn copy_figures(from: &Path, to: &Path) -> Result<(), Failure> {
    fs::create_dir_all(to).map_err(failed(format!("cannot make {}", to.display())))?;
    for name in names(from)? {
        fs::copy(from.join(&name), to.join(&name))
            .map_err(failed(format!("cannot write {name} into {}", to.display())))?;
    }
    Ok(())
}

/// Names of the files in a folder.
fn names(folder: &Path) -> Result<BTreeSet<String>, Failure> {
    let cannot = || format!("cannot list {}", folder.display());
    let entries = fs::read_dir(folder).map_err(failed(cannot()))?;
    entries
        .map(|entry| entry.map(|e| e.file_name().to_string_lossy().into_owned()))
        .collect::<Result<_, _>>()
        .map_err(failed(cannot()))
}
