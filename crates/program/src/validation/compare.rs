//! Compares two texts with numbers, within the rounding of the printed digits.

/// The pairs of lines that differ: in a word, or in a number by more than one unit of its last
/// printed digit. If one text has more lines, the other side of the pair is empty.
pub fn differences<'a>(first: &'a str, second: &'a str) -> Vec<(&'a str, &'a str)> {
    let (mut a, mut b) = (first.lines(), second.lines());
    let mut found = Vec::new();
    loop {
        let pair = match (a.next(), b.next()) {
            (None, None) => return found,
            (x, y) => (x.unwrap_or(""), y.unwrap_or("")),
        };
        if !same_line(pair.0, pair.1) {
            found.push(pair);
        }
    }
}

fn same_line(a: &str, b: &str) -> bool {
    let (mut x, mut y) = (a.split_whitespace(), b.split_whitespace());
    loop {
        match (x.next(), y.next()) {
            (None, None) => return true,
            (Some(p), Some(q)) if same_word(p, q) => {}
            _ => return false,
        }
    }
}

fn same_word(a: &str, b: &str) -> bool {
    if a == b {
        return true;
    }
    let bare = |word: &str| {
        word.trim_matches(|c: char| "()*,;:%`".contains(c))
            .to_owned()
    };
    let (a, b) = (bare(a), bare(b));
    match (a.parse::<f64>(), b.parse::<f64>()) {
        // Each of the two numbers is rounded by up to half a unit.
        (Ok(x), Ok(y)) => (x - y).abs() <= 1.001 * last_digit(&a).max(last_digit(&b)),
        _ => false,
    }
}

/// The value of one unit of the last digit of a printed number.
#[allow(clippy::disallowed_methods)] // a tolerance
fn last_digit(number: &str) -> f64 {
    let (mantissa, exponent) = number.split_once('e').unwrap_or((number, "0"));
    let decimals = mantissa
        .split_once('.')
        .map_or(0, |(_, digits)| digits.len());
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let exponent = exponent - i32::try_from(decimals).unwrap_or(0);
    format!("1e{exponent}").parse().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_may_differ_by_a_unit_of_their_last_digit() {
        for (a, b) in [
            ("| CT | +3.0 % |", "| CT | +3.1 % |"),
            ("| x | -0.0 |", "| x | +0.1 |"),
            ("(0.123 m)", "(0.124 m)"),
            ("5.0012e-03", "5.0013e-03"),
            ("| 40 |", "| 41 |"),
        ] {
            assert_eq!(differences(a, b), []);
            assert_eq!(differences(b, a), []);
        }
        for (a, b) in [
            ("| CT | +3.0 % |", "| CT | +3.2 % |"),
            ("| CT | +3.0 % |", "| CQ | +3.0 % |"),
            ("| CT | +3.0 % |", "| CT | +3.0 % | 1 |"),
            ("5.0012e-03", "5.0014e-03"),
            ("3.0 none", "3.0 4.0"),
            ("one line", "one line\nand another"),
        ] {
            assert_eq!(differences(a, b).len(), 1, "{a} {b}");
        }
    }
}
