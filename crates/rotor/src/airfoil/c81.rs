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
//! Files of other programs and files that people have edited:
//!
//! - a line that does not keep to the columns is read as free numbers (see `records`), and text may
//!   stand before the Mach numbers of a table;
//! - the counts may follow the name anywhere in the first line, or begin one column off; without a
//!   moment table four counts will do in place of six;
//! - blank lines and, before the first line, lines that begin with `#` do not count: MBDyn's free
//!   format begins with `# FREE FORMAT`;
//! - DUST and OpenCOPTER begin with three lines of numbers, the first of which is the number of
//!   Reynolds numbers, a comment, and a line with Reynolds and Mach number (`read_c81_table` in
//!   `mod_c81` of DUST).

use super::{
    Airfoil, AirfoilError, Axis, Coefficient, CurveProblem, Data, Layers, Table, TableError,
    formats::{Format, has_extension},
    layers::MAX_LAYERS,
    records::{self, Layout, Number, Problem, Records, is_separator, placed_words, words},
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

/// Maximum number of Reynolds numbers of a file.
const MAX_SETS: usize = 99;

/// Lines between the tables of two Reynolds numbers of a DUST file, with the first line of the
/// second.
const MAX_LINES_BETWEEN: usize = 5;

/// Lower numbers before the tables of a DUST file are no Reynolds number.
const MIN_REYNOLDS: f64 = 1000.0;

/// The first line.
#[derive(Debug, Clone, PartialEq)]
struct Header {
    name: String,
    /// ML, NL, MD, ND.
    counts: [usize; NEEDED_COUNTS],
    /// MM, NM; 0 if the line does not have them.
    moment: [usize; 2],
}

/// The numbers of a table as they stand in the file.
#[derive(Debug)]
pub struct Numbers {
    /// The Mach numbers, one or more.
    pub machs: Vec<Number>,
    /// An angle and a value for each Mach number.
    pub rows: Vec<Vec<Number>>,
}

/// The tables of lift and drag at one Reynolds number.
#[derive(Debug)]
pub struct Set<T> {
    /// The section's name.
    pub name: String,
    /// Its Reynolds number, if the file has one.
    pub reynolds: Option<f64>,
    /// The lift.
    pub lift: T,
    /// The drag.
    pub drag: T,
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
    // Before the tables take memory.
    if let Some(count) = preface(&mut Records::new(text)).filter(|count| *count > 1) {
        let problem = format!(
            "the file has tables for {count} Reynolds numbers, of which one can be read; `helicopter-rotor polar` takes one of them, or one Mach number, out of the file"
        );
        return Err((1, 1, problem));
    }
    let sets = sets(text, |coefficient, numbers| table(coefficient, &numbers))?;
    let set = sets.into_iter().next();
    let Set {
        name, lift, drag, ..
    } = set.ok_or((1, 1, "the file has no tables".to_owned()))?;
    Ok(Airfoil::new(name, Data::Tables { lift, drag }))
}

/// The tables of a file, one set for each Reynolds number, at least one. `made_of` makes a table of
/// its numbers.
pub fn sets<T>(
    text: &str,
    made_of: impl Fn(Coefficient, Numbers) -> Result<T, Problem>,
) -> Result<Vec<Set<T>>, Problem> {
    let mut records = Records::new(text);
    let Some(count) = preface(&mut records) else {
        let header = first_line(&mut records)?;
        return Ok(vec![set(&mut records, header, None, false, &made_of)?]);
    };
    let mut sets = Vec::new();
    for i in 1..=count {
        let (header, reynolds) = next_header(&mut records)?;
        let has_next = i < count;
        sets.push(set(&mut records, header, reynolds, has_next, &made_of)?);
    }
    Ok(sets)
}

/// Whether a text begins as a C81 file does.
pub fn begins(text: &str) -> bool {
    let mut records = Records::new(text);
    if preface(&mut records).is_some() {
        return true;
    }
    first_line(&mut records).is_ok_and(|(_, line)| headers(line).next().is_some())
}

/// The first line that is no comment.
fn first_line<'a>(records: &mut Records<'a>) -> Result<(usize, &'a str), Problem> {
    loop {
        let line = records.line("the header")?;
        if !line.1.trim_start().starts_with('#') {
            return Ok(line);
        }
    }
}

/// The number of Reynolds numbers by the three lines with which DUST begins a file; none and no
/// line read if the file begins otherwise.
fn preface(records: &mut Records) -> Option<usize> {
    let mut ahead = records.clone();
    let (_, first) = ahead.line("the header").ok()?;
    let is_whole = |text: &str| text.len() <= 2 && text.bytes().all(|b| b.is_ascii_digit());
    let mut count = 0;
    for (i, word) in words(first).enumerate() {
        if i == 3 || !is_whole(word) {
            return None;
        }
        if i == 0 {
            count = word.parse().ok().filter(|n| (1..=MAX_SETS).contains(n))?;
        }
    }
    for _ in 0..2 {
        let (_, line) = ahead.line("the header").ok()?;
        if words(line).count() > 2 || words(line).any(|word| records::number(word).is_none()) {
            return None;
        }
    }
    *records = ahead;
    Some(count)
}

