//! A symmetrical section by simple laws for each Reynolds number: two lift slopes, a stall angle
//! and a polynomial for the drag, as in the thesis, sections 3.5.1 to 3.5.3.
//!
//! ```text
//! line A   cl = a alpha                                   from 0 to 3 deg
//! line C   cl = a 3 deg + c (alpha - 3 deg)               from 3 deg to stall
//! line D   cl = c alpha                                   line C's slope from the origin: too low
//! line B   cl = (a + c)/2 alpha                           the mean of A and D
//! drag     cd = d0 + d1 alpha + d2 alpha^2 + ...          eq. (104), from 0 to stall
//! ```
//!
//! The thesis takes one slope for each blade element: A for pitch angles up to 3 deg, B above. It
//! cannot take the angle of attack, which is known only after the induced velocity, and that needs
//! the slope. Its words are "blade with collective pitch angles up to 3 degrees". Ours is the pitch
//! of the element, collective and twist without the cyclic part: it does not depend on the pitch
//! reference radius, and it is the same on blades without twist.
//!
//! Beyond stall the thesis says nothing. We go on as the shipped polars do: Viterna & Corrigan
//! (1982), NASA CP-2230, from the stall angle to 90 deg, with the largest drag coefficient 2.01 of
//! a flat plate of aspect ratio 50,
//!
//! ```text
//! cl = 2.01/2 sin(2 alpha) + A2 cos(alpha)^2/sin(alpha),   cd = 2.01 sin(alpha)^2 + B2 cos(alpha),
//! ```
//!
//! A2 and B2 such that nothing jumps at stall. Beyond 90 deg, as in NREL's AirfoilPrep, drag is
//! mirrored about 90 deg; lift is mirrored and multiplied by -0.7, and from 180 deg less the stall
//! angle it runs linearly to 0 at 180 deg. Negative angles are mirrored: lift is odd, drag even.

use super::{
    Similarity,
    curve::MAX_COEFFICIENT,
    layers::{Axis, Layers, LayersError},
    table::wrapped,
};
use crate::numbers::{C, Lanes, Scalar};
use core::f64::consts::{FRAC_PI_2, PI};
use thiserror::Error;

/// Up to this angle line A holds, rad.
const EDGE: f64 = 3.0 * PI / 180.0;

/// A pitch that is 3 deg but for rounding counts as 3 deg, rad.
const ROUNDING: f64 = 1e-12;

/// Maximum lift slope, 1/rad; no section has a steeper one.
const MAX_SLOPE: f64 = 20.0;

/// Maximum stall angle, deg; no section stalls later in steady flow.
const MAX_STALL: f64 = 45.0;

/// Number of intervals up to stall; the drag polynomial is checked at their ends.
const CHECKS: usize = 200;

/// Maximum drag coefficient beyond stall: 1.11 + 0.018 times the aspect ratio 50.
const MAX_DRAG: f64 = 2.01;

/// Lift in reversed flow over that in flow from the front.
const REVERSED_LIFT: f64 = -0.7;

/// Which of the lines the lift follows up to stall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Line {
    /// A and then C.
    Broken,
    /// A or B, by the pitch of the element, rad.
    ByPitch(f64),
}

/// The laws at one Reynolds number.
#[derive(Debug, Clone, PartialEq)]
pub struct Law {
    reynolds: f64,
    /// Lift slopes of the lines A and C, 1/rad.
    slope_a: f64,
    slope_c: f64,
    /// Above 0, below pi/2, rad.
    stall: f64,
    /// d0, d1, d2, ... per rad: the polynomial lies between 0 and `MAX_COEFFICIENT` from 0 to the
    /// stall angle.
    drag: Vec<f64>,
}

/// The numbers of a law as its file has them.
#[derive(Debug, Clone, Copy)]
pub struct Coefficients<'a> {
    /// Reynolds number of the chord; `Laws` checks it.
    pub reynolds: f64,
    /// Lift slope of line A, above 0 and at most `MAX_SLOPE`, 1/rad.
    pub slope_a: f64,
    /// Lift slope of line C, 0 to `MAX_SLOPE`, 1/rad.
    pub slope_c: f64,
    /// Stall angle, above 0 and at most `MAX_STALL`, rad.
    pub stall: f64,
    /// d0, d1, d2, ... of the drag polynomial in alpha, rad.
    pub drag: &'a [f64],
}

