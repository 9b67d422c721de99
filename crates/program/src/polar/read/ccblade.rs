//! Tables of CCBlade.jl: a line of text, Reynolds number, Mach number, then rows of angle in rad,
//! lift and drag (`AlphaAF`).

use super::{Table, Tables, line::numbers};
use crate::polar::{Angles, Point};
use core::f64::consts::PI;

/// Reads a table.
pub fn read(text: &str) -> Tables {
    let mut lines = text.lines().filter(|line| !line.trim().is_empty());
    let name = lines.next().map(str::to_owned);
    let mut one = || numbers(lines.next()?)?.first().copied();
    let (reynolds, mach) = (one(), one());
    let rows = lines.filter_map(numbers).filter(|row| row.len() >= 3);
    let points: Vec<Point> = rows
        .map(|row| Point {
            alpha: row[0],
            lift: row[1],
            drag: row[2],
        })
        .collect();
    // Its reader takes rad unless it is told otherwise; larger angles can only be deg.
    let is_deg = points.iter().any(|p| p.alpha.abs() > PI + 1e-3);
    // Some write 0 and 0 for what they do not know.
    let reynolds = reynolds.filter(|re| *re > 0.0);
    let mach = mach.filter(|mach| *mach > 0.0 || reynolds.is_some());
    let table = Table {
        reynolds,
        mach,
        points,
    };
    Tables {
        name,
        tables: vec![table],
        angles: Some(if is_deg { Angles::Deg } else { Angles::Rad }),
        ..Tables::default()
    }
}
