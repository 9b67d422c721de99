//! What the integration tests share: the FMU, loaded as an importer loads it.
//!
//! * `c.rs`: the C types and functions of the standard, written apart from the code under test
//! * `fmu.rs`: the FMU as an importer has it on its disk, loaded
//! * `instance.rs`: an instance with variables by name, and its log
//! * `model_exchange.rs`: its functions of Model Exchange
//! * `child.rs`: a test run alone in a process of its own

// Each test program uses a part of this.
#![allow(dead_code, unused_imports)]

pub mod c;
pub mod child;
pub mod fmu;
pub mod instance;
mod model_exchange;

pub use fmu::Fmu;
pub use instance::{Creation, Instance};
