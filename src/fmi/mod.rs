//! What the C interfaces of FMI 2.0 and 3.0 share. Each of the two adds its functions and what only
//! that version has.
//!
//! * `instance.rs`: one instance, and the frame in which every function runs
//! * `legality.rs`: which function may be called in which state
//! * `creation.rs`: making instances
//! * `life_cycle.rs`, `get_set.rs`, `model_exchange.rs`: what functions of both versions do
//! * `fmu_state.rs`, `serialized_state.rs`: the complete state, and its form as bytes
//! * `communication_time.rs`: the importer's time, and which steps it may take
//! * `logger.rs`: messages to the importer
//! * `handle.rs`: how instances and states are recognised behind the importer's pointers
//! * `types.rs`, `arguments.rs`: the types of C, and the memory behind its pointers
//! * `resource_location.rs`: where the resources are

pub(crate) mod arguments;
mod communication_time;
pub(crate) mod creation;
pub(crate) mod fmu_state;
pub(crate) mod get_set;
pub(crate) mod handle;
pub(crate) mod instance;
pub mod legality;
pub(crate) mod life_cycle;
pub(crate) mod logger;
pub(crate) mod model_exchange;
mod resource_location;
mod serialized_state;
pub mod types;

pub(crate) use communication_time::Experiment;
