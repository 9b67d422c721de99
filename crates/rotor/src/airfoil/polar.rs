//! The `.polar` text format: polars by Reynolds number.
//!
//! ```text
//! # a comment, to the end of the line
//! polar 1                       format and its version
//! name NACA 0015                free text
//! reynolds 242000               a block for each Reynolds number, increasing
//! -180  0.00  0.03              angle of attack in deg, lift, drag [, moment: not used]
//! ...
//!  180  0.00  0.03
//! ```
//!
//! The angle increases strictly from -180 to 180 deg, where the values of both ends agree; drag is
//! never negative. Interpolation is linear in angle and in ln Re.

use super::{
    Airfoil, AirfoilError, Axis, Coefficient, Data, Layers, Table, TableError,
    formats::{Format, has_extension},
    layers::check_count,
};
use crate::text_file::{excerpt, push};

/// A file is in this format if its name ends in `.polar`.
pub const FORMAT: Format = Format {
    detects: |path, _| has_extension(path, "polar"),
    parse,
};

/// What is wrong, and in which line (from 1).
type Problem = (usize, String);

/// A row and its line.
#[derive(Debug)]
struct Row {
    line: usize,
    /// deg.
    alpha: f64,
    lift: f64,
    drag: f64,
}

/// The polar at one Reynolds number.
#[derive(Debug)]
struct Block {
    /// Line of its first word, `reynolds`.
    line: usize,
    reynolds: f64,
    rows: Vec<Row>,
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
    let (name, blocks) = blocks(text)?;
    for block in &blocks {
        block.check_complete()?;
    }
    let table = |coefficient: Coefficient, column: fn(&Row) -> f64| {
        let numbers = blocks.iter().map(|block| block.reynolds);
        let layers = Layers::try_new(Axis::Reynolds, numbers)
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

/// The name and the blocks, one or more, as they stand in the file.
fn blocks(text: &str) -> Result<(String, Vec<Block>), Problem> {
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty());
    match lines.next() {
        Some((_, "polar 1")) => {}
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
        let (word, rest) = content
            .split_once(char::is_whitespace)
            .unwrap_or((content, ""));
        match (word, blocks.last_mut()) {
            ("name", _) => name = excerpt(rest.trim()),
            ("reynolds", _) => {
                let block = Block {
                    line,
                    reynolds: number(rest).map_err(|problem| (line, problem))?,
                    rows: Vec::new(),
                };
                check_count(Axis::Reynolds, blocks.len() + 1)
                    .map_err(|problem| (line, problem.to_string()))?;
                push(&mut blocks, block, "the blocks")
                    .map_err(|problem| (line, problem.to_string()))?;
            }
            (_, Some(block)) => {
                let row = row(line, content)?;
                push(&mut block.rows, row, "the rows")
                    .map_err(|problem| (line, problem.to_string()))?;
            }
            (word, None) => {
                let problem = format!(
                    "`{}` before the first `reynolds` line; only `name` may stand there",
                    excerpt(word)
                );
                return Err((line, problem));
            }
        }
    }
    if blocks.is_empty() {
        return Err((last_line, "there is no `reynolds` block".into()));
    }
    Ok((name, blocks))
}

fn row(line: usize, content: &str) -> Result<Row, Problem> {
    let mut values = [0.0; 4];
    let mut count = 0;
    for word in content.split_whitespace() {
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
        let reynolds = self.reynolds;
        let Some((first, last)) = self.rows.first().zip(self.rows.last()) else {
            let problem = format!("the block of Reynolds number {reynolds} has no rows");
            return Err((self.line, problem));
        };
        let is_circle = (first.alpha, last.alpha) == (-180.0, 180.0);
        if is_circle && (first.lift, first.drag) != (last.lift, last.drag) {
            let problem = format!(
                "the block of Reynolds number {reynolds} has other values at -180 than at 180 deg, which is the same angle"
            );
            return Err((last.line, problem));
        }
        Ok(())
    }
}

/// A finite number, which `nan` and `inf` are not.
fn number(text: &str) -> Result<f64, String> {
    let value: Option<f64> = text.trim().parse().ok().filter(|v: &f64| v.is_finite());
    value.ok_or_else(|| format!("`{}` is not a number", excerpt(text.trim())))
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = "# title\npolar 1\nname Test 12\nreynolds 1e5\n-180 0 0.02\n0 0 0.01 # note\n10 1 0.02 -0.1\n180 0 0.02\n";

    #[test]
    fn a_good_file_is_read() {
        let airfoil = parse(GOOD, "good.polar").unwrap();
        assert_eq!(airfoil.name(), "Test 12");
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
