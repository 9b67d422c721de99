//! Blade-element momentum theory in one annulus, for all angles and directions of flow.
//!
//! # Geometry
//!
//! The undisturbed flow at the element has the in-plane component Omega r and the component V down
//! through the disc: speed U at the angle phi0 = atan2(V, Omega r). The bound vortices induce a
//! velocity perpendicular to the flow W at the section (Glauert 1935, "Airplane Propellers",
//! Durand's Aerodynamic Theory IV, div. L, ch. VII.2). Its axial component is the induced velocity,
//! its in-plane component the swirl. So the section sees
//!
//! ```text
//! W = U cos(phi - phi0),   magnitude of the induced velocity U |sin(phi - phi0)|
//! ```
//!
//! at the inflow angle phi, the only unknown of the annulus. Drag makes no circulation and so
//! induces nothing (Wilson & Lissaman 1974, "Applied Aerodynamics of Wind Power Machines", ch. 3).
//! With drag in the swirl, blades at zero lift in hover would stand in air that turns with them.
//!
//! # Momentum
//!
//! The lift of the element's N blades equals the momentum given to the air that passes through the
//! annulus at W |sin phi| (Glauert 1935, ch. VII.4, with Prandtl's F):
//!
//! ```text
//! N 1/2 rho W^2 c cl dr = 4 pi r rho W |sin phi| F U sin(phi - phi0) dr
//! ```
//!
//! Multiplied out, as in Ning 2021 ("Using blade element momentum methods with gradient-based
//! design optimization", Struct. Multidisc. Optim. 64, p. 991), no divisor can vanish and hover is
//! no special case. With the local solidity s = N c/(2 pi r),
//!
//! ```text
//! R(phi) = 4 F |sin phi| sin(phi - phi0) - s cl(theta - phi) cos(phi - phi0) = 0.
//! ```
//!
//! # Bracket
//!
//! At phi = phi0 the sign of R is that of -cl; 90 deg from there, R has the sign of the direction
//! taken. So there is always a root on the side to which the lift pushes. In descent that side can
//! hold two more roots under plain momentum theory (the other laws of `descent` have one root): the
//! rotor as a windmill, with the air still passing upwards. The windmill is taken where R has
//! changed its sign at one of the angles 1/2, 3/8, 1/4 or 1/8 of phi0 (without lift, 4 F |sin phi|
//! sin(phi - phi0) is largest at 1/2, and lift that falls with phi shifts the largest R towards 0).
//! Otherwise the root on the other side of phi = 0 is taken, which continues hover: the air is
//! pushed down through the disc (plain momentum theory, which is no longer a good theory there).
//!
//! # Method
//!
//! In hover and climb below stall, where R has one root, Newton's method from the closed form; else
//! the bracket.
//!
//! # Edgewise flow, cyclic pitch and angular velocity of the hub
//!
//! The induced velocity is the same all around the annulus and perpendicular to the mean flow W.
//! The lift is averaged over the azimuth, and the mass flow is Glauert's resultant
//! sqrt(V_x^2 + (W sin phi)^2) (1926, ARC R&M 1111), so that
//!
//! ```text
//! R(phi) = 4 F sqrt(V_x^2 + (W sin phi)^2)/U sin(phi - phi0)
//!          - s mean((W_psi/U)^2 cl_psi cos(phi_psi - phi)),
//! ```
//!
//! with W_psi the flow at each blade position. Where all azimuths are alike it is the equation
//! above times cos(phi - phi0). The lift is projected on the direction of the induced velocity, and
//! so is the momentum. Where blades are computed one by one they take the place of the azimuths,
//! and the balance holds at each instant.
//!
//! The wake of a disc in edgewise flow is skewed, and induces more at the rear than at the front:
//! the induced velocity varies around the annulus like Howlett's (1981, NASA CR-166309),
//!
//! ```text
//! v_psi = v (1 + sin^2 chi (r/R) cos psi),   chi = atan(V_x/|V + v|).
//! ```
//!
//! In descent the law's V' takes the place of |V + v|, which passes through 0. The lift in R
//! includes the variation, so that lift and momentum still balance in the mean. As in
//! AeroDyn (Moriarty & Hansen 2005, NREL/TP-500-36881, ch. 2.4) each annulus has its own chi; in
//! axial flow nothing changes. Of the linear distributions, Howlett's was chosen after a comparison
//! with measured inflow and lateral flapping (docs/validation.md): annuli with Pitt & Peters' had
//! less error in the inflow, but more in the flapping.
//!
//! At the far end of the bracket the mean flow W vanishes. If strong edgewise flow along a slow
//! disc leaves the sign of R unchanged even there, that end is taken: the rotor brings its own air
//! to rest.

