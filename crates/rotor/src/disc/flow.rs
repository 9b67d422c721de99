//! The motion of the disc through the air, and the flow at a blade's section.

use super::{Azimuth, BladePosition};
use crate::scalar::Scalar;

/// The motion of the disc through the air in wind axes, without induced velocity. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DiscFlow<S = f64> {
    /// Rotor speed against the air, rad/s: that against the hub plus the hub's yaw rate.
    pub rotation: S,
    /// Rotor speed against the hub, rad/s.
    pub speed: S,
    /// Speed of the edgewise flow, >= 0, m/s.
    pub edgewise: S,
    /// Speed along the shaft, climb positive, m/s.
    pub climb: S,
    /// Angular velocity of the hub about x, rad/s.
    pub roll_rate: S,
    /// Angular velocity of the hub about y, rad/s.
    pub pitch_rate: S,
    /// Pitch = collective + twist - cyclic_cos cos(psi) - cyclic_sin sin(psi), rad.
    pub cyclic_cos: S,
    /// See `cyclic_cos`, rad.
    pub cyclic_sin: S,
    /// Radius of the flapping hinges, m: the blades flap outboard of it.
    pub hinge: f64,
}

/// The flow at a blade's section, without induced velocity, and the section's pitch and position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionFlow<S = f64> {
    /// Change of pitch by cyclic control and flapping, rad.
    pub pitch: S,
    /// U_T: against the motion of the blade, m/s.
    pub in_plane: S,
    /// U_P: against n, down through the disc, m/s.
    pub through: S,
    /// Sine of the section's flap angle: 0 inboard of the hinge.
    pub flap_sin: S,
    /// Cosine of the section's flap angle.
    pub flap_cos: S,
    /// s, m: distance from the hinge, 0 inboard of it.
    pub outboard: f64,
    /// X, m: distance from the shaft.
    pub out: S,
    /// Z, m: height above the plane of the hinges.
    pub up: S,
}

impl<S: Scalar> DiscFlow<S> {
    /// Whether all azimuths are alike.
    pub fn is_axisymmetric(&self) -> bool {
        let Self {
            edgewise,
            roll_rate,
            pitch_rate,
            cyclic_cos,
            cyclic_sin,
            ..
        } = *self;
        [edgewise, roll_rate, pitch_rate, cyclic_cos, cyclic_sin]
            .iter()
            .all(|x| x.is_negligible(0.0))
    }

    /// Whether the hub neither rolls nor pitches.
    pub fn is_hub_steady(&self) -> bool {
        self.roll_rate.is_negligible(0.0) && self.pitch_rate.is_negligible(0.0)
    }

    /// Angular velocity of the hub about a blade's e_r and e_t, rad/s.
    pub fn hub_rates(&self, azimuth: Azimuth<S>) -> (S, S) {
        let Azimuth { sin, cos } = azimuth;
        (
            -self.roll_rate * cos - self.pitch_rate * sin,
            self.roll_rate * sin - self.pitch_rate * cos,
        )
    }

    /// The flow at the section at `radius` (m, along the blade): thesis eqs. (101) and (102), with
    /// the angular velocity of the hub and without small angles. U_T and U_P are the components
    /// along e_t and n of the section's velocity V + w x (X e_r + Z e_z) + beta' s n, because the
    /// air comes from where the section moves to. U_R of eq. (103), along the blade, has no effect
    /// on a section (independence principle) and is left out; so is the effect of sideslip on drag
    /// and stall.
    pub fn at_section(&self, radius: f64, position: &BladePosition<S>) -> SectionFlow<S> {
        let Azimuth { sin, cos } = position.azimuth;
        let outboard = (radius - self.hinge).max(0.0);
        let (flap_sin, flap_cos) = if outboard > 0.0 {
            (position.flap_sin, position.flap_cos)
        } else {
            (S::zero(), S::one())
        };
        let inboard = radius - outboard;
        let (out, up) = (flap_cos * outboard + inboard, flap_sin * outboard);
        let (radial_rate, tangential_rate) = self.hub_rates(position.azimuth);
        SectionFlow {
            pitch: position.pitch - self.cyclic_cos * cos - self.cyclic_sin * sin,
            in_plane: self.rotation * out + self.edgewise * sin - radial_rate * up,
            through: flap_cos * self.climb + flap_sin * self.edgewise * cos
                - tangential_rate * (flap_cos * inboard + outboard)
                + position.flap.rate * outboard,
            flap_sin,
            flap_cos,
            outboard,
            out,
            up,
        }
    }
}
