//! The C interface of FMI 2.0 (standard 2.0.5): the 44 functions of fmi2Functions.h, and what only
//! this version has. No physics here; what it shares with FMI 3.0 is in `fmi`.
//!
//! * `version.rs`, `creation.rs`, `life_cycle.rs`: the version; making instances; running them
//! * `get_set.rs`: getting and setting values of variables
//! * `fmu_state.rs`: the complete state
//! * `directional.rs`: derivatives along a direction
//! * `co_simulation.rs`, `model_exchange.rs`: the functions of one interface
//! * `logger.rs`: which messages the importer wants
//! * `legality.rs`: which function may be called in which state
//! * `types.rs`: the types of C

pub mod co_simulation;
pub mod creation;
pub mod directional;
pub mod fmu_state;
pub mod get_set;
pub mod legality;
pub mod life_cycle;
pub mod logger;
pub mod model_exchange;
pub mod types;
pub mod version;
