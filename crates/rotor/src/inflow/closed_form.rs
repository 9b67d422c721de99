//! The closed form of blade-element momentum theory for small angles and a linear lift slope:
//! Knight & Hefner 1937 (NACA TN 626), Leishman 2006 eq. (3.51); the thesis' eq. (94),
//!
//! ```text
//! lambda = sqrt((A - lambda_c/2)^2 + 2 A theta r) - (A - lambda_c/2),   A = sigma cl_alpha/16
//! ```
//!
//! with dCT = sigma cl_alpha/2 (theta r^2 - lambda r) dr, eq. (93), and
//! dCP = sigma/2 (phi cl + cd) r^3 dr, eq. (91), phi = lambda/r. Here everything is multiplied by
//! the tip speed, so that a rotor at standstill is no special case.
//!
//! Negative pitch. The thesis (section 3.2) takes the magnitude of theta under the root and gives
//! the root the sign of theta. Then lambda would jump by 2 A where theta changes its sign, and the
//! thrust would have the wrong sign. Mirroring the rotor in its disc shows that A changes its sign
//! too. So we mirror the whole equation: lambda(-theta, -lambda_c) = -lambda(theta, lambda_c).
//!
//! Fast descent. Where the air passes upwards through the disc (lambda < 0), the mass flow is
//! -lambda and the same derivation gives
//! lambda = (A + lambda_c/2) - sqrt((A + lambda_c/2)^2 - 2 A theta r). This windmill state is taken
//! where it exists.
//!
//! Tip loss. Prandtl's F multiplies the momentum, so A becomes A/F (Leishman 2006, eq. 3.126). F
//! depends on lambda: one bracketed unknown.

use super::Disc;
use crate::{
    airfoil::{Similarity, wrapped},
    element::{Element, SectionLoad},
    geometry::Block,
    numbers::{C, Dual, Equation, Lanes, Mask, Plain, Portable, Scalar, converted},
    root::{End, RootError, bracketed},
};

/// Loads and induced velocity of blade elements by the closed form. SI units.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ClosedForm<L = f64> {
    /// Loads of one blade's section.
    pub load: SectionLoad<L>,
    /// Induced velocity at the blade, positive down, m/s.
    pub induced: L,
    /// Mean of the induced velocity around the annulus, positive down, m/s.
    pub mean_induced: L,
}

/// Tolerance of the flow through the disc, as a part of its bracket.
const TOLERANCE: f64 = 1e-14;

/// Newton's method has found the flow where its last step is at most this part of the bracket: what
/// is left is about the square of it.
const LAST_STEP: f64 = 1e-8;

/// Bound on Newton's steps; two or three are usual.
const MAX_STEPS: u32 = 6;

/// Speed of a section, m/s, below which it counts as stopped.
const STANDSTILL: f64 = 1e-6;

/// Flow down through the disc, m/s: eq. (94) times the tip speed.
///
/// * `a`: sigma cl_alpha/16 times tip speed, > 0, m/s
/// * `climb`: m/s
/// * `pitch_flow`: theta Omega r, m/s
#[inline(always)]
pub(super) fn through_flow<L: Lanes>(a: L, climb: L, pitch_flow: L) -> L {
    // Mirrored, so that the pitch is not negative.
    let is_mirrored = pitch_flow.is_below(0.0);
    let climb = L::select(is_mirrored, -climb, climb);
    let pitch_flow = pitch_flow.abs();
    let half = a - C(0.5) * climb;
    let mut flow = (half * half + C(2.0) * a * pitch_flow).sqrt() - half;
    let upward = a + C(0.5) * climb;
    let is_upward = upward.values().is_below(0.0);
    if is_upward.any() {
        let windmill = upward * upward - C(2.0) * a * pitch_flow;
        let is_windmill = is_upward & !windmill.values().is_below(0.0);
        flow = L::select(is_windmill, upward - windmill.sqrt(), flow);
    }
    L::select(is_mirrored, -flow, flow)
}

