//! The shape of the rotor: blades by radial stations, cut into elements.

mod elements;
mod file;
mod inertia;

pub use elements::Elements;
pub use file::RotorFileError;
pub use inertia::{BladeInertia, lock_number};

use thiserror::Error;

/// Maximum number of blades.
pub const MAX_BLADES: u32 = 20;

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
    /// r/R, above 0, up to 1.
    pub radius_ratio: f64,
    /// Chord, >= 0, m.
    pub chord: f64,
    /// Pitch of the section less that of any reference that is the same for all stations, rad,
    /// positive nose up.
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
    /// Rotor radius R, > 0, m.
    pub radius: f64,
    /// r/R at which the pitch equals the collective, 0 to 1.
    pub pitch_reference_radius: f64,
    /// Direction of rotation, seen from above.
    pub rotation: Rotation,
    /// Chord of the tip for tip losses and for the tip's Reynolds number, >= 0, m.
    pub tip_chord: f64,
    /// Stations from the cutout (r/R > 0) to the tip (r/R = 1): two or more, radii strictly
    /// increasing.
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
            rotation: Rotation::CounterClockwise,
            tip_chord: chord * taper_ratio,
            stations: vec![station(cutout, chord), station(1.0, chord * taper_ratio)],
            airfoils: vec![String::new()],
            inertia: None,
        }
    }

    /// Refuses shapes that the models cannot compute.
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
        if !(self.radius.is_finite() && self.radius > 0.0) {
            return fail(format!(
                "the rotor radius is {} m; it must be above 0",
                self.radius
            ));
        }
        if !(0.0..=1.0).contains(&self.pitch_reference_radius) {
            return fail(format!(
                "the pitch reference radius is {} R; it must lie between 0 and 1",
                self.pitch_reference_radius
            ));
        }
        let (Some(first), Some(last)) = (self.stations.first(), self.stations.last()) else {
            return fail("the blade has no stations; it needs two or more".into());
        };
        if self.stations.len() < 2
            || first.radius_ratio.is_nan()
            || first.radius_ratio <= 0.0
            || last.radius_ratio != 1.0
        {
            return fail(
                "the blade needs two or more stations, the first at r/R > 0, the last at r/R = 1"
                    .into(),
            );
        }
        for pair in self.stations.windows(2) {
            if pair[1].radius_ratio.is_nan() || pair[1].radius_ratio <= pair[0].radius_ratio {
                return fail(format!(
                    "the blade stations must go outwards, but r/R = {} follows {}",
                    pair[1].radius_ratio, pair[0].radius_ratio
                ));
            }
        }
        for station in &self.stations {
            if !(station.chord.is_finite() && station.chord >= 0.0 && station.twist.is_finite()) {
                return fail(format!(
                    "at r/R = {} the chord is {} m and the twist {} rad; the chord must be 0 or more, the twist finite",
                    station.radius_ratio, station.chord, station.twist
                ));
            }
        }
        if self.stations.iter().all(|s| s.chord == 0.0) {
            return fail("the chord is 0 at every station; the blade needs some chord".into());
        }
        Ok(())
    }

    /// r/R of the root cutout, where the blade begins.
    pub fn cutout(&self) -> f64 {
        self.stations.first().map_or(0.0, |s| s.radius_ratio)
    }

    /// Pitch of the section at `radius_ratio` less the collective, rad.
    pub fn twist(&self, radius_ratio: f64) -> f64 {
        self.interpolate(radius_ratio, |s| s.twist)
            - self.interpolate(self.pitch_reference_radius, |s| s.twist)
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
        let cases: [(Spoil, &str); 8] = [
            (|g| g.blades = 0, "number of blades"),
            (|g| g.blades = 21, "must be 20 or fewer"),
            (|g| g.radius = -1.0, "radius is -1 m"),
            (|g| g.radius = f64::NAN, "radius is NaN m"),
            (|g| g.stations[0].chord = -0.1, "chord is -0.1 m"),
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

    #[test]
    fn twist_counts_from_the_pitch_reference_radius() {
        let mut geometry = Geometry::linear(3, 1.0, 0.2, 0.1, 1.0, -0.1);
        assert!((geometry.twist(1.0) + 0.1).abs() < 1e-15);
        assert!((geometry.twist(0.5) + 0.05).abs() < 1e-15);
        geometry.pitch_reference_radius = 0.75;
        assert!(geometry.twist(0.75).abs() < 1e-15);
        assert!((geometry.twist(1.0) + 0.025).abs() < 1e-15);
    }
}
