//! Section data: lift and drag coefficients over the full circle of angles of attack, for one or
//! more Reynolds or Mach numbers, read from files.

mod c81;
mod combi;
#[cfg(test)]
mod fuzz;
mod laws;
mod layers;
mod polar;
mod records;
mod table;

pub use layers::Axis;
pub use table::{Curve, Table, wrapped};

use laws::{Laws, Line};
use layers::Layers;

use super::{compressibility::Compressibility, scalar::Scalar, text_file};
use core::f64::consts::PI;
use std::path::Path;
use thiserror::Error;

/// Reynolds numbers below this count as this in the drag correction, which was made for
/// boundary layers, not for creeping flow.
const LOWEST_CORRECTED_REYNOLDS: f64 = 1e4;

/// What is wrong with an airfoil file, and where.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum AirfoilError {
    #[error("airfoil file {file}: cannot be read ({reason}); give a file that exists and is text")]
    Unreadable { file: String, reason: String },
    #[error("airfoil file {file}, line {line}: {problem}")]
    Malformed {
        file: String,
        line: usize,
        problem: String,
    },
    #[error("airfoil file {file}, line {line}, column {column}: {problem}")]
    MalformedField {
        file: String,
        line: usize,
        column: usize,
        problem: String,
    },
}

/// Where a section's lift comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lift {
    /// The airfoil's table; of a file of laws, the lines A and C (see `laws`).
    Table,
    /// Flat plate: cl = 2 pi sin(alpha) (thesis eq. 49).
    TwoPi,
    /// One lift slope by the pitch of the element (thesis 3.5.1), for a file of laws only.
    SlopesByReynolds,
}

/// How a section's coefficients are made from its table.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionModel {
    pub lift: Lift,
    pub compressibility: Compressibility,
    /// Exponent n, 0 to 0.5, of the drag correction outside the table's Reynolds numbers.
    pub drag_reynolds_exponent: f64,
}

/// The flow at a section: Reynolds number of the chord and Mach number, both >= 0.
#[derive(Debug, Clone, Copy)]
pub struct Similarity<S> {
    pub reynolds: S,
    pub mach: S,
}

/// An airfoil as read from a file. Angles in rad, from -pi to pi.
#[derive(Debug, Clone, PartialEq)]
pub struct Airfoil {
    name: String,
    data: Data,
}

/// The two kinds of section data.
#[derive(Debug, Clone, PartialEq)]
enum Data {
    Tables { lift: Table, drag: Table },
    Laws(Laws),
}

