//! Serialized states: read in another process, and refused when they are not what they should be.

use super::fmu_state::{Rotor, fresh, seen};
use crate::support::{
    Fmu, Instance, c,
    child::{run_alone, watched},
    instance::bits,
};
use helicopter_rotor::block::variables::{GUID, REALS, STATES};
use proptest::prelude::*;
use std::{env, fs, path::PathBuf, ptr};

const ROTOR: Rotor = Rotor {
    inflow: "petersHe",
    flapping: true,
    is_driven: true,
    tip_loss: 2,
};

/// A flight between two points of the inner grid, with an input that waits to move.
fn in_flight() -> Instance<'static> {
    let instance = fresh(c::CO_SIMULATION, ROTOR);
    instance.initialize();
    assert_eq!(instance.step(0.0, 0.0173), c::OK);
    assert_eq!(instance.set_slope("collective", 0.4), c::OK);
    instance
}

/// The bits of all that can be read on the way on, as a text.
fn went_on(instance: &Instance) -> String {
    let mut text = String::new();
    for (time, size) in [(0.0173, 0.011), (0.0283, 0.02)] {
        assert_eq!(
            instance.step(time, size),
            c::OK,
            "{:?}",
            instance.take_log()
        );
        text += &format!("{:x?}\n", bits(&instance.reals()));
    }
    text
}

fn file() -> PathBuf {
    // The child has another scratch folder.
    Fmu::shared().folder.join("a-serialized-state")
}

#[test]
fn another_process_goes_on_from_the_bytes_to_the_bit() {
    let name = "serialized::another_process_goes_on_from_the_bytes_to_the_bit";
    if env::var_os("HELICOPTER_ROTOR_CHILD").is_some() {
        let instance = Instance::new();
        let bytes = fs::read(file()).unwrap();
        let state = instance.deserialize(&bytes).unwrap();
        assert_eq!(
            instance.set_state(&state),
            c::OK,
            "{:?}",
            instance.take_log()
        );
        let text = went_on(&instance);
        watched(|| println!("{text}"));
        return;
    }
    let instance = in_flight();
    fs::write(file(), instance.state().serialize()).unwrap();
    let expected = went_on(&instance);
    let printed = run_alone(name).expect("this is the parent");
    fs::remove_file(file()).unwrap();
    assert_eq!(printed.watched()[0].trim(), expected.trim());
}

/// Bytes, the state made of them and its bytes are one and the same, at every moment.
#[test]
fn bytes_hold_the_whole_state_in_every_state_of_the_call_sequence() {
    let check = |instance: &Instance, fresh: &Instance| {
        let bytes = instance.state().serialize();
        let state = fresh.deserialize(&bytes).unwrap();
        assert_eq!(state.serialize(), bytes);
        assert_eq!(fresh.set_state(&state), c::OK, "{:?}", fresh.take_log());
        assert_eq!(fresh.state().serialize(), bytes);
    };
    let other = Instance::new();
    let instance = fresh(c::CO_SIMULATION, ROTOR);
    check(&instance, &other);
    assert_eq!(instance.set_up(1.0, Some(2.0)), c::OK);
    assert_eq!(instance.enter_initialization(), c::OK);
    check(&instance, &other);
    assert_eq!(instance.real("azimuth"), 0.0);
    check(&instance, &other);
    assert_eq!(instance.exit_initialization(), c::OK);
    check(&instance, &other);
    assert_eq!(instance.step(1.0, 0.0123), c::OK);
    check(&instance, &other);
    assert_eq!(instance.set_real("collective", 0.1), c::OK);
    check(&instance, &other);
    assert_eq!(instance.terminate(), c::OK);
    check(&instance, &other);
    assert_eq!(seen(&instance), seen(&other));

    let other = Instance::for_model_exchange();
    let instance = fresh(c::MODEL_EXCHANGE, ROTOR);
    check(&instance, &other);
    instance.initialize();
    check(&instance, &other);
    assert_eq!(instance.enter_continuous_time(), c::OK);
    check(&instance, &other);
    let mut x = instance.states();
    x[2] += 1.0;
    assert_eq!(instance.set_states(&x), c::OK);
    check(&instance, &other);
    assert_eq!(instance.derivatives().len(), STATES.len());
    check(&instance, &other);
    assert_eq!(instance.terminate(), c::OK);
    check(&instance, &other);
    assert_eq!(seen(&instance), seen(&other));
}

/// The sentence with which bytes are refused.
#[track_caller]
fn refusal(instance: &Instance, bytes: &[u8]) -> String {
    match instance.deserialize(bytes) {
        Err(status) => instance.refused(status),
        Ok(_) => panic!("{} bytes were taken for a state", bytes.len()),
    }
}

const GUID_AT: usize = 12;
const LENGTH_AT: usize = GUID_AT + GUID.len();
const CONTENT_AT: usize = LENGTH_AT + 8;
/// After the interface, the state of the call sequence and the time.
const STOP_AT: usize = CONTENT_AT + 2 + 8 + 8;
/// After no stop time, and the number of Real variables in two bytes.
const VALUES_AT: usize = STOP_AT + 1 + 2;

