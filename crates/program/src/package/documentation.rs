//! The documentation page: its text with the table of variables and the summary of the accuracy put
//! in.

use crate::{Failure, summary};
use helicopter_rotor::description::VARIABLES_HTML;

const PLACE: &str = "<!-- variables -->";
const ACCURACY_PLACE: &str = "<!-- accuracy -->";
const VERSION_PLACE: &str = "<!-- version -->";

/// The page from its template (modelDescription/documentation/index.html).
pub fn page(template: &[u8]) -> Result<String, Failure> {
    let text = String::from_utf8_lossy(template);
    for place in [PLACE, ACCURACY_PLACE, VERSION_PLACE] {
        if !text.contains(place) {
            return Err(Failure(format!(
                "documentation/index.html has no place `{place}`"
            )));
        }
    }
    Ok(text
        .replace(PLACE, VARIABLES_HTML)
        .replace(ACCURACY_PLACE, &summary::html(&summary::read()?))
        .replace(VERSION_PLACE, env!("CARGO_PKG_VERSION")))
}
