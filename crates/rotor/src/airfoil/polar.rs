//! The `.polar` text format: polars by Reynolds number or by Mach number.
//!
//! ```text
//! # a comment, to the end of the line
//! polar 1                       format and its version
//! name NACA 0015                free text
//! reynolds 242000               a block for each Reynolds number, increasing; or mach 0.3
//! -180  0.00  0.03              angle of attack in deg, lift, drag [, moment: not used]
//! ...
//!  180  0.00  0.03
//! ```
//!
//! Words may be in capitals. Numbers stand between blanks, tabs, commas or semicolons, and a D may
//! begin their exponent, as in C81 files.
//!
//! The angle increases strictly from -180 to 180 deg, where the values of both ends agree; drag is
//! never negative. Interpolation is linear in angle and in ln Re or Mach number.

use super::{
    Airfoil, AirfoilError, Axis, Coefficient, Data, Layers, Table, TableError,
    formats::{Format, has_extension},
    layers::check_count,
    records::{self, is_separator, words},
};
use crate::text_file::{excerpt, push};

/// A file is in this format if its name ends in `.polar` or its text begins with `polar 1`.
pub const FORMAT: Format = Format {
    detects: |path, text| has_extension(path, "polar") || begins(text),
    parse,
};

/// What is wrong, and in which line (from 1).
pub type Problem = (usize, String);

/// A row and its line.
#[derive(Debug)]
pub struct Row {
    line: usize,
    /// deg.
    pub alpha: f64,
    pub lift: f64,
    pub drag: f64,
}

/// The polar at one Reynolds or Mach number.
#[derive(Debug)]
pub struct Block {
    /// Line of its first word, `reynolds` or `mach`.
    line: usize,
    axis: Axis,
    pub number: f64,
    pub rows: Vec<Row>,
}

/// Reads the text of a `.polar` file; `file` is its name for errors.
pub fn parse(text: &str, file: &str) -> Result<Airfoil, AirfoilError> {
    read(text).map_err(|(line, problem)| AirfoilError::Malformed {
        file: file.to_owned(),
        line,
        problem,
    })
}

fn read(text: &str) -> Result<Airfoil, Problem> {
    let (name, first, blocks) = blocks(text)?;
    for block in &blocks {
        block.check_complete()?;
    }
    let table = |coefficient: Coefficient, column: fn(&Row) -> f64| {
        let numbers = blocks.iter().map(|block| block.number);
        let layers = Layers::try_new(first, numbers)
            .map_err(|error| (blocks[error.layer].line, error.to_string()))?;
        let points = |i: usize| blocks[i].rows.iter().map(|row| (row.alpha, column(row)));
        Table::try_new(layers, coefficient, points).map_err(|TableError { layer, error }| {
            let block = &blocks[layer];
            let row = block.rows.get(error.point);
            (row.map_or(block.line, |row| row.line), error.to_string())
        })
    };
    let data = Data::Tables {
        lift: table(Coefficient::Lift, |row| row.lift)?,
        drag: table(Coefficient::Drag, |row| row.drag)?,
    };
    Ok(Airfoil::new(name, data))
}

/// The lines that are more than a comment, with their numbers from 1.
fn lines(text: &str) -> impl Iterator<Item = (usize, &str)> {
    text.lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty())
}

/// Whether a text begins with `polar 1`, in capitals or not.
pub fn begins(text: &str) -> bool {
    lines(text).next().is_some_and(|(_, line)| is_first(line))
}

fn is_first(line: &str) -> bool {
    let mut words = words(line);
    words
        .next()
        .is_some_and(|w| w.eq_ignore_ascii_case("polar"))
        && words.next() == Some("1")
        && words.next().is_none()
}

