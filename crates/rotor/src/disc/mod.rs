//! The disc: wind axes, the positions of the blades, and the flow at their sections.
//!
//! Wind axes. x points from the shaft into the edgewise flow, z up along the shaft, y to the left
//! of x; the rotor turns counter-clockwise seen from above (a clockwise rotor is computed as its
//! mirror image). The azimuth psi counts from downwind in the direction of rotation, so that in
//! edgewise flow the blade advances at psi = 90 deg.
//!
//! A blade at psi points along e_r = (-cos psi, -sin psi, 0) and moves along e_t = (sin psi, -cos
//! psi, 0). Outboard of its hinge at radius h it is turned up by the flap angle beta: the section
//! at the distance s from the hinge lies at X e_r + Z e_z with X = h + s cos beta, Z = s sin beta,
//! and n = cos beta e_z - sin beta e_r is perpendicular to the blade.

mod axes;
mod flow;
mod position;

pub use axes::{Azimuth, WindAxes};
pub use flow::{BladeFlow, DiscFlow, SectionFlow};
pub use position::{AZIMUTHS, BladePosition, Flap, OfPositions, evenly_spaced};
