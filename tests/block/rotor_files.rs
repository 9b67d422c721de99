//! Rotor files that give more than the shape: which value holds, and what the log says.

use crate::support::{
    block::{
        choice, choose, computed, default_block, get, project, resources, set, set_boolean,
        set_string,
    },
    fmu::scratch,
};
use helicopter_rotor::block::{
    Note, RotorBlock,
    variables::{boolean, integer, real, string},
};
use std::{fs, path::PathBuf};

/// A rotor with what a file can give besides the shape.
const ROTOR: &str = r#"numberOfBlades = 3
radius = 2.0
rpm = 400
collective = 6.0
station = [
    { r = 0.2, chord = 0.12, twist = 0.0 },
    { r = 1.0, chord = 0.12, twist = -6.0 },
]
[flapping]
hub = "hinged"
lockNumber = 8
hingeOffset = 0.05
precone = 2.0
delta3 = 10.0
highestAngle = 20.0
[models]
inflow = "drees"
tipLoss = "none"
[drive]
mode = "torque"
inertia = 12.5
[numerics]
elements = 20
"#;

/// Writes a file into a folder of one test, and returns its path.
fn written(test: &str, name: &str, text: &str) -> PathBuf {
    let folder = scratch().join("rotor-files").join(test);
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join(name);
    fs::write(&path, text).unwrap();
    path
}

fn with_file(test: &str, text: &str) -> RotorBlock {
    let mut block = default_block();
    let path = written(test, "rotor.toml", text);
    set_string(&mut block, string::GEOMETRY__FILE, path.to_str().unwrap());
    block
}

fn refused(test: &str, text: &str) -> String {
    let error = with_file(test, text).update().unwrap_err().to_string();
    assert!(error.contains("rotor.toml"), "{error}");
    error
}

/// The notes of what happened.
fn events(block: &mut RotorBlock) -> String {
    let notes = block.take_notes().into_iter();
    let texts = notes.map(|note| match note {
        Note::Event(text) | Note::Warning(text) => text + "\n",
    });
    texts.collect()
}

#[test]
fn a_file_gives_speed_collective_hub_models_and_drive() {
    let mut block = with_file("gives", ROTOR);
    block.update().unwrap();
    let values = block.values();
    for (reference, expected) in [
        (real::RPM, 400.0),
        (real::COLLECTIVE, 6.0_f64.to_radians()),
        (real::FLAPPING__HINGE_OFFSET, 0.05),
        (real::FLAPPING__PRECONE, 2.0_f64.to_radians()),
        (real::FLAPPING__DELTA3, 10.0_f64.to_radians()),
        (real::FLAPPING__HIGHEST_ANGLE, 20.0_f64.to_radians()),
        (real::DRIVE__INERTIA, 12.5),
    ] {
        let name = reference.variable().name;
        assert_eq!(values.reals[reference], expected, "{name}");
    }
    for (reference, name) in [
        (integer::MODELS__INFLOW, "drees"),
        (integer::MODELS__TIP_LOSS, "none"),
        (integer::DRIVE__MODE, "torque"),
    ] {
        assert_eq!(values.integers[reference], choice(reference, name));
    }
    assert_eq!(values.integers[integer::NUMERICS__ELEMENTS], 20);
    assert!(values.booleans[boolean::FLAPPING__ENABLED]);
    assert!((get(&block, real::ROTOR_SPEED) - 400.0).abs() < 1e-9);
    // The blades flap: without that the coning is the precone.
    let above = get(&block, real::CONING) - get(&block, real::FLAPPING__PRECONE);
    assert!(above.abs() > 1e-3, "{above}");
    let log = events(&mut block);
    for part in [
        "read the rotor's geometry from ",
        "rotor.toml; from it: rpm = 400 rev/min, collective = 6 deg, flapping.enabled = true, ",
        "flapping.hingeOffset = 0.05, flapping.precone = 2 deg",
        "models.inflow = \"drees\"",
        "drive.inertia = 12.5 kg.m2",
    ] {
        assert!(log.contains(part), "{part:?} is not in {log}");
    }
    assert!(!log.contains("set otherwise"), "{log}");
}

