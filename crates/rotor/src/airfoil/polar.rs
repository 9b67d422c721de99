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
//! The angle increases strictly from -180 to 180, where the values of both ends agree; drag is
//! never negative. Interpolation is linear in angle and in ln Re.

use super::{Airfoil, AirfoilError, Axis, Curve, Data, Table};

/// One row: angle of attack in deg, lift and drag coefficients.
type Row = (f64, f64, f64);

/// Reads the text of a `.polar` file; `file` is its name for errors.
pub fn parse(text: &str, file: &str) -> Result<Airfoil, AirfoilError> {
    let fail = |line: usize, problem: String| AirfoilError::Malformed {
        file: file.to_owned(),
        line,
        problem,
    };
    let mut lines = text
        .lines()
        .enumerate()
        .map(|(i, line)| (i + 1, line.split('#').next().unwrap_or("").trim()))
        .filter(|(_, line)| !line.is_empty());

    match lines.next() {
        Some((_, "polar 1")) => {}
        Some((line, found)) => {
            return Err(fail(
                line,
                format!("the file must begin with `polar 1`, not `{found}`"),
            ));
        }
        None => {
            return Err(fail(
                1,
                "the file is empty; it must begin with `polar 1`".into(),
            ));
        }
    }

    let mut name = String::new();
    let mut blocks: Vec<(f64, Vec<Row>)> = Vec::new();
    let mut last_line = 1;
    for (line, content) in lines {
        last_line = line;
        let (word, rest) = content
            .split_once(char::is_whitespace)
            .unwrap_or((content, ""));
        match word {
            "name" => name = rest.trim().to_owned(),
            "reynolds" => {
                close(blocks.last()).map_err(|problem| fail(line, problem))?;
                let reynolds = number(rest).map_err(|problem| fail(line, problem))?;
                if reynolds < 1.0 {
                    return Err(fail(
                        line,
                        format!("Reynolds number {reynolds} must be 1 or more"),
                    ));
                }
                if let Some((previous, _)) = blocks.last()
                    && reynolds <= *previous
                {
                    return Err(fail(
                        line,
                        format!(
                            "Reynolds number {reynolds} must be above the block before ({previous})"
                        ),
                    ));
                }
                blocks.push((reynolds, Vec::new()));
            }
            _ => {
                let Some((_, rows)) = blocks.last_mut() else {
                    return Err(fail(
                        line,
                        format!(
                            "`{word}` before the first `reynolds` line; only `name` may stand there"
                        ),
                    ));
                };
                let next = row(content, rows.last()).map_err(|problem| fail(line, problem))?;
                rows.push(next);
            }
        }
    }
    if blocks.is_empty() {
        return Err(fail(last_line, "there is no `reynolds` block".into()));
    }
    close(blocks.last()).map_err(|problem| fail(last_line, problem))?;

    let table = |column: fn(&Row) -> f64| {
        let layers = blocks.iter().map(|(reynolds, rows)| {
            let points: Vec<(f64, f64)> = rows.iter().map(|r| (r.0, column(r))).collect();
            (*reynolds, Curve::from_degrees(&points))
        });
        Table::new(Axis::Reynolds, layers.collect())
    };
    Ok(Airfoil {
        data: Data::Tables {
            lift: table(|r| r.1),
            drag: table(|r| r.2),
        },
        name,
    })
}

fn row(content: &str, previous: Option<&Row>) -> Result<Row, String> {
    let values = content
        .split_whitespace()
        .map(number)
        .collect::<Result<Vec<f64>, String>>()?;
    let (alpha, lift, drag) = match values[..] {
        [alpha, lift, drag] | [alpha, lift, drag, _] => (alpha, lift, drag),
        _ => {
            return Err(format!(
                "a row has 3 or 4 numbers (angle, lift, drag, moment), this one has {}",
                values.len()
            ));
        }
    };
    if drag < 0.0 {
        return Err(format!("drag coefficient {drag} must not be negative"));
    }
    match previous {
        None if alpha != -180.0 => Err(format!(
            "the first angle of a block must be -180 deg, not {alpha}"
        )),
        Some((before, ..)) if alpha <= *before => Err(format!(
            "angle {alpha} deg must be above the row before ({before})"
        )),
        _ if alpha > 180.0 => Err(format!("angle {alpha} deg is beyond 180")),
        _ => Ok((alpha, lift, drag)),
    }
}

/// A block is complete when it ends at 180 deg with the values that it began with.
fn close(block: Option<&(f64, Vec<Row>)>) -> Result<(), String> {
    let Some((reynolds, rows)) = block else {
        return Ok(());
    };
    let Some((first, last)) = rows.first().zip(rows.last()) else {
        return Err(format!(
            "the block of Reynolds number {reynolds} has no rows"
        ));
    };
    if last.0 != 180.0 {
        return Err(format!(
            "the block of Reynolds number {reynolds} ends at {} deg; it must end at 180",
            last.0
        ));
    }
    if (first.1, first.2) != (last.1, last.2) {
        return Err(format!(
            "the block of Reynolds number {reynolds} has other values at -180 than at 180 deg, which is the same angle"
        ));
    }
    Ok(())
}

/// A finite number, which `nan` and `inf` are not.
fn number(text: &str) -> Result<f64, String> {
    let value: Option<f64> = text.trim().parse().ok().filter(|v: &f64| v.is_finite());
    value.ok_or_else(|| format!("`{}` is not a number", text.trim()))
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
            ("reynolds 1e5", "reynolds 0", 4, "1 or more"),
            ("reynolds 1e5", "reynolds fast", 4, "`fast` is not a number"),
            ("-180 0 0.02", "-170 0 0.02", 5, "must be -180"),
            ("0 0 0.01", "-190 0 0.01", 6, "must be above the row before"),
            ("10 1 0.02 -0.1", "10 1", 7, "this one has 2"),
            ("10 1 0.02 -0.1", "10 1 -0.02", 7, "must not be negative"),
            ("10 1 0.02 -0.1", "10 nan 0.02", 7, "`nan` is not a number"),
            ("180 0 0.02\n", "190 0 0.02\n", 5, "must be -180"),
            ("\n180 0 0.02\n", "\n", 7, "must end at 180"),
            (
                "\n180 0 0.02\n",
                "\n180 0 0.03\n",
                8,
                "other values at -180",
            ),
            (
                "\n180 0 0.02\n",
                "\n180 0 0.02\nreynolds 1e4\n",
                9,
                "above the block before",
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
}
