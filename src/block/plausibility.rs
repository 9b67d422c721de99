//! Warnings of values that are permitted but are probably a slip. Each is a sentence that names
//! the value and the slip.

use super::{
    shown::shown,
    values::Values,
    variables::{
        Causality, INTEGERS, InflowModel, REALS, RealRef, Variable, integer, real, string,
    },
};
use core::f64::consts::{FRAC_PI_2, FRAC_PI_3, PI};
use rotor::{
    OperatingPoint, Rotor,
    airfoil::{Airfoil, Axis},
    geometry::{Missed, lock_number},
    scalar::Scalar,
};

/// Largest chord over the rotor radius, from the most slender blades to wide propellers.
const CHORD_RATIOS: (f64, f64) = (0.015, 0.5);

const MAX_SOLIDITY: f64 = 0.5;

/// Largest blade pitch, and largest difference of twist along a blade, rad.
const MAX_PITCH: f64 = FRAC_PI_3;

/// Pitch at an element up to which the closed form, which takes angles for their sines and tangents,
/// has less than 5 % too much thrust in hover, rad.
const MAX_SMALL_PITCH: f64 = PI / 9.0;

/// Lock numbers of built rotors.
const LOCK_NUMBERS: (f64, f64) = (1.0, 20.0);

/// Lock number of an ordinary helicopter.
const USUAL_LOCK_NUMBER: f64 = 8.0;

/// Ratio of a Reynolds number to the nearest of the data up to which these serve. At this ratio the
/// friction drag of a turbulent boundary layer differs by a quarter.
const REYNOLDS_RATIO: f64 = 3.0;

/// The radius r/R whose Reynolds number stands for the blade.
const TYPICAL_RADIUS: f64 = 0.75;

/// Airspeed over tip speed up to which a rotor counts as hovering.
const HOVER: f64 = 0.01;

/// Thrust coefficient down to which a negative thrust counts as 0.
const NO_THRUST: f64 = -1e-5;

/// A rotor at the end of initialisation, whose outputs have been computed.
pub struct Initialized<'a> {
    pub values: &'a Values,
    pub rotor: &'a Rotor,
    pub point: &'a OperatingPoint,
    /// Reads the airfoils in the FMU, with their names. Called only if the rotor's own have no data
    /// for its Reynolds numbers.
    pub shipped: &'a dyn Fn() -> Vec<(String, Airfoil)>,
}

/// The warnings; none for an ordinary rotor.
pub fn warnings(start: &Initialized) -> Vec<String> {
    let mut warnings = large_angles(start.values);
    let others = [
        chord(start),
        solidity(start),
        twist_of_file(start),
        small_angles(start),
        replaced(start.values),
        missed_station(start),
        tip_mach(start),
        reynolds(start),
        lock(start),
        thrust(start),
    ];
    warnings.extend(others.into_iter().flatten());
    warnings
}

/// The angle as it would be if it had been given in degrees: "8 deg = 0.1396 rad".
pub fn in_degrees(value: f64) -> String {
    format!("{} deg = {:.4} rad", shown(value), value.to_radians())
}

/// "geometry.radius = 0.762 m".
fn set(values: &Values, reference: RealRef) -> String {
    let Variable { name, unit, .. } = reference.variable();
    format!("{name} = {} {unit}", shown(values.reals[reference]))
}

/// Three significant digits.
fn rounded(value: f64) -> String {
    shown(format!("{value:.2e}").parse().unwrap_or(value))
}

/// The variables or the file that give the shape.
fn shape(values: &Values, parameters: &str) -> String {
    match values.strings[string::GEOMETRY__FILE].as_str() {
        "" => parameters.to_owned(),
        file => format!("geometry.file = {file:?}"),
    }
}

fn has_file(values: &Values) -> bool {
    !values.strings[string::GEOMETRY__FILE].is_empty()
}

