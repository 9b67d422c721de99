//! The C interface of FMI 2.0 (standard 2.0.5): the 44 functions of fmi2Functions.h and nothing
//! else. No physics here.
//!
//! * `common.rs`: the functions that Co-Simulation and Model Exchange share
//! * `not_offered.rs`: those of them that this FMU does not offer
//! * `co_simulation.rs`, `model_exchange.rs`: those of one interface
//! * `legality.rs`: which function may be called in which state
//! * `instance.rs`: one instance, and the frame in which every function runs

pub mod co_simulation;
pub mod common;
mod instance;
pub mod legality;
mod logger;
pub mod model_exchange;
pub mod not_offered;
pub mod types;
