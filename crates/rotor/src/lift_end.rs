//! The aerodynamic loads of the disc, with the radius at which the lift ends where it depends on
//! the thrust.

use super::{
    error::SolveError,
    evaluation::Evaluation,
    inflow::{DiscLoads, Number},
    loads,
    root::{End, bracketed},
    rotor::end_lift_at,
    sweep::Wanted,
    workspace::Workspace,
};
use core::f64::consts::PI;

/// Tolerance of the thrust coefficient on which the end of the lift depends.
const THRUST_TOLERANCE: f64 = 1e-13;

/// The aerodynamic loads of the disc, with the lift ending where the tip loss model says. The loads
/// of the elements are written to the workspace, if they are wanted.
pub(crate) fn disc_loads<S: Number>(
    evaluation: &Evaluation<S>,
    workspace: &mut Workspace<S>,
    wanted: Wanted,
) -> Result<DiscLoads<S>, SolveError> {
    workspace.prepare(evaluation.rotor);
    let rotor = evaluation.rotor;
    let point = &evaluation.point;
    let tip_loss = rotor.models().tip_loss;
    let blades = f64::from(rotor.geometry().blades);
    if tip_loss.end_at_thrust(blades, S::zero()).is_none() {
        return loads::of_all_elements(evaluation, workspace, wanted);
    }
    let mut loads_at = |coefficient: S| {
        let end = tip_loss.end_at_thrust(blades, coefficient);
        let end = end.unwrap_or(S::one());
        let shares = &mut workspace.lifting_shares;
        end_lift_at(end, rotor.geometry(), rotor.elements(), shares);
        loads::of_all_elements(evaluation, workspace, wanted)
    };
    // More thrust ends the lift further inboard, which reduces the thrust: there is one solution.
    // The published coefficient is over the tip speed alone. Here the airspeed is added to it, so
    // that the coefficient of a slow or stopped rotor stays finite.
    let radius = rotor.geometry().radius;
    let tip_speed = point.speed * radius;
    let air = &point.airspeed;
    let square = tip_speed * tip_speed + (air.x * air.x + air.y * air.y + air.z * air.z);
    let reference = point.air.density * PI * radius * radius * square;
    let mut failure = None;
    let mut surplus = |coefficient: S| match loads_at(coefficient) {
        Ok(loads) if reference.value() > 0.0 => loads.force.z.abs() / reference - coefficient,
        Ok(_) => -coefficient,
        Err(error) => {
            failure = Some(error);
            S::constant(f64::NAN)
        }
    };
    let mut plain = |at: f64| surplus(S::constant(at)).value();
    let mut end = |at: f64| End {
        at,
        residual: plain(at),
    };
    // The thrust is largest if no lift is lost, at CT = 0. At CT = N^2 no lift is left.
    let first = end(0.0);
    let mut last = end(first.residual.clamp(0.0, blades * blades));
    if last.residual > 0.0 {
        last = end(blades * blades);
    }
    let solved = if first.residual <= 0.0 {
        Ok(S::zero())
    } else if last.residual >= 0.0 {
        Ok(S::constant(blades * blades)) // even without lift the thrust is larger: drag
    } else {
        bracketed(plain, first, last, THRUST_TOLERANCE)
            .map(|coefficient| S::at_root(coefficient, surplus))
    };
    match (failure, solved) {
        (Some(error), _) => Err(error),
        (None, Err(cause)) => Err(SolveError::LiftEnd(cause)),
        (None, Ok(coefficient)) => loads_at(coefficient),
    }
}
