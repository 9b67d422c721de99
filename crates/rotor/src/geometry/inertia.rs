//! The moment of inertia of one blade about its flapping hinge.
//!
//! It is given in kg.m2, or by the Lock number gamma = rho a c R^4/I (Lock 1927, ARC R&M 1127;
//! Johnson 1980, "Helicopter Theory", ch. 5, where a = 5.7 in the examples). Here rho is the
//! density at sea level of the standard atmosphere, whatever the air in flight, a = 5.7 per rad,
//! and c the chord at 0.75 R, or at the cutout of blades that begin further out.

use super::Geometry;

/// Density of the air at sea level, ISO 2533, kg/m3.
const DENSITY: f64 = 1.225;
/// Lift slope, per rad.
const LIFT_SLOPE: f64 = 5.7;

/// A blade of the FMU's default rotor: chord, m, radius, m, and moment of inertia, kg.m2.
const DEFAULT_CHORD: f64 = 0.0508;
const DEFAULT_RADIUS: f64 = 0.762;
const DEFAULT_MOMENT: f64 = 0.05;

/// What the moment of inertia of one blade about its flapping hinge is known from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BladeInertia {
    /// The moment of inertia itself, > 0, kg.m2.
    Moment(f64),
    /// The Lock number, > 0. Blades of helicopters have 5 to 12 (Johnson 1980, p. 186: 8 to 10 with
    /// hinges, 5 to 7 without).
    LockNumber(f64),
    /// The Lock number of the FMU's default rotor, 2.39. Blades of this size are heavy; it keeps
    /// the inertia of blades of any other size in proportion.
    LikeDefaultRotor,
}

impl BladeInertia {
    /// The moment of inertia of one blade of this shape, kg.m2.
    pub fn moment(&self, geometry: &Geometry) -> f64 {
        match *self {
            Self::Moment(moment) => moment,
            Self::LockNumber(number) => {
                DENSITY * LIFT_SLOPE * geometry.reference_chord() * fourth(geometry.radius) / number
            }
            // Ratios of 1 leave exactly the default.
            Self::LikeDefaultRotor => {
                DEFAULT_MOMENT
                    * (geometry.reference_chord() / DEFAULT_CHORD)
                    * fourth(geometry.radius / DEFAULT_RADIUS)
            }
        }
    }
}

/// The Lock number of blades of this shape with a moment of inertia, kg.m2, about the hinge.
pub fn lock_number(geometry: &Geometry, moment: f64) -> f64 {
    DENSITY * LIFT_SLOPE * geometry.reference_chord() * fourth(geometry.radius) / moment
}

impl Geometry {
    /// The chord at 0.75 R or, if it is 0 there, the largest chord, > 0, m.
    fn reference_chord(&self) -> f64 {
        let chord = self.interpolate(0.75_f64.max(self.cutout()), |s| s.chord);
        if chord > 0.0 {
            return chord;
        }
        self.stations.iter().map(|s| s.chord).fold(0.0, f64::max)
    }
}

fn fourth(x: f64) -> f64 {
    x * x * (x * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn default_rotor() -> Geometry {
        Geometry::linear(4, 0.762, 1.0 / 6.0, 0.0508, 1.0, 0.0)
    }

    #[test]
    fn the_default_rotor_has_exactly_its_inertia_and_other_sizes_its_lock_number() {
        let inertia = BladeInertia::LikeDefaultRotor;
        let default = default_rotor();
        assert_eq!(inertia.moment(&default), 0.05);
        let number = lock_number(&default, 0.05);
        assert!((number - 2.39).abs() < 0.01, "{number}");
        for (radius, chord) in [(0.05, 0.01), (2.0, 0.1), (10.0, 0.6)] {
            let other = Geometry::linear(4, radius, 0.2, chord, 0.5, 0.0);
            let found = lock_number(&other, inertia.moment(&other));
            assert!((found / number - 1.0).abs() < 1e-14, "{radius}: {found}");
        }
    }

    /// The blade of a Bo 105 (Johnson 1980, p. 186, hingeless: 5 to 7), about 4.9 m and 0.27 m.
    #[test]
    fn a_lock_number_gives_the_inertia_by_its_definition() {
        let geometry = Geometry::linear(4, 4.9, 0.2, 0.27, 1.0, 0.0);
        let moment = BladeInertia::LockNumber(5.0).moment(&geometry);
        let expected = 1.225 * 5.7 * 0.27 * (4.9 * 4.9 * 4.9 * 4.9) / 5.0;
        assert!((moment / expected - 1.0).abs() < 1e-14, "{moment}");
        assert!((lock_number(&geometry, moment) - 5.0).abs() < 1e-12);
        assert_eq!(BladeInertia::Moment(3.0).moment(&geometry), 3.0);
    }

    /// Blades that begin outboard of 0.75 R, or have no chord there.
    #[test]
    fn every_blade_has_a_reference_chord() {
        let outboard = Geometry::linear(2, 1.0, 0.9, 0.1, 0.5, 0.0);
        assert_eq!(outboard.reference_chord(), 0.1);
        let mut gap = default_rotor();
        let mut stations = vec![gap.stations[0].clone(), gap.stations[1].clone()];
        stations.insert(1, gap.stations[0].clone());
        (stations[1].radius_ratio, stations[1].chord) = (0.75, 0.0);
        gap.stations = stations;
        assert_eq!(gap.reference_chord(), 0.0508);
    }
}
