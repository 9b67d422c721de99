//! The C interface of FMI 3.0 (standard 3.0.2): the 75 functions of fmi3Functions.h, and what only
//! this version has. No physics here; what it shares with FMI 2.0 is in `fmi`.
//!
//! * `logging.rs`, `creation.rs`, `life_cycle.rs`: version and messages; making instances; running
//!   them
//! * `variables.rs`, `get_set.rs`: value references, and the values of variables
//! * `dependencies.rs`, `derivatives.rs`: on what a variable depends, and how much
//! * `fmu_state.rs`: the complete state
//! * `events.rs`: Event Mode, which both interfaces have
//! * `co_simulation.rs`, `intermediate_update.rs`, `model_exchange.rs`: the functions of one
//!   interface
//! * `not_offered.rs`: clocks, binary variables and other functions that refuse every call
//! * `legality.rs`: which function may be called in which state
//! * `types.rs`: the types of C

pub mod co_simulation;
pub mod creation;
pub mod dependencies;
pub mod derivatives;
pub mod events;
pub mod fmu_state;
pub mod get_set;
pub mod intermediate_update;
pub mod legality;
pub mod life_cycle;
pub mod logging;
pub mod model_exchange;
pub mod not_offered;
pub mod types;
pub(crate) mod variables;
