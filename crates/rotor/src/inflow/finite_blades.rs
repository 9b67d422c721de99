//! Momentum theory for each blade by itself: Dahl 2015 after Knight & Hefner 1937 (NACA TN 626);
//! thesis section 3.3.1.
//!
//! A blade takes the time T_rev = 2 pi/(N Omega) to where the next one was. In this time its
//! element of width l sweeps an area l U_T T_rev, through which air passes at V + v, and gains
//! twice v. So the lift L of the element is L = 2 rho l U_T T_rev (V + v) v. The thesis' formula is
//! its root
//!
//! ```text
//! v = (-l rho T_rev U_T V + sqrt(2 l rho T_rev U_T L + (l rho T_rev U_T V)^2))/(2 l rho T_rev U_T)
//! ```
//!
//! (its L and signs are lost in the copy at hand). There L is the lift without v; here it is the
//! lift in v, which makes the equation implicit. V is U_P, the flow through the disc at the blade
//! without v; each blade has its own. With L = 1/2 rho W c cl U_T (the component of the lift along
//! the shaft, U_T = W cos phi) U_T cancels, so that the edge of the reversed flow is no special
//! case. With Prandtl's F and either direction of v
//!
//! ```text
//! 2 v |U_P + v| = N Omega c W cl sign(U_T)/(4 pi F).
//! ```
//!
//! In hover this is the annulus' momentum balance without swirl. The source says nothing of
//! edgewise flow V_x. Here |U_P + v| becomes Glauert's resultant sqrt(V_x^2 + (U_P + v)^2) (1926,
//! ARC R&M 1111), as in the other models, and in descent the mass flow of `descent`; without the
//! resultant the inflow would stay that of hover at any speed. A stopped rotor induces nothing.

use super::{Disc, Momentum, annulus::AnnulusInflow, uniform};
use crate::{
    disc::{DiscFlow, SectionFlow},
    element::Element,
    induced::Induced,
    root::RootError,
    scalar::Scalar,
    sweep::{InducedAt, Sweep},
};
use core::{cell::Cell, f64::consts::PI};

/// See `ElementInflow::load`.
pub(super) fn load<S: Scalar>(
    disc: &Disc<S>,
    element: &Element<S>,
    sweep: &mut Sweep<S>,
) -> Result<S, RootError> {
    let mean = Cell::new(S::zero());
    sweep.load_in(InducedAt::Blade, |_, position| {
        let section = disc.flow.at_section(element.radius, position);
        let inflow = solve(element, &section, disc.flow, &disc.momentum)?;
        mean.set(mean.get() + inflow.mean_axial / disc.positions.len() as f64);
        Ok(inflow.induced)
    })?;
    Ok(mean.get())
}

/// The velocity that a blade's element induces.
///
/// `flow` gives the rotor speed and the edgewise speed. Fails only if numbers are not finite.
pub fn solve<S: Scalar>(
    element: &Element<S>,
    section: &SectionFlow<S>,
    flow: &DiscFlow<S>,
    momentum: &Momentum<S>,
) -> Result<AnnulusInflow<S>, RootError> {
    let scale = (section.in_plane.hypot(section.through) + flow.edgewise).value();
    if scale == 0.0 {
        return Ok(AnnulusInflow::zero());
    }
    let pitch = element.pitch + section.pitch;
    let forward = if section.in_plane.value() < 0.0 {
        -1.0
    } else {
        1.0
    };
    let strength = flow.rotation.abs() * element.blades * element.chord * forward / (4.0 * PI);
    // v reduced by the ground, and the flow at the section with it: component through and speed.
    let flow_with = |v: S| {
        let axial = momentum
            .at_the_blades(flow.edgewise, v, Induced::axial(v))
            .axial;
        let through = section.through + section.flap_cos * axial;
        (axial, through, section.in_plane.hypot(through))
    };
    // As in the annuli, the wake leaves with the air that takes up momentum.
    let factor = |v: S, through: S, speed: S| {
        let sine = if momentum.is_plain(section.through, v) {
            through / speed
        } else {
            momentum.wake_sine_in_descent(section.through, through - section.through, speed)
        };
        element.tip_loss_factor(sine)
    };
    let thrust = |v: S| {
        let (_, through, speed) = flow_with(v);
        if speed.value() == 0.0 {
            return S::zero();
        }
        let alpha = pitch - through.atan2(section.in_plane);
        let lift = element.lift_coefficient(alpha, speed);
        strength * speed * lift * section.flap_cos / factor(v, through, speed)
    };
    let mass_flow = |v: S| {
        let momentum_work = momentum.descent.work(section.through, v);
        element.work.count(1 + momentum_work);
        momentum.descent.speed(flow.edgewise, section.through, v)
    };
    let v = uniform::mean_velocity(mass_flow, section.through, scale, thrust)?;
    let (axial, through, speed) = flow_with(v);
    let share = if speed.value() == 0.0 {
        S::one()
    } else {
        factor(v, through, speed)
    };
    Ok(AnnulusInflow {
        induced: Induced::axial(axial),
        mean_axial: share * axial,
        ..AnnulusInflow::zero()
    })
}

#[cfg(test)]
mod tests {
    use super::{
        super::{
            Descent, Ground,
            annulus::tests::{airfoil, element},
        },
        *,
    };

    /// The flow through a blade that is turned up changes its sign while the blade flaps. Neither
    /// the momentum nor Prandtl's F jumps there.
    #[test]
    fn nothing_jumps_where_the_flow_through_a_flapped_blade_changes_its_sign() {
        let airfoil = airfoil();
        let element = element(&airfoil, 0.1, 0.15);
        let (flap_sin, flap_cos) = (0.3, libm::sqrt(1.0 - 0.09));
        let flow = DiscFlow {
            rotation: 100.0,
            speed: 100.0,
            ..DiscFlow::default()
        };
        let at = |through: f64| {
            let section = SectionFlow {
                pitch: 0.0,
                in_plane: 80.0,
                through,
                flap_sin,
                flap_cos,
                outboard: 0.8,
                out: 0.8 * flap_cos,
                up: 0.8 * flap_sin,
            };
            let momentum = Momentum {
                descent: Descent::Measured.unstretched(),
                ground: Ground::default(),
            };
            solve(&element, &section, &flow, &momentum).unwrap()
        };
        let (up, down) = (at(-1e-9), at(1e-9));
        assert!(up.induced.axial > 1.0);
        assert!((up.induced.axial - down.induced.axial).abs() < 1e-7);
        assert!((up.mean_axial - down.mean_axial).abs() < 1e-7);
    }
}
