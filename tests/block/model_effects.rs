//! Every choice of a model has an effect. With each inflow model, any two items of each `models.*`
//! enumeration differ in thrust or torque in at least one of a few flights, unless the
//! documentation says that they are equal.

use crate::support::block::{choose, default_block, get, set, set_string};
use helicopter_rotor::block::variables::{INTEGERS, IntegerRef, RealRef, integer, real, string};
use std::collections::BTreeSet;

/// A flight as changes of the default inputs.
type Flight = &'static [(RealRef, f64)];

/// Hover, climb, the vortex ring, forward flight with cyclic pitch, hover near the ground and a
/// fast tip.
const FLIGHTS: [Flight; 6] = [
    &[],
    &[(real::VELOCITY_3, 4.0)],
    &[(real::VELOCITY_3, -5.0)],
    &[(real::VELOCITY_1, 20.0), (real::CYCLIC_LONGITUDINAL, 0.03)],
    &[(real::HEIGHT_ABOVE_GROUND, 0.9)],
    &[(real::RPM, 2400.0)],
];

/// The section data have lift slopes, which `slopesByReynolds` needs.
const AIRFOIL: &str = "airfoils/naca0015.txt";

/// Relative difference of thrust or torque that counts as an effect.
const EFFECT: f64 = 1e-6;

/// Pairs of items that are equal with every inflow model, as (variable, item, item):
///
/// * `gessowMyers` and `wheatley` are one formula, published twice.
/// * `automatic` blades are `individual` ones where the loads depend on the azimuth.
const SAME_WITH_ALL: [(&str, &str, &str); 2] = [
    ("models.tipLoss", "gessowMyers", "wheatley"),
    ("models.blades", "automatic", "individual"),
];

/// Variables without effect in `annulusClosedForm`. That model holds for axial flow in free air
/// only. Its description says that it is always computed as a disc, by momentum theory, and that
/// ground effect is refused.
const WITHOUT_EFFECT_IN_CLOSED_FORM: [&str; 3] =
    ["models.blades", "models.descent", "models.groundEffect"];

/// Whether a combination of models is refused, as the description of `annulusClosedForm` says.
fn is_refused(inflow: &str, variable: &str, item: &str) -> bool {
    inflow == "annulusClosedForm" && variable == "models.groundEffect" && item != "none"
}

/// Thrust and torque in all flights, or None if the combination of models is refused.
fn loads(inflow: &str, choice: Option<(IntegerRef, &str)>) -> Option<Vec<f64>> {
    let mut all = Vec::new();
    for flight in FLIGHTS {
        let mut block = default_block();
        set_string(&mut block, string::AIRFOIL__FILE, AIRFOIL);
        choose(&mut block, integer::MODELS__INFLOW, inflow);
        if let Some((variable, item)) = choice {
            choose(&mut block, variable, item);
        }
        for (input, value) in flight {
            set(&mut block, *input, *value);
        }
        block.start().ok()?;
        all.extend([get(&block, real::THRUST), get(&block, real::TORQUE)]);
    }
    Some(all)
}

fn differ(a: &[f64], b: &[f64]) -> bool {
    let mut pairs = a.iter().zip(b);
    pairs.any(|(x, y)| (x - y).abs() > EFFECT * x.abs().max(y.abs()))
}

fn models() -> impl Iterator<Item = IntegerRef> {
    IntegerRef::all().filter(|variable| variable.variable().name.starts_with("models."))
}

#[test]
fn every_choice_of_a_model_has_an_effect_with_every_inflow_model() {
    let mut without_effect = BTreeSet::new();
    for inflow in integer::MODELS__INFLOW.variable().choices {
        for variable in models().filter(|v| *v != integer::MODELS__INFLOW) {
            let name = variable.variable().name;
            let items = variable.variable().choices.iter();
            let found: Vec<_> = items
                .filter_map(|item| {
                    let loads = loads(inflow, Some((variable, item)));
                    let is_refused = is_refused(inflow, name, item);
                    assert_eq!(loads.is_none(), is_refused, "{inflow}: {name} {item}");
                    Some((*item, loads?))
                })
                .collect();
            let is_silent =
                *inflow == "annulusClosedForm" && WITHOUT_EFFECT_IN_CLOSED_FORM.contains(&name);
            for (i, (first, a)) in found.iter().enumerate() {
                for (second, b) in &found[i + 1..] {
                    if !differ(a, b)
                        && !is_silent
                        && !SAME_WITH_ALL.contains(&(name, first, second))
                    {
                        without_effect.insert(format!("{inflow}: {name} {first} and {second}"));
                    }
                    assert!(
                        !(differ(a, b) && is_silent),
                        "{inflow}: {name} has an effect"
                    );
                }
            }
        }
    }
    assert!(without_effect.is_empty(), "no effect: {without_effect:#?}");
}

#[test]
fn any_two_inflow_models_differ() {
    let items = integer::MODELS__INFLOW.variable().choices;
    let found: Vec<Vec<f64>> = items
        .iter()
        .map(|item| loads(item, None).unwrap())
        .collect();
    for i in 0..items.len() {
        for k in i + 1..items.len() {
            assert!(
                differ(&found[i], &found[k]),
                "{} and {}",
                items[i],
                items[k]
            );
        }
    }
}

/// The tests cover every `models.*` enumeration.
#[test]
fn all_enumerations_of_models_are_covered() {
    let names: Vec<&str> = models().map(|v| v.variable().name).collect();
    assert_eq!(names.len(), 7, "{names:?}");
    assert_eq!(
        INTEGERS
            .iter()
            .filter(|v| v.name.starts_with("models."))
            .count(),
        names.len()
    );
}
