//! Setting and getting values: a refused value names the variable and the remedy, and leaves no
//! trace.

use crate::support::{
    Fmu, Instance,
    c::{self, Reference, Status},
    instance::{bits, reference},
};
use helicopter_rotor::block::variables::{BOOLEANS, Causality, INTEGERS, REALS, STRINGS};
use roxmltree::Document;
use std::{f64::consts::PI, ptr};

/// All values of a running instance, on which a call is refused in between or not.
fn values_after_two_steps(between: impl Fn(&Instance)) -> Vec<u64> {
    let instance = Instance::running();
    assert_eq!(instance.set_real("collective", 0.2), c::OK);
    assert_eq!(instance.step(0.0, 0.01), c::OK);
    between(&instance);
    // Another collective, so that the second step computes.
    assert_eq!(instance.set_real("collective", 0.1), c::OK);
    assert_eq!(instance.step(0.01, 0.01), c::OK);
    bits(&instance.reals())
}

/// Asserts that a call on a running instance is refused in one sentence with `parts`, changes no
/// value and leaves the next step as it is without that call.
#[track_caller]
fn refused_without_a_trace(parts: &[&str], call: impl Fn(&Instance) -> Status) {
    let between = |instance: &Instance| {
        let before = (bits(&instance.reals()), integers(instance));
        let message = instance.refused(call(instance));
        for part in parts {
            assert!(message.contains(part), "{part:?} is not in: {message}");
        }
        assert_eq!(
            (bits(&instance.reals()), integers(instance)),
            before,
            "{message}"
        );
    };
    assert_eq!(
        values_after_two_steps(between),
        values_after_two_steps(|_| ()),
        "{parts:?}"
    );
}

/// As `refused_without_a_trace`, before the initialisation.
#[track_caller]
fn refused_at_the_start(parts: &[&str], call: impl Fn(&Instance) -> Status) {
    let instance = Instance::new();
    let message = instance.refused(call(&instance));
    for part in parts {
        assert!(message.contains(part), "{part:?} is not in: {message}");
    }
    instance.initialize();
    let undisturbed = Instance::running();
    assert_eq!(
        bits(&instance.reals()),
        bits(&undisturbed.reals()),
        "{message}"
    );
    assert_eq!(integers(&instance), integers(&undisturbed), "{message}");
}

/// With the Booleans, which are integers in C.
fn integers(instance: &Instance) -> Vec<i32> {
    let integers = INTEGERS.iter().map(|v| instance.integer(v.name));
    let booleans = BOOLEANS.iter().map(|v| instance.boolean(v.name));
    integers.chain(booleans).collect()
}

#[test]
fn no_input_or_parameter_accepts_what_is_not_finite() {
    for variable in REALS.iter().filter(|v| !v.causality.is_computed()) {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let parts = [variable.name, "not a finite number"];
            refused_at_the_start(&parts, |i| i.set_real(variable.name, value));
            if variable.causality == Causality::Input || variable.tunable {
                refused_without_a_trace(&parts, |i| i.set_real(variable.name, value));
            }
        }
    }
}

#[test]
fn parameters_out_of_range_are_refused_with_the_range() {
    for (name, value, range) in [
        ("air.density", 0.0, "from 1e-6 to 100"),
        ("air.temperature", -5.0, "from 50 to 2000"),
    ] {
        let parts = [name, "out of range", range, "keeps"];
        refused_without_a_trace(&parts, |i| i.set_real(name, value));
    }
    for (name, value, range) in [
        ("geometry.radius", 0.0, "from 0.001 to 1000"),
        ("geometry.radius", -0.762, "from 0.001 to 1000"),
        ("geometry.chord", 0.0, "from 0.0001 to 100"),
        ("geometry.chord", -0.05, "from 0.0001 to 100"),
        ("geometry.rootCutout", 1.0, "from 0.01 to 0.95"),
        ("geometry.rootCutout", 1.5, "from 0.01 to 0.95"),
        ("geometry.rootCutout", 0.0, "from 0.01 to 0.95"),
        ("geometry.taperRatio", -0.1, "from 0 to 10"),
        ("geometry.pitchReferenceRadius", 1.1, "from 0 to 1"),
    ] {
        let parts = [name, "out of range", range, "keeps"];
        refused_at_the_start(&parts, |i| i.set_real(name, value));
    }
}

