//! Where this shared library is.
//!
//! The system is asked by the address of something private: at the address of an exported function
//! lies that of another FMU, if the importer has loaded that first into its global namespace.

use std::path::PathBuf;

/// Lies in this library.
#[cfg(any(unix, windows))]
static INSIDE: u8 = 0;

/// The file of this shared library, if the system tells.
#[cfg(unix)]
pub fn library_file() -> Option<PathBuf> {
    use std::os::unix::ffi::OsStrExt;
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
#[cfg(windows)]
pub fn library_file() -> Option<PathBuf> {
    use std::{ffi::OsString, os::windows::ffi::OsStringExt};
    let mut module = core::ptr::null_mut();
    // SAFETY: with these flags the function takes an address for the name, and only writes the
    // module to which it belongs.
    let found = unsafe {
        kernel32::GetModuleHandleExW(
            kernel32::FROM_ADDRESS | kernel32::UNCHANGED_REFCOUNT,
            (&raw const INSIDE).cast(),
            &mut module,
        )
    };
    if found == 0 {
        return None;
    }
    let mut name = vec![0_u16; kernel32::LONGEST_PATH];
    // SAFETY: it writes at most as many units as it is told.
    let length =
        unsafe { kernel32::GetModuleFileNameW(module, name.as_mut_ptr(), name.len() as u32) };
    let name = name
        .get(..length as usize)
        .filter(|name| !name.is_empty())?;
    // Not `canonicalize`, which answers a path with \\?\ that few programs read.
    std::path::absolute(OsString::from_wide(name)).ok()
}

/// The functions of Windows that tell it, and their constants, as libloaderapi.h declares them.
#[cfg(windows)]
mod kernel32 {
    use core::ffi::c_void;

    /// The name is an address in the module.
    pub const FROM_ADDRESS: u32 = 4;
    /// The module is not kept.
    pub const UNCHANGED_REFCOUNT: u32 = 2;
    /// Units of the longest path that Windows knows, with its final zero.
    pub const LONGEST_PATH: usize = 32_768;

    #[link(name = "kernel32")]
    unsafe extern "system" {
        pub fn GetModuleHandleExW(flags: u32, name: *const u16, module: *mut *mut c_void) -> i32;
        pub fn GetModuleFileNameW(module: *mut c_void, name: *mut u16, size: u32) -> u32;
    }
}

/// The file of this shared library: elsewhere the system does not tell.
#[cfg(not(any(unix, windows)))]
pub fn library_file() -> Option<PathBuf> {
    None
}
