//! Reads the section data of other programs.
//!
//! `rotor::airfoil::Foreign` recognises a file; each form has its module here.

mod aerodyn;
mod ccblade;
mod columns;
mod line;
mod qblade;
mod xfoil;

use super::{Angles, Point, Polar};
use crate::{Failure, files};
use rotor::airfoil::{Airfoil, Foreign, RawPolar};
use std::path::Path;

/// What a file holds.
#[derive(Debug)]
pub struct Content {
    /// What the file was taken for.
    pub kind: String,
    /// The file's name, without its folder.
    pub file: String,
    /// The section's name, if the file has one.
    pub name: Option<String>,
    pub polars: Vec<Polar>,
    /// What a user should know, with the file's name.
    pub notes: Vec<String>,
}

/// The tables of a file, before what all files have in common.
#[derive(Debug, Default)]
struct Tables {
    name: Option<String>,
    tables: Vec<Table>,
    notes: Vec<String>,
    /// The unit of the angles, if the form or the header says it.
    angles: Option<Angles>,
}

/// The table at one Reynolds and Mach number.
#[derive(Debug, Default)]
struct Table {
    reynolds: Option<f64>,
    mach: Option<f64>,
    points: Vec<Point>,
}

impl Content {
    /// What the file was taken for and what was found.
    pub fn summary(&self) -> String {
        let mut sentence = format!("{}: {}", self.file, self.kind);
        if let Some(name) = &self.name {
            sentence += &format!(" of {name}");
        }
        let numbers = |number: fn(&Polar) -> Option<f64>, word: &str| {
            let mut numbers: Vec<f64> = self.polars.iter().filter_map(number).collect();
            numbers.dedup();
            let plural = if numbers.len() > 1 { "s" } else { "" };
            let words: Vec<String> = numbers.iter().map(f64::to_string).collect();
            let words = words.join(", ");
            (!words.is_empty()).then(|| format!("; {word} number{plural} {words}"))
        };
        sentence += &numbers(|polar| polar.reynolds, "Reynolds").unwrap_or_default();
        sentence += &numbers(|polar| polar.mach, "Mach").unwrap_or_default();
        let counts = || self.polars.iter().map(|polar| polar.points.len());
        let (least, most) = (counts().min().unwrap_or(0), counts().max().unwrap_or(0));
        let count = if least == most {
            most.to_string()
        } else {
            format!("{least} to {most}")
        };
        let points = self.polars.iter().flat_map(|polar| &polar.points);
        let (low, high) = points.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), point| {
            (low.min(point.alpha), high.max(point.alpha))
        });
        sentence + &format!("; {count} angles from {low} to {high} deg")
    }
}

/// Reads a file in any of the forms.
pub fn file(path: &Path, angles: Option<Angles>) -> Result<Content, Failure> {
    let bytes = files::read(path)?;
    // Old files have the degree sign or names in another encoding; numbers are the same in all.
    let text = String::from_utf8_lossy(&bytes);
    content(path, text.trim_start_matches('\u{feff}'), angles)
}