/// The flow and the loads at the elements of a block.
///
/// # Errors
///
/// If the data of the elements or the flow are not finite, so that the equation with Prandtl's F
/// has no solution.
#[inline(always)]
pub(super) fn find<L: Lanes>(
    disc: &Disc<L::One>,
    block: &Block,
    element: &Element<L>,
) -> Result<ClosedForm<L>, RootError> {
    let (rotation, climb) = (disc.flow.rotation, disc.flow.climb);
    if let Ok(solution) = solve::<L, ByNewton>(element, rotation, climb) {
        return Ok(solution);
    }
    let solution = search(disc, block)?;
    let load = solution.load;
    Ok(ClosedForm {
        load: SectionLoad {
            normal: converted(load.normal),
            tangential: converted(load.tangential),
            angle_of_attack: converted(load.angle_of_attack),
            speed: converted(load.speed),
            lift_coefficient: converted(load.lift_coefficient),
            drag_coefficient: converted(load.drag_coefficient),
        },
        induced: converted(solution.induced),
        mean_induced: converted(solution.mean_induced),
    })
}

/// `solve` by a bracket in the lanes that every processor has.
#[inline(never)]
fn search<S: Scalar>(
    disc: &Disc<S>,
    block: &Block,
) -> Result<ClosedForm<S::In<Portable>>, RootError> {
    let element = disc.blade.block::<S::In<Portable>>(block);
    solve::<_, ByBracket>(&element, disc.flow.rotation, disc.flow.climb)
}

/// The flow and the loads at blade elements in axial flow.
///
/// * `speed`: Omega, rad/s; where Omega r is below 1e-6 m/s there is no load
/// * `climb`: flow down through the disc, any sign, m/s
#[inline(always)]
fn solve<L: Lanes, M: Method>(
    element: &Element<L>,
    speed: L::One,
    climb: L::One,
) -> Result<ClosedForm<L>, RootError> {
    let zero = L::nil();
    let rotation = L::splat(speed).times(element.radius);
    let climb = L::splat(climb);
    // Inflow angles are small only if the rotor turns. At standstill the theory has no load.
    let is_stopped = rotation.values().is_below(STANDSTILL);
    if is_stopped.all() {
        return Ok(ClosedForm {
            load: SectionLoad::zero(),
            induced: zero,
            mean_induced: zero,
        });
    }
    let flow = element.similarity(rotation);
    let (slope, zero_lift) = lift_line(element, flow);
    let slope = slope * element.lifting_share;
    let pitch = element.pitch - zero_lift;

    // The compressibility rules depend on the lift coefficient: eq. (94) once with the
    // incompressible slope for the lift, and again with the slope corrected at that lift.
    let mut corrected = slope;
    let mut through = zero;
    for is_last in [false, true] {
        let balance = Balance {
            element,
            rotation,
            climb,
            a: corrected.times(element.solidity()) * rotation / 8.0,
            pitch_flow: pitch * rotation,
        };
        // No lift, nothing induced.
        let has_lift = corrected.values().is_above(0.0) & !is_stopped;
        let loaded = balance.solve::<M>(has_lift)?;
        through = L::select(has_lift, loaded, climb);
        let lift = slope * (pitch - through / rotation);
        let gain = element.compressibility(lift, flow.mach);
        let next = slope * gain;
        let is_same = (next.values() - corrected.values())
            .is_negligible(0.0)
            .all();
        if is_last || is_same {
            break;
        }
        corrected = next;
    }

    let inflow_angle = through / rotation;
    let angle_of_attack = wrapped(element.pitch - inflow_angle);
    let lift = corrected * (pitch - inflow_angle);
    let drag = element.drag_coefficient(angle_of_attack, rotation);
    let pressure = C(0.5) * element.density * rotation * rotation.times(element.chord);
    let induced = through - climb;
    let mean_induced = induced * element.tip_loss_factor(inflow_angle);
    let turning = |quantity: L| L::select(is_stopped, zero, quantity);
    Ok(ClosedForm {
        load: SectionLoad {
            normal: turning(pressure * lift),
            tangential: turning(pressure * (inflow_angle * lift + drag)),
            angle_of_attack: turning(angle_of_attack),
            speed: turning(rotation),
            lift_coefficient: turning(lift),
            drag_coefficient: turning(drag),
        },
        induced: turning(induced),
        mean_induced: turning(mean_induced),
    })
}

