//! A blade at an operating point: its elements one by one.

use super::{
    air::Air,
    airfoil::{Airfoil, SectionModel, Similarity},
    element::{Element, Section},
    geometry::{Elements, Geometry},
    scalar::Scalar,
    tip_loss::TipLoss,
    work::Work,
};

/// The blade of a rotor in air, at a collective.
#[derive(Debug, Clone, Copy)]
pub struct Blade<'a, S = f64> {
    /// Shape of the rotor.
    pub geometry: &'a Geometry,
    /// Where the elements are.
    pub elements: &'a Elements,
    /// One for each of `geometry.airfoils`.
    pub airfoils: &'a [Airfoil],
    /// How coefficients are made from airfoil data.
    pub section: &'a SectionModel,
    /// Loss of lift at the ends.
    pub tip_loss: TipLoss,
    /// The air around the rotor.
    pub air: &'a Air<S>,
    /// Pitch at the reference radius, rad.
    pub collective: S,
    /// Fraction of each element that carries lift, 0 to 1.
    pub lifting_shares: &'a [S],
    /// Counts the computations of sections.
    pub work: &'a Work,
}

impl<'a, S: Scalar> Blade<'a, S> {
    /// Number of elements.
    pub fn len(&self) -> usize {
        self.elements.len()
    }

    /// Width of each element, m.
    pub fn width(&self) -> f64 {
        self.elements.width
    }

    /// Element `i` from the root.
    pub fn element(&self, i: usize) -> Element<'a, S> {
        let (elements, air) = (self.elements, self.air);
        let chord = elements.chord[i];
        Element {
            blades: f64::from(self.geometry.blades),
            radius: elements.radius[i],
            root_radius: self.geometry.cutout() * self.geometry.radius,
            tip_radius: self.geometry.radius,
            chord,
            pitch: self.collective + elements.twist[i],
            lifting_share: self.lifting_shares[i],
            tip_loss: self.tip_loss,
            section: Section {
                inner: &self.airfoils[elements.inner_airfoil[i]],
                outer: &self.airfoils[elements.outer_airfoil[i]],
                outer_share: elements.outer_share[i],
            },
            model: self.section,
            unit_flow: Similarity {
                reynolds: air.density * chord / air.viscosity,
                mach: S::one() / air.speed_of_sound,
            },
            density: air.density,
            work: self.work,
        }
    }
}