/// A solver's finite difference, a landing and a rotor that stops pass the ends by rounding errors.
#[test]
fn inputs_out_of_range_count_as_the_end_of_their_range_with_one_warning_each() {
    for (name, past, end, part) in [
        ("rpm", -1e-8, 0.0, "-1e-8 rev/min is out of range"),
        ("rpm", -f64::MIN_POSITIVE, 0.0, "counts as 0 rev/min"),
        ("rpm", 1e7, 1e6, "the range from 0 to 1000000 rev/min"),
        ("heightAboveGround", -1e-12, 0.0, "-1e-12 m is out"),
        ("collective", 8.0, PI, "(degrees? 8 deg = 0.1396 rad)"),
        ("altitude", 1e6, 20000.0, "from -2000 to 20000 m"),
    ] {
        let flown = |value: f64| {
            let rotor = Instance::running();
            assert_eq!(rotor.set_real(name, value), c::OK, "{name}");
            assert_eq!(rotor.step(0.0, 0.01), c::OK, "{name}");
            (rotor.take_log(), bits(&rotor.reals()), rotor)
        };
        let (log, values, rotor) = flown(past);
        let [line] = &log[..] else {
            panic!("{name}: one line is expected: {log:?}");
        };
        assert_eq!(line.category, "logStatusWarning", "{line:?}");
        assert!(line.message.contains(part), "{part} is not in {line:?}");
        assert_eq!(rotor.real(name), end);
        assert_eq!(values, flown(end).1, "{name}: as at the end of the range");
        assert_eq!(rotor.set_real(name, past), c::OK);
        assert_eq!(rotor.take_log(), [], "said once");
        let other = if name == "rpm" { "altitude" } else { "rpm" };
        assert_eq!(rotor.set_real(other, -1e9), c::OK);
        assert_eq!(rotor.take_log().len(), 1, "another input, another warning");
        assert_eq!(rotor.reset(), c::OK);
        assert_eq!(rotor.set_real(name, past), c::OK);
        assert_eq!(rotor.take_log().len(), 1, "another simulation");
    }
}

#[test]
fn integers_and_enumerations_out_of_range_are_refused_with_the_choices() {
    for (name, value, choices) in [
        ("numerics.elements", 0, "from 1 to 2000"),
        ("numerics.elements", -40, "from 1 to 2000"),
        ("numerics.elements", 1_000_000, "from 1 to 2000"),
        ("geometry.numberOfBlades", 0, "from 1 to 20"),
        ("geometry.numberOfBlades", i32::MAX, "from 1 to 20"),
        (
            "geometry.rotation",
            0,
            "1 (counterClockwise), 2 (clockwise)",
        ),
        ("models.inflow", 99, "1 (annulusClosedForm), 2 (annulus)"),
        ("models.lift", i32::MIN, "1 (table), 2 (twoPi)"),
        (
            "models.tipLoss",
            99,
            "1 (none), 2 (prandtl), 3 (gessowMyers)",
        ),
        ("models.compressibility", -1, "1 (none), 2 (prandtlGlauert)"),
        ("air.atmosphere", 3, "1 (isa), 2 (userDefined)"),
    ] {
        let parts = [name, &value.to_string(), choices, "keeps"];
        refused_at_the_start(&parts, |i| i.set_integer(name, value));
    }
}

#[test]
fn booleans_other_than_0_and_1_are_refused_with_the_choices() {
    for v in &BOOLEANS {
        for value in [2, -1, 256, i32::MAX, i32::MIN] {
            let kept = format!("keeps {}", i32::from(v.start));
            let sentence = format!("{} = {value} is not allowed", v.name);
            let parts = [sentence.as_str(), "0 (false), 1 (true)", &kept];
            refused_at_the_start(&parts, |i| i.set_boolean(v.name, value));
        }
    }
}