/// The lift of the mixed section as one line: its slope, 1/rad, and its angle of zero lift, rad.
#[inline(always)]
fn lift_line<L: Lanes>(element: &Element<L>, flow: Similarity<L>) -> (L, L) {
    let pitch = element.pitch.values();
    let section = &element.section;
    let (mut slope, mut moment) = (L::nil(), L::nil());
    for (airfoil, shares) in section.shares {
        let line = section.airfoils[*airfoil].lift_line(element.model, pitch, flow);
        if section.shares.len() == 1 {
            return line;
        }
        let share = L::Real::load(shares);
        slope += line.0.times(share);
        moment += (line.0 * line.1).times(share);
    }
    let is_flat = slope.values().is_negligible(0.0);
    (slope, L::select(is_flat, L::nil(), moment / slope))
}

/// The balance of the flow through the disc with tip loss.
struct Balance<'a, L: Lanes> {
    element: &'a Element<'a, L>,
    rotation: L,
    climb: L,
    /// sigma Omega R cl_alpha/16, which is (N c/(2 pi r)) Omega r cl_alpha/8, m/s.
    a: L,
    /// theta Omega r, m/s.
    pitch_flow: L,
}

impl<L: Lanes> Equation<L> for Balance<'_, L> {
    #[inline(always)]
    fn residual(&self, through: L) -> L {
        // Small angle, as in thesis eq. (95).
        let factor = self.element.tip_loss_factor(through / self.rotation);
        let loaded = through_flow(self.a / factor, self.climb, self.pitch_flow);
        let is_lossy = factor.values().is_above(0.0);
        through - L::select(is_lossy, loaded, self.pitch_flow)
    }
}

impl<'a, L: Lanes> Balance<'a, L> {
    /// The flow through the disc in the lanes that have lift.
    #[inline(always)]
    fn solve<M: Method>(&self, has_lift: L::Mask) -> Result<L, RootError> {
        let without_loss = through_flow(self.a, self.climb, self.pitch_flow);
        if !self.element.tip_loss.has_factor() {
            // No loss, or the end of the lift, which the slope contains.
            return Ok(without_loss);
        }
        // The solution lies between `without_loss` (F = 1) and its limit theta Omega r (F = 0).
        let range = (without_loss.values(), self.pitch_flow.values());
        let found = M::find(self, range, has_lift)?;
        Ok(L::at_roots(found, self))
    }
}

/// A way to find the flow through the disc.
trait Method {
    /// The root in a range from F = 1 to F = 0, in the lanes that have lift.
    fn find<L: Lanes>(
        balance: &Balance<L>,
        range: (L::Real, L::Real),
        has_lift: L::Mask,
    ) -> Result<L::Real, RootError>;
}

/// Fails where it does not converge.
struct ByNewton;

/// Always finds the root of finite numbers.
struct ByBracket;