use super::{
    Disc, Momentum,
    closed_form::through_flow,
    linear::{Coefficients, Skew},
};
use crate::{
    disc::{Azimuth, BladeFlow, DiscFlow},
    element::Element,
    geometry::Block,
    induced::Induced,
    numbers::{C, Dual, Equation, Lanes, Mask, Plain, Portable, Scalar, converted},
    root::{End, RootError, bracketed},
};
use core::f64::consts::FRAC_PI_2;

/// Tolerance of the inflow angle, rad.
const TOLERANCE: f64 = 1e-14;

/// Distance from the far end of the bracket within which the mean flow counts as brought to rest,
/// rad.
const FAR_END: f64 = 1e-12;

/// Largest last step, rad, at which Newton's method counts as converged. The remaining error is
/// about its square, or a few percent of it if a corner of the table lies within the step.
const LAST_STEP: f64 = 1e-8;

/// Bound on Newton's steps; a few are usual.
const MAX_STEPS: u32 = 6;

/// Lift slope from which Newton's method starts, 1/rad: that of thin sections.
const FIRST_SLOPE: f64 = 5.9;

/// The mean of the undisturbed flow around the annulus: speed U and angle phi0.
#[derive(Debug, Clone, Copy)]
struct Undisturbed<L> {
    speed: L,
    angle: L,
    /// Sine of phi0.
    sin: L,
    /// Cosine of phi0.
    cos: L,
}

/// The induced velocity in annuli side by side, m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnulusInflow<L = f64> {
    /// At the blades, averaged over the azimuth.
    pub induced: Induced<L>,
    /// Its growth towards psi = 0 and 90 deg at this radius, as a part of the average.
    pub skew: Coefficients<L>,
    /// Mean of the axial component around the annulus.
    pub mean_axial: L,
}

impl<L: Lanes> AnnulusInflow<L> {
    /// No induced velocity.
    #[inline(always)]
    pub fn zero() -> Self {
        Self {
            induced: Induced::axial(L::nil()),
            skew: Coefficients {
                kx: L::nil(),
                ky: L::nil(),
            },
            mean_axial: L::nil(),
        }
    }

    /// At a blade at an azimuth.
    #[inline(always)]
    pub fn at(&self, azimuth: Azimuth<L::One>) -> Induced<L> {
        let (cos, sin) = (L::splat(azimuth.cos), L::splat(azimuth.sin));
        let growth = self.skew.kx * cos + self.skew.ky * sin;
        self.induced.scaled(C(1.0) + growth)
    }

    /// The same numbers in other lanes.
    #[inline(always)]
    fn converted<M: Lanes<One = L::One>>(&self) -> AnnulusInflow<M> {
        AnnulusInflow {
            induced: Induced {
                axial: converted(self.induced.axial),
                swirl: converted(self.induced.swirl),
            },
            skew: Coefficients {
                kx: converted(self.skew.kx),
                ky: converted(self.skew.ky),
            },
            mean_axial: converted(self.mean_axial),
        }
    }
}

/// The residual R(phi) where all azimuths are alike and momentum theory holds, dimensionless.
struct AxialBalance<'a, L: Lanes> {
    element: &'a Element<'a, L>,
    undisturbed: Undisturbed<L>,
}

