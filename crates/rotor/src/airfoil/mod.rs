//! Section data: lift and drag coefficients over the full circle of angles of attack, for one or
//! more Reynolds or Mach numbers, read from files.
//!
//! Each file format has its own file here and a row in `formats`. What a format reads becomes
//! curves in layers (`table`) or laws (`laws`), which check themselves all that they rely on.

mod c81;
mod combi;
mod curve;
mod foreign;
mod formats;
#[cfg(test)]
mod fuzz;
mod laws;
mod layers;
mod lookup;
mod polar;
mod raw;
mod records;
mod summary;
mod table;

pub use curve::{Coefficient, Curve, CurveError, CurveProblem};
pub use foreign::Foreign;
pub use layers::{Axis, Layers, LayersError, LayersProblem};
pub use raw::RawPolar;
pub use table::{Table, TableError, wrapped};

use laws::{Laws, Line};
use summary::Summary;

use super::{
    compressibility::Compressibility,
    numbers::{C, LANES, Lanes, Mask, PerLane, Plain, Portable, Scalar},
    text_file::{self, TextFile},
};
use core::f64::consts::PI;
use std::path::Path;
use thiserror::Error;

/// Larger files are not section data: C81 tables with a hundred Mach numbers have 1 MB.
const MAX_BYTES: u64 = 16 << 20;

/// Lower Reynolds numbers count as this one in the drag correction, which was made for boundary
/// layers and not for creeping flow.
const MIN_CORRECTED_REYNOLDS: f64 = 1e4;

/// What is wrong with an airfoil file, and where.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum AirfoilError {
    /// The file is missing, is not a plain file, is too large or is not text.
    #[error("airfoil file {file}: cannot be read ({reason}); give a file that exists and is text")]
    Unreadable {
        /// The file's path.
        file: String,
        /// Why it cannot be read.
        reason: String,
    },
    /// A line breaks the rules of its format.
    #[error("airfoil file {file}, line {line}: {problem}")]
    Malformed {
        /// The file's path.
        file: String,
        /// Line of the problem, from 1.
        line: usize,
        /// What is wrong there.
        problem: String,
    },
    /// The file of another program.
    #[error("airfoil file {file}: it looks like {looks_like}; the FMU reads .polar, C81 and CombiTable files; {}", foreign::remedy(*looks_like, file, polar))]
    Foreign {
        /// The file's path.
        file: String,
        /// What it is.
        looks_like: Foreign,
        /// The name of the file that takes its place.
        polar: String,
    },
    /// A field of a line breaks the rules of its format.
    #[error("airfoil file {file}, line {line}, column {column}: {problem}")]
    MalformedField {
        /// The file's path.
        file: String,
        /// Line of the problem, from 1.
        line: usize,
        /// Column of the problem, from 1.
        column: usize,
        /// What is wrong there.
        problem: String,
    },
}

/// The source of a section's lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lift {
    /// The airfoil's table; for a file of laws, the lines A and C (thesis 3.5.1).
    Table,
    /// Flat plate: cl = 2 pi sin(alpha) (thesis eq. 49).
    TwoPi,
    /// For a file of laws: one lift slope, by the pitch of the element (thesis 3.5.1). For a table,
    /// the table.
    SlopesByReynolds,
}

/// How a section's coefficients are made from its data.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionModel {
    /// The source of the lift.
    pub lift: Lift,
    /// The rule for the lift at a Mach number. Data for two or more Mach numbers take its place.
    pub compressibility: Compressibility,
    /// Exponent n, 0 to 0.5, of the drag correction outside the data's Reynolds numbers.
    pub drag_reynolds_exponent: f64,
}

/// The similarity numbers of the flow at a section.
#[derive(Debug, Clone, Copy)]
pub struct Similarity<S> {
    /// Reynolds number of the chord, >= 0.
    pub reynolds: S,
    /// Mach number, >= 0.
    pub mach: S,
}

