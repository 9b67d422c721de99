//! The physics of a helicopter rotor: plain structures and functions in SI units and radians.
//! Nothing here knows of FMI.
//!
//! "The thesis" is Lovaco Hernandez, J. L. (2017), "Verification of a Modelica Helicopter Rotor Model Using
//! Blade Element Theory", Linkoping University, LIU-IEI-TEK-A--17/02958-SE.

pub mod air;
pub mod airfoil;
pub mod compressibility;
pub mod coverage;
pub mod disc;
pub mod element;
pub mod flapping;
pub mod geometry;
pub mod inflow;
mod lift_end;
mod loads;
mod newton;
mod rates;
pub mod root;
pub mod scalar;
mod scene;
mod start;
pub mod state;
mod text_file;
pub mod tip_loss;
mod tip_path;
mod turn;

use air::Air;
use airfoil::{Airfoil, SectionModel};
use disc::{AZIMUTHS, Azimuth};
use flapping::Hinge;
use geometry::{Elements, Geometry};
use inflow::{Descent, Inflow, descent::FlowState, ground::GroundEffect, peters_he};
use nalgebra::Vector3;
use root::RootError;
use scalar::Scalar;
use thiserror::Error;
use tip_loss::TipLoss;

pub use start::Start;
pub use state::State;

/// The choice of models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Models {
    pub inflow: Inflow,
    pub descent: Descent,
    pub ground_effect: GroundEffect,
    pub blades: Blades,
    pub hinge: Hinge,
    pub tip_loss: TipLoss,
    pub section: SectionModel,
}

/// Whether loads are those of the blades where they are, or means over a turn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Blades {
    /// The disc where all azimuths are alike and the blades do not flap, else individual.
    #[default]
    Automatic,
    /// Means over a turn; the blades do not flap.
    Disc,
    /// Each blade at its azimuth.
    Individual,
}

/// What the rotor does, and in which air. SI units, rad; vectors in the hub frame (x forward, y
/// left, z up along the shaft).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation<S = f64> {
    /// Blade pitch at the reference radius is collective - cyclic_lateral cos(psi) -
    /// cyclic_longitudinal sin(psi), psi from the tail in the turning sense.
    pub collective: S,
    pub cyclic_longitudinal: S,
    pub cyclic_lateral: S,
    /// Omega, of the rotor against the hub, rad/s: imposed, or that at the start.
    pub speed: S,
    /// Velocity of the hub through the air, m/s.
    pub airspeed: Vector3<S>,
    /// Angular velocity of the hub, rad/s.
    pub angular_velocity: Vector3<S>,
    /// Acceleration of gravity, m/s2: it pulls at blades that flap.
    pub gravity: Vector3<S>,
    /// Of the flapping hinges, N.m/rad.
    pub hinge_spring: S,
    /// Of the hub above the ground, m, >= 0.
    pub height: S,
    pub drive: Drive<S>,
    pub air: Air<S>,
}

/// What turns the rotor.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum Drive<S = f64> {
    /// Whatever keeps its speed.
    #[default]
    Speed,
    /// A torque, N.m; the speed is a state of the rotor. `inertia`: of everything that turns, about the
    /// shaft, kg.m2.
    Torque { torque: S, inertia: f64 },
}

impl<S: Scalar> Operation<S> {
    /// The same at the speed that the rotor has in a state.
    pub fn at_speed_of(&self, state: &State<S>) -> Self {
        match self.drive {
            Drive::Speed => *self,
            Drive::Torque { .. } => Self {
                speed: state.speed,
                ..*self
            },
        }
    }
}

/// What the rotor answers: at the present azimuth, or as the mean over a turn in the disc. SI units,
/// vectors in the hub frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Performance<S = f64> {
    /// Force on the hub, and moment on it about its centre.
    pub force: Vector3<S>,
    pub moment: Vector3<S>,
    /// Torque that the rotor absorbs.
    pub torque: S,
    /// Mean over the swept annulus from cutout to tip, positive down.
    pub induced_velocity: S,
    /// r/R of the outermost stalled element's middle at any azimuth, 0 if none is stalled.
    pub stalled_radius: f64,
    /// Share of the blade span that is stalled.
    pub stalled_fraction: f64,
    pub tip_path: TipPath<S>,
    pub flow_state: FlowState,
}

impl<S: Scalar> Default for Performance<S> {
    /// Nothing at all.
    fn default() -> Self {
        let none = S::zero();
        Self {
            force: Vector3::zeros(),
            moment: Vector3::zeros(),
            torque: none,
            induced_velocity: none,
            stalled_radius: 0.0,
            stalled_fraction: 0.0,
            tip_path: TipPath {
                coning: none,
                longitudinal: none,
                lateral: none,
            },
            flow_state: FlowState::default(),
        }
    }
}

/// What the rotor answers, and how fast its states change, per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Response<S = f64> {
    pub performance: Performance<S>,
    pub rates: State<S>,
}

/// The cone of the blades: beta = coning - longitudinal cos psi - lateral sin psi, psi from the tail, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct TipPath<S = f64> {
    pub coning: S,
    pub longitudinal: S,
    pub lateral: S,
}