fn large_angles(values: &Values) -> Vec<String> {
    // A shaft of 90 deg may be a little more by rounding.
    let upside_down = FRAC_PI_2 + 1e-9;
    let mut limits = vec![
        (real::COLLECTIVE, MAX_PITCH),
        (real::CYCLIC_LONGITUDINAL, MAX_PITCH),
        (real::CYCLIC_LATERAL, MAX_PITCH),
        (real::TILT, upside_down),
        (real::LATERAL_TILT, upside_down),
    ];
    if !has_file(values) {
        limits.push((real::GEOMETRY__TWIST, MAX_PITCH));
    }
    let large = limits
        .into_iter()
        .filter(|(reference, limit)| values.reals[*reference].abs() > *limit);
    let warning = |(reference, limit): (RealRef, f64)| {
        let value = values.reals[reference];
        format!(
            "{} is {:.1} deg, beyond {:.0} deg; was it given in degrees ({})?",
            set(values, reference),
            value.to_degrees(),
            limit.to_degrees(),
            in_degrees(value)
        )
    };
    large.map(warning).collect()
}

fn chord(start: &Initialized) -> Option<String> {
    let geometry = start.rotor.geometry();
    let (chord, radius) = (geometry.largest_chord(), geometry.radius);
    let slip = if chord > CHORD_RATIOS.1 * radius {
        "was the chord given in mm?"
    } else if chord < CHORD_RATIOS.0 * radius {
        "was the chord given as c/R, or the radius in mm?"
    } else {
        return None;
    };
    Some(format!(
        "{}: the largest chord is {} m and the radius {} m; their ratio is {}, and {} to {} is usual: {slip} Both are in m",
        shape(start.values, "geometry.chord and geometry.radius"),
        shown(chord),
        shown(radius),
        rounded(chord / radius),
        CHORD_RATIOS.0,
        CHORD_RATIOS.1
    ))
}

fn solidity(start: &Initialized) -> Option<String> {
    let geometry = start.rotor.geometry();
    let solidity = geometry.solidity();
    (solidity > MAX_SOLIDITY).then(|| {
        format!(
            "{}: the solidity (blade area over disc area) of the {} blades is {}, above {MAX_SOLIDITY}; are chord, radius and number of blades right?",
            shape(start.values, "geometry.chord, geometry.radius and geometry.numberOfBlades"),
            geometry.blades,
            rounded(solidity)
        )
    })
}

fn twist_of_file(start: &Initialized) -> Option<String> {
    let twist = start.rotor.geometry().stations.iter().map(|s| s.twist);
    let (low, high) = twist.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), twist| {
        (twist.min(low), twist.max(high))
    });
    (has_file(start.values) && high - low > MAX_PITCH).then(|| {
        format!(
            "{}: the twist varies by {:.1} deg along the blade, beyond 60 deg; is it in degrees, and measured from the same reference line at every station?",
            shape(start.values, ""),
            (high - low).to_degrees()
        )
    })
}

/// Pitch of the closed form beyond the small angles that it assumes.
fn small_angles(start: &Initialized) -> Option<String> {
    let model = start.values.integers[integer::MODELS__INFLOW];
    let twist = &start.rotor.elements().twist;
    let pitch = twist.iter().map(|twist| start.point.collective + twist);
    let largest = pitch.fold(0.0, |a: f64, b| if b.abs() > a.abs() { b } else { a });
    (model == InflowModel::AnnulusClosedForm as i32 && largest.abs() > MAX_SMALL_PITCH).then(|| {
        format!(
            "models.inflow = annulusClosedForm assumes small angles and attached flow, but the pitch reaches {:.0} deg; beyond {:.0} deg its thrust is too large by 5 % and more: set models.inflow to annulus",
            largest.to_degrees(),
            MAX_SMALL_PITCH.to_degrees()
        )
    })
}

