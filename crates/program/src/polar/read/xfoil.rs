//! Polars of XFOIL, XFLR5 and airfoiltools.com: lines that say for what they are, and columns with
//! names.

use super::{
    Table, Tables,
    columns::{header, left_out},
    line::value,
};
use crate::{Failure, polar::Angles};

/// Reads a polar.
pub fn read(text: &str, file: &str) -> Result<Tables, Failure> {
    let Some((first, header)) = header(text) else {
        return Err(Failure(format!(
            "{file}: the line with the names alpha, CL and CD is missing above the rows"
        )));
    };
    let mut table = Table::default();
    let mut tables = Tables {
        angles: Some(Angles::Deg),
        ..Tables::default()
    };
    for line in text.lines().take(first - 1) {
        let lower = line.to_ascii_lowercase();
        if lower.contains("reynolds number") && line.contains('~') {
            return Err(Failure(format!(
                "{file}: its Reynolds number changes with the lift ({}); compute polars at fixed Reynolds numbers (type 1)",
                line.trim()
            )));
        }
        let after = |key: &str| Some(line[lower.find(key)? + key.len()..].trim());
        tables.name = tables.name.or_else(|| {
            let name = after("calculated polar for:").or_else(|| after("airfoil,"))?;
            Some(name.to_owned())
        });
        table.reynolds = table
            .reynolds
            .or_else(|| value(line, "re ="))
            .or_else(|| value(line, "reynolds number,"));
        table.mach = table
            .mach
            .or_else(|| value(line, "mach ="))
            .or_else(|| value(line, "mach,"));
    }
    let rows = header.rows(text.lines().skip(first));
    if rows.without_numbers > 0 {
        tables.notes.push(left_out(rows.without_numbers));
    }
    table.points = rows.rows.into_iter().map(|(_, _, point)| point).collect();
    tables.tables.push(table);
    Ok(tables)
}