impl Airfoil {
    /// Reads a file: a CombiTable of laws if it begins with `#1`, else polars by Reynolds number if its
    /// name ends in `.polar`, else C81.
    pub fn read(path: &Path) -> Result<Self, AirfoilError> {
        let file = path.display().to_string();
        let text = text_file::read(path).map_err(|reason| AirfoilError::Unreadable {
            file: file.clone(),
            reason,
        })?;
        if combi::is_combi(&text) {
            combi::parse(&text, &file)
        } else if path
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("polar"))
        {
            polar::parse(&text, &file)
        } else {
            c81::parse(&text, &file)
        }
    }

    /// What the file calls the section.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether the file gives laws, which `Lift::SlopesByReynolds` needs.
    pub fn has_laws(&self) -> bool {
        matches!(self.data, Data::Laws(_))
    }

    /// Lowest and highest Reynolds or Mach number of the file, if its coefficients depend on it. A
    /// single Mach number is none: a rule takes the coefficients to others.
    pub fn range(&self, axis: Axis) -> Option<(f64, f64)> {
        let (lift, drag) = match &self.data {
            Data::Tables { lift, drag } => (lift.layers(), drag.layers()),
            Data::Laws(laws) => (laws.layers(), laws.layers()),
        };
        let counts = |layers: &&Layers| axis == Axis::Reynolds || layers.resolves_mach();
        let mut ranges = [lift, drag]
            .into_iter()
            .filter(counts)
            .filter_map(|layers| layers.range(axis));
        let first = ranges.next()?;
        Some(ranges.fold(first, |a, b| (a.0.max(b.0), a.1.min(b.1))))
    }

    /// Lift coefficient at angle of attack `alpha` (rad, any value) of an element with the pitch
    /// `pitch` (rad), on which only `Lift::SlopesByReynolds` depends.
    pub fn lift_coefficient<S: Scalar>(
        &self,
        model: &SectionModel,
        pitch: f64,
        alpha: S,
        flow: Similarity<S>,
    ) -> S {
        let lift = match (&self.data, model.lift) {
            (_, Lift::TwoPi) => alpha.sin() * (2.0 * PI),
            (Data::Tables { lift, .. }, _) => lift.value(alpha, flow),
            (Data::Laws(laws), _) => laws.lift(model.line(pitch), alpha, flow),
        };
        self.rule(model).correct(lift, flow.mach)
    }

    /// The lift coefficient at a Mach number over the table's, which is `lift`.
    pub fn compressibility<S: Scalar>(&self, model: &SectionModel, lift: S, mach: S) -> S {
        S::one() / self.rule(model).divisor(lift, mach)
    }

    /// A table of several Mach numbers takes the place of a rule.
    fn rule(&self, model: &SectionModel) -> Compressibility {
        match &self.data {
            Data::Tables { lift, .. }
                if model.lift == Lift::Table && lift.layers().resolves_mach() =>
            {
                Compressibility::None
            }
            _ => model.compressibility,
        }
    }

    /// Drag coefficient at angle of attack `alpha` (rad, any value).
    ///
    /// Outside the table's Reynolds numbers the nearest one's drag is scaled with
    /// (Re_table/Re)^n: Yamauchi & Johnson 1983, "Trends of Reynolds Number Effects on
    /// Two-Dimensional Airfoil Characteristics for Helicopter Rotor Analyses", NASA TM-84363,
    /// n = 0.2 for a turbulent boundary layer. Beyond stall, where the drag is that of pressure
    /// and knows little of the boundary layer, only the part that is not above the drag at the
    /// stall angle is scaled. Bodies without lift have pressure drag only, and tables by Mach number
    /// know no Reynolds number; both stay as they are.
    pub fn drag_coefficient<S: Scalar>(
        &self,
        model: &SectionModel,
        alpha: S,
        flow: Similarity<S>,
    ) -> S {
        let drag = self.table_drag(alpha, flow);
        let Some((lowest, highest)) = self.range(Axis::Reynolds) else {
            return drag;
        };
        let reynolds = flow.reynolds.at_least(LOWEST_CORRECTED_REYNOLDS);
        let is_off = model.drag_reynolds_exponent == 0.0 || !self.lifts();
        if is_off || !(reynolds.is_below(lowest) || reynolds.is_above(highest)) {
            return drag;
        }
        let ratio = S::constant(reynolds.value().clamp(lowest, highest)) / reynolds;
        let factor = (ratio.ln() * model.drag_reynolds_exponent).exp();
        let (negative, positive) = self.stall_angles(flow);
        let stall = if wrapped(alpha).is_below(0.0) {
            negative
        } else {
            positive
        };
        let at_stall = self.table_drag(stall, flow);
        let scaled = if (drag - at_stall).is_above(0.0) {
            at_stall
        } else {
            drag
        };
        drag + scaled * (factor - 1.0)
    }

    /// As the file has it.
    fn table_drag<S: Scalar>(&self, alpha: S, flow: Similarity<S>) -> S {
        match &self.data {
            Data::Tables { drag, .. } => drag.value(alpha, flow),
            Data::Laws(laws) => laws.drag(alpha, flow),
        }
    }

    /// Whether the section has lift at any angle.
    fn lifts(&self) -> bool {
        match &self.data {
            Data::Tables { lift, .. } => lift.is_anywhere(),
            Data::Laws(_) => true,
        }
    }

    /// Slope of one line for the lift, 1/rad, and the angle of zero lift on that line, rad. Of a table,
    /// the line through the lift at -3 and +3 deg of angle of attack: thesis section 3.5.1, line A. Of
    /// laws, line A, or with `Lift::SlopesByReynolds` line A or B by the pitch of the element (rad).
    pub fn lift_line<S: Scalar>(
        &self,
        model: &SectionModel,
        pitch: f64,
        flow: Similarity<S>,
    ) -> (S, S) {
        let none = S::zero();
        let lift = match (&self.data, model.lift) {
            (_, Lift::TwoPi) => return (S::constant(2.0 * PI), none),
            (Data::Laws(laws), _) => return (laws.slope(model.line(pitch), flow), none),
            (Data::Tables { lift, .. }, _) => lift,
        };
        let edge = 3.0_f64.to_radians();
        let at = |alpha: f64| lift.value(S::constant(alpha), flow);
        let (low, high) = (at(-edge), at(edge));
        let slope = (high - low) / (2.0 * edge);
        if slope.value() == 0.0 {
            return (none, none);
        }
        (slope, (high + low) * -0.5 / slope)
    }

    /// Angles of attack (negative, positive; rad) at which the lift reaches its first peak; -pi
    /// and pi for a section without lift, which cannot stall.
    pub fn stall_angles<S: Scalar>(&self, flow: Similarity<S>) -> (S, S) {
        match &self.data {
            Data::Tables { lift, .. } => lift.stall_angles(flow),
            Data::Laws(laws) => {
                let stall = laws.stall(flow);
                (-stall, stall)
            }
        }
    }
}