/// docs/rotor-files.md shows a file and what the log says of it.
#[test]
fn the_page_on_rotor_files_shows_the_log() {
    let page = fs::read_to_string(project().join("docs/rotor-files.md")).unwrap();
    let part = |begin: &str, end: &str| {
        let rest = page.split(begin).nth(1).unwrap();
        rest.split(end).next().unwrap().to_owned()
    };
    let path = written("page", "my-rotor.toml", &part("```toml\n", "```"));
    let section = resources().join("airfoils/naca0012.polar");
    fs::copy(section, path.with_file_name("my-section.polar")).unwrap();
    let mut block = default_block();
    set_string(&mut block, string::GEOMETRY__FILE, path.to_str().unwrap());
    choose(&mut block, integer::MODELS__INFLOW, "drees");
    block.update().unwrap();
    let log = events(&mut block).replace(path.to_str().unwrap(), "my-rotor.toml");
    let shown = part("<!-- log -->\n", "<!-- log -->");
    let shown = shown.trim();
    assert!(log.lines().any(|line| line == shown), "{shown}\n{log}");
}

/// The same numbers whether they come from the file or from the importer.
#[test]
fn a_value_of_the_file_acts_as_the_same_value_of_the_importer() {
    let (shape, _) = ROTOR.split_once("[flapping]").unwrap();
    let shape = shape.replace("rpm = 400\ncollective = 6.0\n", "");
    let shape = shape + "[flapping]\nlockNumber = 8\n";
    let mut own = with_file("acts-own", &shape);
    set(&mut own, real::RPM, 400.0);
    set(&mut own, real::COLLECTIVE, 6.0_f64.to_radians());
    set_string(
        &mut own,
        string::SETTINGS,
        "flapping.enabled = true; flapping.hingeOffset = 0.05; models.inflow = drees; \
         models.tipLoss = none; drive.mode = torque; drive.inertia = 12.5; numerics.elements = 20",
    );
    for (reference, degrees) in [
        (real::FLAPPING__PRECONE, 2.0_f64),
        (real::FLAPPING__DELTA3, 10.0),
        (real::FLAPPING__HIGHEST_ANGLE, 20.0),
    ] {
        set(&mut own, reference, degrees.to_radians());
    }
    let mut file = with_file("acts-file", ROTOR);
    for block in [&mut own, &mut file] {
        set(block, real::VELOCITY_1, 15.0);
        set(block, real::DRIVE_TORQUE, 100.0);
        block.start().unwrap();
        block.step(0.1).unwrap();
    }
    for output in [real::THRUST, real::ROTOR_SPEED, real::LONGITUDINAL_FLAPPING] {
        let pair = [&own, &file].map(|block| get(block, output).to_bits());
        assert_eq!(pair[0], pair[1], "{}", output.variable().name);
    }
}

#[test]
fn what_the_importer_sets_wins_over_the_file_in_any_order() {
    for file_first in [true, false] {
        let mut block = default_block();
        let path = written("wins", "rotor.toml", ROTOR);
        let path = path.to_str().unwrap();
        let set_file = |block: &mut RotorBlock| set_string(block, string::GEOMETRY__FILE, path);
        if file_first {
            set_file(&mut block);
            block.update().unwrap();
        }
        set(&mut block, real::FLAPPING__PRECONE, 0.01);
        // Its default, but an input that is set is set.
        set(&mut block, real::RPM, 960.0);
        set_string(
            &mut block,
            string::SETTINGS,
            "models.tipLoss = prandtl; flapping.delta3 = 0",
        );
        if !file_first {
            set_file(&mut block);
        }
        block.take_notes();
        block.update().unwrap();
        let values = block.values();
        assert_eq!(values.reals[real::FLAPPING__PRECONE], 0.01);
        assert_eq!(values.reals[real::RPM], 960.0);
        assert_eq!(values.reals[real::FLAPPING__DELTA3], 0.0);
        let tip_loss = values.integers[integer::MODELS__TIP_LOSS];
        assert_eq!(tip_loss, choice(integer::MODELS__TIP_LOSS, "prandtl"));
        // The others are the file's.
        assert_eq!(values.reals[real::FLAPPING__HINGE_OFFSET], 0.05);
        let log = events(&mut block);
        let kept = "set otherwise and kept: rpm, flapping.precone, flapping.delta3, models.tipLoss";
        assert!(log.contains(kept), "{file_first}: {log}");
    }
}

