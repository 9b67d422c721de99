//! The block and its variables, for tests that need no packaged FMU.

use helicopter_rotor::block::{
    RotorBlock,
    variables::{BooleanRef, IntegerRef, RealRef, StringRef, boolean, real},
};
use std::path::PathBuf;

/// The folder of the project.
pub fn project() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// The folder of the resources that travel in the FMU.
pub fn resources() -> PathBuf {
    project().join("modelDescription/resources")
}

/// A block of default values with the project's resources.
pub fn default_block() -> RotorBlock {
    RotorBlock::new(resources())
}

/// The number of a choice of an enumeration variable.
pub fn choice(reference: IntegerRef, name: &str) -> i32 {
    let choices = reference.variable().choices;
    let found = choices.iter().position(|c| *c == name);
    found.unwrap_or_else(|| panic!("no choice {name} among {choices:?}")) as i32 + 1
}

/// Sets an enumeration variable to the choice of a name.
pub fn choose(block: &mut RotorBlock, reference: IntegerRef, name: &str) {
    set_integer(block, reference, choice(reference, name));
}

pub fn set(block: &mut RotorBlock, reference: RealRef, value: f64) {
    block.set_reals(&[reference], &[value]).unwrap();
}

pub fn set_integer(block: &mut RotorBlock, reference: IntegerRef, value: i32) {
    block.set_integers(&[reference], &[value]).unwrap();
}

pub fn set_string(block: &mut RotorBlock, reference: StringRef, value: &str) {
    block.set_strings(&[reference], &[value]).unwrap();
}

pub fn set_boolean(block: &mut RotorBlock, reference: BooleanRef, value: bool) {
    block.set_booleans(&[reference], &[value.into()]).unwrap();
}

/// Lets the blades flap.
pub fn enable_flapping(block: &mut RotorBlock) {
    set_boolean(block, boolean::FLAPPING__ENABLED, true);
}

pub fn get(block: &RotorBlock, reference: RealRef) -> f64 {
    block.values().reals[reference]
}

/// A block of default values with these changes, whose outputs are computed.
pub fn computed(reals: &[(RealRef, f64)], integers: &[(IntegerRef, i32)]) -> RotorBlock {
    let mut block = default_block();
    for (reference, value) in reals {
        set(&mut block, *reference, *value);
    }
    for (reference, value) in integers {
        set_integer(&mut block, *reference, *value);
    }
    block.update().unwrap();
    block
}

/// The thrust of the default rotor with these changes, N.
pub fn thrust(reals: &[(RealRef, f64)]) -> f64 {
    get(&computed(reals, &[]), real::THRUST)
}
