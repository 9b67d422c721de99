//! Records of numbers as Fortran programs write and read them: in columns of seven characters
//! (10F7.0, continued as 7X,9F7.0), or free where a line does not keep to the columns.
//!
//! In columns, numbers may touch each other, and an empty column before the end of the line is 0.
//! Free numbers stand between blanks, tabs, commas or semicolons. A D may begin an exponent.

use crate::text_file::{excerpt, push};
use std::{iter::Enumerate, str::Lines};

/// Characters of a column.
const WIDTH: usize = 7;
/// Maximum number of values in a line, besides the angle.
const VALUES_PER_LINE: usize = 9;

/// A number and its place in the file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Number {
    /// Finite.
    pub value: f64,
    /// From 1.
    pub line: usize,
    /// From 1.
    pub column: usize,
}

/// Line and column, from 1, and what is wrong there.
pub type Problem = (usize, usize, String);

/// The lines of a text that are not blank, read one after the other.
#[derive(Clone)]
pub struct Records<'a> {
    /// The lines to come.
    lines: Enumerate<Lines<'a>>,
    /// Number of the last line that was read, from 1.
    last: usize,
}

/// The contents of a record: an angle or a label or nothing, then `values` numbers.
#[derive(Debug, Clone, Copy)]
pub struct Layout<'a> {
    /// Whether an angle comes first. Without one, text may stand before the numbers: some files
    /// have a table's name there.
    pub has_angle: bool,
    /// Number of values.
    pub values: usize,
    /// The values' name in errors.
    pub what: &'a str,
}

impl<'a> Records<'a> {
    /// The records of a text.
    pub fn new(text: &'a str) -> Self {
        Self {
            lines: text.lines().enumerate(),
            last: 1,
        }
    }

    /// The next line with its number, from 1. At the end of the file the error names `wanted`.
    pub fn line(&mut self, wanted: &str) -> Result<(usize, &'a str), Problem> {
        let Some((index, line)) = self.lines.find(|(_, line)| !line.trim().is_empty()) else {
            return Err((self.last, 1, format!("the file ends before {wanted}")));
        };
        self.last = index + 1;
        Ok((self.last, line))
    }

    /// The numbers of the next record: the angle, if it has one, and the values. Never empty.
    ///
    /// # Errors
    ///
    /// A word that is not a number, too few or too many numbers, or the end of the file.
    pub fn numbers(&mut self, layout: Layout) -> Result<Vec<Number>, Problem> {
        let begin = self.clone();
        if let Some(numbers) = self.in_columns(layout)? {
            return Ok(numbers);
        }
        *self = begin;
        self.free(layout)
    }

    /// The numbers of a record in columns; none if one of its lines does not keep to the columns.
    fn in_columns(&mut self, layout: Layout) -> Result<Option<Vec<Number>>, Problem> {
        let mut numbers = Vec::new();
        let mut missing = layout.values;
        let mut lead = if layout.has_angle {
            Lead::Angle
        } else {
            Lead::Label
        };
        while missing > 0 {
            let (number, line) = self.line(layout.what)?;
            let here = missing.min(VALUES_PER_LINE);
            let Some(found) = columns(number, line, lead, here) else {
                return Ok(None);
            };
            for value in found {
                keep(&mut numbers, value)?;
            }
            missing -= here;
            lead = Lead::Blank;
        }
        Ok(Some(numbers))
    }

    fn free(&mut self, layout: Layout) -> Result<Vec<Number>, Problem> {
        let wanted = layout.values + usize::from(layout.has_angle);
        let mut numbers = Vec::new();
        // Also of those that are too many.
        let mut count = 0;
        while count < wanted {
            let (line, text) = self.line(layout.what)?;
            let may_be_label = !layout.has_angle && count == 0;
            let is_label = |word: &str| may_be_label && is_label(word);
            for (column, word) in placed_words(text).skip_while(|(_, word)| is_label(word)) {
                let Some(value) = number(word) else {
                    let problem = format!(
                        "`{}` is not a number; {} is expected, in columns of seven characters or between blanks",
                        excerpt(word),
                        layout.what
                    );
                    return Err((line, column, problem));
                };
                count += 1;
                if count <= wanted {
                    let number = Number {
                        value,
                        line,
                        column,
                    };
                    keep(&mut numbers, number)?;
                }
            }
            let is_short = count < wanted && layout.values <= VALUES_PER_LINE;
            if is_short || count > wanted {
                let problem = format!(
                    "{wanted} numbers are expected here, not {count}; {} is missing or one is too many: correct the line, or the counts in the first line",
                    layout.what
                );
                return Err((line, 1, problem));
            }
        }
        Ok(numbers)
    }
}

/// Adds a number to a record.
fn keep(numbers: &mut Vec<Number>, number: Number) -> Result<(), Problem> {
    push(numbers, number, "the numbers of the table")
        .map_err(|error| (number.line, number.column, error.to_string()))
}

