//! The complete state of an instance: fmi2Functions.h, "Getting and setting the internal FMU
//! state".
//!
//! A state is a copy of what the block knows, of the mode and of the time. Serialized it is, all
//! numbers little-endian:
//!
//! ```text
//! magic        8 bytes  "HelRotor"
//! version      4 bytes  of this format
//! GUID        38 bytes  of modelDescription.xml
//! length       8 bytes  of the content
//! content               interface, state of the call sequence, time, stop time; then the block's
//! checksum     4 bytes  CRC-32 of everything before it
//! ```

#![allow(non_snake_case)]

use super::{
    arguments::{self, elements, fill, place, room},
    handle::{self, Marked},
    instance::{Experiment, Instance, Message, Outcome, call, refuse},
    legality::Function,
    legality::{
        CONTINUOUS_TIME_MODE, EVENT_MODE, INITIALIZATION_MODE, INSTANTIATED, Interface,
        STEP_COMPLETE, States, TERMINATED,
    },
    types::*,
};
use crate::block::{DecodeError, Reader, Snapshot, Stage, variables::GUID};
use std::ptr;
use thiserror::Error;

const MAGIC: [u8; 8] = *b"HelRotor";
const VERSION: u32 = 1;
const HEAD: usize = MAGIC.len() + 4 + GUID.len() + 8;
const CHECKSUM: usize = 4;

/// The state of an instance; an fmi2FMUstate is a handle of one.
#[derive(Debug, Clone, PartialEq)]
struct FmuState {
    interface: Interface,
    state: States,
    experiment: Experiment,
    block: Snapshot,
}

