//! Writing the .fmu: a zip archive of the description, the binary, resources and documentation
//! (FMI 2.0.5, section 2.3; FMI 3.0.2, section 2.5). One library makes the files of both versions.
//!
//! * `selection.rs`: the platforms of the .fmu
//! * `library.rs`: building the library for this machine
//! * `cross.rs`: building it for other machines
//! * `macos.rs`: what is made from libraries for macOS
//! * `compiler.rs`: asking the compiler, and other programs that build, for paths and versions
//! * `binary.rs`: checking a built library
//! * `documentation.rs`: the documentation page
//! * `own_rotor.rs`: what makes an .fmu that of one rotor

mod binary;
mod compiler;
mod cross;
mod documentation;
pub mod library;
mod macos;
pub mod own_rotor;
mod platform;
mod selection;

pub use cross::web as web_library;
pub use own_rotor::{Own, OwnRotor};
pub use selection::{Contents, Selection};

use crate::{
    Failure,
    draft::{Draft, place_of_file},
    failed, files, sources,
};
use helicopter_rotor::{
    block::{packaged, variables::MODEL_IDENTIFIER},
    description,
    fmi::legality::Version,
};
use platform::Platform;
use std::{
    env,
    fs::File,
    io::{Seek, Write},
    path::{Path, PathBuf},
    time::{Duration, UNIX_EPOCH},
};
use zip::{DateTime, ZipWriter, write::SimpleFileOptions};

/// The single files of modelDescription/ that go into the archive under the same name.
const FILES: [&str; 4] = [
    "documentation/diagram.svg",
    "documentation/diagram.png",
    "terminalsAndIcons/icon.svg",
    "terminalsAndIcons/icon.png",
];

/// Files for FMI 2.0 alone: the icon at its old place, and the page of the reference flights.
const FILES_OF_FMI2: [&str; 2] = ["documentation/fmi-ls-ref.html", "model.png"];

/// The folders of modelDescription/ that go into the archive with all their files, and their names
/// in it.
const FOLDERS: [(&str, &str); 2] = [
    ("licenses", "documentation/licenses"),
    ("resources", "resources"),
];

/// The reference flights, which name the variables as FMI 2.0 has them.
const FOLDERS_OF_FMI2: [(&str, &str); 1] = [("extra", "extra")];

/// How hard deflate works for one library: its best.
const LEVEL: i64 = 9;

/// And for several: as Zopfli does with 15 iterations. What it writes is 4 % smaller, any reader of
/// deflate reads it, and it takes seconds for each library.
const LEVEL_OF_SEVERAL: i64 = 9 + 15;

/// The folder modelDescription/ in the source tree.
fn model_description() -> PathBuf {
    sources().join("modelDescription")
}

/// Writes the general .fmu of FMI 2.0 with these libraries in it. After an error there is no
/// incomplete `file`.
pub fn write(file: &Path, contents: &Contents) -> Result<(), Failure> {
    draft(file, contents, None, Version::Two)?.publish()
}

/// Writes the .fmu of FMI 2.0 and that of FMI 3.0 beside it, for one rotor, if there is one.
/// Neither is replaced before both are complete. Returns the path of the latter.
pub fn write_both(file: &Path, contents: &Contents, own: Option<&Own>) -> Result<PathBuf, Failure> {
    let other = beside(file);
    let two = draft(file, contents, own, Version::Two)?;
    let three = draft(&other, contents, own, Version::Three)?;
    two.publish()?;
    three.publish()?;
    Ok(other)
}

/// The .fmu of FMI 3.0 beside one of FMI 2.0: `HelicopterRotor-fmi3.fmu`.
pub fn beside(file: &Path) -> PathBuf {
    let mut name = file.file_stem().unwrap_or_default().to_owned();
    name.push("-fmi3");
    if let Some(extension) = file.extension() {
        name.push(".");
        name.push(extension);
    }
    file.with_file_name(name)
}

/// The folder of the resources of the general FMU.
pub fn resources() -> PathBuf {
    model_description().join("resources")
}

/// The complete .fmu of a version, which is not in its place yet.
fn draft(
    file: &Path,
    contents: &Contents,
    own: Option<&Own>,
    version: Version,
) -> Result<Draft, Failure> {
    let draft = Draft::new(place_of_file(file)?)?;
    let out =
        File::create(draft.path()).map_err(failed(format!("cannot write {}", file.display())))?;
    archive(out, contents, own, version)?;
    Ok(draft)
}

