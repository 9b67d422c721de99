//! The physics against theory and measured sections, and the order of the crate's modules.
//!
//! One program holds them all, so that its tests run side by side and are linked once.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

mod flapping;
mod forward_flight;
mod individual_blades;
mod modules;
mod momentum_theory;
mod section_tables;
mod support;
