//! Libraries for other platforms, for other machines of this one, and for browsers: the targets,
//! linkers and options with which cargo builds them. The same source and compiler give the same
//! bytes in every folder.

use super::{
    binary::{self, Binary},
    compiler::{self, LIMIT, said_by},
    library, macos,
    platform::Platform,
};
use crate::{Failure, failed, files, process, sources};
use helicopter_rotor::block::variables::MODEL_IDENTIFIER;
use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// The oldest C library of Linux on which the library runs.
const GLIBC: &str = "2.17";

/// Builds the library for a platform with cargo, in a folder of its own in cargo's target folder.
pub fn build(platform: Platform, target: &Path) -> Result<Binary, Failure> {
    let folder = target.join("platforms");
    match platform {
        Platform::Linux64 => linux(platform, "x86_64-unknown-linux-gnu", &folder),
        Platform::Aarch64Linux => linux(platform, "aarch64-unknown-linux-gnu", &folder),
        Platform::Win64 => windows(&folder),
        Platform::Aarch64Darwin => for_macos("aarch64-apple-darwin", &folder),
        Platform::Darwin64 => Ok(macos::universal([
            &for_macos("x86_64-apple-darwin", &folder)?,
            &for_macos("aarch64-apple-darwin", &folder)?,
        ])),
    }
}

/// Zig links for any version of the C library.
fn linux(platform: Platform, target: &'static str, folder: &Path) -> Result<Binary, Failure> {
    let mut version = Command::new("cargo-zigbuild");
    let missing = format!(
        "{platform} needs cargo-zigbuild on the PATH, which links for glibc {GLIBC}; install it with `pip install ziglang cargo-zigbuild`, or name a built library with --binary {platform}=FILE"
    );
    process::run_quietly(version.arg("--version"), LIMIT).map_err(failed(missing))?;
    let build = Build::for_platform(platform, target)?;
    let mut command = Command::new("cargo-zigbuild");
    command.args(["rustc", "--target", &format!("{target}.{GLIBC}")]);
    build.binary(platform, command, folder)
}

fn windows(folder: &Path) -> Result<Binary, Failure> {
    let platform = Platform::Win64;
    if cfg!(all(windows, target_env = "msvc")) {
        let target = "x86_64-pc-windows-msvc";
        let mut build = Build::for_platform(platform, target)?;
        // Needs no runtime of Visual C++.
        build.flags(["-Ctarget-feature=+crt-static", "-Clink-arg=/Brepro"]);
        return build.binary(platform, cargo(target), folder);
    }
    let target = "x86_64-pc-windows-gnu";
    let linkers = ["x86_64-w64-mingw32-gcc-win32", "x86_64-w64-mingw32-gcc"];
    let runs =
        |linker: &&str| process::run_quietly(Command::new(linker).arg("--version"), LIMIT).is_ok();
    let linker = linkers.into_iter().find(runs).ok_or_else(|| {
        Failure(format!(
            "{platform} needs the linker {} on the PATH; install MinGW-w64 (on Debian or Ubuntu the package gcc-mingw-w64-x86-64-win32), or name a built library with --binary {platform}=FILE",
            linkers[1]
        ))
    })?;
    let mut build = Build::for_platform(platform, target)?;
    build.flags([
        &format!("-Clinker={linker}"),
        "-Clink-arg=-Wl,--no-insert-timestamp",
    ]);
    // It sorts the imports by the names of files with their folders. With a dot, the folder of its
    // own import libraries comes before that of the build, wherever that is.
    let library = said_by(Command::new(linker).arg("-print-file-name=libkernel32.a"))?;
    if let Some((libraries, _)) = library.rsplit_once('/')
        && libraries.starts_with('/')
    {
        build.flags([format!("-Lnative=/.{libraries}")]);
    }
    build.binary(platform, cargo(target), folder)
}

/// On other systems the compiler's own linker is used, and a list of what macOS 11 has in the place
/// of Apple's SDK.
fn for_macos(target: &'static str, folder: &Path) -> Result<Binary, Failure> {
    let platform = match target.starts_with("x86_64") {
        true => Platform::Darwin64,
        false => Platform::Aarch64Darwin,
    };
    let mut build = Build::for_platform(platform, target)?;
    let mut command = cargo(target);
    command.env("MACOSX_DEPLOYMENT_TARGET", macos::OLDEST);
    let name = format!("@rpath/{MODEL_IDENTIFIER}{}", platform.suffix());
    if cfg!(target_os = "macos") {
        build.flags([&format!("-Clink-arg=-Wl,-install_name,{name}")]);
        return build.binary(platform, command, folder);
    }
    let sdk = folder.join("MacOSX.sdk");
    macos::write_sdk(&sdk)?;
    // The linker strips: stripping afterwards would break the signature that it makes.
    command
        .env("SDKROOT", sdk)
        .env("CARGO_PROFILE_RELEASE_STRIP", "none");
    build.flags(["-Clinker=rust-lld", "-Clinker-flavor=ld64.lld"]);
    build.flags(
        ["-S", "-x", "-dead_strip_dylibs", "-install_name", &name]
            .map(|argument| format!("-Clink-arg={argument}")),
    );
    build.binary(platform, command, folder)
}

