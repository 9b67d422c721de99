//! The block's numbers: its models in all kinds of flight, its derivatives, its names and presets.
//!
//! One program holds them all, so that its tests run side by side and are linked once.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

#[path = "../support/mod.rs"]
mod support;

mod all_combinations;
mod autogiro;
mod axial_flow;
mod blades;
mod derivative_corners;
mod derivatives;
mod descent;
mod drive;
mod dynamic_inflow;
mod finite_outputs;
mod frames;
mod model_effects;
mod names;
mod presets;
mod propellers;
mod rotor_files;
mod settings;
mod slopes_by_reynolds;
