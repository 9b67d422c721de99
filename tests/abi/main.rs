//! The C interface as an importer sees it: the shared library in an unpacked FMU.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "../support/mod.rs"]
mod support;

mod arguments;
mod both_interfaces;
mod c_programs;
mod capabilities;
mod dependencies;
mod directional;
mod exports;
mod extremes;
mod files;
mod float_environment;
mod fmi3;
mod fmu_state;
mod get_set;
mod hostile_files;
mod input_derivatives;
mod legality;
mod life_cycle;
mod logging;
mod many;
mod model_exchange;
mod no_allocation;
mod no_memory;
mod ownership;
mod pointers;
mod promises;
mod random;
mod resources;
mod same_bits;
mod serialized;
mod settings;
mod silence;
