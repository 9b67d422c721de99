//! The closed form of blade-element momentum theory for small angles and a linear lift slope:
//! Knight & Hefner 1937 (NACA TN 626), Leishman 2006 eq. (3.51); the thesis' eq. (94),
//!
//! ```text
//! lambda = sqrt((A - lambda_c/2)^2 + 2 A theta r) - (A - lambda_c/2),   A = sigma cl_alpha/16
//! ```
//!
//! with dCT = sigma cl_alpha/2 (theta r^2 - lambda r) dr, eq. (93), and
//! dCP = sigma/2 (phi cl + cd) r^3 dr, eq. (91), phi = lambda/r. Here everything is multiplied by
//! the tip speed, so that a rotor at standstill is no special case.
//!
//! Negative pitch. The thesis (section 3.2) takes the magnitude of theta under the root and gives
//! the root the sign of theta. Then lambda would jump by 2 A where theta changes its sign, and the
//! thrust would have the wrong sign. Mirroring the rotor in its disc shows that A changes its sign
//! too. So we mirror the whole equation: lambda(-theta, -lambda_c) = -lambda(theta, lambda_c).
//!
//! Fast descent. Where the air passes upwards through the disc (lambda < 0), the mass flow is
//! -lambda and the same derivation gives
//! lambda = (A + lambda_c/2) - sqrt((A + lambda_c/2)^2 - 2 A theta r). This windmill state is taken
//! where it exists.
//!
//! Tip loss. Prandtl's F multiplies the momentum, so A becomes A/F (Leishman 2006, eq. 3.126). F
//! depends on lambda: one bracketed unknown.

use super::Disc;
use crate::{
    airfoil::{Airfoil, wrapped},
    element::{Element, SectionLoad},
    root::{End, RootError, bracketed},
    scalar::{C, Scalar},
    sweep::Sweep,
};

/// Loads and induced velocity of a blade element by the closed form. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedForm<S = f64> {
    /// Loads of one blade's section.
    pub load: SectionLoad<S>,
    /// Induced velocity at the blade, positive down, m/s.
    pub induced: S,
    /// Mean of the induced velocity around the annulus, positive down, m/s.
    pub mean_induced: S,
}

/// Tolerance of the flow through the disc, as a part of its bracket.
const TOLERANCE: f64 = 1e-14;

/// Speed of a section, m/s, below which it counts as stopped.
const STANDSTILL: f64 = 1e-6;

/// Flow down through the disc, m/s: eq. (94) times the tip speed.
///
/// * `a`: sigma cl_alpha/16 times tip speed, > 0, m/s
/// * `climb`: m/s
/// * `pitch_flow`: theta Omega r, m/s
fn through_flow<S: Scalar>(a: S, climb: S, pitch_flow: S) -> S {
    if pitch_flow.is_below(0.0) {
        return -through_flow(a, -climb, -pitch_flow);
    }
    let upward = a + C(0.5) * climb;
    let windmill = upward * upward - C(2.0) * a * pitch_flow;
    if upward.value() < 0.0 && windmill.value() >= 0.0 {
        return upward - windmill.sqrt();
    }
    let half = a - C(0.5) * climb;
    (half * half + C(2.0) * a * pitch_flow).sqrt() - half
}

/// See `ElementInflow::load`.
pub(super) fn load<S: Scalar>(
    disc: &Disc<S>,
    element: &Element<S>,
    sweep: &mut Sweep<S>,
) -> Result<S, RootError> {
    let rotation = disc.flow.rotation * element.radius;
    let solution = solve(element, rotation, disc.flow.climb)?;
    element.work.count(1);
    sweep.take(&solution.load, solution.induced);
    Ok(solution.mean_induced)
}

/// The flow and the loads at one blade element in axial flow.
///
/// * `rotation`: Omega r, m/s; below 1e-6 m/s there is no load
/// * `climb`: flow down through the disc, any sign, m/s
///
/// # Errors
///
/// If the data of the element or the flow are not finite, so that the equation with Prandtl's F has
/// no solution.
pub fn solve<S: Scalar>(
    element: &Element<S>,
    rotation: S,
    climb: S,
) -> Result<ClosedForm<S>, RootError> {
    let zero = S::zero();
    if rotation.value() < STANDSTILL {
        // Inflow angles are small only if the rotor turns. At standstill the theory has no load.
        return Ok(ClosedForm {
            load: SectionLoad::zero(),
            induced: zero,
            mean_induced: zero,
        });
    }
    let flow = element.similarity(rotation);
    let (slope, zero_lift) = {
        let pitch = element.pitch.value();
        let line = |airfoil: &Airfoil| airfoil.lift_line(element.model, pitch, flow);
        let slope = element.section.mixed(|airfoil| line(airfoil).0);
        let moment = element
            .section
            .mixed(|airfoil| line(airfoil).0 * line(airfoil).1);
        let zero_lift = if slope.value() == 0.0 {
            zero
        } else {
            moment / slope
        };
        (slope * element.lifting_share, zero_lift)
    };
    let pitch = element.pitch - zero_lift;

    // The compressibility rules depend on the lift coefficient: eq. (94) once with the
    // incompressible slope for the lift, and again with the slope corrected at that lift.
    let through = loaded_flow(element, rotation, climb, slope, pitch)?;
    let lift = slope * (pitch - through / rotation);
    let gain = |airfoil: &Airfoil| airfoil.compressibility(element.model, lift, flow.mach);
    let corrected = slope * element.section.mixed(gain);
    let through = if corrected.value() == slope.value() {
        through
    } else {
        loaded_flow(element, rotation, climb, corrected, pitch)?
    };

    let inflow_angle = through / rotation;
    let angle_of_attack = wrapped(element.pitch - inflow_angle);
    let lift = corrected * (pitch - inflow_angle);
    let drag = element.drag_coefficient(angle_of_attack, rotation);
    let pressure = C(0.5) * element.density * rotation * rotation * element.chord;
    let induced = through - climb;
    Ok(ClosedForm {
        load: SectionLoad {
            normal: pressure * lift,
            tangential: pressure * (inflow_angle * lift + drag),
            angle_of_attack,
            speed: rotation,
            lift_coefficient: lift,
            drag_coefficient: drag,
        },
        induced,
        mean_induced: induced * factor(element, rotation, through),
    })
}

