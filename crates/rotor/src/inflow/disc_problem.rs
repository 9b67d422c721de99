//! The disc at an operating point, as input to the inflow models.

use super::Momentum;
use crate::{
    blade::Blade,
    disc::{BladeFlow, BladePosition, DiscFlow},
    numbers::Width,
};

/// The disc at an operating point: all that an inflow model needs to know of the rotor.
#[derive(Debug, Clone, Copy)]
pub struct Disc<'a, S = f64> {
    /// The blade, element by element.
    pub blade: Blade<'a, S>,
    /// Motion of the disc through the air, in wind axes.
    pub flow: &'a DiscFlow<S>,
    /// Positions of the blades, or those over which the disc is averaged.
    pub positions: &'a [BladePosition<S>],
    /// The flow at each position.
    pub blade_flows: &'a [BladeFlow<S>],
    /// The lanes in which elements are computed.
    pub width: Width,
    /// Whether the positions are those of the blades.
    pub is_individual: bool,
    /// Momentum theory in descent and near the ground.
    pub momentum: Momentum<S>,
}
