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
    linear::{Coefficients, Skew},
};
use crate::{
    disc::{Azimuth, BladePosition, DiscFlow},
    element::Element,
    induced::Induced,
    root::{End, RootError, bracketed},
    scalar::{C, Scalar},
    sweep::{InducedAt, Sweep},
};
use core::f64::consts::FRAC_PI_2;

/// Tolerance of the inflow angle, rad.
const TOLERANCE: f64 = 1e-14;

/// Distance from the far end of the bracket within which the mean flow counts as brought to rest,
/// rad.
const FAR_END: f64 = 1e-12;

/// The mean of the undisturbed flow around the annulus: speed U and angle phi0.
#[derive(Clone, Copy)]
struct Undisturbed<S> {
    speed: S,
    angle: S,
}

/// The induced velocity in an annulus, m/s.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AnnulusInflow<S = f64> {
    /// At the blades, averaged over the azimuth.
    pub induced: Induced<S>,
    /// Its growth towards psi = 0 and 90 deg at this radius, as a part of the average.
    pub skew: Coefficients<S>,
    /// Mean of the axial component around the annulus.
    pub mean_axial: S,
}

impl<S: Scalar> AnnulusInflow<S> {
    /// No induced velocity.
    pub fn zero() -> Self {
        Self {
            induced: Induced::axial(S::zero()),
            skew: Coefficients::zero(),
            mean_axial: S::zero(),
        }
    }

    /// At a blade at an azimuth.
    pub fn at(&self, azimuth: Azimuth<S>) -> Induced<S> {
        let skew = &self.skew;
        let growth = skew.kx * azimuth.cos + skew.ky * azimuth.sin;
        self.induced.scaled(C(1.0) + growth)
    }
}

/// The residual R(phi) where all azimuths are alike and momentum theory holds, dimensionless.
fn axial_residual<S: Scalar>(
    element: &Element<S>,
    undisturbed: Undisturbed<S>,
    inflow_angle: S,
) -> S {
    element.work.count(1);
    let sin_inflow = inflow_angle.sin();
    let induced_angle = inflow_angle - undisturbed.angle;
    let across = induced_angle.cos();
    let factor = element.tip_loss_factor(sin_inflow);
    let lift = element.lift_coefficient(-inflow_angle + element.pitch, across * undisturbed.speed);
    C(4.0) * (factor * sin_inflow.abs() * induced_angle.sin()) - lift * across * element.solidity()
}

/// The residual R(phi) of the mean over blade positions, dimensionless.
fn mean_residual<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    positions: &[BladePosition<S>],
    momentum: &Momentum<S>,
    undisturbed: Undisturbed<S>,
    inflow_angle: S,
) -> S {
    let far = induced(undisturbed, inflow_angle);
    let inflow = AnnulusInflow {
        induced: momentum.at_the_blades(flow.edgewise, far.axial, far),
        skew: skew(element, flow, momentum, far.axial),
        ..AnnulusInflow::zero()
    };
    let (sin_inflow, cos_inflow) = (inflow_angle.sin(), inflow_angle.cos());
    let speed = undisturbed.speed;
    let mut sum = S::zero();
    for position in positions {
        let section = flow.at_section(element.radius, position);
        let induced = inflow.at(position.azimuth);
        // In units of U: its square can overflow.
        let (in_plane, through) = (
            (section.in_plane - induced.swirl) / speed,
            (section.through + section.flap_cos * induced.axial) / speed,
        );
        let square = in_plane * in_plane + through * through;
        let local_speed = square.sqrt();
        let alpha = element.pitch + section.pitch - through.atan2(in_plane);
        // W_psi^2 cos(phi_psi - phi) = W_psi (W_psi cos phi_psi cos phi + W_psi sin phi_psi sin
        // phi); the first term is perpendicular to the flapped blade.
        let axial = section.flap_cos * in_plane * cos_inflow;
        let projected = local_speed * (axial + through * sin_inflow);
        sum += element.lift_coefficient(alpha, local_speed * speed) * projected;
    }
    let lift = sum / positions.len() as f64;
    let momentum_work = momentum.descent.work(flow.climb, far.axial);
    element.work.count(positions.len() as u64 + momentum_work);
    let resultant = momentum.descent.speed(flow.edgewise, flow.climb, far.axial) / speed;
    let induced_part = (inflow_angle - undisturbed.angle).sin();
    let factor = element.tip_loss_factor(wake_sine(flow, momentum, undisturbed, inflow_angle));
    factor * 4.0 * resultant * induced_part - lift * element.solidity()
}

