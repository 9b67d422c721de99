//! Rotor definition files (TOML): radial tables of chord, twist and airfoil.
//!
//! ```toml
//! numberOfBlades = 3
//! radius = 0.762                 # m
//! pitchReferenceRadius = 0.75    # r/R, 0 if absent
//! rotation = "counterClockwise"  # or "clockwise"
//! station = [                    # from the cutout to the tip, r as r/R, chord in m, twist in deg
//!     { r = 0.2, chord = 0.05, twist = 0.0 },
//!     { r = 1.0, chord = 0.05, twist = -8.0, airfoil = "airfoils/naca0015.polar" },
//! ]
//! [flapping]
//! inertia = 0.04                # of one blade about its hinge, kg.m2; or lockNumber
//! ```
//!
//! `name` and `source` are free text. Only differences of `twist` between stations count: the
//! collective is the pitch at the reference radius. Without `airfoil` a station has the rotor's
//! standard airfoil.

use super::{BladeInertia, Geometry, GeometryError, Rotation, Station};
use crate::text_file::{self, NoMemory, TextFile, ensure, excerpt};
use serde::Deserialize;
use std::path::Path;
use thiserror::Error;

/// Larger files are no rotors: `MAX_STATIONS` stations have 100 kB.
const MAX_BYTES: u64 = 256 << 10;

/// The parser takes up to 82 bytes of memory for each byte of a file, and cannot do without.
const PARSER_BYTES: usize = 100;

/// Maximum number of stations.
const MAX_STATIONS: usize = 1000;

/// Maximum number of airfoil files. Each is read into memory.
const MAX_AIRFOILS: usize = 100;

/// Maximum number of characters of an airfoil's path: more than any system takes.
const MAX_PATH: usize = 4096;

/// What is wrong with a rotor file, and where.
#[derive(Debug, Error, Clone, PartialEq)]
pub enum RotorFileError {
    /// The file is missing, is not a plain file, is too large or is not text.
    #[error("rotor file {file}: cannot be read ({reason}); give a file that exists and is text")]
    Unreadable {
        /// The file's path.
        file: String,
        /// Why it cannot be read.
        reason: String,
    },
    /// The file breaks the rules of TOML, or a name or type is wrong.
    #[error("rotor file {file}, line {line}, column {column}: {problem}")]
    Malformed {
        /// The file's path.
        file: String,
        /// Line of the problem, from 1.
        line: usize,
        /// Column of the problem, from 1.
        column: usize,
        /// What is wrong there.
        problem: String,
    },
    /// The file is sound, but the models cannot compute its shape.
    #[error("rotor file {file}: {problem}")]
    Shape {
        /// The file's path.
        file: String,
        /// The value outside its range.
        problem: GeometryError,
    },
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
struct RotorFile {
    #[serde(rename = "name")]
    _name: Option<String>,
    #[serde(rename = "source")]
    _source: Option<String>,
    number_of_blades: u32,
    radius: f64,
    #[serde(default)]
    pitch_reference_radius: f64,
    #[serde(default = "counter_clockwise")]
    rotation: FileRotation,
    station: Vec<FileStation>,
    flapping: Option<FileFlapping>,
}

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
enum FileRotation {
    CounterClockwise,
    Clockwise,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "camelCase")]
struct FileFlapping {
    inertia: Option<f64>,
    lock_number: Option<f64>,
}

