//! What is made from built libraries for macOS: the universal one, and what each version of FMI
//! gets of it.

use super::{
    binary::Binary,
    compiler::{self, LIMIT, said_by},
    platform::Platform,
};
use crate::{Failure, failed, files, process};
use helicopter_rotor::fmi::legality::Version;
use object::{
    Architecture, FileKind, Object,
    read::macho::{FatArch, MachOFatFile32},
};
use std::{borrow::Cow, env, path::Path, process::Command};
use tempfile::TempDir;

/// The oldest macOS on which the libraries run.
pub const OLDEST: &str = "11.0";

/// The folder `binaries/`, as a library in one of its folders names it to the loader of macOS.
pub const BINARIES: &str = "@loader_path/../";

/// Writes what the linker of another system needs in the place of Apple's SDK: a list of what macOS
/// 11 has.
pub fn write_sdk(folder: &Path) -> Result<(), Failure> {
    let libraries = folder.join("usr/lib");
    files::make_folder(&libraries)?;
    for name in ["System", "c", "m", "iconv"] {
        let file = libraries.join(format!("lib{name}.tbd"));
        files::write(&file, include_bytes!("libSystem.tbd"))?;
    }
    Ok(())
}

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

/// The files in a universal file of macOS; any other file is one by itself.
pub fn parts(content: &[u8]) -> Result<Vec<&[u8]>, object::Error> {
    if FileKind::parse(content)? != FileKind::MachOFat32 {
        return Ok(vec![content]);
    }
    let universal = MachOFatFile32::parse(content)?;
    universal
        .arches()
        .iter()
        .map(|part| part.data(content))
        .collect()
}

/// What an .fmu of this version has in the folder of a platform, for which `library` was built or
/// given. Only those for macOS may differ from it.
///
/// If the two for macOS share code, that for Apple silicon goes into the .fmu once. Importers of
/// FMI 2.0 look for it in `darwin64`, so `aarch64-darwin` gets a library that re-exports the one
/// there. In FMI 3.0 each processor has its folder, so `x86_64-darwin` gets the other part alone.
pub fn content_for<'a>(
    version: Version,
    platform: Platform,
    library: &'a Binary,
    is_code_shared: bool,
    identifier: &str,
) -> Result<Cow<'a, [u8]>, Failure> {
    match (version, platform) {
        (Version::Two, Platform::Aarch64Darwin) if is_code_shared => {
            re_exporting(identifier).map(Cow::from)
        }
        (Version::Three, Platform::Darwin64) if is_code_shared => {
            let part = part(&library.0, Architecture::X86_64);
            part.map(Cow::from).ok_or_else(|| {
                Failure("the library built for darwin64 has no part for x86-64; name a built library with --binary darwin64=FILE".into())
            })
        }
        _ => Ok((&library.0).into()),
    }
}

/// The part of a universal file for a processor.
fn part(file: &[u8], wanted: Architecture) -> Option<&[u8]> {
    let parts = parts(file).ok()?;
    parts
        .into_iter()
        .find(|part| object::File::parse(*part).is_ok_and(|file| file.architecture() == wanted))
}

/// A library for Apple silicon without code, which re-exports the one in `darwin64`.
fn re_exporting(identifier: &str) -> Result<Vec<u8>, Failure> {
    let folder = TempDir::new().map_err(failed("cannot make a folder for temporary files"))?;
    let place = |name: &str| folder.path().join(name);
    let name = format!("{identifier}.dylib");
    // All that a linker must know of the other library.
    let other = format!(
        "--- !tapi-tbd\ntbd-version: 4\ntargets: [ arm64-macos ]\ninstall-name: '{BINARIES}{}/{name}'\ncurrent-version: 0\ncompatibility-version: 0\n...\n",
        Platform::Darwin64
    );
    files::write(&place("other.tbd"), other.as_bytes())?;
    let (mut command, remedy) = if cfg!(target_os = "macos") {
        files::write(&place("none.c"), b"")?;
        let mut compiler = Command::new("cc");
        compiler.args(["-dynamiclib", "-arch", "arm64"]);
        compiler.args([&format!("-mmacosx-version-min={OLDEST}"), "none.c"]);
        compiler.args(["-Wl,-reexport_library,other.tbd"]);
        (
            compiler,
            "install Apple's linker with `xcode-select --install`",
        )
    } else {
        write_sdk(folder.path())?;
        let mut linker = linker()?;
        linker.args(["-flavor", "ld64", "-dylib", "-arch", "arm64"]);
        linker.args(["-platform_version", "macos", OLDEST, OLDEST]);
        linker.args(["-syslibroot", ".", "-lSystem"]);
        linker.args(["-reexport_library", "other.tbd"]);
        (
            linker,
            "install Rust with rustup, which brings the linker rust-lld",
        )
    };
    command.current_dir(folder.path());
    command.args(["-install_name", &format!("@rpath/{name}"), "-o", &name]);
    process::run_quietly(&mut command, LIMIT).map_err(failed(format!(
        "cannot link the library in aarch64-darwin, which re-exports the one in darwin64; {remedy}, or name a built library with --binary aarch64-darwin=FILE"
    )))?;
    files::read(&place(&name))
}

/// The linker of rustup's compiler or, if it has none, that on the PATH.
fn linker() -> Result<Command, Failure> {
    let host = said_by(compiler::command().args(["--print", "host-tuple"]))?;
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
    fn x86_64_darwin_of_fmi_3_gets_the_part_for_intel_and_given_libraries_stay_whole() {
        let intel = header(CPU_TYPE_X86_64);
        let apple = header(CPU_TYPE_ARM64);
        let both = universal([&intel, &apple]);
        let (darwin64, silicon) = (Platform::Darwin64, Platform::Aarch64Darwin);
        for is_code_shared in [true, false] {
            let content = |version, platform, library| {
                content_for(version, platform, library, is_code_shared, "Rotor").unwrap()
            };
            assert_eq!(content(Version::Two, darwin64, &both), both.0);
            assert_eq!(content(Version::Three, silicon, &apple), apple.0);
            let in_fmi3 = if is_code_shared { &intel } else { &both };
            assert_eq!(content(Version::Three, darwin64, &both), in_fmi3.0);
        }
        let given = content_for(Version::Two, silicon, &apple, false, "Rotor").unwrap();
        assert_eq!(given, apple.0);
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