/// The name, what the blocks are numbered by, and the blocks, one or more, as they stand in the
/// file.
pub fn blocks(text: &str) -> Result<(String, Axis, Vec<Block>), Problem> {
    let mut lines = lines(text);
    match lines.next() {
        Some((_, line)) if is_first(line) => {}
        Some((line, found)) => {
            let problem = format!(
                "the file must begin with `polar 1`, not `{}`",
                excerpt(found)
            );
            return Err((line, problem));
        }
        None => {
            let problem = "the file is empty; it must begin with `polar 1`".into();
            return Err((1, problem));
        }
    }
    let mut name = String::new();
    let mut blocks: Vec<Block> = Vec::new();
    let mut last_line = 1;
    for (line, content) in lines {
        last_line = line;
        let word = words(content).next().unwrap_or(content);
        if word.eq_ignore_ascii_case("name") {
            let rest = content.trim_start_matches(is_separator).get(word.len()..);
            name = excerpt(rest.unwrap_or("").trim_matches(is_separator));
        } else if let Some(axis) = axis(word) {
            let first = blocks.first().map(|block| (block.axis, block.line));
            let block = block(line, axis, content, first)?;
            check_count(axis, blocks.len() + 1).map_err(|problem| (line, problem.to_string()))?;
            push(&mut blocks, block, "the blocks")
                .map_err(|problem| (line, problem.to_string()))?;
        } else if let Some(block) = blocks.last_mut() {
            let row = row(line, content)?;
            push(&mut block.rows, row, "the rows")
                .map_err(|problem| (line, problem.to_string()))?;
        } else {
            let problem = format!(
                "`{}` before the first `reynolds` or `mach` line; only `name` may stand there",
                excerpt(word)
            );
            return Err((line, problem));
        }
    }
    match blocks.first() {
        Some(first) => Ok((name, first.axis, blocks)),
        None => Err((last_line, "there is no `reynolds` or `mach` block".into())),
    }
}

/// What a block is numbered by that this word begins.
fn axis(word: &str) -> Option<Axis> {
    if word.eq_ignore_ascii_case("reynolds") {
        return Some(Axis::Reynolds);
    }
    word.eq_ignore_ascii_case("mach").then_some(Axis::Mach)
}

/// The block that a line begins; `first` is the axis and the line of the file's first block.
fn block(
    line: usize,
    axis: Axis,
    content: &str,
    first: Option<(Axis, usize)>,
) -> Result<Block, Problem> {
    if let Some((other, begin)) = first.filter(|(other, _)| *other != axis) {
        let problem = format!(
            "this block has a {axis} and that in line {begin} a {other}; a file has blocks by one of the two"
        );
        return Err((line, problem));
    }
    let mut numbers = words(content).skip(1);
    let (Some(word), None) = (numbers.next(), numbers.next()) else {
        return Err((line, format!("one number must follow, the {axis}")));
    };
    Ok(Block {
        line,
        axis,
        number: number(word).map_err(|problem| (line, problem))?,
        rows: Vec::new(),
    })
}

fn row(line: usize, content: &str) -> Result<Row, Problem> {
    let mut values = [0.0; 4];
    let mut count = 0;
    for word in words(content) {
        let value = number(word).map_err(|problem| (line, problem))?;
        if let Some(place) = values.get_mut(count) {
            *place = value;
        }
        count += 1;
    }
    if !(3..=values.len()).contains(&count) {
        let problem =
            format!("a row has 3 or 4 numbers (angle, lift, drag, moment), this one has {count}");
        return Err((line, problem));
    }
    let [alpha, lift, drag, _] = values;
    Ok(Row {
        line,
        alpha,
        lift,
        drag,
    })
}

impl Block {
    /// The format asks for rows, and for the same values at both ends of the circle.
    fn check_complete(&self) -> Result<(), Problem> {
        let (axis, number) = (self.axis, self.number);
        let Some((first, last)) = self.rows.first().zip(self.rows.last()) else {
            let problem = format!("the block of {axis} {number} has no rows");
            return Err((self.line, problem));
        };
        let is_circle = (first.alpha, last.alpha) == (-180.0, 180.0);
        if is_circle && (first.lift, first.drag) != (last.lift, last.drag) {
            let problem = format!(
                "the block of {axis} {number} has other values at -180 than at 180 deg, which is the same angle"
            );
            return Err((last.line, problem));
        }
        Ok(())
    }
}

