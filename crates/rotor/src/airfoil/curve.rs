//! One coefficient over the full circle of angles of attack.

use crate::text_file::{NoMemory, collect};
use core::f64::consts::PI;
use thiserror::Error;

/// Maximum number of points of a curve; no file needs more than a few hundred.
const MAX_POINTS: usize = 1 << 16;

/// Maximum of lift and drag coefficients, whatever their sign. No section comes near it: a flat
/// plate across the flow has a drag coefficient of 2, and multi-element sections lift up to 5.
pub const MAX_COEFFICIENT: f64 = 10.0;

/// The coefficient of a curve, which decides the values that it may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Coefficient {
    /// From -`MAX_COEFFICIENT` to `MAX_COEFFICIENT`.
    Lift,
    /// From 0 to `MAX_COEFFICIENT`.
    Drag,
}

/// A coefficient over the angle of attack: linear between its points, exact at them.
#[derive(Debug, Clone, PartialEq)]
pub struct Curve {
    /// Angles of attack, strictly increasing from -pi to pi, rad.
    alpha: Vec<f64>,
    /// The coefficient at each angle, at most `MAX_COEFFICIENT` in magnitude.
    value: Vec<f64>,
    /// Slope of the interval that begins at each point but the last, finite, 1/rad.
    slope: Vec<f64>,
    /// Angles of the first lift peak to either side of zero, rad.
    stall: (f64, f64),
}

/// Why points do not make a curve.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
#[error("{problem}")]
pub struct CurveError {
    /// Index of the first wrong point; 0 if there are no points.
    pub point: usize,
    /// What is wrong with it.
    pub problem: CurveProblem,
}

/// What is wrong with a point of a curve. Angles in deg, as the files have them.
#[derive(Debug, Error, Clone, Copy, PartialEq)]
pub enum CurveProblem {
    /// A curve has at least the two ends of the circle.
    #[error("there are no angles; they must run from -180 to 180 deg")]
    Empty,
    /// More points than `MAX_POINTS`.
    #[error("there are more than {MAX_POINTS} angles; leave some out")]
    TooMany,
    /// There is no memory for the curve.
    #[error("{0}")]
    NoMemory(NoMemory),
    /// The coefficient is NaN or infinite.
    #[error("the coefficient at {alpha} deg is not a finite number")]
    NotFinite {
        /// deg.
        alpha: f64,
    },
    /// The coefficient is beyond `MAX_COEFFICIENT`.
    #[error(
        "the coefficient at {alpha} deg is {value:?}; it must lie between -{MAX_COEFFICIENT} and {MAX_COEFFICIENT}"
    )]
    TooLarge {
        /// deg.
        alpha: f64,
        /// The coefficient.
        value: f64,
    },
    /// A drag coefficient below 0.
    #[error("drag coefficient {0} must not be negative")]
    NegativeDrag(f64),
    /// The circle begins at -180 deg.
    #[error(
        "the first angle must be -180 deg, not {0}; `helicopter-rotor polar` extends a file to the full circle"
    )]
    Begin(f64),
    /// The circle ends at 180 deg.
    #[error(
        "the last angle must be 180 deg, not {0}; `helicopter-rotor polar` extends a file to the full circle"
    )]
    End(f64),
    /// Angles increase, by more than rounding.
    #[error("angle {alpha} deg must be above the one before ({before})")]
    NotIncreasing {
        /// deg.
        alpha: f64,
        /// deg.
        before: f64,
    },
    /// The slope to this point is too large for a number.
    #[error("the coefficient changes too steeply from {before} to {alpha} deg")]
    TooSteep {
        /// deg.
        alpha: f64,
        /// deg.
        before: f64,
    },
}

impl From<NoMemory> for CurveError {
    fn from(error: NoMemory) -> Self {
        Self {
            point: 0,
            problem: CurveProblem::NoMemory(error),
        }
    }
}

/// An angle of a file, deg, in rad. The ends of the circle are exact.
fn radians(degrees: f64) -> f64 {
    if degrees.abs() == 180.0 {
        PI.copysign(degrees)
    } else {
        degrees.to_radians()
    }
}

