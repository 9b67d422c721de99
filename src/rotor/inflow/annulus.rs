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
//!
//! Flow along the disc, cyclic pitch and angular velocity of the hub. The induced velocity stays
//! the same all around the annulus, perpendicular to the mean flow W; the lift is averaged over
//! the azimuth, and the mass flow is Glauert's resultant sqrt(V_x^2 + (W sin phi)^2) (1926, ARC
//! R&M 1111), so that
//!
//! ```text
//! R(phi) = 4 F sqrt(V_x^2 + (W sin phi)^2)/U sin(phi - phi0)
//!          - s mean((W_psi/U)^2 cl_psi cos(phi_psi - phi)),
//! ```
//!
//! which is the equation above times cos(phi - phi0) where all azimuths are alike. The lift is
//! projected on the direction of the induced velocity, and so is the momentum. On the far side
//! of the bracket the mean flow W vanishes; where strong flow along a slow disc leaves the sign
//! of R unchanged even there, that end is taken: the rotor then brings its own air to rest.

use super::Induced;
use crate::rotor::{
    disc::{Azimuth, DiscFlow},
    element::Element,
    root::{End, RootError, bracketed},
    scalar::Scalar,
};
use core::f64::consts::FRAC_PI_2;

/// To which the inflow angle is found, rad.
const TOLERANCE: f64 = 1e-14;

/// The mean of the undisturbed flow around the annulus: speed U and angle phi0.
#[derive(Clone, Copy)]
struct Undisturbed {
    speed: f64,
    angle: f64,
}

/// What the annulus answers: the induced velocity at the blades, and the mean of its axial part
/// around the annulus, m/s.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Answer {
    pub induced: Induced,
    pub mean_axial: f64,
}

/// The residual R(phi) where all azimuths are alike, dimensionless.
fn axial_residual<S: Scalar>(element: &Element, undisturbed: Undisturbed, inflow_angle: S) -> S {
    let sin_inflow = inflow_angle.sin();
    let induced_angle = inflow_angle - undisturbed.angle;
    let across = induced_angle.cos();
    let factor = element.tip_loss_factor(sin_inflow);
    let lift = element.lift_coefficient(-inflow_angle + element.pitch, across * undisturbed.speed);
    factor * sin_inflow.abs() * induced_angle.sin() * 4.0 - lift * across * element.solidity()
}

/// The residual R(phi) of the mean over azimuths, dimensionless.
fn mean_residual(
    element: &Element,
    flow: &DiscFlow,
    azimuths: &[Azimuth],
    undisturbed: Undisturbed,
    inflow_angle: f64,
) -> f64 {
    let induced = induced(undisturbed, inflow_angle);
    let mean_through = flow.climb + induced.axial;
    let (sin_inflow, cos_inflow) = (Scalar::sin(inflow_angle), Scalar::cos(inflow_angle));
    let speed = undisturbed.speed;
    let mut lift = 0.0;
    for azimuth in azimuths {
        let meets = flow.meets(element.radius, *azimuth);
        let (in_plane, through) = (
            meets.in_plane - induced.swirl,
            meets.through + induced.axial,
        );
        let square = in_plane * in_plane + through * through;
        let local_speed = libm::sqrt(square);
        let alpha = element.pitch + meets.cyclic - libm::atan2(through, in_plane);
        // W_psi^2 cos(phi_psi - phi) = W_psi (W_psi cos phi_psi cos phi + W_psi sin phi_psi sin phi)
        let projected = local_speed * (in_plane * cos_inflow + through * sin_inflow);
        lift += element.lift_coefficient(alpha, local_speed) * projected;
    }
    lift /= azimuths.len() as f64 * speed * speed;
    let resultant = libm::hypot(flow.edgewise, mean_through) / speed;
    let induced_part = Scalar::sin(inflow_angle - undisturbed.angle);
    4.0 * element.tip_loss_factor(sin_inflow) * resultant * induced_part - element.solidity() * lift
}

/// The velocity induced at an inflow angle, without taking a difference of large numbers.
fn induced(undisturbed: Undisturbed, inflow_angle: f64) -> Induced {
    let magnitude = undisturbed.speed * Scalar::sin(inflow_angle - undisturbed.angle);
    Induced {
        axial: magnitude * Scalar::cos(inflow_angle),
        swirl: magnitude * Scalar::sin(inflow_angle),
    }
}

/// What an element's annulus induces in a flow, averaged over `azimuths`.
///
/// Fails only if the airfoil's or the flow's numbers are not finite, or so large that they overflow.
pub fn solve(
    element: &Element,
    flow: &DiscFlow,
    azimuths: &[Azimuth],
) -> Result<Answer, RootError> {
    let rotation = flow.rotation * element.radius;
    let undisturbed = Undisturbed {
        speed: libm::hypot(rotation, flow.climb),
        angle: libm::atan2(flow.climb, rotation),
    };
    if undisturbed.speed == 0.0 {
        return Ok(Answer::default());
    }
    let inflow_angle = if flow.is_axisymmetric() {
        root(undisturbed, element.pitch, |phi| {
            axial_residual(element, undisturbed, phi)
        })?
    } else {
        root(undisturbed, element.pitch, |phi| {
            mean_residual(element, flow, azimuths, undisturbed, phi)
        })?
    };
    let induced = induced(undisturbed, inflow_angle);
    let factor = element.tip_loss_factor(Scalar::sin(inflow_angle));
    Ok(Answer {
        induced,
        mean_axial: factor * induced.axial,
    })
}

fn root(
    undisturbed: Undisturbed,
    pitch: f64,
    equation: impl Fn(f64) -> f64,
) -> Result<f64, RootError> {
    let end = |at: f64| End {
        at,
        residual: equation(at),
    };
    let search = |from: End, to: End| bracketed(&equation, from, to, TOLERANCE);

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
