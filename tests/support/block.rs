//! The block by the names of its choices, for tests that need no packaged FMU.

// Each test program uses a part of this.
#![allow(dead_code)]

use helicopter_rotor::block::{
    RotorBlock,
    variables::{IntegerRef, RealRef},
};
use std::path::PathBuf;

/// The folder of the project.
pub fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// A block of default values with the project's resources.
pub fn default_block() -> RotorBlock {
    RotorBlock::new(project().join("modelDescription/resources"))
}

/// The integer behind a name of the enumeration at a place among the integers.
pub fn choice(place: IntegerRef, name: &str) -> i32 {
    let choices = place.variable().choices;
    let found = choices.iter().position(|c| *c == name);
    found.unwrap_or_else(|| panic!("no choice {name} among {choices:?}")) as i32 + 1
}

pub fn choose(block: &mut RotorBlock, place: IntegerRef, name: &str) {
    let value = choice(place, name);
    block.set_integers(&[place], &[value]).unwrap();
}

pub fn set(block: &mut RotorBlock, place: RealRef, value: f64) {
    block.set_reals(&[place], &[value]).unwrap();
}

pub fn get(block: &RotorBlock, place: RealRef) -> f64 {
    block.values().reals[place]
}

/// A block of default values with these changes, computed.
pub fn computed(reals: &[(RealRef, f64)], integers: &[(IntegerRef, i32)]) -> RotorBlock {
    let mut block = default_block();
    for (place, value) in reals {
        set(&mut block, *place, *value);
    }
    for (place, value) in integers {
        block.set_integers(&[*place], &[*value]).unwrap();
    }
    block.update().unwrap();
    block
}
