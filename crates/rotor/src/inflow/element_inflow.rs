//! Models in which each element finds its induced velocity by itself.

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
}
