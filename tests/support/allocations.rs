//! Counting allocations and letting them fail, by a small C library that is loaded before the
//! system's. For tests in a child process (see `child`).

use super::fmu::scratch;
use std::{ffi::c_int, path::PathBuf, process::Command};

/// The library, built by the C compiler that also links these tests.
pub fn library() -> PathBuf {
    let source = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/support/allocations.c");
    let library = scratch().join("allocations.so");
    let status = Command::new("cc")
        .args(["-shared", "-fPIC", "-O1", "-o"])
        .arg(&library)
        .arg(source)
        .status();
    assert!(
        status.is_ok_and(|status| status.success()),
        "cc cannot build {source}; install a C compiler"
    );
    library
}

/// The functions of the library, in a process that was started with it.
pub struct Allocations {
    begin: unsafe extern "C" fn(i64, c_int),
    end: unsafe extern "C" fn() -> i64,
}

impl Allocations {
    pub fn find() -> Self {
        let process = libloading::os::unix::Library::this();
        // SAFETY: the functions have these types in allocations.c.
        unsafe {
            Self {
                begin: *process.get(b"allocations_begin").unwrap(),
                end: *process.get(b"allocations_end").unwrap(),
            }
        }
    }

    /// The number of allocations in a part of a test.
    pub fn count(&self, part: impl FnOnce()) -> i64 {
        self.fail(0, false, part).1
    }

    /// Does a part of a test in which allocation number `first` fails (0: none) and, if `and_all`,
    /// all after it. Returns its answer and the number of allocations.
    pub fn fail<T>(&self, first: i64, and_all: bool, part: impl FnOnce() -> T) -> (T, i64) {
        // SAFETY: the functions may be called at any time.
        unsafe { (self.begin)(first, and_all.into()) };
        let answer = part();
        // SAFETY: as above.
        (answer, unsafe { (self.end)() })
    }
}
