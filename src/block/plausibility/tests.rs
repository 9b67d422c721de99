//! Each warning, and that ordinary rotors are quiet.

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
const PRESETS: [(&str, f64); 13] = [
    ("apc-10x7sf.toml", 6000.0),
    ("bo-105.toml", 442.0),
    ("caradonna-tung.toml", 1250.0),
    ("castles-gray-6ft.toml", 1200.0),
    ("castles-gray-6ft-twist12.toml", 1200.0),
    ("harrington-1.toml", 382.0),
    ("hart-ii.toml", 1042.0),
    ("knight-hefner-3.toml", 960.0),
    ("knight-hefner-4.toml", 960.0),
    ("light-teetering.toml", 440.0),
    ("pca-2.toml", 140.0),
    ("thesis.toml", 430.0),
    ("uh-60a.toml", 257.8),
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

const TWISTED: &str = "numberOfBlades = 2\nradius = 0.762\npitchReferenceRadius = 0.75\nstation = [
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
            "set airfoil.file to \"airfoils/naca0015.polar\", the same section with data there",
            "for other sections the FMU has airfoils/goettingen429.polar, airfoils/naca0012.polar",
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
    says(
        &small,
        &["no file in the FMU has data there; set airfoil.file to one of your own"],
    );
    let station = warned(|block| {
        let file = "pca-2.toml";
        block
            .set_strings(&[string::GEOMETRY__FILE], &[file])
            .unwrap();
        block.set_reals(&[real::RPM], &[14.0]).unwrap();
    });
    says(
        &station,
        &[
            "set the airfoil of the stations in geometry.file to a file of your own or to one in the FMU with data there: airfoils/",
        ],
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
