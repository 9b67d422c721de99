//! The registry of airfoil file formats.
//!
//! To add a format, write a file beside this one that parses it, and give it a row in `FORMATS`.

use super::{Airfoil, AirfoilError, c81, combi, polar};
use std::path::Path;

/// A format of airfoil files.
#[derive(Debug)]
pub struct Format {
    /// Whether a file with this path and text is in the format.
    pub detects: fn(&Path, &str) -> bool,
    /// Reads the text of a file; the second argument is the file's name for errors.
    pub parse: fn(&str, &str) -> Result<Airfoil, AirfoilError>,
}

/// All formats. The first that detects a file reads it; the last reads the rest.
pub const FORMATS: [Format; 3] = [combi::FORMAT, polar::FORMAT, c81::FORMAT];

/// The format of a file with this path and text.
pub fn detected(path: &Path, text: &str) -> &'static Format {
    let [.., last] = &FORMATS;
    let found = FORMATS.iter().find(|format| (format.detects)(path, text));
    found.unwrap_or(last)
}

/// Whether a file's name ends in a dot and `extension`, in capitals or not.
pub fn has_extension(path: &Path, extension: &str) -> bool {
    path.extension()
        .is_some_and(|e| e.eq_ignore_ascii_case(extension))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_counts_before_the_name_and_c81_is_the_rest() {
        for (name, text, expected) in [
            ("a.txt", "#1\n", combi::FORMAT),
            ("a.polar", "#1\n", combi::FORMAT),
            ("a.polar", "polar 1\n", polar::FORMAT),
            ("a.POLAR", "", polar::FORMAT),
            ("a.c81", "#12", c81::FORMAT),
            ("a.C81", "", c81::FORMAT),
            ("polar", "", c81::FORMAT),
            ("a", "", c81::FORMAT),
        ] {
            let found = detected(Path::new(name), text);
            let expected = expected.parse;
            assert!(std::ptr::fn_addr_eq(found.parse, expected), "{name} {text}");
        }
    }
}
