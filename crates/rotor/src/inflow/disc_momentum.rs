//! Glauert's momentum theory for the disc as a whole, with the linear distribution that the skew of
//! the wake gives.

use super::{AllElements, Disc, Induction, Number, linear::Coefficients, linear::Skew, uniform};
use crate::{error::SolveError, induced::Field, sweep::Wanted};
use core::f64::consts::PI;

impl<S: Number> Disc<'_, S> {
    /// Mean induced velocity and its distribution at the blades, in wind axes. Fails if the balance
    /// of thrust and momentum has no solution, which needs numbers that are not finite.
    pub(crate) fn momentum_field(&self, skew: Skew) -> Result<Field<S>, SolveError> {
        let Self {
            blade,
            flow,
            momentum,
            ..
        } = self;
        let radius = blade.geometry.radius;
        let tip_speed = flow.rotation.abs() * radius;
        let distributed = |mean: S| {
            let through = flow.climb + mean;
            let Coefficients { kx, ky } = skew.coefficients(flow.edgewise, through, tip_speed);
            let field = Field {
                mean,
                cosine: mean * kx,
                sine: mean * ky,
            };
            momentum.at_the_blades(flow.edgewise, mean, field)
        };
        let density_area = blade.air.density * PI * radius * radius;
        let thrust = |mean: S| {
            let loads = S::disc_loads(AllElements {
                disc: self,
                induction: &Induction::Field(distributed(mean)),
                wanted: Wanted::Sums,
                elements: &mut [],
            });
            // In a given field nothing is solved that could fail.
            loads.map_or(S::constant(f64::NAN), |loads| loads.force.z / density_area)
        };
        let scale = (tip_speed + flow.edgewise + flow.climb.abs()).value();
        if scale == 0.0 {
            return Ok(Field::zero());
        }
        let mass_flow = |v: S| momentum.descent.speed(flow.edgewise, flow.climb, v);
        let mean = uniform::mean_velocity(mass_flow, flow.climb, scale, thrust)
            .map_err(SolveError::Disc)?;
        Ok(distributed(mean))
    }
}
