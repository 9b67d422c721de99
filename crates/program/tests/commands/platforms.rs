//! The platforms of the .fmu: which libraries go into it, and what those for all platforms are.

use crate::support::{self, fail, library, scratch, succeed};
use helicopter_rotor::{
    block::variables::{GUID, INSTANTIATION_TOKEN},
    fmi2, fmi3,
};
use object::{
    BinaryFormat, FileKind, Object,
    macho::{self, MachHeader64},
    read::macho::{FatArch, LoadCommandVariant, MachHeader, MachOFatFile32},
};
use roxmltree::Document;
use sha2::{Digest, Sha256};
use std::{
    collections::BTreeSet,
    env, fs,
    path::{Path, PathBuf},
    process::Command,
};

/// The command that writes an .fmu, with options.
fn package(out: &Path, options: &[&str]) -> Command {
    let mut command = support::program();
    command.args(["package", "--out"]).arg(out).args(options);
    command
}

/// The option `--binary` for a platform and a file.
fn binary(platform: &str, file: &Path) -> String {
    format!("--binary={platform}={}", file.display())
}

/// A library made by a C compiler.
fn made_from(name: &str, source: &str) -> PathBuf {
    let file = scratch().join(name);
    fs::write(file.with_extension("c"), source).unwrap();
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-o"]).arg(&file);
    succeed(compiler.arg(file.with_extension("c")));
    file
}

#[test]
fn a_given_library_is_the_only_one_and_none_is_built() {
    let out = scratch().join("given.fmu");
    let mut command = package(&out, &[&binary("linux64", library())]);
    succeed(command.env("CARGO", "/nonexistent"));
    let content = support::content(&out);
    let binaries: Vec<_> = content
        .keys()
        .filter(|n| n.starts_with("binaries/"))
        .collect();
    assert_eq!(binaries, ["binaries/linux64/HelicopterRotor.so"]);
    assert_eq!(
        content["binaries/linux64/HelicopterRotor.so"],
        fs::read(library()).unwrap()
    );
}

#[test]
fn a_library_that_does_not_fit_is_refused_with_the_reason() {
    let out = scratch().join("refused.fmu");
    let ours = library();
    let text = sources("README.md");
    let empty = made_from("other.so", "int other(void) { return 1; }");
    let of_fmi2_only = format!("const char guid[] = \"{GUID}\"; int other(void) {{ return 1; }}");
    let of_both = format!("const char token[] = \"{INSTANTIATION_TOKEN}\"; {of_fmi2_only}");
    let of_fmi2_only = made_from("of-fmi2-only.so", &of_fmi2_only);
    let without_functions = made_from("without-functions.so", &of_both);
    for (platform, file, words) in [
        ("win64", ours, "is for Linux on X86_64, not for win64"),
        (
            "aarch64-linux",
            ours,
            "is for Linux on X86_64, not for aarch64-linux",
        ),
        ("darwin64", ours, "is for Linux on X86_64, not for darwin64"),
        ("linux64", &text, "is not a shared library that can be read"),
        (
            "linux64",
            &empty,
            "was built from another modelDescription.xml",
        ),
        (
            "linux64",
            &of_fmi2_only,
            "was built from another modelDescription.xml",
        ),
        (
            "linux64",
            &without_functions,
            "does not export fmi2GetTypesPlatform",
        ),
    ] {
        let message = fail(&mut package(&out, &[&binary(platform, file)]));
        assert!(
            message.contains(words) && message.contains(&file.display().to_string()),
            "{message}"
        );
        assert!(!out.exists());
    }
}

fn sources(name: &str) -> PathBuf {
    support::sources().join(name)
}

