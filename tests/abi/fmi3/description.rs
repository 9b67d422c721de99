//! modelDescription.xml of FMI 3.0 against the table of variables and that of FMI 2.0.

use crate::support::{Instance3, instance3::variables};
use helicopter_rotor::{
    block::variables::{GUID, INSTANTIATION_TOKEN, REALS, STATES},
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
