//! New files and folders, which replace older ones only when they are complete.

use crate::{
    Failure, failed,
    files::{self, make_folder},
};
use std::{
    fs::{self, File, FileType, OpenOptions},
    io::{self, ErrorKind},
    path::{Path, PathBuf},
};
use tempfile::TempDir;

/// What a run holds locked in the hidden folder of its draft.
const LOCK: &str = "helicopter-rotor.lock";

/// A file or folder in the making. It lies in a hidden folder beside its place, and goes to its
/// place when it is complete. Otherwise the hidden folder is removed with the draft, or by the next
/// draft for this place if the run is killed.
pub struct Draft {
    hidden: TempDir,
    place: PathBuf,
    // Dropped after `hidden`.
    _lock: File,
}

impl Draft {
    /// A draft for a place, which `place_of_file` or `place_of_folder` has given. The folders
    /// above it are made.
    pub fn new(place: PathBuf) -> Result<Draft, Failure> {
        let folder = folder_of(&place);
        make_folder(folder)?;
        let prefix = format!(".{}.", files::name(&place));
        remove_left_over(folder, &prefix);
        loop {
            let (hidden, lock) = hide(folder, &prefix)
                .map_err(failed(format!("cannot write into {}", folder.display())))?;
            // Another run takes the folder for left over if it comes before the lock.
            if hidden.path().join(LOCK).exists() {
                return Ok(Draft {
                    hidden,
                    place,
                    _lock: lock,
                });
            }
        }
    }

    /// Where to make the file or folder.
    pub fn path(&self) -> PathBuf {
        self.hidden.path().join("new")
    }

    /// Puts the file or folder in its place. What was there is replaced; a new file has the
    /// permissions of the old one.
    pub fn publish(self) -> Result<(), Failure> {
        self.put_in_place()
            .map_err(failed(format!("cannot write {}", self.place.display())))
    }

    fn put_in_place(&self) -> io::Result<()> {
        let (new, place) = (self.path(), &self.place);
        // Else a power failure could leave an empty file in the place of the older one.
        save_to_disk(&new)?;
        let older = fs::metadata(place).ok();
        if cfg!(unix)
            && let Some(older) = older.as_ref().filter(|older| older.is_file())
        {
            fs::set_permissions(&new, older.permissions())?;
        }
        // A folder that is not empty cannot be replaced in one step. Nobody removes the older one
        // if this run is killed between the two.
        let old = self.hidden.path().with_extension("old");
        let is_moved = older.is_some_and(|older| older.is_dir());
        if is_moved {
            fs::rename(place, &old)?;
        }
        if let Err(error) = fs::rename(&new, place) {
            if is_moved {
                // If this fails, too, the older folder stays there. The first error counts.
                let _ = fs::rename(&old, place);
            }
            return Err(error);
        }
        save_names_to_disk(folder_of(place));
        if is_moved {
            fs::remove_dir_all(&old)?;
        }
        Ok(())
    }
}

/// Writes a file that replaces an older one only when it is complete.
pub fn replace_file(file: &Path, content: &[u8]) -> Result<(), Failure> {
    let draft = Draft::new(place_of_file(file)?)?;
    fs::write(draft.path(), content).map_err(failed(format!("cannot write {}", file.display())))?;
    draft.publish()
}

/// Where a file is written that is given by this path: there or, if it is a symbolic link, where
/// the link leads to. Refuses what is there and is not a regular file.
pub fn place_of_file(path: &Path) -> Result<PathBuf, Failure> {
    let ends_in_slash = path.to_string_lossy().ends_with(std::path::is_separator);
    if ends_in_slash && !path.exists() {
        return Err(Failure(format!(
            "{} ends in a slash and so names a folder; name a file",
            path.display()
        )));
    }
    place(path, "file", FileType::is_file)
}

/// Where a folder is written that is given by this path, like `place_of_file`.
pub fn place_of_folder(path: &Path) -> Result<PathBuf, Failure> {
    place(path, "folder", FileType::is_dir)
}

fn place(path: &Path, wanted: &str, is_wanted: fn(&FileType) -> bool) -> Result<PathBuf, Failure> {
    match fs::metadata(path).map(|found| found.file_type()) {
        Ok(found) if !is_wanted(&found) => {
            return Err(Failure(format!(
                "{} is {} and stays what it is; name a {wanted}, old or new",
                path.display(),
                in_words(&found)
            )));
        }
        Err(error) if error.kind() != ErrorKind::NotFound => {
            return Err(failed(format!("cannot write {}", path.display()))(error));
        }
        _ => {}
    }
    let mut place = path.to_owned();
    // Longer chains, like circles, are an error above: the system follows 40 links.
    for _ in 0..40 {
        let Ok(target) = fs::read_link(&place) else {
            break;
        };
        place = folder_of(&place).join(target);
    }
    if place.file_name().is_none() {
        return Err(Failure(format!(
            "{} has no name of its own; name a {wanted}",
            path.display()
        )));
    }
    Ok(place)
}

fn in_words(found: &FileType) -> &'static str {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        if found.is_fifo() {
            return "a FIFO";
        } else if found.is_socket() {
            return "a socket";
        } else if found.is_block_device() || found.is_char_device() {
            return "a device";
        }
    }
    if found.is_dir() {
        "a folder"
    } else if found.is_file() {
        "a file"
    } else {
        "no regular file"
    }
}

fn folder_of(place: &Path) -> &Path {
    let folder = place.parent().filter(|f| !f.as_os_str().is_empty());
    folder.unwrap_or(Path::new("."))
}

/// Makes a hidden folder with a locked file.
fn hide(folder: &Path, prefix: &str) -> io::Result<(TempDir, File)> {
    let hidden = tempfile::Builder::new()
        .prefix(prefix)
        .suffix(".tmp")
        .tempdir_in(folder)?;
    let lock = File::create(hidden.path().join(LOCK))?;
    // Some network folders cannot lock. There nothing is taken for left over, either.
    let _ = lock.lock();
    Ok((hidden, lock))
}

/// Removes the hidden folders of killed runs. Those of other running ones are locked.
fn remove_left_over(folder: &Path, prefix: &str) {
    for path in files::entries(folder).unwrap_or_default() {
        let name = files::name(&path);
        if name.starts_with(prefix)
            && name.ends_with(".tmp")
            && let Ok(lock) = File::options().write(true).open(path.join(LOCK))
            && lock.try_lock().is_ok()
        {
            // What cannot be removed does no harm.
            let _ = fs::remove_dir_all(&path);
        }
    }
}

/// Waits until a file, or all in a folder, is on the disk.
fn save_to_disk(path: &Path) -> io::Result<()> {
    if path.is_dir() {
        for entry in fs::read_dir(path)? {
            save_to_disk(&entry?.path())?;
        }
        save_names_to_disk(path);
        return Ok(());
    }
    // Windows saves only what is open for writing.
    let mut options = OpenOptions::new();
    options.read(true).write(cfg!(windows));
    options.open(path)?.sync_all()
}

/// Waits until the names in a folder are on the disk. Not all file systems can do this, and without
/// it a power failure leaves the older file, which is complete.
fn save_names_to_disk(folder: &Path) {
    if cfg!(unix) {
        let _ = File::open(folder).and_then(|folder| folder.sync_all());
    }
}