#[test]
fn booleans_have_the_start_values_of_the_description_and_can_be_set() {
    let text = Fmu::shared().description();
    let description = Document::parse(&text).unwrap();
    let rows = description
        .descendants()
        .filter(|node| node.has_tag_name("Boolean"));
    let rows: Vec<_> = rows.map(|row| (row, row.parent().unwrap())).collect();
    assert_eq!(rows.len(), BOOLEANS.len());
    let running = Instance::running();
    for (i, (v, (row, variable))) in BOOLEANS.iter().zip(rows).enumerate() {
        assert_eq!(variable.attribute("name"), Some(v.name));
        let reference = i.to_string();
        assert_eq!(
            variable.attribute("valueReference"),
            Some(reference.as_str())
        );
        let start = match running.boolean(v.name) {
            0 => "false",
            1 => "true",
            other => panic!("{} = {other}", v.name),
        };
        assert_eq!(row.attribute("start"), Some(start), "{}", v.name);

        let instance = Instance::new();
        for value in [1, 0, i32::from(!v.start)] {
            assert_eq!(instance.set_boolean(v.name, value), c::OK, "{}", v.name);
        }
        instance.initialize();
        assert_eq!(instance.boolean(v.name), i32::from(!v.start), "{}", v.name);
    }
}

#[test]
fn unknown_value_references_are_refused_with_the_known_ones() {
    let last = |count: usize| format!("from 0 to {}", count - 1);
    let lasts = [
        last(REALS.len()),
        last(INTEGERS.len()),
        last(STRINGS.len()),
        last(BOOLEANS.len()),
    ];
    for reference in [REALS.len() as Reference, 9999, Reference::MAX] {
        let name = format!("value reference {reference}");
        let parts = |i: usize| [name.as_str(), &lasts[i], "modelDescription.xml"];
        refused_without_a_trace(&parts(0), |i| i.get_reals(&[reference], &mut [0.0]));
        refused_without_a_trace(&parts(0), |i| i.set_reals(&[reference], &[0.0]));
        refused_without_a_trace(&parts(1), |i| i.get_integer_at(reference, &mut 0));
        refused_without_a_trace(&parts(1), |i| i.set_integer_at(reference, 1));
        refused_without_a_trace(&parts(2), |i| i.set_string_at(reference, c""));
        refused_without_a_trace(&parts(3), |i| i.get_boolean_at(reference, &mut 0));
        refused_without_a_trace(&parts(3), |i| i.set_booleans(&[reference], &[1]));
    }
}

#[test]
fn of_several_values_all_or_none_are_set() {
    let names = ["collective", "tilt", "air.density"];
    let references = names.map(|name| reference(&REALS, name));
    let set = |values: [f64; 3]| move |i: &Instance| i.set_reals(&references, &values);
    refused_without_a_trace(&["air.density = -1"], set([0.3, 0.1, -1.0]));
    refused_at_the_start(&["flapping.enabled = 2"], |i| {
        i.set_booleans(&[reference(&BOOLEANS, "flapping.enabled"); 2], &[1, 2])
    });
    let instance = Instance::running();
    assert_eq!(set([0.3, 0.1, 1.1])(&instance), c::OK);
    assert_eq!(names.map(|name| instance.real(name)), [0.3, 0.1, 1.1]);
}

#[test]
fn outputs_cannot_be_set() {
    for variable in REALS.iter().filter(|v| v.causality.is_computed()) {
        let set = |i: &Instance| i.set_real(variable.name, 1.0);
        refused_without_a_trace(&[variable.name, "is computed by the rotor"], set);
        refused_at_the_start(&[variable.name, "is computed by the rotor"], set);
    }
    for variable in INTEGERS.iter().filter(|v| v.causality.is_computed()) {
        let set = |i: &Instance| i.set_integer(variable.name, 1);
        refused_without_a_trace(&[variable.name, "is computed by the rotor"], set);
    }
}

#[test]
fn fixed_parameters_keep_their_values_once_the_simulation_runs() {
    let fixed = |v: &Causality, tunable: bool| *v == Causality::Parameter && !tunable;
    for v in REALS.iter().filter(|v| fixed(&v.causality, v.tunable)) {
        let other = if v.start == v.max { v.min } else { v.max };
        refused_without_a_trace(&[v.name, "fixed parameter"], |i| i.set_real(v.name, other));
    }
    for v in INTEGERS.iter().filter(|v| fixed(&v.causality, v.tunable)) {
        let other = if v.start == 1 { 2 } else { 1 };
        refused_without_a_trace(&[v.name, "fixed parameter"], |i| {
            i.set_integer(v.name, other)
        });
    }
    for v in &BOOLEANS {
        refused_without_a_trace(&[v.name, "fixed parameter"], |i| {
            i.set_boolean(v.name, i32::from(!v.start))
        });
    }
    for v in &STRINGS {
        refused_without_a_trace(&[v.name, "fixed parameter"], |i| {
            i.set_string(v.name, "other")
        });
    }
}