impl<L: Lanes> Similarity<L> {
    /// Those of the lanes.
    #[inline(always)]
    pub(crate) fn per_lane(&self) -> Similarity<PerLane<L::One>> {
        Similarity {
            reynolds: self.reynolds.per_lane(),
            mach: self.mach.per_lane(),
        }
    }

    /// Those of a block in lanes.
    #[inline(always)]
    pub(crate) fn in_lanes(numbers: &Similarity<PerLane<L::One>>) -> Self {
        Self {
            reynolds: L::in_lanes(&numbers.reynolds),
            mach: L::in_lanes(&numbers.mach),
        }
    }

    /// Those of a lane.
    #[inline(always)]
    pub fn lane(&self, lane: usize) -> Similarity<L::One> {
        Similarity {
            reynolds: self.reynolds.lane(lane),
            mach: self.mach.lane(lane),
        }
    }
}

/// An airfoil as read from a file. Angles in rad.
#[derive(Debug, Clone, PartialEq)]
pub struct Airfoil {
    name: String,
    data: Data,
    summary: Summary,
}

/// The two kinds of section data.
#[derive(Debug, Clone, PartialEq)]
enum Data {
    Tables { lift: Table, drag: Table },
    Laws(Laws),
}

/// Lowest and highest number of an axis in the data; none if they do not depend on it.
fn range(data: &Data, axis: Axis) -> Option<(f64, f64)> {
    let (lift, drag) = match data {
        Data::Tables { lift, drag } => (lift.layers(), drag.layers()),
        Data::Laws(laws) => (laws.layers(), laws.layers()),
    };
    let has_range = |layers: &&Layers| match axis {
        Axis::Reynolds => true,
        Axis::Mach => layers.resolves_mach(),
    };
    let mut ranges = [lift, drag]
        .into_iter()
        .filter(has_range)
        .filter_map(|layers| layers.range(axis));
    let first = ranges.next()?;
    Some(ranges.fold(first, |a, b| (a.0.max(b.0), a.1.min(b.1))))
}

impl Airfoil {
    /// An airfoil of the data that a format has read.
    fn new(name: String, data: Data) -> Self {
        let summary = Summary::of(&data);
        Self {
            name,
            data,
            summary,
        }
    }

    /// Reads a file in one of the formats of `formats`: a CombiTable of laws if it begins with
    /// `#1`, polars by Reynolds or Mach number if its name ends in `.polar` or it begins with
    /// `polar 1`, else C81.
    ///
    /// # Errors
    ///
    /// The first problem, with its place in the file; or what the file is, if another program
    /// writes such files.
    pub fn read(path: &Path) -> Result<Self, AirfoilError> {
        Self::read_with_hash(path).map(|(airfoil, _)| airfoil)
    }

    /// As `read`, with a 64-bit hash of the file's text, which tells whether the file has changed.
    ///
    /// # Errors
    ///
    /// As `read`.
    pub fn read_with_hash(path: &Path) -> Result<(Self, u64), AirfoilError> {
        match text_file::read(path, MAX_BYTES) {
            Ok(TextFile { text, hash }) => Ok((Self::from_text(&text, path)?, hash)),
            Err(reason) => Err(AirfoilError::Unreadable {
                file: path.display().to_string(),
                reason,
            }),
        }
    }

    /// As `read`, from the text of a file at `path`, which is not read.
    ///
    /// # Errors
    ///
    /// As `read`.
    pub fn from_text(text: &str, path: &Path) -> Result<Self, AirfoilError> {
        (formats::detected(path, text).parse)(text, &path.display().to_string())
            .map_err(|error| foreign::explained(error, text, path))
    }

    /// The section's name in the file.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Whether the file gives laws, which `Lift::SlopesByReynolds` needs.
    pub fn has_laws(&self) -> bool {
        match self.data {
            Data::Laws(_) => true,
            Data::Tables { .. } => false,
        }
    }

    /// Lowest and highest Reynolds or Mach number of the file; none if its coefficients do not
    /// depend on that number. A single Mach number has no range: a compressibility rule takes the
    /// coefficients to others.
    pub fn range(&self, axis: Axis) -> Option<(f64, f64)> {
        range(&self.data, axis)
    }

