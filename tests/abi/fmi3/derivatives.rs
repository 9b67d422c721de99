//! Directional and adjoint derivatives.

use super::dependencies::answered;
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

/// What the library does not list as a dependency of an element has the derivative 0.
#[test]
fn no_element_depends_on_what_it_does_not_list() {
    let instance = under_way();
    let has_derivative = |v: &Variable| variables().contains_key(&format!("der({})", v.name));
    let is_known = |v: &&Variable| {
        let can_be = v.causality == "input" || v.variability == "tunable" || has_derivative(v);
        v.kind == "Float64" && can_be
    };
    let is_unknown = |v: &&Variable| {
        let is_computed = v.causality == "output" || v.name.starts_with("der(");
        v.kind == "Float64" && is_computed
    };
    let all = || variables().values();
    let (mut zeros, mut within_arrays) = (0, 0);
    for known in all().filter(is_known) {
        for j in 1..=known.count {
            for unknown in all().filter(is_unknown) {
                let rows = answered(&instance, unknown.reference);
                let listed = |element: usize| {
                    rows.iter().any(|(of, on, element_on)| {
                        let is_element = [0, element].contains(of) && [0, j].contains(element_on);
                        *on == known.reference && is_element
                    })
                };
                let others: Vec<usize> = (1..=unknown.count).filter(|i| !listed(*i)).collect();
                if others.is_empty() {
                    continue;
                }
                let seed = unit(known.count, j - 1);
                let changes = product(&instance, &[unknown], &[known], &seed, false);
                for i in &others {
                    let (name, on) = (&unknown.name, &known.name);
                    assert_eq!(changes[i - 1], 0.0, "{name}[{i}] depends on {on}[{j}]");
                }
                zeros += others.len();
                within_arrays += usize::from(others.len() < unknown.count);
            }
        }
    }
    assert!(zeros > 500 && within_arrays >= 8, "{zeros} {within_arrays}");
}
