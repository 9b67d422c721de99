//! The disc: how its blades move through the air around the azimuth, in axes turned into the wind.
//!
//! Axes. x points from the shaft into the flow along the disc, z up along the shaft, y to the left
//! of x; the rotor turns counter-clockwise seen from above (a clockwise one is mirrored before it
//! comes here). The azimuth psi counts from downwind in the turning sense, so that with flow along
//! the disc the blade advances at psi = 90 deg.

use super::{
    Load,
    element::{Element, LossIn, SectionLoad},
    inflow::{Field, Induced},
};
use core::f64::consts::PI;
use nalgebra::Vector3;

/// Number of azimuths over which a disc without axial symmetry is averaged. All harmonics of the
/// loads up to the 23rd are averaged exactly; against 144 azimuths, the thrust of the default rotor
/// at an advance ratio of 0.26 differs by 1e-6.
const AZIMUTHS: usize = 24;

/// The motion of the disc through the air, without what it induces. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct DiscFlow {
    /// Rotor speed against the air, rad/s.
    pub rotation: f64,
    /// Speed along the disc, >= 0, m/s.
    pub edgewise: f64,
    /// Speed along the shaft, climb positive, m/s.
    pub climb: f64,
    /// Angular velocity of the hub about x and y, rad/s.
    pub roll_rate: f64,
    pub pitch_rate: f64,
    /// Pitch = collective + twist - cyclic_cos cos(psi) - cyclic_sin sin(psi).
    pub cyclic_cos: f64,
    pub cyclic_sin: f64,
}

/// What a quantity of the hub needs to be turned into the axes of `DiscFlow`, and back.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WindAxes {
    cos: f64,
    sin: f64,
}

/// One azimuth. On an axially symmetrical disc there is a single one without a direction.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Azimuth {
    pub sin: f64,
    pub cos: f64,
}

/// The flow that meets a blade's section, without what the rotor induces, and its pitch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Encounter {
    /// Change of the pitch by cyclic control, rad.
    pub cyclic: f64,
    /// U_T: against the motion of the blade, m/s.
    pub in_plane: f64,
    /// U_P: down through the disc, m/s.
    pub through: f64,
}

/// The azimuths to average over.
#[derive(Debug, Clone, PartialEq)]
pub struct Azimuths {
    around: [Azimuth; AZIMUTHS],
}

impl WindAxes {
    /// Axes for a hub that moves with (forward, left) through the air, m/s.
    pub fn new(forward: f64, left: f64) -> Self {
        let speed = libm::hypot(forward, left);
        if speed == 0.0 {
            return Self { cos: 1.0, sin: 0.0 };
        }
        Self {
            cos: forward / speed,
            sin: left / speed,
        }
    }

    /// A vector's parts along the hub's (forward, left) as parts along the axes' x and y.
    pub fn into_wind(&self, forward: f64, left: f64) -> (f64, f64) {
        (
            forward * self.cos + left * self.sin,
            left * self.cos - forward * self.sin,
        )
    }

    /// A field's slopes towards psi = 0 and 90 deg turn like a vector's parts.
    pub fn field_into_wind(&self, field: &Field) -> Field {
        let (cosine, sine) = self.into_wind(field.cosine, field.sine);
        Field {
            cosine,
            sine,
            ..*field
        }
    }

    /// The way back.
    pub fn field_out_of_wind(&self, field: &Field) -> Field {
        let (cosine, sine) = self.out_of_wind(field.cosine, field.sine);
        Field {
            cosine,
            sine,
            ..*field
        }
    }

    /// The way back.
    pub fn out_of_wind(&self, x: f64, y: f64) -> (f64, f64) {
        (x * self.cos - y * self.sin, x * self.sin + y * self.cos)
    }
}

impl DiscFlow {
    /// Whether all azimuths are alike.
    pub fn is_axisymmetric(&self) -> bool {
        let Self {
            edgewise,
            roll_rate,
            pitch_rate,
            cyclic_cos,
            cyclic_sin,
            ..
        } = *self;
        [edgewise, roll_rate, pitch_rate, cyclic_cos, cyclic_sin]
            .iter()
            .all(|x| *x == 0.0)
    }

    /// What a section at `radius` (m) meets at an azimuth: thesis eqs. (101) and (102) with the
    /// angular velocity of the hub and without flapping.
    ///
    /// The blade points along e_r = (-cos psi, -sin psi, 0) and moves along e_t = (sin psi,
    /// -cos psi, 0); the angular velocity (p, q) of the hub lifts it with r (q cos psi - p sin psi).
    pub fn meets(&self, radius: f64, azimuth: Azimuth) -> Encounter {
        let Azimuth { sin, cos } = azimuth;
        Encounter {
            cyclic: -self.cyclic_cos * cos - self.cyclic_sin * sin,
            in_plane: self.rotation * radius + self.edgewise * sin,
            through: self.climb + radius * (self.pitch_rate * cos - self.roll_rate * sin),
        }
    }
}