/// Parameters of the shape that were set although a rotor file replaces them.
fn replaced(values: &Values) -> Option<String> {
    fn is_shape<T>(variable: &Variable<T>) -> bool {
        variable.causality == Causality::Parameter && variable.name.starts_with("geometry.")
    }
    let file = values.strings[string::GEOMETRY__FILE].as_str();
    let reals = REALS.iter().zip(values.reals);
    let reals = reals
        .filter(|(v, value)| is_shape(v) && *value != v.start)
        .map(|(v, _)| v.name);
    let integers = INTEGERS.iter().zip(values.integers);
    let integers = integers.filter(|(v, value)| is_shape(v) && *value != v.start);
    let names: Vec<&str> = reals.chain(integers.map(|(v, _)| v.name)).collect();
    (!file.is_empty() && !names.is_empty()).then(|| {
        format!(
            "{} without effect, because geometry.file = {file:?} gives the shape of the rotor; set geometry.file to \"\", or change the file",
            match names[..] {
                [name] => format!("{name} was set"),
                _ => format!("{} were set", names.join(", ")),
            }
        )
    })
}

fn missed_station(start: &Initialized) -> Option<String> {
    let (geometry, elements) = (start.rotor.geometry(), start.rotor.elements());
    let (index, missed) = elements.missed_station(geometry)?;
    let station = &geometry.stations[index];
    let what = match missed {
        Missed::Airfoil => match geometry.airfoils[station.airfoil].as_str() {
            "" => "the airfoil in airfoil.file".to_owned(),
            name => format!("the airfoil {name:?}"),
        },
        Missed::Twist => "the twist".to_owned(),
        Missed::Chord => "the chord".to_owned(),
    };
    let variable = integer::NUMERICS__ELEMENTS.variable();
    let enough = ((1.0 - geometry.cutout()) / geometry.gap(index)).ceil();
    let remedy = if enough <= f64::from(variable.max) {
        format!("set {} to {enough} or more", variable.name)
    } else {
        "move the stations apart".to_owned()
    };
    Some(format!(
        "{} = {} is too few: an element is {} R wide and misses {what} of the blade station r/R = {} in {}; {remedy}",
        variable.name,
        elements.len(),
        rounded(elements.width / geometry.radius),
        shown(station.radius_ratio),
        shape(start.values, "the geometry"),
    ))
}

fn tip_mach(start: &Initialized) -> Option<String> {
    let reals = &start.values.reals;
    let hover = reals[real::TIP_MACH];
    let air = &start.point.airspeed;
    let edgewise = start.point.speed * start.rotor.geometry().radius + Scalar::hypot(air.x, air.y);
    let advancing = Scalar::hypot(edgewise, air.z) / start.point.air.speed_of_sound;
    let elements = start.rotor.elements();
    let tip = elements.outer_airfoil.last()?;
    let airfoil = &start.rotor.airfoils()[*tip];
    let limit = if advancing > 1.0 {
        "above 1, where no model of this FMU holds".to_owned()
    } else {
        let (_, highest) = airfoil.range(Axis::Mach)?;
        if advancing <= highest {
            return None;
        }
        format!(
            "beyond the highest Mach number, {highest}, in the airfoil file of {:?}, whose data at that number are used",
            airfoil.name()
        )
    };
    Some(format!(
        "the Mach number of the blade tip is {} ({} by rotation alone), {limit}; are {}, the radius of {} m and the airspeed right? rpm is in rev/min",
        rounded(advancing),
        rounded(hover),
        set(start.values, real::RPM),
        shown(start.rotor.geometry().radius),
    ))
}

