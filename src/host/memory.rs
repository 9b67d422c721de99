//! Memory when there is no more: a reserve, so that the library answers with an error instead of
//! ending the importer's process, as Rust does where an allocation fails.
//!
//! Where the system refuses memory, the allocation comes from the reserve. What a function has made
//! from it does not stay: the function notices by `Watch`, takes back what it did, and fails with a
//! sentence. What is only used within a call, such as a message, is served without a word.
//!
//! The reserve holds what one call needs for a usual rotor. Sizes that come from files and from the
//! importer's arguments are bounded, or asked for in a way that can fail (`Vec::try_reserve`); the
//! reserve refuses pieces beyond `LARGEST`. Its pages take no memory until they are
//! first used.

use core::{
    alloc::{GlobalAlloc, Layout},
    cell::UnsafeCell,
    ptr,
    sync::atomic::{AtomicU64, Ordering},
};
use std::alloc::System;

/// Bytes in the reserve.
const SIZE: usize = 8 << 20;
/// Bytes of the largest piece that it gives.
const LARGEST: usize = 1 << 20;
/// Alignment of the reserve, and the largest that it can give.
const ALIGNMENT: usize = 64;

/// What a caller learns where memory was short.
pub const NO_MEMORY: &str =
    "there is not enough memory; nothing has changed, free some and repeat the call";

/// The allocator of the library.
struct Allocator;

#[global_allocator]
static ALLOCATOR: Allocator = Allocator;

#[repr(C, align(64))]
struct Reserve {
    bytes: UnsafeCell<[u8; SIZE]>,
    /// Bytes given away in the lower 32 bits, and the number of living pieces in the upper 32 bits.
    /// Once no piece lives, all bytes are free again.
    given: AtomicU64,
    /// Number of times that the system has refused memory.
    refusals: AtomicU64,
}

// SAFETY: the bytes are given away in pieces that do not overlap.
unsafe impl Sync for Reserve {}

static RESERVE: Reserve = Reserve {
    bytes: UnsafeCell::new([0; SIZE]),
    given: AtomicU64::new(0),
    refusals: AtomicU64::new(0),
};

const ONE_PIECE: u64 = 1 << 32;

impl Reserve {
    fn begin(&self) -> *mut u8 {
        self.bytes.get().cast()
    }

    fn contains(&self, pointer: *mut u8) -> bool {
        let (begin, address) = (self.begin().addr(), pointer.addr());
        (begin..begin + SIZE).contains(&address)
    }

    /// A piece of memory; null if there is no such piece.
    fn give(&self, layout: Layout) -> *mut u8 {
        self.refusals.fetch_add(1, Ordering::Relaxed);
        if layout.size() > LARGEST || layout.align() > ALIGNMENT {
            return ptr::null_mut();
        }
        let mut place = 0;
        let update = self
            .given
            .fetch_update(Ordering::AcqRel, Ordering::Acquire, |given| {
                let used = (given % ONE_PIECE) as usize;
                place = used.next_multiple_of(layout.align());
                let end = place + layout.size();
                (end <= SIZE).then(|| given / ONE_PIECE * ONE_PIECE + ONE_PIECE + end as u64)
            });
        match update {
            // SAFETY: the piece lies within the reserve.
            Ok(_) => unsafe { self.begin().add(place) },
            Err(_) => ptr::null_mut(),
        }
    }

    fn take_back(&self) {
        let update = |given: u64| {
            let left = given - ONE_PIECE;
            Some(if left < ONE_PIECE { 0 } else { left })
        };
        // It always succeeds.
        let _ = self
            .given
            .fetch_update(Ordering::AcqRel, Ordering::Acquire, update);
    }

    fn is_used(&self) -> bool {
        self.given.load(Ordering::Acquire) >= ONE_PIECE
    }
}

// SAFETY: pieces come from the system or from the reserve, which its address tells, and go back to
// where they came from.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: passed on from the caller.
        let pointer = unsafe { System.alloc(layout) };
        if pointer.is_null() {
            return RESERVE.give(layout);
        }
        pointer
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: passed on from the caller.
        let pointer = unsafe { System.alloc_zeroed(layout) };
        if !pointer.is_null() {
            return pointer;
        }
        let pointer = RESERVE.give(layout);
        if !pointer.is_null() {
            // SAFETY: the piece has this size.
            unsafe { pointer.write_bytes(0, layout.size()) };
        }
        pointer
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        if RESERVE.contains(pointer) {
            RESERVE.take_back();
            return;
        }
        // SAFETY: passed on from the caller; it came from the system.
        unsafe { System.dealloc(pointer, layout) };
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        if !RESERVE.contains(pointer) {
            // SAFETY: passed on from the caller; it came from the system.
            let moved = unsafe { System.realloc(pointer, layout, size) };
            if !moved.is_null() {
                return moved;
            }
        }
        // SAFETY: by the caller's contract the size does not overflow with this alignment.
        let new_layout = unsafe { Layout::from_size_align_unchecked(size, layout.align()) };
        // SAFETY: the size is not 0, by the caller's contract.
        let moved = unsafe { self.alloc(new_layout) };
        if !moved.is_null() {
            // SAFETY: both pieces have at least this size, and are not the same.
            unsafe { ptr::copy_nonoverlapping(pointer, moved, layout.size().min(size)) };
            // SAFETY: passed on from the caller; the contents have moved.
            unsafe { self.dealloc(pointer, layout) };
        }
        moved
    }
}

/// Watches whether memory becomes short.
#[derive(Debug, Clone, Copy)]
pub struct Watch {
    refusals: u64,
}

impl Watch {
    pub fn begin() -> Self {
        Self {
            refusals: RESERVE.refusals.load(Ordering::Acquire),
        }
    }

    /// Whether the system has refused memory since `begin`, and something lives in the reserve. It
    /// may be another thread's; the answer is then too cautious.
    pub fn is_short(&self) -> bool {
        self.refusals != RESERVE.refusals.load(Ordering::Acquire) && RESERVE.is_used()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reserve_gives_pieces_that_do_not_overlap_until_it_is_empty_and_takes_all_back() {
        let reserve = Box::new(Reserve {
            bytes: UnsafeCell::new([0; SIZE]),
            given: AtomicU64::new(0),
            refusals: AtomicU64::new(0),
        });
        for _ in 0..2 {
            assert!(!reserve.is_used());
            let mut end = reserve.begin().addr();
            let mut count = 0;
            loop {
                let layout = Layout::from_size_align(1000 + count, 8 << (count % 4)).unwrap();
                let piece = reserve.give(layout);
                if piece.is_null() {
                    break;
                }
                assert!(piece.addr() >= end && piece.addr().is_multiple_of(layout.align()));
                assert!(reserve.contains(piece));
                end = piece.addr() + layout.size();
                count += 1;
            }
            assert!(end <= reserve.begin().addr() + SIZE && count > 3000);
            assert!(!reserve.contains((&raw const count).cast_mut().cast()));
            for _ in 0..count {
                assert!(reserve.is_used());
                reserve.take_back();
            }
        }
        let too_large = Layout::from_size_align(LARGEST + 1, 8).unwrap();
        assert!(reserve.give(too_large).is_null());
    }
}
