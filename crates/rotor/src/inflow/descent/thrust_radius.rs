//! Where along the blades the thrust acts, and what that does to the descent: the stretch s.
//!
//! On Castles & Gray's rotors (1951, NACA TN 2474, Tables I and III) the induced velocity peaks and
//! drops at a rate of descent that goes with 1/rbar, rbar R being the mean radius of the thrust,
//! rbar = int x dT/int dT: a rotor that carries its thrust inboard acts like a smaller one, whose
//! v_h is larger. It is the twist over the loading that counts, not the twist alone. So
//! s = 0.75/rbar, 1 for the thrust that grows linearly towards the tip.
//!
//! The thrust is not known before the inflow, and taking s from it could fold the balance of thrust
//! and momentum. So s comes from the rate of descent alone: the thrust is taken to be that at which
//! the induced velocity drops at this rate, V_d = 1.75 s v_h. Elsewhere s matters little. With
//! v_h = nu Omega R, C_T = 2 nu^2, a net inflow of nu/2 (it falls from nu to about 0 in the drop),
//! linear lift of slope a, local solidity sigma(x) = N c/(pi R), twist theta(x) and the moments
//! C_j = int sigma x^j dx
//!
//! ```text
//! rbar = r0 + (a/4) (n/nu + m/nu^2),   r0 = C_3/C_2,
//! n = (C_1 r0 - C_2)/2,   m = int sigma theta x^2 (x - r0) dx.
//! ```
//!
//! As the rate of descent goes to 0, s goes to 1, so that nothing jumps between climb and descent:
//! blades can meet their own wake in both, one by one.
//!
//! For a constant chord and linear twist theta_1 from the axis to the tip that is
//! 3/4 + (sigma a/4) (1/(48 nu) + theta_1/(80 nu^2)).

use super::measured::smooth_step;
use crate::{
    geometry::{Elements, Geometry},
    numbers::{C, Scalar},
};
use core::f64::consts::PI;

/// V_d/v_h at which the induced velocity drops, for s = 1.
const DROP: f64 = 1.75;

/// Lift slope a, per rad: 5.83 to 6.07 in the report.
const LIFT_SLOPE: f64 = 6.0;

/// rbar of an ideal blade without twist; s is 1 there.
const TRIANGULAR: f64 = 0.75;

/// Limits of rbar. The measured rotors lie between 0.61 and 0.80.
const RADII: (f64, f64) = (0.6, 0.85);

/// Limits of s.
#[cfg(test)]
pub(super) const STRETCHES: (f64, f64) = (TRIANGULAR / RADII.1, TRIANGULAR / RADII.0);

/// Passes of s = 0.75/rbar(nu(s)) from s = 1. On the measured rotors each pass leaves a half of the
/// difference at the most. A fixed number of passes has one answer and no jump for all rotors; the
/// equation itself has several answers for heavily twisted blades at light load.
const PASSES: u32 = 6;

/// V_d/(Omega R) below which s fades to 1. The drop lies there at C_T below 0.0003.
const FADING: f64 = 0.02;

/// Largest 1/nu, so that nothing overflows as the rate of descent goes to 0.
const MAX_INVERSE: f64 = 1e6;

/// The mean radius of the thrust of a rotor as a function of its loading.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThrustRadius {
    /// r0, without inflow and twist.
    bare: f64,
    /// n.
    inflow: f64,
    /// m.
    twist: f64,
}

impl ThrustRadius {
    /// From the shape of the blades.
    pub fn new(geometry: &Geometry, elements: &Elements) -> Self {
        let areas = elements.chord.iter().zip(&elements.radius);
        let solidity = f64::from(geometry.blades) * elements.width / (PI * geometry.radius);
        let weighted = areas.map(|(chord, radius)| {
            let x = radius / geometry.radius;
            (solidity * chord / geometry.radius, x)
        });
        let (mut c1, mut c2, mut c3) = (0.0, 0.0, 0.0);
        for (weight, x) in weighted.clone() {
            c1 += weight * x;
            c2 += weight * x * x;
            c3 += weight * x * x * x;
        }
        let bare = c3 / c2;
        let twist = weighted
            .zip(&elements.twist)
            .map(|((weight, x), twist)| weight * twist * x * x * (x - bare))
            .sum();
        Self {
            bare,
            inflow: 0.5 * (c1 * bare - c2),
            twist,
        }
    }

