//! Text files of Modelica's CombiTable blocks (Modelica Standard Library, Modelica.Blocks.Tables),
//! with one table of section laws by Reynolds number.
//!
//! ```text
//! #1
//! # a comment, to the end of the line
//! double naca0015(2, 7)         type (double or float), name, rows and columns
//! # Re     slopes A and C, 1/rad   stall, rad   drag: d0, d1, d2 for alpha in rad
//! 2e4      6.2     3.0             0.175        0.032   0.0   1.1
//! 1e6      6.3     4.6             0.297        0.0096  0.0   0.36
//! ```
//!
//! As in Modelica, numbers are separated by blanks, tabs, commas or semicolons, and a row may go on
//! in the next line. Of several tables in a file, the one with the name `airfoil` is read. The
//! columns are those of `CombiTable1D` with the Reynolds number as its input; the last one to seven
//! columns are the coefficients of the drag polynomial. `laws` says what the numbers mean.

use super::{
    Airfoil, AirfoilError, Data,
    formats::Format,
    laws::{Coefficients, Law, LawError, Laws},
    layers::{Axis, MAX_LAYERS, check_count},
    records::{Number, Problem, placed_words},
};
use crate::text_file::{excerpt, push};

/// A file is in this format if its text begins with `#1`.
pub const FORMAT: Format = Format {
    detects: |_, text| begins(text),
    parse,
};

/// The table to read if the file holds several.
const NAME: &str = "airfoil";

/// Columns without the coefficients of the drag polynomial.
const COLUMNS: usize = 4;

/// Maximum number of coefficients of the drag polynomial.
const MAX_DRAG_COEFFICIENTS: usize = 7;

/// Maximum number of tables in a file.
const MAX_TABLES: usize = 100;

/// As many numbers as section data can have. Of a larger table, which is for something else, the
/// other numbers are only counted.
const MAX_NUMBERS: usize = MAX_LAYERS * (COLUMNS + MAX_DRAG_COEFFICIENTS);

/// A table as its file has it.
#[derive(Debug)]
struct Matrix {
    /// At most 80 characters of it.
    name: String,
    rows: usize,
    columns: usize,
    /// The line of the file that begins it.
    line: usize,
    /// The first `MAX_NUMBERS`.
    numbers: Vec<Number>,
    /// Of all numbers.
    count: usize,
}

/// Whether a text begins as a CombiTable file does.
pub fn begins(text: &str) -> bool {
    let rest = text.strip_prefix("#1");
    rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(char::is_whitespace))
}

/// Reads the text of a CombiTable file; `file` is its name for errors.
pub fn parse(text: &str, file: &str) -> Result<Airfoil, AirfoilError> {
    let laws = matrices(text)
        .and_then(chosen)
        .and_then(|matrix| Ok((laws(&matrix)?, matrix.name)));
    match laws {
        Ok((laws, name)) => Ok(Airfoil::new(name, Data::Laws(laws))),
        Err((line, column, problem)) => Err(AirfoilError::MalformedField {
            file: file.to_owned(),
            line,
            column,
            problem,
        }),
    }
}

/// All tables of a file.
fn matrices(text: &str) -> Result<Vec<Matrix>, Problem> {
    if !begins(text) {
        return Err((1, 1, "the file must begin with `#1`".into()));
    }
    let mut tables: Vec<Matrix> = Vec::new();
    let mut last_line = 1;
    for (i, line) in text.lines().enumerate() {
        let content = line.split('#').next().unwrap_or("");
        let line = i + 1;
        if content.trim().is_empty() {
            continue;
        }
        last_line = line;
        if content.trim_start().starts_with(char::is_alphabetic) {
            if let Some(table) = tables.last() {
                table.check_complete(line)?;
            }
            if tables.len() == MAX_TABLES {
                let problem = format!(
                    "there are more than {MAX_TABLES} tables; put the one with the section's data into a file of its own"
                );
                return Err((line, 1, problem));
            }
            tables.push(header(content, line)?);
            continue;
        }
        for (column, word) in placed_words(content) {
            let Some(table) = tables.last_mut() else {
                let problem = format!(
                    "`{}` before the first table, which begins with a line like `double {NAME}(2, 7)`",
                    excerpt(word)
                );
                return Err((line, column, problem));
            };
            table.take(word, line, column)?;
        }
    }
    match tables.last() {
        None => {
            let problem =
                format!("the file has no table; it begins with a line like `double {NAME}(2, 7)`");
            Err((last_line, 1, problem))
        }
        Some(table) => table.check_complete(last_line).map(|()| tables),
    }
}

