//! Linear distributions of the induced velocity over the disc:
//! v = v0 (1 + x (kx cos psi + ky sin psi)), x = r/R, psi from downwind. The coefficients are those
//! collected in Leishman 2006, "Principles of Helicopter Aerodynamics", table 3.1; thesis table 5.

use crate::numbers::{C, Scalar};
use core::f64::consts::{PI, SQRT_2};

/// How the induced velocity varies over the disc with the skew of the wake.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Skew {
    /// No variation: Glauert 1926, ARC R&M 1111.
    Uniform,
    /// Coleman, Feingold & Stempin 1945, NACA WR L-126: kx = tan(chi/2).
    Coleman,
    /// Drees 1949, J. Helicopter Assoc. Gt. Britain 3(2):
    /// kx = 4/3 (1 - cos chi - 1.8 mu^2)/sin chi, ky = -2 mu.
    Drees,
    /// Payne 1959, "Helicopter Dynamics and Aerodynamics": kx = 4/3 (mu/lambda)/(1.2 + mu/lambda).
    Payne,
    /// White & Blake 1979, 35th AHS Forum: kx = sqrt(2) sin chi.
    WhiteBlake,
    /// Pitt & Peters 1981, Vertica 5, p. 21: kx = 15 pi/32 tan(chi/2).
    PittPeters,
    /// Howlett 1981, NASA CR-166309: kx = sin^2 chi.
    Howlett,
    /// Glauert 1926, ARC R&M 1111, for mu > 0.1: kx = 1.2. Ours is kx = 1.2 sin chi. At such speeds
    /// sin chi is about 1; in hover the disc has no rear towards which the inflow could grow.
    GlauertHighSpeed,
}

/// Resultant flow at the disc over tip speed above which Drees' terms in mu stay constant. He
/// fitted them to the advance ratios of helicopters; a slow rotor in wind can have any advance
/// ratio.
const MAX_FLOW: f64 = 0.5;

/// The distribution's coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coefficients<S = f64> {
    /// Growth towards psi = 0 from the shaft to the tip, as a part of the mean.
    pub kx: S,
    /// The same towards psi = 90 deg.
    pub ky: S,
}

impl<S: Scalar> Coefficients<S> {
    /// No variation.
    pub fn zero() -> Self {
        let (kx, ky) = (S::zero(), S::zero());
        Self { kx, ky }
    }

    /// `factor * self`.
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            kx: self.kx * factor,
            ky: self.ky * factor,
        }
    }
}

/// The flow that skews the wake, in any unit of speed.
pub struct SkewedWake<S> {
    /// Edgewise, >= 0.
    pub along: S,
    /// Away from the disc, >= 0.
    pub down: S,
    /// The resultant of the two, > 0.
    pub flow: S,
}

impl<S: Scalar> SkewedWake<S> {
    /// From the edgewise flow (>= 0) and the flow through the disc (any sign), m/s. In still air it
    /// is the direction of the flow that is about to begin, or none if the air stays still.
    pub fn new(edgewise: S, through: S) -> Option<Self> {
        let flow = edgewise.hypot(through);
        if flow.value() != 0.0 {
            return Some(Self {
                along: edgewise,
                down: through.abs(),
                flow,
            });
        }
        S::direction(edgewise, through).map(|(along, down)| Self {
            along,
            down: down.abs(),
            flow: S::one(),
        })
    }
}

impl Skew {
    /// All distributions.
    pub const ALL: [Self; 8] = [
        Self::Uniform,
        Self::Coleman,
        Self::Drees,
        Self::Payne,
        Self::WhiteBlake,
        Self::PittPeters,
        Self::Howlett,
        Self::GlauertHighSpeed,
    ];

