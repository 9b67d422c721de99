//! The known name that was probably meant.

/// Longest name that is compared, in bytes.
const LONGEST: usize = 64;

/// The known name that is nearest to the given one, if any is near: by the letters that differ, or
/// because one contains the other.
pub fn nearest<'a>(given: &str, known: impl Iterator<Item = &'a str> + Clone) -> Option<&'a str> {
    if given.len() > LONGEST || given.is_empty() {
        return None;
    }
    let plain = |name: &str| name.to_lowercase().replace(['_', '-', ' '], "");
    let given = plain(given);
    let by_letters = known.clone();
    let by_letters = by_letters.map(|name| (strsim::osa_distance(&given, &plain(name)), name));
    let near = by_letters
        .min()
        .filter(|(distance, _)| *distance <= 1 + given.len() / 4);
    let contains = |name: &&str| {
        let name = plain(name);
        given.len() >= 4 && (name.contains(&given) || given.contains(&name) && name.len() >= 4)
    };
    near.map(|(_, name)| name)
        .or_else(|| known.filter(contains).min_by_key(|name| name.len()))
}

/// For a message of the parser about an unknown name, the end of a sentence that names the nearest
/// known one; empty for other messages, or if none is near.
pub(super) fn hint(message: &str) -> String {
    let is_unknown = message.starts_with("unknown ");
    let split = message.rsplit_once(", expected ");
    let Some((before, expected)) = split.filter(|_| is_unknown) else {
        return String::new();
    };
    let given = before.split('`').nth(1).unwrap_or_default();
    let known = expected.split('`').skip(1).step_by(2);
    nearest(given, known).map_or_else(String::new, |name| format!("; did you mean `{name}`?"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slips_abbreviations_and_other_spellings_find_the_name() {
        let known = ["numberOfBlades", "radius", "rotation", "hingeOffset", "rpm"];
        for (given, meant) in [
            ("raduis", Some("radius")),
            ("Radius", Some("radius")),
            ("hinge_offset", Some("hingeOffset")),
            ("blades", Some("numberOfBlades")),
            ("offset", Some("hingeOffset")),
            ("rotationDirection", Some("rotation")),
            ("RPM", Some("rpm")),
            ("wingspan", None),
            ("", None),
        ] {
            assert_eq!(nearest(given, known.into_iter()), meant, "{given}");
        }
    }
}
