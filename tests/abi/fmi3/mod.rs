//! The C interface of FMI 3.0 as an importer sees it, and that it answers as that of FMI 2.0.

mod co_simulation;
mod counts;
mod creation;
mod dependencies;
mod derivatives;
mod description;
mod events;
mod float_environment;
mod intermediate_update;
mod legality;
mod logging;
mod no_allocation;
mod same_bits;
mod states;