impl Default for Azimuths {
    fn default() -> Self {
        let around = std::array::from_fn(|i| {
            // Half a step off the axes: no azimuth lies exactly where the flow reverses.
            let psi = 2.0 * PI * (i as f64 + 0.5) / AZIMUTHS as f64;
            Azimuth {
                sin: libm::sin(psi),
                cos: libm::cos(psi),
            }
        });
        Self { around }
    }
}

impl Azimuths {
    /// The azimuths to average over: one without a direction where all are alike.
    pub fn of(&self, is_axisymmetric: bool) -> &[Azimuth] {
        const ALIKE: [Azimuth; 1] = [Azimuth { sin: 0.0, cos: 0.0 }];
        if is_axisymmetric {
            &ALIKE
        } else {
            &self.around
        }
    }
}

/// The loads of one blade's section at an azimuth, in an induced velocity.
fn section_load(
    element: &Element,
    flow: &DiscFlow,
    loss: LossIn,
    azimuth: Azimuth,
    induced: Induced,
) -> SectionLoad {
    let meets = flow.meets(element.radius, azimuth);
    let pitch = element.pitch + meets.cyclic;
    element.load(
        pitch,
        meets.in_plane - induced.swirl,
        meets.through + induced.axial,
        loss,
    )
}

/// Thrust of all blades' sections per unit of radius, N/m, as a mean over the turn.
pub fn mean_thrust(
    element: &Element,
    flow: &DiscFlow,
    loss: LossIn,
    azimuths: &[Azimuth],
    induced: impl Fn(Azimuth) -> Induced,
) -> f64 {
    let normal = |a: &Azimuth| section_load(element, flow, loss, *a, induced(*a)).normal;
    azimuths.iter().map(normal).sum::<f64>() / azimuths.len() as f64 * element.blades
}

/// One element on its way around the azimuth: the loads of all blades per unit of radius, as means
/// over the turn, in the axes of the disc's flow.
#[derive(Debug)]
pub struct Turn<'a> {
    element: &'a Element<'a>,
    flow: &'a DiscFlow,
    pub azimuths: &'a [Azimuth],
    /// N/m.
    pub force: Vector3<f64>,
    /// About the hub's centre, N.
    pub moment: Vector3<f64>,
    /// Share of the turn in which the element is stalled.
    pub stalled: f64,
    angle_of_attack: f64,
    speed: f64,
    lift_coefficient: f64,
    drag_coefficient: f64,
    induced: f64,
}

impl<'a> Turn<'a> {
    pub fn new(element: &'a Element<'a>, flow: &'a DiscFlow, azimuths: &'a [Azimuth]) -> Self {
        Self {
            element,
            flow,
            azimuths,
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            stalled: 0.0,
            angle_of_attack: 0.0,
            speed: 0.0,
            lift_coefficient: 0.0,
            drag_coefficient: 0.0,
            induced: 0.0,
        }
    }

    /// Flies the element around in the induced velocity of each azimuth.
    pub fn fly(&mut self, loss: LossIn, induced: impl Fn(Azimuth) -> Induced) {
        let share = 1.0 / self.azimuths.len() as f64;
        for azimuth in self.azimuths {
            let induced = induced(*azimuth);
            let load = section_load(self.element, self.flow, loss, *azimuth, induced);
            self.add(&load, induced.axial, *azimuth, share);
        }
    }

    /// Takes the same load and axial induced velocity (m/s) at all azimuths.
    pub fn take(&mut self, load: &SectionLoad, induced: f64) {
        self.add(load, induced, Azimuth::default(), 1.0);
    }

    /// A section's force is `normal` up and `tangential` against e_t = (sin psi, -cos psi, 0), at
    /// the place r e_r = -r (cos psi, sin psi, 0).
    fn add(&mut self, load: &SectionLoad, induced: f64, azimuth: Azimuth, share: f64) {
        let Azimuth { sin, cos } = azimuth;
        let blades = share * self.element.blades;
        let (normal, tangential) = (blades * load.normal, blades * load.tangential);
        self.force += Vector3::new(-tangential * sin, tangential * cos, normal);
        let radius = self.element.radius;
        self.moment += Vector3::new(-normal * sin, normal * cos, -tangential) * radius;
        self.angle_of_attack += share * load.angle_of_attack;
        self.speed += share * load.speed;
        self.lift_coefficient += share * load.lift_coefficient;
        self.drag_coefficient += share * load.drag_coefficient;
        self.induced += share * induced;
        if self.element.is_stalled(load) {
            self.stalled += share;
        }
    }

    /// The means of the turn.
    pub fn load(&self, mean_induced: f64) -> Load {
        let flow = self.element.similarity(self.speed);
        Load {
            thrust: self.force.z,
            torque: -self.moment.z,
            angle_of_attack: self.angle_of_attack,
            induced_velocity: self.induced,
            mean_induced_velocity: mean_induced,
            speed: self.speed,
            lift_coefficient: self.lift_coefficient,
            drag_coefficient: self.drag_coefficient,
            reynolds: flow.reynolds,
            mach: flow.mach,
        }
    }
}
