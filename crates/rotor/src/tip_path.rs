//! The tip path: the cone of the blades.

use super::{
    disc::{Flap, OfPositions},
    evaluation::Evaluation,
    inflow::DiscLoads,
    numbers::{C, Scalar},
};
use core::f64::consts::PI;

/// Tilt of the tip path, rad, up to which one or two blades define a cone. From twice this on they
/// define none.
const MAX_LEAN: f64 = 1.0;

/// Frequency of a blade that swings as a pendulum, over the rotor speed, up to which one or two
/// blades define a cone. From twice this on they define none.
const MAX_PENDULUM: f64 = 1.0;

/// The cone of the blades: beta = coning - longitudinal cos psi - lateral sin psi, psi from the
/// tail, rad.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TipPath<S = f64> {
    /// a0.
    pub coning: S,
    /// a1: positive tips the path back.
    pub longitudinal: S,
    /// b1: positive lowers the side at psi = 90 deg.
    pub lateral: S,
}

impl<S: Scalar> TipPath<S> {
    /// The cone of the blades in the hub frame.
    ///
    /// From three blades on, the mean of the flap angles and twice their means with cos psi and sin
    /// psi (the multiblade coordinates, Johnson 1980, ch. 8.4). One or two flap angles do not
    /// define a cone: for each, beta = a0 - a1 cos psi - b1 sin psi with its first two derivatives
    /// does, and the mean over the blades is taken. A blade that moves too fast for that, or a
    /// rotor so slow that weight moves its blades more than the rotation does, defines no cone. The
    /// flap angle then counts as coning; Hermite's weight leads from one to the other.
    pub(crate) fn new(evaluation: &Evaluation<S>, loads: &DiscLoads<S>) -> Self {
        let hinge = &evaluation.rotor.models().hinge;
        let mut path = Self {
            coning: S::constant(hinge.precone),
            longitudinal: S::zero(),
            lateral: S::zero(),
        };
        if evaluation.freedom.is_none() {
            return path;
        }
        path.coning = S::zero();
        let count = evaluation.positions.len() as f64;
        let speed = evaluation.point.speed;
        // Where they are needed.
        let accelerations = if count > 2.0 {
            OfPositions::new()
        } else {
            evaluation.flap_accelerations(&loads.hinge_moments)
        };
        for (k, position) in evaluation.positions.iter().enumerate() {
            let psi = evaluation.state.azimuth + 2.0 * PI * k as f64 / count;
            let (sin, cos) = (psi.sin(), psi.cos());
            let Flap { angle, rate } = position.flap;
            let (coning, longitudinal, lateral) = if count > 2.0 {
                (angle, angle * -2.0 * cos, angle * -2.0 * sin)
            } else {
                let second = accelerations[k] / (speed * speed);
                let first = rate / speed;
                let pendulum = C(hinge.pendulum_frequency()) / speed.abs();
                let is_cone = defined(first.hypot(second), MAX_LEAN, Some(S::one()));
                match defined(pendulum, MAX_PENDULUM, is_cone) {
                    Some(weight) => (
                        angle + second * weight,
                        (second * cos + first * sin) * weight,
                        (second * sin - first * cos) * weight,
                    ),
                    None => (angle, S::zero(), S::zero()),
                }
            };
            path.coning += coning / count;
            path.longitudinal += longitudinal / count;
            path.lateral += lateral / count;
        }
        path
    }
}

/// `weight` times Hermite's weight, which falls from 1 where `x` is at most `limit` to 0 where it
/// is twice that. None for 0: derivatives there are infinite or not a number at standstill.
fn defined<S: Scalar>(x: S, limit: f64, weight: Option<S>) -> Option<S> {
    if x.value() <= limit {
        weight
    } else if x.value() < 2.0 * limit {
        let t = x / limit - 1.0;
        Some(weight? * (C(1.0) - t * t * (C(3.0) - C(2.0) * t)))
    } else {
        None
    }
}
