//! What is made from built libraries for macOS: the universal one, and what each version of FMI
//! gets of it.

use super::{
    Contents,
    binary::{self, Binary},
    compiler::{self, said_by},
    cross::MACOS,
    platform::Platform,
};
use crate::{Failure, failed, files};
use helicopter_rotor::fmi::legality::Version;
use object::{Architecture, Object};
use std::{borrow::Cow, process::Command};
use tempfile::TempDir;

/// The universal file with two libraries for one processor each.
pub fn universal(libraries: [&Binary; 2]) -> Binary {
    /// Parts begin on pages, as the power of two of the larger ones.
    const PAGE: u32 = 14;
    let mut header = Vec::from(object::macho::FAT_MAGIC.to_be_bytes());
    header.extend((libraries.len() as u32).to_be_bytes());
    let mut content = vec![];
    for Binary(library) in libraries {
        content.resize(content.len().next_multiple_of(1 << PAGE), 0);
        // The header takes the first page.
        let begin = content.len() + (1 << PAGE);
        // The types of processor, in the other order of bytes.
        for field in [4, 8] {
            header.extend(library[field..field + 4].iter().rev());
        }
        for number in [begin as u32, library.len() as u32, PAGE] {
            header.extend(number.to_be_bytes());
        }
        content.extend(library);
    }
    header.resize(1 << PAGE, 0);
    Binary([header, content].concat())
}

/// What goes into the folder of a platform in an .fmu of this version; `library` is what was built
/// for it.
///
/// If there are a universal library and its part for Apple silicon, code for that processor goes
/// into the .fmu once. Importers of FMI 2.0 look for it in `darwin64`, so `aarch64-darwin` gets a
/// library that re-exports the one there. In FMI 3.0 each processor has its folder, so
/// `x86_64-darwin` gets the other part alone.
pub fn library_in<'a>(
    version: Version,
    contents: &'a Contents,
    platform: Platform,
    library: &'a Binary,
    identifier: &str,
) -> Result<Cow<'a, [u8]>, Failure> {
    let mut binaries = contents.binaries.iter();
    let universal = binaries.find(|(platform, _)| *platform == Platform::Darwin64);
    let part = |processor| universal.and_then(|(_, file)| part(&file.0, processor));
    let is_there_twice = part(Architecture::Aarch64).is_some_and(|part| {
        let mut binaries = contents.binaries.iter();
        binaries
            .any(|(platform, library)| *platform == Platform::Aarch64Darwin && library.0 == part)
    });
    match (version, platform) {
        (Version::Two, Platform::Aarch64Darwin) if is_there_twice => {
            re_exporting(identifier).map(Cow::from)
        }
        (Version::Three, Platform::Darwin64) if is_there_twice => {
            Ok(part(Architecture::X86_64).unwrap_or(&library.0).into())
        }
        _ => Ok((&library.0).into()),
    }
}

/// The part for a processor of a universal file.
fn part(file: &[u8], wanted: Architecture) -> Option<&[u8]> {
    let parts = binary::parts(file).ok()?;
    parts
        .into_iter()
        .find(|part| object::File::parse(*part).is_ok_and(|file| file.architecture() == wanted))
}

/// A library for Apple silicon without code, which re-exports the one in `darwin64`.
fn re_exporting(identifier: &str) -> Result<Vec<u8>, Failure> {
    let folder = TempDir::new().map_err(failed("cannot make a folder for temporary files"))?;
    let place = |name: &str| folder.path().join(name);
    let name = format!("{identifier}.dylib");
    // All that a linker must know of the other library. `@loader_path` is the folder of this one.
    let other = format!(
        "--- !tapi-tbd\ntbd-version: 4\ntargets: [ arm64-macos ]\ninstall-name: '@loader_path/../{}/{name}'\n...\n",
        Platform::Darwin64
    );
    files::write(&place("other.tbd"), other.as_bytes())?;
    let mut command = if cfg!(target_os = "macos") {
        files::write(&place("none.c"), b"")?;
        let mut compiler = Command::new("cc");
        compiler.args(["-dynamiclib", "-arch", "arm64"]);
        compiler.args([&format!("-mmacosx-version-min={MACOS}"), "none.c"]);
        compiler.args(["-Wl,-reexport_library,other.tbd"]);
        compiler
    } else {
        files::make_folder(&place("usr/lib"))?;
        files::write(
            &place("usr/lib/libSystem.tbd"),
            include_bytes!("libSystem.tbd"),
        )?;
        let mut linker = linker()?;
        linker.args(["-flavor", "ld64", "-dylib", "-arch", "arm64"]);
        linker.args(["-platform_version", "macos", MACOS, MACOS]);
        linker.args([
            "-syslibroot",
            ".",
            "-lSystem",
            "-reexport_library",
            "other.tbd",
        ]);
        linker
    };
    command.current_dir(folder.path()).args([
        "-install_name",
        &format!("@rpath/{name}"),
        "-o",
        &name,
    ]);
    said_by(&mut command).map_err(failed(
        "cannot link the library in aarch64-darwin, which re-exports the one in darwin64; install Rust with rustup, whose linker rust-lld does it, or package the two in separate files",
    ))?;
    files::read(&place(&name))
}

/// The linker of rustup's compiler or, if it has none, that on the PATH.
fn linker() -> Result<Command, Failure> {
    let host = compiler::about("host")?.unwrap_or_default();
    let own = compiler::sysroot()?.join(format!("lib/rustlib/{host}/bin/rust-lld"));
    Ok(Command::new(if own.is_file() {
        own
    } else {
        "rust-lld".into()
    }))
}
