//! Reading the text files that a user names.

use std::{fs, path::Path};

/// Larger files are neither tables of sections nor rotors.
const MAX_BYTES: u64 = 64 << 20;

/// The text of a file, without a byte order mark, or a phrase that says why it cannot be read.
///
/// Only plain files are opened: a device may never end.
pub fn read(path: &Path) -> Result<String, String> {
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
    Ok(text
        .strip_prefix('\u{feff}')
        .map(str::to_owned)
        .unwrap_or(text))
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    #[test]
    fn a_device_that_never_ends_and_a_folder_are_refused() {
        for path in ["/dev/zero", "/"] {
            assert_eq!(read(Path::new(path)), Err("it is not a plain file".into()));
        }
    }
}
