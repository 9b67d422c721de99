//! What the shared library exports.

use crate::support::{Fmu, c, c3, fmu};
use object::Object;
use std::{collections::BTreeSet, ffi::CStr, fs};

#[test]
fn the_44_and_75_functions_of_the_standards_are_exported_and_nothing_else() {
    // `Fmu::shared` has looked each of them up; here is what the file says itself.
    let bytes = fs::read(fmu::binary(&Fmu::shared().folder)).unwrap();
    let file = object::File::parse(&*bytes).unwrap();
    let names = file.exports().unwrap().map(|export| {
        let export = export.unwrap();
        let object::NameOrOrdinal::Name(name) = export.name() else {
            panic!("{export:?} has no name");
        };
        let name = str::from_utf8(name).unwrap();
        // Mach-O puts an underscore before names of C.
        name.strip_prefix('_').unwrap_or(name).to_owned()
    });
    let exported: BTreeSet<String> = names.collect();
    let standard = c::NAMES.iter().chain(&c3::NAMES);
    let standard: BTreeSet<String> = standard.map(|n| (*n).to_owned()).collect();
    assert_eq!(standard.len(), 44 + 75);
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
