//! Blade elements side by side: their sections, and the loads in a given flow.

use super::{
    airfoil::{Airfoil, SectionModel, Similarity, wrapped},
    disc::SectionFlow,
    numbers::{C, LANES, Lanes, Mask, PerLane, Plain, Portable, Scalar},
    tip_loss::{Span, TipLoss},
    work::Work,
};
use core::f64::consts::PI;

/// Blade elements side by side. SI units, rad.
#[derive(Debug, Clone, Copy)]
pub struct Element<'a, L: Lanes = f64> {
    /// Number of blades N.
    pub blades: f64,
    /// Radius of the element's middle, m.
    pub radius: L::Real,
    /// Radius of the root cutout, m.
    pub root_radius: f64,
    /// R, m.
    pub tip_radius: f64,
    /// c, m.
    pub chord: L::Real,
    /// Pitch of the section from the disc, without cyclic pitch, rad.
    pub pitch: L,
    /// Fraction of the width that carries lift, 0 to 1, for tip losses that end the lift.
    pub lifting_share: L,
    /// Loss of lift at the ends of the blade.
    pub tip_loss: TipLoss,
    /// The airfoils.
    pub section: Section<'a>,
    /// How coefficients are made from airfoil data.
    pub model: &'a SectionModel,
    /// Reynolds and Mach number of a flow of 1 m/s.
    pub unit_flow: Similarity<L>,
    /// Density of the air, kg/m3.
    pub density: L,
    /// Counts the computations of sections.
    pub work: &'a Work,
    /// Number of elements.
    pub count: u64,
}

/// Part of a velocity over which a corner beside it is rounded.
const ROUNDING: f64 = 0.1;

/// The same for the change from lift with the induced velocity to lift against it.
const SHARPNESS: f64 = 0.01;

/// The airfoils of the stations around the elements, whose coefficients are mixed.
#[derive(Debug, Clone, Copy)]
pub struct Section<'a> {
    /// All airfoils of the rotor.
    pub airfoils: &'a [Airfoil],
    /// Those of the elements by their index, with their shares in each lane.
    pub shares: &'a [(usize, [f64; LANES])],
}

/// The loads of one blade's sections per unit of radius, N/m, and the flow at them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionLoad<L = f64> {
    /// Along n, perpendicular to the blade, positive up.
    pub normal: L,
    /// Against e_t, the direction of the blade's motion.
    pub tangential: L,
    /// Angle of attack, rad, between -pi and pi.
    pub angle_of_attack: L,
    /// Speed of the flow, m/s.
    pub speed: L,
    /// Lift coefficient averaged over the element, with its tip loss.
    pub lift_coefficient: L,
    /// Drag coefficient.
    pub drag_coefficient: L,
}

impl<L: Lanes> SectionLoad<L> {
    /// No loads, no flow.
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            normal: L::nil(),
            tangential: L::nil(),
            angle_of_attack: L::nil(),
            speed: L::nil(),
            lift_coefficient: L::nil(),
            drag_coefficient: L::nil(),
        }
    }
}

impl<'a, L: Lanes> Element<'a, L> {
    /// Local solidity N c/(2 pi r).
    #[inline(always)]
    pub fn solidity(&self) -> L::Real {
        self.chord * self.blades / (self.radius * (2.0 * PI))
    }

    /// r/R of the element's middle.
    #[inline(always)]
    pub fn radius_ratio(&self) -> L::Real {
        self.radius / self.tip_radius
    }

    /// Counts a computation of each element's loads.
    #[inline(always)]
    pub fn count_work(&self) {
        self.work.count(self.count);
    }

