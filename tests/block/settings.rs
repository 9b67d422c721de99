//! The parameter `settings`, a text of assignments: it does what setting the parameters directly
//! does, with the same errors, and all of it or nothing.

use crate::support::block::{
    choose, default_block, enable_flapping, get, set, set_boolean, set_integer, set_string,
};
use helicopter_rotor::{
    block::{
        Note, RotorBlock,
        variables::{
            BOOLEANS, BooleanRef, Causality, INTEGERS, IntegerRef, REALS, RealRef, STRINGS,
            boolean, integer, real, string,
        },
    },
    description::XML,
};
use roxmltree::Document;

fn block_with(settings: &str) -> RotorBlock {
    let mut block = default_block();
    set_string(&mut block, string::SETTINGS, settings);
    block
}

/// The error of a text that is refused before initialisation, and has changed nothing.
#[track_caller]
fn refusal(settings: &str) -> String {
    let mut block = default_block();
    let before = block.values().clone();
    let error = block.set_strings(&[string::SETTINGS], &[settings]);
    assert_eq!(*block.values(), before, "{settings}");
    error.unwrap_err().to_string()
}

fn warnings(block: &mut RotorBlock) -> Vec<String> {
    let notes = block.take_notes().into_iter();
    notes
        .filter_map(|note| match note {
            Note::Warning(text) => Some(text),
            Note::Event(_) => None,
        })
        .collect()
}

#[test]
fn every_parameter_can_be_assigned_and_has_the_value_as_if_it_were_set_directly() {
    let parameter = |causality| causality == Causality::Parameter;
    let (mut direct, mut text) = (default_block(), String::new());
    for real in RealRef::all().filter(|r| parameter(r.variable().causality)) {
        let v = real.variable();
        let value = v.start + 0.25 * (v.max - v.start);
        set(&mut direct, real, value);
        text += &format!("{} = {value};", v.name);
    }
    for integer in IntegerRef::all().filter(|r| parameter(r.variable().causality)) {
        let v = integer.variable();
        let value = if v.start == v.max { v.min } else { v.max };
        set_integer(&mut direct, integer, value);
        text += &match v.choices {
            [] => format!("{} = {value};", v.name),
            choices => format!("{} = {};", v.name, choices[value as usize - 1]),
        };
    }
    for boolean in BooleanRef::all() {
        let v = boolean.variable();
        set_boolean(&mut direct, boolean, !v.start);
        text += &format!("{} = {};", v.name, !v.start);
    }
    for string in [string::AIRFOIL__FILE, string::GEOMETRY__FILE] {
        set_string(&mut direct, string, "a;ü b");
        text += &format!("{} = \"a;ü b\";", string.variable().name);
    }
    assert_eq!(STRINGS.len(), 3, "the third is settings; add new ones here");

    let mut values = block_with(&text).values().clone();
    assert_eq!(values.strings[string::SETTINGS], text);
    values.strings[string::SETTINGS].clear();
    assert_eq!(values, *direct.values());
    let all = REALS.iter().filter(|v| parameter(v.causality)).count()
        + INTEGERS.iter().filter(|v| parameter(v.causality)).count()
        + BOOLEANS.len()
        + 2;
    assert_eq!(text.matches(" = ").count(), all);
}

#[test]
fn a_flight_with_settings_is_that_with_the_parameters_set_directly() {
    let text = "models.inflow = pittPetersDynamic; flapping.enabled = true; geometry.radius = 0.8; \
                airfoil.file = naca0012.polar";
    let mut by_text = block_with(text);
    let mut direct = default_block();
    choose(&mut direct, integer::MODELS__INFLOW, "pittPetersDynamic");
    enable_flapping(&mut direct);
    set(&mut direct, real::GEOMETRY__RADIUS, 0.8);
    set_string(&mut direct, string::AIRFOIL__FILE, "naca0012.polar");
    let fly = |block: &mut RotorBlock| {
        set(block, real::VELOCITY_1, 5.0);
        block.start().unwrap();
        block.step(0.02).unwrap();
        block.values().reals
    };
    assert_eq!(fly(&mut by_text), fly(&mut direct));
    assert_ne!(
        fly(&mut default_block()),
        fly(&mut direct),
        "they do matter"
    );
}

