//! Inflow: the velocity that the rotor induces at its own blades, and the section loads with it.

pub mod annulus;
pub mod closed_form;

use super::{
    airfoil::{Airfoil, SectionModel, Similarity},
    scalar::Scalar,
    tip_loss::TipLoss,
};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Inflow {
    /// Blade-element momentum theory in each annulus, all angles.
    Annulus,
    /// Small angles and a linear lift slope: thesis eq. (94).
    AnnulusClosedForm,
}

/// A blade element in its annulus, with the undisturbed flow that meets it. SI units, rad.
#[derive(Debug, Clone, Copy)]
pub struct Annulus<'a> {
    /// Number of blades N.
    pub blades: f64,
    /// Radius of the element's middle, and of the tip, m.
    pub radius: f64,
    pub tip_radius: f64,
    /// m.
    pub chord: f64,
    /// Pitch of the section against the disc, rad.
    pub pitch: f64,
    /// Share of the element that carries lift, 0 to 1 (tip loss of Gessow & Myers).
    pub lifting_share: f64,
    pub tip_loss: TipLoss,
    pub section: Section<'a>,
    pub model: &'a SectionModel,
    /// Flow along the disc from the rotation, Omega r >= 0, m/s.
    pub in_plane: f64,
    /// Undisturbed flow down through the disc (climb), m/s.
    pub through: f64,
    /// Reynolds and Mach number of a flow of 1 m/s.
    pub unit_flow: Similarity<f64>,
    /// kg/m3.
    pub density: f64,
}

/// The airfoils of the stations on either side of an element, whose coefficients are mixed.
#[derive(Debug, Clone, Copy)]
pub struct Section<'a> {
    pub inner: &'a Airfoil,
    pub outer: &'a Airfoil,
    /// 0 to 1.
    pub outer_share: f64,
}

/// The loads and the flow at a blade element. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Load {
    /// Thrust of all blades per unit of radius, N/m.
    pub thrust: f64,
    /// Torque absorbed by all blades per unit of radius, N.
    pub torque: f64,
    pub angle_of_attack: f64,
    /// Induced velocity at the blade, positive down, m/s.
    pub induced_velocity: f64,
    /// Its mean around the annulus, m/s.
    pub mean_induced_velocity: f64,
    /// Speed of the flow that meets the section, m/s.
    pub speed: f64,
}

impl Annulus<'_> {
    /// Local solidity N c/(2 pi r).
    fn solidity(&self) -> f64 {
        self.blades * self.chord / (2.0 * core::f64::consts::PI * self.radius)
    }

    /// The section's flow at a given speed, m/s.
    pub fn similarity<S: Scalar>(&self, speed: S) -> Similarity<S> {
        Similarity {
            reynolds: speed * self.unit_flow.reynolds,
            mach: speed * self.unit_flow.mach,
        }
    }

    /// Lift coefficient of the element's lifting part and of the element as a whole are told
    /// apart by `lifting_share`; this is the latter.
    fn lift_coefficient<S: Scalar>(&self, alpha: S, speed: S) -> S {
        let flow = self.similarity(speed);
        self.section
            .mixed(|airfoil| airfoil.lift_coefficient(self.model, alpha, flow))
            * self.lifting_share
    }

    fn drag_coefficient<S: Scalar>(&self, alpha: S, speed: S) -> S {
        let flow = self.similarity(speed);
        self.section
            .mixed(|airfoil| airfoil.drag_coefficient(self.model, alpha, flow))
    }
}

impl Section<'_> {
    /// A coefficient of the mixed section.
    pub fn mixed<S: Scalar>(&self, coefficient: impl Fn(&Airfoil) -> S) -> S {
        if std::ptr::eq(self.inner, self.outer) {
            return coefficient(self.inner);
        }
        coefficient(self.inner) * (1.0 - self.outer_share)
            + coefficient(self.outer) * self.outer_share
    }
}