/// Why bytes are no state of this FMU.
#[derive(Debug, Error, PartialEq)]
enum NoState {
    #[error("the bytes are no serialized state of this FMU: they do not begin as one")]
    Foreign,
    #[error(
        "the state was serialized in format {0}, this FMU reads {VERSION}; take the FMU that wrote it"
    )]
    Version(u32),
    #[error("the state was serialized by an FMU with the GUID {0}, not {GUID}; take that FMU")]
    Guid(String),
    #[error("the state is cut short or too long: {given} bytes where it has {length}")]
    Length { given: usize, length: u64 },
    #[error("the state was damaged: its checksum is wrong")]
    Checksum,
    #[error("the state cannot be used: {0}")]
    Content(#[from] DecodeError),
    #[error("the state cannot be used: it is not written as this FMU writes it")]
    Written,
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

    fn to_bytes(&self) -> Vec<u8> {
        let mut content = vec![match self.interface {
            Interface::CoSimulation => 1,
            Interface::ModelExchange => 0,
        }];
        content.extend_from_slice(&self.state.to_le_bytes());
        let Experiment { time, stop_time } = self.experiment;
        let has_stop = f64::from(u8::from(stop_time.is_some()));
        for number in [time, has_stop, stop_time.unwrap_or(0.0)] {
            content.extend_from_slice(&number.to_le_bytes());
        }
        self.block.write(&mut content);

        let mut bytes = MAGIC.to_vec();
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(GUID.as_bytes());
        bytes.extend_from_slice(&(content.len() as u64).to_le_bytes());
        bytes.append(&mut content);
        bytes.extend_from_slice(&crc32fast::hash(&bytes).to_le_bytes());
        bytes
    }

    fn from_bytes(bytes: &[u8]) -> Result<Self, NoState> {
        let mut reader = Reader::new(bytes);
        let foreign = |_: DecodeError| NoState::Foreign;
        if reader.array::<8>().map_err(foreign)? != MAGIC {
            return Err(NoState::Foreign);
        }
        let version = u32::from_le_bytes(reader.array().map_err(foreign)?);
        if version != VERSION {
            return Err(NoState::Version(version));
        }
        let guid = reader.slice(GUID.len()).map_err(foreign)?;
        if guid != GUID.as_bytes() {
            let shown = String::from_utf8_lossy(guid);
            let shown = shown.chars().filter(char::is_ascii_graphic).collect();
            return Err(NoState::Guid(shown));
        }
        let length = u64::from_le_bytes(reader.array().map_err(foreign)?);
        let around = (HEAD + CHECKSUM) as u64;
        let given = bytes.len();
        if given as u64 != length.saturating_add(around) {
            let length = length.saturating_add(around);
            return Err(NoState::Length { given, length });
        }
        let (body, checksum) = bytes.split_at(given - CHECKSUM);
        if crc32fast::hash(body).to_le_bytes() != *checksum {
            return Err(NoState::Checksum);
        }
        let mut reader = Reader::new(&body[HEAD..]);
        let state = Self::read(&mut reader)?;
        reader.end()?;
        // There are several ways to write some values, of which this FMU has one.
        if state.to_bytes() != bytes {
            return Err(NoState::Written);
        }
        Ok(state)
    }

    fn read(reader: &mut Reader) -> Result<Self, DecodeError> {
        let wrong = |what: &str| DecodeError::Value(what.to_owned());
        let interface = Interface::from_type(reader.byte()?.into());
        let interface = interface.ok_or_else(|| wrong("the interface"))?;
        let state = States::from_le_bytes(reader.array()?);
        let [time, has_stop, stop] = reader.reals()?;
        if !time.is_finite() || stop.is_nan() || ![0.0, 1.0].contains(&has_stop) {
            return Err(wrong("the time"));
        }
        let block = Snapshot::read(reader)?;
        // The stages of the block in the states of the call sequence.
        let is_consistent = match (interface, state) {
            (_, INSTANTIATED | INITIALIZATION_MODE) => block.stage() == Stage::Configuring,
            (Interface::CoSimulation, STEP_COMPLETE | TERMINATED)
            | (Interface::ModelExchange, EVENT_MODE) => block.stage() == Stage::Running,
            (Interface::ModelExchange, CONTINUOUS_TIME_MODE) => block.stage() == Stage::Integrating,
            (Interface::ModelExchange, TERMINATED) => block.stage() != Stage::Configuring,
            _ => false,
        };
        if !is_consistent {
            return Err(wrong("the state of the call sequence"));
        }
        Ok(Self {
            interface,
            state,
            experiment: Experiment {
                time,
                stop_time: (has_stop == 1.0).then_some(stop),
            },
            block,
        })
    }

    /// Makes an instance go on from here; if that is refused, it has not changed.
    fn apply(&self, instance: &mut Instance) -> Outcome {
        if self.interface != instance.interface {
            return refuse(
                "the state is one of the other interface (Co-Simulation or Model Exchange); set it on an instance of its own"
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
        Message::Error(
            "FMUstate points to no state of this FMU; pass one that was not freed".into(),
        )
    })?;
    // SAFETY: a living state, and by the contract above nothing else refers to it.
    Ok(unsafe { state.as_mut() })
}

/// The importer's variable for a state: null, or the state that it has there.
///
/// # Safety
/// `place` is null or points to a pointer.
unsafe fn variable<'a>(place: *mut fmi2FMUstate) -> Result<&'a mut fmi2FMUstate, Message> {
    // SAFETY: passed on from the caller; by the contract above it is initialised.
    Ok(unsafe { arguments::place(place, "FMUstate")?.assume_init_mut() })
}

/// Puts a state where an importer keeps it: over the one that it has there, else in new memory.
///
/// # Safety
/// As `variable`; `*place` as in `living`.
unsafe fn store(place: *mut fmi2FMUstate, state: FmuState) -> Outcome {
    // SAFETY: passed on from the caller.
    let pointer = unsafe { variable(place)? };
    if pointer.is_null() {
        *pointer = handle::create(state);
    } else {
        // SAFETY: passed on from the caller.
        *unsafe { living(*pointer)? } = state;
    }
    Ok(())
}

// ------------------------------------------------------------------ functions

/// # Safety
/// As in the standard: `*state` is null or comes from this function and was not freed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2GetFMUstate(c: fmi2Component, state: *mut fmi2FMUstate) -> fmi2Status {
    let body = |instance: &mut Instance| {
        // SAFETY: passed on from the caller.
        unsafe { store(state, FmuState::of(instance)) }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2GetFMUstate, body) }
}

/// The state may come from another instance of this FMU.
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

/// Sets `*state` to null, so that freeing it once more does nothing.
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
        // SAFETY: passed on from the caller; `living` refuses what is no state.
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
        let (size, state) = unsafe { (place(size, "size")?, living(state)?) };
        size.write(state.to_bytes().len());
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
        let bytes = unsafe { living(state)? }.to_bytes();
        if size < bytes.len() {
            return refuse(format!(
                "there is room for {size} bytes, but the state has {}; ask fmi2SerializedFMUstateSize",
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
        let read = FmuState::from_bytes(bytes)?;
        // SAFETY: passed on from the caller.
        unsafe { store(state, read) }
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2DeSerializeFMUstate, body) }
}
