//! The page: one HTML file with the FMU's library in WebAssembly, which needs no server and no
//! other file. Its sources are in page/; this puts them, the library, modelDescription.xml and
//! measured points into one.

use crate::{
    Failure,
    draft::{Draft, place_of_file},
    failed, files, package, scripts, sources,
};
use base64::{Engine, prelude::BASE64_STANDARD};
use flate2::{Compression, write::GzEncoder};
use helicopter_rotor::description;
use serde_json::json;
use std::{fs, io::Write, path::Path};

/// Where the data go.
const DATA: &str = r#"<script type="application/json" id="data">{}</script>"#;
/// Points that the page shows beside its curve in hover.
const MEASURED: &str = "knight-hefner-1937-tn626-hover.csv";
/// What the page says about licences, from modelDescription/licenses/: the FMU's own, and the parts
/// by others that are in the library.
const LICENCES: [&str; 3] = ["LICENSE-MIT.txt", "THIRD-PARTY.txt", "LICENSE-APACHE.txt"];

/// Writes the page. After an error there is no incomplete `file`.
pub fn write(file: &Path, target: &Path) -> Result<(), Failure> {
    let draft = Draft::new(place_of_file(file)?)?;
    fs::write(draft.path(), make(target)?)
        .map_err(failed(format!("cannot write {}", file.display())))?;
    draft.publish()
}

/// The page's text. `target` is cargo's target folder, in which the library is built.
pub fn make(target: &Path) -> Result<String, Failure> {
    let library = package::web_library(target)?;
    let measured = files::read_text(&scripts::examples().join("data").join(MEASURED))?;
    let folder = sources().join("page");
    let page = inlined(&files::read_text(&folder.join("index.html"))?, |name| {
        files::read_text(&folder.join(name))
    })?;
    let data = json!({
        "library": BASE64_STANDARD.encode(packed(&library)?),
        "description": description::XML,
        "measured": measured,
        "licences": licences()?,
    });
    with_data(&page, &data.to_string())
}

/// The texts, each below its name.
fn licences() -> Result<String, Failure> {
    let folder = sources().join("modelDescription/licenses");
    let mut texts = Vec::new();
    for name in LICENCES {
        texts.push(format!(
            "{name}\n\n{}",
            files::read_text(&folder.join(name))?
        ));
    }
    Ok(texts.join("\n\n"))
}

fn packed(library: &[u8]) -> Result<Vec<u8>, Failure> {
    let mut encoder = GzEncoder::new(Vec::new(), Compression::best());
    encoder
        .write_all(library)
        .and_then(|()| encoder.finish())
        .map_err(failed("cannot compress the page's library"))
}

/// The page with the content of its scripts and style sheets, each on a line of its own, in place
/// of their names.
fn inlined(page: &str, read: impl Fn(&str) -> Result<String, Failure>) -> Result<String, Failure> {
    const STYLE: (&str, &str) = (r#"<link rel="stylesheet" href=""#, r#"">"#);
    const SCRIPT: (&str, &str) = (r#" src=""#, r#""></script>"#);
    let mut lines = Vec::new();
    for line in page.lines() {
        if let Some(rest) = line.strip_prefix(STYLE.0)
            && let Some(name) = rest.strip_suffix(STYLE.1)
        {
            lines.push(format!("<style>\n{}</style>", read(name)?));
        } else if let Some((tag, rest)) = line.split_once(SCRIPT.0)
            && let Some(name) = rest.strip_suffix(SCRIPT.1)
        {
            lines.push(format!("{tag}>\n{}</script>", read(name)?));
        } else {
            lines.push(line.to_owned());
        }
    }
    lines.push(String::new());
    Ok(lines.join("\n"))
}

fn with_data(page: &str, json: &str) -> Result<String, Failure> {
    let Some((before, after)) = page.split_once(DATA) else {
        return Err(Failure(format!(
            "page/index.html does not contain `{DATA}`; add it before the scripts"
        )));
    };
    // "</script>" in a text would end the script. In JSON "\/" is "/".
    let json = json.replace("</", r"<\/");
    Ok(format!("{before}{}{after}", DATA.replace("{}", &json)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn scripts_styles_and_data_are_put_into_the_page() {
        let page = format!(
            "<link rel=\"icon\" href=\"data:,\">\n<link rel=\"stylesheet\" href=\"a.css\">\n{DATA}\n<script id=\"b\" src=\"b.js\"></script>\n"
        );
        let page = inlined(&page, |name| Ok(format!("text of {name}\n"))).unwrap();
        let page = with_data(&page, r#"{"x":"</script>"}"#).unwrap();
        let expected = r#"<link rel="icon" href="data:,">
<style>
text of a.css
</style>
<script type="application/json" id="data">{"x":"<\/script>"}</script>
<script id="b">
text of b.js
</script>
"#;
        assert_eq!(page, expected);
        assert!(with_data("<p>", "{}").is_err());
    }
}
