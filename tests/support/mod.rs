//! What the integration tests share: the FMU, loaded as an importer loads it.
//!
//! * `block.rs`: the block and its variables, without the C interface
//! * `exact.rs`: its exact derivatives beside its values
//! * `c.rs`, `c3.rs`: the C types and functions of FMI 2.0 and 3.0, written apart from the code
//!   under test
//! * `fmu.rs`: the FMU as an importer has it on its disk, loaded
//! * `instance.rs`, `instance3.rs`: an instance of FMI 2.0 or 3.0 with variables by name, and its
//!   log
//! * `model_exchange.rs`: its functions of Model Exchange
//! * `child.rs`: a test run alone in a process of its own
//! * `allocations.rs`: counting allocations in such a process, and letting them fail

// Each test uses a part of this.
#![allow(dead_code, unused_imports)]

#[cfg(all(target_os = "linux", target_env = "gnu"))]
pub mod allocations;
pub mod block;
pub mod c;
pub mod c3;
pub mod child;
pub mod exact;
pub mod fmu;
pub mod instance;
pub mod instance3;
mod model_exchange;

pub use fmu::Fmu;
pub use instance::{Creation, Instance};
pub use instance3::Instance3;