#[test]
fn fixed_parameters_may_be_set_to_the_values_that_they_have() {
    let rewritten = values_after_two_steps(|instance| {
        for v in REALS.iter().filter(|v| v.causality == Causality::Parameter) {
            assert_eq!(instance.set_real(v.name, v.start), c::OK, "{}", v.name);
        }
        for v in INTEGERS
            .iter()
            .filter(|v| v.causality == Causality::Parameter)
        {
            assert_eq!(instance.set_integer(v.name, v.start), c::OK, "{}", v.name);
        }
        for v in &BOOLEANS {
            let status = instance.set_boolean(v.name, v.start.into());
            assert_eq!(status, c::OK, "{}", v.name);
        }
        for v in &STRINGS {
            assert_eq!(instance.set_string(v.name, v.start), c::OK, "{}", v.name);
        }
        assert_eq!(instance.take_log(), []);
    });
    assert_eq!(rewritten, values_after_two_steps(|_| ()));
}

#[test]
fn null_pointers_are_refused_unless_nothing_is_announced() {
    // With `value` null, and `vr` as well or not.
    let call = |i: &Instance, name: &str, vr: *const Reference, count: usize| {
        let (f, c) = (i.functions, i.component);
        // SAFETY: the component lives; the functions must not touch what is null.
        unsafe {
            match name {
                "fmi2GetReal" => (f.fmi2GetReal)(c, vr, count, ptr::null_mut()),
                "fmi2GetInteger" => (f.fmi2GetInteger)(c, vr, count, ptr::null_mut()),
                "fmi2GetBoolean" => (f.fmi2GetBoolean)(c, vr, count, ptr::null_mut()),
                "fmi2GetString" => (f.fmi2GetString)(c, vr, count, ptr::null_mut()),
                "fmi2SetReal" => (f.fmi2SetReal)(c, vr, count, ptr::null()),
                "fmi2SetInteger" => (f.fmi2SetInteger)(c, vr, count, ptr::null()),
                "fmi2SetBoolean" => (f.fmi2SetBoolean)(c, vr, count, ptr::null()),
                _ => (f.fmi2SetString)(c, vr, count, ptr::null()),
            }
        }
    };
    for name in [
        "fmi2GetReal",
        "fmi2GetInteger",
        "fmi2GetBoolean",
        "fmi2GetString",
        "fmi2SetReal",
        "fmi2SetInteger",
        "fmi2SetBoolean",
        "fmi2SetString",
    ] {
        let parts = |what| [name, what];
        refused_without_a_trace(&parts("vr is a null pointer"), |i| {
            call(i, name, ptr::null(), 1)
        });
        refused_without_a_trace(&parts("value is a null pointer"), |i| call(i, name, &0, 1));
        let instance = Instance::running();
        assert_eq!(
            call(&instance, name, ptr::null(), 0),
            c::OK,
            "{name} of nothing"
        );
        assert_eq!(instance.take_log(), [], "{name} of nothing");
    }
    let null_text = |i: &Instance| {
        // SAFETY: both pointers have one element.
        unsafe { (i.functions.fmi2SetString)(i.component, &0, 1, &ptr::null()) }
    };
    refused_without_a_trace(&["fmi2SetString", "null pointer"], null_text);
    let no_text = |i: &Instance| i.set_string_at(0, c"\xff\xfe");
    refused_without_a_trace(&["fmi2SetString", "UTF-8"], no_text);
}

#[test]
fn a_tunable_parameter_takes_effect_with_the_next_step() {
    let instance = Instance::new();
    assert_eq!(instance.set_integer("air.atmosphere", 2), c::OK);
    instance.initialize();
    let before = (instance.real("airDensity"), instance.real("thrust"));
    assert_eq!(before.0, 1.225);
    assert_eq!(instance.set_real("air.density", 2.45), c::OK);
    assert_eq!(
        (instance.real("airDensity"), instance.real("thrust")),
        before,
        "not yet"
    );
    assert_eq!(instance.step(0.0, 0.01), c::OK);
    assert_eq!(instance.real("airDensity"), 2.45);
    let ratio = instance.real("thrust") / before.1;
    assert!(
        (1.9..2.1).contains(&ratio),
        "twice the density, about twice the thrust: {ratio}"
    );
}
