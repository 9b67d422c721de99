//! Whose memory is whose: strings that the library hands out, and what it must copy.

use crate::support::{
    Fmu, Instance,
    c::{self, Reference, Text},
    instance::{Line, Log, callbacks},
};
use helicopter_rotor::block::variables::{GUID, STRINGS};
use std::{
    ffi::{CStr, CString},
    mem::MaybeUninit,
    ptr,
    sync::Mutex,
};

/// The pointers that one call of fmi2GetString hands out.
fn strings<const N: usize>(instance: &Instance, references: [Reference; N]) -> [Text; N] {
    let mut texts = [ptr::null(); N];
    let get = instance.functions.fmi2GetString;
    // SAFETY: both pointers are valid for N elements.
    let status = unsafe {
        get(
            instance.component,
            references.as_ptr(),
            N,
            texts.as_mut_ptr(),
        )
    };
    assert_eq!(status, c::OK);
    texts
}

fn text<'a>(text: Text) -> &'a str {
    // SAFETY: called on pointers from the last call of fmi2GetString alone.
    unsafe { CStr::from_ptr(text) }.to_str().unwrap()
}

#[test]
fn strings_stay_valid_until_the_next_call() {
    let (geometry, airfoil) = (0, 1);
    assert_eq!(
        [STRINGS[0].name, STRINGS[1].name],
        ["geometry.file", "airfoil.file"]
    );
    let long = "ü".repeat(5000);
    let instance = Instance::new();
    assert_eq!(instance.set_string("geometry.file", &long), c::OK);
    instance.begin_initialization();
    // All of one call are valid at once, and when one is asked for twice, both are.
    let [a, b, c, d] = strings(&instance, [geometry, airfoil, geometry, airfoil]).map(text);
    assert_eq!((a, c), (long.as_str(), long.as_str()));
    assert_eq!((b, d), (STRINGS[1].start, STRINGS[1].start));
    // Other instances do not touch them.
    let other = Instance::new();
    assert_eq!(other.set_string("geometry.file", "other"), c::OK);
    other.begin_initialization();
    assert_eq!(other.string("geometry.file"), "other");
    assert_eq!((a, b), (long.as_str(), STRINGS[1].start));

    assert_eq!(instance.set_string("geometry.file", ""), c::OK);
    assert_eq!(instance.string("geometry.file"), "");
}

#[test]
fn a_string_is_copied_when_it_is_set() {
    let instance = Instance::new();
    let mut bytes = b"knight-hefner-4.toml\0".to_vec();
    let text = CStr::from_bytes_with_nul(&bytes).unwrap();
    assert_eq!(instance.set_string_at(0, text), c::OK);
    bytes.fill(b'X');
    instance.initialize();
    assert_eq!(instance.string("geometry.file"), "knight-hefner-4.toml");
}

#[test]
fn all_that_instantiate_is_given_may_be_overwritten_afterwards() {
    let log: Log = Mutex::default();
    let resources = crate::support::fmu::uri(&Fmu::shared().resources());
    let mut texts = ["main rotor", GUID, &resources]
        .map(|text| CString::new(text).unwrap().into_bytes_with_nul());
    let mut memory = Box::new(MaybeUninit::new(callbacks(&log)));
    let f = &Fmu::shared().functions;
    let [name, guid, location] = [0, 1, 2].map(|i: usize| texts[i].as_ptr().cast());
    // SAFETY: the pointers are valid during the call.
    let component = unsafe {
        (f.fmi2Instantiate)(
            name,
            c::CO_SIMULATION,
            guid,
            location,
            memory.as_ptr(),
            0,
            1,
        )
    };
    // SAFETY: the memory is the test's own; as plain bytes it may hold anything.
    unsafe {
        memory
            .as_mut_ptr()
            .cast::<u8>()
            .write_bytes(0xA5, size_of::<c::Callbacks>())
    };
    for text in &mut texts {
        text.fill(b'Z');
    }
    drop((memory, texts));
    // SAFETY: the component lives until it is freed.
    unsafe {
        assert_eq!((f.fmi2DoStep)(component, 0.0, 0.1, 1), c::ERROR);
        assert_eq!((f.fmi2EnterInitializationMode)(component), c::OK);
        assert_eq!((f.fmi2ExitInitializationMode)(component), c::OK);
        (f.fmi2FreeInstance)(component);
    }
    let log: Vec<Line> = log.into_inner().unwrap();
    assert!(
        log.len() >= 2 && log.iter().all(|line| line.instance == "main rotor"),
        "{log:?}"
    );
    assert!(log[0].message.contains("fmi2DoStep"), "{log:?}");
    assert!(
        log[1]
            .message
            .contains(Fmu::shared().resources().to_str().unwrap()),
        "{log:?}"
    );
}
