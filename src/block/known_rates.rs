//! Rates of the states that have been computed already. A step begins where outputs were computed
//! or where the last step began, so that its first stage is known there. This spares an evaluation
//! in four and never changes a bit.

use rotor::{OperatingPoint, Rotor, State};
use std::sync::Arc;

/// The last rates of each kind.
#[derive(Debug, Default)]
pub struct KnownRates {
    published: Option<Known>,
    grid: Option<Known>,
}

/// Rates, and the rotor, operating point and state that they belong to.
#[derive(Debug)]
struct Known {
    rotor: Arc<Rotor>,
    point: OperatingPoint,
    state: State,
    rates: State,
}

impl KnownRates {
    /// The rates of a rotor at an operating point in a state, per second, if they are known.
    pub fn find(&self, rotor: &Arc<Rotor>, point: &OperatingPoint, state: &State) -> Option<State> {
        let fits = |known: &&Known| {
            Arc::ptr_eq(&known.rotor, rotor) && known.point == *point && known.state == *state
        };
        let known = self.published.iter().chain(&self.grid).find(fits)?;
        Some(known.rates)
    }

    /// Keeps the rates that were computed with the outputs.
    pub fn keep_published(
        &mut self,
        rotor: &Arc<Rotor>,
        point: &OperatingPoint,
        state: &State,
        rates: &State,
    ) {
        self.published = Some(Known::new(rotor, point, state, rates));
    }

    /// Keeps the rates at the grid point where a step begins.
    pub fn keep_grid(
        &mut self,
        rotor: &Arc<Rotor>,
        point: &OperatingPoint,
        state: &State,
        rates: &State,
    ) {
        self.grid = Some(Known::new(rotor, point, state, rates));
    }
}

impl Known {
    fn new(rotor: &Arc<Rotor>, point: &OperatingPoint, state: &State, rates: &State) -> Self {
        Self {
            rotor: Arc::clone(rotor),
            point: *point,
            state: *state,
            rates: *rates,
        }
    }
}
