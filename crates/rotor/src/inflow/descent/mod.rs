//! The air that passes through the disc and takes up momentum, in climb, hover, forward flight and descent.
//!
//! Momentum theory says that a rotor which induces v at the disc pulls with T = 2 rho A v V', V' the speed
//! of the air that passes through it: Glauert's resultant sqrt(V_x^2 + (V_c + v)^2) (1926, ARC R&M 1111).
//! In descent that air meets the wake on its way down, and measured rotors do otherwise. What was
//! measured is the ratio v/v_h against V_c/v_h, v_h^2 = T/(2 rho A); with k = V_c/v it is the same to say
//!
//! ```text
//! V' = v g(k),   g(V_c/v) = (v_h/v)^2,
//! ```
//!
//! |1 + k| in momentum theory. In this form every inflow model can use it, annuli and states included: it
//! is one function of what the model knows, with no state of its own that could chatter. As long as
//! V_c/v_h = k/sqrt(g) grows with k, the thrust grows with v at any V_c, and the inflow is unique.

mod johnson;
mod measured;

use crate::scalar::Scalar;

/// How descent is modelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Descent {
    /// Momentum theory as such.
    Momentum,
    /// A curve through measurements: `measured`.
    #[default]
    Measured,
    /// Johnson's vortex ring model: `johnson`.
    Johnson,
}

/// The air through the disc.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassFlow<S = f64> {
    /// V', m/s.
    pub speed: S,
    /// d(v V')/dv, m/s: how the thrust changes with v (the mass flow of Peters & HaQuang 1988 for slopes).
    pub slope: S,
}

impl Descent {
    /// V' at a flow along the disc (>= 0), a climb and an induced velocity (positive down), m/s.
    ///
    /// A rotor that pulls down is one upside down: only the sign of V_c against v counts.
    pub fn speed<S: Scalar>(self, edgewise: S, climb: S, induced: S) -> S {
        if (climb * induced).value() >= 0.0 {
            return edgewise.hypot(climb + induced);
        }
        match self {
            Self::Momentum => edgewise.hypot(climb + induced),
            Self::Measured => {
                let (gain, _) = measured::gain(climb / induced);
                edgewise.hypot(induced * gain)
            }
            Self::Johnson => johnson::speed(edgewise, -climb.abs(), induced.abs()),
        }
    }

    pub fn mass_flow<S: Scalar>(self, edgewise: S, climb: S, induced: S) -> MassFlow<S> {
        let speed = self.speed(edgewise, climb, induced);
        if speed.value() == 0.0 {
            // Where the rotor induces nothing, the wake that is about to begin; where it brings its own air to
            // rest, v V' has a corner and no slope.
            let slope = match S::direction(climb + induced, edgewise) {
                Some((through, _)) if induced.value() == 0.0 => speed + induced * through,
                _ => S::zero(),
            };
            return MassFlow { speed, slope };
        }
        let is_descent = (climb * induced).value() < 0.0;
        let slope = match self {
            Self::Measured if is_descent => {
                let ratio = climb / induced;
                let (gain, rise) = measured::gain(ratio);
                speed + induced * induced * gain * (gain - ratio * rise) / speed
            }
            Self::Johnson if is_descent => {
                let step = (induced.abs() + climb.abs() + edgewise) * 1e-5;
                let thrust = |v: S| v * self.speed(edgewise, climb, v);
                (thrust(induced + step) - thrust(induced - step)) / (step * 2.0)
            }
            _ => speed + induced * (climb + induced) / speed,
        };
        // Momentum theory in descent can have it negative, where it has no meaning; the wake then carries
        // at least nothing away.
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
    /// Between the vortex ring and the windmill, the air swept along.
    TurbulentWake,
    /// The air passes through the disc with the thrust and drives the rotor.
    WindmillBrake,
}

impl FlowState {
    /// `edgewise` (>= 0), `climb` and mean `induced` velocity, m/s; `thrust`: over rho A, m2/s2.
    ///
    /// In units of v_h: the vortex ring within Johnson's boundary (2005, NASA/TP-2005-213477); below it
    /// the turbulent wake as far as the boundary's lower end reaches, -2 in axial flow; else by the direction of
    /// the air.
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
