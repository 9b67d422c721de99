//! The rotor's motion in axes turned into the wind, and the places of its blades.

use super::{
    Blades, Drive, Operation, Rotor, State,
    disc::{Azimuth, DiscFlow, Place, Places, WindAxes},
    flapping::Flap,
    geometry::Rotation,
    inflow::Inflow,
    scalar::Scalar,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// States of the inflow that break the symmetry about the shaft, as a part of the speeds in the problem, up to
/// which they do not count.
const SYMMETRIC: f64 = 1e-12;

/// The rotor's motion in axes turned into the wind, and where its blades are.
pub(super) struct Scene<S = f64> {
    pub axes: WindAxes<S>,
    pub flow: DiscFlow<S>,
    pub gravity: Vector3<S>,
    pub places: Places<S>,
    /// Whether the places are those of the blades, rather than of a mean over the turn.
    pub is_blades: bool,
}

impl<S: Scalar> Rotor<S> {
    /// Whether `performance` is that of blades at their azimuths, rather than a mean over a turn.
    pub fn shows_blades(&self, operation: &Operation<S>, state: &State<S>) -> bool {
        let operation = &operation.at_speed_of(state);
        self.scene(operation, state).is_blades
    }

    /// Whether the states go round with the blades for ever: then no steady state comes in which they rest.
    pub fn never_rests(&self, operation: &Operation<S>, state: &State<S>) -> bool {
        let operation = &operation.at_speed_of(state);
        let scene = self.scene(operation, state);
        let turns =
            operation.speed.value() != 0.0 && scene.is_blades && !scene.flow.is_axisymmetric();
        turns || operation.drive != Drive::Speed
    }

    /// Axes into the wind, the disc's flow in them, and the places of the blades.
    pub(super) fn scene(&self, operation: &Operation<S>, state: &State<S>) -> Scene<S> {
        let mirror = self.mirror();
        let Operation {
            airspeed,
            angular_velocity,
            gravity,
            ..
        } = operation;
        let axes = WindAxes::new(airspeed.x, airspeed.y * mirror);
        let (roll_rate, pitch_rate) =
            axes.into_wind(angular_velocity.x * mirror, angular_velocity.y);
        let (gravity_x, gravity_y) = axes.into_wind(gravity.x, gravity.y * mirror);
        // Cyclic pitch is -cos(psi) and -sin(psi) times these: it turns like (x, y) as well.
        let (cyclic_cos, cyclic_sin) =
            axes.into_wind(operation.cyclic_lateral, operation.cyclic_longitudinal);
        let flow = DiscFlow {
            rotation: operation.speed + angular_velocity.z * mirror,
            speed: operation.speed,
            edgewise: airspeed.x.hypot(airspeed.y),
            climb: airspeed.z,
            roll_rate,
            pitch_rate,
            cyclic_cos,
            cyclic_sin,
            hinge: self.models.hinge.offset,
        };
        // What is left of an asymmetry that dies away is none.
        let speeds = flow.rotation.abs() * self.geometry.radius + flow.edgewise + flow.climb.abs();
        let none = SYMMETRIC * speeds.value();
        let is_inflow_symmetric = match &self.peters_he {
            Some(wake) => wake.is_axisymmetric(&state.inflow, none),
            None => self.inflow_states() == 0 || state.field().is_axisymmetric(none),
        };
        let is_symmetric = flow.is_axisymmetric() && is_inflow_symmetric;
        let is_blades = match self.models.blades {
            _ if self.models.hinge.freedom.is_some() => true,
            Blades::Automatic => !is_symmetric,
            Blades::Disc => false,
            Blades::Individual => true,
        } && self.models.inflow != Inflow::AnnulusClosedForm;
        let places = if is_blades {
            self.blades(&axes, state)
        } else {
            self.turn(is_symmetric)
        };
        Scene {
            axes,
            flow,
            gravity: Vector3::new(gravity_x, gravity_y, gravity.z),
            places,
            is_blades,
        }
    }

    /// The blades where they are.
    fn blades(&self, axes: &WindAxes<S>, state: &State<S>) -> Places<S> {
        let count = self.geometry.blades as usize;
        let step = 2.0 * PI / count as f64;
        Places::new((0..count).map(|k| {
            let psi = state.azimuth + step * k as f64;
            let (cos, sin) = axes.into_wind(psi.cos(), psi.sin());
            let azimuth = Azimuth { sin, cos };
            match (&self.models.hinge.freedom, state.flaps.get(k)) {
                (Some(freedom), Some(flap)) => {
                    let above = flap.angle - self.models.hinge.precone;
                    Place::new(azimuth, *flap, above * -freedom.pitch_flap)
                }
                _ => self.rigid(azimuth),
            }
        }))
    }

    /// The azimuths to average over: one without a direction where all are alike.
    fn turn(&self, is_symmetric: bool) -> Places<S> {
        if is_symmetric {
            return Places::new([self.rigid(Azimuth::nowhere())].into_iter());
        }
        Places::new(self.around.iter().map(|azimuth| {
            let (sin, cos) = (S::constant(azimuth.sin), S::constant(azimuth.cos));
            self.rigid(Azimuth { sin, cos })
        }))
    }

    fn rigid(&self, azimuth: Azimuth<S>) -> Place<S> {
        Place::new(azimuth, Flap::rigid(self.models.hinge.precone), S::zero())
    }

    /// -1 for a clockwise rotor, which is computed as its mirror image.
    pub(super) fn mirror(&self) -> f64 {
        match self.geometry.rotation {
            Rotation::CounterClockwise => 1.0,
            Rotation::Clockwise => -1.0,
        }
    }
}
