//! The .fmu as the program packages it, unpacked and loaded.

use super::c::Functions;
use std::{
    fs,
    path::{Path, PathBuf},
    process::Command,
    sync::OnceLock,
};

/// Tells a child process (see `child`) where its parent has unpacked the FMU.
pub const UNPACKED: &str = "HELICOPTER_ROTOR_UNPACKED_FMU";

/// A folder of this process for the files of its tests; those of ended processes are removed.
pub fn scratch() -> &'static Path {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let all = Path::new(env!("CARGO_TARGET_TMPDIR"));
        let prefix = concat!(env!("CARGO_CRATE_NAME"), "-");
        if Path::new("/proc/self").exists() {
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
        let mut program = Command::new(env!("CARGO_BIN_EXE_helicopter-rotor"));
        let output = program
            .arg("package")
            .arg("--out")
            .arg(&file)
            .output()
            .unwrap();
        assert!(
            output.status.success(),
            "package: {}",
            String::from_utf8_lossy(&output.stderr)
        );
        file
    })
}

/// Unpacks the .fmu into a folder.
pub fn unpack_into(folder: &Path) {
    let file = fs::File::open(packaged_fmu()).unwrap();
    zip::ZipArchive::new(file).unwrap().extract(folder).unwrap();
}

/// The `file:` URI of a path, with everything percent-encoded but letters, digits, `/`, `-` and `.`.
pub fn uri(path: &Path) -> String {
    let mut uri = "file://".to_owned();
    for byte in path.to_str().unwrap().bytes() {
        if byte.is_ascii_alphanumeric() || b"/-.".contains(&byte) {
            uri.push(byte.into());
        } else {
            uri += &format!("%{byte:02X}");
        }
    }
    uri
}

/// An unpacked FMU with its shared library loaded.
pub struct Fmu {
    pub functions: Functions,
    pub folder: PathBuf,
    library: libloading::Library,
}

impl Fmu {
    /// The FMU that the tests of this process share.
    pub fn shared() -> &'static Self {
        static FMU: OnceLock<Fmu> = OnceLock::new();
        FMU.get_or_init(|| {
            let folder = std::env::var_os(UNPACKED)
                .map(PathBuf::from)
                .unwrap_or_else(|| {
                    let folder = scratch().join("unpacked");
                    unpack_into(&folder);
                    folder
                });
            Self::load(&folder)
        })
    }

    /// Loads the shared library in an unpacked FMU.
    pub fn load(folder: &Path) -> Self {
        // SAFETY: the library has no initialisation routines but those of the C runtime.
        let library = unsafe { libloading::Library::new(binary(folder)) }.unwrap();
        // SAFETY: it is ours, and is kept with the functions.
        let functions = unsafe { Functions::find(&library) };
        Self {
            functions,
            folder: folder.to_owned(),
            library,
        }
    }

    /// Unloads the library; the instances must be freed.
    pub fn unload(self) {
        self.library.close().unwrap();
    }

    pub fn resources(&self) -> PathBuf {
        self.folder.join("resources")
    }
}

/// The shared library in an unpacked FMU: the one file in its `binaries/<platform>/`.
pub fn binary(folder: &Path) -> PathBuf {
    let only = |folder: &Path| {
        let mut entries = fs::read_dir(folder).unwrap();
        let first = entries.next().unwrap().unwrap().path();
        assert!(
            entries.next().is_none(),
            "more than one file in {}",
            folder.display()
        );
        first
    };
    only(&only(&folder.join("binaries")))
}