impl Curve {
    /// A curve through points (angle of attack in deg, coefficient).
    ///
    /// The values at -180 and 180 deg may differ: many published tables have such a jump.
    ///
    /// # Errors
    ///
    /// The first point that is wrong: angles must increase strictly from -180 to 180 deg, values
    /// must be at most `MAX_COEFFICIENT` in magnitude, and drag must not be negative. More than
    /// `MAX_POINTS` points, or no memory for them, are errors, too.
    pub fn try_from_degrees(
        coefficient: Coefficient,
        points: &[(f64, f64)],
    ) -> Result<Self, CurveError> {
        check(coefficient, points)?;
        let alpha = collect(points.iter().map(|p| radians(p.0)), "the angles")?;
        let value = collect(points.iter().map(|p| p.1), "the coefficients")?;
        let intervals = alpha.windows(2).zip(value.windows(2));
        let slope = collect(intervals.map(|(a, v)| slope(a, v)), "the slopes")?;
        let stall = (
            -first_peak(points.iter().rev().map(|p| (-p.0, -p.1))).to_radians(),
            first_peak(points.iter().copied()).to_radians(),
        );
        Ok(Self {
            alpha,
            value,
            slope,
            stall,
        })
    }

    /// The coefficient at an angle between -pi and pi, rad.
    pub fn value(&self, alpha: f64) -> f64 {
        let after = self.alpha.partition_point(|a| *a <= alpha).max(1) - 1;
        let slope = self.slope[after.min(self.slope.len() - 1)];
        self.value[after] + slope * (alpha - self.alpha[after])
    }

    /// What a look-up needs of each point: its angle and value, the slope behind it, and the next
    /// point's angle, which is infinite behind the last point.
    pub fn rows(&self) -> impl Iterator<Item = [f64; 4]> {
        let ends = self.alpha[1..].iter().chain([&f64::INFINITY]);
        let slopes = self.slope.iter().chain(self.slope.last());
        let points = self.alpha.iter().zip(&self.value).zip(slopes).zip(ends);
        points.map(|(((alpha, value), slope), end)| [*alpha, *value, *slope, *end])
    }

    /// The lowest coefficient between two angles between -pi and pi, rad.
    pub fn lowest_between(&self, from: f64, to: f64) -> f64 {
        let points = self.alpha.iter().zip(&self.value);
        let inside = points.filter(|(alpha, _)| (from..=to).contains(*alpha));
        let ends = self.value(from).min(self.value(to));
        inside.fold(ends, |lowest, (_, value)| lowest.min(*value))
    }

    /// Whether the coefficient differs from 0 at some angle.
    pub fn is_anywhere(&self) -> bool {
        self.value.iter().any(|v| *v != 0.0)
    }

    /// Angles of attack (negative, positive) at which the lift reaches its first peak; -pi and pi
    /// without lift. rad.
    pub fn stall_angles(&self) -> (f64, f64) {
        self.stall
    }
}

/// Slope of an interval between two angles, rad, with two values.
fn slope(alpha: &[f64], value: &[f64]) -> f64 {
    (value[1] - value[0]) / (alpha[1] - alpha[0])
}

/// All that a `Curve` relies on.
fn check(coefficient: Coefficient, points: &[(f64, f64)]) -> Result<(), CurveError> {
    if points.len() > MAX_POINTS {
        return Err(CurveError {
            point: MAX_POINTS,
            problem: CurveProblem::TooMany,
        });
    }
    let mut before = None;
    for (point, next) in points.iter().enumerate() {
        check_point(coefficient, before, *next).map_err(|problem| CurveError { point, problem })?;
        before = Some(*next);
    }
    let problem = match before {
        Some((180.0, _)) => return Ok(()),
        Some((alpha, _)) => CurveProblem::End(alpha),
        None => CurveProblem::Empty,
    };
    Err(CurveError {
        point: points.len().saturating_sub(1),
        problem,
    })
}

/// A point (angle of attack in deg, coefficient) after the one before it.
fn check_point(
    coefficient: Coefficient,
    before: Option<(f64, f64)>,
    (alpha, value): (f64, f64),
) -> Result<(), CurveProblem> {
    if !value.is_finite() {
        return Err(CurveProblem::NotFinite { alpha });
    }
    if value.abs() > MAX_COEFFICIENT {
        return Err(CurveProblem::TooLarge { alpha, value });
    }
    match coefficient {
        Coefficient::Drag if value < 0.0 => return Err(CurveProblem::NegativeDrag(value)),
        Coefficient::Drag | Coefficient::Lift => {}
    }
    let Some((before, value_before)) = before else {
        return match alpha {
            -180.0 => Ok(()),
            _ => Err(CurveProblem::Begin(alpha)),
        };
    };
    let ends = [radians(before), radians(alpha)];
    if ends[1].is_nan() || ends[1] <= ends[0] {
        return Err(CurveProblem::NotIncreasing { alpha, before });
    }
    if alpha > 180.0 {
        return Err(CurveProblem::End(alpha));
    }
    if !slope(&ends, &[value_before, value]).is_finite() {
        return Err(CurveProblem::TooSteep { alpha, before });
    }
    Ok(())
}

