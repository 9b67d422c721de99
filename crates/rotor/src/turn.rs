//! One blade element on its way around the disc: the loads at the places of the blades, or averaged
//! over the turn.

use super::{
    Load,
    disc::{AZIMUTHS, Azimuth, DiscFlow, Encounter, Place},
    element::{Element, LossIn, SectionLoad},
    inflow::Induced,
    scalar::Scalar,
};
use nalgebra::Vector3;

/// The loads of one blade's section in an induced velocity, and what it meets.
fn section_load<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    loss: LossIn,
    place: &Place<S>,
    induced: Induced<S>,
) -> (Encounter<S>, SectionLoad<S>) {
    let meets = flow.meets(element.radius, place);
    let load = element.load(
        element.pitch + meets.pitch,
        meets.in_plane - induced.swirl,
        meets.through + meets.flap_cos * induced.axial,
        loss,
    );
    (meets, load)
}

/// Thrust of all blades' sections per unit of radius, N/m, as a mean over the places.
pub fn mean_thrust<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    loss: LossIn,
    places: &[Place<S>],
    induced: impl Fn(&Place<S>) -> Induced<S>,
) -> S {
    let normal = |place: &Place<S>| {
        let (meets, load) = section_load(element, flow, loss, place, induced(place));
        load.normal * meets.flap_cos
    };
    places.iter().map(normal).sum::<S>() / places.len() as f64 * element.blades
}

/// One element on its way around the azimuth: the loads of all blades per unit of radius, as means
/// over the places, in the axes of the disc's flow.
#[derive(Debug)]
pub struct Turn<'a, S = f64> {
    element: &'a Element<'a, S>,
    flow: &'a DiscFlow<S>,
    places: &'a [Place<S>],
    /// Which places `load` shows: all, or the first, that of blade 1.
    shown: usize,
    /// N/m.
    pub force: Vector3<S>,
    /// About the hub's centre, N.
    pub moment: Vector3<S>,
    /// Share of the turn in which the element is stalled.
    pub stalled: f64,
    /// One blade's thrust, N/m, and moment about its hinge, N, at each place.
    pub thrust_at: [S; AZIMUTHS],
    pub hinge_moment_at: [S; AZIMUTHS],
    load: Load<S>,
}

impl<'a, S: Scalar> Turn<'a, S> {
    /// `is_blades`: whether the places are those of the blades, of which the first is shown.
    pub fn new(
        element: &'a Element<'a, S>,
        flow: &'a DiscFlow<S>,
        places: &'a [Place<S>],
        is_blades: bool,
    ) -> Self {
        Self {
            element,
            flow,
            places,
            shown: if is_blades { 1 } else { places.len() },
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            stalled: 0.0,
            thrust_at: [S::zero(); AZIMUTHS],
            hinge_moment_at: [S::zero(); AZIMUTHS],
            load: Load::none(),
        }
    }

    /// Flies the element around in the induced velocity of each place.
    pub fn fly<E>(
        &mut self,
        loss: LossIn,
        induced: impl Fn(usize, &Place<S>) -> Result<Induced<S>, E>,
    ) -> Result<(), E> {
        for (i, place) in self.places.iter().enumerate() {
            let induced = induced(i, place)?;
            let (meets, load) = section_load(self.element, self.flow, loss, place, induced);
            self.add(i, &meets, &load, induced.axial, place.azimuth);
        }
        Ok(())
    }

    /// Takes the same load and axial induced velocity (m/s) at all azimuths.
    pub fn take(&mut self, load: &SectionLoad<S>, induced: S) {
        for (i, place) in self.places.iter().enumerate() {
            let meets = self.flow.meets(self.element.radius, place);
            self.add(i, &meets, load, induced, place.azimuth);
        }
    }

    /// A section's force is `normal` along n and `tangential` against e_t, at the place X e_r + Z e_z;
    /// its moment about the hub is -normal (X cos beta + Z sin beta) e_t + tangential (Z e_r - X e_z).
    fn add(
        &mut self,
        place: usize,
        meets: &Encounter<S>,
        load: &SectionLoad<S>,
        induced: S,
        azimuth: Azimuth<S>,
    ) {
        let Azimuth { sin, cos } = azimuth;
        let share = 1.0 / self.places.len() as f64;
        let blades = share * self.element.blades;
        let (normal, tangential) = (load.normal * blades, load.tangential * blades);
        let inwards = normal * meets.flap_sin;
        self.force += Vector3::new(
            inwards * cos - tangential * sin,
            inwards * sin + tangential * cos,
            normal * meets.flap_cos,
        );
        let up = normal * (meets.out * meets.flap_cos + meets.up * meets.flap_sin);
        let twisting = tangential * meets.up;
        self.moment += Vector3::new(
            -up * sin - twisting * cos,
            up * cos - twisting * sin,
            -tangential * meets.out,
        );
        self.thrust_at[place] = load.normal * meets.flap_cos;
        self.hinge_moment_at[place] = load.normal * meets.outboard;
        if self.element.is_stalled(load) {
            self.stalled += share;
        }
        if place < self.shown {
            self.show(meets, load, induced);
        }
    }

    fn show(&mut self, meets: &Encounter<S>, load: &SectionLoad<S>, induced: S) {
        let share = 1.0 / self.shown as f64;
        let all = share * self.element.blades;
        let shown = &mut self.load;
        shown.thrust += load.normal * all * meets.flap_cos;
        shown.torque += load.tangential * all * meets.out;
        shown.angle_of_attack += load.angle_of_attack * share;
        shown.speed += load.speed * share;
        shown.lift_coefficient += load.lift_coefficient * share;
        shown.drag_coefficient += load.drag_coefficient * share;
        shown.induced_velocity += induced * share;
    }

    /// The means of the shown places; `mean_induced`: of the whole annulus, m/s.
    pub fn load(&self, mean_induced: S) -> Load<S> {
        let flow = self.element.similarity(self.load.speed);
        Load {
            mean_induced_velocity: mean_induced,
            reynolds: flow.reynolds,
            mach: flow.mach,
            ..self.load
        }
    }
}
