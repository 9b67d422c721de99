//! The opaque pointers that an importer holds: to instances and to states.
//!
//! A mark in front of the value tells our pointers from foreign ones, and from those of freed
//! values until the memory is used again. The mark is read before a reference is made.

use core::{ffi::c_void, ptr::NonNull};

/// What a handle can hold.
pub trait Marked {
    /// A number that other memory is unlikely to begin with.
    const MARK: u64;
}

#[repr(C)]
struct Handle<T> {
    mark: u64,
    value: T,
}

/// Puts a value behind a pointer for the importer.
pub fn create<T: Marked>(value: T) -> *mut c_void {
    let mark = T::MARK;
    Box::into_raw(Box::new(Handle { mark, value })).cast()
}

/// The handle behind a pointer. `None` if it is null, misaligned or without the mark.
///
/// # Safety
/// As `living`.
unsafe fn recognise<T: Marked>(pointer: *mut c_void) -> Option<NonNull<Handle<T>>> {
    let handle = NonNull::new(pointer.cast::<Handle<T>>())?;
    if !handle.is_aligned() {
        return None;
    }
    // SAFETY: aligned, and by the contract at least 8 bytes may be read.
    let mark = unsafe { (&raw const (*handle.as_ptr()).mark).read() };
    (mark == T::MARK).then_some(handle)
}

/// The value behind a pointer. `None` if it is null, misaligned or without the mark.
///
/// # Safety
/// `pointer` is null, or 8 bytes may be read there.
pub unsafe fn living<T: Marked>(pointer: *mut c_void) -> Option<NonNull<T>> {
    // SAFETY: passed on from the caller.
    let handle = unsafe { recognise::<T>(pointer)? };
    // SAFETY: the mark says that the handle is ours; the field lies in it.
    NonNull::new(unsafe { &raw mut (*handle.as_ptr()).value })
}

/// Frees the value behind a pointer that `living` recognises; does nothing for any other.
///
/// # Safety
/// As `living`, and nothing refers to the value.
pub unsafe fn free<T: Marked>(pointer: *mut c_void) {
    // SAFETY: passed on from the caller.
    let Some(handle) = (unsafe { recognise::<T>(pointer) }) else {
        return;
    };
    // SAFETY: the mark says that `create` made the handle with Box::into_raw. The mark is written
    // in a way that the compiler keeps, so that a copy of the pointer is recognised as freed.
    unsafe {
        (&raw mut (*handle.as_ptr()).mark).write_volatile(0);
        drop(Box::from_raw(handle.as_ptr()));
    }
}