impl<L: Lanes> Equation<L> for AxialBalance<'_, L> {
    #[inline(always)]
    fn residual(&self, inflow_angle: L) -> L {
        let element = self.element;
        element.count_work();
        let Undisturbed { sin, cos, .. } = self.undisturbed;
        let (sin_inflow, cos_inflow) = inflow_angle.sin_cos();
        // Sine and cosine of phi - phi0.
        let sin_induced = sin_inflow * cos - cos_inflow * sin;
        let across = cos_inflow * cos + sin_inflow * sin;
        let factor = element.tip_loss_factor(sin_inflow);
        let speed = across * self.undisturbed.speed;
        let lift = element.lift_coefficient(element.pitch - inflow_angle, speed);
        C(4.0) * (factor * sin_inflow.abs() * sin_induced)
            - (lift * across).times(element.solidity())
    }
}

/// The residual R(phi) of the mean over blade positions, dimensionless.
struct MeanBalance<'a, L: Lanes> {
    element: &'a Element<'a, L>,
    flow: &'a DiscFlow<L::One>,
    blades: &'a [BladeFlow<L::One>],
    momentum: &'a Momentum<L::One>,
    undisturbed: Undisturbed<L>,
}

impl<L: Lanes> Equation<L> for MeanBalance<'_, L> {
    fn residual(&self, inflow_angle: L) -> L {
        let Self {
            element,
            flow,
            momentum,
            undisturbed,
            ..
        } = self;
        let (sin_inflow, cos_inflow) = inflow_angle.sin_cos();
        let induced_part = (inflow_angle - undisturbed.angle).sin();
        let magnitude = undisturbed.speed * induced_part;
        let far = Induced {
            axial: magnitude * cos_inflow,
            swirl: magnitude * sin_inflow,
        };
        let inflow = AnnulusInflow {
            induced: momentum.at_the_annuli(flow.edgewise, far),
            skew: skew(element, flow, momentum, far.axial),
            ..AnnulusInflow::zero()
        };
        let speed = undisturbed.speed;
        let mut sum = L::nil();
        for blade in self.blades {
            let section = blade.at_section::<L>(element.radius);
            let induced = inflow.at(blade.azimuth);
            // In units of U: its square can overflow.
            let (in_plane, through) = (
                (section.in_plane - induced.swirl) / speed,
                (section.through + section.flap_cos * induced.axial) / speed,
            );
            let local_speed = in_plane.length(through);
            let alpha = element.pitch + section.pitch - through.atan2(in_plane);
            // W_psi^2 cos(phi_psi - phi) = W_psi (W_psi cos phi_psi cos phi + W_psi sin phi_psi
            // sin phi); the first term is perpendicular to the flapped blade.
            let axial = section.flap_cos * in_plane * cos_inflow;
            let projected = local_speed * (axial + through * sin_inflow);
            sum += element.lift_coefficient(alpha, local_speed * speed) * projected;
            element.count_work();
        }
        let lift = sum / self.blades.len() as f64;
        let climb = L::splat(flow.climb);
        element
            .work
            .count(momentum.descent.work_of(L::nil(), climb, far.axial));
        let edgewise = L::splat(flow.edgewise);
        let resultant = momentum.descent.speeds(edgewise, climb, far.axial) / speed;
        let factor = element.tip_loss_factor(wake_sine(flow, momentum, *undisturbed, inflow_angle));
        C(4.0) * factor * resultant * induced_part - lift.times(element.solidity())
    }
}

/// The variation around the annulus that the skew of the wake gives; `axial`: induced velocity,
/// m/s.
fn skew<L: Lanes>(
    element: &Element<L>,
    flow: &DiscFlow<L::One>,
    momentum: &Momentum<L::One>,
    axial: L,
) -> Coefficients<L> {
    let tip_speed = flow.rotation.abs() * element.tip_radius;
    let through = momentum.wake_speed(L::splat(flow.climb), axial);
    let of_lane =
        |lane: usize| Skew::Howlett.coefficients(flow.edgewise, through.lane(lane), tip_speed);
    let ratio = element.radius_ratio();
    Coefficients {
        kx: L::from_lanes(|lane| of_lane(lane).kx).times(ratio),
        ky: L::nil(),
    }
}

/// The velocity induced at an inflow angle, without a difference of large numbers.
#[inline(always)]
fn induced<L: Lanes>(undisturbed: Undisturbed<L>, inflow_angle: L) -> Induced<L> {
    let magnitude = undisturbed.speed * (inflow_angle - undisturbed.angle).sin();
    let (sin, cos) = inflow_angle.sin_cos();
    Induced {
        axial: magnitude * cos,
        swirl: magnitude * sin,
    }
}

