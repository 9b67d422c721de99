//! The periodic state: after the time in which each blade comes to where the next one was, its
//! flapping is what that of the next one was, and the inflow is the same. It is found by periodic
//! shooting, as for limit cycles (Seydel 2010, "Practical Bifurcation and Stability
//! Analysis", ch. 7).

use super::{TOLERANCE, balance, unknowns::Unknowns};
use crate::{
    error::SolveError, newton, operating_point::OperatingPoint, rotor::Rotor, scalar::Scalar,
    state::State, workspace::Workspace,
};
use core::f64::consts::PI;
use nalgebra::DVector;

/// Step, rad, that is short enough for the slopes in Newton's method: integration of order 3 leaves
/// them an error of some 1e-4. The state that is found is periodic with the steps of the
/// simulation.
const STEP_FOR_SLOPES: f64 = PI / 12.0;

/// Maximum number of steps in a blade passage. Rotors that need more, because they turn slowly, do
/// not start from a periodic state.
const MAX_STEPS: f64 = 3000.0;

/// Maximum number of steps of the search in all. Successful searches take a tenth.
const MAX_STEPS_IN_ALL: f64 = 20_000.0;

/// Maximum number of steps of a rotor that turns until its motion repeats itself. Flapping that air
/// alone damps takes 3000.
const MAX_STEPS_OF_TURNING: f64 = 10_000.0;

/// Maximum product of a step and the rate of a stop; Heun's method is stable to 2.5 for damped
/// motion.
const MAX_PRODUCT_AT_STOPS: f64 = 2.5;

/// The periodic state, searched from `guess`. For a rotor that is stopped or turns too slowly, it is
/// the balance of blades at rest. Fails if the search finds none.
///
/// If blades that are in balance lie on a stop, the search starts from this balance, and the rotor
/// turns for a while first: a stop damps so strongly that the motion soon repeats itself, whereas
/// the slopes for Newton's method jump where a blade meets a stop. The rotor also turns for a while
/// if Newton's method fails.
pub(super) fn find(
    rotor: &Rotor,
    point: &OperatingPoint,
    guess: State,
    azimuth_step: f64,
    workspace: &mut Workspace,
) -> Result<State, SolveError> {
    let balanced = balance::without_air(rotor, point, &guess);
    let is_on_stop = balance::is_on_stop(rotor, &balanced);
    let guess = if is_on_stop { balanced } else { guess };
    let Some(steps) = steps(rotor, point, &guess, azimuth_step) else {
        return balance::find(rotor, point, &guess, workspace);
    };
    let steps_for_slopes = steps_for_slopes(rotor, point, &guess, azimuth_step).unwrap_or(steps);
    let unknowns = Unknowns::of_periodic_state(rotor, point);
    let passed = |x: &DVector<f64>, steps, workspace: &mut Workspace| {
        let passed = after_passage(rotor, point, &unknowns.state(x), steps, workspace)?;
        Ok(unknowns.of(&passed))
    };
    // The state after so many passages that another one changes nothing, or the last one.
    let turn = |mut x: DVector<f64>, workspace: &mut Workspace| -> Result<_, SolveError> {
        let passages = MAX_STEPS_OF_TURNING / steps;
        for _ in 0..passages as u32 {
            let next = passed(&x, steps, workspace)?;
            let change = (&next - &x).norm();
            x = next;
            if change <= TOLERANCE {
                return Ok((x, true));
            }
        }
        Ok((x, false))
    };
    let mut start = unknowns.of(&guess);
    if is_on_stop {
        let is_found;
        (start, is_found) = turn(start, workspace)?;
        if is_found {
            return Ok(unknowns.state(&start));
        }
    }
    let mut left = MAX_STEPS_IN_ALL;
    let residual = |x: &DVector<f64>, purpose| {
        let steps = match purpose {
            newton::Use::Value => steps,
            newton::Use::Slopes => steps_for_slopes,
        };
        left -= steps;
        if left < 0.0 {
            return Err(SolveError::NoSteadyState);
        }
        Ok(passed(x, steps, workspace)? - x)
    };
    match newton::solve(start.clone(), TOLERANCE, residual) {
        Ok(Some(found)) => return Ok(unknowns.state(&found)),
        Ok(None) | Err(SolveError::NoSteadyState) => {}
        Err(error) => return Err(error),
    }
    match turn(start, workspace)? {
        (found, true) => Ok(unknowns.state(&found)),
        (_, false) => Err(SolveError::NoSteadyState),
    }
}

/// Number of steps in a blade passage for the slopes; none if those of the state will do. Stops need
/// shorter steps than flapping, and the motion of a slow rotor may meet them.
fn steps_for_slopes(
    rotor: &Rotor,
    point: &OperatingPoint,
    state: &State,
    azimuth_step: f64,
) -> Option<f64> {
    let longest = azimuth_step.max(STEP_FOR_SLOPES);
    let rate = rotor.evaluate(point, state).stop_rate();
    if rate * longest / point.speed.abs() > MAX_PRODUCT_AT_STOPS {
        return None;
    }
    steps(rotor, point, state, longest)
}

/// Number of steps in a blade passage, each at most `longest` (rad); none for a rotor that is
/// stopped or turns too slowly.
pub(super) fn steps(
    rotor: &Rotor,
    point: &OperatingPoint,
    state: &State,
    longest: f64,
) -> Option<f64> {
    if point.speed == 0.0 {
        return None;
    }
    let passage = passage(rotor, point);
    let cells = libm::ceil(passage * point.speed / longest * (1.0 - 1e-9)).max(1.0);
    let steps = cells * rotor.stable_steps(point, state, passage / cells);
    (steps <= MAX_STEPS).then_some(steps)
}

/// The state after a blade passage, with the blades renumbered so that it equals `state` if that is
/// periodic.
pub(super) fn after_passage<S: Scalar>(
    rotor: &Rotor,
    point: &OperatingPoint<S>,
    state: &State<S>,
    steps: f64,
    workspace: &mut Workspace<S>,
) -> Result<State<S>, SolveError> {
    let step = passage(rotor, point) / steps;
    let mut state = *state;
    for _ in 0..steps as u32 {
        state = rotor.step(|_| *point, &state, step, workspace)?;
    }
    if let flaps @ [_, ..] = &mut state.flaps[..rotor.flapping_blades()] {
        flaps.rotate_right(1);
    }
    Ok(state)
}

/// Blade passage: the time in which a blade comes to where the next one was, s; negative for a
/// rotor that turns backwards.
fn passage<S: Scalar>(rotor: &Rotor, point: &OperatingPoint<S>) -> S {
    S::constant(2.0 * PI) / (point.speed * f64::from(rotor.geometry().blades))
}
