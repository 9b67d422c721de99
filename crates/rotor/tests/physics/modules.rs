//! No module imports upwards: each uses only those before it in the list on the crate's page.

use std::{
    fs,
    path::{Path, PathBuf},
};

fn sources() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// The modules in their order: the names in backticks in the list of `lib.rs`.
fn order() -> Vec<String> {
    let text = fs::read_to_string(sources().join("lib.rs")).unwrap();
    let list = text.split("only from those before it:").nth(1).unwrap();
    let lines = list
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with("//!"));
    let names = lines.flat_map(|line| line.split('`').skip(1).step_by(2).map(str::to_owned));
    names.collect()
}

/// The files of a module.
fn files(module: &str) -> Vec<PathBuf> {
    let (file, folder) = (
        sources().join(format!("{module}.rs")),
        sources().join(module),
    );
    let mut found: Vec<PathBuf> = file.is_file().then_some(file).into_iter().collect();
    let mut folders: Vec<PathBuf> = folder.is_dir().then_some(folder).into_iter().collect();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                found.push(path);
            }
        }
    }
    found
}

/// The modules that a text names behind a prefix, as in `crate::a::b` or `crate::{a, b::{c}}`.
fn named(text: &str, prefix: &str) -> Vec<String> {
    let mut names = Vec::new();
    for (start, _) in text.match_indices(prefix) {
        let rest = &text[start + prefix.len()..];
        let Some(group) = rest.strip_prefix('{') else {
            names.push(word(rest));
            continue;
        };
        let mut depth = 0;
        let mut is_first = true;
        for (i, c) in group.char_indices() {
            match c {
                '{' => depth += 1,
                '}' if depth == 0 => break,
                '}' => depth -= 1,
                ',' if depth == 0 => is_first = true,
                c if is_first && c.is_alphabetic() => {
                    names.push(word(&group[i..]));
                    is_first = false;
                }
                _ => {}
            }
        }
    }
    names
}

fn word(text: &str) -> String {
    let is_part = |c: &char| c.is_alphanumeric() || *c == '_';
    text.chars().take_while(is_part).collect()
}

/// The code without comments and without the module of tests at its end, which may use anything.
fn without_tests(text: &str) -> String {
    let (code, tests) = text.split_once("\nmod tests {\n").unwrap_or((text, ""));
    assert!(!tests.contains("\n}\n\n"), "code after the tests");
    let lines = code.lines();
    let lines = lines.filter(|line| !line.trim_start().starts_with("//"));
    lines.map(|line| format!("{line}\n")).collect()
}

#[test]
fn modules_import_only_those_before_them() {
    let order = order();
    let mut upwards = Vec::new();
    for (place, module) in order.iter().enumerate() {
        let files = files(module);
        assert!(!files.is_empty(), "{module} of the list is no module");
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            let code = without_tests(&text);
            // How the file names the crate: `crate`, and one `super` for each module around it.
            let depth = file.strip_prefix(sources()).unwrap().iter().count();
            let depth = depth - usize::from(file.ends_with("mod.rs"));
            for prefix in ["crate::".to_owned(), "super::".repeat(depth)] {
                for name in named(&code, &prefix) {
                    // A name that the crate's page re-exports could come from any module.
                    let found = order.iter().position(|m| *m == name);
                    if found.is_none_or(|p| p > place) {
                        upwards.push(format!("{module} uses {prefix}{name}"));
                    }
                }
            }
        }
    }
    assert!(upwards.is_empty(), "{upwards:#?}");
}

#[test]
fn the_list_has_every_module() {
    let text = fs::read_to_string(sources().join("lib.rs")).unwrap();
    let lines = text.lines().filter_map(|line| {
        let line = line.strip_prefix("pub ").unwrap_or(line);
        line.strip_prefix("mod ")?.strip_suffix(';')
    });
    let mut modules: Vec<&str> = lines.collect();
    let mut listed = order();
    modules.sort_unstable();
    listed.sort_unstable();
    assert_eq!(modules, listed);
}