/// What is wrong with the numbers of a law.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum LawError {
    /// Lift slope A out of its range, 1/rad.
    #[error("lift slope A = {0} must be above 0 and at most {MAX_SLOPE} per rad")]
    SlopeA(f64),
    /// Lift slope C out of its range, 1/rad.
    #[error("lift slope C = {0} must be 0 to {MAX_SLOPE} per rad")]
    SlopeC(f64),
    /// Stall angle out of its range, rad.
    #[error(
        "stall angle {0} must be above 0 and at most {max:.3} rad ({MAX_STALL} deg); angles are in rad",
        max = MAX_STALL.to_radians()
    )]
    Stall(f64),
    /// Lift beyond `MAX_COEFFICIENT` at the stall angle.
    #[error(
        "the lift coefficient at the stall angle is {value:?} by line {line}; it must be at most {MAX_COEFFICIENT}: lower the lift slope or the stall angle"
    )]
    Lift {
        /// The lift coefficient.
        value: f64,
        /// The line in the thesis that gives it.
        line: char,
    },
    /// The polynomial is out of its range at an angle up to stall.
    #[error(
        "the drag polynomial gives {value:?} at {deg:.2} deg; from 0 to the stall angle it must lie between 0 and {MAX_COEFFICIENT}",
        deg = alpha.to_degrees()
    )]
    Drag {
        /// The polynomial there.
        value: f64,
        /// rad.
        alpha: f64,
    },
}

/// The laws at all Reynolds numbers of a file.
///
/// Between two of them the coefficients are linear in ln Re; outside, the nearest holds.
#[derive(Debug, Clone, PartialEq)]
pub struct Laws {
    layers: Layers,
    law: Vec<Law>,
}

impl Line {
    /// Slope of the line through the origin, 1/rad.
    fn slope(self, law: &Law) -> f64 {
        let mean_of_a_and_d = match self {
            Self::Broken => false,
            Self::ByPitch(pitch) => pitch.abs() > EDGE + ROUNDING,
        };
        if mean_of_a_and_d {
            0.5 * (law.slope_a + law.slope_c)
        } else {
            law.slope_a
        }
    }
}

impl Law {
    /// The law with these numbers.
    ///
    /// # Errors
    ///
    /// The first number out of its range, and lift or drag beyond `MAX_COEFFICIENT`; the drag
    /// polynomial is checked at 201 angles from 0 to the stall angle.
    pub fn try_new(numbers: Coefficients) -> Result<Self, LawError> {
        let Coefficients {
            reynolds,
            slope_a,
            slope_c,
            stall,
            drag,
        } = numbers;
        if !(slope_a > 0.0 && slope_a <= MAX_SLOPE) {
            return Err(LawError::SlopeA(slope_a));
        }
        if !(0.0..=MAX_SLOPE).contains(&slope_c) {
            return Err(LawError::SlopeC(slope_c));
        }
        if !(stall > 0.0 && stall <= MAX_STALL.to_radians()) {
            return Err(LawError::Stall(stall));
        }
        let law = Self {
            reynolds,
            slope_a,
            slope_c,
            stall,
            drag: drag.to_vec(),
        };
        for (line, name) in [(Line::ByPitch(0.0), 'A'), (Line::Broken, 'C')] {
            let value: f64 = law.attached(line, stall);
            if value > MAX_COEFFICIENT {
                return Err(LawError::Lift { value, line: name });
            }
        }
        for i in 0..=CHECKS {
            let alpha = stall * i as f64 / CHECKS as f64;
            let value: f64 = law.attached_drag(alpha);
            if !(0.0..=MAX_COEFFICIENT).contains(&value) {
                return Err(LawError::Drag { value, alpha });
            }
        }
        Ok(law)
    }

    /// Lift coefficient up to stall at an angle >= 0.
    fn attached<S: Scalar>(&self, line: Line, alpha: S) -> S {
        match line {
            Line::Broken if alpha.is_above(EDGE) => {
                C(self.slope_a * EDGE) + C(self.slope_c) * (alpha - EDGE)
            }
            Line::Broken | Line::ByPitch(_) => C(line.slope(self)) * alpha,
        }
    }

