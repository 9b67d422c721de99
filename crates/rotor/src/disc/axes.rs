//! Wind axes, and azimuths in them.

use crate::numbers::Scalar;

/// The hub frame rotated about the shaft so that x points into the edgewise flow: cosine and sine
/// of the angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WindAxes<S = f64> {
    /// Cosine of the angle from the hub's x axis to the axes' x axis.
    pub cos: S,
    /// Sine of that angle, positive to the left.
    pub sin: S,
}

/// Sine and cosine of an azimuth. An axially symmetric disc has a single azimuth without direction,
/// both 0.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Azimuth<S = f64> {
    /// sin psi.
    pub sin: S,
    /// cos psi.
    pub cos: S,
}

impl<S: Scalar> WindAxes<S> {
    /// Axes for a hub that moves with (`forward`, `left`) through the air, m/s; those of the hub in
    /// hover.
    pub fn new(forward: S, left: S) -> Self {
        let ahead = (S::one(), S::zero());
        let (cos, sin) = S::direction(forward, left).unwrap_or(ahead);
        Self { cos, sin }
    }

    /// Components along the hub's (forward, left) as components along the axes' x and y.
    pub fn into_wind(&self, forward: S, left: S) -> (S, S) {
        (
            forward * self.cos + left * self.sin,
            left * self.cos - forward * self.sin,
        )
    }

    /// Components along the axes' x and y as components along the hub's (forward, left).
    pub fn out_of_wind(&self, x: S, y: S) -> (S, S) {
        (x * self.cos - y * self.sin, x * self.sin + y * self.cos)
    }
}

impl<S: Scalar> Azimuth<S> {
    /// The azimuth without direction that stands for all azimuths of an axially symmetric disc.
    pub fn any() -> Self {
        Self {
            sin: S::zero(),
            cos: S::zero(),
        }
    }
}