#[test]
fn without_the_file_everything_is_as_before_it() {
    let mut block = with_file("without", ROTOR);
    block.update().unwrap();
    set_string(&mut block, string::GEOMETRY__FILE, "");
    block.update().unwrap();
    let expected = computed(&[], &[]);
    assert_eq!(block.values(), expected.values());
    // A file that gives less, after one that gave more.
    let mut block = with_file("without", ROTOR);
    block.update().unwrap();
    set_string(&mut block, string::GEOMETRY__FILE, "pca-2.toml");
    block.update().unwrap();
    assert_eq!(block.values().reals[real::RPM], 960.0);
    assert!(!block.values().booleans[boolean::FLAPPING__ENABLED]);
}

/// Some importers write all their parameters again.
#[test]
fn the_importers_own_values_may_be_written_again_after_initialisation() {
    let mut block = with_file("again", ROTOR);
    block.start().unwrap();
    set(&mut block, real::FLAPPING__HINGE_OFFSET, 0.0);
    set(&mut block, real::FLAPPING__HINGE_OFFSET, 0.05);
    set_boolean(&mut block, boolean::FLAPPING__ENABLED, false);
    let drees = choice(integer::MODELS__INFLOW, "drees");
    for value in [choice(integer::MODELS__INFLOW, "annulus"), drees] {
        block
            .set_integers(&[integer::MODELS__INFLOW], &[value])
            .unwrap();
    }
    let values = block.values();
    assert_eq!(values.reals[real::FLAPPING__HINGE_OFFSET], 0.05);
    assert!(values.booleans[boolean::FLAPPING__ENABLED]);
    assert_eq!(values.integers[integer::MODELS__INFLOW], drees);
    let error = block.set_reals(&[real::FLAPPING__HINGE_OFFSET], &[0.1]);
    let error = error.unwrap_err().to_string();
    assert!(
        error.contains("flapping.hingeOffset is a fixed parameter"),
        "{error}"
    );
}

#[test]
fn a_saved_state_knows_what_the_file_gave() {
    let mut block = with_file("saved", ROTOR);
    block.update().unwrap();
    let snapshot = block.snapshot();
    assert_eq!(snapshot.check(), Ok(()));
    let mut other = default_block();
    other.restore(&snapshot).unwrap();
    set_string(&mut other, string::GEOMETRY__FILE, "");
    other.update().unwrap();
    assert_eq!(other.values(), computed(&[], &[]).values());

    block.start().unwrap();
    block.step(0.01).unwrap();
    let running = block.snapshot();
    let mut other = default_block();
    other.restore(&running).unwrap();
    for block in [&mut block, &mut other] {
        block.step(0.01).unwrap();
    }
    assert_eq!(get(&block, real::THRUST), get(&other, real::THRUST));
}

