//! The names of variables, types and enumeration items, which importers use in their own languages.
//! Published names never change.

use helicopter_rotor::description::XML;
use roxmltree::Document;
use std::collections::BTreeMap;

/// Modelica Language Specification 3.6, section 2.3.3.
const MODELICA_KEYWORDS: [&str; 59] = [
    "algorithm",
    "and",
    "annotation",
    "block",
    "break",
    "class",
    "connect",
    "connector",
    "constant",
    "constrainedby",
    "der",
    "discrete",
    "each",
    "else",
    "elseif",
    "elsewhen",
    "encapsulated",
    "end",
    "enumeration",
    "equation",
    "expandable",
    "extends",
    "external",
    "false",
    "final",
    "flow",
    "for",
    "function",
    "if",
    "import",
    "impure",
    "in",
    "initial",
    "inner",
    "input",
    "loop",
    "model",
    "not",
    "operator",
    "or",
    "outer",
    "output",
    "package",
    "parameter",
    "partial",
    "protected",
    "public",
    "pure",
    "record",
    "redeclare",
    "replaceable",
    "return",
    "stream",
    "then",
    "true",
    "type",
    "when",
    "while",
    "within",
];

/// The list of MATLAB's `iskeyword`.
const MATLAB_KEYWORDS: [&str; 20] = [
    "break",
    "case",
    "catch",
    "classdef",
    "continue",
    "else",
    "elseif",
    "end",
    "for",
    "function",
    "global",
    "if",
    "otherwise",
    "parfor",
    "persistent",
    "return",
    "spmd",
    "switch",
    "try",
    "while",
];

/// MATLAB's `namelengthmax`.
const MATLAB_LENGTH: usize = 63;

/// Every enumeration with its items, which have the numbers 1, 2, 3 ... Append new items here and
/// in modelDescription/variables.toml. Never change anything else in this table.
const ENUMERATIONS: [(&str, &[&str]); 13] = [
    (
        "InflowModel",
        &[
            "annulusClosedForm",
            "annulus",
            "uniform",
            "coleman",
            "drees",
            "payne",
            "whiteBlake",
            "pittPeters",
            "howlett",
            "glauertHighSpeed",
            "finiteBlades",
            "pittPetersDynamic",
            "petersHe",
        ],
    ),
    ("BladesModel", &["automatic", "disc", "individual"]),
    ("LiftModel", &["table", "twoPi", "slopesByReynolds"]),
    (
        "TipLossModel",
        &[
            "none",
            "prandtl",
            "gessowMyers",
            "prandtlTipAndRoot",
            "prandtlThrust",
            "wheatley",
            "sissingh",
        ],
    ),
    (
        "CompressibilityModel",
        &["none", "prandtlGlauert", "karmanTsien", "laitone"],
    ),
    ("DescentModel", &["momentum", "measured", "johnson"]),
    ("GroundEffectModel", &["none", "cheesemanBennett", "hayden"]),
    ("DriveMode", &["speed", "torque"]),
    (
        "FlowState",
        &["normal", "vortexRing", "turbulentWake", "windmillBrake"],
    ),
    ("Rotation", &["counterClockwise", "clockwise"]),
    ("Initialization", &["steady", "rest"]),
    ("Atmosphere", &["isa", "userDefined"]),
    ("HubModel", &["hinged", "teetering"]),
];

fn description() -> Document<'static> {
    Document::parse(XML).unwrap()
}

/// The names of all elements with a tag.
fn names(tag: &str) -> Vec<String> {
    let document = description();
    let elements = document.descendants().filter(|node| node.has_tag_name(tag));
    let names: Vec<String> = elements
        .map(|node| node.attribute("name").unwrap().to_owned())
        .collect();
    assert!(!names.is_empty(), "{tag}");
    names
}

/// The variables, the enumerations and their items.
fn all_names() -> Vec<String> {
    ["ScalarVariable", "SimpleType", "Item"]
        .into_iter()
        .flat_map(names)
        .collect()
}

