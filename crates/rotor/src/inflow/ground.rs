//! Ground effect: the ground holds back the wake, so that the induced velocity at the blades is
//! less than the same thrust induces far from the ground.
//!
//! Published is the gain of thrust at the same power, or the loss of power at the same thrust. In
//! hover P = T v k and T = 2 rho A v^2, where k is the part of the induced velocity that is left.
//! Hence thrust at the same power grows by k^(-2/3), and power at the same thrust falls by k.
//!
//! * Cheeseman & Bennett 1955, ARC R&M 3021: T/T_far = 1/(1 - G),
//!   G = (R/(4 z))^2/(1 + (V_x/v)^2), at the same power, so k = (1 - G)^(3/2).
//! * Hayden 1976, 32nd AHS Forum: P/P_far = 1/(0.9926 + 0.0379 (2 R/z)^2) at the same thrust, from
//!   flight tests in hover. Ours: it fades with forward speed as Cheeseman & Bennett's does.
//!
//! Ours: only a wake that meets the ground is held back. z is the distance along the shaft to the
//! ground, the height divided by the cosine of the shaft's angle from the vertical; a wake that
//! blows along the ground or away from it feels nothing.
//!
//! Ours: heights below R/2 count as R/2. Neither model was tried there, and Cheeseman & Bennett's
//! would become infinite. From z = 2 R to 3 R both fade out.

use crate::numbers::{C, Scalar};

/// The model of ground effect.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum GroundEffect {
    /// No ground.
    #[default]
    None,
    /// Cheeseman & Bennett 1955.
    CheesemanBennett,
    /// Hayden 1976.
    Hayden,
}

/// The rotor near the ground.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ground<S = f64> {
    /// The model.
    pub effect: GroundEffect,
    /// Height of the hub above the ground over the rotor radius, z/R, >= 0.
    pub height_ratio: S,
    /// Cosine of the angle between the shaft and the vertical, negative for an inverted rotor.
    pub upright: S,
}

/// z/R below which the effect stays the same.
const MIN_HEIGHT: f64 = 0.5;

/// z/R at which the effect begins to fade out with height, and at which it is gone.
const FADING: (f64, f64) = (2.0, 3.0);

impl<S: Scalar> Default for Ground<S> {
    /// No ground.
    fn default() -> Self {
        Self {
            effect: GroundEffect::None,
            height_ratio: S::zero(),
            upright: S::one(),
        }
    }
}

impl<S: Scalar> Ground<S> {
    /// Whether the ground has no effect.
    pub fn is_far(&self) -> bool {
        match self.effect {
            GroundEffect::None => true,
            GroundEffect::CheesemanBennett | GroundEffect::Hayden => {
                self.height_ratio.value() >= FADING.1
            }
        }
    }

    /// k, 0 to 1: the part of the induced velocity that is left.
    ///
    /// * `edgewise`: edgewise flow, >= 0, m/s
    /// * `induced`: mean induced velocity far from the ground, any sign, m/s
    pub fn factor(&self, edgewise: S, induced: S) -> S {
        if self.is_far() {
            return S::one();
        }
        let upwards = if induced.is_below(0.0) { -1.0 } else { 1.0 };
        let towards_ground = self.upright * upwards;
        if towards_ground.value() <= self.height_ratio.value() / FADING.1 {
            return S::one();
        }
        let height = (self.height_ratio / towards_ground).at_least(MIN_HEIGHT);
        let t = ((height - FADING.0) / (FADING.1 - FADING.0))
            .at_least(0.0)
            .at_most(1.0);
        let left = C(1.0) - t * t * (C(3.0) - C(2.0) * t);
        let (along, down) = (edgewise * edgewise, induced * induced);
        let slow = if along.is_negligible(0.0) {
            S::one()
        } else {
            down / (down + along)
        };
        match self.effect {
            GroundEffect::None => S::one(),
            GroundEffect::CheesemanBennett => {
                let thrust = C(1.0) - left * slow / (C(16.0) * height * height);
                thrust * thrust.sqrt()
            }
            GroundEffect::Hayden => {
                let power = C(1.0) / (C(0.9926) + C(0.0379 * 4.0) / (height * height));
                C(1.0) - left * slow * (C(1.0) - power)
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;

    fn at(effect: GroundEffect, height_ratio: f64) -> Ground {
        Ground {
            effect,
            height_ratio,
            upright: 1.0,
        }
    }

    /// By hand at z = R: 1/(1 - 1/16) = 1.0667 in thrust; 1/(0.9926 + 0.1516) = 0.8740 in power.
    #[test]
    fn published_values_at_one_radius() {
        let k = at(GroundEffect::CheesemanBennett, 1.0).factor(0.0, 5.0);
        assert!((k.powf(-2.0 / 3.0) - 16.0 / 15.0).abs() < 1e-12);
        // At V_x = v the ground counts half.
        let k = at(GroundEffect::CheesemanBennett, 1.0).factor(5.0, 5.0);
        assert!((k.powf(-2.0 / 3.0) - 32.0 / 31.0).abs() < 1e-12);
        let k = at(GroundEffect::Hayden, 1.0).factor(0.0, 5.0);
        assert!((k - 1.0 / 1.1442).abs() < 1e-12);
    }

    /// By hand at 60 deg and z = R/2: the wake travels R to the ground.
    #[test]
    fn only_a_wake_that_meets_the_ground_is_held_back() {
        for effect in [GroundEffect::CheesemanBennett, GroundEffect::Hayden] {
            let factor = |upright: f64, height: f64, induced: f64| {
                let ground = Ground {
                    upright,
                    ..at(effect, height)
                };
                ground.factor(0.0, induced)
            };
            assert_eq!(factor(0.5, 0.5, 5.0), factor(1.0, 1.0, 5.0));
            assert_eq!(factor(-0.5, 0.5, -5.0), factor(1.0, 1.0, 5.0), "inverted");
            for (upright, induced) in [(0.0, 5.0), (0.0, -5.0), (-1.0, 5.0), (1.0, -5.0)] {
                assert_eq!(factor(upright, 0.6, induced), 1.0, "{upright} {induced}");
            }
            let mut previous = factor(1.0, 0.6, 5.0);
            for degrees in 1..=180 {
                let next = factor(f64::from(degrees).to_radians().cos(), 0.6, 5.0);
                assert!(next >= previous && next - previous < 0.02, "{degrees}");
                previous = next;
            }
        }
    }

    #[test]
    fn the_effect_grows_towards_the_ground_fades_with_speed_and_is_gone_above_3_radii() {
        for effect in [GroundEffect::CheesemanBennett, GroundEffect::Hayden] {
            let mut previous = 1.0;
            for i in (0..=350).rev() {
                let ground = at(effect, 0.01 * f64::from(i));
                let k = ground.factor(0.0, 5.0);
                assert!(k > 0.5 && k <= previous, "{effect:?} {i}: {k} {previous}");
                assert!((previous - k).abs() < 0.02, "no jump");
                previous = k;
                let mut slower = k;
                for speed in [1.0, 5.0, 20.0, 200.0] {
                    let faster = ground.factor(speed, 5.0);
                    assert!(faster >= slower && faster <= 1.0);
                    slower = faster;
                }
                assert_eq!(i >= 300, ground.is_far());
            }
            assert_eq!(at(effect, 3.0).factor(0.0, 5.0), 1.0);
            assert!(at(effect, 0.0).factor(0.0, 0.0).is_finite());
        }
        assert_eq!(at(GroundEffect::None, 0.5).factor(0.0, 5.0), 1.0);
    }
}
