//! The table of variables that the build makes from modelDescription/variables.toml: names,
//! defaults, ranges and value references. Independent of the FMI version.

// The table writes defaults and limits as numbers, pi included.
#![allow(clippy::approx_constant)]

pub use super::references::{BooleanRef, IntegerRef, RealRef, StringRef};

/// The role of a variable, as in FMI.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Causality {
    Input,
    Output,
    /// Computed as an output is, but not meant to be connected.
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
    /// Empty unless the variable is a Real.
    pub unit: &'static str,
    /// Value before anything is set.
    pub start: T,
    /// Smallest and largest accepted value; Booleans and strings do not use them.
    pub min: T,
    pub max: T,
    /// Names of an enumeration's items, numbered from 1. Empty for other types.
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

/// Real variables that are the elements of one array in FMI 3.0, one after the other.
#[derive(Debug, Clone, Copy)]
pub struct Array {
    pub name: &'static str,
    /// The value reference of the first element.
    pub first: u32,
    pub count: u32,
}

/// The dependencies of a variable that is computed, by the value references of FMI 3.0.
#[derive(Debug, Clone, Copy)]
pub struct Dependencies {
    pub of: u32,
    /// Until the initialisation ends.
    pub initial: &'static [Dependency],
    /// Afterwards.
    pub running: &'static [Dependency],
}

/// One element of a variable, or all elements, depends on one element of another or on all. The
/// elements count from 1; 0 means all elements of an array.
#[derive(Debug, Clone, Copy)]
pub struct Dependency {
    pub element: u16,
    pub on: u32,
    pub element_on: u16,
}

impl Causality {
    /// Whether the block computes the variable.
    pub fn is_computed(self) -> bool {
        matches!(self, Self::Output | Self::Local)
    }
}

include!(concat!(env!("OUT_DIR"), "/variables.rs"));

#[cfg(test)]
mod tests {
    use super::super::{Fresh, RotorBlock};
    use super::*;

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    /// Wipes out everything that the block computes. What it then does not write stays NaN, or a
    /// number that no enumeration has.
    fn wipe(block: &mut RotorBlock) {
        for real in RealRef::all().filter(|r| r.variable().causality.is_computed()) {
            block.values.reals[real] = f64::NAN;
        }
        for integer in IntegerRef::all().filter(|r| r.variable().causality.is_computed()) {
            block.values.integers[integer] = -1;
        }
        block.fresh = Fresh::Nothing;
    }

    #[track_caller]
    fn everything_is_written(block: &RotorBlock) {
        for real in RealRef::all() {
            assert!(
                block.values.reals[real].is_finite(),
                "{}",
                real.variable().name
            );
        }
        for integer in IntegerRef::all() {
            let v = integer.variable();
            let range = v.min..=v.max;
            assert!(
                range.contains(&block.values.integers[integer]),
                "{}",
                v.name
            );
        }
        let computed = |causality: Causality| causality.is_computed();
        assert!(
            !BOOLEANS.iter().any(|v| computed(v.causality)),
            "wipe them, too"
        );
        assert!(
            !STRINGS.iter().any(|v| computed(v.causality)),
            "wipe them, too"
        );
    }

    /// Forward flight with a driven shaft, with and without flapping blades.
    fn flights() -> impl Iterator<Item = RotorBlock> {
        [0, 1].into_iter().map(|flaps| {
            let mut block = RotorBlock::new(RESOURCES.into());
            let choices = [
                (integer::MODELS__INFLOW, InflowModel::PetersHe as i32),
                (integer::DRIVE__MODE, DriveMode::Torque as i32),
                (integer::NUMERICS__ELEMENTS, 10),
            ];
            for (choice, value) in choices {
                block.set_integers(&[choice], &[value]).unwrap();
            }
            block
                .set_booleans(&[boolean::FLAPPING__ENABLED], &[flaps])
                .unwrap();
            let (names, values) = ([real::VELOCITY_1, real::DRIVE_TORQUE], [10.0, 3.0]);
            block.set_reals(&names, &values).unwrap();
            block
        })
    }

    #[test]
    fn a_step_writes_every_variable_that_is_computed() {
        for mut block in flights() {
            wipe(&mut block);
            block.update().unwrap();
            everything_is_written(&block);
            wipe(&mut block);
            block.start().unwrap();
            everything_is_written(&block);
            wipe(&mut block);
            block.step(0.01).unwrap();
            everything_is_written(&block);
            block.set_input_slopes(&[real::COLLECTIVE], &[0.1]).unwrap();
            wipe(&mut block);
            block.step(0.01).unwrap();
            everything_is_written(&block);
        }
    }

    #[test]
    fn an_integration_by_the_importer_writes_every_variable_that_is_computed() {
        for mut block in flights() {
            block.start().unwrap();
            block.begin_integration().unwrap();
            let mut states = block.states().unwrap();
            states[0] += 0.1;
            wipe(&mut block);
            block.set_states(&states).unwrap();
            block.update().unwrap();
            block.begin_event();
            everything_is_written(&block);

            // Solvers ask for the derivatives alone.
            for row in &STATES {
                block.values.reals[row.derivative] = f64::NAN;
            }
            block.fresh = Fresh::Nothing;
            let rates = block.derivatives().unwrap();
            assert!(rates.iter().all(|rate| rate.is_finite()));
        }
    }
}
