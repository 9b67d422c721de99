//! The disc: how its blades move through the air around the azimuth, in axes turned into the wind.
//!
//! Axes. x points from the shaft into the flow along the disc, z up along the shaft, y to the left
//! of x; the rotor turns counter-clockwise seen from above (a clockwise one is mirrored before it
//! comes here). The azimuth psi counts from downwind in the turning sense, so that with flow along
//! the disc the blade advances at psi = 90 deg.
//!
//! A blade at psi points along e_r = (-cos psi, -sin psi, 0) and moves along e_t = (sin psi, -cos psi,
//! 0). Beyond its hinge at the radius h it is turned up by the flap angle beta: the section at the
//! distance s from the hinge lies at X e_r + Z e_z with X = h + s cos beta, Z = s sin beta, and n =
//! cos beta e_z - sin beta e_r is perpendicular to the blade.

use super::{flapping::Flap, inflow::Field, scalar::Scalar};
use core::f64::consts::PI;

/// Number of azimuths over which a disc without axial symmetry is averaged. All harmonics of the
/// loads up to the 23rd are averaged exactly; against 144 azimuths, the thrust of the default rotor
/// at an advance ratio of 0.26 differs by 1e-6.
pub const AZIMUTHS: usize = 24;

/// The motion of the disc through the air, without what it induces. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DiscFlow<S = f64> {
    /// Rotor speed against the air, and against the hub, rad/s.
    pub rotation: S,
    pub speed: S,
    /// Speed along the disc, >= 0, m/s.
    pub edgewise: S,
    /// Speed along the shaft, climb positive, m/s.
    pub climb: S,
    /// Angular velocity of the hub about x and y, rad/s.
    pub roll_rate: S,
    pub pitch_rate: S,
    /// Pitch = collective + twist - cyclic_cos cos(psi) - cyclic_sin sin(psi).
    pub cyclic_cos: S,
    pub cyclic_sin: S,
    /// Radius beyond which the blades flap, m.
    pub hinge: f64,
}

/// What a quantity of the hub needs to be turned into the axes of `DiscFlow`, and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WindAxes<S = f64> {
    pub cos: S,
    pub sin: S,
}

/// One azimuth. On an axially symmetrical disc there is a single one without a direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Azimuth<S = f64> {
    pub sin: S,
    pub cos: S,
}

/// Where a blade is: its azimuth and how it flaps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place<S = f64> {
    pub azimuth: Azimuth<S>,
    pub flap: Flap<S>,
    pub flap_sin: S,
    pub flap_cos: S,
    /// Change of the pitch by flapping (delta3), rad.
    pub pitch: S,
}

/// The flow that meets a blade's section, without what the rotor induces; its pitch and its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encounter<S = f64> {
    /// Change of the pitch by cyclic control and flapping, rad.
    pub pitch: S,
    /// U_T: against the motion of the blade, m/s.
    pub in_plane: S,
    /// U_P: against n, m/s.
    pub through: S,
    /// Sine and cosine of the section's flap angle.
    pub flap_sin: S,
    pub flap_cos: S,
    /// s, m: distance from the hinge, 0 inside it.
    pub outboard: f64,
    /// X and Z, m.
    pub out: S,
    pub up: S,
}

/// The places of the blades, or those over which the disc is averaged.
#[derive(Debug, Clone, Copy)]
pub struct Places<S = f64> {
    all: [Place<S>; AZIMUTHS],
    count: usize,
}

impl<S: Scalar> WindAxes<S> {
    /// Axes for a hub that moves with (forward, left) through the air, m/s.
    pub fn new(forward: S, left: S) -> Self {
        let ahead = (S::one(), S::zero());
        let (cos, sin) = S::direction(forward, left).unwrap_or(ahead);
        Self { cos, sin }
    }

    /// A vector's parts along the hub's (forward, left) as parts along the axes' x and y.
    pub fn into_wind(&self, forward: S, left: S) -> (S, S) {
        (
            forward * self.cos + left * self.sin,
            left * self.cos - forward * self.sin,
        )
    }

    /// A field's slopes towards psi = 0 and 90 deg turn like a vector's parts.
    pub fn field_into_wind(&self, field: &Field<S>) -> Field<S> {
        let (cosine, sine) = self.into_wind(field.cosine, field.sine);
        Field {
            cosine,
            sine,
            ..*field
        }
    }

