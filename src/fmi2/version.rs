//! The version of FMI: fmi2Functions.h, "Inquire version numbers of header files".

#![allow(non_snake_case)]

use core::ffi::c_char;

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetTypesPlatform() -> *const c_char {
    c"default".as_ptr()
}

#[unsafe(no_mangle)]
pub extern "C" fn fmi2GetVersion() -> *const c_char {
    c"2.0".as_ptr()
}