fn archive(
    out: impl Write + Seek,
    contents: &Contents,
    own: Option<&Own>,
    version: Version,
) -> Result<(), Failure> {
    let is_fmi2 = version == Version::Two;
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
    let mut xml = xml(contents, version)?;
    let mut resources = Vec::new();
    if let Some(own) = own {
        let (own_xml, text) = own.describe(&xml, version)?;
        xml = own_xml;
        resources.push((packaged::FILE.to_owned(), text.into_bytes()));
        resources.extend(own.files.iter().cloned());
    }
    add("modelDescription.xml", xml.as_bytes())?;
    let identifier = own.map_or(MODEL_IDENTIFIER, |own| &own.name);
    for (platform, binary) in &contents.binaries {
        if contents.is_for_arm_only && !is_fmi2 && *platform == Platform::Linux64 {
            // Importers of FMI 3.0 find the folder of their machine.
            continue;
        }
        let (folder, suffix) = (platform.folder_of(version), platform.suffix());
        let library = macos::content_for(
            version,
            *platform,
            binary,
            contents.is_macos_code_shared,
            identifier,
        )?;
        add(&format!("binaries/{folder}/{identifier}{suffix}"), &library)?;
    }
    let has_page = contents.page.is_some();
    let index = documentation::page(&read("documentation/index.html")?, has_page)?;
    add("documentation/index.html", index.as_bytes())?;
    if let Some(page) = &contents.page {
        add(documentation::PAGE_IN_ARCHIVE, page.as_bytes())?;
    }
    let terminals = match version {
        Version::Two => description::TERMINALS,
        Version::Three => description::TERMINALS_OF_FMI3,
    };
    add(
        "terminalsAndIcons/terminalsAndIcons.xml",
        terminals.as_bytes(),
    )?;
    let files_of_version = FILES_OF_FMI2.iter().filter(|_| is_fmi2);
    for name in FILES.iter().chain(files_of_version) {
        add(name, &read(name)?)?;
    }
    let folders_of_version = FOLDERS_OF_FMI2.iter().filter(|_| is_fmi2);
    for (folder, name_in_archive) in FOLDERS.iter().chain(folders_of_version) {
        // The reference flights are those of the general FMU's defaults.
        if own.is_some() && *folder == "extra" {
            continue;
        }
        for relative in files::names_below(&model_description().join(folder))? {
            let content = read(&format!("{folder}/{relative}"))?;
            let name = format!("{name_in_archive}/{relative}");
            let is_replaced = resources
                .iter()
                .any(|(own, _)| name == format!("resources/{own}"));
            if !is_replaced {
                add(&name, &content)?;
            }
        }
    }
    let mut added: Vec<&str> = Vec::new();
    for (name, content) in &resources {
        if !added.contains(&name.as_str()) {
            add(&format!("resources/{name}"), content)?;
            added.push(name);
        }
    }
    zip.finish().map_err(failed("cannot finish the archive"))?;
    Ok(())
}

/// modelDescription.xml, with its date if the environment gives one, and with a description that
/// says for what machines the .fmu is, if not for those that its folders say. The GUID or token
/// stays that of the libraries.
fn xml(contents: &Contents, version: Version) -> Result<String, Failure> {
    const DESCRIPTION: &str = " description=\"";
    const ARM: &str = "For ARM Linux only: the binary in linux64 is for ARM. ";
    const TOOL: &str = " generationTool=\"";
    let mut xml = match version {
        Version::Two => description::XML,
        Version::Three => description::XML_OF_FMI3,
    }
    .to_owned();
    // The first description is that of the whole model.
    let mut put = |begin: &str, text: &str, is_behind: bool| {
        let place = xml
            .find(begin)
            .ok_or_else(|| Failure(format!("modelDescription.xml has no{begin}; give it one")))?;
        let place = if is_behind {
            place + begin.len()
        } else {
            place
        };
        xml.insert_str(place, text);
        Ok(())
    };
    if contents.is_for_arm_only && version == Version::Two {
        put(DESCRIPTION, ARM, true)?;
    }
    if let Some(date) = date()? {
        put(TOOL, &format!(" generationDateAndTime=\"{date}\""), false)?;
    }
    Ok(xml)
}

/// The date and time in SOURCE_DATE_EPOCH, in which build tools pass a number of seconds since
/// 1970, so that the same source gives the same file. Without it, the file does not say when it was
/// made.
fn date() -> Result<Option<String>, Failure> {
    const NAME: &str = "SOURCE_DATE_EPOCH";
    /// The last second of the year 9999.
    const LAST: u64 = 253_402_300_799;
    let Some(text) = env::var_os(NAME) else {
        return Ok(None);
    };
    let seconds = text.to_str().and_then(|text| text.parse().ok());
    let seconds = seconds.filter(|seconds| *seconds <= LAST).ok_or_else(|| {
        Failure(format!(
            "{NAME} = {} is not a number of seconds since 1970; set one, or remove it from the environment",
            text.display()
        ))
    })?;
    let date = UNIX_EPOCH + Duration::from_secs(seconds);
    Ok(Some(humantime::format_rfc3339_seconds(date).to_string()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_of_fmi_3_lies_beside_that_of_fmi_2() {
        for (file, other) in [
            ("a/HelicopterRotor.fmu", "a/HelicopterRotor-fmi3.fmu"),
            ("rotor", "rotor-fmi3"),
            ("a.b.fmu", "a.b-fmi3.fmu"),
        ] {
            assert_eq!(beside(Path::new(file)), Path::new(other));
        }
    }
}
