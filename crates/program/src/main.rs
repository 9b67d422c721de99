//! The program: makes `HelicopterRotor.fmu`, compares it with measurements in FMPy, and writes the
//! validation page.

mod draft;
mod examples;
mod files;
mod output;
mod package;
mod page;
mod polar;
mod process;
mod progress;
mod python;
mod rotor_file;
mod scripts;
mod stop;
mod summary;
mod validation;

use clap::{Parser, Subcommand, builder::PossibleValuesParser};
use std::{
    fmt,
    path::{Path, PathBuf},
    process::ExitCode,
};
use validation::Purpose;

/// Makes HelicopterRotor.fmu, a helicopter rotor as an FMU for Co-Simulation and Model Exchange,
/// for FMI 2.0 and, as HelicopterRotor-fmi3.fmu, for FMI 3.0.
///
/// Without a command: makes target/fmu/HelicopterRotor.fmu and the file of FMI 3.0 beside it, flies
/// the rotors that Knight & Hefner measured in 1937 with the former in FMPy, prints computed and
/// measured thrust and torque, and plots them beside the FMU. FMPy and the other Python packages
/// are installed into an environment of their own in target/python.
///
/// Files and folders are replaced when the new ones are complete, and not before. Where one is
/// given as a symbolic link, the link stays and the file or folder to which it leads is written.
#[derive(Parser)]
#[command(version, after_long_help = EXIT_STATUS)]
struct Arguments {
    /// Use this built library for the FMU and do not build one with cargo
    #[arg(long, global = true, value_name = "FILE")]
    library: Option<PathBuf>,
    #[command(subcommand)]
    command: Option<Command>,
}

