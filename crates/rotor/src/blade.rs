//! A blade at an operating point: its elements, block by block.

use super::{
    air::Air,
    airfoil::{Airfoil, SectionModel, Similarity},
    element::{Element, Section},
    geometry::{Block, Elements, Geometry},
    numbers::{Lanes, Plain, Scalar},
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

    /// The elements of a block, side by side.
    #[inline(always)]
    pub fn block<L: Lanes<One = S>>(&self, block: &'a Block) -> Element<'a, L> {
        let air = self.air;
        let chord = L::Real::load(&block.chord);
        let twist = L::Real::load(&block.twist);
        Element {
            blades: f64::from(self.geometry.blades),
            radius: L::Real::load(&block.radius),
            root_radius: self.geometry.cutout() * self.geometry.radius,
            tip_radius: self.geometry.radius,
            chord,
            pitch: L::splat(self.collective).plus_real(twist),
            lifting_share: L::from_lanes(|lane| self.lifting_shares[block.element(lane)]),
            tip_loss: self.tip_loss,
            section: Section {
                airfoils: self.airfoils,
                shares: &block.airfoils,
            },
            model: self.section,
            unit_flow: Similarity {
                reynolds: L::splat(air.density / air.viscosity).times(chord),
                mach: L::splat(S::one() / air.speed_of_sound),
            },
            density: L::splat(air.density),
            work: self.work,
            count: block.count as u64,
        }
    }
}