/// A finite number, which `nan` and `inf` are not.
fn number(text: &str) -> Result<f64, String> {
    records::number(text).ok_or_else(|| format!("`{}` is not a number", excerpt(text)))
}

#[cfg(test)]
mod tests {
    use super::super::{Lift, SectionModel, Similarity};
    use super::*;
    use crate::compressibility::Compressibility;
    use std::path::Path;

    const GOOD: &str = "# title\npolar 1\nname Test 12\nreynolds 1e5\n-180 0 0.02\n0 0 0.01 # note\n10 1 0.02 -0.1\n180 0 0.02\n";

    #[test]
    fn a_good_file_is_read() {
        let airfoil = parse(GOOD, "good.polar").unwrap();
        assert_eq!(airfoil.name(), "Test 12");
    }

    fn coefficients(airfoil: &Airfoil, alpha: f64, reynolds: f64, mach: f64) -> (f64, f64) {
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::PrandtlGlauert,
            drag_reynolds_exponent: 0.0,
        };
        let (alpha, flow) = (alpha.to_radians(), Similarity { reynolds, mach });
        let lift = airfoil.lift_coefficient(&model, 0.0, alpha, flow);
        (lift, airfoil.drag_coefficient(&model, alpha, flow))
    }

    #[test]
    fn what_people_do_to_files_does_not_change_what_is_read() {
        let good = coefficients(&parse(GOOD, "good.polar").unwrap(), 5.0, 1e5, 0.0);
        assert!((good.0 - 0.5).abs() < 1e-15 && (good.1 - 0.015).abs() < 1e-15);
        for (what, text) in [
            ("capitals", GOOD.to_uppercase()),
            ("tabs", GOOD.replace(' ', "\t")),
            ("commas", GOOD.replace(' ', ", ")),
            ("semicolons", GOOD.replace(' ', "; ")),
            ("commas at the ends", GOOD.replace("0.02\n", "0.02,\n")),
            (
                "D exponents",
                GOOD.replace("1e5", "1.0D+05").replace("0.01 ", "1d-2 "),
            ),
            ("blanks before and after", GOOD.replace('\n', "  \n\t ")),
            ("blank lines and CRLF", GOOD.replace('\n', "\r\n\r\n")),
        ] {
            match parse(&text, "x.polar") {
                Ok(airfoil) => assert_eq!(coefficients(&airfoil, 5.0, 1e5, 0.0), good, "{what}"),
                Err(error) => panic!("{what}: {error}"),
            }
        }
        let named = GOOD.replace("name Test 12", "NAME;\t A, B ;");
        assert_eq!(parse(&named, "x").unwrap().name(), "A, B");
    }

    #[test]
    fn blocks_by_mach_number_take_the_place_of_a_compressibility_rule() {
        let text = "polar 1\nmach 0.3\n-180 0 0.1\n0 0.4 0.01\n180 0 0.1\nMach 0.7\n-180 0 0.1\n0 0.6 0.03\n180 0 0.1\n";
        let airfoil = parse(text, "mach.polar").unwrap();
        assert_eq!(airfoil.range(Axis::Mach), Some((0.3, 0.7)));
        assert_eq!(airfoil.range(Axis::Reynolds), None);
        for (mach, lift, drag) in [(0.0, 0.4, 0.01), (0.5, 0.5, 0.02), (0.9, 0.6, 0.03)] {
            for reynolds in [1e4, 1e7] {
                let (cl, cd) = coefficients(&airfoil, 0.0, reynolds, mach);
                assert!(
                    (cl - lift).abs() < 1e-15 && (cd - drag).abs() < 1e-15,
                    "{mach}"
                );
            }
        }
    }

    #[test]
    fn a_text_that_begins_with_polar_1_needs_no_file_extension() {
        for (text, expected) in [
            ("polar 1", true),
            ("# title\n\n POLAR\t1 # x\n", true),
            ("polar 2", false),
            ("polar 1 2", false),
            ("polar", false),
            ("", false),
        ] {
            let is_polar = (FORMAT.detects)(Path::new("a.txt"), text);
            assert_eq!(is_polar, expected, "{text}");
        }
    }

    #[test]
    fn errors_name_file_line_and_problem() {
        for (from, to, line, part) in [
            ("polar 1", "polar 2", 2, "must begin with `polar 1`"),
            ("name Test 12", "10 1 0.1", 3, "before the first `reynolds`"),
            ("reynolds 1e5", "reynolds 0", 4, "must lie between 1 and"),
            ("reynolds 1e5", "reynolds fast", 4, "`fast` is not a number"),
            ("-180 0 0.02", "-170 0 0.02", 5, "must be -180"),
            ("0 0 0.01", "-190 0 0.01", 6, "must be above the one before"),
            ("10 1 0.02 -0.1", "10 1", 7, "this one has 2"),
            ("10 1 0.02 -0.1", "10 1 -0.02", 7, "must not be negative"),
            ("10 1 0.02 -0.1", "10 1e300 0.02", 7, "at 10 deg is 1e300"),
            ("10 1 0.02 -0.1", "10 1 11", 7, "between -10 and 10"),
            ("10 1 0.02 -0.1", "10 nan 0.02", 7, "`nan` is not a number"),
            ("180 0 0.02\n", "190 0 0.02\n", 5, "must be -180"),
            (
                "\n180 0 0.02\n",
                "\n",
                7,
                "last angle must be 180 deg, not 10",
            ),
            (
                "\n180 0 0.02\n",
                "\n180 0 0.03\n",
                8,
                "other values at -180",
            ),
            (
                "\n180 0 0.02\n",
                "\n180 0 0.02\nreynolds 1e4\n-180 0 0\n180 0 0\n",
                9,
                "above the one before (100000)",
            ),
            (
                "\n180 0 0.02\n",
                "\n180 0 0.02\nreynolds 1e6\n",
                9,
                "has no rows",
            ),
            (
                "\n180 0 0.02\n",
                "\n180 0 0.02\nmach 0.5\n-180 0 0\n180 0 0\n",
                9,
                "this block has a Mach number and that in line 4 a Reynolds number",
            ),
            ("reynolds 1e5", "reynolds", 4, "one number must follow"),
            (
                "reynolds 1e5",
                "reynolds 1 000",
                4,
                "one number must follow",
            ),
            ("reynolds 1e5", "mach 11", 4, "must lie between 0 and 10"),
        ] {
            let text = GOOD.replacen(from, to, 1);
            let error = parse(&text, "bad.polar").unwrap_err().to_string();
            let place = format!("airfoil file bad.polar, line {line}: ");
            assert!(
                error.starts_with(&place) && error.contains(part),
                "{to:?}: {error}"
            );
        }
        assert!(
            parse("", "x")
                .unwrap_err()
                .to_string()
                .contains("the file is empty")
        );
    }

    /// Each block is two curves of 2 kB: without a limit a file of 4 MB would take 400 MB.
    #[test]
    fn up_to_999_reynolds_numbers_are_read() {
        let text = |count: u32| {
            let block = |re: u32| format!("reynolds {re}\n-180 0 0\n180 0 0\n");
            "polar 1\n".to_owned() + &(1..=count).map(block).collect::<String>()
        };
        assert!(parse(&text(999), "many.polar").is_ok());
        let error = parse(&text(1000), "many.polar").unwrap_err().to_string();
        assert_eq!(
            error,
            "airfoil file many.polar, line 2999: there are more than 999 Reynolds numbers; leave some out"
        );
    }
}
