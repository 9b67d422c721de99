//! Makes modelDescription.xml, the Rust constants of the variables and the documentation's tables
//! from `modelDescription/*.toml`, so that the three always agree, and a table of the resources.

#[path = "build/table.rs"]
mod table;

#[path = "build/html.rs"]
mod html;
#[path = "build/resources.rs"]
mod resources;
#[path = "build/rust.rs"]
mod rust;
#[path = "build/xml.rs"]
mod xml;

use std::{env, error::Error, fs, path::Path};

const VARIABLES: &str = "modelDescription/variables.toml";
const UNITS: &str = "modelDescription/units.toml";
const RESOURCES: &str = "modelDescription/resources";

fn main() -> Result<(), Box<dyn Error>> {
    for input in ["build.rs", "build", VARIABLES, UNITS, RESOURCES] {
        println!("cargo::rerun-if-changed={input}");
    }
    let out = env::var("OUT_DIR")?;
    let out = Path::new(&out);
    let version = env::var("CARGO_PKG_VERSION")?;

    let table = table::Table::read(VARIABLES, UNITS)?;
    let guid = xml::fingerprint(&table, &version)?;
    fs::write(
        out.join("modelDescription.xml"),
        xml::model_description(&table, &version, &guid)?,
    )?;
    fs::write(out.join("variables.rs"), rust::constants(&table, &guid)?)?;
    fs::write(out.join("variables.html"), html::tables(&table))?;
    fs::write(
        out.join("resources.rs"),
        resources::table(Path::new(RESOURCES))?,
    )?;
    Ok(())
}
