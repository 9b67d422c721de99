//! The complete state of an instance, and what the functions for it do in both versions.
//!
//! A state is a copy of everything the block knows, of the mode and of the time.

use super::{
    arguments::{elements, fill, room, room_for_one},
    communication_time::Experiment,
    handle::{self, Marked},
    instance::{Instance, Message, Outcome, call, no_memory, refuse},
    legality::{EVENT_MODE, Function, Interface, STEP_MODE, States, TERMINATED, Version},
    types::{Component, StatePointer, Status},
};
use crate::{block::Snapshot, host::memory::Watch};
use serde::{Deserialize, Serialize};
use std::ptr;

/// The state of an instance; the importer holds a handle of one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FmuState {
    /// Not among the bytes of a state: their head has the token of the version.
    #[serde(skip)]
    pub version: Version,
    pub interface: Interface,
    pub state: States,
    pub experiment: Experiment,
    pub block: Snapshot,
}

impl FmuState {
    fn of(instance: &Instance) -> Self {
        Self {
            version: instance.version,
            interface: instance.interface,
            state: instance.state,
            experiment: instance.experiment,
            block: instance.block.snapshot(),
        }
    }

    /// Makes an instance continue from this state. If that fails, the instance has not changed.
    fn apply(&self, instance: &mut Instance) -> Outcome {
        if self.version != instance.version {
            return refuse(format!(
                "the state belongs to an instance of {}; set it on one of that version",
                self.version.name()
            ));
        }
        if self.interface != instance.interface {
            return refuse(
                "the state belongs to the other interface (Co-Simulation or Model Exchange); set it on an instance of that interface"
                    .into(),
            );
        }
        let has_event_mode = instance.options.has_event_mode;
        if self.interface == Interface::CoSimulation && self.state == EVENT_MODE && !has_event_mode
        {
            return refuse(
                "the state was saved in Event Mode, which the instance does not use; set it on an instance that was made with eventModeUsed = true"
                    .into(),
            );
        }
        instance.block.restore(&self.block)?;
        instance.state = self.state;
        instance.experiment = self.experiment;
        let is_stepping = self.state & (STEP_MODE | TERMINATED) != 0;
        (instance.block).hold_flow_state(has_event_mode && is_stepping);
        Ok(())
    }
}

// ------------------------------------------------------------------ pointers

impl Marked for FmuState {
    const MARK: u64 = 0x7374_6174_6520_4f4b;
}

/// What a version calls its states and the functions for them.
struct Words {
    state: &'static str,
    get: &'static str,
    deserialize: &'static str,
    size: &'static str,
}

impl Version {
    fn words(self) -> &'static Words {
        match self {
            Self::Two => &Words {
                state: "FMUstate",
                get: "fmi2GetFMUstate",
                deserialize: "fmi2DeSerializeFMUstate",
                size: "fmi2SerializedFMUstateSize",
            },
            Self::Three => &Words {
                state: "FMUState",
                get: "fmi3GetFMUState",
                deserialize: "fmi3DeserializeFMUState",
                size: "fmi3SerializedFMUStateSize",
            },
        }
    }
}

/// The state behind a pointer.
///
/// # Safety
/// `pointer` is null, or comes from this file and was not freed.
unsafe fn living<'a>(pointer: StatePointer, words: &Words) -> Result<&'a mut FmuState, Message> {
    let Words {
        state: name,
        get,
        deserialize,
        ..
    } = words;
    if pointer.is_null() {
        return Err(Message::Error(format!(
            "{name} is a null pointer; pass a state from {get} or {deserialize}"
        )));
    }
    // SAFETY: passed on from the caller.
    let state = unsafe { handle::living(pointer) };
    let mut state = state.ok_or_else(|| {
        Message::Error(format!(
            "{name} is not a state of this FMU, or it was freed"
        ))
    })?;
    // SAFETY: a living state, and by the contract above nothing else refers to it.
    Ok(unsafe { state.as_mut() })
}

/// The importer's variable for a state, which holds null or a state.
///
/// # Safety
/// `address` is null or points to a pointer.
unsafe fn variable<'a>(
    address: *mut StatePointer,
    words: &Words,
) -> Result<&'a mut StatePointer, Message> {
    // SAFETY: passed on from the caller; by the contract above it is initialised.
    Ok(unsafe { room_for_one(address, words.state)?.assume_init_mut() })
}

