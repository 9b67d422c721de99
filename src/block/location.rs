//! Where files are: `file:` URIs, and names relative to the FMU's resources.

use std::path::{Path, PathBuf};

/// The path in a `file:` URI (`file:/x`, `file:///x`, `file://localhost/x`, percent-encoded
/// UTF-8, `file:///C:/x`). `None` for any other URI and for one without an absolute path.
pub fn path_from_uri(uri: &str) -> Option<PathBuf> {
    let scheme = uri.get(..5)?;
    if !scheme.eq_ignore_ascii_case("file:") {
        return None;
    }
    let rest = &uri[5..];
    let path = match rest.strip_prefix("//") {
        // Two slashes are followed by the host, and that by the path's own slash.
        Some(authority) => &authority[authority.find('/')?..],
        None if rest.starts_with('/') => rest,
        None => return None,
    };
    let path = percent_decoded(path)?;
    let drive = path.as_bytes();
    let has_drive = drive.len() > 2 && drive[1].is_ascii_alphabetic() && drive[2] == b':';
    Some(PathBuf::from(if has_drive { &path[1..] } else { &path }))
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
    if in_folder.is_file() {
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
            ("file:///C:/a", "C:/a"),
        ] {
            assert_eq!(path_from_uri(uri), Some(PathBuf::from(path)), "{uri}");
        }
        for uri in [
            "",
            "/a/b",
            "file:x",
            "http://x/y",
            "file://host-without-path",
            "file:///%FF",
        ] {
            assert_eq!(path_from_uri(uri), None, "{uri}");
        }
    }
}