    /// s at a climb (flow down through the disc, any sign) and a tip speed (>= 0), m/s; 1 in hover.
    ///
    /// A rotor that descends pulls up, and one that climbs and is in its own wake pulls down: there
    /// the twist acts the other way round.
    pub fn stretch<S: Scalar>(&self, climb: S, tip_speed: S) -> S {
        let descent = climb.abs();
        if descent.value() == 0.0 {
            return S::one();
        }
        let twist = if climb.value() < 0.0 {
            self.twist
        } else {
            -self.twist
        };
        let mut stretch = S::one();
        for _ in 0..PASSES {
            let inverse = (C(DROP) * stretch * tip_speed / descent).at_most(MAX_INVERSE);
            let shift = inverse * (inverse * twist + self.inflow);
            let radius = C(self.bare) + C(0.25 * LIFT_SLOPE) * shift;
            stretch = C(TRIANGULAR) / radius.at_least(RADII.0).at_most(RADII.1);
        }
        let fading = (descent / (C(FADING) * tip_speed)).at_most(1.0);
        let (share, _) = smooth_step(fading);
        C(1.0) + (stretch - 1.0) * share
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;
    use crate::numbers::Dual64;

    const TIP_SPEED: f64 = 115.0;

    /// Three blades of constant chord, solidity 0.05, R = 1 m.
    fn rotor(taper: f64, twist: f64) -> ThrustRadius {
        let geometry = Geometry::linear(3, 1.0, 0.01, 0.05 * PI / 3.0, taper, twist);
        ThrustRadius::new(&geometry, &Elements::new(&geometry, 200))
    }

    /// V_d at which a rotor of this v_h/(Omega R) has its drop, and s there, by the equation that
    /// the passes solve.
    fn at_drop(nu: f64, twist: f64) -> (f64, f64) {
        let radius = 0.75 + 0.05 * 6.0 / 4.0 * (1.0 / (48.0 * nu) + twist / (80.0 * nu * nu));
        let stretch = 0.75 / radius;
        (-1.75 * stretch * nu * TIP_SPEED, stretch)
    }

    #[test]
    fn constant_chord_and_linear_twist_have_the_radius_on_paper() {
        for (ct, twist) in [(0.002, 0.0), (0.005, 0.0), (0.005, -0.2094), (0.004, -0.1)] {
            let (climb, expected) = at_drop(f64::sqrt(0.5 * ct), twist);
            let found = rotor(1.0, twist).stretch(climb, TIP_SPEED);
            assert!(
                (found - expected).abs() < 2e-3,
                "{ct} {twist}: {found} {expected}"
            );
        }
        // The twisted rotor at light load converges slowly.
        let (climb, expected) = at_drop(f64::sqrt(0.001), -0.2094);
        let found = rotor(1.0, -0.2094).stretch(climb, TIP_SPEED);
        assert!(
            (found - expected).abs() < 0.02,
            "{found} instead of {expected}"
        );
        assert!(found > 1.2);
    }

    /// As the report's rotors have it: washout and taper move the thrust inboard.
    #[test]
    fn thrust_inboard_stretches() {
        let plain = rotor(1.0, 0.0).stretch(-6.0, TIP_SPEED);
        assert!(rotor(1.0, -0.1).stretch(-6.0, TIP_SPEED) > plain + 0.03);
        assert!(rotor(0.33, 0.0).stretch(-6.0, TIP_SPEED) > plain + 0.03);
        assert!(rotor(1.0, 0.1).stretch(-6.0, TIP_SPEED) < plain - 0.03);
        // Upside down washout is the other way round.
        let down = rotor(1.0, -0.1).stretch(6.0, TIP_SPEED);
        assert_eq!(down, rotor(1.0, 0.1).stretch(-6.0, TIP_SPEED));
        // The reference of the pitch does not matter.
        let mut geometry = Geometry::linear(3, 1.0, 0.01, 0.05, 1.0, -0.2);
        let of = |g: &Geometry| ThrustRadius::new(g, &Elements::new(g, 40)).stretch(-6.0, 115.0);
        let first = of(&geometry);
        geometry.pitch_reference_radius = 0.75;
        assert!((of(&geometry) - first).abs() < 1e-12);
    }

    /// Nothing jumps with twist, taper, rate of descent or tip speed, and s keeps its limits; its
    /// derivative is that of its differences.
    #[test]
    fn the_stretch_is_continuous() {
        for twist in -40..=40 {
            let twist = 0.01 * f64::from(twist);
            for taper in [0.0, 0.5, 1.0, 2.0] {
                let here = rotor(taper, twist);
                for i in 1..60 {
                    let climb = -0.5 * f64::from(i);
                    let s = here.stretch(climb, TIP_SPEED);
                    assert!((STRETCHES.0..=STRETCHES.1).contains(&s));
                    // The passes can steepen s by their number to the most.
                    let near = [
                        rotor(taper, twist + 1e-6).stretch(climb, TIP_SPEED),
                        rotor(taper + 1e-6, twist).stretch(climb, TIP_SPEED),
                        here.stretch(climb * (1.0 + 1e-6), TIP_SPEED),
                    ];
                    for other in near {
                        assert!(
                            (other - s).abs() < 1e-3,
                            "{twist} {taper} {climb}: {s} {other}"
                        );
                    }
                    let dual = here.stretch(Dual64::new(climb, 1.0), Dual64::from_re(TIP_SPEED));
                    let (h, at) = (1e-7, |c: f64| here.stretch(c, TIP_SPEED));
                    let (up, down) = (at(climb + h) - s, s - at(climb - h));
                    // A corner at a limit of rbar has two slopes.
                    let allowed = 1e-3 * (1.0 + dual.eps.abs()) + (up - down).abs() / h;
                    assert!((dual.eps - up / h).abs() < allowed);
                    assert!((dual.re - s).abs() < 1e-12);
                }
            }
        }
    }

    #[test]
    fn all_speeds_have_a_stretch() {
        for twist in [-0.3, 0.0, 0.3] {
            let rotor = rotor(1.0, twist);
            for climb in [0.0, -0.0, -1e-300, 1e-300, -1e-9, -1e300, 50.0] {
                for tip_speed in [0.0, 1e-300, 200.0, 1e300] {
                    let s: f64 = rotor.stretch(climb, tip_speed);
                    assert!(s.is_finite(), "{twist} {climb} {tip_speed}: {s}");
                }
            }
            assert_eq!(rotor.stretch(0.0, 200.0), 1.0);
            for climb in [-1e-3, 1e-3] {
                assert!((rotor.stretch(climb, 200.0) - 1.0).abs() < 1e-6);
            }
        }
    }
}
