//! A blade drawn with characters: planform, twist and sections along the radius.

use rotor::geometry::Geometry;

/// Columns of a drawing, from the shaft to the tip.
const COLUMNS: usize = 72;
/// Largest number of rows of the planform.
const PLANFORM_ROWS: usize = 12;
/// Rows of the twist.
const TWIST_ROWS: usize = 7;
/// A character is about twice as high as wide.
const HEIGHT: f64 = 2.0;

/// The letter that stands for an airfoil in the drawing and in the table.
pub fn letter(airfoil: usize) -> char {
    let letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz";
    letters.chars().nth(airfoil).unwrap_or('*')
}

/// The drawing, line by line.
pub fn blade(geometry: &Geometry) -> Vec<String> {
    let mut lines = planform(geometry);
    lines.push(String::new());
    lines.extend(twist(geometry));
    lines.push(sections(geometry));
    lines.push(axis());
    lines
}

/// The radius r/R of a column's middle.
fn radius(column: usize) -> f64 {
    (column as f64 + 0.5) / COLUMNS as f64
}

/// The chord about the quarter-chord line, in the proportions of the blade unless that takes too
/// many rows.
fn planform(geometry: &Geometry) -> Vec<String> {
    let per_row = geometry.radius / COLUMNS as f64 * HEIGHT;
    let largest = geometry.largest_chord();
    let wanted = (largest / per_row).ceil().max(1.0);
    let rows = wanted.min(PLANFORM_ROWS as f64).max(3.0);
    let per_row = if wanted < 3.0 || wanted > rows {
        largest / rows
    } else {
        per_row
    };
    let scale = if per_row == geometry.radius / COLUMNS as f64 * HEIGHT {
        "in proportion".to_owned()
    } else {
        format!(
            "chord {:.1} times too large",
            geometry.radius / COLUMNS as f64 * HEIGHT / per_row
        )
    };
    let mut lines = vec![format!("Planform, leading edge above, {scale}:")];
    for row in 0..rows as usize {
        // Distance of the row's middle behind the leading edge of the largest chord, whose quarter
        // chord is that of all sections.
        let behind = (row as f64 + 0.5) * per_row;
        let line = (0..COLUMNS).map(|column| {
            let r = radius(column);
            if r < geometry.cutout() {
                let is_axis = (behind - 0.25 * largest).abs() <= 0.5 * per_row;
                return if is_axis { '-' } else { ' ' };
            }
            let chord = geometry.chord(r);
            let leading = 0.25 * (largest - chord);
            if (leading..=leading + chord).contains(&behind) {
                '#'
            } else {
                ' '
            }
        });
        lines.push(format!("         |{}", trimmed(line)));
    }
    lines
}

/// The pitch of the sections at a collective of 0.
fn twist(geometry: &Geometry) -> Vec<String> {
    let columns = (0..COLUMNS).map(radius);
    let pitch: Vec<Option<f64>> = columns
        .map(|r| (r >= geometry.cutout()).then(|| geometry.twist(r).to_degrees()))
        .collect();
    let known = || pitch.iter().flatten().copied();
    let (low, high) = (
        known().fold(f64::INFINITY, f64::min),
        known().fold(f64::NEG_INFINITY, f64::max),
    );
    let mut lines = vec!["Pitch at a collective of 0, deg:".to_owned()];
    if high - low < 1e-9 {
        lines.push(format!("{low:>8.2} |{}", trimmed(pitch.iter().map(mark))));
        return lines;
    }
    let step = (high - low) / (TWIST_ROWS - 1) as f64;
    for row in 0..TWIST_ROWS {
        let value = high - step * row as f64;
        let line = pitch.iter().map(|pitch| {
            let is_here = pitch.is_some_and(|p| ((high - p) / step).round() as usize == row);
            if is_here { 'o' } else { ' ' }
        });
        lines.push(format!("{value:>8.2} |{}", trimmed(line)));
    }
    lines
}

fn mark(pitch: &Option<f64>) -> char {
    if pitch.is_some() { 'o' } else { ' ' }
}

/// The letter of the section that has the larger share at each radius.
fn sections(geometry: &Geometry) -> String {
    let line = (0..COLUMNS).map(|column| {
        let r = radius(column);
        if r < geometry.cutout() {
            return ' ';
        }
        let outer = geometry.stations.partition_point(|s| s.radius_ratio <= r);
        let outer = outer.clamp(1, geometry.stations.len() - 1);
        let (a, b) = (&geometry.stations[outer - 1], &geometry.stations[outer]);
        let is_outer = r - a.radius_ratio > b.radius_ratio - r;
        letter(if is_outer { b.airfoil } else { a.airfoil })
    });
    format!("airfoil  |{}", trimmed(line))
}

/// The radii r/R below.
fn axis() -> String {
    let mut line = vec![' '; COLUMNS + 10];
    for tenth in (0..=10).step_by(2) {
        let at = 10 + tenth * COLUMNS / 10 - usize::from(tenth == 10);
        let text: Vec<char> = format!("{:.1}", tenth as f64 / 10.0).chars().collect();
        let at = at.saturating_sub(1);
        for (i, c) in text.into_iter().enumerate() {
            if let Some(slot) = line.get_mut(at + i) {
                *slot = c;
            } else {
                line.push(c);
            }
        }
    }
    line[..3].copy_from_slice(&['r', '/', 'R']);
    trimmed(line.into_iter())
}

fn trimmed(line: impl Iterator<Item = char>) -> String {
    line.collect::<String>().trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_planform_shows_cutout_and_taper_and_the_twist_falls() {
        let geometry = Geometry::linear(2, 1.0, 0.5, 0.2, 0.25, -0.2);
        let lines = blade(&geometry);
        let rows: Vec<&String> = lines.iter().filter(|line| line.contains('#')).collect();
        assert!(rows.len() >= 3, "{lines:#?}");
        let column = |line: &str, at: f64| {
            let at = 10 + (at * COLUMNS as f64) as usize;
            line.chars().nth(at).unwrap_or(' ')
        };
        let high = |at: f64| rows.iter().filter(|line| column(line, at) == '#').count();
        assert_eq!(high(0.4), 0, "inboard of the cutout");
        assert!(
            high(0.52) == rows.len() && high(0.98) < rows.len(),
            "{lines:#?}"
        );
        let twist: Vec<&String> = lines
            .iter()
            .filter(|line| line.contains('o') && line.contains('|') && !line.contains("airfoil"))
            .collect();
        assert_eq!(twist.len(), TWIST_ROWS, "{lines:#?}");
        assert!(twist[0].find('o') < twist[TWIST_ROWS - 1].find('o'));
        let airfoil = lines
            .iter()
            .find(|line| line.starts_with("airfoil"))
            .unwrap();
        assert_eq!(airfoil.matches('A').count(), COLUMNS / 2);
        assert!(lines.last().unwrap().starts_with("r/R"), "{lines:#?}");
    }
}
