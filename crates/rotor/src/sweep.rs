//! Blade elements side by side moved around the azimuth: their loads at each blade position.

use super::{
    blade_loads::ElementLoads,
    disc::{BladeFlow, SectionFlow},
    element::{Element, SectionLoad},
    geometry::Block,
    induced::Induced,
    numbers::{Lanes, Plain, Scalar},
};

/// Where an inflow model gives its induced velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InducedAt {
    /// At the blade, with the tip loss already in it.
    Blade,
    /// As the mean around the annulus; Prandtl's F raises it at the blade.
    Annulus,
}

/// The flow at one blade's sections, the axial induced velocity at the blade (m/s), and the loads.
#[inline(always)]
fn section_load<L: Lanes>(
    element: &Element<L>,
    at: InducedAt,
    blade: &BladeFlow<L::One>,
    induced: Induced<L>,
) -> (SectionFlow<L>, L, SectionLoad<L>) {
    let section = blade.at_section::<L>(element.radius);
    let pitch = element.pitch + section.pitch;
    let in_plane = section.in_plane - induced.swirl;
    let axial = match at {
        InducedAt::Blade => induced.axial,
        InducedAt::Annulus => element.induced_at_blade(&section, induced.axial),
    };
    let load = element.load(pitch, in_plane, section.through + section.flap_cos * axial);
    (section, axial, load)
}

/// Sums over the elements of one blade, in each lane, per unit of width, at one position.
#[derive(Debug, Clone, Copy)]
pub struct BladeSums<L> {
    /// Force along the shaft, N/m.
    pub thrust: L,
    /// Force towards the shaft, N/m.
    pub inwards: L,
    /// Force against the motion of the blade, N/m.
    pub tangential: L,
    /// Moment of the force along n about the hub's centre, N.
    pub up: L,
    /// Moment of the tangential force about the blade's projection on the disc, N.
    pub twisting: L,
    /// Torque that the blade absorbs, N.
    pub torque: L,
    /// Moment about the hinge, N.
    pub hinge_moment: L,
}

impl<L: Lanes> BladeSums<L> {
    /// No loads.
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            thrust: L::nil(),
            inwards: L::nil(),
            tangential: L::nil(),
            up: L::nil(),
            twisting: L::nil(),
            torque: L::nil(),
            hinge_moment: L::nil(),
        }
    }

    /// Adds elements, in the lanes whose `counts` is 1 and not 0.
    ///
    /// A section's force is `normal` along n and `tangential` against e_t, and acts at X e_r + Z
    /// e_z; its moment about the hub is -normal (X cos beta + Z sin beta) e_t + tangential (Z e_r -
    /// X e_z).
    #[inline(always)]
    fn add(&mut self, section: &SectionFlow<L>, load: &SectionLoad<L>, counts: L::Real) {
        let (normal, tangential) = (load.normal.times(counts), load.tangential.times(counts));
        let lever = section.out * section.flap_cos + section.up * section.flap_sin;
        self.thrust += normal * section.flap_cos;
        self.inwards += normal * section.flap_sin;
        self.tangential += tangential;
        self.up += normal * lever;
        self.twisting += tangential * section.up;
        self.torque += tangential * section.out;
        self.hinge_moment += normal.times(section.outboard);
    }
}

/// What of the loads is wanted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Wanted {
    /// The sums over the blade.
    Sums,
    /// Also the loads along the blade, and where it is stalled.
    Distribution,
}

/// The loads of a block of elements at each blade position.
#[derive(Debug)]
pub struct Sweep<'a, L: Lanes> {
    /// The elements.
    pub element: &'a Element<'a, L>,
    /// The same by their numbers.
    pub block: &'a Block,
    /// The blades' positions, and the flow there.
    pub blades: &'a [BladeFlow<L::One>],
    /// Sums over the elements, one entry for each position.
    pub sums: &'a mut [BladeSums<L>],
    wanted: Wanted,
    counts: L::Real,
    /// Number of positions averaged in `mean`: all, or only the first, that of blade 1.
    shown: usize,
    /// Number of positions at which each element is stalled.
    pub stalled: L::Real,
    mean: ElementLoads<L>,
}

impl<'a, L: Lanes> Sweep<'a, L> {
    /// `is_individual`: whether the positions are those of the blades; `mean` is then that of blade
    /// 1.
    #[inline(always)]
    pub fn new(
        (element, block): (&'a Element<'a, L>, &'a Block),
        blades: &'a [BladeFlow<L::One>],
        sums: &'a mut [BladeSums<L>],
        is_individual: bool,
        wanted: Wanted,
    ) -> Self {
        Self {
            element,
            block,
            blades,
            sums,
            wanted,
            counts: L::Real::load(&block.counts),
            shown: if is_individual { 1 } else { blades.len() },
            stalled: L::Real::nil(),
            mean: ElementLoads::zero(),
        }
    }

    /// Computes the loads at a position in an induced velocity. Returns the thrust of one blade's
    /// sections per unit of radius, N/m, in the lanes that count.
    #[inline(always)]
    pub fn load_at(&mut self, position: usize, at: InducedAt, induced: Induced<L>) -> L {
        let blade = &self.blades[position];
        let (section, axial, load) = section_load(self.element, at, blade, induced);
        self.add(position, &section, &load, axial);
        (load.normal * section.flap_cos).times(self.counts)
    }

    /// Uses the same load and axial induced velocity (m/s) at all positions.
    #[inline(always)]
    pub fn take(&mut self, load: &SectionLoad<L>, induced: L) {
        for position in 0..self.blades.len() {
            let section = self.blades[position].at_section::<L>(self.element.radius);
            self.add(position, &section, load, induced);
        }
    }

    #[inline(always)]
    fn add(
        &mut self,
        position: usize,
        section: &SectionFlow<L>,
        load: &SectionLoad<L>,
        induced: L,
    ) {
        self.sums[position].add(section, load, self.counts);
        if self.wanted == Wanted::Sums {
            return;
        }
        let stalled = self.element.is_stalled(load);
        let counts = L::Real::select(stalled, self.counts, L::Real::nil());
        self.stalled += counts;
        if position < self.shown {
            self.show(section, load, induced);
        }
    }

    #[inline(always)]
    fn show(&mut self, section: &SectionFlow<L>, load: &SectionLoad<L>, induced: L) {
        let share = 1.0 / self.shown as f64;
        let all = share * self.element.blades;
        let shown = &mut self.mean;
        shown.thrust += load.normal * all * section.flap_cos;
        shown.torque += load.tangential * all * section.out;
        shown.angle_of_attack += load.angle_of_attack * share;
        shown.speed += load.speed * share;
        shown.lift_coefficient += load.lift_coefficient * share;
        shown.drag_coefficient += load.drag_coefficient * share;
        shown.induced_velocity += induced * share;
    }

    /// Writes the loads of blade 1, or the average over all positions, to those of the blade's
    /// elements; `mean_induced` is the mean induced velocity around the annulus, m/s.
    #[inline(always)]
    pub fn write<S: Scalar>(&self, mean_induced: L, loads: &mut [ElementLoads<S>])
    where
        L: Lanes<One = S>,
    {
        let flow = self.element.similarity(self.mean.speed);
        let mean = ElementLoads {
            mean_induced_velocity: mean_induced,
            reynolds: flow.reynolds,
            mach: flow.mach,
            ..self.mean
        };
        let block = self.block.first..self.block.first + self.block.count;
        for (lane, load) in loads[block].iter_mut().enumerate() {
            *load = mean.map(|quantity| quantity.lane(lane));
        }
    }
}
