//! Flapping of rigid blades about their hinges.
//!
//! The blade outboard of the hinge at radius h is a uniform rod, so that its moment of inertia I
//! about the hinge gives the other moments: with the length l = R - h, the first moment S = 3/2 I/l
//! and the mass m = 3 I/l^2. Newton's law for its rotation about the hinge (Johnson 1980,
//! "Helicopter Theory", ch. 5, here without small angles), with n, X and Z of `disc`, the angular
//! velocity (w_r, w_t, W) of the blade's frame, the rotor speed W against the air and Omega against
//! the hub:
//!
//! ```text
//! I beta'' = M - k (beta - beta_p) + S n.g + w_t' (I + h S cos beta)
//!            - (W cos beta - w_r sin beta) (h S w_r + I (w_r cos beta + W sin beta))
//!            - h S sin beta (w_r^2 + w_t^2 + W^2),        w_t' = -Omega w_r
//! ```
//!
//! M is the aerodynamic moment and k the stiffness of the spring, which pulls towards the precone
//! beta_p. For small angles and a hub at rest the flapping frequency is Omega sqrt(1 + h S/I + k/(I
//! Omega^2)), h S/I = 3/2 e/(1 - e).
//!
//! Assumptions. The hub's velocity and angular velocity change slowly enough that their derivatives
//! do not act on the blades. The hub feels each blade through its spring and, at the offset,
//! through the aerodynamic and inertia forces of the blade. With azimuth averages it feels the
//! aerodynamic forces alone, because inertia forces cancel over one revolution. The weight of the
//! blades belongs to the vehicle's weight.

use super::{
    disc::{BladePosition, DiscFlow},
    operating_point::OperatingPoint,
    scalar::Scalar,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// The flapping hinges. Blades that do not flap are rigid at the precone angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Hinge {
    /// Distance of the hinges from the shaft, m.
    pub offset: f64,
    /// Angle at which the spring is at rest, rad.
    pub precone: f64,
    /// None for rigid blades.
    pub freedom: Option<Freedom>,
}

/// A blade that flaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Freedom {
    /// Moment of inertia of one blade about its hinge, kg.m2, > 0.
    pub inertia: f64,
    /// Tangent of delta3: the pitch falls by this times the flap angle above the precone.
    pub pitch_flap: f64,
    /// Length of the blade outboard of the hinge, m, > 0.
    pub length: f64,
}

/// What acts on a blade besides its own motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Action<S = f64> {
    /// Aerodynamic moment about the hinge, positive up, N.m.
    pub moment: S,
    /// Stiffness of the hinge, N.m/rad.
    pub spring: S,
    /// Acceleration of gravity in wind axes, m/s2.
    pub gravity: Vector3<S>,
}

impl Freedom {
    /// First moment about the hinge, kg.m.
    fn first_moment(&self) -> f64 {
        1.5 * self.inertia / self.length
    }

    fn mass(&self) -> f64 {
        3.0 * self.inertia / (self.length * self.length)
    }

    /// beta'' of a blade, rad/s2.
    pub fn acceleration<S: Scalar>(
        &self,
        hinge: &Hinge,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
        action: &Action<S>,
    ) -> S {
        let (sin, cos) = (position.flap_sin, position.flap_cos);
        let (radial, tangential) = flow.hub_rates(position.azimuth);
        let rotation = flow.rotation;
        let first = self.first_moment();
        let offset_moment = hinge.offset * first;
        let outwards =
            -action.gravity.x * position.azimuth.cos - action.gravity.y * position.azimuth.sin;
        let weight = (cos * action.gravity.z - sin * outwards) * first;
        let spring = action.spring * (position.flap.angle - hinge.precone);
        let turning = -flow.speed * radial * (cos * offset_moment + self.inertia);
        let across = (rotation * cos - radial * sin)
            * (radial * offset_moment + (radial * cos + rotation * sin) * self.inertia);
        let centrifugal =
            sin * offset_moment * (radial * radial + tangential * tangential + rotation * rotation);
        (action.moment - spring + weight + turning - across - centrifugal) / self.inertia
    }

    /// The moment of a blade on the hub about -e_t (up) less the aerodynamic moment about the hub's
    /// centre, N.m: k (beta - beta_p) - M - h integral of a_z dm.
    pub fn hub_moment_excess<S: Scalar>(
        &self,
        hinge: &Hinge,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
        action: &Action<S>,
    ) -> S {
        let (sin, cos) = (position.flap_sin, position.flap_cos);
        let (radial, tangential) = flow.hub_rates(position.azimuth);
        let rate = position.flap.rate;
        let first = self.first_moment();
        let spring = action.spring * (position.flap.angle - hinge.precone);
        if hinge.offset == 0.0 {
            return spring - action.moment;
        }
        let acceleration = self.acceleration(hinge, flow, position, action);
        // beta'' and beta'^2, Coriolis, w' x r, and w x (w x r), summed over the blade's mass.
        let out = cos * first + hinge.offset * self.mass();
        let up = sin * first;
        let inertia = (cos * acceleration - sin * rate * rate) * first
            + tangential * 2.0 * rate * up
            + (flow.speed + flow.rotation) * radial * out
            - up * (radial * radial + tangential * tangential);
        spring - action.moment - inertia * hinge.offset
    }

    /// An estimate of the rates of a blade's flapping, frequency plus damping, 1/s, with a lift
    /// slope of 2 pi: `chord` (m) is the largest of the blade, `speed` (m/s) that of the air at its
    /// tip.
    pub fn fastest_rate(
        &self,
        hinge: &Hinge,
        point: &OperatingPoint,
        flow: &DiscFlow,
        chord: f64,
        speed: f64,
    ) -> f64 {
        let first = self.first_moment();
        let per_speed = PI * point.air.density * speed * chord * self.length * self.length;
        let stiffness = point.hinge_spring
            + flow.rotation * flow.rotation * (self.inertia + hinge.offset * first)
            + point.gravity.norm() * first
            + self.pitch_flap.abs() * per_speed * speed / 2.0;
        libm::sqrt(stiffness / self.inertia) + per_speed * self.length / 3.0 / self.inertia
    }
}
