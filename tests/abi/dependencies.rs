//! What modelDescription.xml says in ModelStructure on which unknown depends on what, against what
//! happens: an importer that trusts it would else use old values, or see loops where there are
//! none.

use crate::support::{
    Fmu, Instance, c,
    instance::{bits, reference},
};
use helicopter_rotor::block::variables::{Causality, INTEGERS, REALS, STATES};
use roxmltree::{Document, Node};
use std::collections::{BTreeMap, BTreeSet};

/// The names on which each unknown of a list depends.
fn dependencies(list: &str) -> BTreeMap<String, BTreeSet<String>> {
    let text = Fmu::shared().description();
    let description = Document::parse(&text).unwrap();
    let elements = |parent: &str, tag: &str| -> Vec<Node> {
        let mut all = description.descendants();
        let parent = all.find(|node| node.has_tag_name(parent)).unwrap();
        parent
            .children()
            .filter(|node| node.has_tag_name(tag))
            .collect()
    };
    let variables = elements("ModelVariables", "ScalarVariable");
    let name = |index: &str| {
        let variable = variables[index.parse::<usize>().unwrap() - 1];
        variable.attribute("name").unwrap().to_owned()
    };
    let unknowns = elements(list, "Unknown").into_iter();
    unknowns
        .map(|unknown| {
            let knowns = unknown.attribute("dependencies").unwrap();
            let knowns = knowns.split_whitespace().map(name).collect();
            (name(unknown.attribute("index").unwrap()), knowns)
        })
        .collect()
}

/// Rotors of many kinds, so that everything matters in one of them.
fn configure(instance: &Instance, kind: usize) {
    let choices = INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices;
    let inflow = ["petersHe", "uniform", "pittPetersDynamic", "annulus"][kind];
    let inflow = choices.iter().position(|c| *c == inflow).unwrap() as i32 + 1;
    for (name, value) in [
        ("models.inflow", inflow),
        ("drive.mode", [2, 1, 1, 2][kind]),
        ("air.atmosphere", [1, 2, 1, 1][kind]),
        ("models.groundEffect", [1, 2, 3, 1][kind]),
        ("geometry.numberOfBlades", [8, 2, 1, 3][kind]),
        ("numerics.inflowOrder", 6),
        ("numerics.elements", 10),
        ("initialization", [2, 1, 1, 1][kind]),
    ] {
        assert_eq!(instance.set_integer(name, value), c::OK);
    }
    let flaps = [1, 1, 1, 0][kind];
    assert_eq!(instance.set_boolean("flapping.enabled", flaps), c::OK);
    for (name, value) in [
        ("velocity[1]", 12.0),
        ("velocity[2]", 1.0),
        ("angularVelocity[1]", 0.1),
        ("tilt", 0.1),
        ("lateralTilt", 0.05),
        ("driveTorque", 3.0),
        ("heightAboveGround", 1.0),
        ("flapping.hingeOffset", 0.05),
        ("flapping.hingeSpring", 10.0),
        ("flapping.precone", 0.02),
        ("flapping.delta3", 0.2),
    ] {
        assert_eq!(instance.set_real(name, value), c::OK);
    }
}

/// Names of what differs between two readings of all Real variables.
fn differing(a: &[f64], b: &[f64]) -> BTreeSet<String> {
    let pairs = REALS.iter().zip(bits(a).into_iter().zip(bits(b)));
    let differing = pairs.filter(|(_, (a, b))| a != b);
    differing.map(|(v, _)| v.name.to_owned()).collect()
}

/// Asserts that nothing changes but what is said, and collects what does.
fn check(
    said: &BTreeMap<String, BTreeSet<String>>,
    known: &str,
    changed: &BTreeSet<String>,
    seen: &mut BTreeSet<(String, String)>,
) {
    for (unknown, dependencies) in said {
        if changed.contains(unknown) {
            assert!(dependencies.contains(known), "{unknown} depends on {known}");
            seen.insert((unknown.clone(), known.to_owned()));
        }
    }
}

