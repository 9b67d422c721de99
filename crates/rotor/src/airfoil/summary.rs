//! What follows from a section's data alone, found once when the file is read.

use super::{Axis, Data, Similarity, range};
use core::f64::consts::PI;

/// Margin for rounding between layers, as a fraction.
const MARGIN: f64 = 1e-9;

/// For data that do not depend on the flow.
const ANY_FLOW: Similarity<f64> = Similarity {
    reynolds: 1.0,
    mach: 0.0,
};

/// Facts about a section that hold at every Reynolds and Mach number. They spare look-ups in flows
/// far from stall and never change an answer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Lowest and highest Reynolds number; none if the coefficients do not depend on it.
    pub reynolds: Option<(f64, f64)>,
    /// Whether the section has lift at any angle.
    pub lifts: bool,
    /// Between these angles of attack, rad, no layer is stalled.
    pub unstalled: (f64, f64),
    /// The lift as one line, where it does not depend on the flow: its slope, 1/rad, and its angle
    /// of zero lift, rad.
    pub line: Option<(f64, f64)>,
    /// Below this drag coefficient the drag is less than that at either stall angle.
    pub drag_below_stall: f64,
}

impl Summary {
    pub(super) fn of(data: &Data) -> Self {
        let reynolds = range(data, Axis::Reynolds);
        match data {
            Data::Tables { lift, drag } => {
                let (mut negative, mut positive) = ((0.0, -PI), (PI, 0.0));
                for (n, p) in lift.curves().map(|curve| curve.stall_angles()) {
                    negative = (f64::min(negative.0, n), f64::max(negative.1, n));
                    positive = (f64::min(positive.0, p), f64::max(positive.1, p));
                }
                let at_stall = drag.curves().flat_map(|curve| {
                    [negative, positive].map(|(from, to)| curve.lowest_between(from, to))
                });
                Self {
                    reynolds,
                    lifts: lift.is_anywhere(),
                    unstalled: (negative.1 * (1.0 - MARGIN), positive.0 * (1.0 - MARGIN)),
                    line: lift.is_single().then(|| lift.line(ANY_FLOW)),
                    drag_below_stall: at_stall.fold(f64::INFINITY, f64::min) * (1.0 - MARGIN),
                }
            }
            // The stall angle of laws varies continuously with the Reynolds number.
            Data::Laws(_) => Self {
                reynolds,
                lifts: true,
                unstalled: (0.0, 0.0),
                line: None,
                drag_below_stall: 0.0,
            },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::{Airfoil, Lift, SectionModel, Similarity, polar, wrapped};
    use crate::numbers::Dual64;
    use crate::{compressibility::Compressibility, numbers::Scalar};

    /// Two layers whose stall angles and drag differ, and one that stalls at a point with the least
    /// drag of all.
    const POLARS: [&str; 2] = [
        "polar 1\nreynolds 1e5\n-180 0 0.02\n-8 -1 0.04\n0 0 0.01\n10 1 0.04\n90 0 2\n180 0 0.02\n\
         reynolds 1e6\n-180 0 0.02\n-14 -1.4 0.02\n0 0 0.008\n16 1.5 0.05\n90 0 2\n180 0 0.02\n",
        "polar 1\nreynolds 1e5\n-180 0 0.3\n-10 -1 0.01\n0 0 0.02\n10 1 0.03\n90 0 2\n180 0 0.3\n",
    ];

    /// The drag and the stall as they are without the summary.
    fn plainly<S: Scalar>(
        airfoil: &Airfoil,
        model: &SectionModel,
        alpha: S,
        flow: Similarity<S>,
    ) -> S {
        let mut long = airfoil.clone();
        long.summary.drag_below_stall = 0.0;
        long.drag_coefficient(model, alpha, flow)
    }

    /// The line of the lift as it is without the summary.
    fn line_plainly<S: Scalar>(
        airfoil: &Airfoil,
        model: &SectionModel,
        flow: Similarity<S>,
    ) -> (S, S) {
        let mut long = airfoil.clone();
        long.summary.line = None;
        long.lift_line(model, 0.0, flow)
    }

    #[test]
    fn the_summary_changes_no_answer() {
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.2,
        };
        let (mut spared, mut lines) = (0, 0);
        for airfoil in POLARS.map(|text| polar::parse(text, "test").unwrap()) {
            for i in -1800..=1800 {
                let alpha = f64::from(i) * 0.1_f64.to_radians();
                for reynolds in [2e4, 9.9e4, 1e5, 3e5, 1e6, 5e6] {
                    let flow = Similarity {
                        reynolds: Dual64::new(reynolds, 1.0),
                        mach: Dual64::from_re(0.0),
                    };
                    let alpha = Dual64::new(alpha, 0.3);
                    let drag = airfoil.drag_coefficient(&model, alpha, flow);
                    assert_eq!(drag, plainly(&airfoil, &model, alpha, flow));
                    let line = airfoil.lift_line(&model, 0.0, flow);
                    assert_eq!(line, line_plainly(&airfoil, &model, flow));
                    lines += u32::from(airfoil.summary.line.is_some());
                    let (negative, positive) = airfoil.stall_angles(flow);
                    let angle = wrapped(alpha).re;
                    if airfoil.is_unstalled(angle) {
                        spared += 1;
                        assert!(angle >= negative.re && angle <= positive.re, "{angle}");
                    }
                }
            }
        }
        assert!(spared > 1000 && lines > 1000, "the summary spares nothing");
    }
}