fn reynolds(start: &Initialized) -> Option<String> {
    let rotor = start.rotor;
    let (geometry, elements) = (rotor.geometry(), rotor.elements());
    let typical = elements
        .radius
        .partition_point(|r| *r < TYPICAL_RADIUS * geometry.radius);
    let typical = typical.min(elements.len() - 1);
    let radius = elements.radius[typical] / geometry.radius;
    let index = if elements.outer_share[typical] < 0.5 {
        elements.inner_airfoil[typical]
    } else {
        elements.outer_airfoil[typical]
    };
    let airfoil = &rotor.airfoils()[index];
    let point = start.point;
    let speed = point.speed * elements.radius[typical];
    let reynolds = point.air.density * speed * geometry.chord(radius) / point.air.viscosity;
    let serves = |airfoil: &Airfoil, ratio: f64| match airfoil.range(Axis::Reynolds) {
        Some((low, high)) => low / ratio <= reynolds && reynolds <= high * ratio,
        None => true,
    };
    // A rotor at rest will turn.
    if reynolds == 0.0 || !airfoil.lifts() || serves(airfoil, REYNOLDS_RATIO) {
        return None;
    }
    let (low, high) = airfoil.range(Axis::Reynolds)?;
    let mut fitting: Vec<String> = (start.shipped)()
        .into_iter()
        .filter(|(_, other)| {
            let has_range = other.range(Axis::Reynolds).is_some();
            let is_alike = other.has_laws() == airfoil.has_laws() && other.lifts();
            has_range && is_alike && serves(other, 1.0)
        })
        .map(|(name, _)| name)
        .collect();
    fitting.sort();
    let remedy = if fitting.is_empty() {
        "no file in the FMU has data there; give one of your own".to_owned()
    } else {
        format!(
            "these files in the FMU have data there: {}",
            fitting.join(", ")
        )
    };
    let (file, parameter) = match geometry.airfoils[index].as_str() {
        "" => (
            start.values.strings[string::AIRFOIL__FILE].as_str(),
            "airfoil.file",
        ),
        station => (station, "the airfoil of the stations in geometry.file"),
    };
    Some(format!(
        "the Reynolds number at r/R = {radius:.2} is {}, but the airfoil file {file:?} has no data near it, only {}; the nearest data are used. For another section change {parameter}; {remedy}",
        rounded(reynolds),
        if low == high {
            format!("for {}", rounded(low))
        } else {
            format!("from {} to {}", rounded(low), rounded(high))
        }
    ))
}

fn lock(start: &Initialized) -> Option<String> {
    let hinge = &start.rotor.models().hinge;
    hinge.freedom?;
    let inertia = hinge.mass.inertia;
    let geometry = start.rotor.geometry();
    let lock = lock_number(geometry, inertia);
    (!(LOCK_NUMBERS.0..=LOCK_NUMBERS.1).contains(&lock)).then(|| {
        format!(
            "the Lock number rho a c R^4/I of the flapping blades is {}, where {} to {} is usual; does the moment of inertia of {} kg.m2 (from flapping.inertia, flapping.lockNumber or geometry.file) belong to a blade of {} m? For a Lock number of {USUAL_LOCK_NUMBER} it would be {} kg.m2",
            rounded(lock),
            LOCK_NUMBERS.0,
            LOCK_NUMBERS.1,
            shown(inertia),
            shown(geometry.radius),
            rounded(inertia * lock / USUAL_LOCK_NUMBER)
        )
    })
}

fn thrust(start: &Initialized) -> Option<String> {
    let (reals, point) = (&start.values.reals, start.point);
    let tip_speed = point.speed * start.rotor.geometry().radius;
    let hovers = tip_speed > 0.0 && point.airspeed.norm() <= HOVER * tip_speed;
    (hovers && reals[real::THRUST_COEFFICIENT] < NO_THRUST).then(|| {
        format!(
            "the hovering rotor pushes downwards at the start, with a thrust of {} N; is the sign of {} right, and is it the pitch at geometry.pitchReferenceRadius, r/R = {}?",
            rounded(reals[real::THRUST]),
            set(start.values, real::COLLECTIVE),
            shown(start.rotor.geometry().pitch_reference_radius)
        )
    })
}

#[cfg(test)]
mod tests {
    use super::super::{Note, RotorBlock, variables::boolean};
    use super::*;
    use std::{fs, path::Path};

    const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