/// What the first column of a line holds.
#[derive(Debug, Clone, Copy)]
enum Lead {
    Angle,
    /// Text or nothing.
    Label,
    Blank,
}

/// Whether a word before the numbers is text.
fn is_label(word: &str) -> bool {
    word.starts_with(|c: char| c.is_alphabetic()) && number(word).is_none()
}

/// The numbers of a line in columns, or None if it does not keep to them.
fn columns(number: usize, line: &str, lead: Lead, values: usize) -> Option<Vec<Number>> {
    if line.contains('\t') {
        return None;
    }
    let end = (values + 1) * WIDTH;
    // One more tells that the line is too long.
    let text: Vec<char> = line.trim_end().chars().take(end + 1).collect();
    let mut numbers = Vec::new();
    for place in 0..=values {
        // In a line that ends before the column a number is missing, not blank.
        let rest = text.get(place * WIDTH..)?;
        let field: String = rest.iter().take(WIDTH).collect();
        let is_blank = field.trim().is_empty();
        if place == 0 {
            match lead {
                Lead::Angle => {}
                Lead::Label if is_blank || is_label(field.trim()) => continue,
                Lead::Blank if is_blank => continue,
                Lead::Label | Lead::Blank => return None,
            }
        }
        let before = field.chars().take_while(|c| c.is_whitespace()).count();
        let value = if is_blank && !rest.is_empty() {
            0.0
        } else {
            self::number(field.trim())?
        };
        numbers.push(Number {
            value,
            line: number,
            column: place * WIDTH + 1 + if is_blank { 0 } else { before },
        });
    }
    text.len().le(&end).then_some(numbers)
}

/// A finite number as Fortran writes it: none for `nan` and for one that overflows.
pub fn number(text: &str) -> Option<f64> {
    let value = text
        .parse()
        .or_else(|_| text.replace(['d', 'D'], "e").parse());
    value.ok().filter(|v: &f64| v.is_finite())
}

/// Whether a character stands between words.
pub fn is_separator(character: char) -> bool {
    character.is_whitespace() || character == ',' || character == ';'
}

/// The words between separators.
pub fn words(content: &str) -> impl Iterator<Item = &str> {
    content.split(is_separator).filter(|word| !word.is_empty())
}

/// The words between separators, with their columns from 1.
pub fn placed_words(content: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut rest = content;
    let mut column = 1;
    std::iter::from_fn(move || {
        let word = rest.trim_start_matches(is_separator);
        column += rest[..rest.len() - word.len()].chars().count();
        let length = word.find(is_separator).unwrap_or(word.len());
        let (found, after) = word.split_at(length);
        let place = column;
        rest = after;
        column += found.chars().count();
        (!found.is_empty()).then_some((place, found))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(line: &str, has_angle: bool, values: usize) -> Result<Vec<f64>, Problem> {
        let layout = Layout {
            has_angle,
            values,
            what: "a value",
        };
        let numbers = Records::new(line).numbers(layout)?;
        Ok(numbers.iter().map(|n| n.value).collect())
    }

    #[test]
    fn columns_come_first_and_free_numbers_where_a_line_breaks_them() {
        for (line, expected) in [
            (" -10.00   0.12  -0.50", [-10.0, 0.12, -0.5]),
            ("-180.00-0.1234-1.0000", [-180.0, -0.1234, -1.0]),
            (" -10.00         -0.50", [-10.0, 0.0, -0.5]),
            ("          0.12  -0.50", [0.0, 0.12, -0.5]),
            ("  10      1   1.5D-1 ", [10.0, 1.0, 0.15]),
            ("-10 .12 -.5", [-10.0, 0.12, -0.5]),
            ("-10\t.12\t-.5", [-10.0, 0.12, -0.5]),
            ("-10, 0.12, -0.5", [-10.0, 0.12, -0.5]),
            ("   -10.00000  0.12000  -0.50000", [-10.0, 0.12, -0.5]),
            ("0.000000 1.234567 7.654321", [0.0, 1.234567, 7.654321]),
        ] {
            assert_eq!(values(line, true, 2).unwrap(), expected, "{line}");
        }
        for line in [
            "              0.80",
            "CL             0.80",
            "MACH NO   0.00   0.80",
            "CL\t0\t.8",
            "0 0.8",
        ] {
            assert_eq!(values(line, false, 2).unwrap(), [0.0, 0.8], "{line}");
        }
    }

    #[test]
    fn a_line_with_too_few_or_too_many_numbers_is_refused() {
        for (line, part) in [
            (" -10.00   0.12", "3 numbers are expected here, not 2"),
            (
                " -10.00   0.12  -0.50   0.30",
                "3 numbers are expected here, not 4",
            ),
            (" -10.00   0.12  -o.50", "`-o.50` is not a number"),
            (" -10.00   0.12    nan", "`nan` is not a number"),
        ] {
            let (number, _, problem) = values(line, true, 2).unwrap_err();
            assert!(number == 1 && problem.contains(part), "{line}: {problem}");
        }
    }
}
