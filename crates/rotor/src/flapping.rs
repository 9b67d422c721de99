//! Flapping of rigid blades about their hinges, and what the inertia of blades does to the hub.
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
//! A blade that does not flap is one with an infinitely stiff spring at the precone angle: beta' =
//! beta'' = 0, and the spring carries what is left of the equation. On a hub that turns at the roll
//! and pitch rates p and q, N >= 3 such blades without precone exert the gyroscopic moment N I_s
//! (Omega + r/2) (-q, p), with r the yaw rate and I_s = I + 2 h S + h^2 m about the shaft: Euler's
//! equations (Goldstein 1980, "Classical Mechanics", eq. 5-39) for a flat disc. With one or two
//! blades the moment varies twice per revolution about this mean.
//!
//! Beyond its droop and flap stops a blade is pushed back by a spring K that only pushes, with a
//! damper whose strength grows from 0 with the depth, so that the moment is continuous (Hunt &
//! Crossley 1975, J. Appl. Mech. 42, p. 440):
//!
//! ```text
//! M_stop = K delta + C min(delta/delta_w, 1) delta' >= 0,    C = 2 sqrt(K I)
//! K = S g/delta_w + (nu W)^2 I,    delta_w = 0.01 rad,    nu = 2.6
//! ```
//!
//! delta is the depth beyond the stop. A blade that rests on its droop stop under its weight lies
//! delta_w lower than the stop, and comes to rest there with critical damping. A blade that hits a
//! stop of a turning rotor bends; the second term is the stiffness of the first bending mode of a
//! hinged blade, whose frequency is about 2.6 times the rotor speed (Johnson 1980, ch. 9). K
//! follows from the blade's own inertia, so that the natural frequency on a stop, sqrt(K/I), is at
//! most 2.6 times the rotor speed plus ten times the frequency with which the blade swings as a
//! pendulum: stops never make the equations much stiffer.
//!
//! Assumptions. The hub's velocity and angular velocity and the rotor speed change slowly enough
//! that their derivatives act neither on the blades nor, by way of their inertia, on the hub. The
//! hub feels each flapping blade through its spring and, at the offset, through the aerodynamic and
//! inertia forces of the blade. Of rigid blades it feels the aerodynamic forces and the inertia
//! forces due to the hub's roll and pitch rates; all other inertia forces cancel among the blades,
//! and one blade has a counterweight. Inertia has no part in the force on the hub and in the
//! torque. The weight of the blades belongs to the vehicle's weight.

use super::{
    air::STANDARD_GRAVITY,
    disc::{BladePosition, DiscFlow, Flap},
    numbers::Scalar,
    operating_point::OperatingPoint,
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// The flapping hinges and the blades' mass. Blades that do not flap are rigid at the precone
/// angle.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Hinge {
    /// Distance of the hinges from the shaft, m.
    pub offset: f64,
    /// Angle at which the spring is at rest, rad.
    pub precone: f64,
    /// Mass of one blade outboard of its hinge.
    pub mass: BladeMass,
    /// None for rigid blades.
    pub freedom: Option<Freedom>,
}

/// The mass of one blade outboard of its hinge; by default it has none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct BladeMass {
    /// Moment of inertia I about the hinge, kg.m2, > 0 for blades that flap.
    pub inertia: f64,
    /// First moment S about the hinge, kg.m.
    pub first_moment: f64,
    /// m, kg.
    pub mass: f64,
}

impl BladeMass {
    /// A uniform rod with a moment of inertia about the hinge, kg.m2, and a length from hinge to
    /// tip, m, > 0.
    pub fn rod(inertia: f64, length: f64) -> Self {
        Self {
            inertia,
            first_moment: 1.5 * inertia / length,
            mass: 3.0 * inertia / (length * length),
        }
    }
}

/// A blade that flaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Freedom {
    /// Tangent of delta3: the pitch falls by this times the flap angle above the precone.
    pub pitch_flap: f64,
    /// Length of the blade outboard of the hinge, m, > 0.
    pub length: f64,
    /// What limits the flapping.
    pub stops: Stops,
}

