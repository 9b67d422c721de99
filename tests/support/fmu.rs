//! The FMU as an importer has it on its disk, loaded.

use super::{c::Functions, c3};
use helicopter_rotor::{block::variables::MODEL_IDENTIFIER, description};
use std::{
    env::consts::{DLL_PREFIX, DLL_SUFFIX},
    fs,
    path::{Path, PathBuf},
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
        // With the drive, on Windows.
        std::path::absolute(folder).unwrap()
    })
}

/// The shared library that cargo has built for these tests, beside them.
fn library() -> PathBuf {
    let tests = std::env::current_exe().unwrap();
    tests.with_file_name(format!("{DLL_PREFIX}helicopter_rotor{DLL_SUFFIX}"))
}

/// The folder of this platform in an FMU.
pub fn platform() -> &'static str {
    use std::env::consts::{ARCH, OS};
    match (OS, ARCH) {
        ("linux", "x86_64") => "linux64",
        ("windows", "x86_64") => "win64",
        ("macos", "x86_64") => "darwin64",
        ("linux", "aarch64") => "aarch64-linux",
        ("macos", "aarch64") => "aarch64-darwin",
        _ => panic!("an FMU has no folder for {OS} on {ARCH}"),
    }
}

/// Lays the FMU out in a folder as it is when an importer has unpacked it.
pub fn unpack_into(folder: &Path) {
    let binaries = folder.join("binaries").join(platform());
    fs::create_dir_all(&binaries).unwrap();
    let binary = binaries.join(format!("{MODEL_IDENTIFIER}{DLL_SUFFIX}"));
    fs::copy(library(), binary).unwrap();
    fs::write(folder.join("modelDescription.xml"), description::XML).unwrap();
    let resources = Path::new(env!("CARGO_MANIFEST_DIR")).join("modelDescription/resources");
    copy_folder(&resources, &folder.join("resources"));
}

fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let copy = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy_folder(&path, &copy);
        } else {
            fs::copy(&path, &copy).unwrap();
        }
    }
}

/// The `file:` URI of an absolute path, with everything percent-encoded but letters, digits, `/`,
/// `-` and `.`.
pub fn uri(path: &Path) -> String {
    let mut path = path.to_str().unwrap().to_owned();
    if cfg!(windows) {
        // A path begins with a slash, also before a drive.
        path = format!("/{}", path.replace('\\', "/"));
    }
    let mut uri = "file://".to_owned();
    for byte in path.bytes() {
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
    pub of_fmi3: c3::Functions,
    pub folder: PathBuf,
    library: libloading::Library,
}

impl Fmu {
    /// The FMU that the tests of this process share.
    pub fn shared() -> &'static Self {
        static FMU: OnceLock<Fmu> = OnceLock::new();
        FMU.get_or_init(|| {
            let folder = std::env::var_os(UNPACKED)
                // With the drive, on Windows.
                .map(|folder| std::path::absolute(folder).unwrap())
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
        let (functions, of_fmi3) =
            unsafe { (Functions::find(&library), c3::Functions::find(&library)) };
        Self {
            functions,
            of_fmi3,
            folder: folder.to_owned(),
            library,
        }
    }

    /// Unloads the library; the instances must be freed.
    pub fn unload(self) {
        self.library.close().unwrap();
    }

    /// modelDescription.xml.
    pub fn description(&self) -> String {
        fs::read_to_string(self.folder.join("modelDescription.xml")).unwrap()
    }

    pub fn resources(&self) -> PathBuf {
        self.folder.join("resources")
    }
}

/// The shared library for this platform in an unpacked FMU.
pub fn binary(folder: &Path) -> PathBuf {
    let binaries = folder.join("binaries").join(platform());
    binaries.join(format!("{MODEL_IDENTIFIER}{DLL_SUFFIX}"))
}
