//! The seesaw of a teetering rotor: two blades that are one body on a hinge at the shaft.
//!
//! The body has one degree of freedom, the teeter angle b: blade 1 lies at beta_p + b and blade 2
//! at beta_p - b. The precone beta_p is built in. The axes of the blades meet the shaft a distance
//! u, the undersling, below the hinge.
//!
//! A blade is a rod, so that the principal axes of the body are the line along the blades, the
//! teeter axis and the line across both, which is the shaft at b = 0. With s the distance from the
//! crossing of the blade axes, each blade adds to the moments of inertia about the hinge
//!
//! ```text
//! along the blades:      I sin^2 beta_p + D
//! about the teeter axis: I + D
//! across both:           I cos^2 beta_p
//! D = integral of (s sin beta_p - u)^2 - (s sin beta_p)^2 dm = m u^2 - 2 u S sin beta_p
//! ```
//!
//! The angular velocity along these axes is (w_r cos b + W sin b, w_t - b', W cos b - w_r sin b),
//! with the symbols of `flapping` at blade 1. Euler's equation about the teeter axis (Goldstein
//! 1980, "Classical Mechanics", eq. 5-39) is then
//!
//! ```text
//! (I + D) b'' = (I a_1 - I a_2)/2 + D (w_t' + (w_r cos b + W sin b) (W cos b - w_r sin b))
//!               + m u (g_z sin b + g_r cos b),        w_t' = -Omega w_r
//! ```
//!
//! a_k is the acceleration that `flapping` gives blade k alone on a hinge at the shaft: half the
//! difference of the two is Euler's equation for u = 0, because the moment with which the blades
//! hold each other is equal for both and cancels. For a hub at rest and u = 0 the teetering
//! frequency is Omega sqrt(cos 2 beta_p): a little below the rotor speed, because the coned blades
//! reach above the hinge. The hub feels a moment about the teeter axis through the springs only.
//!
//! When the equation holds:
//!
//! * At any teeter angle and precone: no angle is small.
//! * While the rotor speed varies: Omega' has no moment about the teeter axis, which is a principal
//!   axis at right angles to the shaft.
//! * On a hub that turns at any roll, pitch and yaw rate, if the rates change slowly: p' and q',
//!   which belong in w_t', are left out, as in `flapping`. So is the acceleration of the hub.
//! * On a shaft that leans in any direction: gravity acts on the centre of mass of the body.
//!
//! Two effects of the undersling are left out. The air forces along the blades have no lever u: u
//! is some hundredths of the radius, and these forces are some hundredths of the lift. And the
//! sections move through the air as with u = 0: the crossing of the blade axes, which swings below
//! the hinge, would add u W sin b to U_T.
//!
//! In place of b the flap angles of both blades are states. In exact arithmetic beta_1 + beta_2 = 2
//! beta_p, and rounding errors, or an importer that sets the states otherwise, are damped out:
//! the sum c of the flap angles above the precone obeys c'' = -W^2 c - 2 |W| c', critically damped.

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
    /// D, what the undersling adds to the moment of inertia of one blade, kg.m2.
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
        // Angular velocity about the principal axes.
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
        // The critically damped way back of angles that one body cannot have.
        let sum = one.angle + two.angle - 2.0 * hinge.precone;
        let rate = one.rate + two.rate;
        let back = (flow.rotation * flow.rotation * sum + flow.rotation.abs() * rate * 2.0) * 0.5;
        [teetering - back, -teetering - back]
    }
}
