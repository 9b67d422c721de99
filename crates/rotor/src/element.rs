//! A blade element: the section, and its loads in a given flow.

use super::{
    airfoil::{Airfoil, SectionModel, Similarity, wrapped},
    disc::SectionFlow,
    scalar::{C, Scalar},
    tip_loss::{Span, TipLoss},
    work::Work,
};
use core::f64::consts::PI;

/// A blade element. SI units, rad.
#[derive(Debug, Clone, Copy)]
pub struct Element<'a, S = f64> {
    /// Number of blades N.
    pub blades: f64,
    /// Radius of the element's middle, m.
    pub radius: f64,
    /// Radius of the root cutout, m.
    pub root_radius: f64,
    /// R, m.
    pub tip_radius: f64,
    /// c, m.
    pub chord: f64,
    /// Pitch of the section from the disc, without cyclic pitch, rad.
    pub pitch: S,
    /// Fraction of the width that carries lift, 0 to 1, for tip losses that end the lift.
    pub lifting_share: S,
    /// Loss of lift at the ends of the blade.
    pub tip_loss: TipLoss,
    /// The airfoils on either side.
    pub section: Section<'a>,
    /// How coefficients are made from airfoil data.
    pub model: &'a SectionModel,
    /// Reynolds and Mach number of a flow of 1 m/s.
    pub unit_flow: Similarity<S>,
    /// Density of the air, kg/m3.
    pub density: S,
    /// Counts the computations of sections.
    pub work: &'a Work,
}

/// Part of a velocity over which a corner beside it is rounded.
const ROUNDING: f64 = 0.1;

/// The same for the change from lift with the induced velocity to lift against it.
const SHARPNESS: f64 = 0.01;

/// The airfoils of the stations on either side of an element, whose coefficients are mixed.
#[derive(Debug, Clone, Copy)]
pub struct Section<'a> {
    /// Airfoil of the station inboard.
    pub inner: &'a Airfoil,
    /// Airfoil of the station outboard.
    pub outer: &'a Airfoil,
    /// Weight of the outer airfoil, 0 to 1.
    pub outer_share: f64,
}

/// The loads of one blade's section per unit of radius, N/m, and the flow at it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionLoad<S = f64> {
    /// Along n, perpendicular to the blade, positive up.
    pub normal: S,
    /// Against e_t, the direction of the blade's motion.
    pub tangential: S,
    /// Angle of attack, rad, between -pi and pi.
    pub angle_of_attack: S,
    /// Speed of the flow, m/s.
    pub speed: S,
    /// Lift coefficient averaged over the element, with its tip loss.
    pub lift_coefficient: S,
    /// Drag coefficient.
    pub drag_coefficient: S,
}

