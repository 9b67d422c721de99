//! The C81 airfoil format: lift, drag and moment over angle of attack and Mach number, in fixed
//! columns of seven characters (as documented for the Bell C81 program, AGAJ77, and its users).
//!
//! ```text
//! name (30 characters)  ML NL MD ND MM NM     two digits each: Mach numbers and angles of the
//!                                             lift, drag and moment tables
//!        M1     M2     ...                    7X,9F7.0, continued on further lines
//! alpha  c(M1)  c(M2)  ...                    10F7.0, continued as 7X,9F7.0
//! ```
//!
//! Angles run from -180 to 180 deg; the values at the two ends need not agree, as they do not in many
//! a published table. The moment table is not used and need not be complete.

use super::{Airfoil, AirfoilError, Axis, Curve, Data, Table};

const WIDTH: usize = 7;
const VALUES_PER_LINE: usize = 9;

struct Reader<'a> {
    lines: Vec<&'a str>,
    /// Index of the next line.
    next: usize,
    file: &'a str,
}

/// Reads the text of a C81 file; `file` is its name for errors.
pub fn parse(text: &str, file: &str) -> Result<Airfoil, AirfoilError> {
    let mut reader = Reader {
        lines: text.lines().collect(),
        next: 0,
        file,
    };
    let header = reader.line("the header")?;
    let name: String = header.chars().take(30).collect();
    let count = |index: usize| {
        let column = 30 + 2 * index;
        let field: String = header.chars().skip(column).take(2).collect();
        field.trim().parse::<usize>().ok().filter(|n| *n > 0).ok_or_else(|| {
            reader.field_error(
                1,
                column + 1,
                format!("`{}` is no count; columns 31-42 hold ML, NL, MD, ND, MM and NM in two digits each", field.trim()),
            )
        })
    };
    let (lift_machs, lift_angles) = (count(0)?, count(1)?);
    let (drag_machs, drag_angles) = (count(2)?, count(3)?);
    let lift = reader.table("lift", lift_machs, lift_angles)?;
    let drag = reader.table("drag", drag_machs, drag_angles)?;
    Ok(Airfoil {
        name: name.trim().to_owned(),
        data: Data::Tables { lift, drag },
    })
}

