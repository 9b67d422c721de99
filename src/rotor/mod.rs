//! The physics of a helicopter rotor: plain structures and functions in SI units and radians.
//! Nothing here knows of FMI.
//!
//! "The thesis" is Lovaco Hernandez, J. L. (2017), "Verification of a Modelica Helicopter Rotor Model Using
//! Blade Element Theory", Linkoping University, LIU-IEI-TEK-A--17/02958-SE.

pub mod air;
pub mod airfoil;
pub mod compressibility;
pub mod disc;
pub mod element;
pub mod geometry;
pub mod inflow;
pub mod root;
pub mod scalar;
mod text_file;
pub mod tip_loss;

use air::Air;
use airfoil::{Airfoil, SectionModel, Similarity};
use core::f64::consts::PI;
use disc::{Azimuths, DiscFlow, Turn, WindAxes, mean_thrust};
use element::{Element, LossIn, Section};
use geometry::{Elements, Geometry, Rotation};
use inflow::{
    Field, Inflow, Skew, annulus, closed_form,
    linear::Coefficients,
    pitt_peters::{Loading, Stream},
    uniform,
};
use nalgebra::{Matrix3, Vector3};
use root::RootError;
use thiserror::Error;
use tip_loss::TipLoss;

/// The choice of models.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Models {
    pub inflow: Inflow,
    pub tip_loss: TipLoss,
    pub section: SectionModel,
}

/// What the rotor does, and in which air. SI units, rad; vectors in the hub frame (x forward, y
/// left, z up along the shaft).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation {
    /// Blade pitch at the reference radius is collective - cyclic_lateral cos(psi) -
    /// cyclic_longitudinal sin(psi), psi from the tail in the turning sense.
    pub collective: f64,
    pub cyclic_longitudinal: f64,
    pub cyclic_lateral: f64,
    /// Omega >= 0, of the rotor against the hub, rad/s.
    pub speed: f64,
    /// Velocity of the hub through the air, m/s.
    pub airspeed: Vector3<f64>,
    /// Angular velocity of the hub, rad/s.
    pub angular_velocity: Vector3<f64>,
    pub air: Air,
}

/// What the rotor answers, as the mean over a turn. SI units, vectors in the hub frame.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Performance {
    /// Force on the hub, and moment on it about its centre.
    pub force: Vector3<f64>,
    pub moment: Vector3<f64>,
    /// Torque that the rotor absorbs.
    pub torque: f64,
    /// Mean over the swept annulus from cutout to tip, positive down.
    pub induced_velocity: f64,
    /// r/R of the outermost stalled element's middle at any azimuth, 0 if none is stalled.
    pub stalled_radius: f64,
    /// Share of the blade span that is stalled, mean over the disc.
    pub stalled_fraction: f64,
}

/// The loads and the flow at a blade element, as means over a turn. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Thrust of all blades per unit of radius, N/m.
    pub thrust: f64,
    /// Torque absorbed by all blades per unit of radius, N.
    pub torque: f64,
    pub angle_of_attack: f64,
    /// Induced velocity at the blades, positive down, m/s.
    pub induced_velocity: f64,
    /// Its mean around the annulus, m/s: tip loss is the difference.
    pub mean_induced_velocity: f64,
    /// Speed of the flow that meets the section, m/s.
    pub speed: f64,
    pub lift_coefficient: f64,
    pub drag_coefficient: f64,
    pub reynolds: f64,
    pub mach: f64,
}

/// A disc or a blade element for which no flow was found.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum SolveError {
    #[error("the inflow at r/R = {radius_ratio:.3} has no solution: {cause}")]
    Annulus { radius_ratio: f64, cause: RootError },
    #[error("the mean inflow of the disc has no solution: {0}")]
    Disc(RootError),
    #[error("no inflow was found at which its states stand still; set initialization to rest")]
    Equilibrium,
    #[error("a step of {0} s is too long for the states of the inflow; shorten it")]
    StepTooLong(f64),
}

/// A rotor, cut into elements and ready to compute; it owns the memory that a computation needs.
#[derive(Debug, Clone)]
pub struct Rotor {
    geometry: Geometry,
    airfoils: Vec<Airfoil>,
    models: Models,
    elements: Elements,
    lifting_share: Vec<f64>,
    azimuths: Azimuths,
    /// The last computation, by element.
    loads: Vec<Load>,
}

