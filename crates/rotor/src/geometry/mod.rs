//! The shape of the rotor: blades by radial stations, cut into elements.

mod elements;
mod file;
mod inertia;

pub use elements::{Block, Elements, Missed};
pub use file::{Given, GivenValue, RotorDefinition, RotorFileError, nearest};
pub use inertia::{BladeInertia, lock_number};

use core::{f64::consts::PI, ops::RangeInclusive};
use thiserror::Error;

/// Maximum number of blades.
pub const MAX_BLADES: u32 = 20;

/// Permitted rotor radii R, m.
pub const RADIUS: RangeInclusive<f64> = 1e-3..=1e3;

/// Permitted radii r/R of the root cutout, where the blade begins.
pub const CUTOUT: RangeInclusive<f64> = 0.01..=0.95;

/// Permitted largest chords of a blade, m. Elsewhere the chord may be smaller, down to 0.
pub const CHORD: RangeInclusive<f64> = 1e-4..=1e2;

/// Permitted twist, rad.
pub const TWIST: RangeInclusive<f64> = -PI..=PI;

/// Direction of rotation, seen from above.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotation {
    /// The blade at psi = 90 deg is on the right.
    CounterClockwise,
    /// The blade at psi = 90 deg is on the left.
    Clockwise,
}

/// The blade at one radius. Between stations the chord, the twist and the section's coefficients
/// are linear in radius.
#[derive(Debug, Clone, PartialEq)]
pub struct Station {
    /// r/R, in `CUTOUT` for the first station, up to 1 for the last.
    pub radius_ratio: f64,
    /// Chord, from 0 to the end of `CHORD`, m.
    pub chord: f64,
    /// Pitch of the section less that of any reference that is the same for all stations, in
    /// `TWIST`, rad, positive nose up.
    pub twist: f64,
    /// Index of the section's airfoil in `Geometry::airfoils`.
    pub airfoil: usize,
}

/// A rotor's shape. Lengths in m, angles in rad. [`Geometry::check`] tells whether the values are
/// within their ranges.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Number of blades, 1 to `MAX_BLADES`.
    pub blades: u32,
    /// Rotor radius R, in `RADIUS`, m.
    pub radius: f64,
    /// r/R at which the pitch equals the collective, 0 to 1; not used with `has_blade_angles`.
    pub pitch_reference_radius: f64,
    /// Whether the twist of the stations is their pitch at a collective of 0, so that no radius is
    /// a reference.
    pub has_blade_angles: bool,
    /// Direction of rotation, seen from above.
    pub rotation: Rotation,
    /// Chord of the tip for tip losses and for the tip's Reynolds number, >= 0, m.
    pub tip_chord: f64,
    /// Stations from the cutout (r/R in `CUTOUT`) to the tip (r/R = 1): two or more, radii
    /// increasing. Two stations at one radius between the ends are a step.
    pub stations: Vec<Station>,
    /// Airfoil files of the sections; an empty name is the rotor's standard airfoil.
    pub airfoils: Vec<String>,
    /// The inertia of the blades, if it is known.
    pub inertia: Option<BladeInertia>,
}

/// What is wrong with a shape, and what would be right: a sentence.
#[derive(Debug, Error, Clone, PartialEq)]
#[error("{0}")]
pub struct GeometryError(String);

