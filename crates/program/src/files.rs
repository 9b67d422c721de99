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

/// A path for a temporary file or folder of this process, next to the one that it will replace.
pub fn temporary_beside(path: &Path) -> Result<PathBuf, Failure> {
    if path.file_name().is_none() {
        return Err(Failure(format!(
            "{} has no name of its own; name a file or folder",
            path.display()
        )));
    }
    let id = std::process::id();
    Ok(path.with_file_name(format!(".{}.{id}.tmp", name(path))))
}

/// Writes a file that replaces an older one only when it is complete.
pub fn replace_file(file: &Path, content: &str) -> Result<(), Failure> {
    let temporary = temporary_beside(file)?;
    fs::write(&temporary, content)
        .and_then(|()| fs::rename(&temporary, file))
        .map_err(failed(format!("cannot write {}", file.display())))
}

/// Renames a folder. A folder that already has the new name is replaced.
pub fn replace_folder(from: &Path, to: &Path) -> Result<(), Failure> {
    let cannot = || format!("cannot replace {}", to.display());
    let old = to.with_extension(format!("{}.old", std::process::id()));
    let is_replaced = to.exists();
    if is_replaced {
        fs::rename(to, &old).map_err(failed(cannot()))?;
    }
    if let Err(error) = fs::rename(from, to) {
        if is_replaced {
            // If this fails, too, the old folder keeps its temporary name. The first error counts.
            let _ = fs::rename(&old, to);
        }
        return Err(failed(cannot())(error));
    }
    if is_replaced {
        fs::remove_dir_all(&old).map_err(failed(format!("cannot remove {}", old.display())))?;
    }
    Ok(())
}
