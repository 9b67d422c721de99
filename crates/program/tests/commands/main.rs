//! The program's commands, and the FMU that it makes in an importer.
//!
//! One program holds them all, so that they run side by side and share one packaged FMU.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

mod environment;
mod examples;
mod first_use;
mod fmi3;
mod importers;
mod importers_table;
mod package;
mod package_out;
mod platforms;
mod polar;
mod reference;
mod rotor_file;
mod support;
mod tables;
mod terminal;
mod validation;