    fn lift<S: Scalar>(&self, line: Line, alpha: S) -> S {
        if alpha.is_below(0.0) {
            return -self.lift(line, -alpha);
        }
        if !alpha.is_above(self.stall) {
            return self.attached(line, alpha);
        }
        let at_stall = self.attached(line, self.stall);
        if !alpha.is_above(FRAC_PI_2) {
            return self.stalled_lift(at_stall, alpha);
        }
        let mirrored = C(PI) - alpha;
        let lift = if !mirrored.is_below(self.stall) {
            self.stalled_lift(at_stall, mirrored)
        } else {
            C(at_stall / self.stall) * mirrored
        };
        C(REVERSED_LIFT) * lift
    }

    /// Between the stall angle and 90 deg.
    fn stalled_lift<S: Scalar>(&self, at_stall: f64, alpha: S) -> S {
        let (sin_stall, cos_stall) = (libm::sin(self.stall), libm::cos(self.stall));
        let a2 =
            (at_stall - MAX_DRAG * sin_stall * cos_stall) * sin_stall / (cos_stall * cos_stall);
        let (sin, cos) = (alpha.sin(), alpha.cos());
        C(MAX_DRAG) * (sin * cos) + C(a2) * (cos * cos / sin)
    }

    /// Drag coefficient up to stall at an angle >= 0: Horner's scheme.
    fn attached_drag<S: Scalar>(&self, alpha: S) -> S {
        let coefficients = self.drag.iter().rev();
        coefficients.fold(S::zero(), |higher, d| C(*d) + higher * alpha)
    }

    fn drag<S: Scalar>(&self, alpha: S) -> S {
        let alpha = alpha.abs();
        let folded = if alpha.is_above(FRAC_PI_2) {
            C(PI) - alpha
        } else {
            alpha
        };
        if !folded.is_above(self.stall) {
            return self.attached_drag(folded);
        }
        let (sin_stall, cos_stall) = (libm::sin(self.stall), libm::cos(self.stall));
        let at_stall = self.attached_drag(self.stall);
        let b2 = (at_stall - MAX_DRAG * sin_stall * sin_stall) / cos_stall;
        let sin = folded.sin();
        C(MAX_DRAG) * (sin * sin) + C(b2) * folded.cos()
    }
}

impl Laws {
    /// The laws of a file.
    ///
    /// # Errors
    ///
    /// There must be one or more, with strictly increasing Reynolds numbers from 1 to 1e10.
    pub fn try_new(law: Vec<Law>) -> Result<Self, LayersError> {
        let numbers = law.iter().map(|l| l.reynolds);
        Ok(Self {
            layers: Layers::try_new(Axis::Reynolds, numbers)?,
            law,
        })
    }

    /// The Reynolds numbers of the laws.
    pub fn layers(&self) -> &Layers {
        &self.layers
    }

    /// A quantity of the laws around the numbers of a flow, by the law and the lane.
    #[inline(always)]
    fn mixed<L: Lanes>(&self, flow: Similarity<L>, of_law: impl Fn(&Law, usize) -> L::One) -> L {
        self.layers
            .mixed(flow, |layer, lane| of_law(&self.law[layer], lane))
    }

    /// Lift coefficient at any angle (rad), by the line of each lane.
    #[inline(always)]
    pub fn lift<L: Lanes>(&self, line: impl Fn(usize) -> Line, alpha: L, flow: Similarity<L>) -> L {
        let alpha = wrapped(alpha);
        self.mixed(flow, |law, lane| law.lift(line(lane), alpha.lane(lane)))
    }

    /// Drag coefficient at any angle (rad).
    #[inline(always)]
    pub fn drag<L: Lanes>(&self, alpha: L, flow: Similarity<L>) -> L {
        let alpha = wrapped(alpha);
        self.mixed(flow, |law, lane| law.drag(alpha.lane(lane)))
    }

    /// Slope of the line through the origin, 1/rad, by the line of each lane.
    #[inline(always)]
    pub fn slope<L: Lanes>(&self, line: impl Fn(usize) -> Line, flow: Similarity<L>) -> L {
        self.mixed(flow, |law, lane| L::One::constant(line(lane).slope(law)))
    }

