//! Reading the text files that a user names.

use std::{fs, path::Path};

/// Larger files are not tables of sections or rotors.
const MAX_BYTES: u64 = 64 << 20;

/// The text of a file, or a phrase that says why there is none. What is no plain file, such as a
/// device that never ends, is not opened.
pub fn read(path: &Path) -> Result<String, String> {
    let about = fs::metadata(path).map_err(|e| e.to_string())?;
    if !about.is_file() {
        return Err("it is no plain file".into());
    }
    if about.len() > MAX_BYTES {
        return Err(format!(
            "it has {} bytes, more than {MAX_BYTES}",
            about.len()
        ));
    }
    let text = fs::read_to_string(path).map_err(|e| e.to_string())?;
    // Some editors begin a file with a mark of its encoding.
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
            assert_eq!(read(Path::new(path)), Err("it is no plain file".into()));
        }
    }
}
