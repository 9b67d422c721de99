//! Newton's method for several equations in as many unknowns.

use crate::numbers::Dual64;
use nalgebra::{DMatrix, DVector};

/// Bound on the matrices of slopes.
const MAX_MATRICES: usize = 30;
/// Bound on the steps with a matrix before it is computed anew.
const MAX_STEPS: usize = 8;
/// Bound on the halvings of a step that does not come closer.
const MAX_HALVINGS: u32 = 10;
/// Difference of an unknown for the slopes.
const SMALL: f64 = 1e-7;

/// What a residual is computed for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Use {
    /// Its value, which vanishes at the solution.
    Value,
    /// The slopes, from differences: a smooth and cheap approximation will do.
    Slopes,
}

/// The root of `residual`, searched from `start`; none if the search fails within the
/// method's bounds. All unknowns and residuals are of the order of 1.
///
/// The slopes are differences; from step to step Broyden's formula (1965, Math. Comp. 19, p. 577)
/// corrects them, for as long as each step leaves at most a fifth of the residual. Steps that do
/// not come closer are halved. The search ends where a whole step is smaller than `tolerance`.
///
/// # Errors
///
/// The error of `residual` at the start, or at the shortest step.
pub fn solve<E>(
    start: DVector<f64>,
    tolerance: f64,
    mut residual: impl FnMut(&DVector<f64>, Use) -> Result<DVector<f64>, E>,
) -> Result<Option<DVector<f64>>, E> {
    let count = start.len();
    let mut at = start;
    let mut value = residual(&at, Use::Value)?;
    for _ in 0..MAX_MATRICES {
        if !value.norm().is_finite() {
            return Ok(None);
        }
        if value.norm() == 0.0 {
            return Ok(Some(at));
        }
        let base = residual(&at, Use::Slopes)?;
        let mut slopes = DMatrix::zeros(count, count);
        for i in 0..count {
            let mut other = at.clone();
            other[i] += SMALL;
            slopes.set_column(i, &((residual(&other, Use::Slopes)? - &base) / SMALL));
        }
        for _ in 0..MAX_STEPS {
            let Some(step) = slopes.clone().lu().solve(&-&value) else {
                return Ok(None);
            };
            if step.norm() <= tolerance {
                return Ok(Some(at + step));
            }
            let before = value.norm();
            let mut part = 1.0;
            let mut next = (&at + &step, DVector::zeros(0));
            for halving in 0..=MAX_HALVINGS {
                next.0 = &at + &step * part;
                // Too long a step may lead to where the residual cannot be computed.
                match residual(&next.0, Use::Value) {
                    Ok(value) => next.1 = value,
                    Err(error) if halving == MAX_HALVINGS => return Err(error),
                    Err(_) => {
                        part *= 0.5;
                        continue;
                    }
                }
                if next.1.norm() < before || halving == MAX_HALVINGS {
                    break;
                }
                part *= 0.5;
            }
            let moved = &step * part;
            let change = &next.1 - &value;
            slopes +=
                (change - &slopes * &moved) * moved.transpose() / moved.norm_squared().max(1e-300);
            (at, value) = next;
            if value.norm() > 0.2 * before {
                break;
            }
        }
    }
    Ok(None)
}

/// The change of the root of several equations, which was found at `root`, by the implicit function
/// theorem: dx = -J^-1 (dR/dp) dp, with J from dual numbers. None where J has no inverse.
///
/// # Errors
///
/// The error of `residual` at the root.
pub fn derivative_at_root<E>(
    root: &DVector<f64>,
    mut residual: impl FnMut(&DVector<Dual64>) -> Result<DVector<Dual64>, E>,
) -> Result<Option<DVector<f64>>, E> {
    let count = root.len();
    let still = root.map(Dual64::from_re);
    let by_parameters = residual(&still)?.map(|r| r.eps);
    if by_parameters.iter().all(|change| *change == 0.0) {
        return Ok(Some(DVector::zeros(count)));
    }
    let mut slopes = DMatrix::zeros(count, count);
    for i in 0..count {
        let mut moving = still.clone();
        moving[i].eps = 1.0;
        let both = residual(&moving)?.map(|r| r.eps);
        slopes.set_column(i, &(both - &by_parameters));
    }
    Ok(slopes.lu().solve(&-by_parameters))
}
