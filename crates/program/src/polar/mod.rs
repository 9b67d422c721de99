//! Makes a `.polar` file of the section data that other programs write.
//!
//! `read` reads the files, one module for each form; `clean` and `select` make one polar of each
//! Reynolds or Mach number of them; `extend` continues these to the full circle; `text` and `draw`
//! write the file and its drawing.

mod clean;
mod draw;
mod extend;
mod read;
mod select;
mod text;

use crate::{Failure, draft, output};
use clap::{Args, ValueEnum};
use rotor::airfoil::{Airfoil, Axis};
use std::path::{Path, PathBuf};

/// What `helicopter-rotor polar` is told.
#[derive(Args)]
pub struct Options {
    /// Section data: polars of XFOIL, XFLR5, QBlade and airfoiltools.com, airfoil files of AeroDyn
    /// and OpenFAST, tables of CCBlade.jl, C81, CSV, .polar
    #[arg(required = true, value_name = "IN")]
    inputs: Vec<PathBuf>,
    /// The .polar file to write; a drawing of it goes beside it, with the ending .svg
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// The section's name [default: as in the first file, else the file's name]
    #[arg(long)]
    name: Option<String>,
    /// Reynolds numbers of the polars whose files name none, in their order
    #[arg(long, value_name = "RE", value_delimiter = ',')]
    reynolds: Vec<f64>,
    /// Make blocks by Reynolds or by Mach number [default: by the one that differs]
    #[arg(long, value_name = "AXIS")]
    by: Option<By>,
    /// Of files for several Reynolds and several Mach numbers: take the polars at this number of
    /// the other kind
    #[arg(long, value_name = "NUMBER", requires = "by")]
    at: Option<f64>,
    /// How the polars continue to the full circle
    #[arg(long, value_enum, default_value_t = Method::Viterna)]
    method: Method,
    /// Drag coefficient across the flow; by default that of a long flat plate
    #[arg(long, value_name = "CD", default_value_t = extend::CD_MAX)]
    cd_max: f64,
    /// Range in which the data go over into the flat plate, deg
    #[arg(long, value_name = "DEG", default_value_t = extend::BLEND)]
    blend: f64,
    /// The section is symmetric, and the files have no angles below 0: mirror them
    #[arg(long)]
    symmetric: bool,
    /// Unit of the angles [default: as the form or the header says, else by the lift slope]
    #[arg(long, value_name = "UNIT")]
    angles: Option<Angles>,
}

/// What the blocks of the file are numbered by.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum By {
    Reynolds,
    Mach,
}

/// A way to continue a polar.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Method {
    /// Viterna & Corrigan (1982)
    Viterna,
    /// The normal force of a flat plate, into which the data go over
    FlatPlate,
}

/// The unit of angles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Angles {
    Deg,
    Rad,
}

/// Lift and drag at an angle of attack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// deg.
    pub alpha: f64,
    pub lift: f64,
    pub drag: f64,
}

/// The polar at one Reynolds and Mach number.
#[derive(Debug, Clone, PartialEq)]
pub struct Polar {
    /// The file's name, without its folder, and of several polars in a file which one.
    pub source: String,
    /// None if the file has none.
    pub reynolds: Option<f64>,
    /// None if the file has none.
    pub mach: Option<f64>,
    pub points: Vec<Point>,
}

/// A point of the file to write.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    pub point: Point,
    /// Whether no file has it.
    pub is_extended: bool,
}

/// A block of the file to write.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Reynolds or Mach number.
    pub number: f64,
    pub rows: Vec<Row>,
}

impl From<By> for Axis {
    fn from(by: By) -> Self {
        match by {
            By::Reynolds => Self::Reynolds,
            By::Mach => Self::Mach,
        }
    }
}

/// Reads the files, and writes the `.polar` file and its drawing.
pub fn run(options: &Options) -> Result<(), Failure> {
    check(options)?;
    let mut notes = Vec::new();
    let mut name = None;
    let mut polars = Vec::new();
    let mut sources = Vec::new();
    for path in &options.inputs {
        let file = read::file(path, options.angles)?;
        output::print(file.summary())?;
        sources.push(file.summary());
        notes.extend(file.notes);
        name = name.or(file.name);
        polars.extend(file.polars);
    }
    for polar in &mut polars {
        clean::clean(polar, options.symmetric, &mut notes)?;
    }
    let (by, polars) = select::select(polars, options, &mut notes)?;
    let how = extend::How {
        method: options.method,
        cd_max: options.cd_max,
        blend: options.blend,
    };
    let mut blocks = Vec::new();
    for (number, polar) in polars {
        let rows = extend::to_full_circle(&polar, &how, &mut notes)?;
        blocks.push(Block { number, rows });
    }
    for note in &notes {
        output::print(format_args!("Note: {note}"))?;
    }
    let name = options.name.clone().or(name);
    let name = name.unwrap_or_else(|| stem(&options.inputs[0]));
    let is_extended = blocks.iter().any(|b| b.rows.iter().any(|r| r.is_extended));
    let file = text::File {
        name: &name,
        by,
        sources: &sources,
        notes: &notes,
        how: is_extended.then_some(&how),
        blocks: &blocks,
    };
    publish(&options.out, &file)
}

/// Refuses what no file can mend.
fn check(options: &Options) -> Result<(), Failure> {
    let refused = |sentence: &str| Err(Failure(sentence.into()));
    if !options
        .out
        .extension()
        .is_some_and(|e| e.eq_ignore_ascii_case("polar"))
    {
        return refused("--out must end in .polar, by which the FMU knows the format");
    }
    if !(0.5..=4.0).contains(&options.cd_max) {
        return refused("--cd-max must lie between 0.5 and 4; a long flat plate has 2");
    }
    if !(1.0..=90.0).contains(&options.blend) {
        return refused("--blend must lie between 1 and 90 deg");
    }
    Ok(())
}

/// Writes the file and its drawing once the FMU would read it.
fn publish(out: &Path, file: &text::File) -> Result<(), Failure> {
    let text = file.text();
    if let Err(error) = Airfoil::from_text(&text, out) {
        return Err(Failure(format!(
            "these data make no .polar file that the FMU reads; nothing is written: {error}"
        )));
    }
    let drawing = out.with_extension("svg");
    let picture = draw::svg(file)?;
    // Both places are refused before one is written.
    draft::place_of_file(&drawing)?;
    draft::replace_file(out, text.as_bytes())?;
    draft::replace_file(&drawing, picture.as_bytes())?;
    output::print(format_args!(
        "Made {}, which airfoil.file or a station of a rotor file may name, and its drawing {}",
        out.display(),
        drawing.display()
    ))
}

/// A file's name without folder and ending.
fn stem(path: &Path) -> String {
    path.file_stem()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}
