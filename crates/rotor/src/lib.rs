//! The physics of a helicopter rotor: plain structures and functions in SI units and radians,
//! independent of FMI.
//!
//! A `Rotor` is a definition that never changes. Its `Response` at an `OperatingPoint` in a `State`
//! is computed in a `Workspace`, in plain numbers or in dual numbers, which carry exact
//! derivatives.
//!
//! ```
//! use rotor::{Models, OperatingPoint, Rotor, Workspace, air::Air, airfoil::Airfoil};
//! use rotor::geometry::{Elements, Geometry};
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! # let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../modelDescription/resources/airfoils");
//! # let file = std::path::Path::new(folder).join("naca0015-knight-hefner.polar");
//! // Four blades, R = 0.762 m, cutout at R/6, chord 50.8 mm, neither taper nor twist.
//! let geometry = Geometry::linear(4, 0.762, 1.0 / 6.0, 0.0508, 1.0, 0.0);
//! geometry.check()?;
//! let elements = Elements::new(&geometry, 40);
//! let rotor = Rotor::new(geometry, elements, vec![Airfoil::read(&file)?], Models::default());
//!
//! // Hover at a collective of 8 deg and 960 rev/min, sea level.
//! let point = OperatingPoint::hover(0.1396, 100.5, Air::standard(0.0));
//! let hub = rotor.steady(&point)?;
//! assert!((hub.force.z - 65.8).abs() < 0.1, "{} N", hub.force.z);
//!
//! // The same in a workspace that can be used again, with rates of the states and blade loads.
//! let mut workspace = Workspace::new(&rotor);
//! let response = rotor.respond(&point, &Default::default(), &mut workspace)?;
//! assert_eq!(response.hub.force, hub.force);
//! assert!(response.blade.at(0.75).angle_of_attack > 0.05);
//! # Ok(())
//! # }
//! ```
//!
//! "The thesis" is Lovaco Hernandez, J. L. (2017), "Verification of a Modelica Helicopter Rotor
//! Model Using Blade Element Theory", Linkoping University, LIU-IEI-TEK-A--17/02958-SE.
//!
//! The modules, each of which imports only from those before it:
//!
//! * numbers: `numbers`, `root`, `newton`, `phi`, `error`, `work`, `text_file`
//! * air and sections: `air`, `compressibility`, `airfoil`
//! * the blade: `geometry`, `tip_loss`
//! * the disc: `disc`, `induced`
//! * the elements: `element`, `blade_loads`, `blade`, `sweep`
//! * inflow: `inflow`
//! * the rotor: `state`, `operating_point`, `flapping`, `seesaw`, `models`, `rotor`, `workspace`,
//!   `data_range`
//! * what it computes: `evaluation`, `loads`, `lift_end`, `tip_path`, `hub_loads`, `rates`,
//!   `response`, `step`, `stiff_step`, `start`
//! * a test of all this in every width of lanes: `widths`

#![warn(missing_docs)]
// A new model makes the compiler list what it has to define.
#![warn(clippy::wildcard_enum_match_arm)]

pub mod air;
pub mod airfoil;
pub mod compressibility;
pub mod disc;
pub mod element;
pub mod flapping;
pub mod geometry;
pub mod inflow;
pub mod numbers;
pub mod root;
pub mod seesaw;
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
mod phi;
mod rates;
mod response;
mod rotor;
mod start;
mod step;
mod stiff_step;
mod sweep;
mod text_file;
mod tip_path;
#[cfg(test)]
mod widths;
mod work;
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
pub use start::{Start, Started};
pub use state::State;
pub use step::Division;
pub use stiff_step::StiffStep;
pub use text_file::hash_of_text;
pub use tip_path::TipPath;
pub use work::Work;
pub use workspace::Workspace;
