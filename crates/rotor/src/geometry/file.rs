//! Rotor definition files (TOML): radial tables of chord, twist and airfoil, and what else a rotor
//! is.
//!
//! ```toml
//! numberOfBlades = 3
//! radius = 0.762                 # m
//! pitchReferenceRadius = 0.75    # r/R, 0 if absent
//! rotation = "counterClockwise"  # or "CCW"; "clockwise" or "CW"
//! rpm = 960                      # nominal rotor speed, rev/min
//! collective = 8                 # nominal, deg
//! airfoil = "naca0012.polar"     # of the stations that name none
//! station = [                    # from the cutout to the tip, r as r/R, chord in m, twist in deg
//!     { r = 0.2, chord = 0.05, twist = 0.0 },
//!     { r = 1.0, chord = 0.05, twist = -8.0, airfoil = "airfoils/naca0015.polar" },
//! ]
//! [flapping]
//! hub = "hinged"                 # or "teetering", "hingeless", "rigid"
//! inertia = 0.04                 # of one blade about its hinge, kg.m2; or lockNumber
//! hingeOffset = 0.05             # r/R
//! [models]
//! inflow = "pittPeters"
//! [drive]
//! inertia = 3.0                  # kg.m2
//! ```
//!
//! `name` and `source` are free text. Only differences of `twist` between stations count: the
//! collective is the pitch at the reference radius. With `angle` in its place the stations have
//! the blade angles at a collective of 0. Two stations at one radius are a step. All angles are in
//! degrees.
//!
//! The tables `models`, `drive` and `numerics` hold parameters of the FMU, whose names and ranges
//! this module does not know: it hands them on, as it does with those of `flapping`.

mod given;
mod hub;
mod near;

pub use given::{Given, GivenValue};
pub use near::nearest;

use super::{Geometry, GeometryError, Rotation, Station};
use crate::text_file::{self, NoMemory, TextFile, ensure, excerpt, hash_of_text};
use core::ops::RangeInclusive;
use given::FileParameters;
use hub::FileFlapping;
use serde::Deserialize;
use std::path::Path;
use thiserror::Error;
use toml::Spanned;

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

/// Where the last station may lie, r/R, and still be the tip: tables are often rounded, and some
/// programs need a tip at 0.9999.
const TIP: RangeInclusive<f64> = 0.999..=1.001;

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
    name: Option<String>,
    source: Option<String>,
    number_of_blades: u32,
    radius: f64,
    pitch_reference_radius: Option<f64>,
    rotation: Option<Spanned<String>>,
    rpm: Option<Spanned<f64>>,
    collective: Option<Spanned<f64>>,
    airfoil: Option<Spanned<String>>,
    station: Vec<FileStation>,
    flapping: Option<FileFlapping>,
    models: Option<FileParameters>,
    drive: Option<FileParameters>,
    numerics: Option<FileParameters>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FileStation {
    r: f64,
    chord: f64,
    twist: Option<f64>,
    angle: Option<f64>,
    #[serde(default)]
    airfoil: String,
}

/// All that a rotor file says.
#[derive(Debug, Clone, PartialEq)]
pub struct RotorDefinition {
    /// The shape of the rotor and the inertia of its blades.
    pub geometry: Geometry,
    /// What the file gives for parameters of the FMU, in its order.
    pub given: Vec<Given>,
    /// The name of the rotor.
    pub name: Option<String>,
    /// Where its numbers come from.
    pub source: Option<String>,
    /// Hash of the file's text, which tells whether the file has changed.
    pub hash: u64,
}

impl RotorDefinition {
    /// Reads and checks a rotor definition file.
    ///
    /// # Errors
    ///
    /// The first problem, with the file and, where it has one, its line and column.
    pub fn read(path: &Path) -> Result<Self, RotorFileError> {
        match text_file::read(path, MAX_BYTES) {
            Ok(TextFile { text, hash }) => parse(&text, &path.display().to_string(), hash),
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
        parse(text, &path.display().to_string(), hash_of_text(text))
    }
}

impl Geometry {
    /// The shape in a rotor definition file.
    ///
    /// # Errors
    ///
    /// The first problem, with the file and, where it has one, its line and column.
    pub fn read(path: &Path) -> Result<Self, RotorFileError> {
        RotorDefinition::read(path).map(|definition| definition.geometry)
    }