    /// Lift coefficient.
    ///
    /// * `pitch`: of the blade element, rad; it counts for `Lift::SlopesByReynolds` only
    /// * `alpha`: angle of attack, rad, any value
    #[inline(always)]
    pub fn lift_coefficient<L: Lanes>(
        &self,
        model: &SectionModel,
        pitch: L::Real,
        alpha: L,
        flow: Similarity<L>,
    ) -> L {
        let lift = match (&self.data, model.lift) {
            (Data::Tables { lift, .. }, Lift::Table | Lift::SlopesByReynolds)
                if lift.is_single() =>
            {
                lift.single(alpha)
            }
            _ => L::in_lanes(&self.any_lift::<L::One>(
                model,
                &pitch.store(),
                &alpha.per_lane(),
                &flow.per_lane(),
            )),
        };
        self.rule(model).correct(lift, flow.mach)
    }

    /// The lift coefficient of any data, without the compressibility rule.
    #[inline(never)]
    fn any_lift<S: Scalar>(
        &self,
        model: &SectionModel,
        pitch: &[f64; LANES],
        alpha: &PerLane<S>,
        flow: &Similarity<PerLane<S>>,
    ) -> PerLane<S> {
        let flow = Similarity::<S::In<Portable>>::in_lanes(flow);
        let alpha = S::In::<Portable>::in_lanes(alpha);
        let lift = match model.lift {
            Lift::TwoPi => C(2.0 * PI) * alpha.sin(),
            Lift::Table | Lift::SlopesByReynolds => match &self.data {
                Data::Tables { lift, .. } => lift.value(alpha, flow),
                Data::Laws(laws) => laws.lift(|lane| model.line(pitch[lane]), alpha, flow),
            },
        };
        lift.per_lane()
    }

    /// Factor by which the compressibility rule raises the incompressible lift coefficient `lift`
    /// at a Mach number (>= 0).
    #[inline(always)]
    pub fn compressibility<S: Lanes>(&self, model: &SectionModel, lift: S, mach: S) -> S {
        C(1.0) / self.rule(model).divisor(lift, mach)
    }

    /// The compressibility rule. A table of several Mach numbers takes its place.
    fn rule(&self, model: &SectionModel) -> Compressibility {
        let has_machs = match (model.lift, &self.data) {
            (Lift::Table, Data::Tables { lift, .. }) => lift.layers().resolves_mach(),
            (Lift::Table, Data::Laws(_))
            | (Lift::TwoPi | Lift::SlopesByReynolds, Data::Tables { .. } | Data::Laws(_)) => false,
        };
        if has_machs {
            Compressibility::None
        } else {
            model.compressibility
        }
    }

    /// Drag coefficient at the angle of attack `alpha` (rad, any value).
    ///
    /// Outside the data's Reynolds numbers the nearest one's drag is scaled with (Re_data/Re)^n:
    /// Yamauchi & Johnson 1983, "Trends of Reynolds Number Effects on Two-Dimensional Airfoil
    /// Characteristics for Helicopter Rotor Analyses", NASA TM-84363, n = 0.2 for a turbulent
    /// boundary layer. Beyond stall the drag is that of pressure and depends little on the boundary
    /// layer; there only a part of it is scaled, as large as the drag at the stall angle. Two kinds
    /// of drag stay as they are: that of bodies without lift, which is pressure drag, and that of
    /// tables by Mach number, which know no Reynolds number.
    #[inline(always)]
    pub fn drag_coefficient<L: Lanes>(
        &self,
        model: &SectionModel,
        alpha: L,
        flow: Similarity<L>,
    ) -> L {
        let drag = self.table_drag(alpha, flow);
        let Some((lowest, highest)) = self.summary.reynolds else {
            return drag;
        };
        let reynolds = flow.reynolds.at_least(MIN_CORRECTED_REYNOLDS);
        let is_outside = reynolds.is_below(lowest) | reynolds.is_above(highest);
        let is_off = model.drag_reynolds_exponent == 0.0 || !self.summary.lifts;
        if is_off || !is_outside.any() {
            return drag;
        }
        let nearest = reynolds.values().at_least(lowest).at_most(highest);
        let ratio = L::real(nearest) / reynolds;
        let factor = (C(model.drag_reynolds_exponent) * ratio.ln()).exp();
        let is_low = drag.values().is_below(self.summary.drag_below_stall);
        let scaled = if is_low.all() {
            drag
        } else {
            L::from_lanes(|lane| {
                let flow = flow.lane(lane);
                self.attached_drag(drag.lane(lane), alpha.lane(lane), flow)
            })
        };
        L::select(is_outside, drag + scaled * (factor - 1.0), drag)
    }