/// CRC-32 as IEEE 802.3 defines it, bit by bit.
fn crc32(bytes: &[u8]) -> u32 {
    let mut remainder = u32::MAX;
    for byte in bytes {
        remainder ^= u32::from(*byte);
        for _ in 0..8 {
            let lowest = remainder & 1;
            remainder >>= 1;
            if lowest == 1 {
                remainder ^= 0xEDB8_8320;
            }
        }
    }
    !remainder
}

/// The bytes with the length and the checksum that belong to them.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let body = bytes.len() - 4;
    let length = (body - CONTENT_AT) as u64;
    bytes[LENGTH_AT..CONTENT_AT].copy_from_slice(&length.to_le_bytes());
    let checksum = crc32(&bytes[..body]);
    bytes[body..].copy_from_slice(&checksum.to_le_bytes());
    bytes
}

#[test]
fn bytes_that_are_no_state_of_this_fmu_are_refused_with_the_reason() {
    let instance = in_flight();
    let good = instance.state().serialize();
    assert_eq!(sealed(good.clone()), good, "the checksum is CRC-32");
    let changed = |place: usize, change: fn(u8) -> u8| {
        let mut bytes = good.clone();
        bytes[place] = change(bytes[place]);
        bytes
    };
    let refused = |bytes: &[u8], parts: &[&str]| {
        let message = refusal(&instance, bytes);
        for part in parts {
            assert!(message.contains(part), "{part} is not in {message}");
        }
    };
    for foreign in [
        &b""[..],
        b"HelRot",
        b"another format altogether",
        &[0; 4000],
    ] {
        refused(foreign, &["not a serialized state of this FMU"]);
    }
    refused(&changed(8, |b| b + 1), &["format 5", "reads 4"]);
    refused(&changed(GUID_AT + 5, |b| b ^ 1), &["GUID", GUID]);
    refused(&good[..good.len() - 1], &["cut short"]);
    refused(&good[..CONTENT_AT], &["cut short"]);
    refused(&[&good[..], b"\0"].concat(), &["too long"]);
    refused(&vec![0; 2 << 20], &["more bytes than it should have"]);
    refused(&changed(LENGTH_AT + 7, |_| 255), &["cut short"]);
    refused(
        &changed(CONTENT_AT + 100, |b| b ^ 0x10),
        &["damaged", "checksum"],
    );
    refused(&changed(good.len() - 1, |b| !b), &["damaged", "checksum"]);
    // With a good checksum, but not what this FMU writes.
    let hostile = |place: usize, value: &[u8]| {
        let mut bytes = good.clone();
        bytes[place..place + value.len()].copy_from_slice(value);
        sealed(bytes)
    };
    let (unwritten, mode) = ("not written", "the call sequence");
    refused(&hostile(CONTENT_AT, &[7]), &[unwritten]);
    refused(&hostile(CONTENT_AT, &[1]), &[mode]);
    // No state, two states at once, and one that this FMU never enters.
    for state in [0, 3, 1 << 5, 0x7f] {
        refused(&hostile(CONTENT_AT + 1, &[state]), &[mode]);
    }
    let nan = f64::NAN.to_le_bytes();
    refused(&hostile(CONTENT_AT + 2, &nan), &["time"]);
    refused(&hostile(CONTENT_AT + 10, &nan), &["time"]);
    // Neither without nor with a stop time.
    refused(&hostile(STOP_AT, &[2]), &[unwritten]);
    refused(
        &hostile(STOP_AT + 1, &[good[STOP_AT + 1] ^ 1]),
        &[unwritten],
    );
    // The same state in more bytes than it needs.
    let longer = [
        &good[..=CONTENT_AT],
        &[0x80 | 16, 0],
        &good[CONTENT_AT + 2..],
    ];
    refused(&sealed(longer.concat()), &[unwritten]);
    // What drives the rotor stands before torque and inertia.
    let drive: Vec<u8> = ["driveTorque", "drive.inertia"]
        .into_iter()
        .flat_map(|name| instance.real(name).to_le_bytes())
        .collect();
    let drive = good.windows(16).position(|bytes| bytes == drive).unwrap() - 1;
    refused(&hostile(drive, &[2]), &[unwritten]);
    refused(&hostile(drive, &[0]), &["cannot be used"]);
    for (i, v) in REALS.iter().enumerate() {
        refused(&hostile(VALUES_AT + 8 * i, &nan), &[v.name]);
        if v.min.is_finite() && !v.causality.is_computed() {
            refused(
                &hostile(VALUES_AT + 8 * i, &(v.min - 1.0).to_le_bytes()),
                &[v.name],
            );
        }
    }
    refused(&sealed([&good[..], b"more"].concat()), &["more bytes"]);
    refused(&sealed(good[..good.len() - 9].to_vec()), &["too early"]);
    // And all the time the instance has not changed.
    assert_eq!(went_on(&instance), went_on(&in_flight()));
}