/// The droop stop and the flap stop of a blade. By default there are none.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stops {
    /// Flap angle below which the droop stop pushes up, rad; negative infinity without one.
    pub lowest: f64,
    /// Flap angle above which the flap stop pushes down, rad; infinity without one.
    pub highest: f64,
}

/// Depth to which the weight of a level blade presses it into a stop, rad.
const DEPTH_UNDER_WEIGHT: f64 = 0.01;
/// Frequency with which a blade bends on a stop, over the rotor speed.
const BENDING_FREQUENCY: f64 = 2.6;
/// Distance from a stop that counts as near, rad.
const NEAR_STOP: f64 = 0.05;

impl Default for Stops {
    fn default() -> Self {
        Self {
            lowest: f64::NEG_INFINITY,
            highest: f64::INFINITY,
        }
    }
}

impl Stops {
    /// How far a flap angle (rad) lies beyond the nearer stop, rad; negative between the stops.
    pub fn excess(&self, angle: f64) -> f64 {
        (self.lowest - angle).max(angle - self.highest)
    }

    /// The moment of the stops on a blade, positive up, over its moment of inertia, 1/s2; none
    /// between the stops. `frequency` is that of the blade on a stop, rad/s.
    fn push<S: Scalar>(&self, flap: Flap<S>, frequency: impl FnOnce() -> S) -> Option<S> {
        let against = |depth: S, inwards: S, frequency: S| {
            let damping = (depth / DEPTH_UNDER_WEIGHT).at_most(1.0) * 2.0 * frequency;
            (depth * frequency * frequency + damping * inwards).at_least(0.0)
        };
        if flap.angle.is_below(self.lowest) {
            let depth = -(flap.angle - self.lowest);
            Some(against(depth, -flap.rate, frequency()))
        } else if flap.angle.is_above(self.highest) {
            let depth = flap.angle - self.highest;
            Some(-against(depth, flap.rate, frequency()))
        } else {
            None
        }
    }
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

impl Hinge {
    /// beta'' of a blade, rad/s2.
    pub fn acceleration<S: Scalar>(
        &self,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
        action: &Action<S>,
    ) -> S {
        let (sin, cos) = (position.flap_sin, position.flap_cos);
        let outwards =
            -action.gravity.x * position.azimuth.cos - action.gravity.y * position.azimuth.sin;
        let weight = (cos * action.gravity.z - sin * outwards) * self.mass.first_moment;
        let held = self.spring(flow, position, action);
        self.with_inertia(action.moment - held + weight, flow, position) / self.mass.inertia
    }

    /// The moment with which spring and stops hold a blade, positive down, N.m.
    fn spring<S: Scalar>(
        &self,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
        action: &Action<S>,
    ) -> S {
        let spring = action.spring * (position.flap.angle - self.precone);
        let frequency = || self.stop_frequency(flow.rotation);
        let stops = self.freedom.map(|freedom| freedom.stops);
        match stops.and_then(|stops| stops.push(position.flap, frequency)) {
            Some(push) => spring - push * self.mass.inertia,
            None => spring,
        }
    }

    /// Frequency with which a blade swings about its hinge on a standing rotor, rad/s.
    pub fn pendulum_frequency(&self) -> f64 {
        libm::sqrt(self.mass.first_moment * STANDARD_GRAVITY / self.mass.inertia)
    }

    /// An estimate of the rate of a blade on a stop, frequency plus damping, 1/s, at a rotor speed
    /// against the air, rad/s.
    pub fn stop_rate(&self, rotation: f64) -> f64 {
        3.0 * self.stop_frequency(rotation)
    }

    /// sqrt(K/I) of a stop at a rotor speed against the air, rad/s.
    fn stop_frequency<S: Scalar>(&self, rotation: S) -> S {
        let BladeMass {
            inertia,
            first_moment,
            ..
        } = self.mass;
        let weight = first_moment * STANDARD_GRAVITY / (DEPTH_UNDER_WEIGHT * inertia);
        let bending = rotation * BENDING_FREQUENCY;
        (bending * bending + weight).sqrt()
    }

