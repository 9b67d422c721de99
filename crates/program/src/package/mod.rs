//! Writing the .fmu: a zip archive of the description, the binary, resources and documentation
//! (FMI 2.0.5, section 2.3).

mod documentation;
pub mod library;

use crate::{Failure, failed, sources};
use helicopter_rotor::description;
use std::{
    fs::{self, File},
    io::{Seek, Write},
    path::{Path, PathBuf},
};
use zip::{DateTime, ZipWriter, write::SimpleFileOptions};

/// The FMU's face in the source tree.
fn face() -> PathBuf {
    sources().join("modelDescription")
}

/// Writes the .fmu with a shared library in it; `file` appears whole or not at all.
pub fn write(file: &Path, library: &Path) -> Result<(), Failure> {
    let folder = file
        .parent()
        .filter(|f| !f.as_os_str().is_empty())
        .unwrap_or(Path::new("."));
    fs::create_dir_all(folder).map_err(failed(format!("cannot make {}", folder.display())))?;
    let name = file.file_name().ok_or_else(|| {
        Failure(format!(
            "{} names no file; give a name such as HelicopterRotor.fmu",
            file.display()
        ))
    })?;
    let temporary = folder.join(format!(
        ".{}.{}.tmp",
        name.to_string_lossy(),
        std::process::id()
    ));
    let written = File::create(&temporary)
        .map_err(failed(format!("cannot write {}", temporary.display())))
        .and_then(|out| archive(out, library))
        .and_then(|()| {
            fs::rename(&temporary, file).map_err(failed(format!("cannot write {}", file.display())))
        });
    if written.is_err() {
        // What went wrong is told; a left-over that cannot be removed adds nothing to it.
        let _ = fs::remove_file(&temporary);
    }
    written
}

fn archive(out: impl Write + Seek, library: &Path) -> Result<(), Failure> {
    let mut zip = ZipWriter::new(out);
    // A fixed date and mode: the same content gives the same bytes.
    let options = SimpleFileOptions::default()
        .last_modified_time(DateTime::default())
        .unix_permissions(0o644);
    let mut add = |name: &str, content: &[u8]| {
        zip.start_file(name, options)
            .map_err(|e| e.to_string())
            .and_then(|()| zip.write_all(content).map_err(|e| e.to_string()))
            .map_err(failed(format!("cannot add {name} to the archive")))
    };
    add("modelDescription.xml", description::XML.as_bytes())?;
    let (binary, content) = library::read(library)?;
    add(&binary, &content)?;
    add(
        "documentation/index.html",
        documentation::page(&read("documentation/index.html")?)?.as_bytes(),
    )?;
    for name in [
        "documentation/diagram.svg",
        "documentation/fmi-ls-ref.html",
        "model.png",
    ] {
        add(name, &read(name)?)?;
    }
    for folder in ["licenses", "resources", "extra"] {
        let inside = if folder == "licenses" {
            "documentation/licenses"
        } else {
            folder
        };
        for relative in files_below(&face().join(folder))? {
            add(
                &format!("{inside}/{relative}"),
                &read(&format!("{folder}/{relative}"))?,
            )?;
        }
    }
    zip.finish().map_err(failed("cannot finish the archive"))?;
    Ok(())
}

fn read(relative: &str) -> Result<Vec<u8>, Failure> {
    let path = face().join(relative);
    fs::read(&path).map_err(failed(format!("cannot read {}", path.display())))
}

/// Names of the files below a folder, sorted, with forward slashes.
fn files_below(folder: &Path) -> Result<Vec<String>, Failure> {
    let cannot = || format!("cannot list {}", folder.display());
    let mut names = Vec::new();
    for entry in fs::read_dir(folder).map_err(failed(cannot()))? {
        let entry = entry.map_err(failed(cannot()))?;
        let name = entry.file_name().to_string_lossy().into_owned();
        if entry.path().is_dir() {
            names.extend(
                files_below(&entry.path())?
                    .iter()
                    .map(|f| format!("{name}/{f}")),
            );
        } else if !name.starts_with('.') {
            names.push(name);
        }
    }
    names.sort();
    Ok(names)
}
