//! Tables in columns: named by a header line, else angle, lift and drag in this order.

use super::{
    Table, Tables,
    line::{fields, number, numbers, value},
};
use crate::{
    Failure,
    polar::{Angles, Point},
};

/// The columns by their names.
#[derive(Debug, PartialEq)]
pub struct Header {
    alpha: usize,
    lift: usize,
    drag: usize,
    reynolds: Option<usize>,
    mach: Option<usize>,
    /// The unit of the angles, if their name has it.
    pub angles: Option<Angles>,
}

/// The rows below a header.
#[derive(Debug, Default)]
pub struct Rows {
    /// Reynolds number, Mach number and point of each.
    pub rows: Vec<(Option<f64>, Option<f64>, Point)>,
    /// Rows with an angle whose lift or drag is no number.
    pub without_numbers: usize,
}

/// Reads a table in columns.
pub fn read(text: &str, file: &str) -> Result<Tables, Failure> {
    let found = header(text);
    let has_header = found.is_some();
    let (first, header) = found.unwrap_or((0, without_names()));
    if !has_header && let Some(line) = text.lines().find(|line| has_names(line)) {
        return Err(Failure(format!(
            "{file}: of the columns {:?} one must be the angle of attack (alpha or aoa), one the lift (cl) and one the drag (cd)",
            line.trim()
        )));
    }
    let rows = header.rows(text.lines().skip(first));
    let above = || text.lines().take_while(|line| numbers(line).is_none());
    let reynolds_above =
        above().find_map(|line| value(line, "re =").or_else(|| value(line, "re=")));
    let mut tables = Tables {
        angles: header.angles,
        ..Tables::default()
    };
    if rows.without_numbers > 0 {
        tables.notes.push(left_out(rows.without_numbers));
    }
    if !has_header {
        let note = "the columns have no names; they are taken for angle, lift and drag";
        tables.notes.push(note.into());
    }
    for (reynolds, mach, point) in rows.rows {
        let reynolds = reynolds.or(reynolds_above);
        let same = |table: &&mut Table| (table.reynolds, table.mach) == (reynolds, mach);
        match tables.tables.iter_mut().find(same) {
            Some(table) => table.points.push(point),
            None => tables.tables.push(Table {
                reynolds,
                mach,
                points: vec![point],
            }),
        }
    }
    Ok(tables)
}

/// The note on rows that a program could not compute.
pub fn left_out(count: usize) -> String {
    format!("rows whose lift or drag is no number, left out: {count}")
}

fn without_names() -> Header {
    Header {
        alpha: 0,
        lift: 1,
        drag: 2,
        reynolds: None,
        mach: None,
        angles: None,
    }
}

/// Whether a line has three or more names and no number.
fn has_names(line: &str) -> bool {
    let fields = fields(line.trim_start_matches(['#', '!', '%', ' ']));
    let is_separated = line.contains([',', ';', '\t']);
    is_separated && fields.len() >= 3 && fields.iter().all(|field| is_name(field))
}

/// Whether a field may be a column's name. Prose is longer.
fn is_name(field: &str) -> bool {
    field.starts_with(|c: char| c.is_alphabetic()) && field.len() <= 30
}

/// The columns by the first header line, and the index of the line below it.
pub fn header(text: &str) -> Option<(usize, Header)> {
    let mut lines = text.lines().enumerate();
    lines.find_map(|(i, line)| Some((i + 1, columns(line)?)))
}

/// The columns of a header line.
fn columns(line: &str) -> Option<Header> {
    let fields = fields(line.trim_start_matches(['#', '!', '%', ' ']));
    let names: Vec<String> = fields.iter().map(|field| name(field)).collect();
    let find = |is: fn(&str) -> bool| names.iter().position(|name| is(name));
    let alpha = find(is_angle)?;
    let unit = fields[alpha].to_lowercase();
    let angles = if unit.contains("rad") {
        Some(Angles::Rad)
    } else {
        unit.contains("deg").then_some(Angles::Deg)
    };
    Some(Header {
        alpha,
        lift: find(|name| matches!(name, "cl" | "clift" | "lift" | "liftcoefficient" | "ca"))?,
        drag: find(|name| matches!(name, "cd" | "cdrag" | "drag" | "dragcoefficient" | "cw"))?,
        reynolds: find(|name| matches!(name, "re" | "reynolds" | "reynoldsnumber")),
        mach: find(|name| matches!(name, "ma" | "mach" | "machnumber")),
        angles,
    })
}

/// The letters of a column's name, without its unit.
fn name(field: &str) -> String {
    let bare = field.split(['(', '[', '/']).next().unwrap_or("");
    let letters = bare.chars().filter(|c| c.is_alphabetic());
    letters.flat_map(char::to_lowercase).collect()
}

fn is_angle(name: &str) -> bool {
    matches!(name, "α" | "angle" | "angleofattack")
        || ["alpha", "alfa", "aoa", "angleofattack"]
            .iter()
            .any(|begin| name.starts_with(begin))
}

impl Header {
    /// The rows of the lines below.
    pub fn rows<'a>(&self, lines: impl Iterator<Item = &'a str>) -> Rows {
        let mut found = Rows::default();
        for line in lines {
            let line = line.split(['#', '!']).next().unwrap_or("");
            let fields = fields(line);
            let at = |index: usize| fields.get(index).and_then(|field| number(field));
            let Some(alpha) = at(self.alpha) else {
                continue;
            };
            let (Some(lift), Some(drag)) = (at(self.lift), at(self.drag)) else {
                found.without_numbers += 1;
                continue;
            };
            let reynolds = self.reynolds.and_then(at);
            let mach = self.mach.and_then(at);
            found
                .rows
                .push((reynolds, mach, Point { alpha, lift, drag }));
        }
        found
    }
}
