//! Reading the text files that a user names.

use std::{fs, path::Path};

/// Larger files are neither tables of sections nor rotors.
const MAX_BYTES: u64 = 64 << 20;

/// The content of a file.
#[derive(Debug)]
pub struct TextFile {
    /// Without a byte order mark.
    pub text: String,
    /// Hash of the text, which tells whether the file has changed.
    pub hash: u64,
}

/// The content of a file, or a phrase that says why it cannot be read.
///
/// Only plain files are opened: a device may never end.
pub fn read(path: &Path) -> Result<TextFile, String> {
    let about = fs::metadata(path).map_err(|e| e.to_string())?;
    if !about.is_file() {
        return Err("it is not a plain file".into());
    }
    if about.len() > MAX_BYTES {
        return Err(format!(
            "it has {} bytes, more than {MAX_BYTES}",
            about.len()
        ));
    }
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    let text = text
        .strip_prefix('\u{feff}')
        .map(str::to_owned)
        .unwrap_or(text);
    Ok(TextFile {
        hash: hash(text.as_bytes()),
        text,
    })
}

/// FNV-1a with 64 bits, by Fowler, Noll and Vo (1991): the same on every platform. It finds
/// changes by accident; it is no protection against forgery.
fn hash(bytes: &[u8]) -> u64 {
    bytes.iter().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Test vectors that its authors published.
    #[test]
    fn the_hash_is_fnv_1a() {
        for (text, value) in [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ] {
            assert_eq!(hash(text.as_bytes()), value, "{text}");
        }
    }

    #[cfg(unix)]
    #[test]
    fn a_device_that_never_ends_and_a_folder_are_refused() {
        for path in ["/dev/zero", "/"] {
            let reason = read(Path::new(path)).unwrap_err();
            assert_eq!(reason, "it is not a plain file");
        }
    }
}
