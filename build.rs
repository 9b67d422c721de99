//! Makes modelDescription.xml of FMI 2.0 and of FMI 3.0, the Rust constants of the variables and
//! the documentation's tables from `modelDescription/*.toml`, so that they always agree, and a
//! table of the resources.

#[path = "build/table.rs"]
mod table;

#[path = "build/arrays.rs"]
mod arrays;
#[path = "build/dependencies.rs"]
mod dependencies;
#[path = "build/html.rs"]
mod html;
#[path = "build/resources.rs"]
mod resources;
#[path = "build/rust.rs"]
mod rust;
#[path = "build/xml/mod.rs"]
mod xml;

use std::{env, error::Error, fs, path::Path};

const VARIABLES: &str = "modelDescription/variables.toml";
const UNITS: &str = "modelDescription/units.toml";
const TERMINALS: &str = "modelDescription/terminals.toml";
const RESOURCES: &str = "modelDescription/resources";

fn main() -> Result<(), Box<dyn Error>> {
    let inputs = ["build.rs", "build", VARIABLES, UNITS, TERMINALS, RESOURCES];
    for input in inputs {
        println!("cargo::rerun-if-changed={input}");
    }
    let out = env::var("OUT_DIR")?;
    let out = Path::new(&out);
    let version = env::var("CARGO_PKG_VERSION")?;

    let table = table::Table::read(VARIABLES, UNITS)?;
    let grouped = arrays::grouped(&table).map_err(|e| format!("{VARIABLES}: {e}"))?;
    let of_fmi2 = |guid: &str| xml::fmi2::model_description(&table, &version, guid);
    let of_fmi3 = |token: &str| xml::fmi3::model_description(&table, &grouped, &version, token);
    let guid = xml::fingerprint(of_fmi2("")?);
    let token = xml::fingerprint(of_fmi3("")?);
    fs::write(out.join("modelDescription.xml"), of_fmi2(&guid)?)?;
    fs::write(out.join("modelDescription-fmi3.xml"), of_fmi3(&token)?)?;
    let terminals = xml::terminals::Terminals::read(TERMINALS)?;
    for (file, has_arrays) in [("terminals.xml", false), ("terminals-fmi3.xml", true)] {
        fs::write(out.join(file), terminals.description(&grouped, has_arrays)?)?;
    }
    let constants = rust::constants(&table, &grouped, &guid, &token)?;
    fs::write(out.join("variables.rs"), constants)?;
    fs::write(out.join("variables.html"), html::tables(&table))?;
    fs::write(
        out.join("resources.rs"),
        resources::table(Path::new(RESOURCES))?,
    )?;
    Ok(())
}
