//! How the states of the rotor change in time, and one step of it.

use super::{
    Drive, Operation, Rotor, SolveError, State,
    disc::DiscFlow,
    flapping::Flap,
    inflow::{
        Inflow,
        pitt_peters::{Loading, Stream},
    },
    loads::Sums,
    scalar::Scalar,
    scene::Scene,
};
use core::f64::consts::PI;

/// Largest product of a step and the states' fastest rate; `step` is stable to 1.7 for undamped motion and
/// 2.5 for damped.
const LARGEST_PRODUCT: f64 = 1.0;

impl<S: Scalar> Rotor<S> {
    /// Whether anything but the azimuth changes in time by itself.
    pub fn has_memory(&self, operation: &Operation<S>) -> bool {
        operation.drive != Drive::Speed
            || self.models.hinge.freedom.is_some()
            || self.inflow_states() > 0
    }

    /// Number of the states of the inflow.
    pub(super) fn inflow_states(&self) -> usize {
        match (&self.models.inflow, &self.peters_he) {
            (Inflow::PittPetersDynamic, _) => 3,
            (_, Some(wake)) => wake.len(),
            _ => 0,
        }
    }

    /// Number of the blades that flap.
    pub(super) fn flapping_blades(&self) -> usize {
        match self.models.hinge.freedom {
            Some(_) => self.geometry.blades as usize,
            None => 0,
        }
    }

    /// The state with all that does not count at 0: the speed unless a torque drives the rotor, and what the models
    /// do not use.
    pub fn used(&self, is_driven: bool, state: &State<S>) -> State<S> {
        let mut used = *state;
        if !is_driven {
            used.speed = S::zero();
        }
        used.inflow[self.inflow_states()..].fill(S::zero());
        used.flaps[self.flapping_blades()..].fill(Flap::rigid(0.0));
        used
    }

    /// How fast the states change, per second.
    pub fn rates(
        &mut self,
        operation: &Operation<S>,
        state: &State<S>,
    ) -> Result<State<S>, SolveError> {
        let operation = &operation.at_speed_of(state);
        if !self.has_memory(operation) {
            return Ok(State {
                azimuth: operation.speed,
                ..State::default()
            });
        }
        let scene = self.scene(operation, state);
        let sums = self.fly(&scene, operation, state)?;
        Ok(self.rates_in(operation, state, &scene, &sums))
    }

    pub(super) fn rates_in(
        &self,
        operation: &Operation<S>,
        state: &State<S>,
        scene: &Scene<S>,
        sums: &Sums<S>,
    ) -> State<S> {
        let mut rates = State {
            azimuth: operation.speed,
            ..State::default()
        };
        let stream = self.stream(&scene.flow);
        match (&self.models.inflow, &self.peters_he) {
            (Inflow::PittPetersDynamic, _) => {
                let radius = self.geometry.radius;
                let density_area = operation.air.density * PI * radius * radius;
                let loading = Loading {
                    thrust: sums.force.z / density_area,
                    cosine: sums.moment.y / (density_area * radius),
                    sine: -sums.moment.x / (density_area * radius),
                };
                let field = scene.axes.field_into_wind(&state.field());
                let rate = stream.rate(&field, &loading);
                rates.set_field(&scene.axes.field_out_of_wind(&rate));
            }
            (_, Some(wake)) => {
                let (cos, sin) = (scene.axes.cos, scene.axes.sin);
                let states = wake.rotated(&state.inflow, cos, sin);
                let mut in_wind = [S::zero(); super::state::MOST_INFLOW_STATES];
                wake.rate(&states, &sums.loading, &stream, &mut in_wind);
                rates.inflow = wake.rotated(&in_wind, cos, -sin);
            }
            _ => {}
        }
        if let Some(freedom) = &self.models.hinge.freedom {
            let blades = rates.flaps.iter_mut().zip(scene.places.iter());
            for ((rate, place), moment) in blades.zip(sums.hinge_moments) {
                let action = self.action(operation, scene, moment);
                rate.angle = place.flap.rate;
                rate.rate = freedom.acceleration(&self.models.hinge, &scene.flow, place, &action);
            }
        }
        if let Drive::Torque { torque, inertia } = operation.drive {
            rates.speed = (torque + sums.moment.z) / inertia;
        }
        rates
    }

    /// The state one step of `duration` s later, by Heun's method of order 3 (Heun 1900, Z. Math. Phys. 45,
    /// p. 23). `operation_at`: what the rotor does so many seconds after the beginning of the step.
    pub fn step(
        &mut self,
        mut operation_at: impl FnMut(S) -> Operation<S>,
        state: &State<S>,
        duration: S,
    ) -> Result<State<S>, SolveError> {
        let first = self.rates(&operation_at(S::zero()), state)?;
        let at_third = state.plus(duration / 3.0, &first);
        let second = self.rates(&operation_at(duration / 3.0), &at_third)?;
        let at_two_thirds = state.plus(duration * 2.0 / 3.0, &second);
        let third = self.rates(&operation_at(duration * 2.0 / 3.0), &at_two_thirds)?;
        Ok(state
            .plus(duration * 0.25, &first)
            .plus(duration * 0.75, &third))
    }

    fn stream(&self, flow: &DiscFlow<S>) -> Stream<S> {
        Stream {
            edgewise: flow.edgewise,
            climb: flow.climb,
            radius: self.geometry.radius,
            descent: self.models.descent,
        }
    }
}

impl Rotor {
    /// Number of equal steps that makes a stretch of `duration` s stable.
    pub fn steps(&self, operation: &Operation, state: &State, duration: f64) -> f64 {
        let fastest = self.fastest_rate(operation, state);
        libm::ceil((duration * fastest / LARGEST_PRODUCT).max(1.0))
    }

    /// An estimate of how fast the states move towards where they belong, 1/s: inflow, flapping with the
    /// blades' lift as damper and, with delta3, as spring, and the speed with the lift as brake.
    fn fastest_rate(&self, operation: &Operation, state: &State) -> f64 {
        let operation = &operation.at_speed_of(state);
        let scene = self.scene(operation, state);
        let flow = &scene.flow;
        let radius = self.geometry.radius;
        let chords = self.geometry.stations.iter().map(|s| s.chord);
        let chord = chords.fold(0.0, f64::max);
        let solidity = f64::from(self.geometry.blades) * chord / (PI * radius);
        let tip_speed = flow.rotation.abs() * radius;
        let stream = self.stream(flow);
        let inflow = match (&self.models.inflow, &self.peters_he) {
            (Inflow::PittPetersDynamic, _) => {
                stream.fastest_rate(state.inflow[0], solidity, tip_speed)
            }
            (_, Some(wake)) => {
                let states = &state.inflow;
                wake.fastest_rate(states, solidity, tip_speed, &stream, scene.is_blades)
            }
            _ => 0.0,
        };
        let flapping = self.models.hinge.freedom.map_or(0.0, |freedom| {
            let speed = tip_speed + flow.edgewise + flow.climb.abs();
            freedom.fastest_rate(&self.models.hinge, operation, flow, chord, speed)
        });
        let turning = match operation.drive {
            Drive::Speed => 0.0,
            Drive::Torque { inertia, .. } => {
                let blades = f64::from(self.geometry.blades);
                let speed = tip_speed + flow.edgewise + flow.climb.abs();
                blades * operation.air.density * PI * speed * chord * radius * radius * radius
                    / (3.0 * inertia)
            }
        };
        inflow + flapping + turning
    }
}
