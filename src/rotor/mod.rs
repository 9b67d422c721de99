//! The physics of a helicopter rotor: plain structures and functions in SI units and radians.
//! Nothing here knows of FMI.

pub mod air;
pub mod airfoil;
pub mod compressibility;
pub mod geometry;
pub mod inflow;
pub mod root;
pub mod scalar;
mod text_file;
pub mod tip_loss;

use air::Air;
use airfoil::{Airfoil, SectionModel, Similarity};
use geometry::{Elements, Geometry};
use inflow::{Annulus, Inflow, Load, Section, annulus, closed_form};
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

/// What the rotor does, and in which air. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Operation {
    /// Blade pitch at the reference radius.
    pub collective: f64,
    /// Omega >= 0, rad/s.
    pub speed: f64,
    /// Speed of the hub through the air along the shaft, m/s; climb is positive.
    pub climb: f64,
    pub air: Air,
}

/// What the rotor answers, along its shaft. SI units.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Performance {
    pub thrust: f64,
    /// Torque that the rotor absorbs.
    pub torque: f64,
    /// Mean over the swept annulus from cutout to tip, positive down.
    pub induced_velocity: f64,
    /// r/R of the outermost stalled element's middle, 0 if none is stalled.
    pub stalled_radius: f64,
    /// Share of the blade span that is stalled.
    pub stalled_fraction: f64,
}

/// A blade element for which no flow was found.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
#[error("the inflow at r/R = {radius_ratio:.3} has no solution: {cause}")]
pub struct SolveError {
    pub radius_ratio: f64,
    pub cause: RootError,
}

/// A rotor, cut into elements and ready to compute; it owns the memory that a computation needs.
#[derive(Debug, Clone)]
pub struct Rotor {
    geometry: Geometry,
    airfoils: Vec<Airfoil>,
    models: Models,
    elements: Elements,
    lifting_share: Vec<f64>,
    /// The last computation, by element.
    loads: Vec<Load>,
}

impl Rotor {
    /// From a checked geometry, its airfoils (one for each of `geometry.airfoils`) and the number
    /// of elements (>= 1).
    pub fn new(geometry: Geometry, airfoils: Vec<Airfoil>, models: Models, count: usize) -> Self {
        debug_assert_eq!(airfoils.len(), geometry.airfoils.len());
        let elements = Elements::new(&geometry, count);
        let half = 0.5 * elements.width;
        let lifting_share = elements
            .radius
            .iter()
            .map(|r| {
                models.tip_loss.lifting_share(
                    r - half,
                    r + half,
                    geometry.radius,
                    geometry.tip_chord,
                )
            })
            .collect();
        Self {
            loads: vec![Load::default(); elements.len()],
            geometry,
            airfoils,
            models,
            elements,
            lifting_share,
        }
    }

    pub fn geometry(&self) -> &Geometry {
        &self.geometry
    }

    /// Radii of the elements, m, and their loads in the last computation.
    pub fn element_loads(&self) -> (&[f64], &[Load]) {
        (&self.elements.radius, &self.loads)
    }

    /// Computes the rotor in steady axial flow. Allocates nothing.
    pub fn axial(&mut self, operation: &Operation) -> Result<Performance, SolveError> {
        let mut sums = Performance::default();
        let (mut flux, mut area, mut stalled) = (0.0, 0.0, 0usize);
        for i in 0..self.elements.len() {
            let annulus = self.annulus(i, operation);
            let load = match self.models.inflow {
                Inflow::Annulus => annulus::solve(&annulus),
                Inflow::AnnulusClosedForm => closed_form::solve(&annulus),
            }
            .map_err(|cause| SolveError {
                radius_ratio: self.elements.radius[i] / self.geometry.radius,
                cause,
            })?;
            let is_stalled = self.is_stalled(&annulus, &load);
            self.loads[i] = load;

            sums.thrust += load.thrust * self.elements.width;
            sums.torque += load.torque * self.elements.width;
            flux += load.mean_induced_velocity * self.elements.radius[i];
            area += self.elements.radius[i];
            if is_stalled {
                stalled += 1;
                sums.stalled_radius = self.elements.radius[i] / self.geometry.radius;
            }
        }
        sums.induced_velocity = flux / area;
        sums.stalled_fraction = stalled as f64 / self.elements.len() as f64;
        Ok(sums)
    }

    fn annulus(&self, i: usize, operation: &Operation) -> Annulus<'_> {
        let (elements, air) = (&self.elements, &operation.air);
        let chord = elements.chord[i];
        Annulus {
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
            in_plane: operation.speed * elements.radius[i],
            through: operation.climb,
            unit_flow: Similarity {
                reynolds: air.density * chord / air.viscosity,
                mach: 1.0 / air.speed_of_sound,
            },
            density: air.density,
        }
    }

    /// Whether the section is beyond the first peak of its lift. Still air stalls nothing.
    fn is_stalled(&self, annulus: &Annulus, load: &Load) -> bool {
        let flow = annulus.similarity(load.speed);
        let limit = |side: fn((f64, f64)) -> f64| {
            annulus
                .section
                .mixed(|airfoil| side(airfoil.stall_angles(flow)))
        };
        let alpha = airfoil::wrapped(load.angle_of_attack);
        load.speed > 0.0 && (alpha < limit(|s| s.0) || alpha > limit(|s| s.1))
    }
}