    /// Coefficients of the distribution.
    ///
    /// The wake's skew angle is chi = atan(edgewise/|through|): a wake that leaves upwards is
    /// skewed like one that leaves downwards. With h = sqrt(edgewise^2 + through^2) the formulae
    /// need only sin chi = edgewise/h and tan(chi/2) = edgewise/(h + |through|). These divide by
    /// zero in still air alone, where all coefficients are 0.
    ///
    /// * `edgewise`: edgewise flow, >= 0, m/s
    /// * `through`: flow through the disc with the induced velocity, any sign, m/s
    /// * `tip_speed`: >= 0, m/s
    pub fn coefficients<S: Scalar>(self, edgewise: S, through: S, tip_speed: S) -> Coefficients<S> {
        let Some(SkewedWake { along, down, flow }) = SkewedWake::new(edgewise, through) else {
            return Coefficients::zero();
        };
        let sin = along / flow;
        let half_tangent = along / (flow + down);
        let mut ky = S::zero();
        let kx = match self {
            Self::Uniform => S::zero(),
            Self::Coleman => half_tangent,
            // (1 - cos chi)/sin chi = tan(chi/2), and mu/sin chi = h/tip speed.
            Self::Drees => {
                let flow = edgewise.hypot(through);
                let (mu, total) = if (C(MAX_FLOW) * tip_speed).value() > flow.value() {
                    (edgewise / tip_speed, flow / tip_speed)
                } else {
                    (C(MAX_FLOW) * sin, S::constant(MAX_FLOW))
                };
                ky = C(-2.0) * mu;
                C(4.0 / 3.0) * (half_tangent - C(1.8) * mu * total)
            }
            Self::Payne => C(4.0 / 3.0) * along / (C(1.2) * down + along),
            Self::WhiteBlake => C(SQRT_2) * sin,
            Self::PittPeters => C(15.0 * PI / 32.0) * half_tangent,
            Self::Howlett => sin * sin,
            Self::GlauertHighSpeed => C(1.2) * sin,
        };
        Coefficients { kx, ky }
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;

    /// Leishman's table 3.1, evaluated by hand at chi = 30, 60 and 80 deg with lambda = 0.05.
    #[test]
    fn coefficients_match_the_published_table_at_three_skew_angles() {
        for degrees in [30.0_f64, 60.0, 80.0] {
            let chi = degrees.to_radians();
            let lambda = 0.05;
            let mu = lambda * chi.tan();
            let ratio = mu / lambda;
            let expected = |skew: Skew| match skew {
                Skew::Uniform => (0.0, 0.0),
                Skew::Coleman => ((chi / 2.0).tan(), 0.0),
                Skew::Drees => (
                    4.0 / 3.0 * (1.0 - chi.cos() - 1.8 * mu * mu) / chi.sin(),
                    -2.0 * mu,
                ),
                Skew::Payne => (4.0 / 3.0 * ratio / (1.2 + ratio), 0.0),
                Skew::WhiteBlake => (SQRT_2 * chi.sin(), 0.0),
                Skew::PittPeters => (15.0 * PI / 32.0 * (chi / 2.0).tan(), 0.0),
                Skew::Howlett => (chi.sin().powi(2), 0.0),
                Skew::GlauertHighSpeed => (1.2 * chi.sin(), 0.0),
            };
            for skew in Skew::ALL {
                let (kx, ky) = expected(skew);
                for lambda in [lambda, -lambda] {
                    let found = skew.coefficients(100.0 * mu, 100.0 * lambda, 100.0);
                    assert!(
                        (found.kx - kx).abs() < 1e-13,
                        "{skew:?} at {degrees}: {found:?}"
                    );
                    assert!(
                        (found.ky - ky).abs() < 1e-13,
                        "{skew:?} at {degrees}: {found:?}"
                    );
                }
            }
        }
        // Two numbers by hand: tan(30 deg) and sqrt(2) sin(60 deg).
        let mu = 0.05 * 3.0_f64.sqrt();
        assert!((Skew::Coleman.coefficients(mu, 0.05, 1.0).kx - 0.577_350_269).abs() < 1e-9);
        assert!((Skew::WhiteBlake.coefficients(mu, 0.05, 1.0).kx - 1.224_744_871).abs() < 1e-9);
    }

    /// Also of a rotor at rest, in wind from any side.
    #[test]
    fn no_flow_makes_a_distribution_of_another_size_than_the_mean() {
        for skew in Skew::ALL {
            for (edgewise, through) in [(1e-9, 10.0), (10.0, 1e-9), (10.0, 10.0), (1e-9, 1e-9)] {
                for tip_speed in [0.0, 1e-9, 1.0, 100.0] {
                    let Coefficients { kx, ky } = skew.coefficients(edgewise, through, tip_speed);
                    let size = kx.abs().max(ky.abs());
                    assert!(
                        size < 1.5,
                        "{skew:?} {edgewise} {through} {tip_speed}: {kx} {ky}"
                    );
                }
            }
        }
    }

    #[test]
    fn axial_flow_has_no_skew() {
        for skew in [
            Skew::Coleman,
            Skew::Drees,
            Skew::Payne,
            Skew::PittPeters,
            Skew::Howlett,
            Skew::GlauertHighSpeed,
        ] {
            assert_eq!(skew.coefficients(0.0, 0.05, 1.0).kx, 0.0);
            assert_eq!(skew.coefficients(0.0, 0.0, 1.0).kx, 0.0);
        }
    }
}