    /// The warnings at the end of the initialisation of a block with these changes.
    fn warned(change: impl FnOnce(&mut RotorBlock)) -> Vec<String> {
        let mut block = RotorBlock::new(RESOURCES.into());
        change(&mut block);
        block.start().unwrap();
        let notes = block.take_notes().into_iter();
        let warnings = notes.filter_map(|note| match note {
            Note::Warning(text) => Some(text),
            Note::Event(_) => None,
        });
        warnings.collect()
    }

    fn with_reals(reals: &[(RealRef, f64)]) -> Vec<String> {
        warned(|block| {
            for (reference, value) in reals {
                block.set_reals(&[*reference], &[*value]).unwrap();
            }
        })
    }

    /// A rotor file of this test, and the given changes.
    fn with_file(name: &str, text: &str, change: impl FnOnce(&mut RotorBlock)) -> Vec<String> {
        let path = std::env::temp_dir().join(format!("{}-{name}", std::process::id()));
        fs::write(&path, text).unwrap();
        let warnings = warned(|block| {
            let file = path.to_str().unwrap();
            block
                .set_strings(&[string::GEOMETRY__FILE], &[file])
                .unwrap();
            change(block);
        });
        fs::remove_file(&path).unwrap();
        warnings
    }

    /// Asserts one warning that contains these parts.
    #[track_caller]
    fn says(warnings: &[String], parts: &[&str]) {
        let [warning] = warnings else {
            panic!("one warning is expected: {warnings:?}")
        };
        for part in parts {
            assert!(warning.contains(part), "{part:?} is not in: {warning}");
        }
    }

    /// The rotors in the FMU with a rotor speed at which they were tested, rev/min.
    const PRESETS: [(&str, f64); 7] = [
        ("caradonna-tung.toml", 1250.0),
        ("castles-gray-6ft.toml", 1200.0),
        ("castles-gray-6ft-twist12.toml", 1200.0),
        ("knight-hefner-3.toml", 960.0),
        ("knight-hefner-4.toml", 960.0),
        ("pca-2.toml", 140.0),
        ("thesis.toml", 430.0),
    ];

    #[test]
    fn ordinary_rotors_are_quiet() {
        let quiet: [String; 0] = [];
        assert_eq!(with_reals(&[]), quiet);
        let count = fs::read_dir(Path::new(RESOURCES).join("rotors"))
            .unwrap()
            .count();
        assert_eq!(count, PRESETS.len(), "a preset is not tested here");
        for (file, rpm) in PRESETS {
            let warnings = warned(|block| {
                block
                    .set_strings(&[string::GEOMETRY__FILE], &[file])
                    .unwrap();
                block.set_reals(&[real::RPM], &[rpm]).unwrap();
            });
            assert_eq!(warnings, quiet, "{file}");
        }
        for reals in [
            // Forward flight, climb, descent, a propeller, a rotor at rest, and one without pitch.
            &[(real::VELOCITY_1, 20.0), (real::TILT, 0.1)][..],
            &[(real::VELOCITY_3, 10.0)],
            &[(real::VELOCITY_3, -20.0)],
            &[
                (real::TILT, FRAC_PI_2),
                (real::VELOCITY_1, 20.0),
                (real::COLLECTIVE, 0.5),
            ],
            &[(real::RPM, 0.0)],
            &[(real::COLLECTIVE, 0.0)],
            &[(real::GEOMETRY__TWIST, -0.2), (real::COLLECTIVE, 0.3)],
        ] {
            assert_eq!(with_reals(reals), quiet, "{reals:?}");
        }
        // Flapping, and a helicopter: R = 5 m, chord 0.2 m, 400 rev/min, Lock number 5.
        let enabled = [boolean::FLAPPING__ENABLED];
        assert_eq!(
            warned(|block| block.set_booleans(&enabled, &[1]).unwrap()),
            quiet
        );
        let helicopter = warned(|block| {
            for (reference, value) in [
                (real::GEOMETRY__RADIUS, 5.0),
                (real::GEOMETRY__CHORD, 0.2),
                (real::GEOMETRY__TWIST, -0.14),
                (real::COLLECTIVE, 0.25),
                (real::RPM, 400.0),
                (real::FLAPPING__INERTIA, 180.0),
            ] {
                block.set_reals(&[reference], &[value]).unwrap();
            }
            block.set_booleans(&enabled, &[1]).unwrap();
            let file = "airfoils/naca0012.polar";
            block
                .set_strings(&[string::AIRFOIL__FILE], &[file])
                .unwrap();
        });
        assert_eq!(helicopter, quiet);
    }