#[test]
fn outputs_and_derivatives_depend_on_what_is_said_and_on_nothing_else() {
    let mut said = dependencies("Outputs");
    said.extend(dependencies("Derivatives"));
    let outputs = REALS
        .iter()
        .filter(|v| v.causality == Causality::Output)
        .count();
    assert_eq!(
        said.len(),
        outputs
            + INTEGERS
                .iter()
                .filter(|v| v.causality == Causality::Output)
                .count()
            + STATES.len()
    );
    let mut seen = BTreeSet::new();
    for kind in 0..4 {
        let instance = Instance::for_model_exchange();
        configure(&instance, kind);
        instance.begin_integration();
        let mut x = instance.states();
        for (i, x) in x.iter_mut().enumerate() {
            *x += [0.3, 2.0, 0.5][i.min(2)];
        }
        assert_eq!(instance.set_states(&x), c::OK);
        let before = instance.reals();
        let inputs = REALS
            .iter()
            .filter(|v| v.causality == Causality::Input)
            .map(|v| v.name);
        let states = STATES.iter().map(|row| row.value.variable().name);
        for known in inputs.chain(states) {
            let value = before[reference(&REALS, known) as usize];
            assert_eq!(instance.set_real(known, value + 0.01), c::OK);
            let changed = differing(&instance.reals(), &before);
            check(&said, known, &changed, &mut seen);
            assert_eq!(instance.set_real(known, value), c::OK);
        }
    }
    // Lists that name some are not longer than they must be.
    let all = REALS
        .iter()
        .filter(|v| v.causality == Causality::Input)
        .count()
        + STATES.len();
    let mut short = 0;
    for (unknown, dependencies) in &said {
        // Of two coefficients of one flow, as of flow states, little is seen by small changes.
        if dependencies.len() == all {
            continue;
        }
        short += 1;
        for known in dependencies {
            let pair = (unknown.clone(), known.clone());
            assert!(seen.contains(&pair), "{unknown} does not depend on {known}");
        }
    }
    // azimuth, rotorSpeed, advanceRatio, propellerAdvanceRatio, tipMach, tipReynolds, airDensity,
    // der(azimuth) and 8 flap angles.
    assert_eq!(short, 16);
    // What could be a loop through the flow is one for some rotor.
    for (unknown, known) in [
        ("thrust", "state.inflow[24]"),
        ("der(state.flapRate[8])", "collective"),
    ] {
        assert!(
            seen.contains(&(unknown.to_owned(), known.to_owned())),
            "{unknown} {known}"
        );
    }
}

#[test]
fn initial_unknowns_depend_on_what_is_said_and_on_nothing_else() {
    let said = dependencies("InitialUnknowns");
    let mut seen = BTreeSet::new();
    for kind in 0..4 {
        let read = |change: Option<&str>| {
            let instance = Instance::for_model_exchange();
            configure(&instance, kind);
            if let Some(name) = change {
                let row = &REALS[reference(&REALS, name) as usize];
                // The value that it has by the configuration is read in Initialization Mode only.
                let start = row.start + 0.01 * (1.0 + row.start.abs());
                assert_eq!(instance.set_real(name, start.min(row.max)), c::OK, "{name}");
            }
            instance.begin_initialization();
            instance.reals()
        };
        let before = read(None);
        for v in REALS.iter().filter(|v| !v.causality.is_computed()) {
            let changed = differing(&read(Some(v.name)), &before);
            check(&said, v.name, &changed, &mut seen);
        }
    }
    assert!(said["azimuth"].is_empty());
    // The rotor file, which `settings` may name, gives a speed where the input is not set.
    let is_of_speed = |name: &String| {
        ["rpm", "settings"].contains(&name.as_str()) || name.starts_with("geometry.")
    };
    for unknown in ["state.rotorSpeed", "der(azimuth)", "rotorSpeed"] {
        let known = &said[unknown];
        assert!(
            known.contains("rpm") && known.contains("geometry.file"),
            "{unknown}"
        );
        assert!(known.iter().all(is_of_speed), "{unknown}: {known:?}");
    }
    for pair in [
        ("coning", "flapping.precone"),
        ("state.flapAngle[2]", "collective"),
    ] {
        assert!(
            seen.contains(&(pair.0.to_owned(), pair.1.to_owned())),
            "{pair:?}"
        );
    }
}
