//! The memory in which a rotor computes.

use super::{
    blade_loads::ElementLoads,
    numbers::{Scalar, Width},
    rotor::Rotor,
    work::Work,
};

/// Scratch memory for computations with one rotor at a time, in plain or dual numbers. It carries
/// nothing from one computation to the next, except what they may cost in all.
#[derive(Debug, Clone)]
pub struct Workspace<S = f64> {
    /// Fraction of each element that carries lift.
    pub(crate) lifting_shares: Vec<S>,
    /// Loads of each element.
    pub(crate) elements: Vec<ElementLoads<S>>,
    /// What computations in this memory may cost; without a bound by default.
    pub work: Work,
    /// The lanes in which it computes: the widest by default. No answer depends on it.
    pub width: Width,
}

impl<S: Scalar> Default for Workspace<S> {
    /// No memory yet; the first computation allocates it.
    fn default() -> Self {
        Self {
            lifting_shares: Vec::new(),
            elements: Vec::new(),
            work: Work::default(),
            width: Width::default(),
        }
    }
}

impl<S: Scalar> Workspace<S> {
    /// Memory for a rotor.
    pub fn new(rotor: &Rotor) -> Self {
        let mut workspace = Self::default();
        workspace.prepare(rotor);
        workspace
    }

    /// Makes room for a rotor, whose lift ends where its shape says; allocates only if the last
    /// rotor had fewer elements. The loads keep what they hold: each computation writes them all.
    pub(crate) fn prepare(&mut self, rotor: &Rotor) {
        let shares = rotor.lifting_shares();
        let shares = shares.iter().map(|share| S::constant(*share));
        self.lifting_shares.clear();
        self.lifting_shares.extend(shares);
        self.elements
            .resize(rotor.elements().len(), ElementLoads::zero());
    }

    /// Whether no memory has been allocated yet.
    pub fn is_empty(&self) -> bool {
        self.elements.is_empty()
    }

    pub(crate) fn elements(&self) -> &[ElementLoads<S>] {
        &self.elements
    }
}