    #[test]
    fn angles_beyond_60_deg_were_probably_given_in_degrees() {
        for (reference, name) in [
            (real::COLLECTIVE, "collective"),
            (real::CYCLIC_LONGITUDINAL, "cyclicLongitudinal"),
            (real::CYCLIC_LATERAL, "cyclicLateral"),
        ] {
            let expected = format!("{name} = 1.2 rad is 68.8 deg");
            let parts = [expected.as_str(), "in degrees (1.2 deg = 0.0209 rad)"];
            says(&with_reals(&[(reference, 1.2)]), &parts);
        }
        let twist = with_reals(&[(real::GEOMETRY__TWIST, 1.5)]);
        says(
            &twist,
            &[
                "geometry.twist = 1.5 rad is 85.9 deg",
                "1.5 deg = 0.0262 rad",
            ],
        );
        for (reference, name) in [(real::TILT, "tilt"), (real::LATERAL_TILT, "lateralTilt")] {
            let expected = format!("{name} = 8 rad is 458.4 deg");
            says(
                &with_reals(&[(reference, 8.0)]),
                &[&expected, "8 deg = 0.1396 rad"],
            );
        }
    }

    #[test]
    fn pitch_beyond_the_small_angles_of_the_closed_form() {
        let closed_form = |pitch: f64| {
            warned(|block| {
                let inflow = [integer::MODELS__INFLOW];
                let model = InflowModel::AnnulusClosedForm as i32;
                block.set_integers(&inflow, &[model]).unwrap();
                block.set_reals(&[real::COLLECTIVE], &[pitch]).unwrap();
            })
        };
        assert_eq!(closed_form(0.3), [""; 0]);
        says(&closed_form(0.62), &["annulusClosedForm", "reaches 36 deg"]);
        assert_eq!(with_reals(&[(real::COLLECTIVE, 0.62)]), [""; 0]);
    }

    #[test]
    fn chord_and_radius_in_other_units() {
        let one_blade = |reals: &[(RealRef, f64)]| {
            warned(|block| {
                let blades = [integer::GEOMETRY__NUMBER_OF_BLADES];
                block.set_integers(&blades, &[1]).unwrap();
                for (reference, value) in reals {
                    block.set_reals(&[*reference], &[*value]).unwrap();
                }
            })
        };
        let wide = one_blade(&[(real::GEOMETRY__CHORD, 0.6), (real::RPM, 60.0)]);
        says(
            &wide,
            &[
                "the largest chord is 0.6 m",
                "0.787",
                "was the chord given in mm?",
            ],
        );
        let slender = one_blade(&[(real::GEOMETRY__CHORD, 0.01), (real::RPM, 3000.0)]);
        says(
            &slender,
            &["geometry.chord", "0.0131", "was the chord given as c/R"],
        );
        let text = "numberOfBlades = 1\nradius = 1\nstation = [{ r = 0.2, chord = 0.1 }, { r = 1.0, chord = 0.7 }]\n";
        let file = with_file("wide.toml", text, |block| {
            block.set_reals(&[real::RPM], &[50.0]).unwrap();
        });
        says(&file, &["wide.toml", "the largest chord is 0.7 m"]);
    }

    #[test]
    fn blades_that_fill_the_disc() {
        let warnings = warned(|block| {
            let blades = [integer::GEOMETRY__NUMBER_OF_BLADES];
            block.set_integers(&blades, &[20]).unwrap();
            block.set_reals(&[real::GEOMETRY__CHORD], &[0.08]).unwrap();
        });
        says(&warnings, &["solidity", "20 blades is 0.557", "above 0.5"]);
    }