/// Sine of the angle at which the wake leaves the disc, for Prandtl's F: |sin phi| in momentum
/// theory.
fn wake_sine<L: Lanes>(
    flow: &DiscFlow<L::One>,
    momentum: &Momentum<L::One>,
    undisturbed: Undisturbed<L>,
    inflow_angle: L,
) -> L {
    let climb = L::splat(flow.climb);
    let axial = induced(undisturbed, inflow_angle).axial;
    let is_plain = momentum.is_plain(climb, axial);
    let sine = inflow_angle.sin();
    if is_plain.all() {
        return sine;
    }
    let speed = undisturbed.speed * (inflow_angle - undisturbed.angle).cos().abs();
    let in_descent = momentum.wake_sine_in_descent(climb, axial, speed);
    L::select(is_plain, sine, in_descent)
}

/// The velocity induced in the annuli of a block's elements, averaged over the blade positions.
///
/// Fails only if the airfoil's or the flow's numbers are not finite, or overflow.
#[inline(always)]
pub(super) fn find<L: Lanes>(
    disc: &Disc<L::One>,
    block: &Block,
    element: &Element<L>,
    blades: &[BladeFlow<L::One>],
) -> Result<AnnulusInflow<L>, RootError> {
    if is_one_for_all(disc.flow, blades)
        && let Some(inflow) = in_axial_flow(element, disc.flow, &disc.momentum)
    {
        return Ok(inflow);
    }
    let inflow = search(disc, block, blades)?;
    Ok(inflow.converted())
}

/// `solve` in the lanes that every processor has.
#[inline(never)]
fn search<S: Scalar>(
    disc: &Disc<S>,
    block: &Block,
    blades: &[BladeFlow<S>],
) -> Result<AnnulusInflow<S::In<Portable>>, RootError> {
    let element = disc.blade.block::<S::In<Portable>>(block);
    solve(&element, disc.flow, blades, &disc.momentum)
}

impl<L: Lanes> Undisturbed<L> {
    #[inline(always)]
    fn of(element: &Element<L>, flow: &DiscFlow<L::One>) -> Self {
        let rotation = L::splat(flow.rotation).times(element.radius);
        let climb = L::splat(flow.climb);
        let speed = rotation.length(climb);
        Self {
            speed,
            angle: climb.atan2(rotation),
            sin: climb / speed,
            cos: rotation / speed,
        }
    }
}

/// The inflow in hover and climb by Newton's method. Between phi0 and stall R grows with phi,
/// because the momentum grows and the lift falls, so it has one root. None elsewhere, or if any
/// lane does not converge.
#[inline(always)]
fn in_axial_flow<L: Lanes>(
    element: &Element<L>,
    flow: &DiscFlow<L::One>,
    momentum: &Momentum<L::One>,
) -> Option<AnnulusInflow<L>> {
    let undisturbed = Undisturbed::of(element, flow);
    let without = element.pitch - undisturbed.angle;
    let climb = L::splat(flow.climb);
    let is_simple = momentum.ground.is_far()
        && (!(climb * without).values().is_below(0.0)).all()
        && undisturbed.speed.values().is_above(0.0).all()
        && undisturbed.cos.values().is_above(0.0).all()
        && (!without.values().is_negligible(0.0)).all()
        && element.is_unstalled(without.values()).all();
    if !is_simple {
        return None;
    }
    let angle = {
        let plain = element.map(L::values);
        let element = plain.map(Dual::from_re);
        let undisturbed = Undisturbed {
            speed: Dual::from_re(undisturbed.speed.values()),
            angle: Dual::from_re(undisturbed.angle.values()),
            sin: Dual::from_re(undisturbed.sin.values()),
            cos: Dual::from_re(undisturbed.cos.values()),
        };
        let balance = AxialBalance {
            element: &element,
            undisturbed,
        };
        let mut angle = first_angle(&plain, undisturbed.angle.re, undisturbed.speed.re);
        let mut step = L::Real::nil();
        for _ in 0..MAX_STEPS {
            let at = balance.residual(Dual::new(angle, L::Real::unit()));
            step = at.re / at.eps;
            angle = angle - step;
            if step.is_negligible(LAST_STEP).all() {
                break;
            }
        }
        // Accepted only on the side of the sign of the angle of attack and within 90 deg of phi0,
        // where R has one root; NaN lies nowhere. Where a cambered section lifts the other way, the
        // bracket decides.
        let distance = angle - undisturbed.angle.re;
        let is_inside =
            (distance * without.values()).is_above(0.0) & distance.abs().is_below(FRAC_PI_2);
        if !(step.is_negligible(LAST_STEP) & is_inside).all() {
            return None;
        }
        angle
    };
    let balance = AxialBalance {
        element,
        undisturbed,
    };
    let inflow_angle = L::at_roots(angle, &balance);
    let induced = induced(undisturbed, inflow_angle);
    let factor = element.tip_loss_factor(inflow_angle.sin());
    Some(AnnulusInflow {
        induced,
        mean_axial: factor * induced.axial,
        ..AnnulusInflow::zero()
    })
}

