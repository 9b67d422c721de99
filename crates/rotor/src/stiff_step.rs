//! A step in time of a rotor whose blades flap much faster than it turns: stiff springs, light
//! blades.
//!
//! The rates of each blade's flapping are split into a linear part, A (beta, beta'), and the rest.
//! The linear part is integrated exactly, so that its speed does not limit the step: the
//! exponential Heun method of order 3 (Hochbruck & Ostermann 2005, SIAM J. Numer. Anal. 43, p.
//! 1069: the methods of three stages with c_3 = 2/3, here with c_2 = 1/3). With F the rates, D_i =
//! F(U_i) - F(y) - A (U_i - y) and phi as in the module of that name:
//!
//! ```text
//! U_2 = y + h/3 phi_1(h/3 A) F(y)
//! U_3 = y + 2h/3 phi_1(2h/3 A) F(y) + 4h/3 phi_2(2h/3 A) D_2
//! y_1 = y + h phi_1(h A) F(y) + 3h/2 phi_2(h A) D_3
//! ```
//!
//! The method of order 2 that has 3 h phi_2(h A) D_2 for the last term uses the same rates. Its
//! difference, h phi_2(h A) (3/2 D_3 - 3 D_2), estimates the error of the step: it is 0 where the
//! rest changes evenly, and large where lift jumps or blades hit stops. With t for h in front of
//! and within phi, and t/h times the last term, y_1 is the state within the step, of the same order
//! in h.
//!
//! Where A = 0, as for the other states, this is the method of `step`. A holds the slopes of each
//! blade's acceleration at the beginning of the step, from differences in which all blades move at
//! once. Its accuracy affects the error of the method, but not its order.

use super::{
    disc::Flap,
    error::SolveError,
    operating_point::OperatingPoint,
    phi::phi,
    rotor::Rotor,
    state::{MAX_FLAPPING_BLADES, State},
    workspace::Workspace,
};
use nalgebra::{Matrix2, Vector2};

/// Difference of the flap angles for the slopes, rad; of the flap rates, times the rotor speed.
const DIFFERENCE: f64 = 1e-6;

/// Largest estimated error of a step in the flap angles, rad; in the flap rates, times the rotor
/// speed (at least 1 rad/s).
const TOLERANCE: f64 = 1e-6;

/// A of each blade.
type Slopes = [Matrix2<f64>; MAX_FLAPPING_BLADES];

/// (beta, beta') of each blade, or their changes.
type Flapping = [Vector2<f64>; MAX_FLAPPING_BLADES];

/// A step of stiff blades.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StiffStep {
    /// The state at its end.
    pub end: State,
    motion: Motion,
    /// D_3 of each blade.
    rest: Flapping,
    duration: f64,
}

/// The linear part of the motion of stiff blades.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Motion {
    blades: usize,
    start: State,
    /// F(y).
    first: State,
    slopes: Slopes,
}

impl Motion {
    /// Replaces the flapping of `state` by that after a time, s, with `factor` phi_2 times `rest`.
    fn replace(&self, state: &mut State, time: f64, factor: f64, rest: &Flapping) {
        for (k, rest) in rest.iter().enumerate().take(self.blades) {
            let phi = phi(&(self.slopes[k] * time));
            let linear = phi.first * vector(&self.first.flaps[k]) * time;
            let last = phi.second * rest * factor;
            let flap = vector(&self.start.flaps[k]) + linear + last;
            state.flaps[k] = Flap {
                angle: flap.x,
                rate: flap.y,
            };
        }
    }

    /// `factor` phi_2 after a time, s, times `rest`, of each blade.
    fn last_term(&self, time: f64, factor: f64, rest: &Flapping) -> Flapping {
        let mut last = [Vector2::zeros(); MAX_FLAPPING_BLADES];
        for (k, last) in last.iter_mut().enumerate().take(self.blades) {
            *last = phi(&(self.slopes[k] * time)).second * rest[k] * factor;
        }
        last
    }

    /// D of each blade at a state with these rates.
    fn rest(&self, rates: &State, at: &State) -> Flapping {
        core::array::from_fn(|k| {
            let moved = vector(&at.flaps[k]) - vector(&self.start.flaps[k]);
            vector(&rates.flaps[k]) - vector(&self.first.flaps[k]) - self.slopes[k] * moved
        })
    }
}

impl StiffStep {
    /// Replaces the flapping of `state` by that within the step, `time` s after its beginning.
    pub fn replace_flapping(&self, state: &mut State, time: f64) {
        let factor = 1.5 * time * time / self.duration;
        self.motion.replace(state, time, factor, &self.rest);
    }
}