#[test]
fn null_pointers_and_short_room_are_refused() {
    let instance = in_flight();
    let state = instance.state();
    let good = state.serialize();
    let (f, component) = (instance.functions, instance.component);
    let (mut size, mut room) = (0, vec![0x55; good.len() + 8]);
    let (count, out) = (good.len(), room.as_mut_ptr());
    let mut new = ptr::null_mut();
    let (from, null) = (good.as_ptr().cast(), ptr::null_mut());
    // SAFETY: the instance and the state live; the functions must not touch what is null.
    let answers = unsafe {
        [
            (f.fmi2SerializedFMUstateSize)(component, null, &mut size),
            (f.fmi2SerializedFMUstateSize)(component, state.pointer, ptr::null_mut()),
            (f.fmi2SerializeFMUstate)(component, null, out, count),
            (f.fmi2SerializeFMUstate)(component, state.pointer, ptr::null_mut(), count),
            (f.fmi2SerializeFMUstate)(component, state.pointer, out, count - 1),
            (f.fmi2DeSerializeFMUstate)(component, ptr::null(), count, &mut new),
            (f.fmi2DeSerializeFMUstate)(component, from, count, ptr::null_mut()),
        ]
    };
    assert_eq!(answers, [c::ERROR; 7]);
    assert!(new.is_null() && room.iter().all(|byte| *byte == 0x55));
    let log = instance.take_log();
    assert_eq!(log.len(), 7);
    let (null, size) = ("is a null pointer", "ask fmi2SerializedFMUstateSize");
    let words =
        "FMUstate is a null pointer; pass a state from fmi2GetFMUstate or fmi2DeSerializeFMUstate";
    for (line, part) in log.iter().zip([words, null, words, null, size, null, null]) {
        assert!(line.message.contains(part), "{line:?}");
    }
    // More room than is needed is left as it is.
    // SAFETY: the room is as large as is said.
    let status = unsafe { (f.fmi2SerializeFMUstate)(component, state.pointer, out, count + 8) };
    assert_eq!(status, c::OK);
    assert_eq!(room[count..], [0x55; 8]);
}

/// What becomes of an instance that is given bytes: they are refused with one sentence, or it goes
/// on, or refuses to, in its own words; a reset makes it as new.
fn survives(bytes: &[u8]) -> Result<(), TestCaseError> {
    let instance = Instance::new();
    let Ok(state) = instance.deserialize(bytes) else {
        prop_assert_eq!(instance.take_log().len(), 1);
        return Ok(());
    };
    prop_assert_eq!(
        state.serialize(),
        bytes,
        "what is taken is what was written"
    );
    let statuses = [
        instance.set_state(&state),
        instance.step(0.0173, 0.005),
        instance.terminate(),
    ];
    prop_assert!(statuses.iter().all(|s| [c::OK, c::ERROR].contains(s)));
    let mut values = vec![0.0; REALS.len()];
    let references: Vec<u32> = (0..REALS.len() as u32).collect();
    if instance.get_reals(&references, &mut values) == c::OK {
        prop_assert!(values.iter().all(|v| v.is_finite()));
    }
    for line in instance.take_log() {
        prop_assert!(!line.message.contains("internal error"), "{:?}", line);
    }
    drop(state);
    prop_assert_eq!(instance.reset(), c::OK);
    instance.initialize();
    Ok(())
}

fn good() -> &'static [u8] {
    static BYTES: std::sync::OnceLock<Vec<u8>> = std::sync::OnceLock::new();
    BYTES.get_or_init(|| in_flight().state().serialize())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(192) })]

    #[test]
    fn random_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..300), head in 0..60_usize) {
        survives(&bytes)?;
        survives(&[&good()[..head], &bytes].concat())?;
    }

    #[test]
    fn damaged_bytes_are_refused(place in 0..good().len(), flip in 1..=255_u8, end in 0..good().len()) {
        let mut bytes = good().to_vec();
        bytes[place] ^= flip;
        prop_assert!(Instance::new().deserialize(&bytes).is_err());
        prop_assert!(Instance::new().deserialize(&good()[..end]).is_err());
        survives(&bytes)?;
    }

    /// Any numbers anywhere, sealed with a good checksum.
    #[test]
    fn hostile_bytes_do_not_crash(
        changes in prop::collection::vec((CONTENT_AT..good().len() - 12, prop_oneof![
            prop::sample::select(vec![0.0, -1.0, 1.0, 1e300, -1e300, f64::NAN, f64::INFINITY, 5e-324, 0.5]),
            any::<f64>(),
        ]), 1..6),
        is_aligned in any::<bool>(),
    ) {
        let mut bytes = good().to_vec();
        for (place, value) in changes {
            let is_value = is_aligned && place > VALUES_AT;
            let place = if is_value { VALUES_AT + (place - VALUES_AT) / 8 * 8 } else { place };
            bytes[place..place + 8].copy_from_slice(&value.to_le_bytes());
        }
        survives(&sealed(bytes))?;
    }
}
