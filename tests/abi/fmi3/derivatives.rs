//! Directional and adjoint derivatives.

use crate::support::{
    Instance, Instance3, c,
    instance::reference,
    instance3::{Variable, variable, variables},
};
use helicopter_rotor::block::variables::REALS;

fn under_way() -> Instance3 {
    let instance = Instance3::for_model_exchange();
    instance.ok(instance.choose("models.inflow", 12));
    instance.ok(instance.set_boolean("flapping.enabled", 1));
    instance.ok(instance.set_floats(&["velocity"], &[12.0, 1.0, 0.5]));
    instance.initialize();
    instance.update_discrete_states();
    instance.enter_continuous_time();
    instance
}

fn count(all: &[&Variable]) -> usize {
    all.iter().map(|v| v.count).sum()
}

/// The product of the Jacobian with a vector on its right, or on its left.
fn product(
    instance: &Instance3,
    unknowns: &[&Variable],
    knowns: &[&Variable],
    seed: &[f64],
    is_adjoint: bool,
) -> Vec<f64> {
    let references = |all: &[&Variable]| all.iter().map(|v| v.reference).collect::<Vec<_>>();
    let (u, k) = (references(unknowns), references(knowns));
    let mut result = vec![f64::NAN; count(if is_adjoint { knowns } else { unknowns })];
    let f = instance.functions;
    let get = match is_adjoint {
        true => f.fmi3GetAdjointDerivative,
        false => f.fmi3GetDirectionalDerivative,
    };
    let (p, s, n) = (instance.pointer, seed.as_ptr(), seed.len());
    let (x, length) = (result.as_mut_ptr(), result.len());
    // SAFETY: the pointers are valid for their counts.
    instance.ok(unsafe { get(p, u.as_ptr(), u.len(), k.as_ptr(), k.len(), s, n, x, length) });
    result
}

fn unit(length: usize, i: usize) -> Vec<f64> {
    let mut unit = vec![0.0; length];
    unit[i] = 1.0;
    unit
}

#[test]
fn the_adjoint_derivatives_are_those_of_the_transposed_jacobian() {
    let instance = under_way();
    let unknowns = ["force", "hubMoment", "der(state.inflow)", "thrust"].map(variable);
    let knowns = [
        "velocity",
        "collective",
        "state.inflow",
        "flapping.hingeSpring",
    ]
    .map(variable);
    let (rows, columns) = (count(&unknowns), count(&knowns));
    let column = |j| product(&instance, &unknowns, &knowns, &unit(columns, j), false);
    let jacobian: Vec<Vec<f64>> = (0..columns).map(column).collect();
    let mut entries = 0;
    for i in 0..rows {
        let row = product(&instance, &unknowns, &knowns, &unit(rows, i), true);
        for (j, (entry, column)) in row.into_iter().zip(&jacobian).enumerate() {
            assert_eq!(entry, column[i], "row {i}, column {j}");
            entries += usize::from(entry != 0.0);
        }
    }
    assert!(entries > 20, "{entries}");
    // A vector on the left and one on the right: the same number either way.
    let left: Vec<f64> = (0..rows).map(|i| 0.3 + i as f64).collect();
    let right: Vec<f64> = (0..columns).map(|j| 1.0 / (1.0 + j as f64)).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let by_left = dot(&product(&instance, &unknowns, &knowns, &left, true), &right);
    let by_right = dot(
        &left,
        &product(&instance, &unknowns, &knowns, &right, false),
    );
    assert!(
        (by_left / by_right - 1.0).abs() < 1e-9,
        "{by_left} {by_right}"
    );
}

#[test]
fn directional_derivatives_are_those_of_fmi_2() {
    let (two, three) = (Instance::running(), Instance3::new());
    three.initialize();
    let unknowns = ["force[1]", "force[2]", "force[3]"].map(|n| reference(&REALS, n));
    let knowns = ["velocity[1]", "velocity[2]", "velocity[3]"].map(|n| reference(&REALS, n));
    let seed = [0.3, -0.2, 0.7];
    let mut expected = [0.0; 3];
    assert_eq!(two.along(&unknowns, &knowns, &seed, &mut expected), c::OK);
    let result = product(
        &three,
        &[variable("force")],
        &[variable("velocity")],
        &seed,
        false,
    );
    assert_eq!(result, expected);
}

/// What modelDescription.xml does not list as a dependency has the derivative 0.
#[test]
fn no_variable_depends_on_what_it_does_not_list() {
    let instance = under_way();
    let description = roxmltree::Document::parse(helicopter_rotor::description::XML_OF_FMI3);
    let description = description.unwrap();
    let is_known = |v: &&Variable| {
        v.kind == "Float64"
            && (v.causality == "input" || variables().contains_key(&format!("der({})", v.name)))
    };
    let knowns: Vec<&Variable> = variables().values().filter(is_known).collect();
    let mut zeros = 0;
    let lists = description.descendants().filter(|node| {
        node.has_tag_name("Output") || node.has_tag_name("ContinuousStateDerivative")
    });
    for list in lists {
        let of: u32 = list.attribute("valueReference").unwrap().parse().unwrap();
        let unknown = variables().values().find(|v| v.reference == of).unwrap();
        if unknown.kind != "Float64" {
            continue;
        }
        let on: Vec<u32> = list
            .attribute("dependencies")
            .unwrap()
            .split_whitespace()
            .map(|reference| reference.parse().unwrap())
            .collect();
        for known in knowns.iter().filter(|known| !on.contains(&known.reference)) {
            for j in 0..known.count {
                let seed = unit(known.count, j);
                let changes = product(&instance, &[unknown], &[known], &seed, false);
                assert!(
                    changes.iter().all(|change| *change == 0.0),
                    "{} depends on {}",
                    unknown.name,
                    known.name
                );
                zeros += 1;
            }
        }
    }
    assert!(zeros > 50, "{zeros}");
}
