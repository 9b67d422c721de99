//! Continues a polar to the full circle of angles of attack.
//!
//! The data stay as they are. Each side of a polar is continued from its last point, the match
//! point; for negative angles the section counts as turned upside down. The methods are those with
//! which the tables in the FMU are made (`provenance/airfoil-tables`).

// The last bits do not matter: values are written with five decimals.
#![allow(clippy::disallowed_methods)]

use super::{Method, Point, Polar, Row};
use crate::Failure;

/// Drag coefficient across the flow of a long flat plate: 1.11 + 0.018 AR with AR = 50, the largest
/// aspect ratio of Viterna & Corrigan (1982).
pub const CD_MAX: f64 = 2.01;

/// Range in which the data go over into the flat plate, deg.
pub const BLEND: f64 = 20.0;

/// Lift of reversed flow over that at the mirrored angle, as in NREL's AirfoilPrep and CCBlade
/// (`airfoilprep.py`, `cl_adj`).
const REVERSED_LIFT: f64 = 0.7;

/// Angles from here on have steps of 5 deg, deg.
const COARSE: f64 = 30.0;

/// How polars are continued.
#[derive(Debug, Clone, Copy)]
pub struct How {
    pub method: Method,
    pub cd_max: f64,
    /// deg.
    pub blend: f64,
}

impl How {
    /// The method in words, with its source.
    pub fn in_words(&self) -> String {
        let Self {
            method,
            cd_max,
            blend,
        } = self;
        match method {
            Method::Viterna => format!(
                "Viterna & Corrigan (1982), \"Fixed pitch rotor performance of large horizontal axis wind turbines\", NASA CP-2230, from the last angle of the data to 90 deg with CDmax = {cd_max}. From there to 180 deg minus the last angle as in NREL's AirfoilPrep: drag mirrored about 90 deg, lift mirrored and times -{REVERSED_LIFT}; then lift linear to 180 deg. For negative angles the section counts as turned upside down. Drag is held at or above the least drag of the data."
            ),
            Method::FlatPlate => format!(
                "the normal force of a flat plate, CDmax sin(alpha) with CDmax = {cd_max}: cl = CDmax/2 sin(2 alpha), cd = CDmax sin(alpha)^2, the terms A1 and B1 of Viterna & Corrigan (1982), NASA CP-2230. Over {blend} deg beyond the last angle of the data their last values go over into it. Drag is held at or above the least drag of the data."
            ),
        }
    }
}

/// The points of a polar and those that continue them from -180 to 180 deg.
pub fn to_full_circle(
    polar: &Polar,
    how: &How,
    notes: &mut Vec<String>,
) -> Result<Vec<Row>, Failure> {
    let points = &polar.points;
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return Err(Failure(format!("{} has no rows", polar.source)));
    };
    // As AirfoilPrep: no section is blunter than its own data.
    let cd_max = points.iter().map(|p| p.drag).fold(how.cd_max, f64::max);
    if cd_max > how.cd_max {
        notes.push(format!(
            "{}: CDmax is {cd_max}, the largest drag of the data, instead of {}",
            polar.source, how.cd_max
        ));
    }
    let how = How { cd_max, ..*how };
    let least = points.iter().map(|p| p.drag).fold(f64::INFINITY, f64::min);
    let side = |end: Point| Side {
        how: &how,
        end,
        least,
    };
    let (above, below) = (side(*last), side(turned(*first)));
    let back = back(first, last, [&above, &below], polar, notes);
    let upper = above.continued(back);
    let lower = below.continued(Point {
        lift: -back.lift,
        ..back
    });
    warn_before_stall(polar, notes);
    let extended = |point: Point| Row {
        point,
        is_extended: true,
    };
    let data = |point: &Point| Row {
        point: *point,
        is_extended: false,
    };
    let lower = lower.into_iter().rev().map(turned).map(extended);
    let mut rows: Vec<Row> = lower.chain(points.iter().map(data)).collect();
    rows.extend(upper.into_iter().map(extended));
    // Where a file has one end of the circle, or two that differ, both get the same values.
    for row in &mut rows {
        if row.point.alpha.abs() == 180.0 {
            let point = Point {
                alpha: row.point.alpha,
                ..back
            };
            row.is_extended |= row.point != point;
            row.point = point;
        }
    }
    Ok(rows)
}

/// A method can only guess the stall that the data do not reach.
fn warn_before_stall(polar: &Polar, notes: &mut Vec<String>) {
    let points = &polar.points;
    let (Some(first), Some(last)) = (points.first(), points.last()) else {
        return;
    };
    let has_lift = points.iter().any(|p| p.lift != 0.0);
    for (end, word, is_beyond) in [
        (first, "falls", points.iter().all(|p| p.lift >= first.lift)),
        (last, "rises", points.iter().all(|p| p.lift <= last.lift)),
    ] {
        if has_lift && is_beyond && end.alpha.abs() < 90.0 {
            notes.push(format!(
                "{}: the data end at {} deg, where the lift still {word}; the stall beyond is the method's and not the section's",
                polar.source, end.alpha
            ));
        }
    }
}

/// The point of the section turned upside down.
fn turned(point: Point) -> Point {
    Point {
        alpha: -point.alpha,
        lift: -point.lift,
        drag: point.drag,
    }
}

