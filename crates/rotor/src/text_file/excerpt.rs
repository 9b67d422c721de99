//! What messages quote of a file.

/// Maximum number of characters that a message quotes at one place.
const MAX_QUOTED: usize = 80;

/// A text of a file for a message: its beginning, if it is long, with an ellipsis. Control
/// characters, which could do anything to the terminal that shows the message, are replaced.
pub fn excerpt(text: &str) -> String {
    let shown = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    let is_long = text.chars().nth(MAX_QUOTED).is_some();
    let kept = if is_long { MAX_QUOTED - 1 } else { MAX_QUOTED };
    let mut excerpt: String = text.chars().take(kept).map(shown).collect();
    if is_long {
        excerpt.push('…');
    }
    excerpt
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_text_ends_in_an_ellipsis_at_80_characters() {
        for length in [0, 1, 79, 80] {
            let text = "ü".repeat(length);
            assert_eq!(excerpt(&text), text);
        }
        for length in [81, 1_000_000] {
            let expected = "ü".repeat(79) + "…";
            assert_eq!(excerpt(&"ü".repeat(length)), expected);
        }
    }

    #[test]
    fn control_characters_do_not_get_through() {
        let text = "a\u{1b}[2J\0\u{85}\nb";
        assert_eq!(excerpt(text), "a\u{fffd}[2J\u{fffd}\u{fffd}\u{fffd}b");
    }
}
