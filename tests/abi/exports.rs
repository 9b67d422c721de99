//! What the shared library exports.

use crate::support::{Fmu, c, fmu};
use std::{collections::BTreeSet, ffi::CStr, fs};

#[test]
fn the_44_functions_of_the_standard_are_exported_and_nothing_else() {
    // `Fmu::shared` has looked each of them up; here is what the file says itself.
    let file = fs::read(fmu::binary(&Fmu::shared().folder)).unwrap();
    if !file.starts_with(b"\x7fELF\x02\x01") {
        return; // not the format of this platform
    }
    let exported = defined_dynamic_symbols(&file);
    let standard: BTreeSet<String> = c::NAMES.iter().map(|n| (*n).to_owned()).collect();
    assert_eq!(standard.len(), 44);
    assert_eq!(exported, standard);
}

#[test]
fn version_and_platform_are_those_of_the_headers() {
    let f = &Fmu::shared().functions;
    // SAFETY: the functions answer constant C strings.
    let (version, platform) = unsafe {
        (
            CStr::from_ptr((f.fmi2GetVersion)()),
            CStr::from_ptr((f.fmi2GetTypesPlatform)()),
        )
    };
    assert_eq!((version, platform), (c"2.0", c"default"));
}

/// Names of the symbols that a little-endian ELF64 shared library defines for others: of its
/// section of type SHT_DYNSYM those that lie in a section.
fn defined_dynamic_symbols(file: &[u8]) -> BTreeSet<String> {
    let number = |at: usize, bytes: usize| {
        file[at..at + bytes]
            .iter()
            .rev()
            .fold(0, |n, byte| n << 8 | usize::from(*byte))
    };
    let (table, size, count) = (number(0x28, 8), number(0x3a, 2), number(0x3c, 2));
    let sections = || (0..count).map(|i| table + i * size);
    let symbols = sections()
        .find(|section| number(section + 4, 4) == 11)
        .unwrap();
    let names = number(table + size * number(symbols + 0x28, 4) + 0x18, 8);
    let (start, bytes) = (number(symbols + 0x18, 8), number(symbols + 0x20, 8));
    (start..start + bytes)
        .step_by(24)
        .filter(|symbol| number(symbol + 6, 2) != 0)
        .map(|symbol| {
            let name = CStr::from_bytes_until_nul(&file[names + number(symbol, 4)..]).unwrap();
            name.to_str().unwrap().to_owned()
        })
        .collect()
}