#[test]
fn no_part_of_a_name_is_a_modelica_keyword() {
    for name in all_names() {
        // FMI's structured naming convention demands der(x) for the derivative of x.
        let state = name.strip_prefix("der(").and_then(|x| x.strip_suffix(')'));
        for part in state.unwrap_or(&name).split(['.', '[', ']', '(', ')', ',']) {
            assert!(!MODELICA_KEYWORDS.contains(&part), "{part} in {name}");
        }
    }
}

#[test]
fn names_are_distinct_matlab_identifiers_once_punctuation_is_replaced() {
    for tag in ["ScalarVariable", "SimpleType"] {
        let mut seen = BTreeMap::new();
        for name in names(tag) {
            let identifier = name.replace(['.', '[', ']', '(', ')'], "_");
            is_matlab_identifier(&identifier);
            if let Some(other) = seen.insert(identifier, name.clone()) {
                panic!("{name} and {other} are the same identifier in MATLAB");
            }
        }
    }
    for item in names("Item") {
        is_matlab_identifier(&item);
    }
}

#[track_caller]
fn is_matlab_identifier(name: &str) {
    assert!(
        name.starts_with(|c: char| c.is_ascii_alphabetic()),
        "{name}"
    );
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    assert!(name.chars().all(is_word), "{name}");
    assert!(name.len() <= MATLAB_LENGTH, "{name}");
    assert!(!MATLAB_KEYWORDS.contains(&name), "{name}");
}

#[test]
fn enumeration_items_keep_their_numbers() {
    let document = description();
    let mut found = Vec::new();
    for kind in document.descendants() {
        if !kind.has_tag_name("SimpleType") {
            continue;
        }
        let items = kind.descendants().filter(|node| node.has_tag_name("Item"));
        let items: Vec<(&str, i32)> = items
            .map(|item| {
                let number = item.attribute("value").unwrap().parse().unwrap();
                (item.attribute("name").unwrap(), number)
            })
            .collect();
        found.push((kind.attribute("name").unwrap(), items));
    }
    let golden = ENUMERATIONS.map(|(name, items)| (name, items.iter().copied().zip(1..).collect()));
    assert_eq!(found, golden);
}

/// Every published variable is still there, with its type and causality. Arrays stand with their
/// first element. New variables are appended to the file when they are published.
#[test]
fn published_variables_keep_their_names() {
    let description = Document::parse(XML).unwrap();
    let variables = description
        .descendants()
        .filter(|n| n.has_tag_name("ScalarVariable"));
    let present: Vec<[String; 3]> = variables
        .map(|variable| {
            let kind = variable.first_element_child().unwrap();
            let type_name = kind
                .attribute("declaredType")
                .unwrap_or(kind.tag_name().name());
            let attribute = |name| variable.attribute(name).unwrap().to_owned();
            [
                attribute("name"),
                type_name.to_owned(),
                attribute("causality"),
            ]
        })
        .collect();
    let file = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/tests/data/published-names.csv"
    );
    let mut published = csv::Reader::from_path(file).unwrap();
    let mut count = 0;
    for record in published.records() {
        let record = record.unwrap();
        let row = [0, 1, 2].map(|column| record[column].to_owned());
        assert!(
            present.contains(&row),
            "{row:?} is not in modelDescription.xml"
        );
        count += 1;
    }
    assert!(count > 80, "{count} names");
}

/// What is added to the table goes after the derivatives of the states, so that importers that keep
/// value references find the same variables.
#[test]
fn published_variables_keep_their_value_references() {
    let description = description();
    for (name, reference) in [
        ("collective", "0"),
        ("state.flapRate[8]", "266"),
        ("der(azimuth)", "267"),
        ("der(state.flapRate[8])", "308"),
        ("flapping.lockNumber", "309"),
    ] {
        let found = description
            .descendants()
            .find(|n| n.has_tag_name("ScalarVariable") && n.attribute("name") == Some(name))
            .unwrap();
        assert_eq!(found.attribute("valueReference"), Some(reference), "{name}");
    }
}
