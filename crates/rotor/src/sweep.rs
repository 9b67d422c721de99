//! One blade element moved around the azimuth: its loads at each blade position, and their average.

use super::{
    blade_loads::ElementLoads,
    disc::{AZIMUTHS, Azimuth, BladePosition, DiscFlow, SectionFlow},
    element::{Element, SectionLoad},
    induced::Induced,
    scalar::Scalar,
};
use nalgebra::Vector3;

/// Where an inflow model gives its induced velocity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InducedAt {
    /// At the blade, with the tip loss already in it.
    Blade,
    /// As the mean around the annulus; Prandtl's F raises it at the blade.
    Annulus,
}

/// The flow at one blade's section, the axial induced velocity at the blade (m/s), and the loads.
fn section_load<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    at: InducedAt,
    position: &BladePosition<S>,
    induced: Induced<S>,
) -> (SectionFlow<S>, S, SectionLoad<S>) {
    let section = flow.at_section(element.radius, position);
    let pitch = element.pitch + section.pitch;
    let in_plane = section.in_plane - induced.swirl;
    let axial = match at {
        InducedAt::Blade => induced.axial,
        InducedAt::Annulus => element.induced_at_blade(&section, induced.axial),
    };
    let load = element.load(pitch, in_plane, section.through + section.flap_cos * axial);
    (section, axial, load)
}

/// Thrust of all blades' sections per unit of radius, N/m, averaged over the blade positions.
pub fn mean_thrust<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    at: InducedAt,
    positions: &[BladePosition<S>],
    induced: impl Fn(&BladePosition<S>) -> Induced<S>,
) -> S {
    let normal = |position: &BladePosition<S>| {
        let (section, _, load) = section_load(element, flow, at, position, induced(position));
        load.normal * section.flap_cos
    };
    positions.iter().map(normal).sum::<S>() / positions.len() as f64 * element.blades
}

/// The loads of all blades' sections per unit of radius, averaged over the blade positions, in wind
/// axes.
#[derive(Debug)]
pub struct Sweep<'a, S = f64> {
    element: &'a Element<'a, S>,
    flow: &'a DiscFlow<S>,
    positions: &'a [BladePosition<S>],
    /// Number of positions that `loads` averages: all, or only the first, that of blade 1.
    shown: usize,
    /// N/m.
    pub force: Vector3<S>,
    /// About the hub's centre, N.
    pub moment: Vector3<S>,
    /// Fraction of the blade positions at which the element is stalled.
    pub stalled: f64,
    /// One blade's thrust at each position, N/m.
    pub thrust_at: [S; AZIMUTHS],
    /// One blade's moment about its hinge at each position, N.
    pub hinge_moment_at: [S; AZIMUTHS],
    mean: ElementLoads<S>,
}

impl<'a, S: Scalar> Sweep<'a, S> {
    /// `is_individual`: whether the positions are those of the blades, so that `loads` are blade
    /// 1's.
    pub fn new(
        element: &'a Element<'a, S>,
        flow: &'a DiscFlow<S>,
        positions: &'a [BladePosition<S>],
        is_individual: bool,
    ) -> Self {
        Self {
            element,
            flow,
            positions,
            shown: if is_individual { 1 } else { positions.len() },
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            stalled: 0.0,
            thrust_at: [S::zero(); AZIMUTHS],
            hinge_moment_at: [S::zero(); AZIMUTHS],
            mean: ElementLoads::zero(),
        }
    }

    /// Computes the loads in the velocity that `induced` gives for each position.
    pub fn load_in<E>(
        &mut self,
        at: InducedAt,
        induced: impl Fn(usize, &BladePosition<S>) -> Result<Induced<S>, E>,
    ) -> Result<(), E> {
        for (i, position) in self.positions.iter().enumerate() {
            let induced = induced(i, position)?;
            let (section, axial, load) =
                section_load(self.element, self.flow, at, position, induced);
            self.add(i, &section, &load, axial, position.azimuth);
        }
        Ok(())
    }

    /// Uses the same load and axial induced velocity (m/s) at all positions.
    pub fn take(&mut self, load: &SectionLoad<S>, induced: S) {
        for (i, position) in self.positions.iter().enumerate() {
            let section = self.flow.at_section(self.element.radius, position);
            self.add(i, &section, load, induced, position.azimuth);
        }
    }

    /// A section's force is `normal` along n and `tangential` against e_t, and acts at X e_r + Z
    /// e_z; its moment about the hub is -normal (X cos beta + Z sin beta) e_t + tangential (Z e_r -
    /// X e_z).
    fn add(
        &mut self,
        position: usize,
        section: &SectionFlow<S>,
        load: &SectionLoad<S>,
        induced: S,
        azimuth: Azimuth<S>,
    ) {
        let Azimuth { sin, cos } = azimuth;
        let share = 1.0 / self.positions.len() as f64;
        let blades = share * self.element.blades;
        let (normal, tangential) = (load.normal * blades, load.tangential * blades);
        let inwards = normal * section.flap_sin;
        self.force += Vector3::new(
            inwards * cos - tangential * sin,
            inwards * sin + tangential * cos,
            normal * section.flap_cos,
        );
        let up = normal * (section.out * section.flap_cos + section.up * section.flap_sin);
        let twisting = tangential * section.up;
        self.moment += Vector3::new(
            -up * sin - twisting * cos,
            up * cos - twisting * sin,
            -tangential * section.out,
        );
        self.thrust_at[position] = load.normal * section.flap_cos;
        self.hinge_moment_at[position] = load.normal * section.outboard;
        if self.element.is_stalled(load) {
            self.stalled += share;
        }
        if position < self.shown {
            self.show(section, load, induced);
        }
    }

    fn show(&mut self, section: &SectionFlow<S>, load: &SectionLoad<S>, induced: S) {
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

    /// The loads of blade 1, or the average over all positions; `mean_induced` is the mean induced
    /// velocity around the annulus, m/s.
    pub fn loads(&self, mean_induced: S) -> ElementLoads<S> {
        let flow = self.element.similarity(self.mean.speed);
        ElementLoads {
            mean_induced_velocity: mean_induced,
            reynolds: flow.reynolds,
            mach: flow.mach,
            ..self.mean
        }
    }
}