    /// The part of the file's drag coefficient `drag` that depends on the boundary layer: not more
    /// than the drag at the stall angle.
    #[inline(never)]
    fn attached_drag<S: Scalar>(&self, drag: S, alpha: S, flow: Similarity<S>) -> S {
        let (negative, positive) = self.stall_angles(flow);
        let is_negative = wrapped(alpha).is_below(0.0);
        let stall = if is_negative { negative } else { positive };
        let at_stall = self.table_drag(stall, flow);
        if (drag - at_stall).is_above(0.0) {
            at_stall
        } else {
            drag
        }
    }

    /// The drag coefficient of the file, without the correction.
    #[inline(always)]
    fn table_drag<L: Lanes>(&self, alpha: L, flow: Similarity<L>) -> L {
        match &self.data {
            Data::Tables { drag, .. } if drag.is_single() => drag.single(alpha),
            Data::Tables { .. } | Data::Laws(_) => {
                L::in_lanes(&self.any_drag::<L::One>(&alpha.per_lane(), &flow.per_lane()))
            }
        }
    }

    /// The drag coefficient of any data, without the correction.
    #[inline(never)]
    fn any_drag<S: Scalar>(&self, alpha: &PerLane<S>, flow: &Similarity<PerLane<S>>) -> PerLane<S> {
        let flow = Similarity::<S::In<Portable>>::in_lanes(flow);
        let alpha = S::In::<Portable>::in_lanes(alpha);
        let drag = match &self.data {
            Data::Tables { drag, .. } => drag.value(alpha, flow),
            Data::Laws(laws) => laws.drag(alpha, flow),
        };
        drag.per_lane()
    }

    /// Whether the section has lift at any angle.
    pub fn lifts(&self) -> bool {
        self.summary.lifts
    }

    /// The lift as one line: its slope, 1/rad, and its angle of zero lift, rad.
    ///
    /// For a table it is the line through the lift at -3 and +3 deg of angle of attack (thesis
    /// section 3.5.1, line A). For laws it is line A, or with `Lift::SlopesByReynolds` line A or B
    /// by the `pitch` of the element, rad.
    #[inline(always)]
    pub fn lift_line<L: Lanes>(
        &self,
        model: &SectionModel,
        pitch: L::Real,
        flow: Similarity<L>,
    ) -> (L, L) {
        if let (Some(line), Lift::Table | Lift::SlopesByReynolds) = (self.summary.line, model.lift)
        {
            return (L::constant(line.0), L::constant(line.1));
        }
        let (slope, zero_lift) =
            self.any_lift_line::<L::One>(model, &pitch.store(), &flow.per_lane());
        (L::in_lanes(&slope), L::in_lanes(&zero_lift))
    }

    /// The lift of any data as one line.
    #[inline(never)]
    fn any_lift_line<S: Scalar>(
        &self,
        model: &SectionModel,
        pitch: &[f64; LANES],
        flow: &Similarity<PerLane<S>>,
    ) -> (PerLane<S>, PerLane<S>) {
        let flow = Similarity::<S::In<Portable>>::in_lanes(flow);
        let zero = S::In::<Portable>::nil();
        let (slope, zero_lift) = match (&self.data, model.lift) {
            (_, Lift::TwoPi) => (Lanes::constant(2.0 * PI), zero),
            (Data::Laws(laws), _) => (laws.slope(|lane| model.line(pitch[lane]), flow), zero),
            (Data::Tables { lift, .. }, _) => lift.line(flow),
        };
        (slope.per_lane(), zero_lift.per_lane())
    }

