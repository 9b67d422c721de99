//! Induced velocity at one blade, and its linear distributions over the disc.

use super::{
    disc::{Azimuth, WindAxes},
    numbers::{Lanes, Scalar},
};

/// Velocity induced at a blade, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Induced<S = f64> {
    /// Down through the disc.
    pub axial: S,
    /// With the motion of the blade.
    pub swirl: S,
}

impl<L: Lanes> Induced<L> {
    /// Along the shaft only, m/s.
    #[inline(always)]
    pub fn axial(axial: L) -> Self {
        Self {
            axial,
            swirl: L::nil(),
        }
    }

    /// `factor * self`.
    #[inline(always)]
    pub fn scaled(&self, factor: L) -> Self {
        Self {
            axial: factor * self.axial,
            swirl: factor * self.swirl,
        }
    }
}

/// Induced velocity over the disc: v = mean + x (cosine cos psi + sine sin psi), x = r/R, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Field<S = f64> {
    /// Mean over the disc.
    pub mean: S,
    /// Growth from the shaft to the tip towards psi = 0.
    pub cosine: S,
    /// Growth from the shaft to the tip towards psi = 90 deg.
    pub sine: S,
}

impl<S: Scalar> Field<S> {
    /// No induced velocity.
    pub fn zero() -> Self {
        Self {
            mean: S::zero(),
            cosine: S::zero(),
            sine: S::zero(),
        }
    }

    /// From three states in the order mean, cosine, sine; the slice has at least three.
    pub fn from_states(states: &[S]) -> Self {
        Self {
            mean: states[0],
            cosine: states[1],
            sine: states[2],
        }
    }

    /// At radii r/R and an azimuth.
    #[inline(always)]
    pub fn at<L: Lanes<One = S>>(&self, radius_ratio: L::Real, azimuth: Azimuth<S>) -> Induced<L> {
        let slope = self.cosine * azimuth.cos + self.sine * azimuth.sin;
        Induced::axial(L::splat(self.mean) + L::splat(slope).times(radius_ratio))
    }

    /// `factor * self`.
    pub fn scaled(&self, factor: S) -> Self {
        Self::zero().plus(factor, self)
    }

    /// Whether all azimuths are alike but for `limit` m/s.
    pub fn is_axisymmetric(&self, limit: f64) -> bool {
        self.cosine.is_negligible(limit) && self.sine.is_negligible(limit)
    }

    /// `self + factor * other`.
    pub fn plus(&self, factor: S, other: &Self) -> Self {
        Self {
            mean: self.mean + factor * other.mean,
            cosine: self.cosine + factor * other.cosine,
            sine: self.sine + factor * other.sine,
        }
    }

    /// From the hub frame to wind axes: the slopes towards psi = 0 and 90 deg turn like the
    /// components of a vector.
    pub fn into_wind(&self, axes: &WindAxes<S>) -> Self {
        let (cosine, sine) = axes.into_wind(self.cosine, self.sine);
        Self {
            cosine,
            sine,
            ..*self
        }
    }

    /// From wind axes to the hub frame.
    pub fn out_of_wind(&self, axes: &WindAxes<S>) -> Self {
        let (cosine, sine) = axes.out_of_wind(self.cosine, self.sine);
        Self {
            cosine,
            sine,
            ..*self
        }
    }

    /// Mean, cosine, sine.
    pub fn to_array(self) -> [S; 3] {
        [self.mean, self.cosine, self.sine]
    }
}
