//! Where the lift of the blades ends, for the tip losses that end it.

use super::{
    Operation, Rotor, SolveError, State,
    loads::Sums,
    root::{End, bracketed},
    scene::Scene,
    tip_loss::lifting_share,
};
use core::f64::consts::PI;

/// To which the thrust coefficient is found on which the end of the lift depends.
const THRUST_TOLERANCE: f64 = 1e-13;

impl Rotor {
    /// The loads in a state, with the lift ending where the tip loss says.
    pub(super) fn fly(
        &mut self,
        scene: &Scene,
        operation: &Operation,
        state: &State,
    ) -> Result<Sums, SolveError> {
        let tip_loss = self.models.tip_loss;
        let blades = f64::from(self.geometry.blades);
        if tip_loss.end_at_thrust(blades, 0.0).is_none() {
            return self.fly_with_shares(scene, operation, state);
        }
        // The more thrust, the sooner the lift ends, the less thrust. A rotor that hardly turns has the
        // airspeed in its coefficient instead of a tip speed, which the formula does not know.
        let radius = self.geometry.radius;
        let tip_speed = operation.speed * radius;
        let square = tip_speed * tip_speed + operation.airspeed.norm_squared();
        let reference = operation.air.density * PI * radius * radius * square;
        let mut failure = None;
        let mut surplus = |coefficient: f64| {
            let end = tip_loss.end_at_thrust(blades, coefficient).unwrap_or(1.0);
            self.end_lift_at(end);
            match self.fly_with_shares(scene, operation, state) {
                Ok(sums) if reference > 0.0 => sums.force.z.abs() / reference - coefficient,
                Ok(_) => -coefficient,
                Err(error) => {
                    failure = Some(error);
                    f64::NAN
                }
            }
        };
        let mut end = |at: f64| End {
            at,
            residual: surplus(at),
        };
        // With no lift lost the thrust is largest. At the largest coefficient no lift is left.
        let first = end(0.0);
        let mut last = end(first.residual.clamp(0.0, blades * blades));
        if last.residual > 0.0 {
            last = end(blades * blades);
        }
        let ends = (first, last);
        let solved = if ends.0.residual <= 0.0 {
            Ok(0.0)
        } else if ends.1.residual >= 0.0 {
            Ok(blades * blades) // a drag that alone exceeds it
        } else {
            bracketed(&mut surplus, ends.0, ends.1, THRUST_TOLERANCE)
        };
        let coefficient = match (failure, solved) {
            (Some(error), _) => return Err(error),
            (None, Err(cause)) => return Err(SolveError::LiftEnd(cause)),
            (None, Ok(coefficient)) => coefficient,
        };
        self.end_lift_at(tip_loss.end_at_thrust(blades, coefficient).unwrap_or(1.0));
        self.fly_with_shares(scene, operation, state)
    }

    /// Ends the lift of the blades at r/R = `end`.
    pub(super) fn end_lift_at(&mut self, end: f64) {
        let half = 0.5 * self.elements.width;
        let end = end * self.geometry.radius;
        for (share, radius) in self.lifting_share.iter_mut().zip(&self.elements.radius) {
            *share = lifting_share(radius - half, radius + half, end);
        }
    }
}