/// Sums over elements and azimuths, in the axes of the disc's flow.
#[derive(Default)]
struct Sums {
    force: Vector3<f64>,
    moment: Vector3<f64>,
    flux: f64,
    area: f64,
    stalled: f64,
    stalled_radius: f64,
}

impl Rotor {
    /// From a checked geometry, its airfoils (one for each of `geometry.airfoils`) and the number
    /// of elements (>= 1).
    pub fn new(geometry: Geometry, airfoils: Vec<Airfoil>, models: Models, count: usize) -> Self {
        debug_assert_eq!(airfoils.len(), geometry.airfoils.len());
        let elements = Elements::new(&geometry, count);
        let half = 0.5 * elements.width;
        let share = |r: &f64| {
            let (tip, chord) = (geometry.radius, geometry.tip_chord);
            models
                .tip_loss
                .lifting_share(r - half, r + half, tip, chord)
        };
        Self {
            lifting_share: elements.radius.iter().map(share).collect(),
            loads: vec![Load::default(); elements.len()],
            azimuths: Azimuths::default(),
            geometry,
            airfoils,
            models,
            elements,
        }
    }

    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Radii of the elements, m, and their loads in the last computation.
    pub fn element_loads(&self) -> (&[f64], &[Load]) {
        (&self.elements.radius, &self.loads)
    }

