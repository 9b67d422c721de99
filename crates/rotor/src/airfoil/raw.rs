//! The polars of a file as they stand there: for programs that complete or convert them. They may
//! end before +-180 deg, where an `Airfoil` may not.

use super::{
    Airfoil, AirfoilError, Axis, Coefficient, Layers, Similarity,
    c81::{self, Numbers, Set},
    polar,
    records::Problem,
};

/// Lift and drag at one Reynolds or Mach number, or at one of each.
#[derive(Debug, Clone, PartialEq)]
pub struct RawPolar {
    /// None if the file has none.
    pub reynolds: Option<f64>,
    /// None if the file has none.
    pub mach: Option<f64>,
    /// Angles of attack, deg, and lift coefficients, in the order of the file.
    pub lift: Vec<(f64, f64)>,
    /// Angles of attack, deg, and drag coefficients, in the order of the file.
    pub drag: Vec<(f64, f64)>,
}

impl Airfoil {
    /// The section's name and the polars of a `.polar` file's text; `file` is its name for errors.
    ///
    /// # Errors
    ///
    /// The first line that breaks the rules of the format. Angles may be any.
    pub fn raw_polars(text: &str, file: &str) -> Result<(String, Vec<RawPolar>), AirfoilError> {
        let (name, axis, blocks) =
            polar::blocks(text).map_err(|(line, problem)| AirfoilError::Malformed {
                file: file.to_owned(),
                line,
                problem,
            })?;
        let polars = blocks.into_iter().map(|block| {
            let (reynolds, mach) = match axis {
                Axis::Reynolds => (Some(block.number), None),
                Axis::Mach => (None, Some(block.number)),
            };
            RawPolar {
                reynolds,
                mach,
                lift: block.rows.iter().map(|row| (row.alpha, row.lift)).collect(),
                drag: block.rows.iter().map(|row| (row.alpha, row.drag)).collect(),
            }
        });
        Ok((name, polars.collect()))
    }

    /// The section's name and the polars of a C81 file's text; `file` is its name for errors.
    ///
    /// There is one polar for each Mach number of the lift or of the drag and, in files of DUST,
    /// for each Reynolds number. Where only one of lift and drag has a Mach number, the other is
    /// interpolated.
    ///
    /// # Errors
    ///
    /// The first field that breaks the rules of the format. Angles may be any that increase.
    pub fn raw_c81(text: &str, file: &str) -> Result<(String, Vec<RawPolar>), AirfoilError> {
        let sets = c81::sets(text, columns).map_err(|(line, column, problem)| {
            AirfoilError::MalformedField {
                file: file.to_owned(),
                line,
                column,
                problem,
            }
        })?;
        let name = sets.first().map_or("", |set| &set.name).to_owned();
        Ok((name, sets.iter().flat_map(polars).collect()))
    }
}

/// The numbers of a table, and the Mach numbers between which they are interpolated.
type Columns = (Layers, Numbers);

/// The columns of a table whose angles increase.
fn columns(coefficient: Coefficient, numbers: Numbers) -> Result<Columns, Problem> {
    let layers = c81::layers(coefficient, &numbers.machs)?;
    for pair in numbers.rows.windows(2) {
        let (before, angle) = (&pair[0][0], &pair[1][0]);
        if angle.value <= before.value {
            let problem = format!(
                "{} must be above the number before ({})",
                angle.value, before.value
            );
            return Err((angle.line, angle.column, problem));
        }
    }
    Ok((layers, numbers))
}

/// The polars of a set of tables, one for each Mach number.
fn polars(set: &Set<Columns>) -> Vec<RawPolar> {
    let both = [&set.lift, &set.drag].into_iter();
    let mut machs: Vec<f64> = both
        .flat_map(|(_, table)| table.machs.iter().map(|n| n.value))
        .collect();
    machs.sort_by(f64::total_cmp);
    machs.dedup();
    machs
        .into_iter()
        .map(|mach| RawPolar {
            reynolds: set.reynolds,
            mach: Some(mach),
            lift: at_mach(&set.lift, mach),
            drag: at_mach(&set.drag, mach),
        })
        .collect()
}

/// The column of a table at a Mach number, as `Layers` interpolates.
fn at_mach((layers, table): &Columns, mach: f64) -> Vec<(f64, f64)> {
    // C81 data do not depend on the Reynolds number.
    let flow = Similarity {
        reynolds: 0.0,
        mach,
    };
    let value =
        |row: &[super::records::Number]| layers.mixed(flow, |layer, _| row[layer + 1].value);
    let rows = table.rows.iter();
    rows.map(|row| (row[0].value, value(row))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_blocks_of_a_polar_file_are_given_as_they_stand_there() {
        let text =
            "polar 1\nname A\nreynolds 1e5\n-5 -0.5 0.02\n5 0.5 0.01\nreynolds 2e5\n0 0 0.01\n";
        let (name, polars) = Airfoil::raw_polars(text, "x").unwrap();
        assert_eq!((name.as_str(), polars.len()), ("A", 2));
        assert_eq!((polars[0].reynolds, polars[0].mach), (Some(1e5), None));
        assert_eq!(polars[0].lift, [(-5.0, -0.5), (5.0, 0.5)]);
        assert_eq!(polars[1].drag, [(0.0, 0.01)]);
    }

    #[test]
    fn lift_and_drag_of_a_c81_file_are_given_at_the_mach_numbers_of_either() {
        let text = "A 2 2 1 3\n0.2 0.6\n-9 -1 -2\n9 1 2\n0.4\n-9 0.03\n0 0.01\n9 0.03\n";
        let (name, polars) = Airfoil::raw_c81(text, "x").unwrap();
        assert_eq!(name, "A");
        let machs: Vec<_> = polars.iter().map(|p| p.mach.unwrap()).collect();
        assert_eq!(machs, [0.2, 0.4, 0.6]);
        assert_eq!(polars[0].lift, [(-9.0, -1.0), (9.0, 1.0)]);
        assert_eq!(polars[1].lift, [(-9.0, -1.5), (9.0, 1.5)]);
        assert_eq!(polars[2].lift, [(-9.0, -2.0), (9.0, 2.0)]);
        for polar in &polars {
            assert_eq!(polar.reynolds, None);
            assert_eq!(polar.drag, [(-9.0, 0.03), (0.0, 0.01), (9.0, 0.03)]);
        }
        let error = Airfoil::raw_c81(&text.replace("9 1 2", "-9 1 2"), "x").unwrap_err();
        assert!(
            error
                .to_string()
                .contains("-9 must be above the number before (-9)"),
            "{error}"
        );
    }
}
