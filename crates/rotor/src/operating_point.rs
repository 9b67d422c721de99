//! The operating point: what is imposed on the rotor.

use super::{
    air::{Air, STANDARD_GRAVITY},
    numbers::Scalar,
    state::State,
};
use nalgebra::Vector3;

/// What is imposed on the rotor: controls, rotor speed or torque, motion and height of the hub, and
/// air. SI units, rad; vectors in the hub frame (x forward, y left, z up along the shaft).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OperatingPoint<S = f64> {
    /// Blade pitch at the reference radius, rad. With cyclic control it is collective -
    /// cyclic_lateral cos(psi) - cyclic_longitudinal sin(psi), psi from the tail in the
    /// direction of rotation.
    pub collective: S,
    /// See `collective`, rad.
    pub cyclic_longitudinal: S,
    /// See `collective`, rad.
    pub cyclic_lateral: S,
    /// Omega, of the rotor against the hub, rad/s. While a torque drives the rotor, the speed at
    /// the start.
    pub speed: S,
    /// Velocity of the hub through the air, m/s.
    pub airspeed: Vector3<S>,
    /// Angular velocity of the hub, rad/s.
    pub angular_velocity: Vector3<S>,
    /// Acceleration of gravity, m/s2; it acts on blades that flap, and tells where the ground is.
    pub gravity: Vector3<S>,
    /// Stiffness of the flapping hinges, N.m/rad.
    pub hinge_spring: S,
    /// Height of the hub above the ground, m, >= 0.
    pub height: S,
    /// Whether speed or torque is imposed.
    pub drive: Drive<S>,
    /// The air around the rotor.
    pub air: Air<S>,
}

/// Whether speed or torque is imposed on the rotor.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Drive<S = f64> {
    /// The speed is imposed, whatever torque that takes.
    #[default]
    Speed,
    /// A torque; the rotor speed is a state.
    Torque {
        /// N.m, positive in the direction of rotation.
        torque: S,
        /// Moment of inertia about the shaft of everything that turns, kg.m2, > 0.
        inertia: f64,
    },
}

/// Height of the hub above the ground at which there is no ground effect, m.
const FAR_FROM_GROUND: f64 = 1000.0;

impl OperatingPoint {
    /// Hover in still air far from the ground, at a collective, rad, and an imposed rotor speed,
    /// rad/s. Other flight conditions change its fields: `OperatingPoint { airspeed,
    /// ..OperatingPoint::hover(...) }`.
    pub fn hover(collective: f64, speed: f64, air: Air) -> Self {
        Self {
            collective,
            cyclic_longitudinal: 0.0,
            cyclic_lateral: 0.0,
            speed,
            airspeed: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            gravity: Vector3::new(0.0, 0.0, -STANDARD_GRAVITY),
            hinge_spring: 0.0,
            height: FAR_FROM_GROUND,
            drive: Drive::Speed,
            air,
        }
    }
}

impl<S: Scalar> OperatingPoint<S> {
    /// The operating point with `function` applied to each of its numbers.
    pub fn map<T: Scalar>(&self, function: impl Fn(S) -> T) -> OperatingPoint<T> {
        OperatingPoint {
            collective: function(self.collective),
            cyclic_longitudinal: function(self.cyclic_longitudinal),
            cyclic_lateral: function(self.cyclic_lateral),
            speed: function(self.speed),
            airspeed: self.airspeed.map(&function),
            angular_velocity: self.angular_velocity.map(&function),
            gravity: self.gravity.map(&function),
            hinge_spring: function(self.hinge_spring),
            height: function(self.height),
            drive: match self.drive {
                Drive::Speed => Drive::Speed,
                Drive::Torque { torque, inertia } => Drive::Torque {
                    torque: function(torque),
                    inertia,
                },
            },
            air: self.air.map(&function),
        }
    }

    /// Whether a torque drives the rotor, so that its speed is a state.
    pub fn is_driven(&self) -> bool {
        match self.drive {
            Drive::Speed => false,
            Drive::Torque { .. } => true,
        }
    }

    /// Cosine of the angle between the shaft and the vertical, which gravity gives; 1 without
    /// gravity. Negative for an inverted rotor.
    pub fn upright(&self) -> S {
        let down = &self.gravity;
        let size = down.x.hypot(down.y).hypot(down.z);
        if size.value() == 0.0 {
            return S::one();
        }
        -down.z / size
    }

    /// The operating point at the rotor speed that belongs to a state.
    pub fn at_speed_of(&self, state: &State<S>) -> Self {
        match self.drive {
            Drive::Speed => *self,
            Drive::Torque { .. } => Self {
                speed: state.speed,
                ..*self
            },
        }
    }
}