    /// A moment about the hinge together with that of the inertia forces on a blade whose flap rate
    /// does not change, positive up, N.m.
    fn with_inertia<S: Scalar>(
        &self,
        moment: S,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
    ) -> S {
        let (sin, cos) = (position.flap_sin, position.flap_cos);
        let (radial, tangential) = flow.hub_rates(position.azimuth);
        let rotation = flow.rotation;
        let inertia = self.mass.inertia;
        let offset_moment = self.offset * self.mass.first_moment;
        let turning = -flow.speed * radial * (cos * offset_moment + inertia);
        let across = (rotation * cos - radial * sin)
            * (radial * offset_moment + (radial * cos + rotation * sin) * inertia);
        let centrifugal =
            sin * offset_moment * (radial * radial + tangential * tangential + rotation * rotation);
        moment + turning - across - centrifugal
    }

    /// The integral of a_z dm over a blade whose flap rate changes by `acceleration` (rad/s2), N:
    /// beta'' and beta'^2, Coriolis, w' x r, and w x (w x r).
    fn vertical_inertia<S: Scalar>(
        &self,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
        acceleration: S,
    ) -> S {
        let (sin, cos) = (position.flap_sin, position.flap_cos);
        let (radial, tangential) = flow.hub_rates(position.azimuth);
        let rate = position.flap.rate;
        let first = self.mass.first_moment;
        let out = cos * first + self.offset * self.mass.mass;
        let up = sin * first;
        (cos * acceleration - sin * rate * rate) * first
            + tangential * 2.0 * rate * up
            + (flow.speed + flow.rotation) * radial * out
            - up * (radial * radial + tangential * tangential)
    }

    /// The moment of a flapping blade on the hub about -e_t (up) less the aerodynamic moment about
    /// the hub's centre, N.m: k (beta - beta_p) - M - h integral of a_z dm.
    pub fn hub_moment_excess<S: Scalar>(
        &self,
        flow: &DiscFlow<S>,
        position: &BladePosition<S>,
        action: &Action<S>,
    ) -> S {
        let spring = self.spring(flow, position, action);
        if self.offset == 0.0 {
            return spring - action.moment;
        }
        let acceleration = self.acceleration(flow, position, action);
        let inertia = self.vertical_inertia(flow, position, acceleration);
        spring - action.moment - inertia * self.offset
    }

    /// The same for a rigid blade: the moment of its inertia on the hub about -e_t (up), as far as
    /// it comes from the hub's roll and pitch, N.m.
    pub fn rigid_moment<S: Scalar>(&self, flow: &DiscFlow<S>, position: &BladePosition<S>) -> S {
        let on = |flow: &DiscFlow<S>| {
            self.with_inertia(S::zero(), flow, position)
                - self.vertical_inertia(flow, position, S::zero()) * self.offset
        };
        let steady = DiscFlow {
            roll_rate: S::zero(),
            pitch_rate: S::zero(),
            ..*flow
        };
        on(flow) - on(&steady)
    }
}

impl Freedom {
    /// Whether any of the blades may meet a stop within a time, s.
    pub fn may_meet_stop(&self, flaps: &[Flap], time: f64) -> bool {
        flaps
            .iter()
            .any(|flap| self.stops.excess(flap.angle) > -(NEAR_STOP + flap.rate.abs() * time))
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
        let BladeMass {
            inertia,
            first_moment,
            ..
        } = hinge.mass;
        let per_speed = PI * point.air.density * speed * chord * self.length * self.length;
        let stiffness = point.hinge_spring
            + flow.rotation * flow.rotation * (inertia + hinge.offset * first_moment)
            + point.gravity.norm() * first_moment
            + self.pitch_flap.abs() * per_speed * speed / 2.0;
        libm::sqrt(stiffness / inertia) + per_speed * self.length / 3.0 / inertia
    }
}
