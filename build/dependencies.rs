//! The variables on which others depend, as both versions of the description say it.

use crate::{
    arrays::Grouped,
    table::{Table, Variable},
};

/// The inputs and states on which an output or a derivative depends.
pub fn knowns<'a>(table: &'a Table, v: &Variable) -> Vec<&'a Variable> {
    let all = table.inputs().chain(table.states());
    all.filter(|known| contains(&v.depends_on, known)).collect()
}

/// The inputs and parameters on which a variable depends at the start, directly or by way of
/// states.
pub fn initial_knowns<'a>(table: &'a Table, v: &Variable) -> Vec<&'a Variable> {
    if v.nominal.is_some() {
        return from_start(table, v);
    }
    let of_groups = parameters(table, &v.parameter_groups);
    let mut found: Vec<&Variable> = of_groups.collect();
    for known in knowns(table, v) {
        if known.nominal.is_some() {
            found.extend(from_start(table, known));
        } else {
            found.push(known);
        }
    }
    found
}

/// The inputs and parameters on which a state depends at the start.
fn from_start<'a>(table: &'a Table, state: &Variable) -> Vec<&'a Variable> {
    let inputs = table.inputs().filter(|i| contains(&state.starts_from, i));
    inputs
        .chain(parameters(table, &state.parameter_groups))
        .collect()
}

/// Whether a list contains a variable. Without a list all variables are meant.
fn contains(list: &Option<Vec<String>>, variable: &Variable) -> bool {
    list.as_ref().is_none_or(|l| l.contains(&variable.name))
}

/// The parameters of a list of groups, or all parameters without a list.
fn parameters<'a>(
    table: &'a Table,
    groups: &Option<Vec<String>>,
) -> impl Iterator<Item = &'a Variable> {
    table.parameters(None).filter(move |p| {
        let own = p.name.split('.').next().unwrap_or_default();
        groups.as_ref().is_none_or(|g| g.iter().any(|g| g == own))
    })
}

/// The parameters on which a computed variable depends directly.
pub fn parameters_of<'a>(table: &'a Table, v: &Variable) -> Vec<&'a Variable> {
    parameters(table, &v.parameter_groups).collect()
}

/// One element of a variable of FMI 3.0, or all elements, depends on one element of another or on
/// all. Elements count from 1; 0 means all elements of an array.
#[derive(Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Dependency {
    pub element: usize,
    /// The value reference in FMI 3.0.
    pub on: u32,
    pub element_on: usize,
}

/// When dependencies hold: until the initialisation ends, or afterwards.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Phase {
    Initial,
    Running,
}

fn knowns_in<'a>(table: &'a Table, v: &'a Variable, phase: Phase) -> Vec<&'a Variable> {
    match phase {
        Phase::Initial => initial_knowns(table, v),
        // A state is known then.
        Phase::Running if v.nominal.is_some() => vec![v],
        Phase::Running => [knowns(table, v), parameters_of(table, v)].concat(),
    }
}

/// The dependencies of a variable of FMI 3.0: on inputs, states and parameters.
pub fn of_grouped(
    table: &Table,
    all: &[Grouped],
    grouped: &Grouped,
    phase: Phase,
) -> Vec<Dependency> {
    let elements = grouped.elements.iter();
    let of_elements: Vec<Vec<&Variable>> = elements.map(|v| knowns_in(table, v, phase)).collect();
    let first = names(&of_elements[0]);
    let are_alike = of_elements.iter().all(|knowns| names(knowns) == first);
    let mut dependencies = Vec::new();
    for (i, knowns) in of_elements.iter().enumerate() {
        let element = if are_alike { grouped.whole() } else { i + 1 };
        for on in all {
            let is_known = |element: &&Variable| knowns.iter().any(|k| k.name == element.name);
            let dependency = |element_on: usize| Dependency {
                element,
                on: on.reference,
                element_on,
            };
            if on.elements.iter().all(&is_known) {
                dependencies.push(dependency(on.whole()));
            } else {
                let known = on.elements.iter().enumerate();
                let known = known.filter(|(_, element)| is_known(element));
                dependencies.extend(known.map(|(i, _)| dependency(i + 1)));
            }
        }
        if are_alike {
            break;
        }
    }
    dependencies
}

fn names<'a>(variables: &[&'a Variable]) -> Vec<&'a str> {
    let mut names: Vec<&str> = variables.iter().map(|v| v.name.as_str()).collect();
    names.sort_unstable();
    names
}
