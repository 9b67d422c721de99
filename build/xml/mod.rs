//! The files of an FMU in XML, which are made from the table of variables.

mod common;
pub mod fmi2;
pub mod fmi3;
pub mod terminals;

pub use common::fingerprint;
