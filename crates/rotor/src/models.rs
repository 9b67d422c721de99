//! The choice of models.

use super::{
    airfoil::{Lift, SectionModel},
    compressibility::Compressibility,
    flapping::Hinge,
    inflow::{Descent, ElementInflow, GroundEffect, Inflow},
    seesaw::Seesaw,
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
    /// The flapping hinges.
    pub hinge: Hinge,
    /// What makes two blades that flap, on hinges at the shaft, a seesaw.
    pub seesaw: Option<Seesaw>,
    /// Loss of lift at the ends of the blade.
    pub tip_loss: TipLoss,
    /// How section coefficients are made from airfoil data.
    pub section: SectionModel,
}

impl Default for Models {
    /// The FMU's default models: annuli, the measured law of descent, rigid blades,
    /// Prandtl's tip loss, airfoil tables with Prandtl and Glauert's rule.
    fn default() -> Self {
        Self {
            inflow: Inflow::Elements(ElementInflow::Annulus),
            descent: Descent::Measured,
            ground_effect: GroundEffect::None,
            blades: Blades::Automatic,
            hinge: Hinge::default(),
            seesaw: None,
            tip_loss: TipLoss::Prandtl,
            section: SectionModel {
                lift: Lift::Table,
                compressibility: Compressibility::PrandtlGlauert,
                drag_reynolds_exponent: 0.2,
            },
        }
    }
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
