//! Where files are: `file:` URIs, and names relative to the FMU's resources.

use super::resource_files::is_file;
use std::path::{Path, PathBuf};

/// The path in a `file:` URI (`file:/x`, `file:///x`, `file://localhost/x`, percent-encoded
/// UTF-8). On Windows also `file:///C:/x` and what importers make of it (`file://C:/x`,
/// `file:C:/x`, `C|`, backslashes), and the shares of other hosts (`file://server/share/x`).
/// `None` for any other URI and for one without an absolute path.
pub fn path_from_uri(uri: &str) -> Option<PathBuf> {
    path_text(uri, cfg!(windows)).map(PathBuf::from)
}

const THIS_HOST: &str = "//localhost/";

fn path_text(uri: &str, on_windows: bool) -> Option<String> {
    let scheme = uri.get(..5)?;
    if !scheme.eq_ignore_ascii_case("file:") {
        return None;
    }
    let mut rest = percent_decoded(&uri[5..])?;
    if on_windows {
        rest = rest.replace('\\', "/");
    }
    let begin = rest.get(..THIS_HOST.len());
    if begin.is_some_and(|begin| begin.eq_ignore_ascii_case(THIS_HOST)) {
        // The last slash is the path's.
        rest.drain(..THIS_HOST.len() - 1);
    }
    if on_windows && let Some(path) = path_on_drive(rest.trim_start_matches('/')) {
        return Some(path);
    }
    // Two slashes are followed by the host, and that by the path's own slash.
    let (host, path) = match rest.strip_prefix("//") {
        Some(authority) => authority.split_at(authority.find('/')?),
        None => ("", &*rest),
    };
    if !path.starts_with('/') {
        return None;
    }
    if on_windows && !host.is_empty() {
        return Some(format!("//{host}{path}"));
    }
    if on_windows && path.starts_with("//") {
        // Some write four or five slashes before the server.
        return Some(format!("//{}", path.trim_start_matches('/')));
    }
    Some(path.to_owned())
}

/// The path, if it begins with the letter of a drive: `C:/x` or `C|/x`.
fn path_on_drive(path: &str) -> Option<String> {
    let mut letters = path.chars();
    let (drive, mark) = (letters.next()?, letters.next()?);
    let below = letters.as_str();
    let is_drive = drive.is_ascii_alphabetic() && matches!(mark, ':' | '|');
    (is_drive && below.starts_with('/')).then(|| format!("{drive}:{below}"))
}

/// The text with every %XX replaced by its byte. `None` if the result is not UTF-8.
fn percent_decoded(text: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(text.len());
    let mut rest = text.as_bytes();
    while let Some((first, tail)) = rest.split_first() {
        let digit = |i: usize| tail.get(i).and_then(|b| char::from(*b).to_digit(16));
        match (first, digit(0), digit(1)) {
            (b'%', Some(high), Some(low)) => {
                bytes.push((16 * high + low) as u8);
                rest = &tail[2..];
            }
            _ => {
                bytes.push(*first);
                rest = tail;
            }
        }
    }
    String::from_utf8(bytes).ok()
}

/// The file that a parameter names. A `file:` URI or an absolute path is taken as it is. Any other
/// name is looked for in `folder` of the resources first, then relative to the resources.
pub fn resolve(resources: &Path, folder: &str, name: &str) -> PathBuf {
    if let Some(path) = path_from_uri(name) {
        return path;
    }
    let in_folder = resources.join(folder).join(name);
    if is_file(&in_folder) {
        return in_folder;
    }
    resources.join(name) // `join` keeps an absolute path as it is
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_forms_of_file_uris() {
        for (uri, path) in [
            ("file:/a/b", "/a/b"),
            ("file:///a/b", "/a/b"),
            ("FILE:///a/b", "/a/b"),
            ("file://localhost/a/b", "/a/b"),
            ("file:///a%20b/%C3%A9", "/a b/\u{e9}"),
            ("file:///a/100%", "/a/100%"),
        ] {
            for on_windows in [false, true] {
                assert_eq!(path_text(uri, on_windows).as_deref(), Some(path), "{uri}");
            }
        }
        for uri in [
            "",
            "/a/b",
            "file:x",
            "file:C:x",
            "http://x/y",
            "file://host-without-path",
            "file:///%FF",
        ] {
            for on_windows in [false, true] {
                assert_eq!(path_text(uri, on_windows), None, "{uri}");
            }
        }
    }

    #[test]
    fn the_forms_of_file_uris_on_windows() {
        for (uri, path) in [
            ("file:///C:/a", "C:/a"),
            ("file:/C:/a", "C:/a"),
            ("file:C:/a", "C:/a"),
            ("file://C:/a", "C:/a"),
            ("file://localhost/C:/a", "C:/a"),
            ("file:///C|/a", "C:/a"),
            ("file:///C%3A/a", "C:/a"),
            ("file:///C%3a%5Ca%20b", "C:/a b"),
            ("file:///C:\\a\\b", "C:/a/b"),
            ("file:C:\\a", "C:/a"),
            ("file:///C:/", "C:/"),
            ("file://server/share/a", "//server/share/a"),
            ("file:////server/share/a", "//server/share/a"),
            ("file://///server/share/a", "//server/share/a"),
            ("file:\\\\server\\share\\a", "//server/share/a"),
        ] {
            assert_eq!(path_text(uri, true).as_deref(), Some(path), "{uri}");
        }
    }

    /// There these are names of files, and other hosts cannot be reached by a path.
    #[test]
    fn drives_and_backslashes_are_names_elsewhere() {
        for (uri, path) in [
            ("file:///C:/a", "/C:/a"),
            ("file:///C|/a", "/C|/a"),
            ("file:///a\\b", "/a\\b"),
            ("file://server/share/a", "/share/a"),
        ] {
            assert_eq!(path_text(uri, false).as_deref(), Some(path), "{uri}");
        }
    }
}
