//! The C interface of FMI 2.0 (standard 2.0.5): the 44 functions of fmi2Functions.h and nothing
//! else. No physics here.
//!
//! * `common.rs`: the functions that Co-Simulation and Model Exchange share: logging, instances, initialisation
//! * `values.rs`: getting and setting values of variables
//! * `state.rs`: getting, setting and serializing the complete state
//! * `derivative.rs`: derivatives along a direction, and of outputs in time
//! * `co_simulation.rs`, `model_exchange.rs`: the functions of one interface
//! * `legality.rs`: which function may be called in which state
//! * `instance.rs`: one instance, and the frame in which every function runs
//! * `types.rs`, `logger.rs`: the types of C, and messages to the importer

pub mod co_simulation;
pub mod common;
pub mod derivative;
mod instance;
pub mod legality;
mod logger;
pub mod model_exchange;
pub mod state;
pub mod types;
pub mod values;