/// The variation around the annulus that the skew of the wake gives; `axial`: induced velocity,
/// m/s.
fn skew<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    momentum: &Momentum<S>,
    axial: S,
) -> Coefficients<S> {
    let tip_speed = flow.rotation.abs() * element.tip_radius;
    Skew::Howlett
        .coefficients(
            flow.edgewise,
            momentum.wake_speed(flow.climb, axial),
            tip_speed,
        )
        .scaled(element.radius_ratio())
}

/// The velocity induced at an inflow angle, without a difference of large numbers.
fn induced<S: Scalar>(undisturbed: Undisturbed<S>, inflow_angle: S) -> Induced<S> {
    let magnitude = undisturbed.speed * (inflow_angle - undisturbed.angle).sin();
    Induced {
        axial: magnitude * inflow_angle.cos(),
        swirl: magnitude * inflow_angle.sin(),
    }
}

/// Sine of the angle at which the wake leaves the disc, for Prandtl's F: |sin phi| in momentum
/// theory.
fn wake_sine<S: Scalar>(
    flow: &DiscFlow<S>,
    momentum: &Momentum<S>,
    undisturbed: Undisturbed<S>,
    inflow_angle: S,
) -> S {
    let axial = induced(undisturbed, inflow_angle).axial;
    if momentum.is_plain(flow.climb, axial) {
        return inflow_angle.sin();
    }
    let speed = undisturbed.speed * (inflow_angle - undisturbed.angle).cos().abs();
    momentum.wake_sine_in_descent(flow.climb, axial, speed)
}

/// See `ElementInflow::load`.
pub(super) fn load<S: Scalar>(
    disc: &Disc<S>,
    element: &Element<S>,
    sweep: &mut Sweep<S>,
) -> Result<S, RootError> {
    let inflow = solve(element, disc.flow, disc.positions, &disc.momentum)?;
    sweep.load_in(InducedAt::Blade, |_, position| {
        Ok(inflow.at(position.azimuth))
    })?;
    Ok(inflow.mean_axial)
}

/// The velocity induced in an element's annulus, averaged over the blade positions.
///
/// Fails only if the airfoil's or the flow's numbers are not finite, or overflow.
pub fn solve<S: Scalar>(
    element: &Element<S>,
    flow: &DiscFlow<S>,
    positions: &[BladePosition<S>],
    momentum: &Momentum<S>,
) -> Result<AnnulusInflow<S>, RootError> {
    let rotation = flow.rotation * element.radius;
    let undisturbed = Undisturbed {
        speed: rotation.hypot(flow.climb),
        angle: flow.climb.atan2(rotation),
    };
    if undisturbed.speed.value() == 0.0 {
        return Ok(AnnulusInflow::zero());
    }
    let equation = |phi: S| mean_residual(element, flow, positions, momentum, undisturbed, phi);
    let inflow_angle = if is_one_for_all(flow, positions) {
        // At phi0 nothing is induced, and R is the lift alone.
        let lift = element.lift_coefficient(element.pitch - undisturbed.angle, undisturbed.speed);
        let start = lift * -element.solidity();
        if momentum.is_plain(flow.climb, lift) && momentum.ground.is_far() {
            let equation = |phi: S| axial_residual(element, undisturbed, phi);
            inflow_angle(undisturbed.angle, start, element.pitch, equation)?
        } else {
            inflow_angle(undisturbed.angle, start, element.pitch, equation)?
        }
    } else {
        let start = equation(undisturbed.angle);
        inflow_angle(undisturbed.angle, start, element.pitch, equation)?
    };
    let far = induced(undisturbed, inflow_angle);
    let induced = momentum.at_the_blades(flow.edgewise, far.axial, far);
    let factor = element.tip_loss_factor(wake_sine(flow, momentum, undisturbed, inflow_angle));
    Ok(AnnulusInflow {
        induced,
        skew: skew(element, flow, momentum, far.axial),
        mean_axial: factor * induced.axial,
    })
}

