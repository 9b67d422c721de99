//! Where this shared library is.

use std::path::PathBuf;

/// The file of this shared library, if the system tells.
///
/// The system is asked by the address of something private: at the address of an exported function
/// lies that of another FMU, if the importer has loaded that first into its global namespace.
#[cfg(unix)]
pub fn library_file() -> Option<PathBuf> {
    use std::os::unix::ffi::OsStrExt;
    static INSIDE: u8 = 0;
    // SAFETY: `info` is a plain C structure for which zeros are valid; dladdr writes it.
    let name = unsafe {
        let mut info: libc::Dl_info = std::mem::zeroed();
        if libc::dladdr((&raw const INSIDE).cast(), &mut info) == 0 || info.dli_fname.is_null() {
            return None;
        }
        std::ffi::CStr::from_ptr(info.dli_fname)
    };
    std::path::Path::new(std::ffi::OsStr::from_bytes(name.to_bytes()))
        .canonicalize()
        .ok()
}

/// The file of this shared library, if the system tells.
#[cfg(not(unix))]
pub fn library_file() -> Option<PathBuf> {
    None
}
