//! What an importer passes behind pointers: arrays and strings.

use super::{instance::Message, types::fmi2String};
use core::ffi::CStr;
use std::slice;

/// The elements behind a pointer; none where the importer says that there are none.
///
/// # Safety
/// `pointer` is null or points to `count` initialised elements that live as long as the slice.
pub unsafe fn elements<'a, T>(
    pointer: *const T,
    count: usize,
    what: &str,
) -> Result<&'a [T], Message> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer, but {count} are announced"
        )));
    }
    // SAFETY: by the contract above.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// As `elements`, for what the function writes.
///
/// # Safety
/// As `elements`, and nothing else refers to the elements.
pub unsafe fn elements_mut<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [T], Message> {
    if count == 0 {
        return Ok(&mut []);
    }
    if pointer.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer, but {count} are announced"
        )));
    }
    // SAFETY: by the contract above.
    Ok(unsafe { slice::from_raw_parts_mut(pointer, count) })
}

/// The text behind a C string.
///
/// # Safety
/// `text` is null or a C string that lives as long as the answer.
pub unsafe fn text<'a>(text: fmi2String, what: &str) -> Result<&'a str, Message> {
    if text.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer; pass a string"
        )));
    }
    // SAFETY: by the contract above.
    let bytes = unsafe { CStr::from_ptr(text) };
    bytes
        .to_str()
        .map_err(|_| Message::Error(format!("{what} is no valid UTF-8; pass UTF-8")))
}
