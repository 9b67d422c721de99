//! The files from which a rotor was made, and whether they are those of a saved state.

use serde::{Deserialize, Serialize};
use std::path::PathBuf;

/// A file as a parameter or a rotor file names it, and a hash of its text.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileHash {
    pub name: String,
    pub hash: u64,
}

/// A file that was read.
#[derive(Debug)]
pub struct ReadFile {
    pub content: FileHash,
    pub path: PathBuf,
    /// What was read from it: the beginning of a sentence that ends with the path.
    pub what: String,
    /// The end of the sentence, such as what a rotor file gives for parameters.
    pub details: String,
}

impl ReadFile {
    /// The sentence for the log that says what was read.
    pub fn note(&self) -> String {
        let Self { what, details, .. } = self;
        format!("{what} from {}{details}", self.path.display())
    }
}

/// A warning for each file whose content differs from that in a saved state.
pub fn changes(saved: &[FileHash], files: &[ReadFile]) -> Vec<String> {
    let mut warnings: Vec<String> = Vec::new();
    for file in files {
        // A rotor and an airfoil may have one name in folders of their own.
        let is_named = |saved: &&FileHash| saved.name == file.content.name;
        let mut named = saved.iter().filter(is_named).peekable();
        if named.peek().is_some() && named.all(|saved| saved.hash != file.content.hash) {
            let warning = format!(
                "the file {} has changed since the state was saved, and the rotor is that of the present file: results differ from those of the saved simulation; restore the file to continue with its rotor",
                file.path.display()
            );
            if !warnings.contains(&warning) {
                warnings.push(warning);
            }
        }
    }
    warnings
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_changed_file_is_named_once() {
        let content = |name: &str, hash| FileHash {
            name: name.to_owned(),
            hash,
        };
        let read = |name: &str, hash| ReadFile {
            content: content(name, hash),
            path: PathBuf::from("/folder").join(name),
            what: String::new(),
            details: String::new(),
        };
        let files = [read("rotor", 1), read("a", 2), read("b", 3), read("a", 2)];
        let saved = |a, b| [content("rotor", 1), content("a", a), content("b", b)];
        assert_eq!(changes(&saved(2, 3), &files), [""; 0]);
        assert_eq!(changes(&[], &files), [""; 0]);
        let warnings = changes(&saved(4, 3), &files);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].contains("/folder/a has changed"));
        assert_eq!(changes(&saved(4, 5), &files).len(), 2);
    }
}
