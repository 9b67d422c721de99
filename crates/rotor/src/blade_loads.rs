//! Loads along the blade.

use super::{
    geometry::Elements,
    numbers::{Lanes, Scalar},
};

/// The loads and the flow at a blade element: those of blade 1, or azimuth averages. SI units, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ElementLoads<S = f64> {
    /// Thrust per unit of radius times the number of blades, N/m.
    pub thrust: S,
    /// Torque absorbed per unit of radius times the number of blades, N.
    pub torque: S,
    /// Angle of attack, rad.
    pub angle_of_attack: S,
    /// Induced velocity at the blades, positive down, m/s.
    pub induced_velocity: S,
    /// Mean induced velocity around the annulus, m/s. Prandtl's F in the momentum makes it less
    /// than that at the blades.
    pub mean_induced_velocity: S,
    /// Speed of the flow at the section, m/s.
    pub speed: S,
    /// Lift coefficient.
    pub lift_coefficient: S,
    /// Drag coefficient.
    pub drag_coefficient: S,
    /// Reynolds number of the chord.
    pub reynolds: S,
    /// Mach number of the flow at the section.
    pub mach: S,
}

impl<L: Lanes> ElementLoads<L> {
    /// No loads, no flow.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = L::nil();
        Self {
            thrust: zero,
            torque: zero,
            angle_of_attack: zero,
            induced_velocity: zero,
            mean_induced_velocity: zero,
            speed: zero,
            lift_coefficient: zero,
            drag_coefficient: zero,
            reynolds: zero,
            mach: zero,
        }
    }

    /// A function of each quantity.
    #[inline(always)]
    pub(crate) fn map<M>(&self, function: impl Fn(L) -> M) -> ElementLoads<M> {
        ElementLoads {
            thrust: function(self.thrust),
            torque: function(self.torque),
            angle_of_attack: function(self.angle_of_attack),
            induced_velocity: function(self.induced_velocity),
            mean_induced_velocity: function(self.mean_induced_velocity),
            speed: function(self.speed),
            lift_coefficient: function(self.lift_coefficient),
            drag_coefficient: function(self.drag_coefficient),
            reynolds: function(self.reynolds),
            mach: function(self.mach),
        }
    }
}

impl<S: Scalar> ElementLoads<S> {
    /// `self + weight * (other - self)`.
    fn towards(&self, other: &Self, weight: f64) -> Self {
        let mix =
            |quantity: fn(&Self) -> S| quantity(self) + (quantity(other) - quantity(self)) * weight;
        Self {
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

/// The loads of all elements from root to tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BladeLoads<'a, S = f64> {
    pub(crate) elements: &'a Elements,
    pub(crate) tip_radius: f64,
    /// One for each element.
    pub(crate) loads: &'a [ElementLoads<S>],
}

impl<'a, S: Scalar> BladeLoads<'a, S> {
    /// Radii of the middles of the elements, m, from root to tip.
    pub fn radii(&self) -> &'a [f64] {
        &self.elements.radius
    }

    /// Loads of the elements, one for each radius.
    pub fn elements(&self) -> &'a [ElementLoads<S>] {
        self.loads
    }

    /// Loads at a radius r/R: linear between the middles of the elements, and those of the end
    /// elements beyond them.
    pub fn at(&self, radius_ratio: f64) -> ElementLoads<S> {
        let last = self.loads.len() - 1;
        let index =
            (radius_ratio * self.tip_radius - self.elements.radius[0]) / self.elements.width;
        let inner = (index.max(0.0) as usize).min(last);
        let weight = (index - inner as f64).clamp(0.0, 1.0);
        self.loads[inner].towards(&self.loads[(inner + 1).min(last)], weight)
    }
}
