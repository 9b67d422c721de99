//! The periodic state: after the time in which each blade comes to where the next one was, its
//! flapping is what that of the next one was, and the inflow is the same. It is found by periodic
//! shooting, as for limit cycles (Seydel 2010, "Practical Bifurcation and Stability
//! Analysis", ch. 7).

use super::{TOLERANCE, unknowns::Unknowns};
use crate::{
    error::SolveError, inflow::Number, newton, numbers::Scalar, operating_point::OperatingPoint,
    rotor::Rotor, state::State, workspace::Workspace,
};
use core::f64::consts::PI;
use nalgebra::DVector;

/// Step, rad, that is short enough for the slopes in Newton's method: integration of order 3 leaves
/// them an error of some 1e-4. The state that is found is periodic with the steps of the
/// simulation.
const STEP_FOR_SLOPES: f64 = PI / 12.0;

/// Maximum number of steps in a blade passage. Rotors that need more, because they turn slowly or
/// have stiff blades, start from the motion of `collocation`.
const MAX_STEPS: f64 = 300.0;

/// Maximum number of steps of the search in all, from a motion that `collocation` has found, and
/// where it has found none. Successful searches take a third.
const MAX_STEPS_IN_ALL: [f64; 2] = [3000.0, 1000.0];

/// Blade passages at the azimuth step that come to these.
const PASSAGES: f64 = 10.0;

/// Computations of the loads for one where the end of the lift depends on the thrust.
const LOADS_FOR_THRUST: f64 = 10.0;

/// Maximum number of steps of a rotor that turns until its motion repeats itself. Flapping that air
/// alone damps takes 3000.
const MAX_STEPS_OF_TURNING: f64 = 3000.0;

/// The periodic state, searched from `guess`; none if the search fails, or if a blade passage takes
/// too many steps. `is_motion`: whether the guess is a motion that `collocation` has found.
pub(super) fn find(
    rotor: &Rotor,
    point: &OperatingPoint,
    guess: State,
    is_motion: bool,
    azimuth_step: f64,
    workspace: &mut Workspace,
) -> Option<State> {
    let count = |longest: f64| steps(rotor, point, &guess, longest);
    let steps = count(azimuth_step)?;
    // Stiff blades, which need many more steps than the azimuth, need as many for their slopes.
    let coarse = cells(rotor, point, azimuth_step.max(STEP_FOR_SLOPES));
    let steps_for_slopes = match count(azimuth_step.max(STEP_FOR_SLOPES)) {
        Some(few) if few <= 4.0 * coarse => few,
        Some(_) | None => steps,
    };
    let unknowns = Unknowns::of_periodic_state(rotor, point);
    let passages = PASSAGES * cells(rotor, point, azimuth_step);
    let mut left = (MAX_STEPS_IN_ALL[usize::from(!is_motion)] + passages) / cost(rotor);
    let residual = |x: &DVector<f64>, purpose| -> Result<DVector<f64>, SolveError> {
        let steps = match purpose {
            newton::Use::Value => steps,
            newton::Use::Slopes => steps_for_slopes,
        };
        left -= steps;
        if left < 0.0 {
            return Err(SolveError::NoSteadyState);
        }
        let passed = after_passage(rotor, point, &unknowns.state(x), steps, workspace)?;
        Ok(unknowns.of(&passed) - x)
    };
    let found = newton::solve(unknowns.of(&guess), TOLERANCE, residual);
    Some(unknowns.state(&found.ok()??))
}

/// The periodic state that the rotor reaches by turning from `guess`; none if it does not repeat
/// itself in time, or if a blade passage takes too many steps.
///
/// Where blades meet stops, the slopes for Newton's method jump. The stops damp the motion so
/// strongly that it soon repeats itself.
pub(super) fn turn(
    rotor: &Rotor,
    point: &OperatingPoint,
    guess: State,
    azimuth_step: f64,
    workspace: &mut Workspace,
) -> Option<State> {
    let steps = steps(rotor, point, &guess, azimuth_step)?;
    let unknowns = Unknowns::of_periodic_state(rotor, point);
    let mut x = unknowns.of(&guess);
    for _ in 0..(MAX_STEPS_OF_TURNING / cost(rotor) / steps) as u32 {
        let passed = after_passage(rotor, point, &unknowns.state(&x), steps, workspace).ok()?;
        let next = unknowns.of(&passed);
        let change = (&next - &x).norm();
        x = next;
        if change <= TOLERANCE {
            return Some(unknowns.state(&x));
        }
    }
    None
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
    let cells = cells(rotor, point, longest);
    let steps = cells
        * rotor
            .division(point, state, passage(rotor, point) / cells)
            .plain;
    // A fine azimuth step is the user's choice.
    (steps <= MAX_STEPS.max(2.0 * cells)).then_some(steps)
}

/// Number of steps in a blade passage, each at most `longest` (rad), by azimuth alone.
fn cells(rotor: &Rotor, point: &OperatingPoint, longest: f64) -> f64 {
    let turn = passage(rotor, point) * point.speed;
    libm::ceil(turn / longest * (1.0 - 1e-9)).max(1.0)
}

/// Computations of the loads in a stage of a step.
fn cost(rotor: &Rotor) -> f64 {
    let blades = f64::from(rotor.geometry().blades);
    match rotor.models().tip_loss.end_at_thrust(blades, 0.0) {
        Some(_) => LOADS_FOR_THRUST,
        None => 1.0,
    }
}

/// The state after a blade passage, with the blades renumbered so that it equals `state` if that is
/// periodic.
pub(super) fn after_passage<S: Number>(
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