/// Angle (deg) of the first local maximum of lift above 0 and up to 30 deg. Without a local
/// maximum, the angle of the largest lift in that range; without lift, 180.
fn first_peak(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let mut best: (f64, f64) = (180.0, 0.0);
    for (alpha, lift) in points.filter(|p| p.0 > 0.0 && p.0 <= 30.0) {
        if lift > best.1 {
            best = (alpha, lift);
        } else if best.1 > 0.0 {
            break;
        }
    }
    best.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Against a search through all points.
    #[test]
    fn the_interval_is_found_at_every_angle() {
        let points = [
            (-180.0, 0.0),
            (-90.3, 2.0),
            (-90.2, 1.0),
            (0.1, 3.0),
            (0.2, -1.0),
            (180.0, 0.0),
        ];
        let curve = Curve::try_from_degrees(Coefficient::Lift, &points).unwrap();
        for i in -36_000..=36_000 {
            let degrees = f64::from(i) / 200.0;
            let after = points
                .iter()
                .position(|p| p.0 > degrees)
                .unwrap_or(points.len() - 1);
            let (a, b) = (points[after - 1], points[after]);
            let expected = a.1 + (degrees - a.0) / (b.0 - a.0) * (b.1 - a.1);
            let found = curve.value(degrees.to_radians());
            assert!(
                (found - expected).abs() < 1e-11,
                "{degrees}: {found} {expected}"
            );
        }
    }

    #[test]
    fn points_that_make_no_curve_are_refused_at_the_first_wrong_one() {
        // Two angles that are one in rad.
        let alike: [f64; 2] = [15.000_000_000_000_004, 15.000_000_000_000_005];
        assert!(alike[0] < alike[1] && alike[0].to_radians() == alike[1].to_radians());
        type Points<'a> = &'a [(f64, f64)];
        let cases: [(Points, usize, &str); 15] = [
            (&[], 0, "no angles"),
            (&[(-180.0, 1.0)], 0, "last angle must be 180 deg, not -180"),
            (
                &[(-170.0, 1.0), (180.0, 1.0)],
                0,
                "must be -180 deg, not -170",
            ),
            (
                &[(f64::NAN, 1.0), (180.0, 1.0)],
                0,
                "must be -180 deg, not NaN",
            ),
            (
                &[(-180.0, 1.0), (170.0, 1.0)],
                1,
                "must be 180 deg, not 170",
            ),
            (
                &[(-180.0, 1.0), (190.0, 1.0)],
                1,
                "must be 180 deg, not 190",
            ),
            (
                &[(-180.0, 1.0), (-180.0, 1.0)],
                1,
                "above the one before (-180)",
            ),
            (&[(-180.0, 1.0), (f64::NAN, 1.0)], 1, "angle NaN deg"),
            (
                &[(-180.0, 1.0), (alike[0], 1.0), (alike[1], 2.0)],
                2,
                "above the one before (15.000000000000004)",
            ),
            (
                &[(-180.0, f64::NAN), (180.0, 1.0)],
                0,
                "not a finite number",
            ),
            (
                &[(-180.0, 0.0), (180.0, f64::INFINITY)],
                1,
                "not a finite number",
            ),
            (
                &[(-180.0, 0.0), (0.0, 0.0), (1e-310, 10.0), (180.0, 0.0)],
                2,
                "too steeply",
            ),
            (
                &[(-180.0, 0.0), (0.0, 1e300), (180.0, 0.0)],
                1,
                "the coefficient at 0 deg is 1e300; it must lie between -10 and 10",
            ),
            (
                &[(-180.0, 0.0), (0.0, -10.5), (180.0, 0.0)],
                1,
                "at 0 deg is -10.5",
            ),
            (
                &[(-180.0, 0.1), (0.0, -0.1), (180.0, 0.1)],
                1,
                "drag coefficient -0.1",
            ),
        ];
        for (points, place, part) in cases {
            let error = Curve::try_from_degrees(Coefficient::Drag, points).unwrap_err();
            assert_eq!(error.point, place, "{points:?}");
            assert!(error.to_string().contains(part), "{points:?}: {error}");
        }
        let negative_lift = [(-180.0, 0.1), (0.0, -10.0), (180.0, 10.0)];
        assert!(Curve::try_from_degrees(Coefficient::Lift, &negative_lift).is_ok());
        let angle = |i: u32| -180.0 + 360.0 * f64::from(i) / 70_000.0;
        let many: Vec<_> = (0..=70_000).map(|i| (angle(i), 0.0)).collect();
        let error = Curve::try_from_degrees(Coefficient::Lift, &many).unwrap_err();
        assert_eq!(error.problem, CurveProblem::TooMany);
    }
}
