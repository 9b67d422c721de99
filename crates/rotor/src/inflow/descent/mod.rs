//! The air that passes through the disc and takes up momentum, in climb, hover, forward flight and
//! descent.
//!
//! Momentum theory says that a rotor which induces v at the disc has the thrust T = 2 rho A v V',
//! where V' is the speed of the air that passes through the disc: Glauert's resultant sqrt(V_x^2 +
//! (V_c + v)^2) (1926, ARC R&M 1111). In descent that air meets the wake on its way down, and
//! measured rotors depart from the theory. Measured is the ratio v/v_h against V_c/v_h, v_h^2 =
//! T/(2 rho A). With k = V_c/v the same is
//!
//! ```text
//! V' = v g(k),   g(V_c/v) = (v_h/v)^2,
//! ```
//!
//! and g = |1 + k| in momentum theory. In this form every inflow model can use the measurements,
//! annuli and inflow states included: V' is a function of V_x, V_c and v alone, without a discrete
//! flow state that could switch to and fro. As long as V_c/v_h = k/sqrt(g) grows with k, the thrust
//! grows with v at any V_c, and the inflow is unique.

mod johnson;
mod measured;
mod thrust_radius;

pub use thrust_radius::ThrustRadius;

use crate::numbers::{C, Lanes, Mask, Scalar};

/// The model of the mass flow in descent.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Descent {
    /// Momentum theory, in descent too.
    Momentum,
    /// A curve through the measurements of Castles & Gray 1951, NACA TN 2474, stretched to where
    /// the rotor carries its thrust.
    #[default]
    Measured,
    /// Johnson's vortex ring model: 2005, NASA/TP-2005-213477.
    Johnson,
}

/// The mass flow in descent of a rotor at an operating point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DescentLaw<S = f64> {
    /// The model.
    pub model: Descent,
    /// s, by which the rotor stretches the peak and the drop of [`Descent::Measured`]. The other
    /// models take no notice.
    pub stretch: S,
}

/// The air that takes up the momentum of the thrust.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassFlow<S = f64> {
    /// V', m/s.
    pub speed: S,
    /// d(v V')/dv, >= 0, m/s: how the thrust changes with v. It carries the slopes of the inflow in
    /// Peters & HaQuang 1988 (J. Am. Helicopter Soc. 33(4), p. 64).
    pub slope: S,
}

impl Descent {
    /// The law for a rotor whose thrust acts at this mean radius.
    ///
    /// * `climb`: flow down through the disc, any sign, m/s
    /// * `tip_speed`: >= 0, m/s
    pub fn of_rotor<S: Scalar>(
        self,
        thrust_radius: &ThrustRadius,
        climb: S,
        tip_speed: S,
    ) -> DescentLaw<S> {
        match self {
            Self::Momentum | Self::Johnson => self.unstretched(),
            Self::Measured => DescentLaw {
                model: self,
                stretch: thrust_radius.stretch(climb, tip_speed),
            },
        }
    }

    /// The law for s = 1.
    pub fn unstretched<S: Scalar>(self) -> DescentLaw<S> {
        DescentLaw {
            model: self,
            stretch: S::one(),
        }
    }
}

impl<S: Scalar> DescentLaw<S> {
    /// V', m/s.
    ///
    /// A rotor with thrust downwards is a rotor upside down: only the sign of V_c relative to v
    /// matters.
    ///
    /// * `edgewise`: edgewise flow V_x, >= 0, m/s
    /// * `climb`: flow down through the disc V_c, any sign, m/s
    /// * `induced`: v, positive down, m/s
    pub fn speed(&self, edgewise: S, climb: S, induced: S) -> S {
        let is_descent = (climb * induced).value() < 0.0;
        let momentum = || edgewise.hypot(climb + induced);
        match self.model {
            Descent::Momentum => momentum(),
            Descent::Measured if is_descent => {
                let (gain, _) = measured::gain(climb / induced, self.stretch);
                edgewise.hypot(induced * gain)
            }
            Descent::Johnson if is_descent => johnson::speed(edgewise, -climb.abs(), induced.abs()),
            Descent::Measured | Descent::Johnson => momentum(),
        }
    }

    /// V' in each lane.
    pub(crate) fn speeds<L: Lanes<One = S>>(&self, edgewise: L, climb: L, induced: L) -> L {
        let is_descent = (climb * induced).values().is_below(0.0);
        match self.model {
            Descent::Measured | Descent::Johnson if is_descent.any() => L::from_lanes(|lane| {
                self.speed(edgewise.lane(lane), climb.lane(lane), induced.lane(lane))
            }),
            Descent::Momentum | Descent::Measured | Descent::Johnson => {
                edgewise.length(climb + induced)
            }
        }
    }