#[test]
fn numbers_choose_the_items_of_enumerations_and_booleans_too() {
    let block = block_with("models.inflow=12;flapping.enabled=1");
    assert_eq!(block.values().integers[integer::MODELS__INFLOW], 12);
    assert!(block.values().booleans[boolean::FLAPPING__ENABLED]);
    let block = block_with("flapping.enabled = True");
    assert!(block.values().booleans[boolean::FLAPPING__ENABLED]);
}

#[test]
fn what_is_refused_directly_is_refused_with_the_same_sentence() {
    let mut block = default_block();
    let refused = [
        (
            "geometry.radius = -1",
            block.set_reals(&[real::GEOMETRY__RADIUS], &[-1.0]),
        ),
        (
            "geometry.twist = -12.5",
            block.set_reals(&[real::GEOMETRY__TWIST], &[-12.5]),
        ),
        (
            "geometry.chord = nan",
            block.set_reals(&[real::GEOMETRY__CHORD], &[f64::NAN]),
        ),
        ("thrust = 60", block.set_reals(&[real::THRUST], &[60.0])),
        (
            "state.rotorSpeed = 60",
            block.set_reals(&[real::STATE__ROTOR_SPEED], &[60.0]),
        ),
        (
            "models.inflow = 99",
            block.set_integers(&[integer::MODELS__INFLOW], &[99]),
        ),
        (
            "numerics.elements = 0",
            block.set_integers(&[integer::NUMERICS__ELEMENTS], &[0]),
        ),
        (
            "flapping.enabled = 2",
            block.set_booleans(&[boolean::FLAPPING__ENABLED], &[2]),
        ),
    ];
    for (text, direct) in refused {
        let sentence = direct.unwrap_err().to_string();
        let error = refusal(text);
        assert_eq!(
            error,
            format!("settings: {sentence}; no assignment in settings was made")
        );
    }
}

#[test]
fn slips_are_refused_with_the_remedy() {
    for (text, parts) in [
        ("models.inflow uniform", ["no assignment", "NAME = VALUE"]),
        (
            "model.inflow = uniform",
            [
                "no parameter \"model.inflow\"",
                "did you mean models.inflow?",
            ],
        ),
        ("x = 1", ["no parameter \"x\"", "modelDescription.xml"]),
        (
            "models.inflow = pittPetersDinamic",
            [
                "1 (annulusClosedForm), 2 (annulus)",
                "did you mean pittPetersDynamic?",
            ],
        ),
        (
            "models.inflow = uniform, flapping.enabled = true",
            [
                "models.inflow = uniform, flapping.enabled = true is not",
                "; between",
            ],
        ),
        (
            "geometry.radius = 0,8",
            [
                "geometry.radius = 0,8 is not a number",
                "in m (it keeps 0.762 m)",
            ],
        ),
        (
            "geometry.radius = 0.8 m",
            ["is not a number", "write the number alone"],
        ),
        (
            "geometry.numberOfBlades = 3.0",
            ["is not an integer", "keeps 4"],
        ),
        (
            "flapping.enabled = yes",
            ["set true or false", "keeps false"],
        ),
        (
            "collective = 0.1",
            ["collective is an input", "start value"],
        ),
        (
            "settings = \"models.inflow = uniform\"",
            ["itself", "one after the other"],
        ),
        (
            "models.inflow = uniform; models.inflow = annulus",
            ["models.inflow is assigned twice", "remove one"],
        ),
    ] {
        let error = refusal(text);
        for part in parts {
            assert!(error.contains(part), "{part:?} is not in {error:?}");
        }
    }
}

#[test]
fn one_refused_assignment_refuses_all_with_the_other_strings_of_the_call() {
    let error = refusal("flapping.enabled = true; geometry.radius = 0.8; models.inflow = none");
    assert!(error.contains("models.inflow = none"), "{error}");
    let mut block = default_block();
    let before = block.values().clone();
    let names = [string::AIRFOIL__FILE, string::SETTINGS];
    block
        .set_strings(&names, &["naca0012.polar", "models.inflow = none"])
        .unwrap_err();
    assert_eq!(*block.values(), before);
}

