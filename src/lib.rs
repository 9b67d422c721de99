//! `HelicopterRotor.fmu`: a helicopter rotor behind the FMI 2.0 co-simulation interface.
//!
//! Data flows one way: importer, `fmi2`, `block`, `rotor`, and back. `rotor` is the physics,
//! `block` says which variable feeds which quantity, `fmi2` is the C interface.

pub mod block;
pub mod fmi2;
pub mod rotor;
