//! What a rotor remembers: the azimuth, its inflow and the flapping of its blades.

use super::{
    flapping::Flap,
    inflow::{Field, peters_he},
    scalar::Scalar,
};

/// Most blades that can flap.
pub const MOST_FLAPPING_BLADES: usize = 8;

/// Most states that an inflow model has.
pub const MOST_INFLOW_STATES: usize = peters_he::MAX_STATES;

/// The states of a rotor, or how fast they change. What the models do not use stays 0.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct State<S = f64> {
    /// Of blade 1 from the tail in the turning sense, rad; it counts on over the turns. Blade k is k - 1
    /// steps of 2 pi/N ahead.
    pub azimuth: S,
    /// Of the rotor against the hub while a torque drives it, rad/s.
    pub speed: S,
    /// m/s, in the axes of the hub (mirrored for a clockwise rotor).
    pub inflow: [S; MOST_INFLOW_STATES],
    pub flaps: [Flap<S>; MOST_FLAPPING_BLADES],
}

impl<S: Scalar> Default for State<S> {
    /// All zero.
    fn default() -> Self {
        Self {
            azimuth: S::zero(),
            speed: S::zero(),
            inflow: [S::zero(); MOST_INFLOW_STATES],
            flaps: [Flap::rigid(0.0); MOST_FLAPPING_BLADES],
        }
    }
}

impl State {
    /// Largest difference to another state in anything but the azimuth: m/s, rad or rad/s.
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
    /// The state with a function of each of its numbers.
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

    /// The first three states of the inflow as a linear distribution.
    pub fn field(&self) -> Field<S> {
        let [mean, cosine, sine, ..] = self.inflow;
        Field { mean, cosine, sine }
    }

    pub fn set_field(&mut self, field: &Field<S>) {
        self.inflow[..3].copy_from_slice(&field.to_array());
    }
}
