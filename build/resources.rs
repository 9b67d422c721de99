//! The files of the FMU's resources as a table in Rust, for libraries that have no files: those in
//! WebAssembly.

use std::{
    error::Error,
    fmt::Write,
    fs,
    path::{Path, PathBuf},
};

/// A constant with the name below resources/ and the text of each file, in the order of the names.
pub fn table(resources: &Path) -> Result<String, Box<dyn Error>> {
    let mut table = String::from("pub const TEXTS: &[(&str, &str)] = &[\n");
    for folder in sorted(resources)? {
        for file in sorted(&folder)? {
            let name = file.strip_prefix(resources)?.to_string_lossy();
            let name = name.replace('\\', "/");
            let path = std::path::absolute(&file)?;
            writeln!(table, "    ({name:?}, include_str!({path:?})),")?;
        }
    }
    table.push_str("];\n");
    Ok(table)
}

fn sorted(folder: &Path) -> Result<Vec<PathBuf>, Box<dyn Error>> {
    let entries = fs::read_dir(folder)?.collect::<Result<Vec<_>, _>>()?;
    let mut paths: Vec<_> = entries.into_iter().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}
