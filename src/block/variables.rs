//! The table of variables as the build made it from modelDescription/variables.toml: names,
//! defaults, ranges and value references. Neutral of the FMI version.

// Defaults and limits stand as numbers in the table, also where they are pi.
#![allow(clippy::approx_constant)]

pub use super::references::{BooleanRef, IntegerRef, RealRef, StringRef};

/// What a variable is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    Input,
    Output,
    /// Computed like an output, but not connected to others.
    Local,
    Parameter,
}

/// One row of the table; `T` is the base type of its value.
#[derive(Debug, Clone, Copy)]
pub struct Variable<T: 'static> {
    pub name: &'static str,
    pub causality: Causality,
    /// Whether a parameter may change while the simulation runs.
    pub tunable: bool,
    /// Whether it is a continuous state.
    pub is_state: bool,
    /// Empty for what is not a Real.
    pub unit: &'static str,
    /// Value before anything is set.
    pub start: T,
    /// Smallest and largest value that is accepted (not used for Booleans and strings).
    pub min: T,
    pub max: T,
    /// Names of an enumeration's values, which count from 1.
    pub choices: &'static [&'static str],
}

/// One of the continuous states: its value and its derivative are Real variables.
#[derive(Debug, Clone, Copy)]
pub struct ContinuousState {
    pub value: RealRef,
    /// Its derivative in time.
    pub derivative: RealRef,
    /// Order of magnitude, > 0.
    pub nominal: f64,
}

impl Causality {
    /// Whether the block computes the variable.
    pub fn is_computed(self) -> bool {
        matches!(self, Self::Output | Self::Local)
    }
}

include!(concat!(env!("OUT_DIR"), "/variables.rs"));
