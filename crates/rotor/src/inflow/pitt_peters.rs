//! Dynamic inflow with three states: Pitt & Peters 1981 (Vertica 5, p. 21), with the mass flow of
//! Peters & HaQuang 1988 (J. Am. Helicopter Soc. 33(4), p. 64).
//!
//! The induced velocity v = v0 + x (vc cos psi + vs sin psi), x = r/R, psi from downwind, follows
//! the loading of the disc F = (T, integral of x cos psi dT, integral of x sin psi dT) by
//!
//! ```text
//! R M dv/dt + V L^-1 v = F/(rho A),   M = diag(8/(3 pi), 16/(45 pi), 16/(45 pi))
//!
//!     | 1/2          -15 pi X/64    0          |
//! L = | 15 pi X/64    2 (1 - X^2)   0          |     X = tan(chi/2)
//!     | 0             0             2 (1 + X^2)|
//! ```
//!
//! in the order (v0, vc, vs), with the skew chi of the wake and V = diag(VT, Vm, Vm), where
//! VT = sqrt(mu^2 + lambda^2) and Vm = (mu^2 + (lambda + lambda_i) lambda)/VT =
//! d(lambda_i VT)/d lambda_i; in descent, `descent` gives both. It is the usual form multiplied by
//! (Omega R)^2, so that a stopped rotor is no special case. The steady state without moments is
//! momentum theory, T = 2 rho A VT v0, with kx = 15 pi/32 tan(chi/2).
//!
//! Sign of the coupling. Load at the rear has its wake behind the disc and lowers the mean inflow;
//! load at the front raises it. So the off-diagonal terms have opposite signs. With equal signs L
//! would be singular at chi = 77.7 deg.

use super::{
    InflowStates, MAX_STATES,
    descent::MassFlow,
    dynamic::{DiscLoading, Stream},
};
use crate::{
    induced::Field,
    numbers::{C, Scalar},
};
use core::f64::consts::PI;

/// The loading of the disc over rho A, m2/s2.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Loading<S = f64> {
    /// T/(rho A).
    pub thrust: S,
    /// Integral of x cos psi dT.
    pub cosine: S,
    /// Integral of x sin psi dT.
    pub sine: S,
}

impl<S: Scalar> Loading<S> {
    /// From the loads of a disc of radius R, m.
    pub fn of(disc: &DiscLoading<S>, radius: f64) -> Self {
        Self {
            thrust: disc.thrust / disc.density_area,
            cosine: disc.moment_y / (disc.density_area * radius),
            sine: -disc.moment_x / (disc.density_area * radius),
        }
    }
}

/// Number of states: mean, cosine and sine.
pub const STATES: usize = 3;

/// A field as the first three inflow states.
pub fn to_states<S: Scalar>(field: &Field<S>) -> InflowStates<S> {
    let mut states = [S::zero(); MAX_STATES];
    states[..STATES].copy_from_slice(&field.to_array());
    states
}

const APPARENT_MASS: f64 = 8.0 / (3.0 * PI);
const APPARENT_INERTIA: f64 = 16.0 / (45.0 * PI);

/// The entries of V L^-1 that are not zero, m/s.
struct Gains<S> {
    mean: S,
    mean_by_cosine: S,
    cosine: S,
    cosine_by_mean: S,
    sine: S,
}

fn gains<S: Scalar>(stream: &Stream<S>, induced: S) -> Gains<S> {
    let MassFlow {
        speed: total,
        slope: slopes,
    } = stream.mass_flow(induced);
    if total.is_negligible(0.0) {
        return Gains {
            mean: S::zero(),
            mean_by_cosine: S::zero(),
            cosine: S::zero(),
            cosine_by_mean: S::zero(),
            sine: S::zero(),
        };
    }
    let skew = stream.skew(induced);
    let coupling = C(15.0 * PI / 64.0) * skew;
    let (a, d) = (0.5, C(2.0) * (C(1.0) - skew * skew));
    let determinant = d * a + coupling * coupling;
    Gains {
        mean: total * d / determinant,
        mean_by_cosine: total * coupling / determinant,
        cosine: slopes * a / determinant,
        cosine_by_mean: -slopes * coupling / determinant,
        sine: slopes / (C(2.0) * (C(1.0) + skew * skew)),
    }
}

/// dv/dt, m/s2.
pub fn rate<S: Scalar>(stream: &Stream<S>, field: &Field<S>, loading: &Loading<S>) -> Field<S> {
    let gains = gains(stream, field.mean);
    let mean = gains.mean * field.mean + gains.mean_by_cosine * field.cosine;
    let cosine = gains.cosine * field.cosine + gains.cosine_by_mean * field.mean;
    let sine = gains.sine * field.sine;
    Field {
        mean: (loading.thrust - mean) / (APPARENT_MASS * stream.radius),
        cosine: (loading.cosine - cosine) / (APPARENT_INERTIA * stream.radius),
        sine: (loading.sine - sine) / (APPARENT_INERTIA * stream.radius),
    }
}

