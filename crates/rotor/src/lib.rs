//! The physics of a helicopter rotor: plain structures and functions in SI units and radians. Nothing here knows of FMI.
//!
//! A `Rotor` is a definition that never changes. It answers a `Response` at an `OperatingPoint` in a `State`, computed in a
//! `Workspace`, in plain numbers or in dual ones that carry exact derivatives.
//!
//! "The thesis" is Lovaco Hernandez, J. L. (2017), "Verification of a Modelica Helicopter Rotor Model Using Blade Element
//! Theory", Linkoping University, LIU-IEI-TEK-A--17/02958-SE.
//!
//! The modules, each of which imports only from those before it:
//!
//! * numbers: `scalar`, `root`, `newton`, `text_file`
//! * air and sections: `air`, `compressibility`, `airfoil`
//! * the blade: `geometry`, `tip_loss`, `element`, `blade_loads`, `blade`
//! * the disc: `disc`, `induced`, `sweep`
//! * inflow: `inflow`
//! * the rotor: `state`, `operating_point`, `flapping`, `models`, `rotor`, `workspace`, `data_range`
//! * what it computes: `evaluation`, `loads`, `lift_end`, `tip_path`, `hub_loads`, `rates`, `response`, `step`, `start`

pub mod air;
pub mod airfoil;
pub mod compressibility;
pub mod disc;
pub mod element;
pub mod flapping;
pub mod geometry;
pub mod inflow;
pub mod root;
pub mod scalar;
pub mod state;
pub mod tip_loss;

mod blade;
mod blade_loads;
mod data_range;
mod error;
mod evaluation;
mod hub_loads;
mod induced;
mod lift_end;
mod loads;
mod models;
mod newton;
mod operating_point;
mod rates;
mod response;
mod rotor;
mod start;
mod step;
mod sweep;
mod text_file;
mod tip_path;
mod workspace;

pub use blade_loads::{BladeLoads, ElementLoads};
pub use data_range::OutsideData;
pub use error::SolveError;
pub use evaluation::Evaluation;
pub use hub_loads::HubLoads;
pub use induced::{Field, Induced};
pub use models::{Blades, Models};
pub use operating_point::{Drive, OperatingPoint};
pub use response::Response;
pub use rotor::Rotor;
pub use start::Start;
pub use state::State;
pub use tip_path::TipPath;
pub use workspace::Workspace;
