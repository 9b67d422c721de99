//! Rates and steps that have been computed already. The outputs need the rates at the end of each
//! step, so the next step begins with known rates. The step ahead of the present is kept until the
//! present has passed it. No result changes, not even in its last bit.

use super::integrate::{Since, Step, Stepped};
use rotor::{OperatingPoint, Rotor, State};
use std::sync::Arc;

/// The last rates of each kind, and the last step.
#[derive(Debug, Default)]
pub struct KnownRates {
    /// The rates with the outputs.
    published: Option<Known>,
    /// The rates where the last step began.
    last: Option<Known>,
    /// The rates where it ended.
    next: Option<Known>,
    /// The step ahead of the present.
    step: Option<KnownStep>,
}

/// A step, and what it belongs to.
#[derive(Debug)]
struct KnownStep {
    rotor: Arc<Rotor>,
    point: OperatingPoint,
    start: State,
    step: Step,
    stepped: Stepped,
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
        let all = self.published.iter().chain(&self.last).chain(&self.next);
        let known = all.into_iter().find(fits)?;
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

    /// Keeps the rates where a step begins.
    pub fn keep_last(
        &mut self,
        rotor: &Arc<Rotor>,
        point: &OperatingPoint,
        state: &State,
        rates: &State,
    ) {
        self.last = Some(Known::new(rotor, point, state, rates));
    }

    /// Keeps the rates where a step ends.
    pub fn keep_next(
        &mut self,
        rotor: &Arc<Rotor>,
        point: &OperatingPoint,
        state: &State,
        rates: &State,
    ) {
        self.next = Some(Known::new(rotor, point, state, rates));
    }

    /// The step from the last point, if it is known.
    pub fn step_ahead(&self, rotor: &Arc<Rotor>, since: &Since) -> Option<Stepped> {
        let known = self.step.as_ref()?;
        let fits = Arc::ptr_eq(&known.rotor, rotor)
            && known.point == since.point
            && known.start == since.state
            && known.step == since.step;
        fits.then_some(known.stepped)
    }

    /// Keeps the step from the last point.
    pub fn keep_step_ahead(&mut self, rotor: &Arc<Rotor>, since: &Since, stepped: &Stepped) {
        self.step = Some(KnownStep {
            rotor: Arc::clone(rotor),
            point: since.point,
            start: since.state,
            step: since.step,
            stepped: *stepped,
        });
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