/// An estimate of how fast the states move towards their equilibrium, 1/s, for steps in time: what
/// the wake carries away plus the damping by the blades with a lift slope of 2 pi. `solidity` is N
/// c/(pi R), `tip_speed` in m/s.
pub fn fastest_rate(stream: &Stream, induced: f64, solidity: f64, tip_speed: f64) -> f64 {
    let gains = gains(stream, induced);
    // The mass flow changes with the mean, too, which counts where it nearly vanishes.
    let mean = 2.0 * gains.mean + 2.0 * induced.abs();
    let wake = mean / APPARENT_MASS + (gains.cosine + gains.sine) / APPARENT_INERTIA;
    let speed = tip_speed + stream.edgewise;
    let blades = solidity * 2.0 * PI * speed * (0.25 / APPARENT_MASS + 0.125 / APPARENT_INERTIA);
    (wake + blades) / stream.radius
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;
    use crate::inflow::Descent;
    use crate::numbers::Dual64;

    fn stream(edgewise: f64, climb: f64, radius: f64) -> Stream {
        Stream {
            edgewise,
            climb,
            radius,
            descent: Descent::Momentum.unstretched(),
        }
    }

    /// In hover v0 = T/(2 v0), and the slopes are 2/V of the moments, V = 2 v0: the published gains
    /// at chi = 0.
    #[test]
    fn steady_gains_in_hover() {
        let field = Field {
            mean: 3.0,
            cosine: 0.4,
            sine: -0.2,
        };
        let loading = Loading {
            thrust: 2.0 * 9.0,
            cosine: 6.0 * 0.4 / 2.0,
            sine: -6.0 * 0.2 / 2.0,
        };
        let rate = rate(&stream(0.0, 0.0, 1.5), &field, &loading);
        for part in rate.to_array() {
            assert!(part.abs() < 1e-13, "{rate:?}");
        }
    }

    /// Without moments the steady slope is 15 pi/32 tan(chi/2) of the mean, and the thrust is that
    /// of momentum theory.
    #[test]
    fn steady_slope_in_forward_flight_is_that_of_the_static_model() {
        for edgewise in [1.0, 5.0, 40.0] {
            let (climb, mean): (f64, f64) = (-1.0, 1.7);
            let total = edgewise_total(edgewise, climb + mean);
            let half_tangent = ((edgewise / (climb + mean)).atan() / 2.0).tan();
            let cosine = 15.0 * PI / 32.0 * half_tangent * mean;
            let field = Field {
                mean,
                cosine,
                sine: 0.0,
            };
            let loading = Loading {
                thrust: 2.0 * total * mean,
                ..Loading::default()
            };
            let rate = rate(&stream(edgewise, climb, 1.0), &field, &loading);
            for part in rate.to_array() {
                assert!(part.abs() < 1e-10, "{edgewise}: {rate:?}");
            }
        }
    }

    fn edgewise_total(edgewise: f64, through: f64) -> f64 {
        (edgewise * edgewise + through * through).sqrt()
    }

    /// Small changes of the mean in hover decay with the time constant R 8/(3 pi)/(4 v0): the
    /// apparent mass of a disc over the slope of 2 v^2.
    #[test]
    fn time_constant_of_the_mean_in_hover() {
        let (v0, radius, small) = (4.0, 2.0, 1e-6);
        let loading = Loading {
            thrust: 2.0 * v0 * v0,
            ..Loading::default()
        };
        let rate = |mean| {
            let field = Field {
                mean,
                ..Field::default()
            };
            rate(&stream(0.0, 0.0, radius), &field, &loading).mean
        };
        let constant = -2.0 * small / (rate(v0 + small) - rate(v0 - small));
        let expected = radius * 8.0 / (3.0 * PI) / (4.0 * v0);
        assert!(
            (constant / expected - 1.0).abs() < 1e-6,
            "{constant} {expected}"
        );
    }

    /// In still air a wake that begins carries a slope away by V L^-1 = |dv|, to either side.
    #[test]
    fn a_wake_that_begins_takes_the_slopes_with_it() {
        let still = Dual64::from_re(0.0);
        let stream = Stream {
            edgewise: still,
            climb: still,
            radius: 2.0,
            descent: Descent::Measured.unstretched(),
        };
        let loading = Loading {
            thrust: still,
            cosine: still,
            sine: still,
        };
        for change in [1.5, -1.5] {
            let field = Field {
                mean: Dual64::new(0.0, change),
                cosine: Dual64::from_re(0.4),
                sine: still,
            };
            let rate = rate(&stream, &field, &loading).cosine;
            let expected = -1.5 * 0.4 / (APPARENT_INERTIA * 2.0);
            assert_eq!(rate.re, 0.0);
            assert!((rate.eps / expected - 1.0).abs() < 1e-12, "{rate:?}");
        }
    }
}