fn counter_clockwise() -> FileRotation {
    FileRotation::CounterClockwise
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileStation {
    r: f64,
    chord: f64,
    #[serde(default)]
    twist: f64,
    #[serde(default)]
    airfoil: String,
}

impl Geometry {
    /// Reads and checks a rotor definition file.
    ///
    /// # Errors
    ///
    /// The first problem, with the file and, where it has one, its line and column.
    pub fn read(path: &Path) -> Result<Self, RotorFileError> {
        Self::read_with_hash(path).map(|(geometry, _)| geometry)
    }

    /// As `read`, with a 64-bit hash of the file's text, which tells whether the file has changed.
    ///
    /// # Errors
    ///
    /// As `read`.
    pub fn read_with_hash(path: &Path) -> Result<(Self, u64), RotorFileError> {
        match text_file::read(path, MAX_BYTES) {
            Ok(TextFile { text, hash }) => Ok((Self::from_text(&text, path)?, hash)),
            Err(reason) => Err(RotorFileError::Unreadable {
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
    pub fn from_text(text: &str, path: &Path) -> Result<Self, RotorFileError> {
        parse(text, &path.display().to_string())
    }
}

fn parse(text: &str, file: &str) -> Result<Geometry, RotorFileError> {
    let no_memory = |error: NoMemory| RotorFileError::Unreadable {
        file: file.to_owned(),
        reason: error.to_string(),
    };
    ensure(PARSER_BYTES * text.len(), "its content").map_err(no_memory)?;
    let rotor: RotorFile = toml::from_str(text).map_err(|error| {
        let before = &text[..error.span().map_or(0, |span| span.start)];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        RotorFileError::Malformed {
            file: file.to_owned(),
            line: before.matches('\n').count() + 1,
            column: before[line_start..].chars().count() + 1,
            problem: without_long_quotes(&error.message().trim().replace('\n', ", ")),
        }
    })?;

    let shape = |problem| RotorFileError::Shape {
        file: file.to_owned(),
        problem,
    };
    let inertia = rotor
        .flapping
        .map(blade_inertia)
        .transpose()
        .map_err(shape)?;

    if rotor.station.len() > MAX_STATIONS {
        let problem = format!(
            "there are {} stations; leave some out, so that there are {MAX_STATIONS} or fewer",
            rotor.station.len()
        );
        return Err(shape(GeometryError(problem)));
    }
    let mut airfoils: Vec<String> = Vec::new();
    let mut stations = Vec::with_capacity(rotor.station.len());
    for station in rotor.station {
        let known = airfoils.iter().position(|a| *a == station.airfoil);
        let airfoil = known.unwrap_or_else(|| {
            airfoils.push(station.airfoil);
            airfoils.len() - 1
        });
        stations.push(Station {
            radius_ratio: station.r,
            chord: station.chord,
            twist: station.twist.to_radians(),
            airfoil,
        });
    }
    check_airfoils(&airfoils).map_err(shape)?;
    let mut geometry = Geometry {
        blades: rotor.number_of_blades,
        radius: rotor.radius,
        pitch_reference_radius: rotor.pitch_reference_radius,
        rotation: match rotor.rotation {
            FileRotation::CounterClockwise => Rotation::CounterClockwise,
            FileRotation::Clockwise => Rotation::Clockwise,
        },
        tip_chord: 0.0,
        stations,
        airfoils,
        inertia,
    };
    geometry.check().map_err(shape)?;
    geometry.tip_chord = largest_outer_chord(&geometry);
    Ok(geometry)
}

/// A message of the parser. It may quote the file, and then ends in what was expected there.
fn without_long_quotes(message: &str) -> String {
    match message.rfind(", expected ") {
        Some(end) => excerpt(&message[..end]) + &message[end..],
        None => excerpt(message),
    }
}

fn check_airfoils(airfoils: &[String]) -> Result<(), GeometryError> {
    if airfoils.len() > MAX_AIRFOILS {
        return Err(GeometryError(format!(
            "the stations have {} different airfoils; give them {MAX_AIRFOILS} or fewer",
            airfoils.len()
        )));
    }
    let wrong = airfoils.iter().find_map(|airfoil| {
        if airfoil.chars().count() > MAX_PATH {
            return Some((
                airfoil,
                format!("more than {MAX_PATH} characters; shorten it"),
            ));
        }
        let has_control = airfoil.chars().any(char::is_control);
        has_control.then(|| (airfoil, "control characters; remove them".to_owned()))
    });
    let Some((airfoil, problem)) = wrong else {
        return Ok(());
    };
    Err(GeometryError(format!(
        "the airfoil `{}` of a station has {problem}",
        excerpt(airfoil)
    )))
}

/// The inertia of the blades, from exactly one of the two numbers.
fn blade_inertia(flapping: FileFlapping) -> Result<BladeInertia, GeometryError> {
    let (name, value, inertia) = match (flapping.inertia, flapping.lock_number) {
        (Some(moment), None) => ("inertia", moment, BladeInertia::Moment(moment)),
        (None, Some(number)) => ("lockNumber", number, BladeInertia::LockNumber(number)),
        (Some(_), Some(_)) | (None, None) => {
            return Err(GeometryError(
                "the table [flapping] needs either inertia (kg.m2) or lockNumber".into(),
            ));
        }
    };
    if !(value.is_finite() && value > 0.0) {
        return Err(GeometryError(format!(
            "flapping.{name} is {value}; it must be above 0"
        )));
    }
    Ok(inertia)
}

/// Largest chord in the outer tenth of the radius: a rounded tip has a chord of 0 at its end.
fn largest_outer_chord(geometry: &Geometry) -> f64 {
    let at_its_inner_end = geometry.interpolate(0.9_f64.max(geometry.cutout()), |s| s.chord);
    let outer = geometry.stations.iter().filter(|s| s.radius_ratio >= 0.9);
    outer.map(|s| s.chord).fold(at_its_inner_end, f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"name = "test"
numberOfBlades = 2
radius = 1.5
station = [
    { r = 0.2, chord = 0.1, twist = 4.0, airfoil = "airfoils/circle.polar" },
    { r = 0.95, chord = 0.1, twist = 2.0 },
    { r = 1.0, chord = 0.0, twist = 0.0 },
]
"#;

    #[test]
    fn a_good_file_is_read() {
        let geometry = parse(GOOD, "good.toml").unwrap();
        assert_eq!(geometry.blades, 2);
        assert_eq!(geometry.airfoils, ["airfoils/circle.polar", ""]);
        assert!((geometry.stations[0].twist.to_degrees() - 4.0).abs() < 1e-12);
        assert_eq!(geometry.tip_chord, 0.1, "the rounded tip does not count");
        assert_eq!(geometry.rotation, Rotation::CounterClockwise);
        let text = format!("rotation = \"clockwise\"\n{GOOD}");
        let geometry = parse(&text, "good.toml").unwrap();
        assert_eq!(geometry.rotation, Rotation::Clockwise);
    }

    #[test]
    fn the_inertia_of_the_blades_is_read() {
        let inertia = |flapping: &str| parse(&format!("{GOOD}{flapping}"), "good.toml");
        for (flapping, expected) in [
            ("", None),
            ("[flapping]\ninertia = 2.5", Some(BladeInertia::Moment(2.5))),
            (
                "[flapping]\nlockNumber = 8",
                Some(BladeInertia::LockNumber(8.0)),
            ),
        ] {
            assert_eq!(inertia(flapping).unwrap().inertia, expected, "{flapping}");
        }
        for (flapping, part) in [
            (
                "[flapping]\ninertia = 2\nlockNumber = 8",
                "needs either inertia",
            ),
            ("[flapping]", "needs either inertia"),
            (
                "[flapping]\ninertia = -1",
                "flapping.inertia is -1; it must be above 0",
            ),
            ("[flapping]\nlockNumber = nan", "flapping.lockNumber is NaN"),
            ("[flapping]\nmass = 2", "unknown field `mass`"),
        ] {
            let error = inertia(flapping).unwrap_err().to_string();
            assert!(error.contains(part), "{error}");
        }
    }

    #[test]
    fn errors_name_file_place_and_problem() {
        for (from, to, part) in [
            (
                "radius = 1.5",
                "radius = \"big\"",
                "bad.toml, line 3, column 10: ",
            ),
            (
                "radius = 1.5",
                "raduis = 1.5",
                "bad.toml, line 3, column 1: unknown field `raduis`",
            ),
            ("radius = 1.5\n", "", "missing field `radius`"),
            (
                "radius = 1.5",
                "radius = -1.5",
                "bad.toml: the rotor radius is -1.5 m; it must lie between",
            ),
            (
                "chord = 0.1, twist = 2.0",
                "chord = -1, twist = 2.0",
                "at the blade station r/R = 0.95 the chord is -1.0 m",
            ),
            (
                "chord = 0.1, twist = 2.0",
                "chord = 1e100",
                "at the blade station r/R = 0.95 the chord is 1e100 m",
            ),
            ("twist = 2.0", "twist = 1e300", "r/R = 0.95 the twist is "),
            (
                "radius = 1.5",
                "radius = 1e100",
                "bad.toml: the rotor radius is 1e100 m",
            ),
            ("r = 0.95", "r = 0.1", "r/R = 0.1 follows 0.2"),
            ("[\n", "[[\n", "bad.toml, line "),
        ] {
            let error = parse(&GOOD.replacen(from, to, 1), "bad.toml")
                .unwrap_err()
                .to_string();
            assert!(error.contains(part), "{to}: {error}");
        }
    }

    /// A rotor with stations of these airfoils, and one more at the tip.
    fn with_airfoils(names: impl ExactSizeIterator<Item = String>) -> String {
        let count = names.len() as f64;
        let station = |(i, name): (usize, String)| {
            let r = 0.2 + 0.7 * i as f64 / count;
            format!("{{ r = {r}, chord = 0.1, airfoil = \"{name}\" }},\n")
        };
        let stations: String = names.enumerate().map(station).collect();
        format!(
            "numberOfBlades = 2\nradius = 1\nstation = [\n{stations}{{ r = 1.0, chord = 0.1 }},\n]\n"
        )
    }

    #[test]
    fn what_a_file_may_demand_of_memory_is_limited() {
        let read = |text: String| parse(&text, "x.toml").map_err(|error| error.to_string());
        let error = |text: String| read(text).unwrap_err();
        let stations = |count: usize| with_airfoils((0..count).map(|_| String::new()));
        assert_eq!(read(stations(999)).unwrap().stations.len(), 1000);
        assert!(error(stations(1000)).contains("there are 1001 stations; leave some out"));
        let airfoils = |count: usize| with_airfoils((0..count).map(|i| i.to_string()));
        assert_eq!(read(airfoils(99)).unwrap().airfoils.len(), 100);
        assert!(error(airfoils(100)).contains("101 different airfoils; give them 100 or fewer"));
        let path = |name: &str| with_airfoils([name.to_owned()].into_iter());
        let control = error(path("a\\u001b[2J"));
        assert!(
            control.contains("`a\u{fffd}[2J` of a station has control characters"),
            "{control}"
        );
        let path = |length: usize| with_airfoils(["a".repeat(length)].into_iter());
        assert!(read(path(4096)).is_ok());
        let long = error(path(4097));
        assert!(
            long.contains("has more than 4096 characters") && long.len() < 300,
            "{long}"
        );
    }

    #[test]
    fn messages_quote_at_most_80_characters_of_the_file() {
        let long = "x, expected ".repeat(10_000);
        for (from, to, part) in [
            ("radius", format!("\"{long}\""), ", expected one of `name`"),
            ("1.5", format!("\"{long}\""), ", expected f64"),
            ("radius", "x".repeat(100_000), ", expected one of `name`"),
            (
                "name",
                format!("rotation = \"{long}\"\nname"),
                ", expected `counterClockwise`",
            ),
            ("1.5", "1".repeat(100_000), "line 3, column 10"),
        ] {
            let text = GOOD.replacen(from, &to, 1);
            let error = parse(&text, "bad.toml").unwrap_err().to_string();
            assert!(error.contains(part) && error.len() < 350, "{error}");
            assert!(error.matches('x').count() <= 90, "{error}");
        }
    }
}
