//! Lines of numbers, between any separators.

use super::{Angles, Tables};
use core::f64::consts::PI;

/// Lift slope per unit of angle above which the unit is rad: thin sections have 2 pi per rad, which
/// is 0.11 per deg.
const LEAST_SLOPE: f64 = 0.8;

/// The fields of a line: between semicolons, else commas, else tabs, else blanks. Quotes around
/// them are taken off.
pub fn fields(line: &str) -> Vec<&str> {
    let line = line.trim();
    let separator = [';', ',', '\t'].into_iter().find(|c| line.contains(*c));
    let fields: Vec<&str> = match separator {
        Some(separator) => line.split(separator).collect(),
        None => line.split_whitespace().collect(),
    };
    let bare = fields
        .into_iter()
        .map(|field| field.trim().trim_matches('"').trim());
    bare.collect()
}

/// The finite number in a field. A D may begin its exponent, and a comma its decimals: where commas
/// separate, no field has one.
pub fn number(field: &str) -> Option<f64> {
    let plain = |text: &str| text.parse::<f64>().ok().filter(|value| value.is_finite());
    let field = field.trim();
    plain(field).or_else(|| {
        let is_numeric = field
            .bytes()
            .all(|b| b.is_ascii_digit() || b"+-.,eEdD".contains(&b));
        let other = field.replace(['d', 'D'], "e").replacen(',', ".", 1);
        plain(&other).filter(|_| is_numeric)
    })
}

/// The numbers of a line between blanks, tabs, commas or semicolons; none if it has other words.
pub fn numbers(line: &str) -> Option<Vec<f64>> {
    let words = line.split(|c: char| c.is_whitespace() || c == ',' || c == ';');
    let words = words.filter(|word| !word.is_empty());
    let numbers: Option<Vec<f64>> = words.map(number).collect();
    numbers.filter(|numbers| !numbers.is_empty())
}

/// The number behind a key in small letters. XFOIL writes `0.500 e 6`.
pub fn value(line: &str, key: &str) -> Option<f64> {
    // Letters keep their places, as the key has no others.
    let begin = line.to_ascii_lowercase().find(key)? + key.len();
    let mut words = line[begin..].split_whitespace();
    let number: f64 = words.next()?.parse().ok()?;
    let mut rest = words.take(2).collect::<String>().to_ascii_lowercase();
    rest.retain(|c| !c.is_whitespace());
    let exponent = rest.strip_prefix('e').map(|digits| {
        let end = digits.find(|c: char| !c.is_ascii_digit() && c != '+' && c != '-');
        digits[..end.unwrap_or(digits.len())].parse::<i32>()
    });
    match exponent {
        Some(Ok(exponent)) => format!("{number}e{exponent}").parse().ok(),
        _ => Some(number),
    }
}

/// Whether the angles of a file are in rad: as the user or the file says, else where the lift rises
/// too steeply for deg.
pub fn are_radians(tables: &Tables, given: Option<Angles>) -> bool {
    if let Some(unit) = given.or(tables.angles) {
        return unit == Angles::Rad;
    }
    let points = || tables.tables.iter().flat_map(|table| &table.points);
    if points().any(|p| p.alpha.abs() > PI + 1e-3) {
        return false;
    }
    let near: Vec<_> = points().filter(|p| p.alpha.abs() < 0.2).collect();
    let lowest = near.iter().min_by(|a, b| a.alpha.total_cmp(&b.alpha));
    let highest = near.iter().max_by(|a, b| a.alpha.total_cmp(&b.alpha));
    let slope = lowest
        .zip(highest)
        .map(|(a, b)| (b.lift - a.lift) / (b.alpha - a.alpha));
    slope.is_some_and(|slope| slope > LEAST_SLOPE)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_and_numbers_are_read_as_people_write_them() {
        for (line, expected) in [
            ("  -1.0   0.1  0.01", vec!["-1.0", "0.1", "0.01"]),
            ("-1.0, 0.1,0.01", vec!["-1.0", "0.1", "0.01"]),
            ("-1,0;0,1;0,01", vec!["-1,0", "0,1", "0,01"]),
            (
                "angle of attack\tcl\tcd",
                vec!["angle of attack", "cl", "cd"],
            ),
            ("\"alpha\",\"cl\"", vec!["alpha", "cl"]),
            ("1,,3", vec!["1", "", "3"]),
        ] {
            assert_eq!(fields(line), expected, "{line}");
        }
        for (field, expected) in [
            ("1", Some(1.0)),
            ("-.5", Some(-0.5)),
            ("1.5D-2", Some(0.015)),
            ("0,25", Some(0.25)),
            ("NaN", None),
            ("inf", None),
            ("*****", None),
            ("", None),
            ("1,2,3", None),
            ("e", None),
        ] {
            assert_eq!(number(field), expected, "{field}");
        }
    }

    #[test]
    fn numbers_are_read_with_the_blanks_that_xfoil_puts_into_them() {
        let line = " Mach =   0.150     Re =     0.500 e 6     Ncrit =   9.000";
        assert_eq!(value(line, "re ="), Some(5e5));
        assert_eq!(value(line, "mach ="), Some(0.15));
        assert_eq!(value("Re =     1.250 e 5", "re ="), Some(125_000.0));
        assert_eq!(value("Re = 3e5", "re ="), Some(3e5));
        assert_eq!(value("Re = ", "re ="), None);
    }
}