/// Whether a single position without flapping stands for all.
fn is_one_for_all<S: Scalar>(flow: &DiscFlow<S>, positions: &[BladePosition<S>]) -> bool {
    matches!(positions, [position] if position.flap_sin.is_negligible(0.0))
        && flow.is_axisymmetric()
}

/// The inflow angle, rad, with the residual `start` at phi0 = `undisturbed`; `pitch` of the
/// element.
fn inflow_angle<S: Scalar>(
    undisturbed: S,
    start: S,
    pitch: S,
    equation: impl Fn(S) -> S,
) -> Result<S, RootError> {
    let first = End {
        at: undisturbed.value(),
        residual: start.value(),
    };
    let found = root(first, pitch.value(), |phi| {
        equation(S::constant(phi)).value()
    })?;
    // Nothing is induced, or the mean flow is brought to rest: the angle keeps its distance to
    // phi0.
    let distance = found - undisturbed.value();
    if start.is_negligible(0.0) || f64::abs(distance) > FRAC_PI_2 - FAR_END {
        return Ok(S::at_root(found, |phi| phi - undisturbed - distance));
    }
    Ok(S::at_root(found, equation))
}

/// The root that belongs to the residual at phi0.
fn root(start: End, pitch: f64, equation: impl Fn(f64) -> f64) -> Result<f64, RootError> {
    let end = |at: f64| End {
        at,
        residual: equation(at),
    };
    let search = |from: End, to: End| bracketed(&equation, from, to, TOLERANCE);

    if start.residual == 0.0 {
        return Ok(start.at); // no lift, nothing induced
    }
    let side = if start.residual < 0.0 { 1.0 } else { -1.0 };
    let mut from = start;
    if side * start.at < 0.0 {
        for part in [0.5, 0.375, 0.25, 0.125, 0.0] {
            from = end(part * start.at);
            if from.residual * side >= 0.0 {
                return search(start, from);
            }
        }
    }
    let far = start.at + side * FRAC_PI_2;
    // A tighter bracket: without lift, at phi = theta of a symmetrical section, R has the sign of
    // the side, which is checked rather than assumed.
    if side * (pitch - from.at) > 0.0 && side * (far - pitch) > 0.0 {
        let pitch = end(pitch);
        if pitch.residual * side > 0.0 {
            return search(from, pitch);
        }
    }
    search(
        from,
        End {
            at: far,
            residual: -from.residual,
        },
    )
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;
    use crate::{
        airfoil::{Airfoil, Lift, SectionModel, Similarity},
        compressibility::Compressibility,
        disc::{Azimuth, Flap},
        element::Section,
        inflow::{Descent, Ground, GroundEffect},
        tip_loss::TipLoss,
    };
    use num_dual::Dual64;
    use std::path::Path;

    const MODEL: SectionModel = SectionModel {
        lift: Lift::Table,
        compressibility: Compressibility::KarmanTsien,
        drag_reynolds_exponent: 0.2,
    };

    pub fn airfoil() -> Airfoil {
        let folder =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("../../modelDescription/resources/airfoils");
        Airfoil::read(&folder.join("naca0015.polar")).unwrap()
    }

    /// An element at 0.8 R of three blades with Prandtl's tip loss.
    pub fn element<S: Scalar>(airfoil: &Airfoil, chord: f64, pitch: S) -> Element<'_, S> {
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
                inner: airfoil,
                outer: airfoil,
                outer_share: 0.0,
            },
            model: &MODEL,
            unit_flow: Similarity {
                reynolds: S::constant(7e3),
                mach: S::constant(1.0 / 340.0),
            },
            density: S::constant(1.2),
            work: Box::leak(Box::default()),
        }
    }

    /// The induced velocity moves with pitch and climb as its differences do, in hover and climb,
    /// at no lift and where the table has no corner.
    #[test]
    fn the_derivatives_of_the_solution_are_those_of_its_differences() {
        fn induced<S: Scalar>(airfoil: &Airfoil, pitch: S, climb: S, edgewise: f64) -> S {
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
            let inflow = solve(&element, &flow, &[position], &momentum);
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
                let inflow = solve(&element, &flow, &[anywhere], &momentum).unwrap();
                let is_windmill = climb + inflow.induced.axial < -1e-6;
                changes += u32::from(is_windmill != was_windmill);
                was_windmill = is_windmill;
            }
            assert_eq!(changes, 1, "chord {chord}, pitch {pitch}");
        }
    }
}
