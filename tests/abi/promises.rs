//! The promises in docs/robustness.md name tests that exist.

use std::{fs, path::Path};

/// The texts of all Rust files below a folder.
fn sources(folder: &Path, texts: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        if path.is_dir() && name != "target" {
            sources(&path, texts);
        } else if name.ends_with(".rs") {
            texts.push(fs::read_to_string(&path).unwrap());
        }
    }
}

#[test]
fn every_promise_names_a_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut texts = Vec::new();
    for folder in ["src", "tests", "crates"] {
        sources(&root.join(folder), &mut texts);
    }
    let page = fs::read_to_string(root.join("docs/robustness.md")).unwrap();
    let promises = page.split("\n## ").next().unwrap();
    let rows = promises.lines().filter(|line| line.starts_with("| "));
    let mut count = 0;
    for row in rows.skip(1) {
        let tests = row.trim_end_matches(" |").rsplit(" | ").next().unwrap();
        for test in tests.split(", ").map(|name| name.trim_matches('`')) {
            let (module, function) = (format!("\nmod {test};"), format!("\nfn {test}"));
            let is_test = |text: &String| {
                let text = text.replace("    fn ", "fn ").replace("    #", "#");
                text.contains(&format!("#[test]{function}"))
            };
            let is_module = |text: &String| text.contains(&module);
            let found = texts.iter().any(is_test) || texts.iter().any(is_module);
            assert!(found, "no test {test}: {row}");
            count += 1;
        }
    }
    assert!(count > 10, "{count} tests are named");
}