#[test]
fn contradictory_options_are_refused() {
    let out = scratch().join("contradictory.fmu");
    let ours = binary("linux64", library());
    for (options, words) in [
        (vec![&*ours, &ours], "two libraries are given for linux64"),
        (
            vec!["--platforms=win64", &ours],
            "is not among the platforms",
        ),
        (vec!["--platforms=arm", &ours], "is not among the platforms"),
        (vec!["--platforms=linux32"], "`linux32` is no platform"),
        (vec!["--platforms=all,win64"], "`all` is no platform"),
        (vec!["--binary=win64"], "name a platform and a file"),
    ] {
        let message = fail(&mut package(&out, &options));
        assert!(message.contains(words), "{message}");
    }
}

/// Instead of the error of a linker, minutes later.
#[test]
fn what_is_missing_to_build_for_a_platform_is_named_with_the_way_to_get_it() {
    let folder = scratch().join("no-tools");
    // A compiler that knows no other target.
    let compiler = folder.join("rustc");
    support::write_executable(&compiler, "#!/bin/sh\necho /no/such/folder\n");
    let out = folder.join("rotor.fmu");
    for (platform, words) in [
        ("linux64", "pip install ziglang cargo-zigbuild"),
        ("win64", "gcc-mingw-w64-x86-64-win32"),
        ("aarch64-darwin", "rustup target add aarch64-apple-darwin"),
    ] {
        let mut command = package(&out, &["--platforms", platform]);
        command.env("PATH", &folder).env("RUSTC", &compiler);
        let message = fail(&mut command);
        let other_way = format!("--binary {platform}=FILE");
        assert!(
            message.contains(words) && message.contains(&other_way),
            "{message}"
        );
    }
}

/// It would write its files beside the folder of the installed programs.
#[test]
fn a_program_that_cargo_has_installed_refuses_to_work_elsewhere() {
    let folder = scratch().join("cargo-home/bin");
    fs::create_dir_all(&folder).unwrap();
    let program = folder.join("helicopter-rotor");
    fs::hard_link(env!("CARGO_BIN_EXE_helicopter-rotor"), &program).unwrap();
    let message = fail(Command::new(&program).arg("package"));
    assert!(
        message.contains("works only in the source tree") && message.contains("cargo run"),
        "{message}"
    );
    assert_eq!(fs::read_dir(folder.parent().unwrap()).unwrap().count(), 1);
    succeed(Command::new(&program).arg("--help"));
}

// ---------------------------------------------------------------- the .fmu for all platforms

/// Names the .fmu for all platforms.
const FMU: &str = "HELICOPTER_ROTOR_FMU";

/// That .fmu, of FMI 2.0.
fn for_all_platforms() -> PathBuf {
    let file = env::var_os(FMU).unwrap_or_else(|| panic!("set {FMU} to the file"));
    PathBuf::from(file)
}

