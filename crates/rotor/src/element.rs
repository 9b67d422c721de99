//! A blade element: the section, and its loads in a given flow.

use super::{
    airfoil::{Airfoil, SectionModel, Similarity, wrapped},
    scalar::Scalar,
    tip_loss::{Span, TipLoss},
};
use core::f64::consts::PI;

/// A blade element. SI units, rad.
#[derive(Debug, Clone, Copy)]
pub struct Element<'a, S = f64> {
    /// Number of blades N.
    pub blades: f64,
    /// Radius of the element's middle, of the root and of the tip, m.
    pub radius: f64,
    pub root_radius: f64,
    pub tip_radius: f64,
    /// m.
    pub chord: f64,
    /// Pitch of the section against the disc without cyclic pitch, rad.
    pub pitch: S,
    /// Share of the element that carries lift, 0 to 1 (tip losses that end it).
    pub lifting_share: S,
    pub tip_loss: TipLoss,
    pub section: Section<'a>,
    pub model: &'a SectionModel,
    /// Reynolds and Mach number of a flow of 1 m/s.
    pub unit_flow: Similarity<S>,
    /// kg/m3.
    pub density: S,
}

/// The airfoils of the stations on either side of an element, whose coefficients are mixed.
#[derive(Debug, Clone, Copy)]
pub struct Section<'a> {
    pub inner: &'a Airfoil,
    pub outer: &'a Airfoil,
    /// 0 to 1.
    pub outer_share: f64,
}

/// Where the tip loss F of an inflow model stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LossIn {
    /// In the momentum of the annulus; the section's lift is whole.
    Momentum,
    /// In the section's lift, because the inflow knows nothing of the tip.
    Lift,
}

/// The loads of one blade's section per unit of radius, N/m, and the flow that meets it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionLoad<S = f64> {
    /// Along the shaft, up.
    pub normal: S,
    /// In the disc, against the motion of the blade.
    pub tangential: S,
    /// rad, between -pi and pi.
    pub angle_of_attack: S,
    /// m/s.
    pub speed: S,
    /// Of the element as a whole, with its tip loss.
    pub lift_coefficient: S,
    pub drag_coefficient: S,
}

impl<S: Scalar> SectionLoad<S> {
    /// Of a section in still air, and of one whose angle of attack nobody asks for.
    pub fn none() -> Self {
        Self {
            normal: S::zero(),
            tangential: S::zero(),
            angle_of_attack: S::zero(),
            speed: S::zero(),
            lift_coefficient: S::zero(),
            drag_coefficient: S::zero(),
        }
    }
}

impl<S: Scalar> Element<'_, S> {
    /// Local solidity N c/(2 pi r).
    pub fn solidity(&self) -> f64 {
        self.blades * self.chord / (2.0 * PI * self.radius)
    }

    pub fn radius_ratio(&self) -> f64 {
        self.radius / self.tip_radius
    }

    /// The section's similarity numbers at a speed, m/s.
    pub fn similarity(&self, speed: S) -> Similarity<S> {
        Similarity {
            reynolds: speed * self.unit_flow.reynolds,
            mach: speed * self.unit_flow.mach,
        }
    }

    /// Lift coefficient of the whole element, of which the share `lifting_share` carries lift.
    pub fn lift_coefficient(&self, alpha: S, speed: S) -> S {
        let flow = self.similarity(speed);
        self.section
            .mixed(|airfoil| airfoil.lift_coefficient(self.model, self.pitch.value(), alpha, flow))
            * self.lifting_share
    }

    pub fn drag_coefficient(&self, alpha: S, speed: S) -> S {
        let flow = self.similarity(speed);
        self.section
            .mixed(|airfoil| airfoil.drag_coefficient(self.model, alpha, flow))
    }

    /// Ratio of the mean induced velocity around the annulus to that at the blade.
    pub fn tip_loss_factor(&self, sin_inflow: S) -> S {
        let span = Span {
            blades: self.blades,
            radius_ratio: self.radius_ratio(),
            cutout: self.root_radius / self.tip_radius,
        };
        self.tip_loss.factor(&span, sin_inflow)
    }

    /// Loads of the section at a pitch (rad) in a flow with the part `in_plane` against the
    /// motion of the blade and `through` down through the disc (m/s), thesis eqs. (74) to (76)
    /// and (83), (84) without small angles. The flow along the blade has no effect on a section
    /// (independence principle), and none on its drag here.
    pub fn load(&self, pitch: S, in_plane: S, through: S, loss: LossIn) -> SectionLoad<S> {
        let speed = in_plane.hypot(through);
        if speed.value() == 0.0 {
            return SectionLoad {
                angle_of_attack: wrapped(pitch),
                speed,
                ..SectionLoad::none()
            };
        }
        let (sin, cos) = (through / speed, in_plane / speed);
        let alpha = wrapped(pitch - through.atan2(in_plane));
        let lift = self.lift_coefficient(alpha, speed)
            * match loss {
                LossIn::Momentum => S::one(),
                LossIn::Lift => self.tip_loss_factor(sin),
            };
        let drag = self.drag_coefficient(alpha, speed);
        let pressure = self.density * 0.5 * speed * speed * self.chord;
        SectionLoad {
            normal: pressure * (lift * cos - drag * sin),
            tangential: pressure * (lift * sin + drag * cos),
            angle_of_attack: alpha,
            speed,
            lift_coefficient: lift,
            drag_coefficient: drag,
        }
    }

    /// Whether a section in this flow is beyond the first peak of its lift, to either side. Still
    /// air stalls nothing.
    pub fn is_stalled(&self, load: &SectionLoad<S>) -> bool {
        let flow = self.similarity(load.speed);
        let limit = |side: fn((S, S)) -> S| {
            self.section
                .mixed(|airfoil| side(airfoil.stall_angles(flow)))
                .value()
        };
        let alpha = load.angle_of_attack.value();
        load.speed.value() > 0.0 && (alpha < limit(|s| s.0) || alpha > limit(|s| s.1))
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