    /// The last computation at a radius r/R between cutout and tip: linear between the middles of the
    /// elements, and that of the outermost ones beyond them.
    pub fn load_at(&self, radius_ratio: f64) -> Load {
        let last = self.loads.len() - 1;
        let place =
            (radius_ratio * self.geometry.radius - self.elements.radius[0]) / self.elements.width;
        let inner = (place.max(0.0) as usize).min(last);
        let (a, b) = (&self.loads[inner], &self.loads[(inner + 1).min(last)]);
        let weight = (place - inner as f64).clamp(0.0, 1.0);
        let mix = |quantity: fn(&Load) -> f64| quantity(a) + weight * (quantity(b) - quantity(a));
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

    /// Computes the rotor in steady flight, averaged over a turn. Allocates nothing.
    ///
    /// The blades are rigid and do not flap. A clockwise rotor is computed as the mirror image of
    /// a counter-clockwise one.
    pub fn steady(&mut self, operation: &Operation) -> Result<Performance, SolveError> {
        let (axes, flow) = self.wind(operation);
        let field = match self.models.inflow {
            Inflow::Disc(skew) => Some(self.field(skew, &flow, operation)?),
            Inflow::PittPetersDynamic => Some(axes.field_into_wind(&self.equilibrium(operation)?)),
            Inflow::Annulus | Inflow::AnnulusClosedForm => None,
        };
        let sums = self.sums(&flow, operation, field.as_ref())?;
        Ok(self.performance(&axes, &sums))
    }

    /// Whether the inflow has states: then `equilibrium`, `rate` and `with_inflow` move the rotor on in
    /// time, and `steady` is where it comes to rest.
    pub fn has_memory(&self) -> bool {
        self.models.inflow == Inflow::PittPetersDynamic
    }

    /// The rotor in a given inflow, in the axes of the hub (mirrored for a clockwise rotor).
    pub fn with_inflow(
        &mut self,
        operation: &Operation,
        field: &Field,
    ) -> Result<Performance, SolveError> {
        let (axes, flow) = self.wind(operation);
        let sums = self.sums(&flow, operation, Some(&axes.field_into_wind(field)))?;
        Ok(self.performance(&axes, &sums))
    }

    /// How fast the states of the inflow change, m/s2, in the axes of `with_inflow`.
    pub fn rate(&mut self, operation: &Operation, field: &Field) -> Result<Field, SolveError> {
        let (axes, flow) = self.wind(operation);
        let field = axes.field_into_wind(field);
        let sums = self.sums(&flow, operation, Some(&field))?;
        let radius = self.geometry.radius;
        let density_area = operation.air.density * PI * radius * radius;
        let loading = Loading {
            thrust: sums.force.z / density_area,
            cosine: sums.moment.y / (radius * density_area),
            sine: -sums.moment.x / (radius * density_area),
        };
        let rate = self.stream(&flow).rate(&field, &loading);
        Ok(axes.field_out_of_wind(&rate))
    }

    /// An estimate of how fast the states of the inflow move towards their equilibrium, 1/s.
    pub fn fastest_rate(&self, operation: &Operation, field: &Field) -> f64 {
        let (_, flow) = self.wind(operation);
        let radius = self.geometry.radius;
        let chord = self
            .geometry
            .stations
            .iter()
            .map(|s| s.chord)
            .fold(0.0, f64::max);
        let solidity = f64::from(self.geometry.blades) * chord / (PI * radius);
        self.stream(&flow)
            .fastest_rate(field.mean, solidity, flow.rotation.abs() * radius)
    }

    /// The inflow at which its states stand still, by Newton's method with differences, from the
    /// static model of Pitt & Peters; steps that do not come closer are halved.
    pub fn equilibrium(&mut self, operation: &Operation) -> Result<Field, SolveError> {
        const STEPS: usize = 40;
        const HALVINGS: usize = 12;
        let (axes, flow) = self.wind(operation);
        let start = self.field(Skew::PittPeters, &flow, operation)?;
        let scale = flow.rotation.abs() * self.geometry.radius + flow.edgewise + flow.climb.abs();
        let mut field = axes.field_out_of_wind(&start);
        if scale == 0.0 {
            return Ok(field);
        }
        let mut rate = Vector3::from(self.rate(operation, &field)?.to_array());
        for _ in 0..STEPS {
            if !rate.norm().is_finite() {
                return Err(SolveError::Disc(RootError::NotFinite));
            }
            let small = 1e-7 * scale;
            let mut slopes = Matrix3::zeros();
            for i in 0..3 {
                let mut other = field.to_array();
                other[i] += small;
                let moved = self.rate(operation, &Field::from_array(other))?;
                slopes.set_column(i, &((Vector3::from(moved.to_array()) - rate) / small));
            }
            let Some(step) = slopes.lu().solve(&-rate) else {
                break;
            };
            let mut part = 1.0;
            for halving in 0..=HALVINGS {
                let next = field.plus(part, &Field::from_array(step.into()));
                let next_rate = Vector3::from(self.rate(operation, &next)?.to_array());
                if next_rate.norm() < rate.norm() || halving == HALVINGS {
                    (field, rate) = (next, next_rate);
                    break;
                }
                part *= 0.5;
            }
            if step.norm() <= 1e-10 * scale {
                return Ok(field);
            }
        }
        Err(SolveError::Equilibrium)
    }

    fn stream(&self, flow: &DiscFlow) -> Stream {
        let DiscFlow {
            edgewise, climb, ..
        } = *flow;
        Stream {
            edgewise,
            climb,
            radius: self.geometry.radius,
        }
    }

    /// Axes into the wind, and the disc's flow in them.
    fn wind(&self, operation: &Operation) -> (WindAxes, DiscFlow) {
        let mirror = self.mirror();
        let Operation {
            airspeed,
            angular_velocity,
            ..
        } = operation;
        let axes = WindAxes::new(airspeed.x, mirror * airspeed.y);
        let (roll_rate, pitch_rate) =
            axes.into_wind(mirror * angular_velocity.x, angular_velocity.y);
        // Cyclic pitch is -cos(psi) and -sin(psi) times these: it turns like (x, y) as well.
        let (cyclic_cos, cyclic_sin) =
            axes.into_wind(operation.cyclic_lateral, operation.cyclic_longitudinal);
        let flow = DiscFlow {
            rotation: operation.speed + mirror * angular_velocity.z,
            edgewise: libm::hypot(airspeed.x, airspeed.y),
            climb: airspeed.z,
            roll_rate,
            pitch_rate,
            cyclic_cos,
            cyclic_sin,
        };
        (axes, flow)
    }

    /// -1 for a clockwise rotor, which is computed as its mirror image.
    fn mirror(&self) -> f64 {
        match self.geometry.rotation {
            Rotation::CounterClockwise => 1.0,
            Rotation::Clockwise => -1.0,
        }
    }

    fn performance(&self, axes: &WindAxes, sums: &Sums) -> Performance {
        let mirror = self.mirror();
        let (force_x, force_y) = axes.out_of_wind(sums.force.x, sums.force.y);
        let (moment_x, moment_y) = axes.out_of_wind(sums.moment.x, sums.moment.y);
        Performance {
            force: Vector3::new(force_x, mirror * force_y, sums.force.z),
            moment: Vector3::new(mirror * moment_x, moment_y, mirror * sums.moment.z),
            torque: -sums.moment.z,
            induced_velocity: sums.flux / sums.area,
            stalled_radius: sums.stalled_radius,
            stalled_fraction: sums.stalled / self.elements.len() as f64,
        }
    }

    /// The loads of all elements, in a field of induced velocity or with the model's own annuli.
    fn sums(
        &mut self,
        flow: &DiscFlow,
        operation: &Operation,
        field: Option<&Field>,
    ) -> Result<Sums, SolveError> {
        let mut sums = Sums::default();
        let is_axisymmetric = flow.is_axisymmetric() && field.is_none_or(Field::is_axisymmetric);
        for i in 0..self.elements.len() {
            let element = self.element(i, operation);
            let mut turn = Turn::new(&element, flow, self.azimuths.of(is_axisymmetric));
            let unsolved = |cause| SolveError::Annulus {
                radius_ratio: element.radius_ratio(),
                cause,
            };
            let mean_induced = match (field, self.models.inflow) {
                (Some(field), _) => {
                    turn.fly(LossIn::Lift, |azimuth| {
                        field.at(element.radius_ratio(), azimuth)
                    });
                    field.mean
                }
                (None, Inflow::AnnulusClosedForm) => {
                    let rotation = flow.rotation * element.radius;
                    let answer =
                        closed_form::solve(&element, rotation, flow.climb).map_err(unsolved)?;
                    turn.take(&answer.load, answer.induced);
                    answer.mean_induced
                }
                (None, _) => {
                    let answer = annulus::solve(&element, flow, turn.azimuths).map_err(unsolved)?;
                    turn.fly(LossIn::Momentum, |_| answer.induced);
                    answer.mean_axial
                }
            };
            let width = self.elements.width;
            sums.force += turn.force * width;
            sums.moment += turn.moment * width;
            sums.flux += mean_induced * element.radius;
            sums.area += element.radius;
            sums.stalled += turn.stalled;
            if turn.stalled > 0.0 {
                sums.stalled_radius = element.radius_ratio();
            }
            self.loads[i] = turn.load(mean_induced);
        }
        Ok(sums)
    }

    /// Glauert's mean inflow and its distribution.
    fn field(
        &self,
        skew: Skew,
        flow: &DiscFlow,
        operation: &Operation,
    ) -> Result<Field, SolveError> {
        let radius = self.geometry.radius;
        let tip_speed = flow.rotation.abs() * radius;
        let distributed = |mean: f64| {
            let through = flow.climb + mean;
            let coefficients = skew.coefficients(flow.edgewise, through, tip_speed);
            let Coefficients { kx, ky } = coefficients;
            Field {
                mean,
                cosine: mean * kx,
                sine: mean * ky,
            }
        };
        let density_area = operation.air.density * PI * radius * radius;
        let thrust = |mean: f64| {
            let field = distributed(mean);
            let mut thrust = 0.0;
            for i in 0..self.elements.len() {
                let element = self.element(i, operation);
                let azimuths = self.azimuths.of(flow.is_axisymmetric());
                let induced = |azimuth| field.at(element.radius_ratio(), azimuth);
                let per_length = mean_thrust(&element, flow, LossIn::Lift, azimuths, induced);
                thrust += per_length * self.elements.width;
            }
            thrust / density_area
        };
        let scale = tip_speed + flow.edgewise + flow.climb.abs();
        if scale == 0.0 {
            return Ok(Field::default());
        }
        let mean = uniform::mean_velocity(flow.edgewise, flow.climb, scale, thrust)
            .map_err(SolveError::Disc)?;
        Ok(distributed(mean))
    }

    fn element(&self, i: usize, operation: &Operation) -> Element<'_> {
        let (elements, air) = (&self.elements, &operation.air);
        let chord = elements.chord[i];
        Element {
            blades: f64::from(self.geometry.blades),
            radius: elements.radius[i],
            tip_radius: self.geometry.radius,
            chord,
            pitch: operation.collective + elements.twist[i],
            lifting_share: self.lifting_share[i],
            tip_loss: self.models.tip_loss,
            section: Section {
                inner: &self.airfoils[elements.inner_airfoil[i]],
                outer: &self.airfoils[elements.outer_airfoil[i]],
                outer_share: elements.outer_share[i],
            },
            model: &self.models.section,
            unit_flow: Similarity {
                reynolds: air.density * chord / air.viscosity,
                mach: 1.0 / air.speed_of_sound,
            },
            density: air.density,
        }
    }
}