    const TWISTED: &str =
        "numberOfBlades = 2\nradius = 0.762\npitchReferenceRadius = 0.75\nstation = [
        { r = 0.2, chord = 0.05, twist = 0 },
        { r = 0.75, chord = 0.05, twist = 0 },
        { r = 0.76, chord = 0.05, twist = 9 },
        { r = 0.77, chord = 0.05, twist = 0 },
        { r = 1.0, chord = 0.05, twist = 0 },
    ]\n";

    #[test]
    fn twist_in_a_file() {
        let text = TWISTED.replace(
            "r = 1.0, chord = 0.05, twist = 0",
            "r = 1.0, chord = 0.05, twist = -70",
        );
        let text = text.replace("twist = 9", "twist = 0");
        let warnings = with_file("twist.toml", &text, |block| {
            block.set_reals(&[real::COLLECTIVE], &[0.6]).unwrap();
        });
        says(&warnings, &["twist.toml", "varies by 70.0 deg"]);
    }

    #[test]
    fn parameters_that_a_rotor_file_replaces() {
        let changed = |reals: &[(RealRef, f64)]| {
            warned(|block| {
                let file = "knight-hefner-3.toml";
                block
                    .set_strings(&[string::GEOMETRY__FILE], &[file])
                    .unwrap();
                for (reference, value) in reals {
                    block.set_reals(&[*reference], &[*value]).unwrap();
                }
            })
        };
        let one = changed(&[(real::GEOMETRY__RADIUS, 1.0)]);
        says(
            &one,
            &[
                "geometry.radius was set without effect",
                "knight-hefner-3.toml",
            ],
        );
        let two = changed(&[(real::GEOMETRY__RADIUS, 1.0), (real::GEOMETRY__CHORD, 0.1)]);
        says(&two, &["geometry.radius, geometry.chord were set"]);
        assert_eq!(
            changed(&[(real::GEOMETRY__RADIUS, 0.762)]),
            [""; 0],
            "the default"
        );
    }

    #[test]
    fn stations_that_the_elements_miss() {
        let set = |elements: i32| {
            move |block: &mut RotorBlock| {
                let count = [integer::NUMERICS__ELEMENTS];
                block.set_integers(&count, &[elements]).unwrap();
            }
        };
        let coarse = with_file("missed.toml", TWISTED, set(8));
        says(
            &coarse,
            &[
                "numerics.elements = 8 is too few",
                "the twist of",
                "r/R = 0.76",
                "to 80 or more",
            ],
        );
        assert_eq!(with_file("met.toml", TWISTED, set(80)), [""; 0]);
        let paddle = TWISTED.replace("twist = 9", "twist = 0, airfoil = \"circle.polar\"");
        let narrow = paddle
            .replace("r = 0.77", "r = 0.76002")
            .replace("r = 0.75,", "r = 0.75998,");
        let warnings = with_file("airfoil.toml", &narrow, set(40));
        says(
            &warnings,
            &[
                "the airfoil \"circle.polar\" of the blade",
                "move the stations apart",
            ],
        );
        assert_eq!(with_file("wide-airfoil.toml", &paddle, set(80)), [""; 0]);
        let wide = TWISTED.replace(
            "r = 0.76, chord = 0.05, twist = 9",
            "r = 0.76, chord = 0.15, twist = 0",
        );
        let warnings = with_file("chord.toml", &wide, set(20));
        says(
            &warnings,
            &[
                "numerics.elements = 20",
                "the chord of the blade station r/R = 0.76",
            ],
        );
        assert_eq!(with_file("wide-chord.toml", &wide, set(80)), [""; 0]);
    }

    #[test]
    fn a_tip_beyond_the_speed_of_sound_or_the_table() {
        let at = |reals: &[(RealRef, f64)]| {
            warned(|block| {
                let file = "airfoils/naca0012.polar";
                block
                    .set_strings(&[string::AIRFOIL__FILE], &[file])
                    .unwrap();
                for (reference, value) in reals {
                    block.set_reals(&[*reference], &[*value]).unwrap();
                }
            })
        };
        let fast = at(&[(real::RPM, 5000.0)]);
        says(
            &fast,
            &[
                "Mach number of the blade tip is 1.17",
                "above 1",
                "rpm = 5000 rev/min",
            ],
        );
        let advancing = at(&[(real::RPM, 3500.0), (real::VELOCITY_1, 70.0)]);
        says(&advancing, &["is 1.03 (0.821 by rotation alone)"]);
        let stopped = at(&[(real::RPM, 0.0), (real::VELOCITY_1, 500.0)]);
        says(&stopped, &["is 1.47 (0 by rotation alone)"]);
        let path = std::env::temp_dir().join(format!("{}-two-machs.c81", std::process::id()));
        let table = |values: &str| format!("0.1 0.3\n-180 {values}\n180 {values}\n");
        let text = format!("two 2 2 2 2\n{}{}", table("0 0"), table("0.01 0.02"));
        fs::write(&path, text).unwrap();
        let warnings = warned(|block| {
            let file = path.to_str().unwrap();
            block
                .set_strings(&[string::AIRFOIL__FILE], &[file])
                .unwrap();
            block.set_reals(&[real::RPM], &[1500.0]).unwrap();
        });
        fs::remove_file(&path).unwrap();
        says(
            &warnings,
            &["0.352", "beyond the highest Mach number, 0.3,"],
        );
    }

    #[test]
    fn reynolds_numbers_far_from_the_data_and_files_that_have_them() {
        let large = with_reals(&[
            (real::GEOMETRY__RADIUS, 5.0),
            (real::GEOMETRY__CHORD, 0.3),
            (real::RPM, 400.0),
        ]);
        says(
            &large,
            &[
                "only for 242000",
                "change airfoil.file",
                "airfoils/naca0012.polar",
                "goettingen429",
            ],
        );
        for absent in ["circle", "naca0015.txt", "wheatley", "knight-hefner"] {
            assert!(
                !large[0].contains(&format!("airfoils/{absent}")),
                "{}",
                large[0]
            );
        }
        let small = with_reals(&[(real::RPM, 20.0)]);
        says(&small, &["no file in the FMU has data there"]);
        let station = warned(|block| {
            let file = "pca-2.toml";
            block
                .set_strings(&[string::GEOMETRY__FILE], &[file])
                .unwrap();
            block.set_reals(&[real::RPM], &[14.0]).unwrap();
        });
        says(
            &station,
            &["change the airfoil of the stations in geometry.file"],
        );
    }

    #[test]
    fn lock_numbers_of_blades_of_another_size() {
        let with_inertia = |inertia: f64| {
            warned(|block| {
                let enabled = [boolean::FLAPPING__ENABLED];
                block.set_booleans(&enabled, &[1]).unwrap();
                block
                    .set_reals(&[real::FLAPPING__INERTIA], &[inertia])
                    .unwrap();
            })
        };
        says(
            &with_inertia(0.005),
            &["Lock number", "is 23.9", "flapping.inertia", "0.005 kg.m2"],
        );
        says(
            &with_inertia(0.5),
            &["Lock number", "is 0.239", "it would be 0.0149 kg.m2"],
        );
    }

    #[test]
    fn a_hovering_rotor_that_pushes_downwards() {
        let pushes = with_reals(&[(real::COLLECTIVE, -0.1)]);
        says(
            &pushes,
            &["pushes downwards", "collective = -0.1 rad", "r/R = 0"],
        );
        let in_climb = with_reals(&[(real::COLLECTIVE, 0.02), (real::VELOCITY_3, 10.0)]);
        assert_eq!(in_climb, [""; 0]);
    }
}
