//! The complete state of an instance: fmi2Functions.h, "Getting and setting the internal FMU
//! state".
//!
//! A state is a copy of everything the block knows, of the mode and of the time.

#![allow(non_snake_case)]

use super::{
    arguments::{elements, fill, room, room_for_one},
    communication_time::Experiment,
    handle::{self, Marked},
    instance::{Instance, Message, Outcome, call, no_memory, refuse},
    legality::{Function, Interface, States},
    types::*,
};
use crate::{block::Snapshot, host::memory::Watch};
use serde::{Deserialize, Serialize};
use std::ptr;

/// The state of an instance; an fmi2FMUstate is a handle of one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FmuState {
    pub interface: Interface,
    pub state: States,
    pub experiment: Experiment,
    pub block: Snapshot,
}

impl FmuState {
    fn of(instance: &Instance) -> Self {
        Self {
            interface: instance.interface,
            state: instance.state,
            experiment: instance.experiment,
            block: instance.block.snapshot(),
        }
    }

    /// Makes an instance continue from this state. If that fails, the instance has not changed.
    fn apply(&self, instance: &mut Instance) -> Outcome {
        if self.interface != instance.interface {
            return refuse(
                "the state belongs to the other interface (Co-Simulation or Model Exchange); set it on an instance of that interface"
                    .into(),
            );
        }
        instance.block.restore(&self.block)?;
        instance.state = self.state;
        instance.experiment = self.experiment;
        Ok(())
    }
}

// ------------------------------------------------------------------ pointers

impl Marked for FmuState {
    const MARK: u64 = 0x7374_6174_6520_4f4b;
}

/// The state behind a pointer.
///
/// # Safety
/// `pointer` is null, or comes from this file and was not freed.
unsafe fn living<'a>(pointer: fmi2FMUstate) -> Result<&'a mut FmuState, Message> {
    if pointer.is_null() {
        return Err(Message::Error(
            "FMUstate is a null pointer; pass a state from fmi2GetFMUstate or fmi2DeSerializeFMUstate"
                .into(),
        ));
    }
    // SAFETY: passed on from the caller.
    let state = unsafe { handle::living(pointer) };
    let mut state = state.ok_or_else(|| {
        Message::Error("FMUstate is not a state of this FMU, or it was freed".into())
    })?;
    // SAFETY: a living state, and by the contract above nothing else refers to it.
    Ok(unsafe { state.as_mut() })
}

/// The importer's variable for a state, which holds null or a state.
///
/// # Safety
/// `address` is null or points to a pointer.
unsafe fn variable<'a>(address: *mut fmi2FMUstate) -> Result<&'a mut fmi2FMUstate, Message> {
    // SAFETY: passed on from the caller; by the contract above it is initialised.
    Ok(unsafe { room_for_one(address, "FMUstate")?.assume_init_mut() })
}

/// Makes a state and stores it where the importer keeps it: over the state that is there, else in
/// new memory.
///
/// # Safety
/// As `variable`; `*address` as in `living`.
unsafe fn store(
    address: *mut fmi2FMUstate,
    make: impl FnOnce() -> Result<FmuState, Message>,
) -> Outcome {
    let watch = Watch::begin();
    let state = make()?;
    // SAFETY: passed on from the caller.
    let pointer = unsafe { variable(address)? };
    if pointer.is_null() {
        let handle = handle::create(state);
        if watch.is_short() {
            // SAFETY: it was made here, and nobody else knows it.
            unsafe { handle::free::<FmuState>(handle) };
            return Err(no_memory(()));
        }
        *pointer = handle;
        return Ok(());
    }
    if watch.is_short() {
        return Err(no_memory(()));
    }
    // SAFETY: passed on from the caller.
    *unsafe { living(*pointer)? } = state;
    Ok(())
}

// ------------------------------------------------------------------ functions

/// # Safety
/// As in the standard: `*state` is null or comes from this function and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { store(state, || Ok(FmuState::of(instance))) }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetFMUstate, body) }
}

/// The state may come from another instance of this FMU. If a file of its rotor has changed since
/// then, a warning is logged, and the call succeeds.
///
/// # Safety
/// As in the standard: `state` comes from fmi2GetFMUstate or fmi2DeSerializeFMUstate and was not
/// freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetFMUstate(c: fmi2Component, state: fmi2FMUstate) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { living(state)? }.apply(instance)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetFMUstate, body) }
}

/// Sets `*state` to null, so that freeing it again does nothing.
///
/// # Safety
/// As in the standard: `state` is null, or `*state` as in fmi2SetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2FreeFMUstate(
    c: fmi2Component,
    state: *mut fmi2FMUstate,
) -> fmi2Status {
    let body = |_: &mut Instance| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: passed on from the caller.
        let pointer = unsafe { variable(state)? };
        if pointer.is_null() {
            return Ok(());
        }
        // SAFETY: passed on from the caller; `living` refuses anything else.
        unsafe {
            living(*pointer)?;
            handle::free::<FmuState>(*pointer);
        }
        *pointer = ptr::null_mut();
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2FreeFMUstate, body) }
}

/// # Safety
/// As in the standard: `state` as in fmi2SetFMUstate, `size` may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializedFMUstateSize(
    c: fmi2Component,
    state: fmi2FMUstate,
    size: *mut usize,
) -> fmi2Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (size, state) = unsafe { (room_for_one(size, "size")?, living(state)?) };
        size.write(state.to_bytes()?.len());
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SerializedFMUstateSize, body) }
}

/// # Safety
/// As in the standard: `state` as in fmi2SetFMUstate, `serializedState` has `size` elements.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SerializeFMUstate(
    c: fmi2Component,
    state: fmi2FMUstate,
    serializedState: *mut fmi2Byte,
    size: usize,
) -> fmi2Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        let bytes = unsafe { living(state)? }.to_bytes()?;
        if size < bytes.len() {
            return refuse(format!(
                "serializedState has room for {size} bytes, but the state takes {}; ask fmi2SerializedFMUstateSize",
                bytes.len()
            ));
        }
        // SAFETY: passed on from the caller; a byte is a byte.
        let out = unsafe { room(serializedState.cast::<u8>(), bytes.len(), "serializedState")? };
        fill(out, bytes);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SerializeFMUstate, body) }
}

/// # Safety
/// As in the standard: `serializedState` has `size` elements, `*state` as in fmi2GetFMUstate.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2DeSerializeFMUstate(
    c: fmi2Component,
    serializedState: *const fmi2Byte,
    size: usize,
    state: *mut fmi2FMUstate,
) -> fmi2Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller; a byte is a byte.
        let bytes = unsafe { elements(serializedState.cast::<u8>(), size, "serializedState")? };
        // SAFETY: passed on from the caller.
        unsafe { store(state, || Ok(FmuState::from_bytes(bytes)?)) }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2DeSerializeFMUstate, body) }
}