#[test]
fn wrong_values_and_unknown_keys_are_refused_with_line_and_remedy() {
    for (from, to, parts) in [
        (
            "precone = 2.0",
            "precone = 80",
            &[
                "line 13: flapping.precone is 80 deg, which is out of range; give a value from -30 to 30 deg",
            ][..],
        ),
        (
            "hingeOffset = 0.05",
            "hingeOffset = 0.95",
            &[
                "line 12: flapping.hingeOffset is 0.95, which is out of range; give a value from 0 to 0.5",
            ],
        ),
        (
            "\"drees\"",
            "\"dress\"",
            &[
                "models.inflow is \"dress\", which is no choice; write one of annulusClosedForm,",
                "did you mean drees?",
            ],
        ),
        (
            "tipLoss",
            "tiploss",
            &[
                "line 18: [models] has no key \"tiploss\"; did you mean tipLoss?",
                "its keys are inflow, blades",
            ],
        ),
        (
            "mode = \"torque\"",
            "mode = 2",
            &["drive.mode is 2; give the name of a choice"],
        ),
        (
            "elements = 20",
            "elements = 0",
            &["line 23: numerics.elements is 0, which is out of range"],
        ),
        (
            "elements = 20",
            "elements = 2.5",
            &["numerics.elements is 2.5; give an integer"],
        ),
        (
            "inertia = 12.5",
            "inertia = \"heavy\"",
            &["drive.inertia is \"heavy\"; give a number"],
        ),
        (
            "rpm = 400",
            "rpm = -400",
            &["line 3: rpm is -400 rev/min, which is out of range"],
        ),
        ("[drive]", "[engine]", &["unknown field `engine`"]),
    ] {
        let error = refused("wrong", &ROTOR.replacen(from, to, 1));
        for part in parts {
            assert!(error.contains(part), "{part:?} is not in: {error}");
        }
    }
}

#[test]
fn airfoils_are_found_beside_the_rotor_file_first() {
    let polar = "polar 1\nname Beside\nreynolds 1e6\n-180 0 0.03\n-10 -1 0.03\n0 0 0.01\n10 1 0.03\n180 0 0.03\n";
    let folder = scratch().join("rotor-files/beside/sections");
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("own.polar"), polar).unwrap();
    let station = ROTOR.replace(
        "twist = -6.0",
        "twist = -6.0, airfoil = \"sections/own.polar\"",
    );
    let standard = format!("airfoil = \"sections/own.polar\"\n{ROTOR}");
    for text in [station, standard] {
        let mut block = with_file("beside", &text);
        block.update().unwrap();
        let log = events(&mut block);
        assert!(log.contains("read airfoil \"Beside\" from "), "{log}");
    }
    // The importer's airfoil is not looked for there.
    let mut block = with_file("beside", ROTOR);
    set_string(&mut block, string::AIRFOIL__FILE, "sections/own.polar");
    assert!(block.update().is_err());
    // Those in the FMU are found, too.
    let shipped = ROTOR.replace("twist = -6.0", "twist = -6.0, airfoil = \"naca0012.polar\"");
    with_file("beside", &shipped).update().unwrap();
    let missing = ROTOR.replace("twist = -6.0", "twist = -6.0, airfoil = \"missing.polar\"");
    let error = refused("beside", &missing);
    assert!(
        error.contains("which is not beside the rotor file in "),
        "{error}"
    );
}

/// Thrust of the rotor in a file, in hover.
fn thrust(test: &str, text: &str) -> f64 {
    let mut block = with_file(test, text);
    block.update().unwrap();
    get(&block, real::THRUST)
}

#[test]
fn blade_angles_are_twist_from_a_collective_of_0() {
    let angles = ROTOR
        .replace("collective = 6.0", "collective = 1.5")
        .replace("twist = 0.0", "angle = 6.0")
        .replace("twist = -6.0", "angle = 0.0");
    // The twist at r/R = 0, where the collective is the pitch, is that of the line through the
    // stations: 7.5 deg.
    let twist = ROTOR.replace("collective = 6.0", "collective = 9.0");
    let [angles, twist] = [thrust("angles", &angles), thrust("twist", &twist)];
    assert!((angles / twist - 1.0).abs() < 1e-12, "{angles} {twist}");
}

#[test]
fn a_step_is_the_limit_of_stations_that_come_together() {
    let blade = |gap: f64| {
        let middle = format!(
            "{{ r = 0.6, chord = 0.12, twist = -3.0 }},\n    {{ r = {}, chord = 0.2, twist = -1.0 }},\n    {{ r = 1.0",
            0.6 + gap
        );
        ROTOR.replace("{ r = 1.0", &middle)
    };
    let step = thrust("step", &blade(0.0));
    let near = thrust("near-step", &blade(1e-9));
    assert!((step / near - 1.0).abs() < 1e-8, "{step} {near}");
    let mut block = with_file("step", &blade(0.0));
    block.start().unwrap();
    let log = events(&mut block);
    assert!(!log.contains("is too few"), "{log}");
}

