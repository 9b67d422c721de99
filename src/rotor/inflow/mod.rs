//! Inflow: the velocity that the rotor induces at its own blades.

pub mod annulus;
pub mod closed_form;
pub mod linear;
pub mod uniform;

pub use linear::Skew;

use super::disc::Azimuth;
use linear::Coefficients;

/// The choice of model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inflow {
    /// Blade-element momentum theory in each annulus, all angles.
    Annulus,
    /// Small angles and a linear lift slope, axial flow only: thesis eq. (94).
    AnnulusClosedForm,
    /// Glauert's momentum theory for the disc as a whole, with a distribution over it.
    Disc(Skew),
}

/// Velocity induced at a blade, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Induced {
    /// Down through the disc.
    pub axial: f64,
    /// With the motion of the blade.
    pub swirl: f64,
}

/// Induced velocity over the disc: v = mean (1 + x (kx cos psi + ky sin psi)), x = r/R, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Field {
    pub mean: f64,
    pub coefficients: Coefficients,
}

impl Field {
    /// At a radius r/R and an azimuth from downwind.
    pub fn at(&self, radius_ratio: f64, azimuth: Azimuth) -> Induced {
        let Coefficients { kx, ky } = self.coefficients;
        let shape = 1.0 + radius_ratio * (kx * azimuth.cos + ky * azimuth.sin);
        Induced {
            axial: self.mean * shape,
            swirl: 0.0,
        }
    }
}
