//! The documentation page: its template with the version, the tables of variables and the summary
//! of the accuracy.

use crate::{Failure, summary};
use helicopter_rotor::description::VARIABLES_HTML;

/// The marks in the template that are replaced.
const VARIABLES: &str = "<!-- variables -->";
const ACCURACY: &str = "<!-- accuracy -->";
const VERSION: &str = "<!-- version -->";

/// The page for browsers in the archive, beside the documentation page.
pub const PAGE_IN_ARCHIVE: &str = "documentation/rotor.html";
const PAGE: &str = "<!-- page -->";
const LINK: &str = r#"<p><a href="rotor.html">This rotor in your browser</a>: sliders move it, and its disc, loads and power
follow, computed by this FMU's code.</p>"#;

/// The page from its template (modelDescription/documentation/index.html), with a link to the page
/// for browsers if that is in the archive.
pub fn page(template: &[u8], has_page: bool) -> Result<String, Failure> {
    let template = String::from_utf8_lossy(template);
    for mark in [VARIABLES, ACCURACY, VERSION, PAGE] {
        if !template.contains(mark) {
            return Err(Failure(format!(
                "documentation/index.html does not contain `{mark}`; add it where its content belongs"
            )));
        }
    }
    Ok(template
        .replace(VARIABLES, VARIABLES_HTML)
        .replace(ACCURACY, &summary::html(&summary::read()?))
        .replace(VERSION, env!("CARGO_PKG_VERSION"))
        .replace(PAGE, if has_page { LINK } else { "" }))
}
