//! modelDescription.xml of FMI 3.0 against the table of variables and that of FMI 2.0.

use crate::support::{Instance3, instance3::variables};
use helicopter_rotor::{
    block::variables::{BOOLEANS, GUID, INSTANTIATION_TOKEN, INTEGERS, REALS, STATES, STRINGS},
    description::{TERMINALS, TERMINALS_OF_FMI3, XML, XML_OF_FMI3},
};
use roxmltree::Document;
use std::collections::BTreeSet;

#[test]
fn the_two_files_have_tokens_of_their_own() {
    assert_ne!(GUID, INSTANTIATION_TOKEN);
    assert!(XML.contains(GUID) && !XML.contains(INSTANTIATION_TOKEN));
    assert!(XML_OF_FMI3.contains(INSTANTIATION_TOKEN) && !XML_OF_FMI3.contains(GUID));
}

/// The page is in the archives of both versions.
#[test]
fn the_documentation_speaks_of_both_versions_and_names_variables_that_exist() {
    let page = include_str!("../../../modelDescription/documentation/index.html");
    assert!(page.contains("FMI 2.0") && page.contains("FMI 3.0"));
    // Without indices, as a text may name elements by [1..3] or [..].
    let bare = |name: &str| {
        let mut parts = name.split('[');
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |all, part| {
            all + part.split_once(']').map_or("", |(_, rest)| rest)
        })
    };
    let of_fmi2 = (REALS.iter().map(|v| v.name))
        .chain(INTEGERS.iter().map(|v| v.name))
        .chain(BOOLEANS.iter().map(|v| v.name))
        .chain(STRINGS.iter().map(|v| v.name));
    let of_fmi3 = variables().keys().map(String::as_str);
    let names: BTreeSet<String> = of_fmi2.chain(of_fmi3).map(bare).collect();
    let groups = names.iter().filter_map(|name| name.split_once('.'));
    let groups: BTreeSet<&str> = groups.map(|(group, _)| group).collect();
    let mut count = 0;
    for code in page.split("<code>").skip(1) {
        let code = code.split("</code>").next().unwrap();
        let name = code.split(" = ").next().unwrap();
        let is_part = |c: char| c.is_ascii_alphanumeric() || ".[]()".contains(c);
        let name_alone = bare(name);
        let group = name_alone.split('.').next().unwrap();
        let is_in_group = name_alone.contains('.') && groups.contains(group);
        if name.chars().all(is_part) && (is_in_group || name.contains('[')) {
            let is_whole_group = groups.contains(name_alone.as_str());
            assert!(is_whole_group || names.contains(&name_alone), "{code}");
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn value_references_are_unique_and_there_is_one_independent_variable() {
    let all = variables();
    let references: BTreeSet<u32> = all.values().map(|v| v.reference).collect();
    assert_eq!(references.len(), all.len());
    let independent: Vec<&str> = all
        .values()
        .filter(|v| v.causality == "independent")
        .map(|v| v.name.as_str())
        .collect();
    assert_eq!(independent, ["time"]);
}

#[test]
fn time_is_in_seconds_and_every_unit_is_defined() {
    let description = Document::parse(XML_OF_FMI3).unwrap();
    let with = |name| {
        description
            .descendants()
            .filter(move |n| n.has_tag_name(name))
    };
    let defined: BTreeSet<&str> = with("Unit").filter_map(|n| n.attribute("name")).collect();
    let units = with("Float64").map(|n| (n.attribute("name"), n.attribute("unit")));
    for (name, unit) in units.clone() {
        assert!(unit.is_some_and(|unit| defined.contains(unit)), "{name:?}");
    }
    assert!(units.clone().any(|v| v == (Some("time"), Some("s"))));
}

#[test]
fn every_variable_of_fmi_2_is_a_variable_or_an_element_of_an_array() {
    let floats = variables().values().filter(|v| v.kind == "Float64");
    let floats = floats.filter(|v| v.name != "time");
    let mut elements = BTreeSet::new();
    for v in floats {
        for i in 0..v.count {
            let name = REALS[v.reference as usize + i].name;
            let flat = match v.count {
                1 => v.name.clone(),
                _ if v.name.starts_with("station.") => {
                    v.name.replace("station", &format!("station[{}]", i + 1))
                }
                _ if v.name.starts_with("der(") => v.name.replace(')', &format!("[{}])", i + 1)),
                _ => format!("{}[{}]", v.name, i + 1),
            };
            assert_eq!(name, flat);
            elements.insert(name);
        }
    }
    assert_eq!(elements.len(), REALS.len());
    assert!(
        variables().len() < 100,
        "{}: a person can read them",
        variables().len()
    );
}

#[test]
fn the_order_of_the_derivatives_is_that_of_the_states() {
    let description = Document::parse(XML_OF_FMI3).unwrap();
    let derivatives = description.descendants();
    let derivatives = derivatives.filter(|n| n.has_tag_name("ContinuousStateDerivative"));
    let mut order = Vec::new();
    for derivative in derivatives {
        let reference: u32 = derivative
            .attribute("valueReference")
            .unwrap()
            .parse()
            .unwrap();
        let v = variables()
            .values()
            .find(|v| v.reference == reference)
            .unwrap();
        order.extend(reference..reference + v.count as u32);
    }
    let states: Vec<u32> = STATES.iter().map(|row| row.derivative.number()).collect();
    assert_eq!(order, states);
    let instance = Instance3::for_model_exchange();
    instance.initialize();
    assert_eq!(instance.states().len(), states.len());
}

#[test]
fn terminals_name_variables_that_exist_each_member_once() {
    for (terminals, description, tag) in [
        (TERMINALS, XML, "ScalarVariable"),
        (TERMINALS_OF_FMI3, XML_OF_FMI3, "Float64"),
    ] {
        let (terminals, description) = (
            Document::parse(terminals).unwrap(),
            Document::parse(description).unwrap(),
        );
        let names: BTreeSet<&str> = description
            .descendants()
            .filter(|node| node.has_tag_name(tag))
            .filter_map(|node| node.attribute("name"))
            .collect();
        let hub = terminals
            .descendants()
            .find(|n| n.attribute("name") == Some("hub"));
        // No variable of a Frame of Modelica: these have other signs and more members.
        let description = hub.unwrap().attribute("description").unwrap();
        assert!(description.contains("of the rotor on the hub") && !description.contains("Frame"));
        let mut count = 0;
        for terminal in terminals
            .descendants()
            .filter(|n| n.has_tag_name("Terminal"))
        {
            let mut members = BTreeSet::new();
            for member in terminal.children().filter(|n| n.is_element()) {
                let variable = member.attribute("variableName").unwrap();
                assert!(names.contains(variable), "{variable}");
                assert!(members.insert(member.attribute("memberName").unwrap()));
            }
            count += 1;
        }
        assert_eq!(count, 3);
    }
}
