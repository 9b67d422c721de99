//! What an importer passes behind pointers: arrays, memory for results, and strings.
//!
//! Before a reference is made, a pointer is checked for null, for alignment and for a size that
//! memory can have. Only the importer knows whether the memory is there.

use super::{
    instance::{Message, Outcome, refuse},
    types::Text,
};
use core::{alloc::Layout, ffi::CStr, mem::MaybeUninit, slice};

/// An error if `pointer` cannot point to `count` elements (> 0).
fn check<T>(pointer: *const T, count: usize, what: &str) -> Outcome {
    if pointer.is_null() {
        return refuse(format!(
            "{what} is a null pointer; pass an array of {count} elements"
        ));
    }
    check_alignment(pointer, what)?;
    if Layout::array::<T>(count).is_err() {
        return refuse(format!(
            "{what} cannot have {count} elements; no memory is that large"
        ));
    }
    Ok(())
}

fn check_alignment<T>(pointer: *const T, what: &str) -> Outcome {
    if pointer.is_aligned() {
        return Ok(());
    }
    refuse(format!(
        "{what} is a misaligned pointer; its address must be a multiple of {}",
        align_of::<T>()
    ))
}

/// The elements behind a pointer. If `count` is 0, the pointer does not matter.
///
/// # Safety
/// If `pointer` passes `check`, it points to `count` initialised elements that live as long as the
/// slice.
pub unsafe fn elements<'a, T>(
    pointer: *const T,
    count: usize,
    what: &str,
) -> Result<&'a [T], Message> {
    if count == 0 {
        return Ok(&[]);
    }
    check(pointer, count, what)?;
    // SAFETY: by the contract above; not null, aligned, and no larger than memory can be.
    Ok(unsafe { slice::from_raw_parts(pointer, count) })
}

/// Room for `count` results behind a pointer, which the importer need not have initialised.
///
/// # Safety
/// If `pointer` passes `check`, it points to memory for `count` elements that lives as long as the
/// slice and that nothing else refers to.
pub unsafe fn room<'a, T>(
    pointer: *mut T,
    count: usize,
    what: &str,
) -> Result<&'a mut [MaybeUninit<T>], Message> {
    if count == 0 {
        return Ok(&mut []);
    }
    check(pointer, count, what)?;
    // SAFETY: by the contract above; not null, aligned, and no larger than memory can be.
    Ok(unsafe { slice::from_raw_parts_mut(pointer.cast(), count) })
}

/// As `room`, for one result.
///
/// # Safety
/// As `room`.
pub unsafe fn room_for_one<'a, T>(
    pointer: *mut T,
    what: &str,
) -> Result<&'a mut MaybeUninit<T>, Message> {
    if pointer.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer; pass the address of a variable for the result"
        )));
    }
    check_alignment(pointer, what)?;
    // SAFETY: by the contract above; not null and aligned.
    Ok(unsafe { &mut *pointer.cast() })
}

/// Fills room with results, one after the other.
pub fn fill<T>(room: &mut [MaybeUninit<T>], results: impl IntoIterator<Item = T>) {
    for (slot, result) in room.iter_mut().zip(results) {
        slot.write(result);
    }
}

/// The text behind a C string.
///
/// # Safety
/// `text` is null or a C string that lives as long as the result.
pub unsafe fn text<'a>(text: Text, what: &str) -> Result<&'a str, Message> {
    if text.is_null() {
        return Err(Message::Error(format!(
            "{what} is a null pointer; pass a string"
        )));
    }
    // SAFETY: by the contract above.
    let bytes = unsafe { CStr::from_ptr(text) };
    bytes
        .to_str()
        .map_err(|_| Message::Error(format!("{what} is not valid UTF-8; pass UTF-8")))
}
