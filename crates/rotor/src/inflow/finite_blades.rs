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
    disc::{BladeFlow, DiscFlow, SectionFlow},
    element::Element,
    geometry::Block,
    induced::Induced,
    numbers::{Lanes, Mask, Portable, Scalar},
    root::RootError,
};
use core::f64::consts::PI;

/// The velocity that one blade's elements of a block induce, in the lanes that every processor has.
#[inline(never)]
pub(super) fn search<S: Scalar>(
    disc: &Disc<S>,
    block: &Block,
    blade: &BladeFlow<S>,
) -> Result<AnnulusInflow<S::In<Portable>>, RootError> {
    let element = disc.blade.block::<S::In<Portable>>(block);
    let section = blade.at_section(element.radius);
    solve(&element, &section, disc.flow, &disc.momentum)
}

/// The velocity that a blade's elements induce.
///
/// `flow` gives the rotor speed and the edgewise speed. Fails only if numbers are not finite.
pub fn solve<L: Lanes>(
    element: &Element<L>,
    section: &SectionFlow<L>,
    flow: &DiscFlow<L::One>,
    momentum: &Momentum<L::One>,
) -> Result<AnnulusInflow<L>, RootError> {
    let edgewise = L::splat(flow.edgewise);
    let scale = (section.in_plane.length(section.through) + edgewise).values();
    let is_still = scale.is_negligible(0.0);
    if is_still.all() {
        return Ok(AnnulusInflow::zero());
    }
    let pitch = element.pitch + section.pitch;
    let forward = {
        let is_reversed = section.in_plane.values().is_below(0.0);
        L::select(is_reversed, L::constant(-1.0), L::unit())
    };
    let strength = forward.times(element.chord)
        * L::splat(flow.rotation.abs())
        * (element.blades / (4.0 * PI));
    // v reduced by the ground, and the flow at the section with it: component through and speed.
    let flow_with = |v: L| {
        let axial = momentum
            .at_the_annuli(flow.edgewise, Induced::axial(v))
            .axial;
        let through = section.through + section.flap_cos * axial;
        (axial, through, section.in_plane.length(through))
    };
    // As in the annuli, the wake leaves with the air that takes up momentum.
    let factor = |v: L, through: L, speed: L| {
        let is_plain = momentum.is_plain(section.through, v);
        let mut sine = through / speed;
        if !is_plain.all() {
            let induced = through - section.through;
            let in_descent = momentum.wake_sine_in_descent(section.through, induced, speed);
            sine = L::select(is_plain, sine, in_descent);
        }
        element.tip_loss_factor(sine)
    };
    let thrust = |v: L| {
        element.count_work();
        let (_, through, speed) = flow_with(v);
        let alpha = pitch - through.atan2(section.in_plane);
        let lift = element.lift_coefficient(alpha, speed);
        let thrust = strength * speed * lift * section.flap_cos / factor(v, through, speed);
        L::select(speed.values().is_negligible(0.0), L::nil(), thrust)
    };
    let mass_flow = |v: L| {
        element
            .work
            .count(momentum.descent.work_of(edgewise, section.through, v));
        momentum.descent.speeds(edgewise, section.through, v)
    };
    let scale = L::Real::select(is_still, L::Real::unit(), scale);
    let v = uniform::mean_velocity(mass_flow, section.through, scale, thrust)?;
    let (axial, through, speed) = flow_with(v);
    let share = L::select(
        speed.values().is_negligible(0.0),
        L::unit(),
        factor(v, through, speed),
    );
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

    /// The sections are computed a few times for each solution, and each time is counted once.
    #[test]
    fn work_is_counted_where_sections_are_computed() {
        let airfoil = airfoil();
        let element = element(&airfoil, 0.1, 0.15);
        let flow = DiscFlow {
            rotation: 100.0,
            speed: 100.0,
            ..DiscFlow::default()
        };
        let section = SectionFlow {
            pitch: 0.0,
            in_plane: 80.0,
            through: 0.0,
            flap_sin: 0.0,
            flap_cos: 1.0,
            outboard: 0.8,
            out: 0.8,
            up: 0.0,
        };
        let momentum = Momentum {
            descent: Descent::Measured.unstretched(),
            ground: Ground::default(),
        };
        solve(&element, &section, &flow, &momentum).unwrap();
        let done = element.work.done();
        assert!((2..=8).contains(&done), "{done}");
    }
}
