//! Files and folders, with errors that name them.

use crate::{Failure, failed};
use std::{
    fs,
    path::{Path, PathBuf},
};

pub fn read(file: &Path) -> Result<Vec<u8>, Failure> {
    fs::read(file).map_err(failed(format!("cannot read {}", file.display())))
}

pub fn read_text(file: &Path) -> Result<String, Failure> {
    fs::read_to_string(file).map_err(failed(format!("cannot read {}", file.display())))
}

/// Writes a file of no value to others: a run that is killed may leave it incomplete.
pub fn write(file: &Path, content: &[u8]) -> Result<(), Failure> {
    fs::write(file, content).map_err(failed(format!("cannot write {}", file.display())))
}

/// Makes a folder, and those above it.
pub fn make_folder(folder: &Path) -> Result<(), Failure> {
    fs::create_dir_all(folder).map_err(failed(format!("cannot make {}", folder.display())))
}

/// The paths of the files and folders in a folder, sorted.
pub fn entries(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let cannot = || format!("cannot list {}", folder.display());
    let entries = fs::read_dir(folder).map_err(failed(cannot()))?;
    let paths: Result<Vec<PathBuf>, _> = entries.map(|entry| entry.map(|e| e.path())).collect();
    let mut paths = paths.map_err(failed(cannot()))?;
    paths.sort();
    Ok(paths)
}

/// The last part of a path, as text.
pub fn name(path: &Path) -> String {
    let name = path.file_name().unwrap_or_default();
    name.to_string_lossy().into_owned()
}

/// The names of the files below a folder, sorted, with forward slashes. Hidden files are left out.
pub fn names_below(folder: &Path) -> Result<Vec<String>, Failure> {
    let mut names = Vec::new();
    for path in entries(folder)? {
        let name = name(&path);
        if path.is_dir() {
            let below = names_below(&path)?;
            names.extend(below.iter().map(|f| format!("{name}/{f}")));
        } else if !name.starts_with('.') {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}