    /// As `read`, from the text of a file at `path`, which is not read.
    ///
    /// # Errors
    ///
    /// As `read`.
    pub fn from_text(text: &str, path: &Path) -> Result<Self, RotorFileError> {
        RotorDefinition::from_text(text, path).map(|definition| definition.geometry)
    }
}

/// The place of a byte in a text: line and column from 1.
fn place(text: &str, at: usize) -> (usize, usize) {
    let before = text.get(..at).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |i| i + 1);
    let line = before.matches('\n').count() + 1;
    (line, before[line_start..].chars().count() + 1)
}

fn parse(text: &str, file: &str, hash: u64) -> Result<RotorDefinition, RotorFileError> {
    let no_memory = |error: NoMemory| RotorFileError::Unreadable {
        file: file.to_owned(),
        reason: error.to_string(),
    };
    ensure(PARSER_BYTES * text.len(), "its content").map_err(no_memory)?;
    let malformed = |at: usize, problem: String| {
        let (line, column) = place(text, at);
        RotorFileError::Malformed {
            file: file.to_owned(),
            line,
            column,
            problem,
        }
    };
    let rotor: RotorFile = toml::from_str(text).map_err(|error| {
        let message = error.message().trim().replace('\n', ", ");
        let problem = without_long_quotes(&message) + &near::hint(&message);
        malformed(error.span().map_or(0, |span| span.start), problem)
    })?;
    let shape = |problem| RotorFileError::Shape {
        file: file.to_owned(),
        problem,
    };
    let rotation = match &rotor.rotation {
        None => Rotation::CounterClockwise,
        Some(word) => rotation(word.get_ref()).map_err(|p| malformed(word.span().start, p))?,
    };
    let inertia = match &rotor.flapping {
        None => None,
        Some(flapping) => flapping.inertia().map_err(shape)?,
    };
    let has_angles = has_angles(&rotor).map_err(shape)?;
    let (stations, airfoils) = stations(rotor.station).map_err(shape)?;
    let mut geometry = Geometry {
        blades: rotor.number_of_blades,
        radius: rotor.radius,
        pitch_reference_radius: rotor.pitch_reference_radius.unwrap_or(0.0),
        has_blade_angles: has_angles,
        rotation,
        tip_chord: 0.0,
        stations,
        airfoils,
        inertia,
    };
    geometry.check().map_err(shape)?;
    geometry.tip_chord = largest_outer_chord(&geometry);

    let line = |at: usize| place(text, at).0;
    let mut given = Vec::new();
    let mut give = |name: &str, value: &Spanned<f64>| {
        given.push(Given::number(
            name,
            *value.get_ref(),
            line(value.span().start),
        ));
    };
    if let Some(rpm) = &rotor.rpm {
        give("rpm", rpm);
    }
    match &rotor.collective {
        Some(collective) => give("collective", collective),
        // The blade angles are those at a collective of 0.
        None if has_angles => given.push(Given::number("collective", 0.0, 0)),
        None => {}
    }
    if let Some(airfoil) = &rotor.airfoil {
        check_airfoils(std::slice::from_ref(airfoil.get_ref())).map_err(shape)?;
        let value = GivenValue::Text(airfoil.get_ref().clone());
        given.push(Given::new(
            "airfoil.file",
            value,
            line(airfoil.span().start),
        ));
    }
    if let Some(flapping) = &rotor.flapping {
        let speed = rotor.rpm.as_ref().map(|rpm| *rpm.get_ref());
        let found = flapping.given(&geometry, speed, line);
        given.extend(found.map_err(|(at, problem)| malformed(at, problem))?);
    }
    for (table, parameters) in [
        ("models", rotor.models),
        ("drive", rotor.drive),
        ("numerics", rotor.numerics),
    ] {
        let parameters = parameters.into_iter().flat_map(|p| p.0);
        given.extend(parameters.map(|(key, value)| {
            let at = line(value.span().start);
            Given::new(&format!("{table}.{key}"), value.into_inner(), at)
        }));
    }
    Ok(RotorDefinition {
        geometry,
        given,
        name: rotor.name,
        source: rotor.source,
        hash,
    })
}

fn rotation(word: &str) -> Result<Rotation, String> {
    let letters = word.chars().filter(|c| c.is_alphabetic());
    match letters
        .flat_map(char::to_lowercase)
        .collect::<String>()
        .as_str()
    {
        "cw" | "clockwise" => Ok(Rotation::Clockwise),
        "ccw" | "counterclockwise" | "anticlockwise" => Ok(Rotation::CounterClockwise),
        _ => Err(format!(
            "rotation is {:?}; write \"clockwise\" (or \"CW\") or \"counterClockwise\" (or \"CCW\"), seen from above",
            excerpt(word)
        )),
    }
}

