//! The choice of models.

use super::{
    airfoil::SectionModel,
    flapping::Hinge,
    inflow::{Descent, GroundEffect, Inflow},
    tip_loss::TipLoss,
};

/// The models with which a rotor is computed.
#[derive(Debug, Clone, PartialEq)]
pub struct Models {
    /// How the induced velocity is found.
    pub inflow: Inflow,
    /// How momentum theory is corrected in descent.
    pub descent: Descent,
    /// How the ground reduces the induced velocity.
    pub ground_effect: GroundEffect,
    /// Blades one by one, or averages over one revolution.
    pub blades: Blades,
    /// How the blades are held.
    pub hinge: Hinge,
    /// Loss of lift at the ends of the blade.
    pub tip_loss: TipLoss,
    /// How section coefficients are made from airfoil data.
    pub section: SectionModel,
}

/// Whether loads are those of the blades at their azimuths or averages over one revolution.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Blades {
    /// `Disc` where all azimuths are alike and the blades do not flap, else `Individual`.
    #[default]
    Automatic,
    /// Averages over one revolution of rigid blades.
    Disc,
    /// Each blade at its azimuth.
    Individual,
}