/// A light helicopter's two blades: precone and undersling built in.
#[test]
fn a_teetering_rotor_flaps_as_one_body_and_leaves_the_hub_without_moment() {
    let teetering = ROTOR
        .replace("numberOfBlades = 3", "numberOfBlades = 2")
        .replace("hub = \"hinged\"", "hub = \"teetering\"\nundersling = 0.03")
        .replace("hingeOffset = 0.05\n", "")
        .replace("delta3 = 10.0\n", "")
        .replace("mode = \"torque\"\n", "");
    let mut block = with_file("teetering", &teetering);
    set(
        &mut block,
        real::VELOCITY_1,
        0.2 * 400.0 * std::f64::consts::PI / 30.0 * 2.0,
    );
    block.start().unwrap();
    let (mut moment, mut thrust, mut largest) = ([0.0; 2], 0.0, 0.0_f64);
    let steps = 60;
    for _ in 0..steps {
        block.step(60.0 / 400.0 / f64::from(steps)).unwrap();
        let angle = real::STATE__FLAP_ANGLE.map(|r| get(&block, r));
        let sum = angle[0] + angle[1] - 2.0 * get(&block, real::FLAPPING__PRECONE);
        assert!(sum.abs() < 1e-12, "{sum}");
        largest = largest.max((angle[0] - angle[1]) / 2.0);
        for (sum, r) in moment
            .iter_mut()
            .zip([real::HUB_MOMENT_1, real::HUB_MOMENT_2])
        {
            *sum += get(&block, r) / f64::from(steps);
        }
        thrust += get(&block, real::THRUST) / f64::from(steps);
    }
    assert!(largest > 0.01, "{largest}");
    // What is left is the torque of the drag about the shaft, which the tip path leans.
    let torque = get(&block, real::TORQUE);
    for m in moment {
        assert!(
            m.abs() < 0.1 * torque && m.abs() < 1e-3 * thrust * 2.0,
            "{moment:?} {torque}"
        );
    }
    for (from, to, part) in [
        (
            "numberOfBlades = 2",
            "numberOfBlades = 3",
            "teetering with 3 blades: a seesaw has two",
        ),
        (
            "undersling",
            "hingeOffset = 0.1\nundersling",
            "hingeOffset = 0.1: the hinge of a seesaw",
        ),
    ] {
        let mut block = with_file("teetering-wrong", &teetering.replace(from, to));
        let error = block.update().unwrap_err().to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// Differences of the whole simulation against exact derivatives, the start included.
#[test]
fn the_derivatives_of_a_teetering_rotor_are_those_of_its_outputs() {
    let text = ROTOR
        .replace("numberOfBlades = 3", "numberOfBlades = 2")
        .replace("hub = \"hinged\"", "hub = \"teetering\"\nundersling = 0.03")
        .replace("hingeOffset = 0.05\n", "")
        .replace("mode = \"torque\"\n", "");
    let outputs = [
        real::THRUST,
        real::LONGITUDINAL_FLAPPING,
        real::STATE__FLAP_ANGLE[0],
    ];
    let at = |collective: f64| {
        let mut block = with_file("teetering-derivative", &text);
        set(&mut block, real::VELOCITY_1, 12.0);
        set(&mut block, real::COLLECTIVE, collective);
        block.update().unwrap();
        block
    };
    let collective = 0.1;
    let step = 1e-5;
    let exact: Vec<f64> = at(collective)
        .directional_derivative(&outputs, &[real::COLLECTIVE], &[1.0])
        .unwrap()
        .collect();
    let (low, high) = (at(collective - step), at(collective + step));
    for (output, exact) in outputs.into_iter().zip(exact) {
        let difference = (get(&high, output) - get(&low, output)) / (2.0 * step);
        let name = output.variable().name;
        assert!(
            (difference / exact - 1.0).abs() < 1e-3,
            "{name}: {difference} {exact}"
        );
    }
}
