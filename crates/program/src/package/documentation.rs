//! The documentation page: its template with the version, the tables of variables and the summary
//! of the accuracy.

use crate::{Failure, summary};
use helicopter_rotor::description::VARIABLES_HTML;

/// The marks in the template that are replaced.
const VARIABLES: &str = "<!-- variables -->";
const ACCURACY: &str = "<!-- accuracy -->";
const VERSION: &str = "<!-- version -->";

/// The page from its template (modelDescription/documentation/index.html).
pub fn page(template: &[u8]) -> Result<String, Failure> {
    let template = String::from_utf8_lossy(template);
    for mark in [VARIABLES, ACCURACY, VERSION] {
        if !template.contains(mark) {
            return Err(Failure(format!(
                "documentation/index.html does not contain `{mark}`; add it where its content belongs"
            )));
        }
    }
    Ok(template
        .replace(VARIABLES, VARIABLES_HTML)
        .replace(ACCURACY, &summary::html(&summary::read()?))
        .replace(VERSION, env!("CARGO_PKG_VERSION")))
}
