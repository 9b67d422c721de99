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
use std::{borrow::Cow, env, process::Command};
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

/// What goes into the folder of a platform in an .fmu of this version; `library` is what is there
/// for it.
///
/// If the libraries of both folders for macOS were built here, code for Apple silicon goes into the
/// .fmu once. Importers of FMI 2.0 look for it in `darwin64`, so `aarch64-darwin` gets a library
/// that re-exports the one there. In FMI 3.0 each processor has its folder, so `x86_64-darwin` gets
/// the other part alone.
pub fn library_in<'a>(
    version: Version,
    contents: &Contents,
    platform: Platform,
    library: &'a Binary,
    identifier: &str,
) -> Result<Cow<'a, [u8]>, Failure> {
    match (version, platform) {
        (Version::Two, Platform::Aarch64Darwin) if contents.is_macos_built_here => {
            re_exporting(identifier).map(Cow::from)
        }
        (Version::Three, Platform::Darwin64) if contents.is_macos_built_here => {
            let part = part(&library.0, Architecture::X86_64);
            part.map(Cow::from).ok_or_else(|| {
                Failure("the library built for darwin64 has no part for x86-64".into())
            })
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

/// The folder beside that of the library that names it.
pub const BESIDE: &str = "@loader_path/../";

/// A library for Apple silicon without code, which re-exports the one in `darwin64`.
fn re_exporting(identifier: &str) -> Result<Vec<u8>, Failure> {
    let folder = TempDir::new().map_err(failed("cannot make a folder for temporary files"))?;
    let place = |name: &str| folder.path().join(name);
    let name = format!("{identifier}.dylib");
    // All that a linker must know of the other library.
    let other = format!(
        "--- !tapi-tbd\ntbd-version: 4\ntargets: [ arm64-macos ]\ninstall-name: '{BESIDE}{}/{name}'\ncurrent-version: 0\ncompatibility-version: 0\n...\n",
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
        "cannot link the library in aarch64-darwin, which re-exports the one in darwin64; install Rust with rustup, whose linker rust-lld does it, or name a built library with --binary aarch64-darwin=FILE",
    ))?;
    files::read(&place(&name))
}

/// The linker of rustup's compiler or, if it has none, that on the PATH.
fn linker() -> Result<Command, Failure> {
    let host = compiler::about("host")?.unwrap_or_default();
    let name = format!("rust-lld{}", env::consts::EXE_SUFFIX);
    let own = compiler::sysroot()?.join(format!("lib/rustlib/{host}/bin/{name}"));
    Ok(Command::new(if own.is_file() { own } else { name.into() }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use object::macho::{CPU_TYPE_ARM64, CPU_TYPE_X86_64, CpuType, MH_MAGIC_64};

    /// The header of a Mach-O library without anything behind it.
    fn header(processor: CpuType) -> Binary {
        let fields = [MH_MAGIC_64, processor.0, 0, 6, 0, 0, 0, 0];
        Binary(
            fields
                .iter()
                .flat_map(|field| field.to_le_bytes())
                .collect(),
        )
    }

    #[test]
    fn fmi_3_gets_the_part_for_its_processor_and_given_libraries_stay_whole() {
        let intel = header(CPU_TYPE_X86_64);
        let apple = header(CPU_TYPE_ARM64);
        let both = universal([&intel, &apple]);
        let (darwin64, silicon) = (Platform::Darwin64, Platform::Aarch64Darwin);
        for is_macos_built_here in [true, false] {
            let contents = Contents {
                binaries: vec![(darwin64, both.clone()), (silicon, apple.clone())],
                is_for_arm_only: false,
                is_macos_built_here,
                page: None,
            };
            let content = |version, platform, library| {
                library_in(version, &contents, platform, library, "Rotor").unwrap()
            };
            assert_eq!(content(Version::Two, darwin64, &both), both.0);
            assert_eq!(content(Version::Three, silicon, &apple), apple.0);
            let in_fmi3 = content(Version::Three, darwin64, &both);
            if is_macos_built_here {
                assert_eq!(in_fmi3, intel.0);
            } else {
                assert_eq!(in_fmi3, both.0);
                assert_eq!(content(Version::Two, silicon, &apple), apple.0);
            }
        }
    }

    #[test]
    #[ignore = "needs rust-lld, which comes with rustup"]
    fn the_re_exporting_library_names_that_of_the_rotor_and_has_the_same_bytes_each_time() {
        let library = re_exporting("MyRotor").unwrap();
        let has = |text: &str| library.windows(text.len()).any(|w| w == text.as_bytes());
        assert!(has("@loader_path/../darwin64/MyRotor.dylib\0"));
        assert!(has("@rpath/MyRotor.dylib\0"));
        assert!(!has(env::temp_dir().to_str().unwrap()));
        assert_eq!(library, re_exporting("MyRotor").unwrap());
    }
}
