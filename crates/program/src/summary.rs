//! The summary of how well the model does, which stands in the README between two marks: the
//! validation writes it there, and the FMU's own documentation shows it.

use crate::{Failure, failed, sources};
use std::{fs, path::PathBuf};

const MARK: &str = "<!-- measured -->";

/// The README, in the source tree that this program was built from.
pub fn readme() -> PathBuf {
    sources().join("README.md")
}

/// The summary, a Markdown table.
pub fn read() -> Result<String, Failure> {
    let text = read_readme()?;
    around(&text).map(|(_, summary, _)| summary.trim().to_owned())
}

/// The README's text with another summary.
pub fn replaced(summary: &str) -> Result<String, Failure> {
    let text = read_readme()?;
    let (before, _, after) = around(&text)?;
    Ok(format!("{before}{MARK}\n{}\n{MARK}{after}", summary.trim()))
}

fn read_readme() -> Result<String, Failure> {
    let file = readme();
    fs::read_to_string(&file).map_err(failed(format!("cannot read {}", file.display())))
}

/// The text before the summary, the summary, and what comes after.
fn around(text: &str) -> Result<(&str, &str, &str), Failure> {
    let mut parts = text.split(MARK);
    match (parts.next(), parts.next(), parts.next(), parts.next()) {
        (Some(before), Some(summary), Some(after), None) => Ok((before, summary, after)),
        _ => Err(Failure(format!(
            "README.md must have two lines `{MARK}`, between which the summary of the validation stands"
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
    // The second line only says which columns stand to the right.
    for cells in rows.skip(1) {
        html += &row(&cells, "td");
    }
    html + "</table>"
}

fn cells(line: &str) -> Vec<String> {
    let inner = line.trim().trim_matches('|');
    inner.split('|').map(|cell| text(cell.trim())).collect()
}

/// A cell's text, in which every other backtick begins code.
fn text(cell: &str) -> String {
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
    fn the_summary_stands_between_two_marks() {
        let text = format!("a\n{MARK}\nold\n{MARK}\nb");
        assert_eq!(around(&text).unwrap(), ("a\n", "\nold\n", "\nb"));
        assert!(around("no mark").is_err());
        assert!(around(&format!("{MARK}{MARK}{MARK}")).is_err());
    }
}