    /// Where the section is clear of stall at an angle of attack (rad, between -pi and pi),
    /// whatever the Reynolds and Mach number. `stall_angles` decides where it is not.
    #[inline(always)]
    pub fn is_unstalled<V: Plain>(&self, alpha: V) -> V::Mask {
        let (negative, positive) = self.summary.unstalled;
        !alpha.is_below(negative) & !alpha.is_above(positive)
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
    /// The line of a file of laws that the lift follows.
    fn line(&self, pitch: f64) -> Line {
        match self.lift {
            Lift::SlopesByReynolds => Line::ByPitch(pitch),
            Lift::Table | Lift::TwoPi => Line::Broken,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::numbers::Dual64;

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

    /// At the end of the file's Reynolds numbers the power law begins on the side beyond the end.
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

    #[test]
    fn the_lift_line_of_laws_is_line_a_and_without_lift_it_is_zero() {
        let flow = Similarity {
            reynolds: 1e5,
            mach: 0.0,
        };
        let model = |lift: Lift| SectionModel {
            lift,
            compressibility: Compressibility::None,
            drag_reynolds_exponent: 0.2,
        };
        let laws = "#1\ndouble a(1, 5)\n1e5 6 4 0.2 0.01\n";
        let laws = combi::parse(laws, "test").unwrap();
        for (lift, pitch, slope) in [
            (Lift::Table, 0.2, 6.0),
            (Lift::SlopesByReynolds, 0.01, 6.0),
            (Lift::SlopesByReynolds, 0.2, 5.0),
        ] {
            assert_eq!(laws.lift_line(&model(lift), pitch, flow), (slope, 0.0));
        }
        let circle = polar::parse("polar 1\nreynolds 1\n-180 0 1\n180 0 1\n", "test").unwrap();
        let none = circle.lift_line(&model(Lift::Table), 0.0, flow);
        assert_eq!(none, (0.0, 0.0));
    }

    #[test]
    fn messages_quote_at_most_80_characters_of_a_file() {
        let long = "y".repeat(1_000_000);
        let polar = |text: String| polar::parse(&text, "f").map(|_| ());
        let c81 = |text: String| c81::parse(&text, "f").map(|_| ());
        let combi = |text: String| combi::parse(&text, "f").map(|_| ());
        let errors = [
            polar(long.clone()),
            polar(format!("polar 1\n{long}")),
            polar(format!("polar 1\nreynolds {long}")),
            polar(format!("polar 1\nreynolds 1e5\n0 {long}")),
            c81(long.clone()),
            c81(format!("name 1 1 1 1\n{long}")),
            c81(format!("name 1 1 1 1\n0\n-180 {long}")),
            combi(format!("#1\n{long}")),
            combi(format!("#1\n{long} {long}")),
            combi(format!("#1\n1{long}")),
            combi(format!("#1\ndouble {long}(1, 1)\n1\n")),
            combi(format!("#1\ndouble {long}(1, 1)\n1{long}\n")),
            combi(format!("#1\ndouble {long}(1, 1)\n1\n1{long}\n")),
            combi(format!("#1\ndouble {long}(1, 1)\n1\ndouble b(1, 1)\n1\n")),
        ];
        for error in errors {
            let error = error.unwrap_err().to_string();
            let longest = error.split(|c| c != 'y').map(str::len).max();
            assert!(longest <= Some(80) && error.len() < 400, "{error}");
        }
        let name = format!("polar 1\nname {long}\nreynolds 1\n-180 0 0\n180 0 0\n");
        let airfoil = polar::parse(&name, "f").unwrap();
        assert_eq!(airfoil.name().chars().count(), 80);
    }
}
