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
//! The last term is what the method of order 2 of the same family leaves out, the exponential
//! Rosenbrock-Euler method (same article), so that it bounds the error of the step: where lift
//! jumps or blades hit stops, steps must be shorter.
//!
//! Where A is 0, as for the other states, it is the method of `step`. A are the slopes at the
//! beginning of the step, by differences of all blades at once: the order does not depend on their
//! accuracy.

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

/// Difference of the flap angles for the slopes, rad; of the flap rates, per rotor speed.
const DIFFERENCE: f64 = 1e-6;

/// Largest error of a step in the flap angles, rad; in the flap rates, per rotor speed.
const TOLERANCE: f64 = 1e-6;

/// A of each blade.
type Slopes = [Matrix2<f64>; MAX_FLAPPING_BLADES];

/// (beta, beta') of each blade, or their changes.
type Flapping = [Vector2<f64>; MAX_FLAPPING_BLADES];

impl Rotor {
    /// As `step_from`, for blades that flap too fast for it; inflow, stops and rotor speed limit
    /// the step. None if the flapping after the step were not accurate: shorter steps are needed.
    pub fn stiff_step_from(
        &self,
        first: &State,
        mut point_at: impl FnMut(f64) -> OperatingPoint,
        state: &State,
        duration: f64,
        workspace: &mut Workspace,
    ) -> Result<Option<State>, SolveError> {
        let stages = self.stiff_stages(first, &mut point_at, state, duration, workspace);
        match stages {
            Err(SolveError::TooMuchWork(limit)) => Err(SolveError::TooMuchWork(limit)),
            // Within too long a step the motion may lead to where no rates exist.
            Err(_) => Ok(None),
            Ok((next, error)) => {
                let speed = point_at(0.0).at_speed_of(state).speed.abs().max(1.0);
                let blades = &error[..self.flapping_blades()];
                let is_accurate = blades
                    .iter()
                    .all(|e| e.x.abs() <= TOLERANCE && e.y.abs() <= TOLERANCE * speed);
                Ok(is_accurate.then_some(next))
            }
        }
    }

    /// The state after the step, and for each blade the last term of its flapping.
    fn stiff_stages(
        &self,
        first: &State,
        point_at: &mut impl FnMut(f64) -> OperatingPoint,
        state: &State,
        duration: f64,
        workspace: &mut Workspace,
    ) -> Result<(State, Flapping), SolveError> {
        let slopes = self.flapping_slopes(first, &point_at(0.0), state, workspace)?;
        // D of each blade.
        let rest = |rates: &State, at: &State| -> Flapping {
            core::array::from_fn(|k| {
                let moved = vector(&at.flaps[k]) - vector(&state.flaps[k]);
                vector(&rates.flaps[k]) - vector(&first.flaps[k]) - slopes[k] * moved
            })
        };
        // Replaces the flapping of `plain` by that after a time with the part of D, and returns
        // that part.
        let replace = |plain: &mut State, time: f64, factor: f64, rest: &Flapping| -> Flapping {
            let mut parts = [Vector2::zeros(); MAX_FLAPPING_BLADES];
            for k in 0..self.flapping_blades() {
                let phi = phi(&(slopes[k] * time));
                parts[k] = phi.second * rest[k] * (factor * time);
                let linear = phi.first * vector(&first.flaps[k]) * time;
                let flap = vector(&state.flaps[k]) + linear + parts[k];
                plain.flaps[k] = Flap {
                    angle: flap.x,
                    rate: flap.y,
                };
            }
            parts
        };
        let (third, two_thirds) = (duration / 3.0, duration * 2.0 / 3.0);
        let none = [Vector2::zeros(); MAX_FLAPPING_BLADES];
        let mut at_third = state.plus(third, first);
        replace(&mut at_third, third, 0.0, &none);
        let second = self.rates(&point_at(third), &at_third, workspace)?;
        let mut at_two_thirds = state.plus(two_thirds, &second);
        replace(
            &mut at_two_thirds,
            two_thirds,
            2.0,
            &rest(&second, &at_third),
        );
        let last = self.rates(&point_at(two_thirds), &at_two_thirds, workspace)?;
        let mut next = state.plus(duration * 0.25, first);
        next = next.plus(duration * 0.75, &last);
        let error = replace(&mut next, duration, 1.5, &rest(&last, &at_two_thirds));
        Ok((next, error))
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
        for flap in &mut moved.flaps[..blades] {
            flap.angle += DIFFERENCE;
        }
        let by_angle = self.rates(point, &moved, workspace)?;
        moved.flaps = state.flaps;
        for flap in &mut moved.flaps[..blades] {
            flap.rate += per_rate;
        }
        let by_rate = self.rates(point, &moved, workspace)?;
        Ok(core::array::from_fn(|k| {
            let acceleration = |rates: &State| rates.flaps[k].rate - first.flaps[k].rate;
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
