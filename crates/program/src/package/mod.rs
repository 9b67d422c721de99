//! Writing the .fmu: a zip archive of the description, the binary, resources and documentation
//! (FMI 2.0.5, section 2.3).
//!
//! * `selection.rs`: the platforms of the .fmu
//! * `library.rs`: building the library for this machine
//! * `cross.rs`: building it for other machines
//! * `binary.rs`: checking a built library
//! * `documentation.rs`: the documentation page

mod binary;
mod cross;
mod documentation;
pub mod library;
mod platform;
mod selection;

pub use selection::{Contents, Selection};

use crate::{
    Failure,
    draft::{Draft, place_of_file},
    failed, files, sources,
};
use helicopter_rotor::{block::variables::MODEL_IDENTIFIER, description};
use std::{
    borrow::Cow,
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

/// How hard deflate works for one library: its best.
const LEVEL: i64 = 9;

/// And for several: as Zopfli does with 15 iterations. What it writes is 4 % smaller, any reader of
/// deflate reads it, and it takes seconds for each library.
const LEVEL_OF_SEVERAL: i64 = 9 + 15;

/// The folder modelDescription/ in the source tree.
fn model_description() -> PathBuf {
    sources().join("modelDescription")
}

/// Writes the .fmu with these libraries in it. After an error there is no incomplete `file`.
pub fn write(file: &Path, contents: &Contents) -> Result<(), Failure> {
    let draft = Draft::new(place_of_file(file)?)?;
    let out =
        File::create(draft.path()).map_err(failed(format!("cannot write {}", file.display())))?;
    archive(out, contents)?;
    draft.publish()
}

fn archive(out: impl Write + Seek, contents: &Contents) -> Result<(), Failure> {
    let mut zip = ZipWriter::new(out);
    let level = match contents.binaries.len() {
        0 | 1 => LEVEL,
        _ => LEVEL_OF_SEVERAL,
    };
    // A fixed date and mode: the same content gives the same bytes.
    let options = SimpleFileOptions::default()
        .last_modified_time(DateTime::default())
        .compression_level(Some(level))
        // Each file as a whole.
        .with_zopfli_buffer(None)
        .unix_permissions(0o644);
    let mut add = |name: &str, content: &[u8]| {
        zip.start_file(name, options)
            .map_err(|e| e.to_string())
            .and_then(|()| zip.write_all(content).map_err(|e| e.to_string()))
            .map_err(failed(format!("cannot add {name} to the archive")))
    };
    let read = |relative: &str| files::read(&model_description().join(relative));
    add("modelDescription.xml", xml(contents)?.as_bytes())?;
    for (platform, binary) in &contents.binaries {
        let (folder, suffix) = (platform.folder(), platform.suffix());
        add(
            &format!("binaries/{folder}/{MODEL_IDENTIFIER}{suffix}"),
            &binary.0,
        )?;
    }
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

/// modelDescription.xml, whose description says for what machines the .fmu is, if not for those
/// that its folders say. The GUID stays that of the libraries.
fn xml(contents: &Contents) -> Result<Cow<'static, str>, Failure> {
    const BEGIN: &str = " description=\"";
    const ARM: &str = "For ARM Linux only: the binary in linux64 is for ARM. ";
    if !contents.is_for_arm_only {
        return Ok(Cow::Borrowed(description::XML));
    }
    // The first description is that of the whole model.
    let (before, after) = description::XML
        .split_once(BEGIN)
        .ok_or_else(|| Failure("modelDescription.xml has no description; give it one".into()))?;
    Ok(Cow::Owned(format!("{before}{BEGIN}{ARM}{after}")))
}