impl<S: Scalar> SectionLoad<S> {
    /// No loads, no flow.
    pub fn zero() -> Self {
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

/// sqrt(a^2 + b^2) of ordinary numbers, faster than `hypot`.
fn length<S: Scalar>(a: S, b: S) -> S {
    (a * a + b * b).sqrt()
}

impl<S: Scalar> Element<'_, S> {
    /// Local solidity N c/(2 pi r).
    pub fn solidity(&self) -> f64 {
        self.blades * self.chord / (2.0 * PI * self.radius)
    }

    /// r/R of the element's middle.
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

    /// Lift coefficient of the element, averaged over its width: only `lifting_share` of it carries
    /// lift. `alpha` in rad, `speed` in m/s.
    pub fn lift_coefficient(&self, alpha: S, speed: S) -> S {
        let flow = self.similarity(speed);
        self.section
            .mixed(|airfoil| airfoil.lift_coefficient(self.model, self.pitch.value(), alpha, flow))
            * self.lifting_share
    }

    /// Drag coefficient at an angle of attack, rad, and a speed, m/s.
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

    /// Axial induced velocity at the blade, m/s, for an inflow model that gives `mean`, the mean
    /// around the annulus. `section` is the flow without induced velocity.
    ///
    /// Prandtl's F is the ratio of the two (Prandtl 1919, appendix to Betz; Glauert 1935, div. L,
    /// ch. VII.4): v = mean/F, so that no lift is lost where nothing is induced. The mean flow
    /// carries the vortex sheets of the wake away, and its angle decides F.
    ///
    /// Towards the tip mean/F grows without bound. In a balance of the annulus the momentum would
    /// fall with the lift; here the mean is given. So the addition a = mean/F - mean goes over
    /// smoothly to d = cl W/(2 pi), which takes away all the lift cl that the mean flow leaves (for
    /// a lift slope of 2 pi): a d/sqrt(a^2 + d^2). Where the lift acts against the mean, nothing is
    /// added. These limits are our assumption, and their corners are rounded.
    pub fn induced_at_blade(&self, section: &SectionFlow<S>, mean: S) -> S {
        let through = section.through + section.flap_cos * mean;
        let speed = section.in_plane.hypot(through);
        if speed.value() == 0.0 {
            return mean;
        }
        let factor = self.tip_loss_factor(through / speed);
        if factor.value() == 1.0 {
            return mean;
        }
        // Lift acts up in forward and down in reversed flow; along the shaft it does neither.
        let forward = section.in_plane / length(section.in_plane, C(ROUNDING) * through);
        let alpha = self.pitch + section.pitch - through.atan2(section.in_plane);
        let lift = forward * self.lift_coefficient(alpha, speed) * speed / (2.0 * PI);
        let limit = length(lift, C(ROUNDING) * mean);
        let added = mean / factor - mean;
        // 1 where lift and mean have the same direction, 0 where they have not.
        let product = mean * lift;
        let sum = C(SHARPNESS) * (mean * mean + lift * lift);
        let (same, size) = (length(product, sum), length(added, limit));
        if same.value() == 0.0 || size.value() == 0.0 {
            return mean; // no lift and nothing induced, or so little that its square vanishes
        }
        let share = C(0.5) * (C(1.0) + product / same);
        mean + share * added * (limit / size)
    }

    /// Loads of the section at a pitch (rad) in a flow with the components `in_plane` against the
    /// motion of the blade and `through` down through the disc (m/s): thesis eqs. (74) to (76) and
    /// (83), (84) without small angles. The flow along the blade has no effect on a section
    /// (independence principle), and here none on its drag either.
    pub fn load(&self, pitch: S, in_plane: S, through: S) -> SectionLoad<S> {
        self.work.count(1);
        let speed = in_plane.hypot(through);
        if speed.value() == 0.0 {
            return SectionLoad {
                angle_of_attack: wrapped(pitch),
                speed,
                ..SectionLoad::zero()
            };
        }
        let (sin, cos) = (through / speed, in_plane / speed);
        let alpha = wrapped(pitch - through.atan2(in_plane));
        let lift = self.lift_coefficient(alpha, speed);
        let drag = self.drag_coefficient(alpha, speed);
        let pressure = C(0.5) * self.density * speed * speed * self.chord;
        SectionLoad {
            normal: pressure * (lift * cos - drag * sin),
            tangential: pressure * (lift * sin + drag * cos),
            angle_of_attack: alpha,
            speed,
            lift_coefficient: lift,
            drag_coefficient: drag,
        }
    }

    /// Whether the section is beyond the first peak of its lift, to either side. It is not in still
    /// air.
    pub fn is_stalled(&self, load: &SectionLoad<S>) -> bool {
        let alpha = load.angle_of_attack.value();
        if self.section.inner.is_unstalled(alpha) && self.section.outer.is_unstalled(alpha) {
            return false;
        }
        let flow = self.similarity(load.speed);
        let limit = |side: fn((S, S)) -> S| {
            self.section
                .mixed(|airfoil| side(airfoil.stall_angles(flow)))
                .value()
        };
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
