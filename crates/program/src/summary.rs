//! The summary of the model's accuracy, a Markdown table between two marks in the README. The
//! validation writes it there, and the documentation in the FMU shows it.

use crate::{Failure, files::read_text, sources};
use std::path::PathBuf;

const MARK: &str = "<!-- measured -->";

/// The README, in the source tree that this program was built from.
pub fn readme() -> PathBuf {
    sources().join("README.md")
}

/// The summary, a Markdown table.
pub fn read() -> Result<String, Failure> {
    let text = read_text(&readme())?;
    split(&text).map(|(_, summary, _)| summary.trim().to_owned())
}

/// The text of the README with a new summary.
pub fn replaced(summary: &str) -> Result<String, Failure> {
    let text = read_text(&readme())?;
    let (before, _, after) = split(&text)?;
    Ok(format!("{before}{MARK}\n{}\n{MARK}{after}", summary.trim()))
}

/// The text before the summary, the summary, and the text after it.
fn split(text: &str) -> Result<(&str, &str, &str), Failure> {
    let mut parts = text.split(MARK);
    match (parts.next(), parts.next(), parts.next(), parts.next()) {
        (Some(before), Some(summary), Some(after), None) => Ok((before, summary, after)),
        _ => Err(Failure(format!(
            "README.md must have exactly two lines `{MARK}`; put them before and after the summary of the validation"
        ))),
    }
}

/// A Markdown table as HTML.
pub fn html(table: &str) -> String {
    let mut rows = table.lines().map(cells);
    let mut html = String::from("<table>\n");
    if let Some(header) = rows.next() {
        html += &row(&header, "th");
    }
    // The second line only gives the alignment of the columns.
    for cells in rows.skip(1) {
        html += &row(&cells, "td");
    }
    html + "</table>"
}

fn cells(line: &str) -> Vec<String> {
    let inner = line.trim().trim_matches('|');
    inner
        .split('|')
        .map(|cell| cell_html(cell.trim()))
        .collect()
}

/// The HTML of a cell. Text between two backticks is code.
fn cell_html(cell: &str) -> String {
    let escaped = cell
        .replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;");
    let mut html = String::new();
    for (i, part) in escaped.split('`').enumerate() {
        if i % 2 == 1 {
            html += &format!("<code>{part}</code>");
        } else {
            html += part;
        }
    }
    html
}

fn row(cells: &[String], tag: &str) -> String {
    let cells: String = cells
        .iter()
        .map(|cell| format!("<{tag}>{cell}</{tag}>"))
        .collect();
    format!("<tr>{cells}</tr>\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_markdown_table_becomes_html() {
        let table = "| case | worst |\n| --- | ---: |\n| A & B, `drees` | +1.0 % |";
        assert_eq!(
            html(table),
            "<table>\n<tr><th>case</th><th>worst</th></tr>\n\
             <tr><td>A &amp; B, <code>drees</code></td><td>+1.0 %</td></tr>\n</table>"
        );
    }

    #[test]
    fn the_summary_is_the_text_between_two_marks() {
        let text = format!("a\n{MARK}\nold\n{MARK}\nb");
        assert_eq!(split(&text).unwrap(), ("a\n", "\nold\n", "\nb"));
        assert!(split("no mark").is_err());
        assert!(split(&format!("{MARK}{MARK}{MARK}")).is_err());
    }
}
