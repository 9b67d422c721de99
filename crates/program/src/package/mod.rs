//! Writing the .fmu: a zip archive of the description, the binary, resources and documentation
//! (FMI 2.0.5, section 2.3).

mod documentation;
pub mod library;

use crate::{
    Failure,
    draft::{Draft, place_of_file},
    failed, files, sources,
};
use helicopter_rotor::description;
use std::{
    fs::File,
    io::{Seek, Write},
    path::{Path, PathBuf},
};
use zip::{DateTime, ZipWriter, write::SimpleFileOptions};

/// The single files of modelDescription/ that go into the archive under the same name.
const FILES: [&str; 3] = [
    "documentation/diagram.svg",
    "documentation/fmi-ls-ref.html",
    "model.png",
];

/// The folders of modelDescription/ that go into the archive with all their files, and their names
/// in it.
const FOLDERS: [(&str, &str); 3] = [
    ("licenses", "documentation/licenses"),
    ("resources", "resources"),
    ("extra", "extra"),
];

/// The folder modelDescription/ in the source tree.
fn model_description() -> PathBuf {
    sources().join("modelDescription")
}

/// Writes the .fmu with a shared library in it. After an error there is no incomplete `file`.
pub fn write(file: &Path, library: &Path) -> Result<(), Failure> {
    let draft = Draft::new(place_of_file(file)?)?;
    let out =
        File::create(draft.path()).map_err(failed(format!("cannot write {}", file.display())))?;
    archive(out, library)?;
    draft.publish()
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
    let read = |relative: &str| files::read(&model_description().join(relative));
    add("modelDescription.xml", description::XML.as_bytes())?;
    let (binary, content) = library::read(library)?;
    add(&binary, &content)?;
    let page = documentation::page(&read("documentation/index.html")?)?;
    add("documentation/index.html", page.as_bytes())?;
    for name in FILES {
        add(name, &read(name)?)?;
    }
    for (folder, name_in_archive) in FOLDERS {
        for relative in files::names_below(&model_description().join(folder))? {
            let content = read(&format!("{folder}/{relative}"))?;
            add(&format!("{name_in_archive}/{relative}"), &content)?;
        }
    }
    zip.finish().map_err(failed("cannot finish the archive"))?;
    Ok(())
}