/// The loads and the flow at a blade element: of blade 1, or as means over a turn in the disc. SI
/// units, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Load<S = f64> {
    /// Thrust per unit of radius times the number of blades, N/m.
    pub thrust: S,
    /// Torque absorbed per unit of radius times the number of blades, N.
    pub torque: S,
    pub angle_of_attack: S,
    /// Induced velocity at the blades, positive down, m/s.
    pub induced_velocity: S,
    /// Its mean around the annulus, m/s: tip loss is the difference.
    pub mean_induced_velocity: S,
    /// Speed of the flow that meets the section, m/s.
    pub speed: S,
    pub lift_coefficient: S,
    pub drag_coefficient: S,
    pub reynolds: S,
    pub mach: S,
}

impl<S: Scalar> Load<S> {
    /// Before anything is computed.
    pub fn none() -> Self {
        let none = S::zero();
        Self {
            thrust: none,
            torque: none,
            angle_of_attack: none,
            induced_velocity: none,
            mean_induced_velocity: none,
            speed: none,
            lift_coefficient: none,
            drag_coefficient: none,
            reynolds: none,
            mach: none,
        }
    }
}

/// A disc or a blade element for which no flow was found.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum SolveError {
    #[error("the inflow at r/R = {radius_ratio:.3} has no solution: {cause}")]
    Annulus { radius_ratio: f64, cause: RootError },
    #[error("the mean inflow of the disc has no solution: {0}")]
    Disc(RootError),
    #[error("the radius at which the lift ends has no solution: {0}")]
    LiftEnd(RootError),
    #[error(
        "no state was found in which inflow and flapping repeat themselves; set initialization to rest"
    )]
    NoSteadyState,
    #[error("a step of {0} s is too long for the states of inflow and flapping; shorten it")]
    StepTooLong(f64),
}

/// A rotor, cut into elements and ready to compute with plain or dual numbers; it owns the memory that a
/// computation needs.
#[derive(Debug, Clone)]
pub struct Rotor<S = f64> {
    geometry: Geometry,
    airfoils: Vec<Airfoil>,
    models: Models,
    elements: Elements,
    lifting_share: Vec<S>,
    /// The azimuths over which the disc is averaged.
    around: [Azimuth; AZIMUTHS],
    /// The model of Peters & He, while it is chosen.
    peters_he: Option<peters_he::Wake>,
    /// The last computation, by element.
    loads: Vec<Load<S>>,
}

impl Rotor {
    /// From a checked geometry, its airfoils (one for each of `geometry.airfoils`) and the number
    /// of elements (>= 1). Blades that flap are at most `state::MOST_FLAPPING_BLADES`.
    pub fn new(geometry: Geometry, airfoils: Vec<Airfoil>, models: Models, count: usize) -> Self {
        debug_assert_eq!(airfoils.len(), geometry.airfoils.len());
        let elements = Elements::new(&geometry, count);
        let mut rotor = Self {
            lifting_share: vec![1.0; elements.len()],
            loads: vec![Load::none(); elements.len()],
            around: disc::around(),
            peters_he: match models.inflow {
                Inflow::PetersHe { order } => {
                    let ratios: Vec<f64> = elements
                        .radius
                        .iter()
                        .map(|r| r / geometry.radius)
                        .collect();
                    let blades = geometry.blades as usize;
                    Some(peters_he::Wake::of_blades(order, blades, &ratios))
                }
                _ => None,
            },
            geometry,
            airfoils,
            models,
            elements,
        };
        if let Some(end) = models.tip_loss.fixed_end(&rotor.geometry) {
            rotor.end_lift_at(end);
        }
        rotor
    }

    /// The same rotor, to compute with numbers of another type. Allocates.
    pub fn with_numbers<T: Scalar>(&self) -> Rotor<T> {
        let shares = self.lifting_share.iter();
        Rotor {
            geometry: self.geometry.clone(),
            airfoils: self.airfoils.clone(),
            models: self.models,
            elements: self.elements.clone(),
            lifting_share: shares.map(|share| T::constant(*share)).collect(),
            around: self.around,
            peters_he: self.peters_he.clone(),
            loads: vec![Load::none(); self.elements.len()],
        }
    }
}

impl<S: Scalar> Rotor<S> {
    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Radii of the elements, m, and their loads in the last computation.
    pub fn element_loads(&self) -> (&[f64], &[Load<S>]) {
        (&self.elements.radius, &self.loads)
    }

    /// The last computation at a radius r/R between cutout and tip: linear between the middles of the
    /// elements, and that of the outermost ones beyond them.
    pub fn load_at(&self, radius_ratio: f64) -> Load<S> {
        let last = self.loads.len() - 1;
        let place =
            (radius_ratio * self.geometry.radius - self.elements.radius[0]) / self.elements.width;
        let inner = (place.max(0.0) as usize).min(last);
        let (a, b) = (&self.loads[inner], &self.loads[(inner + 1).min(last)]);
        let weight = (place - inner as f64).clamp(0.0, 1.0);
        let mix = |quantity: fn(&Load<S>) -> S| quantity(a) + (quantity(b) - quantity(a)) * weight;
        Load {
            thrust: mix(|l| l.thrust),
            torque: mix(|l| l.torque),
            angle_of_attack: mix(|l| l.angle_of_attack),
            induced_velocity: mix(|l| l.induced_velocity),
            mean_induced_velocity: mix(|l| l.mean_induced_velocity),
            speed: mix(|l| l.speed),
            lift_coefficient: mix(|l| l.lift_coefficient),
            drag_coefficient: mix(|l| l.drag_coefficient),
            reynolds: mix(|l| l.reynolds),
            mach: mix(|l| l.mach),
        }
    }
}