#[test]
fn what_is_set_last_counts() {
    let inflow = |block: &RotorBlock| block.values().integers[integer::MODELS__INFLOW];
    let mut block = block_with("models.inflow = 3");
    assert_eq!(inflow(&block), 3);
    set_integer(&mut block, integer::MODELS__INFLOW, 4);
    assert_eq!(inflow(&block), 4);
    set_string(&mut block, string::SETTINGS, "models.inflow = 3");
    assert_eq!(inflow(&block), 3, "the same text again");
    let names = [string::SETTINGS, string::AIRFOIL__FILE];
    let texts = ["airfoil.file = a", "b"];
    block.set_strings(&names, &texts).unwrap();
    assert_eq!(block.values().strings[string::AIRFOIL__FILE], "b");
}

#[test]
fn an_empty_text_undoes_nothing() {
    let mut block = block_with("models.inflow = uniform; geometry.radius = 0.8");
    set_string(&mut block, string::SETTINGS, "");
    assert_eq!(block.values().integers[integer::MODELS__INFLOW], 3);
    assert_eq!(get(&block, real::GEOMETRY__RADIUS), 0.8);
    block.start().unwrap();
    assert_eq!(warnings(&mut block), [""; 0]);
}

#[test]
fn a_reset_undoes_settings() {
    let mut block = block_with("models.inflow = uniform");
    block.reset();
    assert_eq!(block.values(), default_block().values());
}

#[test]
fn an_assignment_that_a_later_value_replaces_is_a_warning() {
    let text = "models.inflow = uniform; geometry.radius = 0.8; geometry.chord = 0.06";
    let mut block = block_with(text);
    set(&mut block, real::GEOMETRY__RADIUS, 0.762);
    set(&mut block, real::GEOMETRY__CHORD, 0.06);
    set_integer(&mut block, integer::MODELS__INFLOW, 2);
    block.start().unwrap();
    let warnings = warnings(&mut block);
    assert_eq!(warnings.len(), 2, "{warnings:?}");
    for (warning, part) in warnings.iter().zip([
        "settings has models.inflow = uniform, but models.inflow was set to another value",
        "settings has geometry.radius = 0.8, but",
    ]) {
        assert!(warning.contains(part), "{warning}");
    }
}

#[test]
fn settings_are_fixed_when_the_simulation_runs() {
    let text = "air.density = 1.0; air.atmosphere = userDefined";
    let mut block = block_with(text);
    block.start().unwrap();
    set(&mut block, real::AIR__DENSITY, 1.1);
    set_string(&mut block, string::SETTINGS, text);
    assert_eq!(
        get(&block, real::AIR__DENSITY),
        1.1,
        "its own text changes nothing"
    );
    let error = block.set_strings(&[string::SETTINGS], &["air.density = 1.2"]);
    let error = error.unwrap_err().to_string();
    assert!(
        error.starts_with("settings is a fixed parameter"),
        "{error}"
    );
    assert_eq!(get(&block, real::AIR__DENSITY), 1.1);
}

#[test]
fn a_saved_state_holds_the_text_and_what_it_assigned() {
    let text = "models.inflow = uniform; geometry.radius = 0.8";
    for is_running in [false, true] {
        let mut saved = block_with(text);
        if is_running {
            saved.start().unwrap();
        }
        let mut other = block_with("models.inflow = drees; geometry.chord = 0.06");
        other.restore(&saved.snapshot()).unwrap();
        assert_eq!(other.values(), saved.values());
        assert_eq!(other.values().strings[string::SETTINGS], text);
    }
}

/// Importers that write all start values in the order of the description leave `settings` in force.
#[test]
fn settings_is_the_last_variable_of_the_description() {
    let description = Document::parse(XML).unwrap();
    let mut variables = description
        .descendants()
        .filter(|node| node.has_tag_name("ScalarVariable"));
    assert_eq!(
        variables.next_back().unwrap().attribute("name"),
        Some("settings")
    );
    assert_eq!(STRINGS.last().unwrap().name, "settings");
}
