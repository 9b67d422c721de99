//! Models in which each element finds its induced velocity by itself.

use super::{Disc, annulus, closed_form, finite_blades};
use crate::{element::Element, root::RootError, scalar::Scalar, sweep::Sweep};

/// A model in which the induced velocity of an element depends on no other element.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ElementInflow {
    /// Blade-element momentum theory in each annulus, all angles.
    Annulus,
    /// Small angles and a linear lift slope, axial flow only: thesis eq. (94).
    AnnulusClosedForm,
    /// Each blade sweeps its own air: Knight & Hefner, Dahl.
    FiniteBlades,
}

impl ElementInflow {
    /// Whether the model holds only for axial flow past rigid blades.
    pub fn is_axial_only(self) -> bool {
        match self {
            Self::AnnulusClosedForm => true,
            Self::Annulus | Self::FiniteBlades => false,
        }
    }

    /// Computes the loads of an element, which `sweep` moves around the azimuth. Returns the mean
    /// induced velocity around its annulus, m/s. Fails only if numbers are not finite or overflow.
    pub(crate) fn load<S: Scalar>(
        self,
        disc: &Disc<S>,
        element: &Element<S>,
        sweep: &mut Sweep<S>,
    ) -> Result<S, RootError> {
        match self {
            Self::Annulus => annulus::load(disc, element, sweep),
            Self::AnnulusClosedForm => closed_form::load(disc, element, sweep),
            Self::FiniteBlades => finite_blades::load(disc, element, sweep),
        }
    }
}