    /// How many computations of a section's loads cost as much as one of V', at the flows that
    /// [`DescentLaw::speed`] takes. Measured: at most 4,900 instructions in axial flow and 21,500
    /// elsewhere, for 530 of a section in the lanes of every processor.
    fn work(&self, edgewise: S, climb: S, induced: S) -> u64 {
        match self.model {
            Descent::Momentum | Descent::Measured => 0,
            // V' is the root of a piecewise cubic, and momentum theory has no closed form beside
            // the axis.
            Descent::Johnson if (climb * induced).value() < 0.0 => {
                if edgewise.value() == 0.0 {
                    10
                } else {
                    40
                }
            }
            Descent::Johnson => 0,
        }
    }

    /// The same for all lanes.
    pub(crate) fn work_of<L: Lanes<One = S>>(&self, edgewise: L, climb: L, induced: L) -> u64 {
        (0..L::COUNT)
            .map(|lane| self.work(edgewise.lane(lane), climb.lane(lane), induced.lane(lane)))
            .sum()
    }

    /// V' and its slope, at the flows that [`DescentLaw::speed`] takes.
    pub fn mass_flow(&self, edgewise: S, climb: S, induced: S) -> MassFlow<S> {
        let speed = self.speed(edgewise, climb, induced);
        if speed.value() == 0.0 {
            // A rotor that induces nothing has the slope of the wake that is about to begin. Where
            // its induced velocity brings the air to rest, v V' has a corner and no slope.
            let slope = match S::direction(climb + induced, edgewise) {
                Some((through, _)) if induced.value() == 0.0 => speed + induced * through,
                Some(_) | None => S::zero(),
            };
            return MassFlow { speed, slope };
        }
        let is_descent = (climb * induced).value() < 0.0;
        let momentum = || speed + induced * (climb + induced) / speed;
        let slope = match self.model {
            Descent::Momentum => momentum(),
            Descent::Measured if is_descent => {
                let ratio = climb / induced;
                let (gain, rise) = measured::gain(ratio, self.stretch);
                speed + induced * induced * gain * (gain - ratio * rise) / speed
            }
            Descent::Johnson if is_descent => {
                let step = C(1e-5) * (induced.abs() + climb.abs() + edgewise);
                let thrust = |v: S| v * self.speed(edgewise, climb, v);
                (thrust(induced + step) - thrust(induced - step)) / (C(2.0) * step)
            }
            Descent::Measured | Descent::Johnson => momentum(),
        };
        // In descent momentum theory can give a negative slope. It has no physical meaning: at the
        // least the wake carries no momentum away.
        MassFlow {
            speed,
            slope: slope.at_least(0.0),
        }
    }
}

/// The state of the flow through a rotor (Leishman 2006, section 2.13).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum FlowState {
    /// The air passes through the disc away from the thrust.
    #[default]
    Normal,
    /// Inside the boundary of Johnson's unstable region.
    VortexRing,
    /// Between the vortex ring and the windmill brake state.
    TurbulentWake,
    /// The air passes through the disc with the thrust and drives the rotor.
    WindmillBrake,
}

impl FlowState {
    /// The flow state by Johnson's boundary (2005, NASA/TP-2005-213477): inside the boundary it is
    /// the vortex ring, below it the turbulent wake, down to the end of the model (V_c/v_h = -2 in
    /// axial flow), and below that the windmill brake. In fast edgewise flow, where there is no
    /// boundary, the direction of the air through the disc decides.
    ///
    /// * `edgewise`: edgewise flow, >= 0, m/s
    /// * `climb`: flow down through the disc, m/s
    /// * `induced`: mean induced velocity, positive down, m/s
    /// * `thrust`: T/(rho A), m2/s2
    pub fn of(edgewise: f64, climb: f64, induced: f64, thrust: f64) -> Self {
        let side = if thrust < 0.0 { -1.0 } else { 1.0 };
        let hover = libm::sqrt(thrust.abs() / 2.0);
        let (along, up) = (edgewise / hover, side * climb / hover);
        if hover > 0.0
            && let Some(boundary) = johnson::Boundary::at(along)
        {
            if up > boundary.upper {
                return Self::Normal;
            }
            if up > boundary.lower {
                return Self::VortexRing;
            }
            if up > boundary.end {
                return Self::TurbulentWake;
            }
            return Self::WindmillBrake;
        }
        if side * (climb + induced) < 0.0 {
            Self::WindmillBrake
        } else {
            Self::Normal
        }
    }
}
