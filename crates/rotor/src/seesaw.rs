//! The seesaw of a teetering rotor: two blades that are one body on a hinge at the shaft.
//!
//! The body has one degree of freedom, the teeter angle b: blade 1 lies at beta_p + b and blade 2
//! at beta_p - b. The precone beta_p is built in. The axes of the blades meet the shaft a distance
//! u, the undersling, below the hinge.
//!
//! With a_k the acceleration that `flapping` gives a single blade on a hinge at the shaft, the
//! moment with which the blades hold each other is equal for both. It cancels in (I a_1 - I a_2)/2,
//! which therefore moves the seesaw without undersling. The undersling changes the moments of
//! inertia about the teeter axis and about the axis along the blades by D each, for one blade, and
//! the one about the shaft not at all:
//!
//! ```text
//! D = integral of (s sin beta_p - u)^2 - (s sin beta_p)^2 dm = m u^2 - 2 u S sin beta_p
//! ```
//!
//! Euler's equations for the body (Goldstein 1980, "Classical Mechanics", eq. 5-39) with the
//! angular velocity (w_r cos b + W sin b, w_t - b', W cos b - w_r sin b) then give, with the
//! symbols of `flapping` at blade 1,
//!
//! ```text
//! (I + D) b'' = (I a_1 - I a_2)/2 + D (w_t' + (w_r cos b + W sin b) (W cos b - w_r sin b))
//!               + m u (g_z sin b + g_r cos b)
//! ```
//!
//! For a hub at rest and u = 0 the teetering frequency is Omega sqrt(cos 2 beta_p): a little below
//! the rotor speed, because of the height of the coned blades. The hub feels a moment about the
//! teeter axis through the springs only.
//!
//! In place of b the flap angles of both blades are states. In exact arithmetic beta_1 + beta_2 = 2
//! beta_p, and rounding errors, or an importer that sets the states otherwise, are damped out:
//! the sum c of the flap angles above the precone obeys c'' = -W^2 c - 2 W c', critically damped.
//!
//! Assumptions: those of `flapping`; and the air forces along the blade have no lever at the
//! undersling: it is some hundredths of the radius, and these forces are some hundredths of the
//! lift.

use super::{
    disc::{BladePosition, DiscFlow},
    flapping::{Action, Hinge},
    numbers::Scalar,
};

/// A seesaw.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Seesaw {
    /// Distance of the hinge above the point where the axes of the blades meet the shaft, m.
    pub undersling: f64,
}

impl Seesaw {
    /// D, kg.m2.
    fn inertia(&self, hinge: &Hinge) -> f64 {
        let height = 2.0 * hinge.mass.first_moment * libm::sin(hinge.precone);
        self.undersling * (self.undersling * hinge.mass.mass - height)
    }

    /// b'', rad/s2, from the positions of both blades and what acts on them.
    pub fn acceleration<S: Scalar>(
        &self,
        hinge: &Hinge,
        flow: &DiscFlow<S>,
        blades: [(&BladePosition<S>, &Action<S>); 2],
    ) -> S {
        let [one, two] =
            blades.map(|(position, action)| hinge.acceleration(flow, position, action));
        let free = (one - two) * 0.5;
        if self.undersling == 0.0 {
            return free;
        }
        let [(position, action), (other, _)] = blades;
        let angle = (position.flap.angle - other.flap.angle) * 0.5;
        let (sin, cos) = (angle.sin(), angle.cos());
        let (radial, _) = flow.hub_rates(position.azimuth);
        let along = radial * cos + flow.rotation * sin;
        let across = flow.rotation * cos - radial * sin;
        let outwards =
            -action.gravity.x * position.azimuth.cos - action.gravity.y * position.azimuth.sin;
        let weight =
            (action.gravity.z * sin + outwards * cos) * (hinge.mass.mass * self.undersling);
        let more = self.inertia(hinge);
        let moment =
            free * hinge.mass.inertia + (along * across - flow.speed * radial) * more + weight;
        moment / (hinge.mass.inertia + more)
    }

    /// beta'' of each blade, rad/s2.
    pub fn accelerations<S: Scalar>(
        &self,
        hinge: &Hinge,
        flow: &DiscFlow<S>,
        blades: [(&BladePosition<S>, &Action<S>); 2],
    ) -> [S; 2] {
        let teetering = self.acceleration(hinge, flow, blades);
        let [one, two] = blades.map(|(position, _)| position.flap);
        let sum = one.angle + two.angle - 2.0 * hinge.precone;
        let rate = one.rate + two.rate;
        let back = (flow.rotation * flow.rotation * sum + flow.rotation.abs() * rate * 2.0) * 0.5;
        [teetering - back, -teetering - back]
    }
}