    /// The way back.
    pub fn field_out_of_wind(&self, field: &Field<S>) -> Field<S> {
        let (cosine, sine) = self.out_of_wind(field.cosine, field.sine);
        Field {
            cosine,
            sine,
            ..*field
        }
    }

    /// The way back.
    pub fn out_of_wind(&self, x: S, y: S) -> (S, S) {
        (x * self.cos - y * self.sin, x * self.sin + y * self.cos)
    }
}

impl<S: Scalar> Place<S> {
    /// A blade at an azimuth that flaps with `flap`; `pitch` (rad) is what flapping adds to its pitch.
    pub fn new(azimuth: Azimuth<S>, flap: Flap<S>, pitch: S) -> Self {
        Self {
            azimuth,
            flap,
            flap_sin: flap.angle.sin(),
            flap_cos: flap.angle.cos(),
            pitch,
        }
    }
}

impl<S: Scalar> Places<S> {
    /// At most `AZIMUTHS` places: as many as the disc is averaged over, and more than a rotor has blades.
    pub fn new(places: impl Iterator<Item = Place<S>>) -> Self {
        let nowhere = Place::new(Azimuth::nowhere(), Flap::rigid(0.0), S::zero());
        let mut all = [nowhere; AZIMUTHS];
        let mut count = 0;
        for (slot, place) in all.iter_mut().zip(places) {
            *slot = place;
            count += 1;
        }
        Self { all, count }
    }
}

impl<S> std::ops::Deref for Places<S> {
    type Target = [Place<S>];

    fn deref(&self) -> &[Place<S>] {
        &self.all[..self.count]
    }
}

impl<S: Scalar> Azimuth<S> {
    /// The one without a direction.
    pub fn nowhere() -> Self {
        Self {
            sin: S::zero(),
            cos: S::zero(),
        }
    }
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

    /// Angular velocity of the hub about a blade's e_r and e_t, rad/s.
    pub fn hub_rates(&self, azimuth: Azimuth<S>) -> (S, S) {
        let Azimuth { sin, cos } = azimuth;
        (
            -self.roll_rate * cos - self.pitch_rate * sin,
            self.roll_rate * sin - self.pitch_rate * cos,
        )
    }

    /// What a section at `radius` (m, along the blade) meets: thesis eqs. (101) and (102) with the angular
    /// velocity of the hub and without small angles. The velocity of the section, V + w x (X e_r + Z e_z) +
    /// beta' s n, along e_t and against n. U_R of eq. (103), along the blade, has no effect on a section
    /// (independence principle) and is left out; so is the sideslip's effect on drag and stall.
    pub fn meets(&self, radius: f64, place: &Place<S>) -> Encounter<S> {
        let Azimuth { sin, cos } = place.azimuth;
        let outboard = (radius - self.hinge).max(0.0);
        let (flap_sin, flap_cos) = if outboard > 0.0 {
            (place.flap_sin, place.flap_cos)
        } else {
            (S::zero(), S::one())
        };
        let inboard = radius - outboard;
        let (out, up) = (flap_cos * outboard + inboard, flap_sin * outboard);
        let (radial_rate, tangential_rate) = self.hub_rates(place.azimuth);
        Encounter {
            pitch: place.pitch - self.cyclic_cos * cos - self.cyclic_sin * sin,
            in_plane: self.rotation * out + self.edgewise * sin - radial_rate * up,
            through: flap_cos * self.climb + flap_sin * self.edgewise * cos
                - tangential_rate * (flap_cos * inboard + outboard)
                + place.flap.rate * outboard,
            flap_sin,
            flap_cos,
            outboard,
            out,
            up,
        }
    }
}

/// Azimuths evenly around the disc, half a step off the axes: none lies exactly where the flow reverses.
pub fn around() -> [Azimuth; AZIMUTHS] {
    std::array::from_fn(|i| {
        let psi = 2.0 * PI * (i as f64 + 0.5) / AZIMUTHS as f64;
        Azimuth {
            sin: libm::sin(psi),
            cos: libm::cos(psi),
        }
    })
}
