//! The states as unknowns of order 1, for Newton's method.

use crate::{
    disc::Flap, numbers::Scalar, operating_point::OperatingPoint, rotor::Rotor, state::State,
};
use nalgebra::DVector;

/// Which states are unknown, and their scales: velocities are divided by a speed, flap rates by the
/// rotor's speed.
pub(super) struct Unknowns {
    inflow: usize,
    flapping: usize,
    /// m/s.
    speed: f64,
    /// rad/s.
    rotation: f64,
}

impl Unknowns {
    /// The inflow states, divided by a speed, m/s.
    pub(super) fn of_inflow(rotor: &Rotor, speed: f64) -> Self {
        Self {
            inflow: rotor.models().inflow.state_count(),
            flapping: 0,
            speed,
            rotation: 1.0,
        }
    }

    /// Inflow states and flapping of a rotor that turns.
    pub(super) fn of_periodic_state(rotor: &Rotor, point: &OperatingPoint) -> Self {
        Self {
            inflow: rotor.models().inflow.state_count(),
            flapping: rotor.flapping_blades(),
            speed: point.speed * rotor.geometry().radius,
            rotation: point.speed,
        }
    }

    /// The unknowns of a state.
    pub(super) fn of<S: Scalar>(&self, state: &State<S>) -> DVector<S> {
        let inflow = state.inflow[..self.inflow].iter().map(|v| *v / self.speed);
        let flaps = &state.flaps[..self.flapping];
        let flaps = flaps.iter().flat_map(|f| [f.angle, f.rate / self.rotation]);
        DVector::from_iterator(self.inflow + 2 * self.flapping, inflow.chain(flaps))
    }

    /// The state with these unknowns and 0 for all else.
    pub(super) fn state<S: Scalar>(&self, unknowns: &DVector<S>) -> State<S> {
        let mut state = State::default();
        let (inflow, flaps) = unknowns.as_slice().split_at(self.inflow);
        for (value, x) in state.inflow.iter_mut().zip(inflow) {
            *value = *x * self.speed;
        }
        for (flap, x) in state.flaps.iter_mut().zip(flaps.chunks_exact(2)) {
            *flap = Flap {
                angle: x[0],
                rate: x[1] * self.rotation,
            };
        }
        state
    }
}
