//! The motion of the disc through the air, and the flow at a blade's section.

use super::{Azimuth, BladePosition};
use crate::numbers::{Lanes, Mask, Scalar};

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

/// The flow at a blade, without induced velocity, and the blade's position: what its sections
/// share. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BladeFlow<S = f64> {
    /// In wind axes.
    pub azimuth: Azimuth<S>,
    /// Sine of the flap angle.
    pub flap_sin: S,
    /// Cosine of the flap angle.
    pub flap_cos: S,
    /// Rate of the flap angle, rad/s.
    flap_rate: S,
    /// Change of pitch by cyclic control and flapping, rad.
    pitch: S,
    /// Rotor speed against the air, rad/s.
    rotation: S,
    /// The disc's speed along its shaft, m/s.
    climb: S,
    /// The edgewise flow against the blade's motion, and from the hub to the tip, m/s.
    edgewise: (S, S),
    /// Angular velocity of the hub about e_r and e_t, rad/s.
    hub_rates: (S, S),
    /// Radius of the flapping hinge, m.
    hinge: f64,
}

/// The flow at a blade's section, without induced velocity, and the section's pitch and position.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionFlow<L: Lanes = f64> {
    /// Change of pitch by cyclic control and flapping, rad.
    pub pitch: L,
    /// U_T: against the motion of the blade, m/s.
    pub in_plane: L,
    /// U_P: against n, down through the disc, m/s.
    pub through: L,
    /// Sine of the section's flap angle: 0 inboard of the hinge.
    pub flap_sin: L,
    /// Cosine of the section's flap angle.
    pub flap_cos: L,
    /// s, m: distance from the hinge, 0 inboard of it.
    pub outboard: L::Real,
    /// X, m: distance from the shaft.
    pub out: L,
    /// Z, m: height above the plane of the hinges.
    pub up: L,
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

    /// The flow at a blade.
    pub fn at_blade(&self, position: &BladePosition<S>) -> BladeFlow<S> {
        let Azimuth { sin, cos } = position.azimuth;
        BladeFlow {
            azimuth: position.azimuth,
            flap_sin: position.flap_sin,
            flap_cos: position.flap_cos,
            flap_rate: position.flap.rate,
            pitch: position.pitch - self.cyclic_cos * cos - self.cyclic_sin * sin,
            rotation: self.rotation,
            climb: self.climb,
            edgewise: (self.edgewise * sin, self.edgewise * cos),
            hub_rates: self.hub_rates(position.azimuth),
            hinge: self.hinge,
        }
    }
}

impl<S: Scalar> BladeFlow<S> {
    /// The flow at the sections at `radius` (m, along the blade): thesis eqs. (101) and (102), with
    /// the angular velocity of the hub and without small angles. U_T and U_P are the components
    /// along e_t and n of the section's velocity V + w x (X e_r + Z e_z) + beta' s n, because the
    /// air comes from where the section moves to. U_R of eq. (103), along the blade, has no effect
    /// on a section (independence principle) and is left out; so is the effect of sideslip on drag
    /// and stall.
    #[inline(always)]
    pub fn at_section<L: Lanes<One = S>>(&self, radius: L::Real) -> SectionFlow<L> {
        let outboard = (radius - self.hinge).at_least(0.0);
        let inboard = radius - outboard;
        let is_outboard = outboard.is_above(0.0);
        let (mut flap_sin, mut flap_cos) = (L::splat(self.flap_sin), L::splat(self.flap_cos));
        if !is_outboard.all() {
            flap_sin = L::select(is_outboard, flap_sin, L::nil());
            flap_cos = L::select(is_outboard, flap_cos, L::unit());
        }
        let (out, up) = (
            flap_cos.times(outboard).plus_real(inboard),
            flap_sin.times(outboard),
        );
        let (radial_rate, tangential_rate) = self.hub_rates;
        let lever = flap_cos.times(inboard).plus_real(outboard);
        SectionFlow {
            pitch: L::splat(self.pitch),
            in_plane: L::splat(self.rotation) * out + L::splat(self.edgewise.0)
                - L::splat(radial_rate) * up,
            through: flap_cos * L::splat(self.climb) + flap_sin * L::splat(self.edgewise.1)
                - L::splat(tangential_rate) * lever
                + L::splat(self.flap_rate).times(outboard),
            flap_sin,
            flap_cos,
            outboard,
            out,
            up,
        }
    }
}