/// `double name(rows, columns)`.
fn header(content: &str, line: usize) -> Result<Matrix, Problem> {
    let column = 1 + content.chars().take_while(|c| c.is_whitespace()).count();
    let wrong = || {
        let problem = format!(
            "`{}` does not begin a table; write `double name(rows, columns)`",
            excerpt(content.trim())
        );
        (line, column, problem)
    };
    let (kind, rest) = content
        .trim()
        .split_once(char::is_whitespace)
        .ok_or_else(wrong)?;
    if kind != "double" && kind != "float" {
        return Err(wrong());
    }
    let (name, rest) = rest.split_once('(').ok_or_else(wrong)?;
    let (rows, rest) = rest.split_once(',').ok_or_else(wrong)?;
    let (columns, rest) = rest.split_once(')').ok_or_else(wrong)?;
    let count = |text: &str| text.trim().parse::<usize>().ok().filter(|n| *n > 0);
    match (count(rows), count(columns)) {
        (Some(rows), Some(columns)) if rest.is_empty() && !name.trim().is_empty() => Ok(Matrix {
            name: excerpt(name.trim()),
            rows,
            columns,
            line,
            numbers: Vec::new(),
            count: 0,
        }),
        _ => Err(wrong()),
    }
}

impl Matrix {
    /// How many numbers it holds when it is complete.
    fn size(&self) -> usize {
        self.rows.saturating_mul(self.columns)
    }

    /// As in the file's header.
    fn title(&self) -> String {
        format!("{}({}, {})", self.name, self.rows, self.columns)
    }

    fn take(&mut self, word: &str, line: usize, column: usize) -> Result<(), Problem> {
        if self.count == self.size() {
            let problem = format!(
                "`{}` is one number too many for the table {} of line {}; correct its rows and columns",
                excerpt(word),
                self.title(),
                self.line
            );
            return Err((line, column, problem));
        }
        let value = word.parse::<f64>().ok().filter(|v| v.is_finite());
        let Some(value) = value else {
            let problem = format!("`{}` is not a number", excerpt(word));
            return Err((line, column, problem));
        };
        self.count += 1;
        if self.numbers.len() == MAX_NUMBERS {
            return Ok(());
        }
        let number = Number {
            value,
            line,
            column,
        };
        push(&mut self.numbers, number, "the numbers of the table")
            .map_err(|error| (line, column, error.to_string()))
    }

    fn check_complete(&self, line: usize) -> Result<(), Problem> {
        if self.count == self.size() {
            return Ok(());
        }
        let problem = format!(
            "the table {} of line {} ends after {} numbers; add the others or correct its rows and columns",
            self.title(),
            self.line,
            self.count
        );
        Err((line, 1, problem))
    }
}

/// The table with the section's data.
fn chosen(mut tables: Vec<Matrix>) -> Result<Matrix, Problem> {
    let named = tables.iter().position(|t| t.name == NAME);
    if let Some(place) = named.or((tables.len() == 1).then_some(0)) {
        return Ok(tables.swap_remove(place));
    }
    let names: Vec<&str> = tables.iter().map(|t| t.name.as_str()).collect();
    let problem = format!(
        "the tables {} are in the file; give the one with the section's data the name `{NAME}`",
        excerpt(&names.join(", "))
    );
    Err((1, 1, problem))
}

