//! Serialized states: any bytes are refused, or are a state with which an instance goes on to
//! finite numbers or an error.
//!
//! The bytes are the content; head and checksum, which random bytes never have, are added. With 255
//! as the first byte the others are a whole serialized state; with 254 they say which bytes of
//! a real state are changed, and how.

#![no_main]

use crc::{CRC_32_ISO_HDLC, Crc};
use fuzz::{Instance, fail, finite, promise};
use helicopter_rotor::{
    block::variables::{STATES, boolean, integer, real},
    fmi2::{
        co_simulation::{fmi2DoStep, fmi2SetRealInputDerivatives},
        fmu_state::*,
        get_set::fmi2SetBoolean,
        life_cycle::{fmi2EnterInitializationMode, fmi2ExitInitializationMode},
        model_exchange::{fmi2GetContinuousStates, fmi2GetDerivatives},
        types::*,
    },
};
use libfuzzer_sys::fuzz_target;
use std::{ptr, sync::OnceLock};

/// Bytes of the head before the length: magic, version and GUID.
const BEFORE_LENGTH: usize = 8 + 4 + 38;

/// The checksum behind the content.
static CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);

const OK: fmi2Status = fmi2Status::Ok;

/// A whole state with this content.
fn whole(content: &[u8]) -> Vec<u8> {
    static HEAD: OnceLock<Vec<u8>> = OnceLock::new();
    let head = HEAD
        .get_or_init(|| Instance::new(FMI2_CO_SIMULATION).serialized()[..BEFORE_LENGTH].to_vec());
    let mut bytes = head.clone();
    bytes.extend((content.len() as u64).to_le_bytes());
    bytes.extend(content);
    bytes.extend(CRC.checksum(&bytes).to_le_bytes());
    bytes
}

/// The contents of states of both interfaces and of a rotor with all kinds of states, in flight.
fn real_contents() -> &'static [Vec<u8>] {
    static CONTENTS: OnceLock<Vec<Vec<u8>>> = OnceLock::new();
    CONTENTS.get_or_init(|| {
        let content = |(kind, is_complex): (fmi2Enumeration, bool)| {
            let instance = Instance::new(kind);
            instance.simplify();
            if is_complex {
                instance.set_integer(integer::MODELS__INFLOW, 13);
                instance.set_integer(integer::DRIVE__MODE, 2);
                let flaps = boolean::FLAPPING__ENABLED.number();
                // SAFETY: the pointers live during the call.
                unsafe { fmi2SetBoolean(instance.0, &flaps, 1, &1) };
            }
            // SAFETY: the instance lives; in Model Exchange the step is refused.
            unsafe {
                fmi2EnterInitializationMode(instance.0);
                fmi2ExitInitializationMode(instance.0);
                fmi2DoStep(instance.0, 0.0, 1e-3, 1);
                fmi2SetRealInputDerivatives(instance.0, &real::RPM.number(), 1, &1, &1.0);
            }
            let bytes = instance.serialized();
            bytes[BEFORE_LENGTH + 8..bytes.len() - 4].to_vec()
        };
        let interfaces = [FMI2_CO_SIMULATION, FMI2_MODEL_EXCHANGE];
        let all = interfaces.map(|kind| [(kind, false), (kind, true)]);
        all.into_iter().flatten().map(content).collect()
    })
}

/// The content of a real state, with changes: place (two bytes) and what is flipped there.
fn changed(which: u8, changes: &[u8]) -> Vec<u8> {
    let contents = real_contents();
    let mut content = contents[usize::from(which) % contents.len()].clone();
    for change in changes.chunks_exact(3) {
        let place = usize::from(u16::from_le_bytes([change[0], change[1]]));
        let length = content.len();
        content[place % length] ^= change[2];
    }
    content
}

/// Goes on from a state that was set. Only numbers that are read with fmi2OK count.
fn go_on(instance: &Instance) {
    if !instance.is_quick() {
        return;
    }
    let time = instance.time();
    for step in 0..2 {
        // SAFETY: the instance lives. In Model Exchange this is refused.
        unsafe { fmi2DoStep(instance.0, time + 1e-4 * f64::from(step), 1e-4, 1) };
        instance.reals();
    }
    let (mut x, mut rates) = ([0.0; STATES.len()], [0.0; STATES.len()]);
    // SAFETY: the pointers are valid for the count.
    unsafe {
        if fmi2GetContinuousStates(instance.0, x.as_mut_ptr(), x.len()) == OK {
            finite(&x);
        }
        if fmi2GetDerivatives(instance.0, rates.as_mut_ptr(), rates.len()) == OK {
            finite(&rates);
        }
    }
}

/// Reads a state; none if it is refused.
fn read(instance: &Instance, bytes: &[u8]) -> Option<fmi2FMUstate> {
    let mut state = ptr::null_mut();
    // SAFETY: the pointers live during the call.
    let status = unsafe {
        fmi2DeSerializeFMUstate(instance.0, bytes.as_ptr().cast(), bytes.len(), &mut state)
    };
    promise((status == OK) != state.is_null(), || {
        "a state with an error".into()
    });
    (status == OK).then_some(state)
}

fuzz_target!(|data: &[u8]| {
    let bytes = match data {
        [255, whole @ ..] => whole.to_vec(),
        [254, which, changes @ ..] => whole(&changed(*which, changes)),
        content => whole(content),
    };
    for kind in [FMI2_CO_SIMULATION, FMI2_MODEL_EXCHANGE] {
        let instance = Instance::new(kind);
        let Some(mut state) = read(&instance, &bytes) else {
            return;
        };
        // SAFETY: the instance and the states live.
        unsafe {
            if fmi2SetFMUstate(instance.0, state) == OK {
                // It differs in the hashes of files that have changed.
                match read(&instance, &instance.serialized()) {
                    Some(mut again) => fmi2FreeFMUstate(instance.0, &mut again),
                    None => fail("its own state is refused"),
                };
                go_on(&instance);
            }
            fmi2FreeFMUstate(instance.0, &mut state);
        }
    }
});
