//! Brings the points of a polar into order. Values stay as they are, but for rows at one angle that
//! nearly agree, which give their mean.

use super::{Point, Polar};
use crate::Failure;

/// Angles this near, deg, are one.
const SAME_ANGLE: f64 = 1e-6;

/// Lift and drag of one angle may differ this much between two runs of a program; the mean is
/// taken.
const SAME_LIFT: f64 = 0.01;
const SAME_DRAG: f64 = 0.1;

/// Sorts the points by angle between -180 and 180 deg, without repetitions, and mirrors those of a
/// symmetric section.
pub fn clean(
    polar: &mut Polar,
    is_symmetric: bool,
    notes: &mut Vec<String>,
) -> Result<(), Failure> {
    let points = &mut polar.points;
    let file = &polar.source;
    if let Some(bad) = points.iter().find(|p| p.drag < 0.0) {
        return Err(Failure(format!(
            "{file}: the drag coefficient at {} deg is {}; drag cannot be negative: correct the row or leave it out",
            bad.alpha, bad.drag
        )));
    }
    if points.iter().any(|p| p.alpha > 180.0 + SAME_ANGLE) {
        for point in points.iter_mut().filter(|p| p.alpha > 180.0 + SAME_ANGLE) {
            point.alpha -= 360.0;
        }
        notes.push(format!(
            "{file}: angles above 180 deg are written as those below 0 that they are"
        ));
    }
    for point in points.iter_mut() {
        let nearest = (point.alpha * 1e6).round() / 1e6;
        if (point.alpha - nearest).abs() < 1e-9 {
            point.alpha = nearest;
        }
        if (point.alpha.abs() - 180.0).abs() < SAME_ANGLE {
            point.alpha = 180f64.copysign(point.alpha);
        }
        if point.alpha.abs() > 180.0 || !point.alpha.is_finite() {
            return Err(Failure(format!(
                "{file}: {} deg is no angle of attack; angles lie between -180 and 180 deg",
                point.alpha
            )));
        }
    }
    points.sort_by(|a, b| a.alpha.total_cmp(&b.alpha));
    *points = without_repetitions(points, file, notes)?;
    if is_symmetric {
        *points = mirrored(points, file)?;
    }
    let range = points
        .first()
        .zip(points.last())
        .map(|(a, b)| (a.alpha, b.alpha));
    match range {
        Some((low, high)) if low < 0.0 && high > 0.0 => Ok(()),
        Some((low, high)) if low >= 0.0 && high > 0.0 => Err(Failure(format!(
            "{file} has no angles below 0; if the section is symmetric, add --symmetric, which mirrors the others, else compute the polar below 0, too"
        ))),
        Some((_, high)) => Err(Failure(format!(
            "{file} has no angles above {high} deg; a polar needs angles to both sides of 0"
        ))),
        None => Err(Failure(format!(
            "{file} has no rows with an angle, lift and drag"
        ))),
    }
}

fn without_repetitions(
    points: &[Point],
    file: &str,
    notes: &mut Vec<String>,
) -> Result<Vec<Point>, Failure> {
    let mut kept: Vec<Point> = Vec::new();
    let (mut same, mut mean) = (0, 0);
    // Number of rows in the last of those kept.
    let mut rows = 1.0;
    for point in points {
        let Some(last) = kept
            .last_mut()
            .filter(|p| point.alpha - p.alpha < SAME_ANGLE)
        else {
            kept.push(*point);
            rows = 1.0;
            continue;
        };
        if (last.lift, last.drag) == (point.lift, point.drag) {
            same += 1;
            continue;
        }
        let is_near = (last.lift - point.lift).abs() <= SAME_LIFT
            && (last.drag - point.drag).abs() <= SAME_DRAG * last.drag.max(point.drag);
        if !is_near {
            return Err(Failure(format!(
                "{file} has two different rows at {} deg (lift {} and {}, drag {} and {}); leave one out",
                point.alpha, last.lift, point.lift, last.drag, point.drag
            )));
        }
        rows += 1.0;
        last.lift += (point.lift - last.lift) / rows;
        last.drag += (point.drag - last.drag) / rows;
        mean += 1;
    }
    if same > 0 {
        notes.push(format!("{file}: repeated rows left out: {same}"));
    }
    if mean > 0 {
        notes.push(format!(
            "{file}: of rows at one angle that differ by less than {SAME_LIFT} in lift and 10 % in drag the mean is taken: {mean}"
        ));
    }
    Ok(kept)
}

/// The points of a symmetric section, of which those from 0 on are known.
fn mirrored(points: &[Point], file: &str) -> Result<Vec<Point>, Failure> {
    if let Some(point) = points.first().filter(|p| p.alpha < 0.0) {
        return Err(Failure(format!(
            "{file} has angles below 0, such as {} deg; leave --symmetric out",
            point.alpha
        )));
    }
    let at_zero = points.first().filter(|p| p.alpha == 0.0);
    if let Some(point) = at_zero.filter(|p| p.lift.abs() > SAME_LIFT) {
        return Err(Failure(format!(
            "{file} has a lift coefficient of {} at 0 deg, so the section is not symmetric; leave --symmetric out",
            point.lift
        )));
    }
    let others = points.iter().filter(|p| p.alpha > 0.0);
    let mirror = others.clone().rev().map(|p| Point {
        alpha: -p.alpha,
        lift: -p.lift,
        drag: p.drag,
    });
    let middle = at_zero.map(|p| Point { lift: 0.0, ..*p });
    Ok(mirror.chain(middle).chain(others.copied()).collect())
}