impl Geometry {
    /// A blade of linear chord and twist from `cutout` (r/R) to the tip, of one airfoil.
    ///
    /// * `blades`: 1 to `MAX_BLADES`
    /// * `radius`: > 0, m
    /// * `cutout`: r/R, above 0 and below 1
    /// * `chord`: at the cutout, > 0, m
    /// * `taper_ratio`: tip chord over the chord at the cutout, >= 0
    /// * `twist`: pitch at the tip less that at the shaft, rad; negative for washout
    pub fn linear(
        blades: u32,
        radius: f64,
        cutout: f64,
        chord: f64,
        taper_ratio: f64,
        twist: f64,
    ) -> Self {
        let station = |radius_ratio: f64, chord: f64| Station {
            radius_ratio,
            chord,
            twist: twist * radius_ratio,
            airfoil: 0,
        };
        Self {
            blades,
            radius,
            pitch_reference_radius: 0.0,
            has_blade_angles: false,
            rotation: Rotation::CounterClockwise,
            tip_chord: chord * taper_ratio,
            stations: vec![station(cutout, chord), station(1.0, chord * taper_ratio)],
            airfoils: vec![String::new()],
            inertia: None,
        }
    }

    /// Refuses shapes that the models cannot compute, and values that no rotor has.
    ///
    /// # Errors
    ///
    /// The first value outside its range, with the range.
    pub fn check(&self) -> Result<(), GeometryError> {
        let fail = |text: String| Err(GeometryError(text));
        if self.blades == 0 {
            return fail("the number of blades is 0; it must be 1 or more".into());
        }
        if self.blades > MAX_BLADES {
            return fail(format!(
                "the number of blades is {}; it must be {MAX_BLADES} or fewer",
                self.blades
            ));
        }
        if !RADIUS.contains(&self.radius) {
            return fail(format!(
                "the rotor radius is {:?} m; it must lie between {} and {} m",
                self.radius,
                RADIUS.start(),
                RADIUS.end()
            ));
        }
        if !(0.0..=1.0).contains(&self.pitch_reference_radius) {
            return fail(format!(
                "the pitch reference radius is {:?} R; it must lie between 0 and 1",
                self.pitch_reference_radius
            ));
        }
        let (Some(first), Some(last)) = (self.stations.first(), self.stations.last()) else {
            return fail("the blade has no stations; it needs two or more".into());
        };
        for pair in self.stations.windows(2) {
            if pair[1].radius_ratio.is_nan() || pair[1].radius_ratio < pair[0].radius_ratio {
                return fail(format!(
                    "the blade stations must go outwards, but r/R = {:?} follows {:?}",
                    pair[1].radius_ratio, pair[0].radius_ratio
                ));
            }
        }
        let at = |s: &Station, other: &Station| s.radius_ratio == other.radius_ratio;
        for (i, pair) in self.stations.windows(2).enumerate() {
            let is_end = i == 0 || i + 2 == self.stations.len();
            let is_third = self.stations.get(i + 2).is_some_and(|s| at(s, &pair[1]));
            if at(&pair[0], &pair[1]) && (is_end || is_third) {
                return fail(format!(
                    "the blade stations must go outwards, but r/R = {:?} is given {}; two stations at one radius are a step, which has room between the cutout and the tip only",
                    pair[1].radius_ratio,
                    if is_third { "three times" } else { "twice" }
                ));
            }
        }
        if self.stations.len() < 2
            || !CUTOUT.contains(&first.radius_ratio)
            || last.radius_ratio != 1.0
        {
            return fail(format!(
                "the blade has {} stations from r/R = {:?} to {:?}; it needs two or more, the first at r/R = {} to {}, the last at r/R = 1",
                self.stations.len(),
                first.radius_ratio,
                last.radius_ratio,
                CUTOUT.start(),
                CUTOUT.end()
            ));
        }
        for station in &self.stations {
            let place = format!("at the blade station r/R = {}", station.radius_ratio);
            if !(0.0..=*CHORD.end()).contains(&station.chord) {
                return fail(format!(
                    "{place} the chord is {:?} m; it must lie between 0 and {} m",
                    station.chord,
                    CHORD.end()
                ));
            }
            if !TWIST.contains(&station.twist) {
                return fail(format!(
                    "{place} the twist is {:?} deg; it must lie between {} and {} deg",
                    station.twist.to_degrees(),
                    TWIST.start().to_degrees(),
                    TWIST.end().to_degrees()
                ));
            }
        }
        let largest = self.largest_chord();
        if largest < *CHORD.start() {
            return fail(format!(
                "the largest chord of the blade is {largest:?} m; it must be {} m or more",
                CHORD.start()
            ));
        }
        Ok(())
    }

