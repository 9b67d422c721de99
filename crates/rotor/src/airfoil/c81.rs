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
//! Angles run from -180 to 180 deg. The values at the two ends may differ, as they do in many
//! published tables. The moment table is not used; it may be incomplete or missing.
//!
//! Files that people have edited: a line that does not keep to the columns is read as free numbers
//! (see `records`). The counts may follow the name anywhere in the first line; without a moment
//! table four counts will do in place of six. Blank lines do not count.

use super::{
    Airfoil, AirfoilError, Axis, Coefficient, CurveProblem, Data, Layers, Table, TableError,
    formats::{Format, has_extension},
    layers::MAX_LAYERS,
    records::{Layout, Number, Problem, Records, words},
};
use crate::text_file::{excerpt, push};

/// A file is in this format if its name ends in `.c81`.
pub const FORMAT: Format = Format {
    detects: |path, _| has_extension(path, "c81"),
    parse,
};

/// Number of characters before the counts.
const COUNTS_COLUMN: usize = 30;
/// Number of counts: ML, NL, MD, ND, MM and NM.
const COUNTS: usize = 6;
/// Number of counts that are needed: those of lift and drag.
const NEEDED_COUNTS: usize = 4;

/// Maximum number of Mach numbers or of angles; no table has more.
const MAX_COUNT: usize = MAX_LAYERS;

/// The first line.
#[derive(Debug, PartialEq)]
struct Header {
    name: String,
    /// ML, NL, MD, ND.
    counts: [usize; NEEDED_COUNTS],
}

/// Reads the text of a C81 file; `file` is its name for errors.
pub fn parse(text: &str, file: &str) -> Result<Airfoil, AirfoilError> {
    read(text).map_err(|(line, column, problem)| AirfoilError::MalformedField {
        file: file.to_owned(),
        line,
        column,
        problem,
    })
}

fn read(text: &str) -> Result<Airfoil, Problem> {
    let mut records = Records::new(text);
    let (line, first) = records.line("the header")?;
    let header = header(first).ok_or_else(|| {
        let field: String = first.chars().skip(COUNTS_COLUMN).take(2).collect();
        let problem = format!(
            "`{}` is not a count; columns 31-42 hold ML, NL, MD, ND, MM and NM in two digits each, or the line ends with these numbers between blanks",
            excerpt(field.trim())
        );
        (line, COUNTS_COLUMN + 1, problem)
    })?;
    let [lift_machs, lift_angles, drag_machs, drag_angles] = header.counts;
    let lift = table(&mut records, Coefficient::Lift, lift_machs, lift_angles)?;
    let drag = table(&mut records, Coefficient::Drag, drag_machs, drag_angles)?;
    Ok(Airfoil::new(header.name, Data::Tables { lift, drag }))
}

fn count(text: &str) -> Option<usize> {
    let is_digits = text.bytes().all(|b| b.is_ascii_digit());
    let value = text.parse().ok().filter(|_| is_digits);
    value.filter(|n| (1..=MAX_COUNT).contains(n))
}

fn header(line: &str) -> Option<Header> {
    header_in_columns(line).or_else(|| free_header(line))
}

/// Counts of two digits from column 31 on.
fn header_in_columns(line: &str) -> Option<Header> {
    if line.contains('\t') {
        return None;
    }
    let end = COUNTS_COLUMN + 2 * NEEDED_COUNTS;
    let text: Vec<char> = line.chars().take(end).collect();
    let mut counts = [0; NEEDED_COUNTS];
    for (i, slot) in counts.iter_mut().enumerate() {
        let field = text.get(COUNTS_COLUMN + 2 * i..)?.iter().take(2);
        *slot = count(field.collect::<String>().trim())?;
    }
    let name: String = text.iter().take(COUNTS_COLUMN).collect();
    Some(Header {
        name: excerpt(name.trim()),
        counts,
    })
}