impl Rotor {
    /// Like `step_from`, for blades that flap too fast for it. Inflow, stops and rotor speed still
    /// limit the step. None if the flapping would not be accurate enough; take shorter steps.
    pub fn stiff_step_from(
        &self,
        first: &State,
        mut point_at: impl FnMut(f64) -> OperatingPoint,
        state: &State,
        duration: f64,
        workspace: &mut Workspace,
    ) -> Result<Option<StiffStep>, SolveError> {
        let point = point_at(0.0);
        let motion = Motion {
            blades: self.flapping_blades(),
            start: *state,
            first: *first,
            slopes: self.flapping_slopes(first, &point, state, workspace)?,
        };
        match self.stiff_stages(motion, &mut point_at, duration, workspace) {
            Err(SolveError::TooMuchWork(limit)) => Err(SolveError::TooMuchWork(limit)),
            // Within too long a step the motion may lead to where no rates exist.
            Err(_) => Ok(None),
            Ok((step, error)) => {
                let speed = point.at_speed_of(state).speed.abs().max(1.0);
                let is_accurate = error
                    .iter()
                    .all(|e| e.x.abs() <= TOLERANCE && e.y.abs() <= TOLERANCE * speed);
                Ok(is_accurate.then_some(step))
            }
        }
    }

    /// The step, and the estimated error of each blade's flapping.
    fn stiff_stages(
        &self,
        motion: Motion,
        point_at: &mut impl FnMut(f64) -> OperatingPoint,
        duration: f64,
        workspace: &mut Workspace,
    ) -> Result<(StiffStep, Flapping), SolveError> {
        let Motion { start, first, .. } = &motion;
        let (third, two_thirds) = (duration / 3.0, duration * 2.0 / 3.0);
        let none = [Vector2::zeros(); MAX_FLAPPING_BLADES];
        let mut at_third = start.plus(third, first);
        motion.replace(&mut at_third, third, 0.0, &none);
        let second = self.rates(&point_at(third), &at_third, workspace)?;
        let rest_2 = motion.rest(&second, &at_third);
        let mut at_two_thirds = start.plus(two_thirds, &second);
        motion.replace(
            &mut at_two_thirds,
            two_thirds,
            duration * 4.0 / 3.0,
            &rest_2,
        );
        let last = self.rates(&point_at(two_thirds), &at_two_thirds, workspace)?;
        let rest = motion.rest(&last, &at_two_thirds);
        let mut end = start.plus(duration * 0.25, first);
        end = end.plus(duration * 0.75, &last);
        motion.replace(&mut end, duration, duration * 1.5, &rest);
        let uneven = core::array::from_fn(|k| rest[k] * 1.5 - rest_2[k] * 3.0);
        let error = motion.last_term(duration, duration, &uneven);
        let step = StiffStep {
            end,
            motion,
            rest,
            duration,
        };
        Ok((step, error))
    }

    /// A of each blade at the beginning of a step.
    fn flapping_slopes(
        &self,
        first: &State,
        point: &OperatingPoint,
        state: &State,
        workspace: &mut Workspace,
    ) -> Result<Slopes, SolveError> {
        let blades = self.flapping_blades();
        let per_rate = DIFFERENCE * point.at_speed_of(state).speed.abs().max(1.0);
        let mut moved = *state;
        // The blades of a seesaw move against each other.
        let is_seesaw = self.models().seesaw.is_some();
        let sign = |k: usize| if is_seesaw && k == 1 { -1.0 } else { 1.0 };
        for (k, flap) in moved.flaps[..blades].iter_mut().enumerate() {
            flap.angle += sign(k) * DIFFERENCE;
        }
        let by_angle = self.rates(point, &moved, workspace)?;
        moved.flaps = state.flaps;
        for (k, flap) in moved.flaps[..blades].iter_mut().enumerate() {
            flap.rate += sign(k) * per_rate;
        }
        let by_rate = self.rates(point, &moved, workspace)?;
        Ok(core::array::from_fn(|k| {
            let acceleration =
                |rates: &State| sign(k) * (rates.flaps[k].rate - first.flaps[k].rate);
            Matrix2::new(
                0.0,
                1.0,
                acceleration(&by_angle) / DIFFERENCE,
                acceleration(&by_rate) / per_rate,
            )
        }))
    }
}

fn vector(flap: &Flap) -> Vector2<f64> {
    Vector2::new(flap.angle, flap.rate)
}