/// The one of FMI 3.0, beside it.
fn of_fmi3() -> PathBuf {
    for_all_platforms().with_file_name("HelicopterRotor-fmi3.fmu")
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_fmus_for_all_platforms_have_the_announced_size() {
    for file in [for_all_platforms(), of_fmi3()] {
        let size = fs::metadata(&file).unwrap().len();
        let file = file.display();
        assert!(
            size <= 5_000_000,
            "{file}: {size} bytes; docs/platforms.md says 5 MB"
        );
    }
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_fmu_for_all_platforms_has_the_page_for_browsers() {
    let files = support::content(&for_all_platforms());
    let page = String::from_utf8(files["documentation/rotor.html"].clone()).unwrap();
    assert!(page.contains(r#"{"description":"<?xml "#) && !page.contains(" src="));
    let index = String::from_utf8(files["documentation/index.html"].clone()).unwrap();
    assert!(index.contains(r#"href="rotor.html""#));
}

/// The binaries by the name of their platform. The universal one is in its parts.
fn binaries() -> Vec<(String, Vec<u8>)> {
    binaries_in(&for_all_platforms())
}

fn binaries_in(fmu: &Path) -> Vec<(String, Vec<u8>)> {
    let mut binaries = Vec::new();
    for (name, content) in support::content(fmu) {
        let Some(place) = name.strip_prefix("binaries/") else {
            continue;
        };
        let platform = place.split('/').next().unwrap().to_owned();
        if FileKind::parse(&*content).unwrap() != FileKind::MachOFat32 {
            binaries.push((platform, content));
            continue;
        }
        for part in MachOFatFile32::parse(&*content).unwrap().arches() {
            assert_eq!(part.offset.get(object::BigEndian) % (1 << 14), 0);
            binaries.push((platform.clone(), part.data(&*content).unwrap().to_vec()));
        }
    }
    binaries
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_fmu_for_all_platforms_has_a_binary_for_each() {
    let files = support::content(&for_all_platforms());
    let binaries: Vec<_> = files
        .keys()
        .filter(|n| n.starts_with("binaries/"))
        .collect();
    assert_eq!(
        binaries,
        [
            "binaries/aarch64-darwin/HelicopterRotor.dylib",
            "binaries/aarch64-linux/HelicopterRotor.so",
            "binaries/darwin64/HelicopterRotor.dylib",
            "binaries/linux64/HelicopterRotor.so",
            "binaries/win64/HelicopterRotor.dll",
        ]
    );
    assert_eq!(
        made_for(&self::binaries()),
        [
            "aarch64-darwin: MachO Aarch64",
            "aarch64-linux: Elf Aarch64",
            "darwin64: MachO X86_64",
            "darwin64: MachO Aarch64",
            "linux64: Elf X86_64",
            "win64: Pe X86_64",
        ]
    );
}

fn made_for(binaries: &[(String, Vec<u8>)]) -> Vec<String> {
    let made_for = binaries.iter().map(|(platform, content)| {
        let file = object::File::parse(&**content).unwrap();
        format!("{platform}: {:?} {:?}", file.format(), file.architecture())
    });
    made_for.collect()
}

/// Each is, byte for byte, a library or a part of one in the .fmu of FMI 2.0.
#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_fmu_of_fmi_3_has_a_binary_for_each_platform() {
    let [two, three] = [binaries(), binaries_in(&of_fmi3())];
    assert_eq!(
        made_for(&three),
        [
            "aarch64-darwin: MachO Aarch64",
            "aarch64-linux: Elf Aarch64",
            "x86_64-darwin: MachO X86_64",
            "x86_64-linux: Elf X86_64",
            "x86_64-windows: Pe X86_64",
        ]
    );
    for (platform, content) in three {
        assert!(
            two.iter().any(|(_, other)| *other == content),
            "{platform} has another library than the .fmu of FMI 2.0"
        );
    }
}

/// Code for Apple silicon is there once.
#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_library_in_aarch64_darwin_re_exports_that_in_darwin64_and_nothing_else() {
    let name = "binaries/aarch64-darwin/HelicopterRotor.dylib";
    let library = support::content(&for_all_platforms()).remove(name).unwrap();
    let file = MachO::read(&library);
    assert_eq!(
        file.re_exported,
        ["@loader_path/../darwin64/HelicopterRotor.dylib"]
    );
    // With this flag dyld would not look for re-exported functions.
    assert_eq!(file.flags & macho::MH_NO_REEXPORTED_DYLIBS.0, 0);
    let file = object::File::parse(&*library).unwrap();
    assert_eq!(file.sections().count(), 0, "it has code or data of its own");
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn a_library_that_only_re_exports_is_refused() {
    let name = "binaries/aarch64-darwin/HelicopterRotor.dylib";
    let given = scratch().join("re-exporting.dylib");
    fs::write(&given, &support::content(&for_all_platforms())[name]).unwrap();
    let out = scratch().join("re-exporting.fmu");
    let message = fail(&mut package(&out, &[&binary("aarch64-darwin", &given)]));
    assert!(
        message.contains("it re-exports the library in darwin64"),
        "{message}"
    );
}

/// For importers that unpack one folder alone.
#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn given_libraries_for_macos_stay_as_they_are() {
    let [two, three] = [for_all_platforms(), of_fmi3()].map(|fmu| support::content(&fmu));
    let universal = &two["binaries/darwin64/HelicopterRotor.dylib"];
    let silicon = &three["binaries/aarch64-darwin/HelicopterRotor.dylib"];
    let options =
        [("darwin64", universal), ("aarch64-darwin", silicon)].map(|(platform, library)| {
            let file = scratch().join(format!("given-{platform}.dylib"));
            fs::write(&file, library).unwrap();
            binary(platform, &file)
        });
    let out = scratch().join("given-macos.fmu");
    succeed(&mut package(&out, &[&options[0], &options[1]]));
    let of_fmi3 = scratch().join("given-macos-fmi3.fmu");
    for (fmu, darwin64) in [(&out, "darwin64"), (&of_fmi3, "x86_64-darwin")] {
        let content = support::content(fmu);
        let library = |folder: &str| &content[&format!("binaries/{folder}/HelicopterRotor.dylib")];
        assert!(library(darwin64) == universal, "{darwin64}");
        assert!(library("aarch64-darwin") == silicon, "{darwin64}");
    }
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn every_binary_with_code_exports_the_functions_of_the_standard_and_nothing_else() {
    let standard = fmi2::legality::TABLE.iter().chain(fmi3::legality::TABLE);
    let standard: BTreeSet<_> = standard.map(|function| function.name.to_owned()).collect();
    assert_eq!(standard.len(), 44 + 75);
    let of_fmi2 = binaries();
    let with_code = of_fmi2.iter().filter(|(p, _)| p != "aarch64-darwin");
    let of_fmi3 = binaries_in(&of_fmi3());
    for (platform, content) in with_code.chain(&of_fmi3) {
        assert_eq!(functions(content), standard, "{platform}");
    }
}

/// The functions that a binary exports, as in C.
fn functions(content: &[u8]) -> BTreeSet<String> {
    let file = object::File::parse(content).unwrap();
    let names = file.exports().unwrap().map(|export| {
        let export = export.unwrap();
        let object::NameOrOrdinal::Name(name) = export.name() else {
            panic!("{export:?} has no name");
        };
        let name = str::from_utf8(name).unwrap();
        // Mach-O puts an underscore before names of C.
        let is_macho = file.format() == BinaryFormat::MachO;
        let prefix = if is_macho { "_" } else { "" };
        name.strip_prefix(prefix).unwrap().to_owned()
    });
    names.collect()
}

/// Some importers for ARM Linux look for `linux64`, where others have the binary for x86-64.
#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_fmu_for_arm_has_the_same_binary_in_both_folders_and_says_so() {
    let all = support::content(&for_all_platforms());
    let library = scratch().join("arm.so");
    fs::write(&library, &all["binaries/aarch64-linux/HelicopterRotor.so"]).unwrap();
    let out = scratch().join("arm.fmu");
    let given = binary("aarch64-linux", &library);
    succeed(&mut package(&out, &["--platforms=arm", &given]));
    let mut arm = support::content(&out);
    for folder in ["linux64", "aarch64-linux"] {
        let name = format!("binaries/{folder}/HelicopterRotor.so");
        assert!(arm.remove(&name).unwrap() == all["binaries/aarch64-linux/HelicopterRotor.so"]);
    }
    let [xml, usual] = [&arm, &all].map(|files| {
        let text = str::from_utf8(&files["modelDescription.xml"]).unwrap();
        Document::parse(text).unwrap()
    });
    let [root, usual] = [&xml, &usual].map(|document| document.root_element());
    let said = root.attribute("description").unwrap();
    assert!(said.starts_with("For ARM Linux only: the binary in linux64 is for ARM. "));
    assert!(said.ends_with(usual.attribute("description").unwrap()));
    assert_eq!(root.attribute("guid"), usual.attribute("guid"));
    assert!(arm.keys().all(|name| !name.starts_with("binaries/")));
}

/// Libraries that every system of its kind has: no runtime of a compiler among them.
fn may_be_needed(format: BinaryFormat) -> &'static [&'static str] {
    match format {
        BinaryFormat::Elf => &[
            "libc.so.6",
            "libdl.so.2",
            "libpthread.so.0",
            "ld-linux-aarch64.so.1",
            "ld-linux-x86-64.so.2",
        ],
        BinaryFormat::Pe => &[
            "KERNEL32.dll",
            "USERENV.dll",
            "WS2_32.dll",
            "api-ms-win-core-synch-l1-2-0.dll",
            "bcryptprimitives.dll",
            "msvcrt.dll",
            "ntdll.dll",
        ],
        BinaryFormat::MachO => &["/usr/lib/libSystem.B.dylib"],
        other => panic!("no system has binaries of the format {other:?}"),
    }
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn every_binary_needs_only_what_its_system_has() {
    for (platform, content) in binaries() {
        let needed = match object::File::parse(&*content).unwrap() {
            object::File::MachO64(_) => MachO::read(&content).needed,
            object::File::Elf64(file) => needed_by_elf(&file),
            file => {
                let imports = file.imports().unwrap().map(|import| import.unwrap());
                imports
                    .map(|import| String::from_utf8_lossy(import.library()).into_owned())
                    .collect()
            }
        };
        let format = object::File::parse(&*content).unwrap().format();
        assert!(!needed.is_empty(), "{platform}");
        for library in needed {
            assert!(
                may_be_needed(format).contains(&library.as_str()),
                "{platform} needs {library}"
            );
        }
    }
}

/// The libraries that an ELF file names.
fn needed_by_elf(file: &object::read::elf::ElfFile64<'_>) -> BTreeSet<String> {
    let table = file.elf_dynamic_table().unwrap();
    table
        .iter()
        .filter(|entry| entry.tag == object::elf::DT_NEEDED)
        .map(|entry| String::from_utf8_lossy(table.string(entry).unwrap()).into_owned())
        .collect()
}

/// What the load commands of a Mach-O file say.
struct MachO {
    needed: BTreeSet<String>,
    /// The libraries that it re-exports.
    re_exported: Vec<String>,
    flags: u32,
    name: String,
    /// The oldest macOS, as in 0x000b_0000 for 11.0.
    oldest: u32,
    /// The place and size of the signature.
    signature: Option<(usize, usize)>,
}

impl MachO {
    fn read(content: &[u8]) -> Self {
        let mut this = Self {
            needed: BTreeSet::new(),
            re_exported: vec![],
            flags: 0,
            name: String::new(),
            oldest: u32::MAX,
            signature: None,
        };
        let header = MachHeader64::<object::Endianness>::parse(content, 0).unwrap();
        let endian = header.endian().unwrap();
        this.flags = header.flags(endian).0;
        let mut commands = header.load_commands(endian, content, 0).unwrap();
        while let Some(command) = commands.next().unwrap() {
            let text = |place| {
                let text = command.string(endian, place).unwrap();
                String::from_utf8_lossy(text).into_owned()
            };
            match command.variant().unwrap() {
                LoadCommandVariant::Dylib(dylib)
                    if dylib.cmd.get(endian) == macho::LC_REEXPORT_DYLIB =>
                {
                    this.re_exported.push(text(dylib.dylib.name));
                }
                LoadCommandVariant::Dylib(dylib) => {
                    this.needed.insert(text(dylib.dylib.name));
                }
                LoadCommandVariant::IdDylib(dylib) => this.name = text(dylib.dylib.name),
                LoadCommandVariant::BuildVersion(version, _) => {
                    this.oldest = version.minos.get(endian).0;
                }
                LoadCommandVariant::LinkeditData(data)
                    if data.cmd.get(endian) == macho::LC_CODE_SIGNATURE =>
                {
                    let place = data.dataoff.get(endian) as usize;
                    this.signature = Some((place, data.datasize.get(endian) as usize));
                }
                _ => {}
            }
        }
        this
    }
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_binaries_for_linux_run_with_glibc_2_17() {
    let mut count = 0;
    for (platform, content) in binaries() {
        if !platform.contains("linux") {
            continue;
        }
        for (place, _) in content
            .windows(6)
            .enumerate()
            .filter(|(_, w)| w == b"GLIBC_")
        {
            let version = content[place + 6..].split(|b| *b == 0).next().unwrap();
            let version = str::from_utf8(version).unwrap();
            let parts: Vec<u32> = version.split('.').map(|n| n.parse().unwrap()).collect();
            assert!(parts <= vec![2, 17], "{platform} needs GLIBC_{version}");
            count += 1;
        }
    }
    assert!(count >= 2);
}

#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_binaries_for_macos_are_for_version_11_and_are_named_without_a_folder() {
    let mut count = 0;
    for (platform, content) in binaries() {
        if platform.contains("darwin") {
            let file = MachO::read(&content);
            assert!(file.oldest <= 0x000b_0000, "{platform}: {:x}", file.oldest);
            assert_eq!(file.name, "@rpath/HelicopterRotor.dylib", "{platform}");
            count += 1;
        }
    }
    assert_eq!(count, 3);
}

/// macOS on ARM ends a process that loads a library whose pages do not match its signature.
#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn the_binaries_for_macos_on_arm_have_a_valid_signature() {
    let mut count = 0;
    for (platform, content) in binaries() {
        let file = object::File::parse(&*content).unwrap();
        let is_arm = file.architecture() == object::Architecture::Aarch64;
        if file.format() != BinaryFormat::MachO || !is_arm {
            continue;
        }
        let (begin, size) = MachO::read(&content).signature.expect("it is signed");
        let signature = &content[begin..begin + size];
        let number = |bytes: &[u8], place: usize| {
            u32::from_be_bytes(bytes[place..place + 4].try_into().unwrap()) as usize
        };
        assert_eq!(
            number(signature, 0),
            macho::CSMAGIC_EMBEDDED_SIGNATURE as usize
        );
        // The first entry is the code directory.
        let directory = &signature[number(signature, 16)..];
        assert_eq!(number(directory, 0), macho::CSMAGIC_CODEDIRECTORY as usize);
        let (hashes, pages, end) = (
            number(directory, 16),
            number(directory, 28),
            number(directory, 32),
        );
        assert_eq!(
            (directory[36], directory[37], end),
            (32, 2, begin),
            "{platform}"
        );
        let page_size = 1 << directory[39];
        assert_eq!(pages, begin.div_ceil(page_size));
        for (page, content) in content[..end].chunks(page_size).enumerate() {
            let hash = &directory[hashes + 32 * page..][..32];
            assert_eq!(hash, &*Sha256::digest(content), "{platform}: page {page}");
        }
        count += 1;
    }
    assert_eq!(count, 2);
}

/// Else the same source gives another file in another folder, and tells where it was built.
#[test]
#[ignore = "needs the .fmu that .ci/platforms makes"]
fn no_binary_names_a_folder_of_the_machine_on_which_it_was_built() {
    let here = support::sources().to_str().unwrap().to_owned();
    let home = env::var("HOME").unwrap() + "/";
    for (platform, content) in binaries() {
        for text in [&*here, &*home, "/registry/src/", "/.rustup/"] {
            let found = content
                .windows(text.len())
                .position(|w| w == text.as_bytes());
            let shown = found.map(|place| {
                let end = content.len().min(place + 200);
                String::from_utf8_lossy(&content[place..end]).into_owned()
            });
            assert_eq!(shown, None, "{platform} contains {text}");
        }
    }
}
