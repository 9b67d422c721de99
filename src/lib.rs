//! `HelicopterRotor.fmu`: a helicopter rotor behind FMI 2.0 and FMI 3.0, for Co-Simulation and
//! Model Exchange.
//!
//! Data flows one way: importer, `fmi2` or `fmi3`, `block`, the crate `rotor`, and back. `fmi2` and
//! `fmi3` are the C interfaces and share `fmi`, `block` says which variable feeds which quantity,
//! and `rotor` is the physics. `host` deals with what the importer's process does to the library.

pub mod block;
pub mod description;
pub mod fmi;
pub mod fmi2;
pub mod fmi3;
mod host;
