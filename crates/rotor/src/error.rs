//! Why a rotor could not be computed.

use super::root::RootError;
use thiserror::Error;

/// No solution was found at an operating point.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum SolveError {
    /// The momentum equation of an annulus.
    #[error("the inflow near r/R = {radius_ratio:.3} has no solution: {cause}")]
    Annulus {
        /// r/R of the middle of the innermost of the elements that are solved together.
        radius_ratio: f64,
        /// What the root finder found.
        cause: RootError,
    },
    /// The momentum equation of the disc as a whole.
    #[error("the mean inflow of the disc has no solution: {0}")]
    Disc(RootError),
    /// The thrust on which the end of the lift depends.
    #[error("the radius at which the lift ends has no solution: {0}")]
    LiftEnd(RootError),
    /// The steady start.
    #[error(
        "no state was found in which inflow and flapping repeat themselves; set initialization to rest"
    )]
    NoSteadyState,
    /// More work than the workspace allows, in computations of a section's loads.
    #[error("it takes more than {0} computations of blade sections")]
    TooMuchWork(u64),
    /// In a step in time: the states cannot be integrated.
    #[error("the rates of inflow, flapping or rotor speed are not finite")]
    RatesNotFinite,
    /// In a step in time: not even the shortest steps are accurate.
    #[error(
        "the blades flap faster than steps can follow; give them a softer hinge spring or a larger inertia"
    )]
    FlappingTooFast,
}