/// The content of a file with this text.
fn content(path: &Path, text: &str, angles: Option<Angles>) -> Result<Content, Failure> {
    let file = files::name(path);
    let shown = path.display().to_string();
    let own = text
        .lines()
        .map(|line| line.split('#').next().unwrap_or("").trim());
    let first = own.into_iter().find(|line| !line.is_empty()).unwrap_or("");
    let first = first.split_whitespace().next().unwrap_or("");
    let is_polar = first.eq_ignore_ascii_case("polar");
    let is_c81 = path
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("c81"));
    let recognised = match Foreign::recognised(text) {
        // Rows of C81 would pass for columns of angle, lift and drag.
        None | Some(Foreign::Columns) if is_c81 => Some(Foreign::C81),
        // The numbers may be between quotes.
        None if columns::header(text).is_some() => Some(Foreign::Columns),
        other => other,
    };
    let (kind, tables) = match recognised {
        _ if is_polar => (
            "a .polar file".to_owned(),
            raw(Airfoil::raw_polars(text, &shown))?,
        ),
        Some(kind) => (kind.to_string(), tables(kind, text, &shown)?),
        None => {
            return Err(Failure(format!(
                "{shown}: no table of angle, lift and drag is found in it; the forms are polars of XFOIL, XFLR5, QBlade and airfoiltools.com, airfoil files of AeroDyn and OpenFAST, tables of CCBlade.jl, C81, .polar, and columns of angle, lift and drag"
            )));
        }
    };
    let mut notes: Vec<String> = tables
        .notes
        .iter()
        .map(|note| format!("{file}: {note}"))
        .collect();
    let mut polars = Vec::new();
    let is_rad = line::are_radians(&tables, angles);
    if is_rad && tables.angles.is_none() && angles.is_none() {
        notes.push(format!(
            "{file}: the angles are taken for rad, by the slope of the lift; add --angles deg if they are deg"
        ));
    }
    let is_one = tables
        .tables
        .iter()
        .filter(|t| !t.points.is_empty())
        .count()
        == 1;
    for mut table in tables.tables {
        if table.points.is_empty() {
            continue;
        }
        let source = match (table.reynolds, table.mach) {
            (Some(reynolds), Some(mach)) if !is_one => {
                format!("{file} at Reynolds number {reynolds} and Mach number {mach}")
            }
            (Some(reynolds), None) if !is_one => format!("{file} at Reynolds number {reynolds}"),
            (None, Some(mach)) if !is_one => format!("{file} at Mach number {mach}"),
            _ => file.clone(),
        };
        for point in table.points.iter_mut().filter(|_| is_rad) {
            point.alpha = point.alpha.to_degrees();
        }
        polars.push(Polar {
            source,
            reynolds: table.reynolds,
            mach: table.mach,
            points: table.points,
        });
    }
    if polars.is_empty() {
        return Err(Failure(format!(
            "{shown}: it looks like {kind}, but has no rows with an angle, lift and drag"
        )));
    }
    let name = tables
        .name
        .map(|name| shortened(&name))
        .filter(|name| !name.is_empty());
    Ok(Content {
        kind,
        name,
        file,
        polars,
        notes,
    })
}

/// A name with at most so many characters that it fits into a line; some files describe a section
/// where others name it.
fn shortened(name: &str) -> String {
    const MOST: usize = 60;
    let name = name.split_whitespace().collect::<Vec<_>>().join(" ");
    match name.char_indices().nth(MOST) {
        Some((end, _)) => format!("{}…", &name[..end]),
        None => name,
    }
}

/// The tables of a file of this kind.
fn tables(kind: Foreign, text: &str, file: &str) -> Result<Tables, Failure> {
    match kind {
        Foreign::C81 => raw(Airfoil::raw_c81(text, file)),
        Foreign::Xfoil | Foreign::Xflr5 | Foreign::AirfoilTools => xfoil::read(text, file),
        Foreign::AirfoilInfo => aerodyn::read_info(text, file),
        Foreign::AeroDyn => aerodyn::read(text, file),
        Foreign::QBlade => qblade::read(text, file),
        Foreign::CcBlade => Ok(ccblade::read(text)),
        Foreign::Columns => columns::read(text, file),
        Foreign::Coordinates => Err(Failure(format!(
            "{file}: it looks like {kind}; compute polars of the section, for example with XFOIL, and give these"
        ))),
    }
}

/// The polars of a file that the library reads.
fn raw(
    read: Result<(String, Vec<RawPolar>), rotor::airfoil::AirfoilError>,
) -> Result<Tables, Failure> {
    let (name, polars) = read.map_err(|error| Failure(error.to_string()))?;
    let tables = polars.into_iter().map(|polar| Table {
        reynolds: polar.reynolds,
        mach: polar.mach,
        points: points(&polar.lift, &polar.drag),
    });
    Ok(Tables {
        name: Some(name),
        tables: tables.collect(),
        angles: Some(Angles::Deg),
        ..Tables::default()
    })
}

/// Lift and drag at the angles of either, where both have data.
fn points(lift: &[(f64, f64)], drag: &[(f64, f64)]) -> Vec<Point> {
    let mut alphas: Vec<f64> = lift.iter().chain(drag).map(|p| p.0).collect();
    alphas.sort_by(f64::total_cmp);
    alphas.dedup();
    let at = |alpha: f64| {
        Some(Point {
            alpha,
            lift: value(lift, alpha)?,
            drag: value(drag, alpha)?,
        })
    };
    alphas.into_iter().filter_map(at).collect()
}

/// A coefficient at an angle, linear between points; none outside them.
fn value(points: &[(f64, f64)], alpha: f64) -> Option<f64> {
    if let Some(point) = points.iter().find(|p| p.0 == alpha) {
        return Some(point.1);
    }
    let pair = points
        .windows(2)
        .find(|pair| pair[0].0 < alpha && alpha < pair[1].0)?;
    let [(a, low), (b, high)] = [pair[0], pair[1]];
    Some(low + (alpha - a) / (b - a) * (high - low))
}
