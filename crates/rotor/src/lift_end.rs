//! Where the lift of the blades ends, for the tip losses that end it.

use super::{
    Operation, Rotor, SolveError, State,
    loads::Sums,
    root::{End, bracketed},
    scalar::Scalar,
    scene::Scene,
    tip_loss::lifting_share,
};
use core::f64::consts::PI;

/// To which the thrust coefficient is found on which the end of the lift depends.
const THRUST_TOLERANCE: f64 = 1e-13;

impl<S: Scalar> Rotor<S> {
    /// The loads in a state, with the lift ending where the tip loss says.
    pub(super) fn fly(
        &mut self,
        scene: &Scene<S>,
        operation: &Operation<S>,
        state: &State<S>,
    ) -> Result<Sums<S>, SolveError> {
        let tip_loss = self.models.tip_loss;
        let blades = f64::from(self.geometry.blades);
        if tip_loss.end_at_thrust(blades, S::zero()).is_none() {
            return self.fly_with_shares(scene, operation, state);
        }
        // The more thrust, the sooner the lift ends, the less thrust. A rotor that hardly turns has the
        // airspeed in its coefficient instead of a tip speed, which the formula does not know.
        let radius = self.geometry.radius;
        let tip_speed = operation.speed * radius;
        let air = &operation.airspeed;
        let square = tip_speed * tip_speed + (air.x * air.x + air.y * air.y + air.z * air.z);
        let reference = operation.air.density * PI * radius * radius * square;
        let mut failure = None;
        let mut surplus = |coefficient: S| {
            let end = tip_loss.end_at_thrust(blades, coefficient);
            self.end_lift_at(end.unwrap_or(S::one()));
            match self.fly_with_shares(scene, operation, state) {
                Ok(sums) if reference.value() > 0.0 => sums.force.z.abs() / reference - coefficient,
                Ok(_) => -coefficient,
                Err(error) => {
                    failure = Some(error);
                    S::constant(f64::NAN)
                }
            }
        };
        let mut plain = |at: f64| surplus(S::constant(at)).value();
        let mut end = |at: f64| End {
            at,
            residual: plain(at),
        };
        // With no lift lost the thrust is largest. At the largest coefficient no lift is left.
        let first = end(0.0);
        let mut last = end(first.residual.clamp(0.0, blades * blades));
        if last.residual > 0.0 {
            last = end(blades * blades);
        }
        let solved = if first.residual <= 0.0 {
            Ok(S::zero())
        } else if last.residual >= 0.0 {
            Ok(S::constant(blades * blades)) // a drag that alone exceeds it
        } else {
            bracketed(plain, first, last, THRUST_TOLERANCE)
                .map(|coefficient| S::at_root(coefficient, surplus))
        };
        let coefficient = match (failure, solved) {
            (Some(error), _) => return Err(error),
            (None, Err(cause)) => return Err(SolveError::LiftEnd(cause)),
            (None, Ok(coefficient)) => coefficient,
        };
        let end = tip_loss.end_at_thrust(blades, coefficient);
        self.end_lift_at(end.unwrap_or(S::one()));
        self.fly_with_shares(scene, operation, state)
    }

    /// Ends the lift of the blades at r/R = `end`.
    pub(super) fn end_lift_at(&mut self, end: S) {
        let half = 0.5 * self.elements.width;
        let end = end * self.geometry.radius;
        for (share, radius) in self.lifting_share.iter_mut().zip(&self.elements.radius) {
            *share = lifting_share(radius - half, radius + half, end);
        }
    }
}