#[derive(Subcommand)]
enum Command {
    #[command(flatten)]
    InSourceTree(InSourceTree),
    /// Make a .polar file of the section data of other programs, and draw it
    ///
    /// Says what each file was taken for. Data that end before the full circle are extended; the
    /// rows that are not data are marked.
    Polar(#[command(flatten)] polar::Options),
}

/// What works only in the source tree.
#[derive(Subcommand)]
enum InSourceTree {
    /// Make the two .fmu only
    Package {
        /// The .fmu of FMI 2.0 to write [default: target/fmu/HelicopterRotor.fmu, or that of
        /// --name]; that of FMI 3.0 gets `-fmi3` at the end of its name
        ///
        /// A regular file, old or new: folders, devices and FIFOs are refused. Of a symbolic link
        /// the target is written, also if it does not exist yet, and the link stays.
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
        #[command(flatten)]
        selection: package::Selection,
        #[command(flatten)]
        rotor: package::OwnRotor,
    },
    /// Show the rotor in a file: table, drawing, solidity, Lock number, hover
    Check(rotor_file::Check),
    /// Write a commented rotor file
    New(rotor_file::New),
    /// Make the page: the rotor in a browser, as one HTML file that needs no server
    ///
    /// Builds the FMU's library in WebAssembly, for which Rust's standard library must be
    /// installed: `rustup target add wasm32-unknown-unknown`.
    Page {
        /// The HTML file to write [default: target/page/HelicopterRotor.html]
        #[arg(long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// Run the examples in fmu-examples/: tables and pictures of systems that contain the rotor
    Examples {
        /// Run only these
        #[arg(value_name = "NAME", value_parser = PossibleValuesParser::new(examples::names()))]
        names: Vec<String>,
        /// Folder for the .fmu and the results, one for each example [default: target/examples]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
    /// Make the reference files against which importers are checked, and the .fmu that contains
    /// them
    Reference,
    /// Fly every measured case with the FMU in FMPy, and write docs/validation.md, its figures and
    /// the summary in the README
    Validate {
        /// Write none of these files: compare them with the new results, number by number within
        /// the last printed digit
        #[arg(long)]
        check: bool,
        /// Folder for the page, errors.csv and element-times.csv; its old content is removed
        /// [default: target/validation]
        #[arg(long, value_name = "FOLDER")]
        out: Option<PathBuf>,
    },
    /// Make or repair the Python environment of the examples, and print the path of its interpreter
    ///
    /// The environment is in target/python. All packages that the examples import are imported. If
    /// one is missing or broken, it is named, and the packages are installed again.
    Python,
}

const EXIT_STATUS: &str = "\
Exit status:
  0    done
  1    an error, which a sentence on the standard error explains
  2    wrong arguments
  130  ended by Ctrl-C or SIGTERM; nothing incomplete is left
  141  ended because the reader of the output has gone, as in `... | head -1`";

/// An error as a sentence for the person at the terminal.
#[derive(Debug)]
pub struct Failure(pub String);

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

/// Puts a sentence in front of an error: what was not possible.
pub fn failed<E: fmt::Display>(sentence: impl fmt::Display) -> impl FnOnce(E) -> Failure {
    move |error| Failure(format!("{sentence}: {error}"))
}

/// The source tree that this program was built from.
pub fn sources() -> &'static Path {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    package.ancestors().nth(2).unwrap_or(package)
}

fn main() -> ExitCode {
    match parse_and_run() {
        Ok(status) => status,
        Err(_) if output::reader_has_gone() => ExitCode::from(output::EXIT_STATUS_WITHOUT_READER),
        Err(_) if stop::is_requested() => {
            output::note("Interrupted; nothing incomplete is left.");
            ExitCode::from(stop::EXIT_STATUS)
        }
        Err(failure) => {
            output::note(format_args!("Error: {failure}"));
            ExitCode::FAILURE
        }
    }
}

fn parse_and_run() -> Result<ExitCode, Failure> {
    output::check()?;
    stop::watch()?;
    match Arguments::try_parse() {
        Ok(arguments) => run(arguments).map(|()| ExitCode::SUCCESS),
        // Also --help and --version are errors for clap.
        Err(error) => {
            output::written(error.print())?;
            let status = u8::try_from(error.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from);
            Ok(status)
        }
    }
}

fn run(Arguments { library, command }: Arguments) -> Result<(), Failure> {
    match command {
        Some(Command::Polar(options)) => polar::run(&options),
        Some(Command::InSourceTree(command)) => run_in_source_tree(library, Some(command)),
        None => run_in_source_tree(library, None),
    }
}

fn run_in_source_tree(
    library: Option<PathBuf>,
    command: Option<InSourceTree>,
) -> Result<(), Failure> {
    let target = target_folder()?;
    let given = library.clone();
    let library = || library.map_or_else(|| package::library::build(&target), Ok);
    let default_fmu = target.join("fmu").join("HelicopterRotor.fmu");
    match command {
        Some(InSourceTree::Package {
            out,
            selection,
            rotor,
        }) => {
            let own = rotor.read(&package::resources())?;
            let name = own.as_ref().map(|own| format!("{}.fmu", own.name));
            let default = name.map_or(default_fmu, |name| target.join("fmu").join(name));
            let out = out.unwrap_or(default);
            // Refused before the library is built.
            draft::place_of_file(&out)?;
            draft::place_of_file(&package::beside(&out))?;
            let contents = selection.contents(given, &target)?;
            make_both(&out, &contents, own.as_ref())
        }
        Some(InSourceTree::Check(check)) => check.run(),
        Some(InSourceTree::New(new)) => new.run(),
        Some(InSourceTree::Page { out }) => {
            let out = out.unwrap_or_else(|| target.join("page").join("HelicopterRotor.html"));
            page::write(&out, &target)?;
            output::print(format_args!("Made {}", out.display()))
        }
        Some(InSourceTree::Examples { names, out }) => {
            let out = out.unwrap_or_else(|| target.join("examples"));
            let fmu = out.join("HelicopterRotor.fmu");
            make_fmu(&fmu, &library()?)?;
            examples::run(&names, &fmu, &out, &target)
        }
        Some(InSourceTree::Reference) => {
            let library = library()?;
            make_fmu(&default_fmu, &library)?;
            scripts::make_reference_flights(&default_fmu, &target)?;
            make_fmu(&default_fmu, &library)
        }
        Some(InSourceTree::Validate { check, out }) => {
            let purpose = if check {
                Purpose::Check
            } else {
                Purpose::Write
            };
            let out = out.unwrap_or_else(|| target.join("validation"));
            validation::check_before(&out)?;
            validation::run(&out, &library()?, &target, purpose)
        }
        Some(InSourceTree::Python) => output::print(python::environment(&target)?.display()),
        None => {
            let contents = package::Contents::of_host(&library()?)?;
            make_both(&default_fmu, &contents, None)?;
            scripts::fly_knight_hefner(&default_fmu, &target)
        }
    }
}

fn make_both(
    file: &Path,
    contents: &package::Contents,
    own: Option<&package::Own>,
) -> Result<(), Failure> {
    let other = package::write_both(file, contents, own)?;
    output::print(format_args!("Made {}", file.display()))?;
    output::print(format_args!("Made {}", other.display()))
}

fn make_fmu(file: &Path, library: &Path) -> Result<(), Failure> {
    package::write(file, &package::Contents::of_host(library)?)?;
    output::print(format_args!("Made {}", file.display()))
}

/// Cargo's target folder, which contains this program as `target/<profile>/<program>`.
///
/// Fails for a program that `cargo install` has copied, into a folder `bin`, or whose source tree
/// has gone: it needs both.
fn target_folder() -> Result<PathBuf, Failure> {
    let program = std::env::current_exe().map_err(failed("cannot find this program's own file"))?;
    let profile = program.parent();
    let is_installed = profile.is_some_and(|folder| folder.ends_with("bin"));
    if is_installed || !sources().join("Cargo.toml").is_file() {
        return Err(Failure(format!(
            "this program works only in the source tree that it was built from, {}; run it there with `cargo run --release`",
            sources().display()
        )));
    }
    let folder = profile.and_then(Path::parent);
    folder.map(Path::to_path_buf).ok_or_else(|| {
        Failure("this program is not in a target folder of cargo; run it with `cargo run`".into())
    })
}