    /// r/R of the root cutout, where the blade begins.
    pub fn cutout(&self) -> f64 {
        self.stations.first().map_or(0.0, |s| s.radius_ratio)
    }

    /// Pitch of the section at `radius_ratio` less the collective, rad.
    pub fn twist(&self, radius_ratio: f64) -> f64 {
        let twist = self.interpolate(radius_ratio, |s| s.twist);
        if self.has_blade_angles {
            return twist;
        }
        twist - self.interpolate(self.pitch_reference_radius, |s| s.twist)
    }

    /// Chord at `radius_ratio`, from the cutout to the tip, m.
    pub fn chord(&self, radius_ratio: f64) -> f64 {
        self.interpolate(radius_ratio, |s| s.chord)
    }

    /// Largest chord of the blade, m.
    pub fn largest_chord(&self) -> f64 {
        self.stations.iter().fold(0.0, |c, s| s.chord.max(c))
    }

    /// Area of the blades from the cutout to the tip over the disc area pi R^2.
    pub fn solidity(&self) -> f64 {
        let disc = PI * self.radius * self.radius;
        f64::from(self.blades) * self.area(self.cutout(), 1.0) / disc
    }

    /// Solidity of rectangular blades, from the shaft to the tip, with the same thrust at one lift
    /// coefficient, which is proportional to the integral of c r^2.
    pub fn thrust_weighted_solidity(&self) -> f64 {
        let mut sum = 0.0;
        for pair in self.stations.windows(2) {
            let (a, b) = (&pair[0], &pair[1]);
            let middle = 0.5 * (a.radius_ratio + b.radius_ratio);
            let weight = |r: f64, chord: f64| chord * r * r;
            // Simpson's rule is exact for a cubic.
            sum += (b.radius_ratio - a.radius_ratio) / 6.0
                * (weight(a.radius_ratio, a.chord)
                    + 4.0 * weight(middle, 0.5 * (a.chord + b.chord))
                    + weight(b.radius_ratio, b.chord));
        }
        3.0 * sum * f64::from(self.blades) / (PI * self.radius)
    }

    /// A quantity at a radius: linear between the stations; inside the cutout it follows the line
    /// of the innermost interval.
    fn interpolate(&self, radius_ratio: f64, quantity: impl Fn(&Station) -> f64) -> f64 {
        let (inner, outer, weight) = self.between(radius_ratio);
        quantity(inner) + weight * (quantity(outer) - quantity(inner))
    }

    /// The stations to either side of a radius, and how far (0 to 1) it lies towards the outer one.
    fn between(&self, radius_ratio: f64) -> (&Station, &Station, f64) {
        let outer = self
            .stations
            .partition_point(|s| s.radius_ratio <= radius_ratio)
            .clamp(1, self.stations.len() - 1);
        let (a, b) = (&self.stations[outer - 1], &self.stations[outer]);
        (
            a,
            b,
            (radius_ratio - a.radius_ratio) / (b.radius_ratio - a.radius_ratio),
        )
    }

    /// Distance of a station, by its index, from the nearer of its neighbours, r/R; the other
    /// station of a step does not count.
    pub fn gap(&self, station: usize) -> f64 {
        let gaps = self.stations.windows(2);
        let gaps = gaps.map(|pair| pair[1].radius_ratio - pair[0].radius_ratio);
        // The gap before the station and the one behind it.
        let sides = gaps.skip(station.saturating_sub(1));
        let sides = sides.take(if station == 0 { 1 } else { 2 });
        sides.filter(|gap| *gap > 0.0).fold(1.0, f64::min)
    }