/// The inflow angle by the closed form, first for a lift slope of `FIRST_SLOPE` without tip loss,
/// and then with Prandtl's F and the lift slope at that angle; `undisturbed` is phi0.
#[inline(always)]
fn first_angle<V: Plain>(element: &Element<V>, undisturbed: V, speed: V) -> V {
    let solidity = element.solidity();
    let angle = through_flow(solidity * (FIRST_SLOPE / 8.0), undisturbed, element.pitch);
    let alpha = element.pitch - angle;
    let slope = element.lift_coefficient(alpha, speed) / alpha;
    let is_usual = slope.is_above(0.5 * FIRST_SLOPE) & slope.is_below(2.0 * FIRST_SLOPE);
    let slope = V::select(is_usual, slope, V::splat(FIRST_SLOPE));
    let factor = element.tip_loss_factor(angle);
    through_flow(
        solidity * slope / (factor * 8.0),
        undisturbed,
        element.pitch,
    )
}

/// The velocity induced in annuli, by a bracket.
///
/// Fails only if the airfoil's or the flow's numbers are not finite, or overflow.
pub fn solve<L: Lanes>(
    element: &Element<L>,
    flow: &DiscFlow<L::One>,
    blades: &[BladeFlow<L::One>],
    momentum: &Momentum<L::One>,
) -> Result<AnnulusInflow<L>, RootError> {
    let undisturbed = Undisturbed::of(element, flow);
    // In all lanes or in none.
    if undisturbed.speed.values().is_negligible(0.0).any() {
        return Ok(AnnulusInflow::zero());
    }
    let mean = MeanBalance {
        element,
        flow,
        blades,
        momentum,
        undisturbed,
    };
    let inflow_angle = if is_one_for_all(flow, blades) {
        // At phi0 nothing is induced, and R is the lift alone.
        let lift = element.lift_coefficient(element.pitch - undisturbed.angle, undisturbed.speed);
        let start = -lift.times(element.solidity());
        let is_plain = momentum.is_plain(L::splat(flow.climb), lift).all();
        if is_plain && momentum.ground.is_far() {
            let axial = AxialBalance {
                element,
                undisturbed,
            };
            inflow_angle(undisturbed.angle, start, element.pitch, &axial)?
        } else {
            inflow_angle(undisturbed.angle, start, element.pitch, &mean)?
        }
    } else {
        let start = mean.residual(undisturbed.angle);
        inflow_angle(undisturbed.angle, start, element.pitch, &mean)?
    };
    let far = induced(undisturbed, inflow_angle);
    let induced = momentum.at_the_annuli(flow.edgewise, far);
    let factor = element.tip_loss_factor(wake_sine(flow, momentum, undisturbed, inflow_angle));
    Ok(AnnulusInflow {
        induced,
        skew: skew(element, flow, momentum, far.axial),
        mean_axial: factor * induced.axial,
    })
}

/// Whether a single position without flapping stands for all.
#[inline(always)]
fn is_one_for_all<S: Scalar>(flow: &DiscFlow<S>, blades: &[BladeFlow<S>]) -> bool {
    matches!(blades, [blade] if blade.flap_sin.is_negligible(0.0)) && flow.is_axisymmetric()
}