/// Builds the library in WebAssembly, for the page. Its table of functions is exported, and can
/// grow by the importer's logger.
pub fn web(target: &Path) -> Result<Vec<u8>, Failure> {
    let triple = "wasm32-unknown-unknown";
    let mut build = Build::new("the page", "", triple)?;
    build.flags(["-Clink-arg=--export-table", "-Clink-arg=--growable-table"]);
    let mut command = cargo(triple);
    // Half of what the page has to load is this library.
    command.env("CARGO_PROFILE_RELEASE_OPT_LEVEL", "s");
    files::read(&build.file(command, &target.join("platforms"), ".wasm")?)
}

fn cargo(target: &str) -> Command {
    let mut command = Command::new(library::cargo());
    command.args(["rustc", "--target", target]);
    command
}

/// How a library is built.
struct Build {
    target: &'static str,
    flags: Vec<String>,
}

impl Build {
    fn for_platform(platform: Platform, target: &'static str) -> Result<Self, Failure> {
        let other = format!(", or name a built library with --binary {platform}=FILE");
        Self::new(platform.folder(), &other, target)
    }

    /// Fails if the compiler has no standard library for the target, with what the user can do
    /// besides installing it.
    fn new(purpose: &str, other: &str, target: &'static str) -> Result<Self, Failure> {
        let folder =
            said_by(compiler::command().args(["--print", "target-libdir", "--target", target]))?;
        if !Path::new(&folder).is_dir() {
            return Err(Failure(format!(
                "{purpose} needs Rust's standard library for {target}; install it with `rustup target add {target}`{other}"
            )));
        }
        Ok(Self {
            target,
            flags: vec![],
        })
    }

    fn flags<S: AsRef<str>, const N: usize>(&mut self, flags: [S; N]) {
        self.flags
            .extend(flags.map(|flag| flag.as_ref().to_owned()));
    }

    fn binary(
        self,
        platform: Platform,
        command: Command,
        folder: &Path,
    ) -> Result<Binary, Failure> {
        binary::read(platform, &self.file(command, folder, platform.suffix())?)
    }

    /// Runs a command of cargo that ends with the target, and returns the library that has this
    /// ending.
    fn file(
        mut self,
        mut command: Command,
        folder: &Path,
        suffix: &str,
    ) -> Result<PathBuf, Failure> {
        for (from, to) in renamed_folders(self.target, folder)? {
            let flag = format!("--remap-path-prefix={}={to}", from.display());
            self.flags.push(flag);
        }
        // An .fmu has up to five of these libraries. With the inlining threshold of level "s", 50
        // in place of 225, they are 10 % smaller. A step takes up to 5 % more instructions, a start
        // in hover, which is mostly reading files, 12 to 16 % more.
        self.flags.push("-Cllvm-args=-inline-threshold=50".into());
        command
            .args(["--release", "--locked", "--crate-type", "cdylib"])
            .env("CARGO_PROFILE_RELEASE_LTO", "fat")
            .env("CARGO_ENCODED_RUSTFLAGS", self.flags.join("\x1f"));
        library::run(command, folder, suffix)
    }
}

/// The folders whose names would be in the library, where panics are, and what they are called
/// there.
fn renamed_folders(target: &str, target_folder: &Path) -> Result<Vec<(PathBuf, String)>, Failure> {
    let mut renamed = vec![
        (sources().to_path_buf(), "/helicopter-rotor".to_owned()),
        (target_folder.to_path_buf(), "/target".to_owned()),
    ];
    // The standard library's source, if the component rust-src is installed.
    let commit = compiler::commit()?;
    renamed.push((
        compiler::sysroot()?.join("lib/rustlib/src/rust"),
        format!("/rustc/{}", commit.as_deref().unwrap_or("unknown")),
    ));
    let mut metadata = Command::new(library::cargo());
    metadata
        .args([
            "metadata",
            "--format-version",
            "1",
            "--locked",
            "--filter-platform",
            target,
            "--manifest-path",
        ])
        .arg(sources().join("Cargo.toml"));
    let metadata = said_by(&mut metadata)?;
    let metadata: serde_json::Value = serde_json::from_str(&metadata)
        .map_err(failed("cannot read what `cargo metadata` says"))?;
    let packages = metadata["packages"].as_array().into_iter().flatten();
    for package in packages.filter(|package| !package["source"].is_null()) {
        let manifest = Path::new(package["manifest_path"].as_str().unwrap_or_default());
        let folder = manifest.ancestors().nth(2).unwrap_or(manifest);
        if !renamed.iter().any(|(known, _)| known == folder) {
            renamed.push((folder.to_path_buf(), "/crates".to_owned()));
        }
    }
    Ok(renamed)
}