    /// Blade area between two radii (fractions of R), m2: the exact integral of the linear chord.
    fn area(&self, from: f64, to: f64) -> f64 {
        let mut area = 0.0;
        for pair in self.stations.windows(2) {
            let (low, high) = (from.max(pair[0].radius_ratio), to.min(pair[1].radius_ratio));
            if high > low {
                area += (high - low) * self.interpolate(0.5 * (low + high), |s| s.chord);
            }
        }
        area * self.radius
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn impossible_shapes_are_refused_with_the_remedy() {
        let good = Geometry::linear(3, 1.0, 0.2, 0.1, 0.5, -0.1);
        assert_eq!(good.check(), Ok(()));
        type Spoil = fn(&mut Geometry);
        let cases: [(Spoil, &str); 18] = [
            (|g| g.blades = 0, "number of blades"),
            (|g| g.blades = 21, "must be 20 or fewer"),
            (|g| g.radius = -1.0, "radius is -1.0 m"),
            (|g| g.radius = f64::NAN, "radius is NaN m"),
            (
                |g| g.radius = 1e100,
                "radius is 1e100 m; it must lie between 0.001 and 1000 m",
            ),
            (|g| g.radius = 1e-9, "radius is 1e-9 m"),
            (|g| g.pitch_reference_radius = 1e100, "is 1e100 R"),
            (|g| g.stations[0].chord = -0.1, "chord is -0.1 m"),
            (|g| g.stations[0].chord = f64::NAN, "chord is NaN m"),
            (
                |g| g.stations[1].chord = 1e100,
                "r/R = 1 the chord is 1e100 m; it must lie between 0 and 100 m",
            ),
            (
                |g| g.stations.iter_mut().for_each(|s| s.chord = 1e-5),
                "largest chord of the blade is 1e-5 m; it must be 0.0001 m or more",
            ),
            (
                |g| g.stations[0].twist = -4.0,
                "r/R = 0.2 the twist is -229.183",
            ),
            (|g| g.stations[0].twist = f64::NAN, "twist is NaN deg"),
            (
                |g| g.stations[0].radius_ratio = 0.005,
                "the first at r/R = 0.01 to 0.95",
            ),
            (
                |g| g.stations.insert(1, g.stations[0].clone()),
                "must go outwards",
            ),
            (|g| g.stations[0].radius_ratio = 1.0, "must go outwards"),
            (|g| g.stations[1].radius_ratio = 0.9, "the last at r/R = 1"),
            (|g| g.stations.clear(), "no stations"),
        ];
        for (spoil, part) in cases {
            let mut bad = good.clone();
            spoil(&mut bad);
            let error = bad.check().unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    /// A rounded tip, and twist that a file gives in degrees.
    #[test]
    fn the_ends_of_the_ranges_are_permitted() {
        let mut geometry = Geometry::linear(3, *RADIUS.end(), *CUTOUT.start(), 1e-4, 1.0, PI);
        assert_eq!(geometry.check(), Ok(()));
        geometry.stations[0].twist = (-180.0_f64).to_radians();
        geometry.stations[1].chord = 0.0;
        assert_eq!(geometry.check(), Ok(()));
    }

    #[test]
    fn chord_solidity_and_twist_from_the_pitch_reference_radius() {
        let mut geometry = Geometry::linear(3, 1.0, 0.2, 0.1, 1.0, -0.1);
        assert!((geometry.twist(1.0) + 0.1).abs() < 1e-15);
        assert!((geometry.twist(0.5) + 0.05).abs() < 1e-15);
        assert_eq!((geometry.chord(1.0), geometry.largest_chord()), (0.1, 0.1));
        assert!((geometry.solidity() - 3.0 * 0.08 / PI).abs() < 1e-15);
        geometry.pitch_reference_radius = 0.75;
        assert!(geometry.twist(0.75).abs() < 1e-15);
        assert!((geometry.twist(1.0) + 0.025).abs() < 1e-15);
    }
}