/// The rows as laws.
fn laws(matrix: &Matrix) -> Result<Laws, Problem> {
    if !(COLUMNS + 1..=COLUMNS + MAX_DRAG_COEFFICIENTS).contains(&matrix.columns) {
        let problem = format!(
            "the table {} must have 5 to 11 columns: Reynolds number, lift slopes A and C in 1/rad, stall angle in rad, and 1 to {MAX_DRAG_COEFFICIENTS} coefficients of the drag polynomial",
            matrix.title()
        );
        return Err((matrix.line, 1, problem));
    }
    check_count(Axis::Reynolds, matrix.rows)
        .map_err(|problem| (matrix.line, 1, problem.to_string()))?;
    let rows = || matrix.numbers.chunks_exact(matrix.columns);
    let mut laws = Vec::new();
    for row in rows() {
        push(&mut laws, law(row)?, "the laws")
            .map_err(|error| (matrix.line, 1, error.to_string()))?;
    }
    Laws::try_new(laws).map_err(|error| {
        // The Reynolds number of the wrong row.
        let place = rows().nth(error.layer).and_then(|row| row.first());
        let (line, column) = place.map_or((matrix.line, 1), |n| (n.line, n.column));
        (line, column, error.to_string())
    })
}

fn law(row: &[Number]) -> Result<Law, Problem> {
    let [reynolds, slope_a, slope_c, stall, drag @ ..] = row else {
        return Err((1, 1, "a row has too few columns".into()));
    };
    let polynomial: Vec<f64> = drag.iter().map(|d| d.value).collect();
    let numbers = Coefficients {
        reynolds: reynolds.value,
        slope_a: slope_a.value,
        slope_c: slope_c.value,
        stall: stall.value,
        drag: &polynomial,
    };
    Law::try_new(numbers).map_err(|error| {
        let place = match error {
            LawError::SlopeA(_) => slope_a,
            LawError::SlopeC(_) => slope_c,
            LawError::Stall(_) | LawError::Lift { .. } => stall,
            LawError::Drag { .. } => drag.first().unwrap_or(stall),
        };
        (place.line, place.column, error.to_string())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::airfoil::{Similarity, laws::Line};

    const GOOD: &str = "\
#1
# NACA 0015, two rows
double airfoil(2, 7)  # rows, columns
2e4 6.2 3.0 0.175 0.032 0.0 1.1
1e6 6.3 4.6 0.297 0.0096 0.0 0.36 # last
";

    fn read(text: &str) -> Laws {
        match parse(text, "x.txt").unwrap().data {
            Data::Laws(laws) => laws,
            Data::Tables { .. } => unreachable!(),
        }
    }

    #[test]
    fn a_good_file_is_read() {
        let laws = read(GOOD);
        let flow = |reynolds| Similarity {
            reynolds,
            mach: 0.0,
        };
        assert_eq!(laws.slope(|_| Line::ByPitch(0.0), flow(2e4)), 6.2);
        assert!((laws.slope(|_| Line::ByPitch(0.2), flow(1e6)) - 5.45).abs() < 1e-14);
        assert_eq!(laws.stall(flow(1e6)), 0.297);
        assert_eq!(laws.drag(0.0, flow(2e4)), 0.032);
    }

    #[test]
    fn what_modelica_allows_is_the_same_file() {
        let good = read(GOOD);
        let (start, rows) = GOOD.split_once("double").unwrap();
        let several =
            format!("{start}double other(2,2)\n1 2\n3 4\ndouble{rows}float last(1,1)\n5\n");
        for text in [
            GOOD.replace('\n', "\r\n"),
            GOOD.replace("6.2 3.0 0.175", "6.2,3.0;\t0.175"),
            GOOD.replace("6.2 3.0", "6.2 # slope A\n\n 3.0"),
            GOOD.replace("0.0 1.1\n", "0.0 1.1 "),
            GOOD.replace("double airfoil(2, 7)", "  float\tairfoil ( 2 ,7 ) "),
            GOOD.replace("airfoil", "naca0015"),
            GOOD.trim_end().to_owned(),
            several,
        ] {
            assert_eq!(read(&text), good, "{text}");
        }
    }

    #[test]
    fn errors_name_file_line_column_and_problem() {
        for (from, to, place, part) in [
            (
                "double airfoil(2, 7)",
                "2 7",
                "line 3, column 1",
                "before the first table",
            ),
            (
                "double",
                "integer",
                "line 3, column 1",
                "write `double name(rows, columns)`",
            ),
            (
                "(2, 7)",
                "(2; 7)",
                "line 3, column 1",
                "does not begin a table",
            ),
            (
                "(2, 7)",
                "(0, 7)",
                "line 3, column 1",
                "does not begin a table",
            ),
            (
                "(2, 7)",
                "(1, 7)",
                "line 5, column 1",
                "one number too many",
            ),
            (
                "(2, 7)",
                "(3, 7)",
                "line 5, column 1",
                "ends after 14 numbers",
            ),
            (
                "(2, 7)",
                "(99999999999999, 99999999999999)",
                "line 5, column 1",
                "ends after 14",
            ),
            ("(2, 7)", "(7, 2)", "line 3, column 1", "5 to 11 columns"),
            (
                "double airfoil(2, 7)",
                "",
                "line 4, column 1",
                "before the first table",
            ),
            ("6.2", "6.2x", "line 4, column 5", "`6.2x` is not a number"),
            ("6.2", "nan", "line 4, column 5", "`nan` is not a number"),
            ("6.2", "1e999", "line 4, column 5", "is not a number"),
            ("6.2", "-6.2", "line 4, column 5", "must be above 0"),
            ("4.6", "46", "line 5, column 9", "0 to 20 per rad"),
            ("0.175", "10.0", "line 4, column 13", "angles are in rad"),
            ("0.175", "0", "line 4, column 13", "must be above 0"),
            ("2e4", "0.5", "line 4, column 1", "must lie between 1 and"),
            (
                "1e6",
                "2e4",
                "line 5, column 1",
                "above the one before (20000)",
            ),
            (
                "1.1",
                "-1.1",
                "line 4, column 19",
                "must lie between 0 and 10",
            ),
            (
                "1.1",
                "1e300",
                "line 4, column 19",
                "the drag polynomial gives 7",
            ),
            (
                "6.2 3.0 0.175",
                "20 3.0 0.7",
                "line 4, column 12",
                "the lift coefficient at the stall angle is 14.0 by line A",
            ),
            (
                "6.2 3.0 0.175",
                "6.2 20 0.7",
                "line 4, column 12",
                "by line C; it must be at most 10",
            ),
        ] {
            let text = GOOD.replacen(from, to, 1);
            let error = parse(&text, "bad.txt").unwrap_err().to_string();
            let begins = format!("airfoil file bad.txt, {place}: ");
            assert!(
                error.starts_with(&begins) && error.contains(part),
                "{to:?}: {error}"
            );
        }
        let two = GOOD.replace("airfoil", "one") + "double two(1,1)\n0\n";
        let error = parse(&two, "x").unwrap_err().to_string();
        assert!(
            error.contains("one, two") && error.contains("`airfoil`"),
            "{error}"
        );
        let error = parse("#1\n# nothing\n", "x").unwrap_err().to_string();
        assert!(error.contains("no table"), "{error}");
    }

    #[test]
    fn tables_of_other_things_may_be_large_but_not_that_of_the_section() {
        let rows = |count: u32| {
            let row = |re: u32| format!("{re} 6 4 0.2 0.01\n");
            format!("({count}, 5)\n") + &(1..=count).map(row).collect::<String>()
        };
        let file = |name: &str, count: u32| {
            let (_, good) = GOOD.split_once("double").unwrap();
            format!("#1\ndouble {name}{}double{good}", rows(count))
        };
        assert_eq!(read(&file("engine", 3000)), read(GOOD));
        let error = |text: &str| parse(text, "x").unwrap_err().to_string();
        let short = file("engine", 3000).replace("(3000, 5)", "(3001, 5)");
        assert!(error(&short).contains("ends after 15000 numbers"));
        assert!(parse(&format!("#1\ndouble a{}", rows(999)), "x").is_ok());
        assert!(
            error(&format!("#1\ndouble a{}", rows(1000)))
                .contains("line 2, column 1: there are more than 999 Reynolds numbers")
        );
        let tables = "#1\n".to_owned() + &"double a(1, 1)\n0\n".repeat(101);
        assert!(error(&tables).contains("line 202, column 1: there are more than 100 tables"));
    }
}