    /// The same elements in other numbers, to which `convert` takes those of `L`.
    #[inline(always)]
    pub fn map<M: Lanes<Real = L::Real>>(&self, convert: impl Fn(L) -> M) -> Element<'a, M> {
        Element {
            blades: self.blades,
            radius: self.radius,
            root_radius: self.root_radius,
            tip_radius: self.tip_radius,
            chord: self.chord,
            pitch: convert(self.pitch),
            lifting_share: convert(self.lifting_share),
            tip_loss: self.tip_loss,
            section: self.section,
            model: self.model,
            unit_flow: Similarity {
                reynolds: convert(self.unit_flow.reynolds),
                mach: convert(self.unit_flow.mach),
            },
            density: convert(self.density),
            work: self.work,
            count: self.count,
        }
    }

    /// The section's similarity numbers at a speed, m/s.
    #[inline(always)]
    pub fn similarity(&self, speed: L) -> Similarity<L> {
        Similarity {
            reynolds: speed * self.unit_flow.reynolds,
            mach: speed * self.unit_flow.mach,
        }
    }

    /// Lift coefficient of the element, averaged over its width: only `lifting_share` of it carries
    /// lift. `alpha` in rad, `speed` in m/s.
    #[inline(always)]
    pub fn lift_coefficient(&self, alpha: L, speed: L) -> L {
        let flow = self.similarity(speed);
        let pitch = self.pitch.values();
        let lift = match self.section.only() {
            Some(airfoil) => airfoil.lift_coefficient(self.model, pitch, alpha, flow),
            None => {
                let section = &self.section;
                let (alpha, flow) = (&alpha.per_lane(), &flow.per_lane());
                L::in_lanes(&section.mixed_lift::<L::One>(self.model, &pitch.store(), alpha, flow))
            }
        };
        lift * self.lifting_share
    }

    /// Factor by which the compressibility rule raises the incompressible lift coefficient `lift`
    /// at a Mach number (>= 0).
    #[inline(always)]
    pub fn compressibility(&self, lift: L, mach: L) -> L {
        let mut gain = L::nil();
        for (index, shares) in self.section.shares {
            let airfoil = &self.section.airfoils[*index];
            let own = airfoil.compressibility(self.model, lift, mach);
            gain += own.times(L::Real::load(shares));
        }
        gain
    }

    /// Drag coefficient at an angle of attack, rad, and a speed, m/s.
    #[inline(always)]
    pub fn drag_coefficient(&self, alpha: L, speed: L) -> L {
        let flow = self.similarity(speed);
        match self.section.only() {
            Some(airfoil) => airfoil.drag_coefficient(self.model, alpha, flow),
            None => {
                let (alpha, flow) = (&alpha.per_lane(), &flow.per_lane());
                L::in_lanes(&self.section.mixed_drag::<L::One>(self.model, alpha, flow))
            }
        }
    }

    /// Ratio of the mean induced velocity around the annulus to that at the blade.
    #[inline(always)]
    pub fn tip_loss_factor(&self, sin_inflow: L) -> L {
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
    #[inline(always)]
    pub fn induced_at_blade(&self, section: &SectionFlow<L>, mean: L) -> L {
        if !self.tip_loss.has_factor() {
            return mean;
        }
        let through = section.through + section.flap_cos * mean;
        let speed = section.in_plane.length(through);
        let factor = self.tip_loss_factor(through / speed);
        let is_still = speed.values().is_negligible(0.0);
        let is_whole = is_still | !factor.values().is_below(1.0);
        if is_whole.all() {
            return mean;
        }
        // Lift acts up in forward and down in reversed flow; along the shaft it does neither.
        let forward = section.in_plane / section.in_plane.length(C(ROUNDING) * through);
        let alpha = self.pitch + section.pitch - through.atan2(section.in_plane);
        let lift = forward * self.lift_coefficient(alpha, speed) * speed / (2.0 * PI);
        let limit = lift.length(C(ROUNDING) * mean);
        let added = mean / factor - mean;
        // 1 where lift and mean have the same direction, 0 where they have not.
        let product = mean * lift;
        let sum = C(SHARPNESS) * (mean * mean + lift * lift);
        let (same, size) = (product.length(sum), added.length(limit));
        let share = C(0.5) * (C(1.0) + product / same);
        let at_blade = mean + share * added * (limit / size);
        // Without lift and with nothing induced, or so little that its square vanishes.
        let is_nothing = same.values().is_negligible(0.0) | size.values().is_negligible(0.0);
        L::select(is_whole | is_nothing, mean, at_blade)
    }

    /// Loads of the section at a pitch (rad) in a flow with the components `in_plane` against the
    /// motion of the blade and `through` down through the disc (m/s): thesis eqs. (74) to (76) and
    /// (83), (84) without small angles. The flow along the blade has no effect on a section
    /// (independence principle), and here none on its drag either.
    #[inline(always)]
    pub fn load(&self, pitch: L, in_plane: L, through: L) -> SectionLoad<L> {
        self.count_work();
        let speed = in_plane.length(through);
        let alpha = wrapped(pitch - through.atan2(in_plane));
        let lift = self.lift_coefficient(alpha, speed);
        let drag = self.drag_coefficient(alpha, speed);
        let pressure = C(0.5) * self.density * speed * speed.times(self.chord);
        let (sin, cos) = (through / speed, in_plane / speed);
        let load = SectionLoad {
            normal: pressure * (lift * cos - drag * sin),
            tangential: pressure * (lift * sin + drag * cos),
            angle_of_attack: alpha,
            speed,
            lift_coefficient: lift,
            drag_coefficient: drag,
        };
        let is_still = speed.values().is_negligible(0.0);
        if !is_still.any() {
            return load;
        }
        let nothing = |value: L| L::select(is_still, L::nil(), value);
        SectionLoad {
            normal: nothing(load.normal),
            tangential: nothing(load.tangential),
            angle_of_attack: L::select(is_still, wrapped(pitch), alpha),
            speed,
            lift_coefficient: nothing(lift),
            drag_coefficient: nothing(drag),
        }
    }

    /// Where the section is clear of stall at an angle of attack (rad, between -pi and pi),
    /// whatever the flow.
    #[inline(always)]
    pub fn is_unstalled(&self, alpha: L::Real) -> L::Mask {
        let mut is_unstalled = L::Mask::all_lanes(true);
        for (airfoil, _) in self.section.shares {
            is_unstalled = is_unstalled & self.section.airfoils[*airfoil].is_unstalled(alpha);
        }
        is_unstalled
    }

    /// Where the section is beyond the first peak of its lift, to either side. It is not in still
    /// air.
    #[inline(always)]
    pub fn is_stalled(&self, load: &SectionLoad<L>) -> L::Mask {
        let alpha = load.angle_of_attack.values();
        let is_unstalled = self.is_unstalled(alpha);
        if is_unstalled.all() {
            return !is_unstalled;
        }
        let flow = self.similarity(load.speed);
        let (mut negative, mut positive) = ([0.0; LANES], [0.0; LANES]);
        for lane in 0..L::COUNT {
            (negative[lane], positive[lane]) = self.section.stall_angles(lane, flow.lane(lane));
        }
        let negative = <L::Real as Plain>::load(&negative);
        let positive = <L::Real as Plain>::load(&positive);
        let is_beyond = alpha.below(negative) | alpha.above(positive);
        is_beyond & load.speed.values().is_above(0.0)
    }
}