/// The next first line of a set of tables in a DUST file, and the Reynolds number before it.
fn next_header<'a>(records: &mut Records<'a>) -> Result<((usize, &'a str), Option<f64>), Problem> {
    let mut reynolds = None;
    for _ in 0..MAX_LINES_BETWEEN {
        let (line, text) = records.line("the line with the counts of the tables")?;
        if headers(text).next().is_some() {
            return Ok(((line, text), reynolds));
        }
        let number = words(text).next().and_then(records::number);
        reynolds = number.filter(|re| *re >= MIN_REYNOLDS).or(reynolds);
    }
    let (line, _) = records.line("the line with the counts of the tables")?;
    let problem = "the file begins as DUST's do, but no line with the counts ML, NL, MD, ND, MM and NM, two digits each, is found before this one".into();
    Err((line, 1, problem))
}

/// Reads a set of tables, of which the first line has been read: with the counts that fit.
fn set<T>(
    records: &mut Records,
    (line, first): (usize, &str),
    reynolds: Option<f64>,
    has_next: bool,
    made_of: &impl Fn(Coefficient, Numbers) -> Result<T, Problem>,
) -> Result<Set<T>, Problem> {
    let mut farthest: Option<Problem> = None;
    for header in headers(first) {
        let mut ahead = records.clone();
        let [lift_machs, lift_angles, drag_machs, drag_angles] = header.counts;
        let tables = numbers(&mut ahead, "lift", lift_machs, lift_angles)
            .and_then(|numbers| made_of(Coefficient::Lift, numbers))
            .and_then(|lift| {
                let numbers = numbers(&mut ahead, "drag", drag_machs, drag_angles)?;
                let drag = made_of(Coefficient::Drag, numbers)?;
                let [machs, angles] = header.moment;
                if has_next && machs > 0 && angles > 0 {
                    self::numbers(&mut ahead, "moment", machs, angles)?;
                }
                Ok((lift, drag))
            });
        match tables {
            Ok((lift, drag)) => {
                *records = ahead;
                return Ok(Set {
                    name: header.name,
                    reynolds,
                    lift,
                    drag,
                });
            }
            Err(problem) => {
                let is_farther = |known: &Problem| (problem.0, problem.1) > (known.0, known.1);
                if farthest.as_ref().is_none_or(is_farther) {
                    farthest = Some(problem);
                }
            }
        }
    }
    Err(farthest.unwrap_or_else(|| no_counts(line, first)))
}

/// The error of a first line without counts: the first of them that is wrong.
fn no_counts(line: usize, first: &str) -> Problem {
    let begin = |i: usize| COUNTS_COLUMN + 2 * i;
    let field = |i: usize| first.chars().skip(begin(i)).take(2).collect::<String>();
    let is_wrong = |i: &usize| count(field(*i).trim()).is_none();
    let wrong = (0..NEEDED_COUNTS).find(is_wrong).unwrap_or(0);
    let found = match field(wrong).trim() {
        "" => "the first line ends without the counts".to_owned(),
        field => format!("`{}` is not a count", excerpt(field)),
    };
    let problem = format!(
        "{found}; columns 31-42 hold ML, NL, MD, ND, MM and NM in two digits each, or the line ends with these numbers between blanks"
    );
    (line, begin(wrong) + 1, problem)
}

fn count(text: &str) -> Option<usize> {
    let is_digits = text.bytes().all(|b| b.is_ascii_digit());
    let value = text.parse().ok().filter(|_| is_digits);
    value.filter(|n| (1..=MAX_COUNT).contains(n))
}

/// The ways to read a first line, the most usual first; none for a row of a table.
fn headers(line: &str) -> impl Iterator<Item = Header> {
    let line = if is_row(line) { "" } else { line };
    let [usual, early, late] = [COUNTS_COLUMN, COUNTS_COLUMN - 1, COUNTS_COLUMN + 1]
        .map(|column| header_in_columns(line, column));
    [usual, free_header(line), early, late]
        .into_iter()
        .flatten()
}

/// Whether a line is a row of a table: only numbers, of which one is negative or two have decimals.
fn is_row(line: &str) -> bool {
    let (mut is_negative, mut decimals) = (false, 0);
    for word in words(line) {
        let Some(value) = records::number(word) else {
            return false;
        };
        is_negative |= value < 0.0;
        decimals += usize::from(word.contains('.'));
    }
    is_negative || decimals > 1
}

/// Counts of two digits behind `begin` characters.
fn header_in_columns(line: &str, begin: usize) -> Option<Header> {
    if line.contains('\t') {
        return None;
    }
    // Where each character and the end begin.
    let places = line.char_indices().map(|(place, _)| place);
    let mut places = places.chain([line.len()]).skip(begin);
    let mut from = places.next()?;
    let name = excerpt(line[..from].trim());
    let mut all = [0; COUNTS];
    for (i, slot) in all.iter_mut().enumerate() {
        // The last field may be short of a character.
        let to = places.by_ref().take(2).last().unwrap_or(from);
        match count(line[from..to].trim()) {
            Some(count) => *slot = count,
            None if i < NEEDED_COUNTS => return None,
            None => {}
        }
        from = to;
    }
    let [
        lift_machs,
        lift_angles,
        drag_machs,
        drag_angles,
        moment @ ..,
    ] = all;
    Some(Header {
        name,
        counts: [lift_machs, lift_angles, drag_machs, drag_angles],
        moment,
    })
}

/// Counts at the end of the line, between blanks or all in one word of two digits each.
fn free_header(line: &str) -> Option<Header> {
    // The last words, as far as they are numbers.
    let mut numbers: Vec<(usize, &str)> = Vec::new();
    for (column, word) in placed_words(line) {
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
    let moment = [NEEDED_COUNTS, NEEDED_COUNTS + 1].map(|i| texts.get(i).and_then(|t| count(t)));
    let end = line.char_indices().nth(begin - 1);
    let name = &line[..end.map_or(line.len(), |(index, _)| index)];
    Some(Header {
        name: excerpt(name.trim_matches(is_separator)),
        counts,
        moment: moment.map(|count| count.unwrap_or(0)),
    })
}

/// Reads a table of so many Mach numbers and angles.
fn numbers(
    records: &mut Records,
    name: &str,
    machs: usize,
    angles: usize,
) -> Result<Numbers, Problem> {
    let machs = records.numbers(Layout {
        has_angle: false,
        values: machs,
        what: &format!("a Mach number of the {name} table"),
    })?;
    let mut rows = Vec::new();
    for _ in 0..angles {
        let row = records.numbers(Layout {
            has_angle: true,
            values: machs.len(),
            what: &format!("a value of the {name} table"),
        })?;
        let begin = row[0];
        push(&mut rows, row, "the rows")
            .map_err(|error| (begin.line, begin.column, error.to_string()))?;
    }
    Ok(Numbers { machs, rows })
}

fn name(coefficient: Coefficient) -> &'static str {
    match coefficient {
        Coefficient::Lift => "lift",
        Coefficient::Drag => "drag",
    }
}

/// The problem at a number.
fn at(number: &Number, problem: String) -> Problem {
    (number.line, number.column, problem)
}

/// The layers of a coefficient at these Mach numbers.
pub fn layers(coefficient: Coefficient, machs: &[Number]) -> Result<Layers, Problem> {
    let name = name(coefficient);
    Layers::try_new(Axis::Mach, machs.iter().map(|n| n.value))
        .map_err(|error| at(&machs[error.layer], format!("{name} table: {error}")))
}

/// The table of a coefficient with these numbers.
fn table(coefficient: Coefficient, Numbers { machs, rows }: &Numbers) -> Result<Table, Problem> {
    let layers = layers(coefficient, machs)?;
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
        let (name, angles) = (name(coefficient), rows.len());
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

    /// The forms of DUST (`read_c81_table`), OpenCOPTER and MBDyn (`c81_data_write_free_format`),
    /// and headers and Mach lines that people have moved.
    #[test]
    fn the_dialects_of_other_programs_are_the_same_file() {
        let good = sampled(&parse(GOOD, "good.c81").unwrap());
        let (first, tables) = GOOD.split_once('\n').unwrap();
        let moments = "          0.00\n-180.00   0.00\n 180.00   0.00\n";
        let free: Vec<String> = tables
            .lines()
            .map(|l| l.split_whitespace().collect::<Vec<_>>().join(" ") + " ")
            .collect();
        let free = free.join("\n");
        for (what, text) in [
            (
                "DUST",
                format!(
                    "1 0 0\n0 1\n0.158 0.158\nCOMMENT#1\n1000000.0    0.200\n 020401030102\n{tables}{moments}"
                ),
            ),
            (
                "DUST with a name in one word and tabs",
                format!(
                    "1 0 0\n0 1\n0.158 0.158\nCOMMENT#1\n  1000000.00 0.2\nSection  020401030102\n{}",
                    free.replace(' ', "\t")
                ),
            ),
            (
                "OpenCOPTER",
                format!("1 0 0\n0\n0\nTAKEN FROM A TUNNEL\n\n{first}\n{tables}{moments}"),
            ),
            (
                "MBDyn, free",
                format!("# FREE FORMAT\nTest section; 2 4 1 3 1 2\n{free}\n0 \n-180 0 \n180 0 \n"),
            ),
            (
                "names of the tables",
                GOOD.replacen("          0.00   0.80", "CL        0.00   0.80", 1),
            ),
            (
                "words before the Mach numbers",
                GOOD.replacen("          0.00   0.80", "MACH NUMBER 0.00 0.80", 1),
            ),
            (
                "a header one column early",
                GOOD.replacen("Test section   ", "Test section  ", 1),
            ),
            (
                "a header one column late",
                GOOD.replacen("Test section   ", "Test section    ", 1),
            ),
            (
                "a header of digits one column early",
                format!("{:29}{}\n{tables}", "Test section 12x", "020401030102"),
            ),
            (
                "a header of digits one column late",
                format!("{:x<31}{}\n{tables}", "Test section ", "020401030102"),
            ),
        ] {
            match parse(&text, "x.c81") {
                Ok(airfoil) => assert_eq!(sampled(&airfoil), good, "{what}"),
                Err(error) => panic!("{what}: {error}"),
            }
        }
    }

    #[test]
    fn tables_for_several_reynolds_numbers_are_found_and_refused_with_what_to_do() {
        let (_, tables) = GOOD.split_once('\n').unwrap();
        let moments = "          0.00\n-180.00   0.00\n 180.00   0.00\n";
        let set = |re: &str| format!("{re}    0.200\n 020401030102\n{tables}{moments}");
        let begin = "2 0 0\n0 1\n0.158 0.158\nCOMMENT#1\n";
        for text in [
            format!("{begin}{}{}", set("1e5"), set("1.0D6")),
            format!("{begin}{}COMMENT#2\n{}", set("1e5"), set("1000000")),
        ] {
            let sets = sets(&text, |_, numbers| Ok(numbers)).unwrap();
            let reynolds: Vec<_> = sets.iter().map(|set| set.reynolds).collect();
            assert_eq!(reynolds, [Some(1e5), Some(1e6)]);
            assert_eq!(sets[1].drag.rows.len(), 3);
            let error = parse(&text, "dust.c81").unwrap_err().to_string();
            assert!(
                error.contains("tables for 2 Reynolds numbers")
                    && error.contains("`helicopter-rotor polar` takes one"),
                "{error}"
            );
        }
        let missing = format!("{begin}{}", set("1e5"));
        let (_, _, problem) = sets(&missing, |_, _| Ok(())).unwrap_err();
        assert!(
            problem.contains("the file ends before the line with the counts"),
            "{problem}"
        );
        let other = "1 0 0\n0 1\n0 0\na\nb\nc\nd\ne\nf\n";
        let error = parse(other, "dust.c81").unwrap_err().to_string();
        assert!(
            error.contains("line 9") && error.contains("begins as DUST's do"),
            "{error}"
        );
    }

    #[test]
    fn a_table_that_ends_before_the_full_circle_is_refused_with_what_to_do() {
        let text = "Test 1 2 1 2\n0.3\n-20 -1\n20 1\n0.3\n-20 0.1\n20 0.1\n";
        let error = parse(text, "short.c81").unwrap_err().to_string();
        assert!(
            error.contains("line 3, column 1: ")
                && error.contains("the first angle must be -180 deg, not -20; `helicopter-rotor polar` extends a file to the full circle"),
            "{error}"
        );
    }

    #[test]
    fn a_first_line_without_counts_is_told_from_one_with_wrong_ones() {
        for (line, part) in [
            (
                "NACA 0012",
                "column 31: the first line ends without the counts; columns 31-42 hold",
            ),
            (
                "NACA 0012                      x 4 1 3 1 2",
                "column 31: `x` is not a count; columns",
            ),
            (
                "NACA 0012                      2 4 O 3 1 2",
                "column 35: `O` is not a count; columns",
            ),
        ] {
            let error = parse(line, "x.c81").unwrap_err().to_string();
            assert!(
                error.contains("line 1, ") && error.contains(part),
                "{error}"
            );
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
            let found = headers(line).next().unwrap();
            assert_eq!((found.name.as_str(), found.counts), (name, [2, 4, 1, 3]));
        }
        for line in [
            "",
            "name",
            "name 1 2 3",
            "name 4 1 3 1 2",
            "name 0 4 1 3 1 2",
            "name 2 4 1 9999999999999999999999",
            "-9.000000000000000000e+01 -7.678535430653904863e-17",
            "-90, -60, -30, 0, 5, 10, 20, 40, 60, 90",
            "0.5 0.25 10 10 10 10",
        ] {
            assert_eq!(headers(line).next(), None, "{line}");
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
