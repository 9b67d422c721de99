//! QBlade's `.plr` files: keywords, then rows of an angle and, for each Reynolds number, lift, drag
//! and moment (and three more columns if decomposed).

use super::{
    Table, Tables,
    line::{number, numbers},
};
use crate::{
    Failure,
    polar::{Angles, Point},
};

/// Reads the polars.
pub fn read(text: &str, file: &str) -> Result<Tables, Failure> {
    let mut reynolds: Vec<f64> = Vec::new();
    let mut name = None;
    let mut stride = 3;
    let mut rows = Vec::new();
    for line in text.lines() {
        // What follows a dash between blanks explains the keyword.
        let content = line.split(" - ").next().unwrap_or("");
        let words: Vec<&str> = content.split_whitespace().collect();
        let has = |key: &str| words.iter().any(|word| word.eq_ignore_ascii_case(key));
        if has("REYNOLDS") {
            reynolds = words.iter().filter_map(|word| number(word)).collect();
        } else if has("FOILNAME") {
            let others = words
                .iter()
                .filter(|word| !word.eq_ignore_ascii_case("FOILNAME"));
            name = Some(others.copied().collect::<Vec<_>>().join(" "));
        } else if has("ISDECOMPOSED") {
            let is_true = words
                .iter()
                .any(|word| *word == "1" || word.eq_ignore_ascii_case("true"));
            stride = if is_true { 6 } else { 3 };
        } else if let Some(row) = numbers(line).filter(|row| row.len() >= 3) {
            rows.push(row);
        }
    }
    if reynolds.is_empty() {
        return Err(Failure(format!(
            "{file}: the line with REYNOLDS and its numbers is missing"
        )));
    }
    let mut tables: Vec<Table> = reynolds
        .iter()
        .map(|re| Table {
            reynolds: Some(*re),
            ..Table::default()
        })
        .collect();
    for row in rows {
        for (i, table) in tables.iter_mut().enumerate() {
            let at = 1 + stride * i;
            let (Some(lift), Some(drag)) = (row.get(at), row.get(at + 1)) else {
                return Err(Failure(format!(
                    "{file}: the row at {} deg has {} numbers, too few for {} Reynolds numbers",
                    row[0],
                    row.len(),
                    reynolds.len()
                )));
            };
            table.points.push(Point {
                alpha: row[0],
                lift: *lift,
                drag: *drag,
            });
        }
    }
    Ok(Tables {
        name,
        tables,
        angles: Some(Angles::Deg),
        ..Tables::default()
    })
}