    /// Stall angle, > 0, rad.
    #[inline(always)]
    pub fn stall<L: Lanes>(&self, flow: Similarity<L>) -> L {
        self.mixed(flow, |law, _| L::One::constant(law.stall))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn laws() -> Laws {
        let law = |reynolds: f64, scale: f64| {
            let numbers = Coefficients {
                reynolds,
                slope_a: 6.0 * scale,
                slope_c: 4.0 * scale,
                stall: scale * 0.2,
                drag: &[0.01, 0.0, 0.5],
            };
            Law::try_new(numbers).unwrap()
        };
        Laws::try_new(vec![law(1e5, 1.0), law(1e6, 1.1)]).unwrap()
    }

    fn flow(reynolds: f64) -> Similarity<f64> {
        Similarity {
            reynolds,
            mach: 0.0,
        }
    }

    fn lift(line: Line, alpha: f64, reynolds: f64) -> f64 {
        laws().lift(|_| line, alpha, flow(reynolds))
    }

    #[test]
    fn line_a_up_to_3_deg_of_pitch_and_above_the_mean_of_a_and_d_at_any_angle_of_attack() {
        let degrees = |x: f64| x.to_radians();
        for pitch in [-3.0, 0.0, 2.9, 3.0] {
            let line = Line::ByPitch(degrees(pitch));
            assert!((lift(line, 0.1, 1e5) - 0.6).abs() < 1e-15, "{pitch}");
        }
        for pitch in [-20.0, -3.1, 3.1, 16.9] {
            let line = Line::ByPitch(degrees(pitch));
            assert!((lift(line, 0.1, 1e5) - 0.5).abs() < 1e-15, "{pitch}");
            assert!((lift(line, 0.01, 1e5) - 0.05).abs() < 1e-15, "{pitch}");
        }
    }

    #[test]
    fn without_a_pitch_the_lift_follows_a_and_then_c() {
        assert!((lift(Line::Broken, 0.05, 1e5) - 0.3).abs() < 1e-15);
        let expected = 6.0 * EDGE + 4.0 * (0.15 - EDGE);
        assert!((lift(Line::Broken, 0.15, 1e5) - expected).abs() < 1e-15);
        assert!((lift(Line::Broken, -0.15, 1e5) + expected).abs() < 1e-15);
    }

    #[test]
    fn a_row_is_met_exactly_and_between_rows_the_coefficients_are_linear_in_ln_re() {
        let line = Line::ByPitch(0.1);
        assert_eq!(lift(line, 0.1, 1e6), laws().law[1].lift(line, 0.1));
        assert_eq!(lift(line, 0.1, 1e9), lift(line, 0.1, 1e6), "nearest");
        assert_eq!(lift(line, 0.1, 2e3), lift(line, 0.1, 1e5), "nearest");
        let middle = lift(line, 0.1, libm::sqrt(1e11));
        assert!((middle - 0.525).abs() < 1e-14);
        assert!((laws().stall(flow(libm::sqrt(1e11))) - 0.21).abs() < 1e-14);
    }

    #[test]
    fn drag_is_the_polynomial_up_to_stall() {
        let drag = |alpha: f64| laws().drag(alpha, flow(1e5));
        assert_eq!(drag(0.0), 0.01);
        assert!((drag(0.1) - 0.015).abs() < 1e-15);
        assert_eq!(drag(-0.1), drag(0.1));
        assert!((drag(FRAC_PI_2) - 2.01).abs() < 1e-12);
    }

    #[test]
    fn the_whole_circle_is_finite_without_jumps_odd_in_lift_and_even_in_drag() {
        let step = 1e-4;
        for line in [Line::Broken, Line::ByPitch(0.01), Line::ByPitch(0.3)] {
            for i in -32_000..32_000 {
                let alpha = f64::from(i) * step;
                let (a, b) = (lift(line, alpha, 3e5), lift(line, alpha + step, 3e5));
                assert!((b - a).abs() < 12.0 * step, "{line:?} {alpha}: {a} {b}");
                assert!(a.abs() < 1.5, "{alpha}: {a}");
                assert!((a + lift(line, -alpha, 3e5)).abs() < 1e-12);
                let drag = |alpha: f64| laws().drag(alpha, flow(3e5));
                let (a, b) = (drag(alpha), drag(alpha + step));
                assert!((b - a).abs() < 3.0 * step, "{alpha}: {a} {b}");
                assert!((0.01..=2.02).contains(&a), "{alpha}: {a}");
                assert!((a - drag(-alpha)).abs() < 1e-12);
            }
        }
        assert!(lift(Line::Broken, PI, 3e5).abs() < 1e-12);
        assert!(lift(Line::Broken, FRAC_PI_2, 3e5).abs() < 1e-12);
    }
}