impl SectionModel {
    /// Which of the lines of a file of laws the lift follows.
    fn line(&self, pitch: f64) -> Line {
        if self.lift == Lift::SlopesByReynolds {
            Line::ByPitch(pitch)
        } else {
            Line::Broken
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use num_dual::Dual64;

    fn drag(alpha_deg: f64, reynolds: f64, exponent: f64) -> f64 {
        let text = "polar 1\nreynolds 1e5\n-180 0 0.02\n-10 -1 0.04\n0 0 0.01\n10 1 0.04\n90 0 2\n180 0 0.02\n";
        let airfoil = polar::parse(text, "test").unwrap();
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: exponent,
        };
        let flow = Similarity {
            reynolds,
            mach: 0.0,
        };
        airfoil.drag_coefficient(&model, alpha_deg.to_radians(), flow)
    }

    #[test]
    fn drag_outside_the_reynolds_range_follows_the_power_law_up_to_stall() {
        assert_eq!(drag(0.0, 1e5, 0.2), 0.01);
        assert_eq!(drag(0.0, 2e4, 0.0), 0.01);
        assert!((drag(0.0, 2e4, 0.2) / (0.01 * libm::pow(5.0, 0.2)) - 1.0).abs() < 1e-14);
        assert!((drag(0.0, 1e7, 0.2) / (0.01 * libm::pow(0.01, 0.2)) - 1.0).abs() < 1e-14);
        assert_eq!(drag(0.0, 10.0, 0.2), drag(0.0, 1e4, 0.2), "the floor");
        let added = drag(90.0, 2e4, 0.2) - 2.0;
        assert!(
            (added / (0.04 * (libm::pow(5.0, 0.2) - 1.0)) - 1.0).abs() < 1e-12,
            "{added}"
        );
    }

    /// At the end of the file's Reynolds numbers the power law begins on the side that lies beyond it.
    #[test]
    fn drag_at_the_end_of_the_reynolds_range_changes_by_the_power_law_beyond_it() {
        let text = "polar 1\nreynolds 1e5\n-180 0 0.02\n-10 -1 0.04\n0 0 0.01\n10 1 0.04\n90 0 2\n180 0 0.02\nreynolds 1e6\n-180 0 0.02\n-10 -1 0.04\n0 0 0.01\n10 1 0.04\n90 0 2\n180 0 0.02\n";
        let airfoil = polar::parse(text, "test").unwrap();
        let model = SectionModel {
            lift: Lift::Table,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.2,
        };
        let slope = |reynolds: f64, change: f64| {
            let flow = Similarity {
                reynolds: Dual64::new(reynolds, change),
                mach: Dual64::from_re(0.0),
            };
            airfoil
                .drag_coefficient(&model, Dual64::from_re(0.0), flow)
                .eps
        };
        let law = |reynolds: f64, change: f64| -0.2 * 0.01 / reynolds * change;
        assert!((slope(1e5, -1.0) / law(1e5, -1.0) - 1.0).abs() < 1e-12);
        assert!((slope(1e6, 1.0) / law(1e6, 1.0) - 1.0).abs() < 1e-12);
        // Inside, both tables are alike.
        assert_eq!((slope(1e5, 1.0), slope(1e6, -1.0)), (0.0, 0.0));
    }
}
