//! The states of a rotor: azimuth, speed, inflow and flapping.

use super::{
    disc::Flap,
    inflow::{InflowStates, MAX_STATES},
    numbers::Scalar,
};

/// Maximum number of blades that can flap.
pub const MAX_FLAPPING_BLADES: usize = 8;

/// Maximum number of states of an inflow model.
pub const MAX_INFLOW_STATES: usize = MAX_STATES;

/// The states of a rotor, or their rates of change per second. States that the models do not have
/// stay 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<S = f64> {
    /// Azimuth of blade 1 from the tail in the direction of rotation, rad. It keeps growing from
    /// revolution to revolution. Blade k is (k - 1) 2 pi/N ahead.
    pub azimuth: S,
    /// Rotor speed against the hub while a torque drives it, rad/s.
    pub speed: S,
    /// Inflow states, m/s, in the axes of the hub (mirrored for a clockwise rotor).
    pub inflow: InflowStates<S>,
    /// Flap angles and rates of the blades.
    pub flaps: [Flap<S>; MAX_FLAPPING_BLADES],
}

impl<S: Scalar> Default for State<S> {
    /// All zero.
    fn default() -> Self {
        Self {
            azimuth: S::zero(),
            speed: S::zero(),
            inflow: [S::zero(); MAX_INFLOW_STATES],
            flaps: [Flap::rigid(0.0); MAX_FLAPPING_BLADES],
        }
    }
}

impl State {
    /// The state a part of the way (0 to 1) to another one `duration` s later: the cubic with these
    /// states and the rates `first` and `last` at its ends (Hermite). Its error is of the fourth
    /// power of the duration, as is that of a single step of Heun's method; the states must be
    /// smooth within it.
    pub fn between(
        &self,
        first: &Self,
        (other, last): (&Self, &Self),
        part: f64,
        duration: f64,
    ) -> Self {
        let change = other.plus(-1.0, self);
        let rest = 1.0 - part;
        self.plus(part * part * (3.0 - 2.0 * part), &change)
            .plus(duration * part * rest * rest, first)
            .plus(-duration * part * part * rest, last)
    }

    /// Largest difference from another state, in m/s, rad or rad/s; the azimuth does not count.
    pub fn largest_change(&self, other: &Self) -> f64 {
        let inflow = self.inflow.iter().zip(&other.inflow);
        let flaps = self.flaps.iter().zip(&other.flaps);
        let angles = flaps.flat_map(|(a, b)| [(a.angle - b.angle).abs(), (a.rate - b.rate).abs()]);
        inflow
            .map(|(a, b)| (a - b).abs())
            .chain(angles)
            .fold((self.speed - other.speed).abs(), f64::max)
    }
}

impl<S: Scalar> State<S> {
    /// The state with `function` applied to each of its numbers.
    pub fn map<T: Scalar>(&self, function: impl Fn(S) -> T) -> State<T> {
        State {
            azimuth: function(self.azimuth),
            speed: function(self.speed),
            inflow: self.inflow.map(&function),
            flaps: self.flaps.map(|flap| Flap {
                angle: function(flap.angle),
                rate: function(flap.rate),
            }),
        }
    }

    /// `self + factor * rates`.
    pub fn plus(&self, factor: S, rates: &Self) -> Self {
        let mut sum = *self;
        sum.azimuth += factor * rates.azimuth;
        sum.speed += factor * rates.speed;
        for (value, rate) in sum.inflow.iter_mut().zip(&rates.inflow) {
            *value += factor * *rate;
        }
        for (flap, rate) in sum.flaps.iter_mut().zip(&rates.flaps) {
            flap.angle += factor * rate.angle;
            flap.rate += factor * rate.rate;
        }
        sum
    }
}