/// The inflow angle, rad, with the residual `start` at phi0 = `undisturbed`; `pitch` of the
/// element.
fn inflow_angle<L: Lanes>(
    undisturbed: L,
    start: L,
    pitch: L,
    equation: &impl Equation<L>,
) -> Result<L, RootError> {
    let first = End {
        at: undisturbed.values(),
        residual: start.values(),
    };
    let found = root(first, pitch.values(), |phi| {
        equation.residual(L::real(phi)).values()
    })?;
    // Nothing is induced, or the mean flow is brought to rest: the angle keeps its distance to
    // phi0.
    let distance = found - undisturbed.values();
    let is_kept = start.is_negligible(0.0) | distance.abs().is_above(FRAC_PI_2 - FAR_END);
    let kept = undisturbed.plus_real(distance);
    if is_kept.all() {
        return Ok(kept);
    }
    Ok(L::select(is_kept, kept, L::at_roots(found, equation)))
}

/// The root that belongs to the residual at phi0.
fn root<V: Plain>(start: End<V>, pitch: V, equation: impl Fn(V) -> V) -> Result<V, RootError> {
    let end = |at: V| End {
        at,
        residual: equation(at),
    };
    let is_nothing = start.residual.is_negligible(0.0); // no lift, nothing induced
    let side = V::select(start.residual.is_below(0.0), V::splat(1.0), V::splat(-1.0));
    let is_descent = (side * start.at).is_below(0.0) & !is_nothing;
    let mut from = start;
    let mut is_windmill = V::Mask::all_lanes(false);
    if is_descent.any() {
        for part in [0.5, 0.375, 0.25, 0.125, 0.0] {
            let is_open = is_descent & !is_windmill;
            let next = end(start.at * part);
            from = End::select(is_open, next, from);
            is_windmill = is_windmill | (is_open & !(next.residual * side).is_below(0.0));
            if (is_windmill | !is_descent).all() {
                break;
            }
        }
    }
    let far = start.at + side * FRAC_PI_2;
    let mut to = End {
        at: far,
        residual: -from.residual,
    };
    // A tighter bracket: without lift, at phi = theta of a symmetrical section, R has the sign of
    // the side, which is checked rather than assumed.
    let is_between = (side * (pitch - from.at)).is_above(0.0)
        & (side * (far - pitch)).is_above(0.0)
        & !is_windmill
        & !is_nothing;
    if is_between.any() {
        let pitch = end(pitch);
        let is_tighter = is_between & (pitch.residual * side).is_above(0.0);
        to = End::select(is_tighter, pitch, to);
    }
    let first = End::select(is_windmill | is_nothing, start, from);
    let last = End::select(is_windmill, from, to);
    let last = End::select(is_nothing, start, last);
    bracketed(&equation, first, last, V::splat(TOLERANCE))
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::numbers::Dual64;
    use crate::{
        airfoil::{Airfoil, Lift, SectionModel, Similarity},
        compressibility::Compressibility,
        disc::{Azimuth, BladePosition, Flap},
        element::Section,
        inflow::{Descent, Ground, GroundEffect},
        numbers::LANES,
        tip_loss::TipLoss,
    };
    use std::path::Path;

    const MODEL: SectionModel = SectionModel {
        lift: Lift::Table,
        compressibility: Compressibility::KarmanTsien,
        drag_reynolds_exponent: 0.2,
    };

    pub fn airfoil() -> [Airfoil; 1] {
        let folder =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../../modelDescription/resources/airfoils");
        [Airfoil::read(&folder.join("naca0015.polar")).unwrap()]
    }

    /// An element at 0.8 R of three blades with Prandtl's tip loss.
    pub fn element<S: Scalar>(airfoil: &[Airfoil], chord: f64, pitch: S) -> Element<'_, S> {
        Element {
            blades: 3.0,
            radius: 0.8,
            root_radius: 0.1,
            tip_radius: 1.0,
            chord,
            pitch,
            lifting_share: S::one(),
            tip_loss: TipLoss::Prandtl,
            section: Section {
                airfoils: airfoil,
                shares: &[(0, [1.0; LANES])],
            },
            model: &MODEL,
            unit_flow: Similarity {
                reynolds: S::constant(7e3),
                mach: S::constant(1.0 / 340.0),
            },
            density: S::constant(1.2),
            work: Box::leak(Box::default()),
            count: 1,
        }
    }

    /// The induced velocity moves with pitch and climb as its differences do, in hover and climb,
    /// at no lift and where the table has no corner.
    #[test]
    fn the_derivatives_of_the_solution_are_those_of_its_differences() {
        fn induced<S: Scalar>(airfoil: &[Airfoil], pitch: S, climb: S, edgewise: f64) -> S {
            let flow = DiscFlow {
                rotation: S::constant(100.0),
                speed: S::constant(100.0),
                edgewise: S::constant(edgewise),
                climb,
                roll_rate: S::zero(),
                pitch_rate: S::zero(),
                cyclic_cos: S::zero(),
                cyclic_sin: S::zero(),
                hinge: 0.0,
            };
            let azimuth = Azimuth {
                sin: S::constant(0.6),
                cos: S::constant(0.8),
            };
            let position = BladePosition::new(azimuth, Flap::rigid(0.0), S::zero());
            let element = element(airfoil, 0.1, pitch);
            let ground = Ground {
                effect: GroundEffect::None,
                height_ratio: S::one(),
                upright: S::one(),
            };
            let momentum = Momentum {
                descent: Descent::Measured.unstretched(),
                ground,
            };
            let inflow = solve(&element, &flow, &[flow.at_blade(&position)], &momentum);
            inflow.unwrap().induced.axial
        }
        let airfoil = airfoil();
        for (pitch, climb, edgewise) in [
            (0.15, 0.0, 0.0),
            (0.15, 3.0, 0.0),
            (0.15, -4.0, 0.0),
            (0.15, 1.0, 20.0),
            (-0.08, 0.5, 10.0),
        ] {
            let plain = |pitch, climb| induced::<f64>(&airfoil, pitch, climb, edgewise);
            for (by_pitch, by_climb) in [(1.0, 0.0), (0.0, 1.0)] {
                let step = 1e-6;
                let (dp, dc) = (by_pitch * step, by_climb * step);
                let above = plain(pitch + dp, climb + dc);
                let difference = (above - plain(pitch - dp, climb - dc)) / (2.0 * step);
                let dual = induced(
                    &airfoil,
                    Dual64::new(pitch, by_pitch),
                    Dual64::new(climb, by_climb),
                    edgewise,
                );
                assert!((dual.re - plain(pitch, climb)).abs() < 1e-12);
                assert!(
                    (dual.eps - difference).abs() < 1e-6 * (1.0 + difference.abs()),
                    "{pitch} {climb} {edgewise}: {} {difference}",
                    dual.eps
                );
            }
        }
    }

    /// From hover to fast descent momentum theory goes over to the windmill once and stays there.
    #[test]
    fn descent_changes_to_the_windmill_once() {
        let airfoil = airfoil();
        let cases = [0.1, 0.3].map(|chord| [0.0, 0.02, 0.05, 0.1].map(|pitch| (chord, pitch)));
        for (chord, pitch) in cases.into_iter().flatten() {
            let element = element(&airfoil, chord, pitch);
            let mut changes = 0;
            let mut was_windmill = false;
            for i in 0..4000 {
                let climb = -0.02 * f64::from(i);
                let flow = DiscFlow {
                    rotation: 100.0,
                    climb,
                    ..DiscFlow::default()
                };
                let anywhere = BladePosition::new(Default::default(), Default::default(), 0.0);
                let momentum = Momentum {
                    descent: Descent::Momentum.unstretched(),
                    ground: Ground::default(),
                };
                let inflow =
                    solve(&element, &flow, &[flow.at_blade(&anywhere)], &momentum).unwrap();
                let is_windmill = climb + inflow.induced.axial < -1e-6;
                changes += u32::from(is_windmill != was_windmill);
                was_windmill = is_windmill;
            }
            assert_eq!(changes, 1, "chord {chord}, pitch {pitch}");
        }
    }
}
