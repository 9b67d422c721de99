//! The dependencies that the library answers, against those in modelDescription.xml.

use crate::support::{
    Instance3,
    c::Reference,
    instance3::{variable, variables},
};
use roxmltree::Document;
use std::collections::BTreeSet;

/// Element, known, element of the known.
pub type Row = (usize, Reference, usize);

pub fn answered(instance: &Instance3, reference: Reference) -> Vec<Row> {
    let (f, p) = (instance.functions, instance.pointer);
    let mut n = 0;
    // SAFETY: the pointers are valid for their counts.
    unsafe {
        instance.ok((f.fmi3GetNumberOfVariableDependencies)(
            p, reference, &mut n,
        ));
        let (mut elements, mut knowns, mut of) = (vec![99; n], vec![0; n], vec![99; n]);
        let mut kinds = vec![-1; n];
        instance.ok((f.fmi3GetVariableDependencies)(
            p,
            reference,
            elements.as_mut_ptr(),
            knowns.as_mut_ptr(),
            of.as_mut_ptr(),
            kinds.as_mut_ptr(),
            n,
        ));
        assert!(kinds.iter().all(|kind| *kind == 5));
        let rows = elements.into_iter().zip(knowns).zip(of);
        rows.map(|((element, known), of)| (element, known, of))
            .collect()
    }
}

#[test]
fn the_library_answers_the_dependencies_of_the_description_before_and_after_the_start() {
    let description = Document::parse(helicopter_rotor::description::XML_OF_FMI3).unwrap();
    let instance = Instance3::new();
    let mut count = 0;
    for tags in [
        &["InitialUnknown"][..],
        &["Output", "ContinuousStateDerivative"],
    ] {
        if tags.len() == 2 {
            instance.initialize();
        }
        let lists = description.descendants();
        for list in lists.filter(|node| tags.iter().any(|tag| node.has_tag_name(*tag))) {
            let reference = list.attribute("valueReference").unwrap().parse().unwrap();
            let said = list.attribute("dependencies").unwrap().split_whitespace();
            let said: BTreeSet<Reference> = said.map(|r| r.parse().unwrap()).collect();
            let rows = answered(&instance, reference);
            let knowns: BTreeSet<Reference> = rows.iter().map(|row| row.1).collect();
            assert_eq!(knowns, said, "{list:?}");
            for (element, known, of) in rows {
                for (element, reference) in [(element, reference), (of, known)] {
                    let v = variables()
                        .values()
                        .find(|v| v.reference == reference)
                        .unwrap();
                    assert!(
                        element <= v.count && (v.count > 1 || element == 1),
                        "{}",
                        v.name
                    );
                }
            }
            count += 1;
        }
    }
    assert!(count > 60, "{count}");
}

#[test]
fn each_flap_angle_depends_on_its_own_rate_and_parameters_on_nothing() {
    let instance = Instance3::new();
    instance.initialize();
    let rate = variable("state.flapRate").reference;
    let rows = answered(&instance, variable("der(state.flapAngle)").reference);
    let expected: Vec<Row> = (1..=8).map(|blade| (blade, rate, blade)).collect();
    assert_eq!(rows, expected);
    // A state is known then.
    for (name, count) in [("state.inflow", 24), ("state.flapRate", 8), ("azimuth", 1)] {
        let state = variable(name).reference;
        let own: Vec<Row> = (1..=count).map(|i| (i, state, i)).collect();
        assert_eq!(answered(&instance, state), own, "{name}");
    }
    let rows = answered(&instance, variable("azimuth").reference);
    assert_eq!(rows, [(1, variable("azimuth").reference, 1)]);
    for name in ["collective", "geometry.radius", "settings", "time"] {
        assert_eq!(answered(&instance, variable(name).reference), []);
    }
}