/// Flow through the disc with tip loss.
fn loaded_flow<S: Scalar>(
    element: &Element<S>,
    rotation: S,
    climb: S,
    slope: S,
    pitch: S,
) -> Result<S, RootError> {
    if slope.value() <= 0.0 {
        return Ok(climb); // no lift, nothing induced
    }
    // sigma Omega R/16 with sigma = N c/(pi R) is (N c/(2 pi r)) Omega r/8.
    let a = slope * element.solidity() * rotation / 8.0;
    let pitch_flow = pitch * rotation;
    let with = |factor: S| through_flow(a / factor, climb, pitch_flow);
    let without_loss = with(S::one());
    if !element.tip_loss.has_factor() {
        // No loss, or the end of the lift, which `slope` contains.
        return Ok(without_loss);
    }
    // The solution lies between `without_loss` (F = 1) and its limit theta Omega r (F = 0).
    let residual = |through: S| {
        let factor = factor(element, rotation, through);
        if factor.value() > 0.0 {
            through - with(factor)
        } else {
            through - pitch_flow
        }
    };
    let plain = |through: f64| residual(S::constant(through)).value();
    let (begin, limit) = (without_loss.value(), pitch_flow.value());
    let first = End {
        at: begin,
        residual: plain(begin),
    };
    let side = if limit > begin { 1.0 } else { -1.0 };
    if first.residual * side >= 0.0 {
        return Ok(without_loss); // F differs from 1 by less than the rounding of the equation
    }
    let last = End {
        at: limit,
        residual: -first.residual,
    };
    let through = bracketed(plain, first, last, TOLERANCE * (limit - begin).abs())?;
    Ok(S::at_root(through, residual))
}

/// Prandtl's F in a flow through the disc, m/s.
fn factor<S: Scalar>(element: &Element<S>, rotation: S, through: S) -> S {
    element.tip_loss_factor(through / rotation) // small angle, as in thesis eq. (95)
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;

    /// Eq. (94) as printed, in ratios of tip speed.
    fn printed(a: f64, climb: f64, theta_r: f64) -> f64 {
        let half = a - climb / 2.0;
        (half * half + 2.0 * a * theta_r).sqrt() - half
    }

    #[test]
    fn equals_the_printed_equation_for_positive_pitch() {
        for climb in [-0.01, 0.0, 0.02, 0.1] {
            for theta_r in [0.0, 0.01, 0.1] {
                let difference = through_flow(0.03, climb, theta_r) - printed(0.03, climb, theta_r);
                assert!(difference.abs() < 1e-15, "{climb} {theta_r}");
            }
        }
    }

    #[test]
    fn satisfies_momentum_theory_in_climb_and_as_a_windmill() {
        // 4 |lambda| (lambda - lambda_c) = 8 A (theta r - lambda)
        for (climb, theta_r) in [
            (0.0, 0.1),
            (0.05, 0.1),
            (-0.3, 0.05),
            (0.3, -0.05),
            (0.0, -0.1),
        ] {
            let a = 0.03;
            let l = through_flow(a, climb, theta_r);
            let sides = 4.0 * l.abs() * (l - climb) - 8.0 * a * (theta_r - l);
            assert!(sides.abs() < 1e-15, "{climb} {theta_r}: {l} leaves {sides}");
        }
    }

    #[test]
    fn mirrored_pitch_and_climb_mirror_the_flow_without_a_jump_at_zero() {
        let a = 0.03;
        assert_eq!(through_flow(a, 0.02, 0.1), -through_flow(a, -0.02, -0.1));
        for climb in [-0.2, -0.02, 0.0, 0.02, 0.2] {
            let jump = through_flow(a, climb, 1e-12) - through_flow(a, climb, -1e-12);
            assert!(jump.abs() < 1e-9, "climb {climb}: jump {jump}");
        }
    }
}