/// Counts at the end of the line, between blanks or all in one word of two digits each.
fn free_header(line: &str) -> Option<Header> {
    // The last words, as far as they are numbers.
    let mut numbers: Vec<(usize, &str)> = Vec::new();
    for (column, word) in words(line) {
        if !word.bytes().all(|b| b.is_ascii_digit()) {
            numbers.clear();
            continue;
        }
        if numbers.len() == COUNTS {
            numbers.remove(0);
        }
        numbers.push((column, word));
    }
    let (begin, texts): (usize, Vec<String>) = match numbers[..] {
        [.., (column, run)] if run.len() == 2 * COUNTS || run.len() == 2 * NEEDED_COUNTS => {
            let pairs = run.as_bytes().chunks(2);
            let text = |pair: &[u8]| String::from_utf8_lossy(pair).into_owned();
            (column, pairs.map(text).collect())
        }
        ref numbers => {
            let taken = match numbers.len() {
                COUNTS => COUNTS,
                NEEDED_COUNTS => NEEDED_COUNTS,
                // A number of the section, such as 0012, before four counts; else one is missing.
                5 if numbers[0].1.len() > 2 => NEEDED_COUNTS,
                _ => return None,
            };
            let counts = &numbers[numbers.len() - taken..];
            let texts = counts.iter().map(|word| word.1.to_owned());
            (counts[0].0, texts.collect())
        }
    };
    let mut counts = [0; NEEDED_COUNTS];
    for (slot, text) in counts.iter_mut().zip(&texts) {
        *slot = count(text)?;
    }
    let end = line.char_indices().nth(begin - 1);
    let name = &line[..end.map_or(line.len(), |(index, _)| index)];
    let is_around = |c: char| c.is_whitespace() || c == ',' || c == ';';
    Some(Header {
        name: excerpt(name.trim_matches(is_around)),
        counts,
    })
}

