//! What the process of the importer may have changed around this library, and how the library keeps
//! its numbers and its promises there.
//!
//! * `float_environment`: traps, rounding and flushing of floating-point numbers
//! * `library_file`: where this library is
//! * `memory`: what happens when there is none

pub mod float_environment;
pub mod library_file;
pub mod memory;
