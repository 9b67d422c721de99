//! What examples print and write: tables and plots.

use std::{collections::BTreeMap, path::Path};

/// A plot has been drawn.
pub fn assert_plot(file: &Path) {
    assert!(file.metadata().unwrap().len() > 10_000, "{file:?}");
}

/// The words of a line that are numbers.
pub fn numbers(line: &str) -> Vec<f64> {
    let words = line.split_whitespace();
    words.filter_map(|word| word.parse().ok()).collect()
}

/// The fields of a row, by the names of the columns.
pub type Row = BTreeMap<String, String>;

/// The rows of a CSV file with a header.
pub fn csv(file: &Path) -> Vec<Row> {
    let mut table = csv::Reader::from_path(file).unwrap();
    table.deserialize().map(Result::unwrap).collect()
}

pub fn value(row: &Row, name: &str) -> f64 {
    let field = row.get(name).unwrap_or_else(|| panic!("no column {name}"));
    field.parse().unwrap()
}