/// Whether the stations have `angle` in place of `twist`. All have, or none.
fn has_angles(rotor: &RotorFile) -> Result<bool, GeometryError> {
    let fail = |text: String| Err(GeometryError(text));
    if let Some(station) = rotor
        .station
        .iter()
        .find(|s| s.twist.is_some() && s.angle.is_some())
    {
        return fail(format!(
            "the blade station r/R = {} has both twist and angle; give angle if the pitch of the section is known as it is at a collective of 0, otherwise twist",
            station.r
        ));
    }
    let angles = rotor.station.iter().filter(|s| s.angle.is_some()).count();
    if angles > 0 && angles < rotor.station.len() {
        return fail("some blade stations have angle and others do not; give all of them angle, or all of them twist".into());
    }
    if angles > 0 && rotor.pitch_reference_radius.is_some() {
        return fail("pitchReferenceRadius has no meaning with stations that have angle, to which the collective is added at every radius; leave it out".into());
    }
    Ok(angles > 0)
}

/// The stations with the airfoils that they name.
fn stations(from_file: Vec<FileStation>) -> Result<(Vec<Station>, Vec<String>), GeometryError> {
    if from_file.len() > MAX_STATIONS {
        return Err(GeometryError(format!(
            "there are {} stations; leave some out, so that there are {MAX_STATIONS} or fewer",
            from_file.len()
        )));
    }
    if let Some(last) = from_file.last()
        && last.r > *TIP.end()
    {
        return Err(GeometryError(format!(
            "the last blade station is at r = {}, but r is the radius over that of the tip, so that the tip is at 1; divide every r by the rotor radius",
            last.r
        )));
    }
    let mut airfoils: Vec<String> = Vec::new();
    let mut stations = Vec::with_capacity(from_file.len());
    for station in from_file {
        let known = airfoils.iter().position(|a| *a == station.airfoil);
        let airfoil = known.unwrap_or_else(|| {
            airfoils.push(station.airfoil);
            airfoils.len() - 1
        });
        stations.push(Station {
            radius_ratio: station.r,
            chord: station.chord,
            twist: station.angle.or(station.twist).unwrap_or(0.0).to_radians(),
            airfoil,
        });
    }
    if let Some(last) = stations.last_mut()
        && TIP.contains(&last.radius_ratio)
    {
        last.radius_ratio = 1.0;
    }
    check_airfoils(&airfoils)?;
    Ok((stations, airfoils))
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

/// Largest chord in the outer tenth of the radius: a rounded tip has a chord of 0 at its end.
fn largest_outer_chord(geometry: &Geometry) -> f64 {
    let at_its_inner_end = geometry.interpolate(0.9_f64.max(geometry.cutout()), |s| s.chord);
    let outer = geometry.stations.iter().filter(|s| s.radius_ratio >= 0.9);
    outer.map(|s| s.chord).fold(at_its_inner_end, f64::max)
}

#[cfg(test)]
mod tests {
    use super::super::BladeInertia;
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
        let geometry = shape(GOOD).unwrap();
        assert_eq!(geometry.blades, 2);
        assert_eq!(geometry.airfoils, ["airfoils/circle.polar", ""]);
        assert!((geometry.stations[0].twist.to_degrees() - 4.0).abs() < 1e-12);
        assert_eq!(geometry.tip_chord, 0.1, "the rounded tip does not count");
        assert_eq!(geometry.rotation, Rotation::CounterClockwise);
        for (word, rotation) in [
            ("clockwise", Rotation::Clockwise),
            ("CW", Rotation::Clockwise),
            ("cw", Rotation::Clockwise),
            ("CCW", Rotation::CounterClockwise),
            ("counterClockwise", Rotation::CounterClockwise),
            ("counter-clockwise", Rotation::CounterClockwise),
        ] {
            let geometry = shape(&format!("rotation = \"{word}\"\n{GOOD}")).unwrap();
            assert_eq!(geometry.rotation, rotation, "{word}");
        }
    }

    fn definition(text: &str) -> Result<RotorDefinition, RotorFileError> {
        parse(text, "x.toml", 0)
    }

    fn shape(text: &str) -> Result<Geometry, RotorFileError> {
        definition(text).map(|definition| definition.geometry)
    }

    fn error(text: &str) -> String {
        definition(text).unwrap_err().to_string()
    }

    #[test]
    fn blade_angles_are_the_pitch_at_a_collective_of_0_at_every_radius() {
        let text = GOOD.replace("twist", "angle");
        let found = definition(&text).unwrap();
        for (radius, degrees) in [(0.2, 4.0), (0.575, 3.0), (0.95, 2.0), (1.0, 0.0)] {
            let pitch = found.geometry.twist(radius).to_degrees();
            assert!((pitch - degrees).abs() < 1e-12, "{radius}: {pitch}");
        }
        // The collective is added to them, and is 0 unless the file gives one.
        let collective = |text: &str| {
            let given = definition(text).unwrap().given;
            let given = given.into_iter().find(|g| g.name == "collective");
            given.map(|g| g.value)
        };
        assert_eq!(collective(&text), Some(GivenValue::Number(0.0)));
        let own = format!("collective = 3\n{text}");
        assert_eq!(collective(&own), Some(GivenValue::Number(3.0)));
        assert_eq!(collective(GOOD), None);
        for (text, part) in [
            (
                GOOD.replacen("twist", "angle", 1),
                "some blade stations have angle",
            ),
            (
                GOOD.replacen("twist", "angle = 1.0, twist", 1),
                "both twist and angle",
            ),
            (
                format!("pitchReferenceRadius = 0.75\n{text}"),
                "pitchReferenceRadius has no meaning with stations that have angle",
            ),
        ] {
            assert!(error(&text).contains(part), "{}", error(&text));
        }
    }

    #[test]
    fn two_stations_at_one_radius_are_a_step() {
        let at = |r: f64, extra: &str| {
            let step =
                format!("r = 0.95, chord = 0.1, twist = 2.0 }},\n    {{ r = {r}, chord = 0.2");
            GOOD.replace("r = 0.95, chord = 0.1", &(step + extra))
        };
        let geometry = shape(&at(0.95, "")).unwrap();
        let chords = [0.949_999, 0.95].map(|r| geometry.chord(r));
        assert!(
            (chords[0] - 0.1).abs() < 1e-12 && (chords[1] - 0.2).abs() < 1e-12,
            "{chords:?}"
        );
        // 0.75 of a chord of 0.1 m, and a triangle.
        let area = geometry.solidity() * std::f64::consts::PI * 1.5 * 1.5 / 2.0;
        assert!(
            (area - 1.5 * (0.75 * 0.1 + 0.05 * 0.1)).abs() < 1e-12,
            "{area}"
        );
        assert!((geometry.gap(1) - 0.75).abs() < 1e-12 && (geometry.gap(2) - 0.05).abs() < 1e-12);
        let third = ", twist = 2.0 },\n    { r = 0.95, chord = 0.3";
        let message = error(&at(0.95, third));
        assert!(
            message.contains("r/R = 0.95 is given three times; two stations"),
            "{message}"
        );
        let message = error(&GOOD.replace("r = 0.95", "r = 1.0"));
        assert!(
            message.contains("r/R = 1.0 is given twice; two stations"),
            "{message}"
        );
    }

    #[test]
    fn a_tip_that_is_rounded_is_the_tip_and_a_radius_in_metres_is_named() {
        for tip in ["0.9999", "0.999", "1.0005", "1"] {
            let geometry = shape(&GOOD.replace("r = 1.0", &format!("r = {tip}"))).unwrap();
            assert_eq!(geometry.stations.last().unwrap().radius_ratio, 1.0);
        }
        let message = error(&GOOD.replace("r = 1.0", "r = 0.99"));
        assert!(message.contains("the last at r/R = 1"), "{message}");
        let message = error(&GOOD.replace("r = 1.0", "r = 1.5"));
        assert!(
            message.contains("the last blade station is at r = 1.5")
                && message.contains("divide every r"),
            "{message}"
        );
    }

    #[test]
    fn what_the_file_gives_for_parameters_is_handed_on_with_its_line() {
        let text = format!(
            "rpm = 400\ncollective = 6.5\nairfoil = \"a.polar\"\n{GOOD}[flapping]\nhub = \"hinged\"\n\
             lockNumber = 8\nhingeOffset = 0.05\nprecone = 2\n[models]\ninflow = \"drees\"\n\
             [drive]\ninertia = 3\n[numerics]\nelements = 60\n"
        );
        let given = definition(&text).unwrap().given;
        let shown: Vec<String> = given
            .iter()
            .map(|g| format!("{}: {} = {}", g.line, g.name, g.value))
            .collect();
        assert_eq!(
            shown,
            [
                "1: rpm = 400",
                "2: collective = 6.5",
                "3: airfoil.file = \"a.polar\"",
                "13: flapping.enabled = true",
                "15: flapping.hingeOffset = 0.05",
                "16: flapping.precone = 2",
                "18: models.inflow = \"drees\"",
                "20: drive.inertia = 3",
                "22: numerics.elements = 60",
            ]
        );
        assert_eq!(given[8].value, GivenValue::Integer(60));
        assert!(definition(GOOD).unwrap().given.is_empty());
    }

    /// Johnson 1980, eq. 5-145: nu^2 = 1 + 3/2 e/(1 - e) + k/(I Omega^2).
    #[test]
    fn a_hingeless_hub_has_the_spring_of_its_flapping_frequency() {
        let hub = |keys: &str| {
            format!("rpm = 400\n{GOOD}[flapping]\nhub = \"hingeless\"\ninertia = 2\n{keys}\n")
        };
        let given = definition(&hub("flapFrequency = 1.12\nhingeOffset = 0.1"))
            .unwrap()
            .given;
        let spring = given
            .iter()
            .find(|g| g.name == "flapping.hingeSpring")
            .unwrap();
        let GivenValue::Number(spring) = spring.value else {
            panic!()
        };
        let speed = 400.0 * std::f64::consts::PI / 30.0;
        let frequency = (1.0 + 1.5 * 0.1 / 0.9 + spring / (2.0 * speed * speed)).sqrt();
        assert!((frequency - 1.12).abs() < 1e-12, "{frequency}");
        for (text, part) in [
            (hub(""), "a hingeless hub needs the spring"),
            (hub("flapFrequency = 1.1\nhingeSpring = 5"), "leave one out"),
            (
                hub("flapFrequency = 1.05\nhingeOffset = 0.1"),
                "it must be at least 1.0801",
            ),
            (hub("flapFrequency = nan"), "flapFrequency is NaN"),
            (
                hub("flapFrequency = 1.1").replace("rpm = 400\n", ""),
                "flapFrequency needs rpm",
            ),
        ] {
            assert!(error(&text).contains(part), "{}", error(&text));
        }
        assert!(definition(&hub("hingeSpring = 500")).is_ok());
    }

    #[test]
    fn unknown_names_are_refused_with_the_nearest_known_one() {
        let with = |line: &str| format!("{line}\n{GOOD}");
        let flapping = |line: &str| format!("{GOOD}[flapping]\ninertia = 1\n{line}\n");
        for (text, part) in [
            (
                with("Rotation = \"CW\""),
                "x.toml, line 1, column 1: unknown field `Rotation`",
            ),
            (with("Rotation = \"CW\""), "; did you mean `rotation`?"),
            (with("blades = 3"), "; did you mean `numberOfBlades`?"),
            (
                with("rotation = \"left\""),
                "line 1, column 12: rotation is \"left\"; write",
            ),
            (flapping("preconing = 2"), "; did you mean `precone`?"),
            (
                flapping("hinge_offset = 0.1"),
                "; did you mean `hingeOffset`?",
            ),
            (
                flapping("hub = \"hinge\""),
                "hub is \"hinge\"; write one of \"hinged\"",
            ),
            (flapping("hub = \"hinge\""), "; did you mean \"hinged\"?"),
            (
                GOOD.replace("chord = 0.0", "cord = 0.0"),
                "; did you mean `chord`?",
            ),
            (with("model = 1"), "; did you mean `models`?"),
        ] {
            assert!(error(&text).contains(part), "{}", error(&text));
        }
        let message = error(&with("wingspan = 3"));
        assert!(!message.contains("did you mean"), "{message}");
        let message = error(&format!("{GOOD}[models]\ninflow = [1, 2]\n"));
        assert!(
            message.contains("expected a number, true or false, or a text"),
            "{message}"
        );
    }

    #[test]
    fn the_inertia_of_the_blades_is_read() {
        let inertia = |flapping: &str| shape(&format!("{GOOD}{flapping}"));
        for (flapping, expected) in [
            ("", None),
            ("[flapping]\ninertia = 2.5", Some(BladeInertia::Moment(2.5))),
            ("[flapping]\nhub = \"rigid\"\nprecone = 2", None),
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
            ("[flapping]\nprecone = 2", "needs either inertia"),
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
            let error = parse(&GOOD.replacen(from, to, 1), "bad.toml", 0)
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
        let read = |text: String| shape(&text).map_err(|error| error.to_string());
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
                "; write \"clockwise\"",
            ),
            ("1.5", "1".repeat(100_000), "line 3, column 10"),
        ] {
            let text = GOOD.replacen(from, &to, 1);
            let error = parse(&text, "bad.toml", 0).unwrap_err().to_string();
            assert!(error.contains(part) && error.len() < 350, "{error}");
            assert!(error.matches('x').count() <= 90, "{error}");
        }
    }
}
