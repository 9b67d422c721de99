//! The text of a `.polar` file.

use super::{Block, By, extend::How};
use std::fmt::Write;

/// What is written into a file.
pub struct File<'a> {
    pub name: &'a str,
    pub by: By,
    /// What was read, one sentence for each polar.
    pub sources: &'a [String],
    pub notes: &'a [String],
    /// How rows were added; none if there are none.
    pub how: Option<&'a How>,
    pub blocks: &'a [Block],
}

/// Columns at which comments wrap.
const WIDTH: usize = 100;

impl File<'_> {
    /// The word that begins a block.
    pub fn word(&self) -> &'static str {
        match self.by {
            By::Reynolds => "reynolds",
            By::Mach => "mach",
        }
    }

    /// The text of the file.
    pub fn text(&self) -> String {
        let mut text = String::new();
        let version = env!("CARGO_PKG_VERSION");
        comment(
            &mut text,
            &format!("Made by helicopter-rotor polar {version} of"),
        );
        for source in self.sources {
            comment(&mut text, &format!("- {source}"));
        }
        for note in self.notes {
            comment(&mut text, &format!("Note: {note}."));
        }
        if let Some(how) = self.how {
            comment(
                &mut text,
                &format!(
                    "Rows that end in \"# extended\" are not data. They follow {}",
                    how.in_words()
                ),
            );
        }
        text += "polar 1\n";
        let name: String = self
            .name
            .chars()
            .filter(|c| !c.is_control() && *c != '#')
            .collect();
        // Writing to a String cannot fail.
        let _ = writeln!(text, "name {}", name.trim());
        for block in self.blocks {
            let _ = writeln!(text, "{} {}", self.word(), block.number);
            text += "# alpha_deg        cl        cd\n";
            for row in &block.rows {
                let (point, mark) = (
                    &row.point,
                    if row.is_extended { "  # extended" } else { "" },
                );
                let (alpha, lift, drag) = if row.is_extended {
                    let rounded = |value: f64| format!("{:.5}", value + 0.0);
                    (
                        point.alpha.to_string(),
                        rounded(point.lift),
                        rounded(point.drag),
                    )
                } else {
                    (
                        point.alpha.to_string(),
                        point.lift.to_string(),
                        point.drag.to_string(),
                    )
                };
                let _ = writeln!(text, "{alpha:>11} {lift:>9} {drag:>9}{mark}");
            }
        }
        text
    }
}

/// Adds a comment, wrapped between words.
fn comment(text: &mut String, sentence: &str) {
    let mut line = String::from("#");
    for word in sentence.split_whitespace() {
        if line.len() + 1 + word.len() > WIDTH && line.len() > 1 {
            text.push_str(&line);
            text.push('\n');
            line = String::from("#");
        }
        line.push(' ');
        line.push_str(word);
    }
    text.push_str(&line);
    text.push('\n');
}
