//! URIs: any text is a path or none, and every absolute path has a URI that leads back to it.

#![no_main]

use fuzz::promise;
use helicopter_rotor::block::path_from_uri;
use libfuzzer_sys::fuzz_target;
use std::path::PathBuf;

fuzz_target!(|text: &str| {
    if let Some(path) = path_from_uri(text) {
        let path = path.to_str().unwrap();
        promise(text.len() >= 5 + path.len(), || {
            format!("{path} is longer than {text}")
        });
        let drive = path.as_bytes();
        let is_drive = drive.len() >= 2 && drive[0].is_ascii_alphabetic() && drive[1] == b':';
        promise(path.starts_with('/') || is_drive, || {
            format!("{path} is relative")
        });
    }
    // An underscore is no drive.
    let path = format!("/_{text}");
    let encoded: String = path.bytes().map(|byte| format!("%{byte:02x}")).collect();
    for uri in [
        format!("file:///{}", &encoded[3..]),
        format!("File:/{}", &encoded[3..]),
    ] {
        promise(path_from_uri(&uri) == Some(PathBuf::from(&path)), || {
            format!("{uri} does not lead to {path}")
        });
    }
});