impl<'a> Section<'a> {
    /// The airfoil of sections that are not mixed.
    #[inline(always)]
    fn only(&self) -> Option<&'a Airfoil> {
        match self.shares {
            [(index, _)] => Some(&self.airfoils[*index]),
            _ => None,
        }
    }

    /// The lift coefficient of mixed sections.
    #[inline(never)]
    fn mixed_lift<S: Scalar>(
        &self,
        model: &SectionModel,
        pitch: &[f64; LANES],
        alpha: &PerLane<S>,
        flow: &Similarity<PerLane<S>>,
    ) -> PerLane<S> {
        let alpha = S::In::<Portable>::in_lanes(alpha);
        let (pitch, flow) = (Plain::load(pitch), Similarity::in_lanes(flow));
        let mut lift = S::In::<Portable>::nil();
        for (index, shares) in self.shares {
            let airfoil = &self.airfoils[*index];
            let own = airfoil.lift_coefficient(model, pitch, alpha, flow);
            lift += own.times(Plain::load(shares));
        }
        lift.per_lane()
    }

    /// The drag coefficient of mixed sections.
    #[inline(never)]
    fn mixed_drag<S: Scalar>(
        &self,
        model: &SectionModel,
        alpha: &PerLane<S>,
        flow: &Similarity<PerLane<S>>,
    ) -> PerLane<S> {
        let alpha = S::In::<Portable>::in_lanes(alpha);
        let flow = Similarity::in_lanes(flow);
        let mut drag = S::In::<Portable>::nil();
        for (index, shares) in self.shares {
            let own = self.airfoils[*index].drag_coefficient(model, alpha, flow);
            drag += own.times(Plain::load(shares));
        }
        drag.per_lane()
    }

    /// The stall angles of the mixed section in a lane, negative and positive, rad.
    #[inline(never)]
    fn stall_angles<S: Scalar>(&self, lane: usize, flow: Similarity<S>) -> (f64, f64) {
        let (mut negative, mut positive) = (0.0, 0.0);
        for (airfoil, shares) in self.shares {
            let angles = self.airfoils[*airfoil].stall_angles(flow);
            negative += shares[lane] * angles.0.value();
            positive += shares[lane] * angles.1.value();
        }
        (negative, positive)
    }
}
