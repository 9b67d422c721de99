//! How much a computation may cost: a bound on the number of times that the loads of a section of a
//! blade are computed, which is nearly all that a rotor costs.

use super::error::SolveError;
use core::cell::Cell;

/// Counts computations of the loads of a section, and bounds them.
///
/// A step costs the number of blades (or of azimuths of a disc) times that of elements and of
/// stages, and with static inflow the iterations.
#[derive(Debug, Clone)]
pub struct Work {
    done: Cell<u64>,
    limit: u64,
}

impl Default for Work {
    /// Without a bound.
    fn default() -> Self {
        Self::up_to(u64::MAX)
    }
}

impl Work {
    /// Work that has not begun and may take `limit` computations of a section's loads.
    pub fn up_to(limit: u64) -> Self {
        Self {
            done: Cell::new(0),
            limit,
        }
    }

    /// The number of computations so far.
    pub fn done(&self) -> u64 {
        self.done.get()
    }

    /// What is left within the bound.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.done())
    }

    /// Counts computations, or what costs as much.
    pub fn count(&self, computations: u64) {
        self.done.set(self.done.get().wrapping_add(computations));
    }

    /// An error if there is less left than `computations` take. Asked before each computation of
    /// the whole rotor, so that the bound is passed by one of these at most.
    pub fn check(&self, computations: u64) -> Result<(), SolveError> {
        if computations <= self.left() {
            return Ok(());
        }
        Err(self.exceeded())
    }

    /// The error of work beyond the bound.
    pub fn exceeded(&self) -> SolveError {
        SolveError::TooMuchWork(self.limit)
    }
}
