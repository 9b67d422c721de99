//! Blade-element momentum theory in one annulus, for all angles and directions of flow.
//!
//! Geometry. The undisturbed flow that meets the element has the in-plane part Omega r and the
//! part V down through the disc: speed U at the angle phi0 = atan2(V, Omega r). The bound vortices
//! induce a velocity perpendicular to the flow W that actually meets the section (Glauert 1935,
//! "Airplane Propellers", Durand's Aerodynamic Theory IV, div. L, ch. VII.2), whose axial part is
//! the induced velocity and whose in-plane part is the swirl. So the section sees
//!
//! ```text
//! W = U cos(phi - phi0),   magnitude of the induced velocity U |sin(phi - phi0)|
//! ```
//!
//! at the inflow angle phi, which is the annulus' only unknown. Drag makes no circulation and so induces nothing (Wilson
//! & Lissaman 1974, "Applied Aerodynamics of Wind Power Machines", ch. 3); with drag in the swirl,
//! blades at zero lift in hover would stand in air that turns with them.
//!
//! Momentum. The lift of the element's N blades equals the momentum given to the air that passes
//! through the annulus at W |sin phi| (Glauert 1935, ch. VII.4, with Prandtl's F):
//!
//! ```text
//! N 1/2 rho W^2 c cl dr = 4 pi r rho W |sin phi| F U sin(phi - phi0) dr
//! ```
//!
//! Multiplied out, as Ning 2021 ("Using blade element momentum methods with gradient-based design
//! optimization", Struct. Multidisc. Optim. 64, p. 991) does, there is no division that could
//! vanish, hover is no special case, and with the local solidity s = N c/(2 pi r)
//!
//! ```text
//! R(phi) = 4 F |sin phi| sin(phi - phi0) - s cl(theta - phi) cos(phi - phi0) = 0.
//! ```
//!
//! Bracket. At phi = phi0 the sign of R is that of -cl; at 90 deg from there, R has the sign of
//! the direction in which one went. So there is always a root on the side to which the lift pushes.
//! In descent that side holds up to two more roots: the rotor as a windmill, with the air still
//! passing upwards. The windmill is taken where it exists, that is where R changes its sign
//! before phi0/2, at which 4 F |sin phi| sin(phi - phi0) is largest for F = 1; else the air is
//! pushed down through the disc as in hover (momentum theory as such, which is no longer a good
//! theory there).

use super::{Annulus, Load};
use crate::rotor::{
    root::{End, RootError, bracketed},
    scalar::Scalar,
};
use core::f64::consts::FRAC_PI_2;

/// To which the inflow angle is found, rad.
const TOLERANCE: f64 = 1e-14;

/// The undisturbed flow: speed U and angle phi0.
#[derive(Clone, Copy)]
struct Undisturbed {
    speed: f64,
    angle: f64,
}

/// The residual R(phi), dimensionless.
fn residual<S: Scalar>(annulus: &Annulus, undisturbed: Undisturbed, inflow_angle: S) -> S {
    let sin_inflow = inflow_angle.sin();
    let induced_angle = inflow_angle - undisturbed.angle;
    let across = induced_angle.cos();
    let factor = annulus.tip_loss.factor(
        annulus.blades,
        annulus.radius / annulus.tip_radius,
        sin_inflow,
    );
    let lift = annulus.lift_coefficient(-inflow_angle + annulus.pitch, across * undisturbed.speed);
    factor * sin_inflow.abs() * induced_angle.sin() * 4.0 - lift * across * annulus.solidity()
}

/// The flow and the loads at one element.
///
/// Fails only if the airfoil's or the flow's numbers are not finite, or so large that they overflow.
pub fn solve(annulus: &Annulus) -> Result<Load, RootError> {
    let undisturbed = Undisturbed {
        speed: libm::hypot(annulus.in_plane, annulus.through),
        angle: libm::atan2(annulus.through, annulus.in_plane),
    };
    if undisturbed.speed == 0.0 {
        return Ok(Load {
            angle_of_attack: annulus.pitch,
            ..Load::default()
        });
    }
    let inflow_angle = inflow_angle(annulus, undisturbed)?;
    Ok(load(annulus, undisturbed, inflow_angle))
}

fn inflow_angle(annulus: &Annulus, undisturbed: Undisturbed) -> Result<f64, RootError> {
    let equation = |phi: f64| residual(annulus, undisturbed, phi);
    let end = |at: f64| End {
        at,
        residual: equation(at),
    };
    let search = |from: End, to: End| bracketed(equation, from, to, TOLERANCE);

    let start = end(undisturbed.angle);
    if start.residual == 0.0 {
        return Ok(start.at); // no lift, nothing induced
    }
    let side = if start.residual < 0.0 { 1.0 } else { -1.0 };
    let mut from = start;
    if side * start.at < 0.0 {
        let windmill = end(0.5 * start.at);
        if windmill.residual * side >= 0.0 {
            return search(start, windmill);
        }
        from = windmill;
    }
    let far = start.at + side * FRAC_PI_2;
    // A tighter bracket: without lift, at phi = theta of a symmetrical section, R has the sign of
    // the side, which is checked rather than assumed.
    if side * (annulus.pitch - from.at) > 0.0 && side * (far - annulus.pitch) > 0.0 {
        let pitch = end(annulus.pitch);
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

fn load(annulus: &Annulus, undisturbed: Undisturbed, inflow_angle: f64) -> Load {
    let (sin, cos) = (Scalar::sin(inflow_angle), Scalar::cos(inflow_angle));
    let induced_angle = inflow_angle - undisturbed.angle;
    let speed = undisturbed.speed * Scalar::cos(induced_angle);
    let angle_of_attack = annulus.pitch - inflow_angle;
    let lift = annulus.lift_coefficient(angle_of_attack, speed);
    let drag = annulus.drag_coefficient(angle_of_attack, speed);
    let pressure = 0.5 * annulus.density * speed * speed * annulus.chord * annulus.blades;
    // The axial part of the induced velocity, W sin(phi) - V, without taking a difference.
    let induced_velocity = undisturbed.speed * Scalar::sin(induced_angle) * cos;
    let factor = annulus
        .tip_loss
        .factor(annulus.blades, annulus.radius / annulus.tip_radius, sin);
    Load {
        thrust: pressure * (lift * cos - drag * sin),
        torque: pressure * (lift * sin + drag * cos) * annulus.radius,
        angle_of_attack,
        induced_velocity,
        mean_induced_velocity: factor * induced_velocity,
        speed,
    }
}
