//! Airfoil files of AeroDyn: AirfoilInfo of version 15 and OpenFAST, and those of 13 and 14.

use super::{
    Table, Tables,
    line::{number, numbers},
};
use crate::{
    Failure,
    polar::{Angles, Point},
};

/// Reads an AirfoilInfo file: lines of a value and its name; `NumAlf` rows follow its line.
pub fn read_info(text: &str, file: &str) -> Result<Tables, Failure> {
    let mut tables = Tables {
        angles: Some(Angles::Deg),
        ..Tables::default()
    };
    let mut reynolds = None;
    let mut lines = text.lines().enumerate().filter(|(_, line)| {
        let line = line.trim();
        !line.is_empty() && !line.starts_with('!')
    });
    while let Some((i, line)) = lines.next() {
        let mut words = line.split_whitespace();
        let (Some(value), Some(key)) = (words.next(), words.next()) else {
            continue;
        };
        if key.eq_ignore_ascii_case("Re") {
            reynolds = number(value).map(|millions| 1e6 * millions);
        } else if key.eq_ignore_ascii_case("NumAlf") {
            let Ok(count) = value.parse::<usize>() else {
                return Err(Failure(format!(
                    "{file}, line {}: `{value}` is no number of rows (NumAlf)",
                    i + 1
                )));
            };
            let mut points = Vec::new();
            for _ in 0..count {
                let row = lines.next().map(|(i, line)| (i, numbers(line)));
                let Some((_, Some(row))) = row
                    .as_ref()
                    .filter(|(_, row)| row.as_ref().is_some_and(|row| row.len() >= 3))
                else {
                    let place =
                        row.map_or("the end".to_owned(), |(i, _)| format!("line {}", i + 1));
                    return Err(Failure(format!(
                        "{file}, {place}: {count} rows of angle, lift and drag are expected by NumAlf, of which {} are found; correct NumAlf or the row",
                        points.len()
                    )));
                };
                points.push(Point {
                    alpha: row[0],
                    lift: row[1],
                    drag: row[2],
                });
            }
            tables.tables.push(Table {
                reynolds,
                mach: None,
                points,
            });
            reynolds = None;
        }
    }
    Ok(tables)
}

/// Reads a file of AeroDyn 13 or 14: lines that begin with numbers and say what they are, then rows
/// of an angle and lift, drag and moment of each table; or the tables one after the other, each
/// with such lines.
pub fn read(text: &str, file: &str) -> Result<Tables, Failure> {
    let mut tables = Tables {
        angles: Some(Angles::Deg),
        ..Tables::default()
    };
    // The titles may be anything.
    let begin = text.lines().position(|line| {
        line.to_lowercase()
            .contains("number of airfoil tables in this file")
    });
    let mut reynolds: Vec<f64> = Vec::new();
    let mut is_open = false;
    for line in text.lines().skip(begin.unwrap_or(0) + 1) {
        if line.trim().is_empty() {
            continue;
        }
        let Some(row) = numbers(line).filter(|row| row.len() >= 3) else {
            is_open = false;
            if line.to_lowercase().contains("reynolds") {
                let words = line.split_whitespace().map_while(number);
                reynolds = words
                    .map(|millions| 1e6 * millions)
                    .filter(|re| *re > 0.0)
                    .collect();
            }
            continue;
        };
        let count = reynolds.len().max(1);
        if !is_open {
            is_open = true;
            for i in 0..count {
                tables.tables.push(Table {
                    reynolds: reynolds.get(i).copied(),
                    ..Table::default()
                });
            }
        }
        let width = (row.len() - 1) / count;
        let open = tables.tables.len() - count;
        for (i, table) in tables.tables[open..].iter_mut().enumerate() {
            let at = 1 + width * i;
            let (Some(lift), Some(drag)) = (row.get(at), row.get(at + 1)) else {
                return Err(Failure(format!(
                    "{file}: the row at {} deg has {} numbers, too few for {count} Reynolds numbers",
                    row[0],
                    row.len()
                )));
            };
            table.points.push(Point {
                alpha: row[0],
                lift: *lift,
                drag: *drag,
            });
        }
    }
    Ok(tables)
}
