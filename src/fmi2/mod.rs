//! The C interface of FMI 2.0 (standard 2.0.5): the 44 functions of fmi2Functions.h and nothing
//! else. No physics here.
//!
//! * `version.rs`, `creation.rs`, `life_cycle.rs`: the version; making instances; running them
//! * `get_set.rs`: getting and setting values of variables
//! * `fmu_state.rs`, `serialized_state.rs`: the complete state, and its form as bytes
//! * `directional.rs`: derivatives along a direction
//! * `co_simulation.rs`, `model_exchange.rs`: the functions of one interface
//! * `communication_time.rs`: the importer's time, and which steps it may take
//! * `logger.rs`: messages to the importer
//! * `legality.rs`: which function may be called in which state
//! * `instance.rs`: one instance, and the frame in which every function runs
//! * `handle.rs`: how instances and states are recognised behind the importer's pointers
//! * `types.rs`, `arguments.rs`: the types of C, and the memory behind its pointers
//! * `resource_location.rs`: where the resources are

mod arguments;
pub mod co_simulation;
mod communication_time;
pub mod creation;
pub mod directional;
pub mod fmu_state;
pub mod get_set;
mod handle;
mod instance;
pub mod legality;
pub mod life_cycle;
pub mod logger;
pub mod model_exchange;
mod resource_location;
mod serialized_state;
pub mod types;
pub mod version;
