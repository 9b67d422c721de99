//! The program: makes `HelicopterRotor.fmu`, flies it in FMPy beside measurements, and writes the page of how well.

mod fly;
mod package;
mod python;
mod reference;
mod summary;
mod validate;

use clap::{Parser, Subcommand};
use std::{
    fmt,
    path::{Path, PathBuf},
    process::ExitCode,
};

/// HelicopterRotor.fmu: a helicopter rotor as an FMI 2.0 FMU, for Co-Simulation and Model Exchange.
///
/// Without a command: makes target/fmu/HelicopterRotor.fmu, flies the rotors that Knight & Hefner
/// measured in 1937 with it in FMPy, prints computed beside measured thrust and torque, and draws
/// them. The Python packages for this go into an environment of their own under target/.
#[derive(Parser)]
#[command(version)]
struct Arguments {
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    /// Only make the .fmu
    Package {
        /// Where to write it [default: target/fmu/HelicopterRotor.fmu]
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Make the reference inputs and outputs anew, that an importer is checked against, and the .fmu with them in it
    Reference,
    /// Fly every measured case with the FMU in FMPy, and write docs/validation.md, its figures and the README's summary
    Validate {
        /// Write nothing: compare them with what comes out now, within the last printed digit
        #[arg(long)]
        check: bool,
        /// Folder for errors.csv, element-times.csv and the page [default: target/validation]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
    /// Make the Python environment of the examples, and print the path of its interpreter
    Python,
}

/// An error as a sentence for the person at the terminal.
#[derive(Debug)]
pub struct Failure(pub String);

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Adds what was being done to an error.
pub fn failed<E: fmt::Display>(what: impl fmt::Display) -> impl FnOnce(E) -> Failure {
    move |error| Failure(format!("{what}: {error}"))
}

fn main() -> ExitCode {
    match run(Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("Error: {failure}");
            ExitCode::FAILURE
        }
    }
}

fn run(command: Option<Command>) -> Result<(), Failure> {
    let target = target_folder()?;
    let default_fmu = target.join("fmu").join("HelicopterRotor.fmu");
    match command {
        Some(Command::Package { out }) => {
            make_fmu(out.as_deref().unwrap_or(&default_fmu))?;
        }
        Some(Command::Reference) => {
            make_fmu(&default_fmu)?;
            reference::make(&default_fmu, &target)?;
            make_fmu(&default_fmu)?;
        }
        Some(Command::Validate { check, out }) => {
            let purpose = if check {
                validate::Purpose::Check
            } else {
                validate::Purpose::Write
            };
            let out = out.unwrap_or_else(|| target.join("validation"));
            validate::run(&out, &target, purpose)?;
        }
        Some(Command::Python) => {
            println!("{}", python::environment(&target)?.display());
        }
        None => {
            make_fmu(&default_fmu)?;
            fly::knight_hefner(&default_fmu, &target)?;
        }
    }
    Ok(())
}

fn make_fmu(file: &Path) -> Result<(), Failure> {
    package::write(file)?;
    println!("Made {}", file.display());
    Ok(())
}

/// Cargo's target folder, in which the program itself lies as `target/<profile>/<program>`.
fn target_folder() -> Result<PathBuf, Failure> {
    let program = std::env::current_exe().map_err(failed("cannot find this program's own file"))?;
    let folder = program.parent().and_then(Path::parent);
    folder.map(Path::to_path_buf).ok_or_else(|| {
        Failure(
            "this program lies outside of cargo's target folder; run it with `cargo run`".into(),
        )
    })
}
