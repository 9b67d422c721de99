//! Inflow: the velocity that the rotor induces at its own blades.

pub mod annulus;
pub mod closed_form;
pub mod descent;
pub mod finite_blades;
pub mod ground;
pub mod linear;
pub mod peters_he;
pub mod pitt_peters;
pub mod uniform;

pub use descent::Descent;
pub use linear::Skew;

use super::{disc::Azimuth, scalar::Scalar};

/// The choice of model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inflow {
    /// Blade-element momentum theory in each annulus, all angles.
    Annulus,
    /// Small angles and a linear lift slope, axial flow only: thesis eq. (94).
    AnnulusClosedForm,
    /// Glauert's momentum theory for the disc as a whole, with a distribution over it.
    Disc(Skew),
    /// Each blade sweeps its own air: Knight & Hefner, Dahl.
    FiniteBlades,
    /// Pitt & Peters' three states, which take time to build up.
    PittPetersDynamic,
    /// Peters & He's states, to a power of the radius of 1 to 6.
    PetersHe { order: usize },
}

/// Velocity induced at a blade, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Induced<S = f64> {
    /// Down through the disc.
    pub axial: S,
    /// With the motion of the blade.
    pub swirl: S,
}

impl<S: Scalar> Induced<S> {
    /// Along the shaft only, m/s.
    pub fn axial(axial: S) -> Self {
        Self {
            axial,
            swirl: S::zero(),
        }
    }
}

/// Induced velocity over the disc: v = mean + x (cosine cos psi + sine sin psi), x = r/R, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Field<S = f64> {
    pub mean: S,
    /// Growth from the shaft to the tip towards psi = 0.
    pub cosine: S,
    /// And towards psi = 90 deg.
    pub sine: S,
}

impl<S: Scalar> Field<S> {
    /// Of a rotor that induces nothing.
    pub fn none() -> Self {
        Self {
            mean: S::zero(),
            cosine: S::zero(),
            sine: S::zero(),
        }
    }

    /// At a radius r/R and an azimuth.
    pub fn at(&self, radius_ratio: f64, azimuth: Azimuth<S>) -> Induced<S> {
        let slope = self.cosine * azimuth.cos + self.sine * azimuth.sin;
        Induced::axial(self.mean + slope * radius_ratio)
    }

    /// `factor * self`.
    pub fn scaled(&self, factor: S) -> Self {
        Self::none().plus(factor, self)
    }

    /// Whether all azimuths are alike but for `none` m/s.
    pub fn is_axisymmetric(&self, none: f64) -> bool {
        self.cosine.is_negligible(none) && self.sine.is_negligible(none)
    }

    /// `self + factor * other`.
    pub fn plus(&self, factor: S, other: &Self) -> Self {
        Self {
            mean: self.mean + factor * other.mean,
            cosine: self.cosine + factor * other.cosine,
            sine: self.sine + factor * other.sine,
        }
    }

    pub fn to_array(self) -> [S; 3] {
        [self.mean, self.cosine, self.sine]
    }
}