/// Makes a state and stores it where the importer keeps it: over the state that is there, else in
/// new memory.
///
/// # Safety
/// As `variable`; `*address` as in `living`.
unsafe fn store(
    address: *mut StatePointer,
    words: &Words,
    make: impl FnOnce() -> Result<FmuState, Message>,
) -> Outcome {
    let watch = Watch::begin();
    let state = make()?;
    // SAFETY: passed on from the caller.
    let pointer = unsafe { variable(address, words)? };
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
    *unsafe { living(*pointer, words)? } = state;
    Ok(())
}

// ------------------------------------------------------------------ functions

/// Copies the state of an instance.
///
/// # Safety
/// As in the standard: `*state` is null or comes from this function and was not freed.
pub unsafe fn get(
    component: Component,
    function: &'static Function,
    state: *mut StatePointer,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe {
            store(state, function.version.words(), || {
                Ok(FmuState::of(instance))
            })
        }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// Makes an instance continue from a state, which may come from another instance of this FMU. If
/// a file of its rotor has changed since then, a warning is logged, and the call succeeds.
///
/// # Safety
/// As in the standard: `state` comes from `get` or `deserialize` and was not freed.
pub unsafe fn set(
    component: Component,
    function: &'static Function,
    state: StatePointer,
) -> Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { living(state, function.version.words())? }.apply(instance)
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// Frees a state and sets `*state` to null, so that freeing it again does nothing.
///
/// # Safety
/// As in the standard: `state` is null, or `*state` as in `set`.
pub unsafe fn free(
    component: Component,
    function: &'static Function,
    state: *mut StatePointer,
) -> Status {
    let words = function.version.words();
    let body = |_: &mut Instance| {
        if state.is_null() {
            return Ok(());
        }
        // SAFETY: passed on from the caller.
        let pointer = unsafe { variable(state, words)? };
        if pointer.is_null() {
            return Ok(());
        }
        // SAFETY: passed on from the caller; `living` refuses anything else.
        unsafe {
            living(*pointer, words)?;
            handle::free::<FmuState>(*pointer);
        }
        *pointer = ptr::null_mut();
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// Returns the number of bytes that a state takes.
///
/// # Safety
/// As in the standard: `state` as in `set`, `size` may be written.
pub unsafe fn serialized_size(
    component: Component,
    function: &'static Function,
    state: StatePointer,
    size: *mut usize,
) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        let (size, state) = unsafe {
            let words = function.version.words();
            (room_for_one(size, "size")?, living(state, words)?)
        };
        size.write(state.to_bytes()?.len());
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// Writes a state as bytes.
///
/// # Safety
/// As in the standard: `state` as in `set`, `serialized` has `size` bytes.
pub unsafe fn serialize(
    component: Component,
    function: &'static Function,
    state: StatePointer,
    serialized: *mut u8,
    size: usize,
) -> Status {
    let words = function.version.words();
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        let bytes = unsafe { living(state, words)? }.to_bytes()?;
        if size < bytes.len() {
            return refuse(format!(
                "serializedState has room for {size} bytes, but the state takes {}; ask {}",
                bytes.len(),
                words.size
            ));
        }
        // SAFETY: passed on from the caller.
        let out = unsafe { room(serialized, bytes.len(), "serializedState")? };
        fill(out, bytes);
        Ok(())
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}

/// Makes a state from bytes.
///
/// # Safety
/// As in the standard: `serialized` has `size` bytes, `*state` as in `get`.
pub unsafe fn deserialize(
    component: Component,
    function: &'static Function,
    serialized: *const u8,
    size: usize,
    state: *mut StatePointer,
) -> Status {
    let body = |_: &mut Instance| {
        // SAFETY: passed on from the caller.
        let bytes = unsafe { elements(serialized, size, "serializedState")? };
        let version = function.version;
        // SAFETY: passed on from the caller.
        unsafe {
            store(state, version.words(), || {
                Ok(FmuState::from_bytes(bytes, version)?)
            })
        }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(component, function, body) }
}