impl<'a> Reader<'a> {
    fn line(&mut self, wanted: &str) -> Result<&'a str, AirfoilError> {
        let line = self
            .lines
            .get(self.next)
            .ok_or_else(|| AirfoilError::Malformed {
                file: self.file.to_owned(),
                line: self.lines.len().max(1),
                problem: format!("the file ends before {wanted}"),
            })?;
        self.next += 1;
        Ok(line)
    }

    fn field_error(&self, line: usize, column: usize, problem: String) -> AirfoilError {
        AirfoilError::MalformedField {
            file: self.file.to_owned(),
            line,
            column,
            problem,
        }
    }

    /// The number in the field that begins at character `column` (from 0) of the current line.
    fn number(&self, line: &str, column: usize, what: &str) -> Result<f64, AirfoilError> {
        let field: String = line.chars().skip(column).take(WIDTH).collect();
        let value = field.trim().parse::<f64>().ok().filter(|v| v.is_finite());
        value.ok_or_else(|| {
            self.field_error(
                self.next,
                column + 1,
                format!(
                    "{what} is expected in these seven columns, not `{}`",
                    field.trim()
                ),
            )
        })
    }

    /// `count` values, nine a line from column 8 on, none below `lowest`.
    fn values(
        &mut self,
        mut line: &'a str,
        count: usize,
        what: &str,
        lowest: f64,
    ) -> Result<Vec<f64>, AirfoilError> {
        let mut values = Vec::with_capacity(count);
        for i in 0..count {
            let place = i % VALUES_PER_LINE;
            if i > 0 && place == 0 {
                line = self.line(what)?;
            }
            let column = WIDTH * (place + 1);
            let value = self.number(line, column, what)?;
            if value < lowest {
                let problem = format!("{value}: {what} must not be below {lowest}");
                return Err(self.field_error(self.next, column + 1, problem));
            }
            values.push(value);
        }
        Ok(values)
    }

    fn table(&mut self, name: &str, machs: usize, angles: usize) -> Result<Table, AirfoilError> {
        let what = format!("a Mach number of the {name} table");
        let line = self.line(&what)?;
        let numbers = self.values(line, machs, &what, 0.0)?;
        if numbers.windows(2).any(|pair| pair[1] <= pair[0]) {
            return Err(self.field_error(
                self.next,
                WIDTH + 1,
                format!("the Mach numbers of the {name} table must increase"),
            ));
        }
        let mut columns = vec![Vec::with_capacity(angles); machs];
        let mut previous = f64::NEG_INFINITY;
        for row in 0..angles {
            let what = format!("a value of the {name} table");
            let line = self.line(&what)?;
            let alpha = self.number(line, 0, &format!("an angle of the {name} table"))?;
            let ends_wrong = (row == 0 && alpha != -180.0) || (row + 1 == angles && alpha != 180.0);
            if alpha <= previous || ends_wrong {
                return Err(self.field_error(
                    self.next,
                    1,
                    format!("angle {alpha}: the angles of the {name} table must increase from -180 to 180 deg"),
                ));
            }
            previous = alpha;
            let lowest = if name == "drag" {
                0.0
            } else {
                f64::NEG_INFINITY
            };
            let values = self.values(line, machs, &what, lowest)?;
            for (column, value) in columns.iter_mut().zip(values) {
                column.push((alpha, value));
            }
        }
        let curves = columns.iter().map(|points| Curve::from_degrees(points));
        Ok(Table::new(
            Axis::Mach,
            numbers.into_iter().zip(curves).collect(),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotor::airfoil::{Lift, SectionModel, Similarity};
    use crate::rotor::compressibility::Compressibility;

    const GOOD: &str = "\
Test section                   2 4 1 3 1 2
          0.00   0.80
-180.00   0.00   0.00
   0.00   0.10   0.20
  10.00   1.10   1.60
 180.00   0.00   0.00
          0.00
-180.00   0.03
   0.00   0.01
 180.00   0.03
";

    fn lift(airfoil: &Airfoil, mach: f64) -> f64 {
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::PrandtlGlauert,
            drag_reynolds_exponent: 0.2,
        };
        airfoil.lift_coefficient(
            &model,
            0.0,
            0.0,
            Similarity {
                reynolds: 1e6,
                mach,
            },
        )
    }

    #[test]
    fn a_good_file_is_read_and_its_mach_numbers_take_the_place_of_a_rule() {
        let airfoil = parse(GOOD, "test.c81").unwrap();
        assert_eq!(airfoil.name(), "Test section");
        assert_eq!(lift(&airfoil, 0.0), 0.1);
        assert!((lift(&airfoil, 0.4) - 0.15).abs() < 1e-15);
        assert_eq!(lift(&airfoil, 0.95), 0.2);
    }

    #[test]
    fn long_rows_continue_on_the_next_line() {
        let row = |alpha: &str, count: usize| {
            let mut text = format!("{alpha:>7}");
            for i in 0..count {
                if i == 9 {
                    text += "\n       ";
                }
                text += &format!("{:7.2}", 0.05 * i as f64);
            }
            text + "\n"
        };
        let mut text = "long                          11 2 1 2 1 2\n".to_owned();
        for alpha in ["", "-180", "180"] {
            text += &row(alpha, 11);
        }
        for alpha in ["", "-180", "180"] {
            text += &row(alpha, 1);
        }
        let airfoil = parse(&text, "long.c81").unwrap();
        assert!((lift(&airfoil, 0.5) - 0.5).abs() < 1e-15);
    }

    #[test]
    fn errors_name_file_line_column_and_problem() {
        for (from, to, place, part) in [
            (" 2 4 1 3", " x 4 1 3", "line 1, column 31", "no count"),
            (
                "   0.80",
                "   o.80",
                "line 2, column 15",
                "a Mach number of the lift table",
            ),
            ("   0.80", "   0.00", "line 2, column 8", "must increase"),
            (
                "   0.00   0.10",
                "   0.00   .1.0",
                "line 4, column 8",
                "a value of the lift table",
            ),
            (
                "-180.00   0.00",
                "-170.00   0.00",
                "line 3, column 1",
                "from -180 to 180",
            ),
            (
                "   0.00   0.01",
                "   0.00  -0.01",
                "line 9, column 8",
                "must not be below 0",
            ),
            (" 180.00   0.03\n", "", "line 9", "the file ends before"),
        ] {
            let text = GOOD.replacen(from, to, 1);
            let error = parse(&text, "bad.c81").unwrap_err().to_string();
            assert!(
                error.contains(place) && error.contains(part),
                "{to:?}: {error}"
            );
        }
    }
}