fn table(
    records: &mut Records,
    coefficient: Coefficient,
    machs: usize,
    angles: usize,
) -> Result<Table, Problem> {
    let name = match coefficient {
        Coefficient::Lift => "lift",
        Coefficient::Drag => "drag",
    };
    let at = |number: &Number, problem: String| (number.line, number.column, problem);
    let numbers = records.numbers(Layout {
        has_angle: false,
        values: machs,
        what: &format!("a Mach number of the {name} table"),
    })?;
    let layers = Layers::try_new(Axis::Mach, numbers.iter().map(|n| n.value))
        .map_err(|error| at(&numbers[error.layer], format!("{name} table: {error}")))?;
    let mut rows = Vec::new();
    for _ in 0..angles {
        let row = records.numbers(Layout {
            has_angle: true,
            values: machs,
            what: &format!("a value of the {name} table"),
        })?;
        let begin = row[0];
        push(&mut rows, row, "the rows").map_err(|error| at(&begin, error.to_string()))?;
    }
    let points = |mach: usize| {
        rows.iter()
            .map(move |row| (row[0].value, row[mach + 1].value))
    };
    Table::try_new(layers, coefficient, points).map_err(|TableError { layer, error }| {
        let row = &rows[error.point];
        let number = match error.problem {
            CurveProblem::Begin(_)
            | CurveProblem::End(_)
            | CurveProblem::NotIncreasing { .. }
            | CurveProblem::Empty
            | CurveProblem::NoMemory(_)
            | CurveProblem::TooMany => &row[0],
            CurveProblem::NotFinite { .. }
            | CurveProblem::TooLarge { .. }
            | CurveProblem::NegativeDrag(_)
            | CurveProblem::TooSteep { .. } => &row[layer + 1],
        };
        let problem = format!("{name} table of {angles} angles by the first line: {error}");
        at(number, problem)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::airfoil::{Lift, SectionModel, Similarity};
    use crate::compressibility::Compressibility;

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
            (" 2 4 1 3", " x 4 1 3", "line 1, column 31", "not a count"),
            (
                "   0.80",
                "   o.80",
                "line 2, column 18",
                "a Mach number of the lift table",
            ),
            (
                "   0.80",
                "   0.00",
                "line 2, column 18",
                "above the one before",
            ),
            (
                "   0.00   0.10",
                "   0.00   .1.0",
                "line 4, column 11",
                "a value of the lift table",
            ),
            (
                "-180.00   0.00",
                "-170.00   0.00",
                "line 3, column 1",
                "must be -180 deg",
            ),
            (
                "   0.00   0.01",
                "   0.00  -0.01",
                "line 9, column 10",
                "must not be negative",
            ),
            (
                "   0.00   0.01",
                "   0.00  1e100",
                "line 9, column 10",
                "between -10 and 10",
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

    /// Lift at Mach 0.4 halfway between the Mach numbers of `GOOD`, and drag, at some angles.
    fn sampled(airfoil: &Airfoil) -> Vec<f64> {
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.2,
        };
        let flow = Similarity {
            reynolds: 1e6,
            mach: 0.4,
        };
        let angles = [-3.0, -0.5, 0.0, 0.1, 1.0, 3.0];
        let lift = angles.map(|a| airfoil.lift_coefficient(&model, 0.0, a, flow));
        let drag = angles.map(|a| airfoil.drag_coefficient(&model, a, flow));
        [lift, drag].concat()
    }

    #[test]
    fn what_people_do_to_files_does_not_change_what_is_read() {
        let good = sampled(&parse(GOOD, "good.c81").unwrap());
        let moment = "          0.00\n-180.00   0.00\n 180.00   0.00\n";
        let free_lines: Vec<String> = GOOD
            .lines()
            .map(|l| l.split_whitespace().collect::<Vec<_>>().join(" "))
            .collect();
        let free = free_lines.join("\n");
        for (what, text) in [
            ("a moment table", format!("{GOOD}{moment}")),
            ("half a moment table", format!("{GOOD}          0.00\n-18")),
            ("no trailing newline", GOOD.trim_end().to_owned()),
            ("CRLF", GOOD.replace('\n', "\r\n")),
            (
                "blank lines",
                format!("\n{}", GOOD.replace('\n', "\n   \n\n")),
            ),
            ("blanks at the ends", GOOD.replace('\n', "      \n")),
            ("free", free.clone()),
            ("tabs", free.replace(' ', "\t")),
            (
                "commas",
                free.replace("Test section", "Test_section")
                    .replace(' ', ", "),
            ),
            ("upper case", GOOD.to_uppercase()),
            (
                "blanks as zeros",
                GOOD.replace("-180.00   0.00   0.00", "-180.00          0.00"),
            ),
            (
                "a blank angle",
                GOOD.replace("   0.00   0.10", "          0.10"),
            ),
            (
                "numbers that touch",
                GOOD.replace("  10.00   1.10   1.60", "  10.001.100001.60000"),
            ),
            (
                "other numbers",
                GOOD.replace("1.10", "1.1 ")
                    .replace("   1.60", "1.6D+00")
                    .replace("0.80", " .8 "),
            ),
            (
                "a short name",
                GOOD.replace("Test section                   2", "Test 2"),
            ),
            (
                "a short name without moments",
                GOOD.replace(
                    "Test section                   2 4 1 3 1 2",
                    "NACA 0012 2 4 1 3",
                ),
            ),
            (
                "an upper-case name with digits",
                GOOD.replace(
                    "Test section                   2",
                    "NACA 0012 SECTION, 2D 2",
                ),
            ),
            (
                "counts in one word",
                GOOD.replace(
                    "Test section                   2 4 1 3 1 2",
                    "Test 020401030102",
                ),
            ),
            (
                "counts without moments",
                GOOD.replace(" 2 4 1 3 1 2", " 2 4 1 3"),
            ),
            ("zero moments", GOOD.replace(" 2 4 1 3 1 2", " 2 4 1 3 0 0")),
            (
                "one line free",
                GOOD.replace("  10.00   1.10   1.60", "10 1.1 1.6"),
            ),
        ] {
            match parse(&text, "x.c81") {
                Ok(airfoil) => assert_eq!(sampled(&airfoil), good, "{what}"),
                Err(error) => panic!("{what}: {error}"),
            }
        }
    }

    #[test]
    fn the_name_ends_where_the_counts_begin() {
        for (line, name) in [
            ("SC1095                         2 4 1 3 1 2", "SC1095"),
            ("sc 1095 r8 2 4 1 3 1 2", "sc 1095 r8"),
            ("NACA 0012 2 4 1 3 1 2", "NACA 0012"),
            ("NACA 0012 2 4 1 3", "NACA 0012"),
            ("\tV23010-1.58\t2\t4\t1\t3\t1\t2", "V23010-1.58"),
            (
                "a name that has thirty letters 2 4 1 3 1 2",
                "a name that has thirty letters",
            ),
            ("0012, 020401030102", "0012"),
        ] {
            let found = header(line).unwrap();
            assert_eq!((found.name.as_str(), found.counts), (name, [2, 4, 1, 3]));
        }
        for line in [
            "",
            "name",
            "name 1 2 3",
            "name 4 1 3 1 2",
            "name 0 4 1 3 1 2",
            "name 2 4 1 9999999999999999999999",
        ] {
            assert_eq!(header(line), None, "{line}");
        }
    }

    #[test]
    fn more_or_fewer_numbers_than_the_first_line_says_are_refused() {
        for (from, to, place, part) in [
            (
                "  10.00   1.10   1.60",
                "  10.00   1.10",
                "line 5, column 1",
                "3 numbers are expected here, not 2",
            ),
            (
                "  10.00   1.10   1.60",
                "10 1.1 1.6 2.1",
                "line 5, column 1",
                "3 numbers are expected here, not 4",
            ),
            (
                " 2 4 1 3 1 2",
                " 2 3 1 3 1 2",
                "line 5, column 3",
                "3 angles by the first line",
            ),
            (
                " 2 4 1 3 1 2",
                " 2 5 1 3 1 2",
                "line 7, column 1",
                "3 numbers are expected here, not 1",
            ),
        ] {
            let error = parse(&GOOD.replacen(from, to, 1), "x")
                .unwrap_err()
                .to_string();
            assert!(
                error.contains(place) && error.contains(part),
                "{to}: {error}"
            );
        }
    }
}
