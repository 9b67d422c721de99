//! Shared by the tests of the program: the packaged .fmu, a folder for files, the Python
//! environment, the program installed elsewhere, and running commands.

use std::{
    collections::BTreeMap,
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
    process::Command,
    sync::OnceLock,
};

/// The source tree.
pub fn sources() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .ancestors()
        .nth(2)
        .unwrap()
}

/// The program under test.
pub fn program() -> Command {
    Command::new(env!("CARGO_BIN_EXE_helicopter-rotor"))
}

/// Runs a command that must succeed, and returns its output.
#[track_caller]
pub fn succeed(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}\n{errors}");
    text
}

/// Runs a command that must fail, and returns its error message.
#[track_caller]
pub fn fail(command: &mut Command) -> String {
    let output = command.output().unwrap();
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(!output.status.success(), "{text}");
    String::from_utf8_lossy(&output.stderr).into_owned()
}

/// A folder for the files of this test process. Folders of ended processes are removed.
pub fn scratch() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let prefix = concat!(env!("CARGO_CRATE_NAME"), "-");
        if cfg!(target_os = "linux") {
            for entry in fs::read_dir(all).into_iter().flatten().flatten() {
                let name = entry.file_name().to_string_lossy().into_owned();
                let process = name
                    .strip_prefix(prefix)
                    .and_then(|id| id.parse::<u32>().ok());
                if process.is_some_and(|id| !Path::new(&format!("/proc/{id}")).exists()) {
                    // Another process may remove it at the same time.
                    let _ = fs::remove_dir_all(entry.path());
                }
            }
        }
        let folder = all.join(format!("{prefix}{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        folder
    })
}

/// The .fmu, packaged once in each process.
pub fn packaged_fmu() -> &'static Path {
    static FILE: OnceLock<PathBuf> = OnceLock::new();
    FILE.get_or_init(|| {
        let file = scratch().join("HelicopterRotor.fmu");
        succeed(program().args(["package", "--out"]).arg(&file));
        file
    })
}

/// The files in the archive by name.
pub fn content(fmu: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut archive = zip::ZipArchive::new(File::open(fmu).unwrap()).unwrap();
    (0..archive.len())
        .map(|i| {
            let mut file = archive.by_index(i).unwrap();
            let name = file.name().unwrap().into_owned();
            let mut bytes = Vec::new();
            file.read_to_end(&mut bytes).unwrap();
            (name, bytes)
        })
        .collect()
}

/// The interpreter of the examples' environment, which is made if it is missing.
pub fn interpreter() -> &'static Path {
    static INTERPRETER: OnceLock<PathBuf> = OnceLock::new();
    INTERPRETER.get_or_init(|| {
        let path = succeed(program().arg("python"));
        PathBuf::from(path.trim())
    })
}

/// Runs a script of the source tree in that environment.
pub fn python(script: &str) -> Command {
    let mut command = Command::new(interpreter());
    command.arg(sources().join(script));
    command
}

/// The shared library in the packaged FMU, as a file.
pub fn library() -> &'static Path {
    static FILE: OnceLock<PathBuf> = OnceLock::new();
    FILE.get_or_init(|| {
        let file = scratch().join("library.so");
        let fmu = File::open(packaged_fmu()).unwrap();
        let mut archive = zip::ZipArchive::new(fmu).unwrap();
        let mut binary = archive
            .by_name("binaries/linux64/HelicopterRotor.so")
            .unwrap();
        io::copy(&mut binary, &mut File::create(&file).unwrap()).unwrap();
        file
    })
}

/// The program in a new target folder, in which there is no Python environment yet. It is a link,
/// as a copy being written is "busy" to a process that another test starts at that moment.
pub fn installed(name: &str) -> PathBuf {
    let folder = scratch().join(name).join("debug");
    fs::create_dir_all(&folder).unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_helicopter-rotor"));
    let link = folder.join(program.file_name().unwrap());
    fs::hard_link(program, &link).unwrap();
    link
}

/// The target folder of an installed program.
pub fn target(installed: &Path) -> &Path {
    installed.ancestors().nth(2).unwrap()
}

/// Writes a shell script, in a process of its own for the same reason.
pub fn write_executable(file: &Path, text: &str) {
    fs::create_dir_all(file.parent().unwrap()).unwrap();
    let write = r#"printf '%s' "$1" >"$0" && chmod +x "$0""#;
    succeed(Command::new("sh").args(["-c", write]).arg(file).arg(text));
}

/// Gives an installed program a complete Python environment in which all scripts are this shell
/// script.
pub fn install_interpreter(installed: &Path, script: &str) {
    let folder = target(installed).join("python");
    let text = format!("#!/bin/sh\n[ \"$1\" = -c ] && exit 0\n{script}\n");
    write_executable(&folder.join("bin/python"), &text);
    let requirements = sources().join("fmu-examples/requirements.txt");
    fs::copy(requirements, folder.join("requirements.txt")).unwrap();
}

/// The names of the hidden folders in which new files are made.
pub fn drafts(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).unwrap().map(|e| e.unwrap().path());
    entries
        .filter(|path| path.extension().is_some_and(|e| e == "tmp"))
        .collect()
}

/// Loads `calls.c` into a program, which then writes its calls to the file `calls`.
pub fn observe(command: &mut Command, calls: &Path) {
    static LIBRARY: OnceLock<PathBuf> = OnceLock::new();
    let library = LIBRARY.get_or_init(|| {
        let library = scratch().join("calls.so");
        let source = sources().join("crates/program/tests/commands/calls.c");
        let mut compiler = Command::new("cc");
        compiler.args(["-shared", "-fPIC", "-o"]);
        succeed(compiler.arg(&library).arg(source).arg("-ldl"));
        library
    });
    command.env("LD_PRELOAD", library).env("CALLS", calls);
}