/// The values at 180 deg, which is also -180 deg: those of the data, if they reach one of the two.
fn back(
    first: &Point,
    last: &Point,
    sides: [&Side; 2],
    polar: &Polar,
    notes: &mut Vec<String>,
) -> Point {
    let mean = |a: f64, b: f64| 0.5 * (a + b);
    let (lift, drag) = match (first.alpha == -180.0, last.alpha == 180.0) {
        (true, true) => {
            let (lift, drag) = (mean(first.lift, last.lift), mean(first.drag, last.drag));
            if (first.lift, first.drag) != (last.lift, last.drag) {
                notes.push(format!(
                    "{}: -180 and 180 deg, which are one angle, have lift {} and {} and drag {} and {}; their means are written",
                    polar.source, first.lift, last.lift, first.drag, last.drag
                ));
            }
            (lift, drag)
        }
        (true, false) => (first.lift, first.drag),
        (false, true) => (last.lift, last.drag),
        (false, false) => (0.0, mean(sides[0].drag_behind(), sides[1].drag_behind())),
    };
    Point {
        alpha: 180.0,
        lift,
        drag,
    }
}

/// The continuation of one side, of which the angles are positive.
struct Side<'a> {
    how: &'a How,
    /// The last point of the data.
    end: Point,
    /// The least drag of the data.
    least: f64,
}

impl Side<'_> {
    /// The drag at 180 deg by the method.
    fn drag_behind(&self) -> f64 {
        match self.how.method {
            Method::Viterna if self.end.alpha < 90.0 => self.viterna_drag(0.0),
            Method::Viterna | Method::FlatPlate => self.least,
        }
    }

    /// The points beyond the data to 180 deg, where they are as `back`.
    fn continued(&self, back: Point) -> Vec<Point> {
        if self.end.alpha >= 180.0 {
            return Vec::new();
        }
        // Neither method says how data from the rear half of the circle go on.
        if self.end.alpha >= 90.0 {
            return vec![back];
        }
        let point = match self.how.method {
            Method::Viterna => Self::viterna,
            Method::FlatPlate => Self::flat_plate,
        };
        let angles = self.angles();
        angles
            .into_iter()
            .map(|alpha| point(self, alpha, back))
            .collect()
    }

    /// The angles beyond the data: whole degrees up to 30 and where the data go over into the
    /// method, then every 5 deg, and where the method changes.
    fn angles(&self) -> Vec<f64> {
        let end = self.end.alpha;
        let fine = match self.how.method {
            Method::Viterna => COARSE,
            Method::FlatPlate => COARSE.max(end + self.how.blend),
        };
        let mut angles: Vec<f64> = (0..=180)
            .map(f64::from)
            .filter(|a| *a > end && (*a <= fine || a % 5.0 == 0.0))
            .collect();
        match self.how.method {
            Method::Viterna => angles.push(180.0 - end),
            Method::FlatPlate => angles.push(end + self.how.blend),
        }
        angles.sort_by(f64::total_cmp);
        angles.dedup();
        angles
    }

    fn viterna(&self, alpha: f64, back: Point) -> Point {
        let end = self.end.alpha;
        let folded = alpha.min(180.0 - alpha);
        let drag = self.viterna_drag(folded);
        let behind = alpha - (180.0 - end);
        let (lift, drag) = if behind > 0.0 {
            let weight = behind / end;
            let lift = -REVERSED_LIFT * self.end.lift;
            (
                lift + weight * (back.lift - lift),
                drag + weight * (back.drag - self.drag_behind()),
            )
        } else if alpha > 90.0 {
            (-REVERSED_LIFT * self.viterna_lift(folded), drag)
        } else {
            (self.viterna_lift(folded), drag)
        };
        Point { alpha, lift, drag }
    }

    /// CL = A1 sin 2 alpha + A2 cos^2 alpha / sin alpha, from the last angle of the data to 90 deg.
    fn viterna_lift(&self, alpha: f64) -> f64 {
        let Point {
            alpha: end, lift, ..
        } = self.end;
        let (sin, cos) = end.to_radians().sin_cos();
        let a2 = (lift - self.how.cd_max * sin * cos) * sin / (cos * cos);
        let (sin, cos) = alpha.to_radians().sin_cos();
        self.how.cd_max * sin * cos + a2 * cos * cos / sin
    }

    /// CD = B1 sin^2 alpha + B2 cos alpha, at or above the least drag of the data.
    fn viterna_drag(&self, alpha: f64) -> f64 {
        let Point {
            alpha: end, drag, ..
        } = self.end;
        let (sin, cos) = end.to_radians().sin_cos();
        let b2 = (drag - self.how.cd_max * sin * sin) / cos;
        let (sin, cos) = alpha.to_radians().sin_cos();
        (self.how.cd_max * sin * sin + b2 * cos).max(self.least)
    }

    fn flat_plate(&self, alpha: f64, back: Point) -> Point {
        let Point {
            alpha: end,
            lift,
            drag,
        } = self.end;
        let (sin, cos) = alpha.to_radians().sin_cos();
        let plate = Point {
            alpha,
            lift: self.how.cd_max * sin * cos,
            drag: (self.how.cd_max * sin * sin).max(self.least),
        };
        // Begins and ends without a kink.
        let x = ((alpha - end) / self.how.blend).clamp(0.0, 1.0);
        let weight = x * x * (3.0 - 2.0 * x);
        // The end of the data may be that of the circle.
        let x = ((alpha - 180.0 + self.how.blend) / self.how.blend).clamp(0.0, 1.0);
        let behind = x * x * (3.0 - 2.0 * x);
        Point {
            alpha,
            lift: lift + weight * (plate.lift - lift) + behind * back.lift,
            drag: drag + weight * (plate.drag - drag) + behind * (back.drag - self.least),
        }
    }
}
