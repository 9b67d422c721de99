//! The parameter `settings` through the C interface: an importer that can set strings only sets
//! enumerations and Booleans with it.

use crate::support::{Instance, c, instance::bits};

const TEXT: &str = "models.inflow = pittPetersDynamic; flapping.enabled = true";

#[test]
fn a_string_sets_enumerations_and_booleans_and_is_read_back() {
    let instance = Instance::new();
    assert_eq!(instance.set_string("settings", TEXT), c::OK);
    instance.initialize();
    assert_eq!(instance.string("settings"), TEXT);
    assert_eq!(instance.integer("models.inflow"), 12);
    assert_eq!(instance.boolean("flapping.enabled"), 1);
    assert_eq!(instance.step(0.0, 0.01), c::OK);

    let direct = Instance::new();
    assert_eq!(direct.set_integer("models.inflow", 12), c::OK);
    assert_eq!(direct.set_boolean("flapping.enabled", 1), c::OK);
    direct.initialize();
    assert_eq!(direct.step(0.0, 0.01), c::OK);
    assert_eq!(bits(&instance.reals()), bits(&direct.reals()));
    assert!(direct.real("coning") > 0.0);
}

#[test]
fn a_refused_text_is_one_error_in_the_log_and_changes_nothing() {
    let instance = Instance::new();
    let text = "flapping.enabled = true; models.inflow = pitPetersDynamic";
    let message = instance.refused(instance.set_string("settings", text));
    for part in [
        "fmi2SetString: settings: models.inflow = pitPetersDynamic is not allowed",
        "1 (annulusClosedForm)",
        "did you mean pittPetersDynamic?",
        "no assignment in settings was made",
    ] {
        assert!(message.contains(part), "{part:?} is not in {message}");
    }
    instance.begin_initialization();
    assert_eq!(instance.boolean("flapping.enabled"), 0);
    assert_eq!(instance.string("settings"), "");
    assert_eq!(instance.set_string("settings", TEXT), c::OK, "the next try");
    assert_eq!(instance.boolean("flapping.enabled"), 1);
}

#[test]
fn a_reset_returns_to_the_defaults() {
    let instance = Instance::new();
    assert_eq!(instance.set_string("settings", TEXT), c::OK);
    instance.initialize();
    assert_eq!(instance.reset(), c::OK);
    instance.initialize();
    assert_eq!(instance.string("settings"), "");
    assert_eq!(bits(&instance.reals()), bits(&Instance::running().reals()));
}

/// As importers do that write the start value of every variable, after what the user wants.
#[test]
fn writing_the_empty_start_value_of_settings_undoes_nothing() {
    let instance = Instance::new();
    assert_eq!(instance.set_boolean("flapping.enabled", 1), c::OK);
    assert_eq!(instance.set_string("settings", ""), c::OK);
    instance.begin_initialization();
    assert_eq!(instance.boolean("flapping.enabled"), 1);
}
