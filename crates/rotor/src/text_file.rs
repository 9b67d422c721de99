//! Reading the text files that a user names.
//!
//! A file may come from a stranger, or be none: what is read of it, what its content makes of
//! memory, and what a message quotes of it have limits.

mod excerpt;
mod memory;

pub use excerpt::excerpt;
pub use memory::{NoMemory, collect, ensure, push};

use std::{
    fs::{self, File, Metadata, OpenOptions},
    io::{ErrorKind, Read},
    path::Path,
};

/// The content of a file.
#[derive(Debug)]
pub struct TextFile {
    /// Without a byte order mark.
    pub text: String,
    /// Hash of the text, which tells whether the file has changed.
    pub hash: u64,
}

/// The content of a file of at most `max_bytes`, or a phrase that says why it cannot be read.
///
/// Only plain files are opened: a device may never end, and opening it may have effects.
pub fn read(path: &Path, max_bytes: u64) -> Result<TextFile, String> {
    check(&fs::metadata(path).map_err(|e| e.to_string())?)?;
    let file = open(path).map_err(|e| e.to_string())?;
    content(file, max_bytes)
}

/// Refuses what is not a plain file.
fn check(about: &Metadata) -> Result<(), String> {
    if about.is_file() {
        return Ok(());
    }
    Err("it is not a plain file".into())
}

/// Opens a file without waiting, should it have become a pipe, and without taking it for the
/// process's terminal.
fn open(path: &Path) -> std::io::Result<File> {
    let mut options = OpenOptions::new();
    // Miri does not know these flags.
    #[cfg(all(unix, not(miri)))]
    std::os::unix::fs::OpenOptionsExt::custom_flags(
        &mut options,
        libc::O_NONBLOCK | libc::O_NOCTTY,
    );
    options.read(true).open(path)
}

/// The content of an open file, about which only the file itself is asked: the path may lead to
/// another one by now.
fn content(file: File, max_bytes: u64) -> Result<TextFile, String> {
    let about = file.metadata().map_err(|e| e.to_string())?;
    check(&about)?;
    let too_large = |bytes: u64| Err(format!("it has {bytes} bytes, more than {max_bytes}"));
    if about.len() > max_bytes {
        return too_large(about.len());
    }
    let mut bytes = Vec::new();
    // The files of the system in /proc have no length either, and some of them wait or never end.
    if about.len() > 0 {
        let no_memory = || NoMemory("its content").to_string();
        // One more, as the end is found by reading beyond it.
        let room = usize::try_from(about.len() + 1).map_err(|_| no_memory())?;
        bytes.try_reserve_exact(room).map_err(|_| no_memory())?;
        // It may grow while it is read.
        let end = file.take(max_bytes + 1).read_to_end(&mut bytes);
        end.map_err(|e| {
            if e.kind() == ErrorKind::OutOfMemory {
                return no_memory();
            }
            e.to_string()
        })?;
    }
    if bytes.len() as u64 > max_bytes {
        return too_large(bytes.len() as u64);
    }
    let mut text = String::from_utf8(bytes).map_err(|e| e.utf8_error().to_string())?;
    if text.starts_with('\u{feff}') {
        text.drain(..'\u{feff}'.len_utf8());
    }
    Ok(TextFile {
        hash: hash_of_text(&text),
        text,
    })
}

/// FNV-1a with 64 bits, by Fowler, Noll and Vo (1991): the same on every platform. It finds
/// changes by accident; it is no protection against forgery.
pub fn hash_of_text(text: &str) -> u64 {
    text.bytes().fold(0xcbf2_9ce4_8422_2325, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::PathBuf;

    /// A path for a file of this test.
    fn scratch(name: &str) -> PathBuf {
        let name = format!("helicopter-rotor-{}-{name}", std::process::id());
        std::env::temp_dir().join(name)
    }

    /// Test vectors that its authors published.
    #[test]
    fn the_hash_is_fnv_1a() {
        for (text, value) in [
            ("", 0xcbf2_9ce4_8422_2325),
            ("a", 0xaf63_dc4c_8601_ec8c),
            ("foobar", 0x8594_4171_f739_67e8),
        ] {
            assert_eq!(hash_of_text(text), value, "{text}");
        }
    }

    #[test]
    fn a_file_is_read_up_to_the_limit_and_without_its_byte_order_mark() {
        let path = scratch("text");
        fs::write(&path, "\u{feff}ü1").unwrap();
        assert_eq!(read(&path, 6).unwrap().text, "ü1");
        let reason = read(&path, 5).unwrap_err();
        assert_eq!(reason, "it has 6 bytes, more than 5");
        fs::write(&path, "").unwrap();
        assert_eq!(read(&path, 6).unwrap().text, "");
        fs::remove_file(path).unwrap();
    }

    #[cfg(unix)]
    #[test]
    fn a_device_that_never_ends_and_a_folder_are_refused() {
        for path in ["/dev/zero", "/"] {
            let reason = read(Path::new(path), 100).unwrap_err();
            assert_eq!(reason, "it is not a plain file");
        }
    }

    /// They pass for plain files without a length. The log of the kernel waits for its next line,
    /// and the page map has 8 bytes for each page of the address space: 2^36 pages.
    #[cfg(target_os = "linux")]
    #[test]
    fn files_of_the_system_without_a_length_are_empty() {
        let paths = ["/proc/kmsg", "/proc/self/pagemap", "/proc/self/maps"];
        let mut read_any = false;
        for path in paths.map(Path::new) {
            // Not every process may open all of them.
            if let Ok(file) = read(path, 1 << 26) {
                assert_eq!(file.text, "", "{}", path.display());
                read_any = true;
            }
        }
        assert!(read_any);
    }

    #[test]
    fn an_error_of_the_system_while_reading_is_told() {
        let path = scratch("unreadable");
        fs::write(&path, "text").unwrap();
        let only_written = OpenOptions::new().write(true).open(&path).unwrap();
        let reason = content(only_written, 100).unwrap_err();
        assert!(reason.contains("os error"), "{reason}");
        fs::remove_file(path).unwrap();
    }

    /// As if it had taken the place of a plain file just before the path was opened.
    #[cfg(unix)]
    #[test]
    fn a_pipe_that_nobody_writes_to_is_refused_without_waiting() {
        let path = scratch("pipe");
        let made = std::process::Command::new("mkfifo").arg(&path).status();
        assert!(made.unwrap().success());
        let reason = content(open(&path).unwrap(), 100).unwrap_err();
        assert_eq!(reason, "it is not a plain file");
        assert_eq!(read(&path, 100).unwrap_err(), "it is not a plain file");
        fs::remove_file(path).unwrap();
    }
}
