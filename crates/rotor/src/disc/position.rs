//! Blade positions: azimuth and flapping.

use super::Azimuth;
use crate::numbers::Scalar;
use arrayvec::ArrayVec;
use core::f64::consts::PI;

/// Number of azimuths over which a disc without axial symmetry is averaged. All harmonics of the
/// loads up to the 23rd are averaged exactly; against 144 azimuths, the thrust of the default rotor
/// at an advance ratio of 0.26 differs by 1e-6.
pub const AZIMUTHS: usize = 24;

/// Flapping of one blade: angle above the plane perpendicular to the shaft, rad, and its rate,
/// rad/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Flap<S = f64> {
    /// beta, rad.
    pub angle: S,
    /// d(beta)/dt, rad/s.
    pub rate: S,
}

impl<S: Scalar> Flap<S> {
    /// A blade held at an angle, rad.
    pub fn rigid(angle: f64) -> Self {
        Self {
            angle: S::constant(angle),
            rate: S::zero(),
        }
    }
}

/// A blade position: azimuth and flapping.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BladePosition<S = f64> {
    /// In wind axes.
    pub azimuth: Azimuth<S>,
    /// Flap angle and rate.
    pub flap: Flap<S>,
    /// Sine of the flap angle.
    pub flap_sin: S,
    /// Cosine of the flap angle.
    pub flap_cos: S,
    /// Change of pitch by flapping (delta3), rad.
    pub pitch: S,
}

impl<S: Scalar> BladePosition<S> {
    /// A blade at `azimuth` that flaps with `flap`; flapping adds `pitch` (rad) to its pitch.
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

/// Something for each of the positions of the blades, or of those over which the disc is averaged:
/// 1 to `AZIMUTHS`.
pub type OfPositions<T> = ArrayVec<T, AZIMUTHS>;

// A rotor of the maximum number of blades must fit in.
const _: () = assert!(crate::geometry::MAX_BLADES as usize <= AZIMUTHS);

/// Azimuths evenly around the disc, offset by half a step so that none lies exactly where the flow
/// reverses.
pub fn evenly_spaced() -> [Azimuth; AZIMUTHS] {
    std::array::from_fn(|i| {
        let psi = 2.0 * PI * (i as f64 + 0.5) / AZIMUTHS as f64;
        Azimuth {
            sin: libm::sin(psi),
            cos: libm::cos(psi),
        }
    })
}