impl Method for ByNewton {
    #[inline(always)]
    fn find<L: Lanes>(
        balance: &Balance<L>,
        (begin, limit): (L::Real, L::Real),
        has_lift: L::Mask,
    ) -> Result<L::Real, RootError> {
        let accuracy = (limit - begin).abs() * LAST_STEP;
        let dual = |x: L| Dual::from_re(x.values());
        let balance = Balance {
            element: &balance.element.map(dual),
            rotation: dual(balance.rotation),
            climb: dual(balance.climb),
            a: dual(balance.a),
            pitch_flow: dual(balance.pitch_flow),
        };
        let mut through = begin;
        let mut is_found = !has_lift;
        for _ in 0..MAX_STEPS {
            let at = balance.residual(Dual::new(through, L::Real::unit()));
            let step = at.re / at.eps;
            through = through - step;
            is_found = !has_lift | !step.abs().above(accuracy);
            if is_found.all() {
                break;
            }
        }
        // Where F is 1 but for rounding, the flow is `begin` but for rounding.
        let is_inside = !((through - begin) * (limit - through)).is_below(0.0)
            | !(through - begin).abs().above(accuracy);
        if (is_found & (is_inside | !has_lift)).all() {
            Ok(through)
        } else {
            Err(RootError::OutOfIterations)
        }
    }
}

impl Method for ByBracket {
    fn find<L: Lanes>(
        balance: &Balance<L>,
        (begin, limit): (L::Real, L::Real),
        has_lift: L::Mask,
    ) -> Result<L::Real, RootError> {
        let zero = L::Real::nil();
        let plain = |through: L::Real| {
            let residual = balance.residual(L::real(through)).values();
            L::Real::select(has_lift, residual, zero)
        };
        let first = End {
            at: begin,
            residual: plain(begin),
        };
        let side = L::Real::select(limit.above(begin), L::Real::unit(), -L::Real::unit());
        // F differs from 1 by less than the rounding of the equation.
        let is_whole = !(first.residual * side).is_below(0.0);
        let first = End {
            residual: L::Real::select(is_whole, zero, first.residual),
            ..first
        };
        let last = End {
            at: limit,
            residual: -first.residual,
        };
        bracketed(plain, first, last, (limit - begin).abs() * TOLERANCE)
    }
}

#[cfg(test)]
#[allow(clippy::disallowed_methods)] // the expectations are independent of libm
mod tests {
    use super::*;

    /// Eq. (94) as printed, in ratios of tip speed.
    fn printed(a: f64, climb: f64, theta_r: f64) -> f64 {
        let half = a - climb / 2.0;
        (half * half + 2.0 * a * theta_r).sqrt() - half
    }

    #[test]
    fn equals_the_printed_equation_for_positive_pitch() {
        for climb in [-0.01, 0.0, 0.02, 0.1] {
            for theta_r in [0.0, 0.01, 0.1] {
                let difference = through_flow(0.03, climb, theta_r) - printed(0.03, climb, theta_r);
                assert!(difference.abs() < 1e-15, "{climb} {theta_r}");
            }
        }
    }

    #[test]
    fn satisfies_momentum_theory_in_climb_and_as_a_windmill() {
        // 4 |lambda| (lambda - lambda_c) = 8 A (theta r - lambda)
        for (climb, theta_r) in [
            (0.0, 0.1),
            (0.05, 0.1),
            (-0.3, 0.05),
            (0.3, -0.05),
            (0.0, -0.1),
        ] {
            let a = 0.03;
            let l = through_flow(a, climb, theta_r);
            let sides = 4.0 * l.abs() * (l - climb) - 8.0 * a * (theta_r - l);
            assert!(sides.abs() < 1e-15, "{climb} {theta_r}: {l} leaves {sides}");
        }
    }

    #[test]
    fn mirrored_pitch_and_climb_mirror_the_flow_without_a_jump_at_zero() {
        let a = 0.03;
        assert_eq!(through_flow(a, 0.02, 0.1), -through_flow(a, -0.02, -0.1));
        for climb in [-0.2, -0.02, 0.0, 0.02, 0.2] {
            let jump = through_flow(a, climb, 1e-12) - through_flow(a, climb, -1e-12);
            assert!(jump.abs() < 1e-9, "climb {climb}: jump {jump}");
        }
    }
}
