//! The documentation's tables of variables and choices.

use crate::table::{Base, Table, Variable};

pub fn tables(table: &Table) -> String {
    let mut html = String::new();
    for (causality, title) in [
        ("input", "Inputs"),
        ("output", "Outputs"),
        ("local", "Local variables"),
        ("parameter", "Parameters"),
    ] {
        html += &format!(
            "<h3>{title}</h3>\n<table>\n<tr><th>Name</th><th>Unit or type</th><th>Default</th><th>Range</th><th>Meaning</th></tr>\n"
        );
        // An array has one row, which names the range of its indices.
        let rows = table
            .variables
            .iter()
            .filter(|v| v.causality == causality && (v.count.is_none() || v.name.contains("[1]")));
        for v in rows {
            html += &variable_row(table, v);
        }
        html += "</table>\n";
    }
    html += "<h3>Choices</h3>\n<table>\n<tr><th>Type</th><th>Choice</th><th>Value</th><th>Meaning</th></tr>\n";
    for enumeration in &table.enumerations {
        for item in &enumeration.items {
            html += &format!(
                "<tr><td>{}</td><td><code>{}</code></td><td>{}</td><td>{}</td></tr>\n",
                enumeration.name,
                item.name,
                item.value,
                escape(&item.description)
            );
        }
    }
    html += "</table>\n";
    html
}

fn variable_row(table: &Table, v: &Variable) -> String {
    let name = match v.count {
        Some(n) => v.name.replace("[1]", &format!("[1..{n}]")),
        None => v.name.clone(),
    };
    let is_tunable = v.variability() == "tunable";
    format!(
        "<tr><td><code>{name}</code></td><td>{}</td><td>{}</td><td>{}</td><td>{}{}</td></tr>\n",
        unit_or_type(v),
        default(table, v),
        range(table, v),
        escape(&v.description),
        if is_tunable { " (tunable)" } else { "" },
    )
}

fn unit_or_type(v: &Variable) -> String {
    match (&v.unit, &v.display_unit) {
        (Some(unit), Some(display)) => format!("{unit} (shown in {display})"),
        (Some(unit), None) => unit.clone(),
        _ => v.kind.clone(),
    }
}

fn default(table: &Table, v: &Variable) -> String {
    match (&v.start, v.base()) {
        (None, _) => String::new(),
        (Some(start), Base::Real) => {
            let (factor, offset, unit) = shown_in(table, v);
            let value = start.as_float().unwrap_or_default() * factor + offset;
            format!("{} {unit}", short(value)).trim_end().to_owned()
        }
        (Some(start), Base::String) => match start.as_str() {
            None | Some("") => "(empty)".to_owned(),
            Some(text) => format!("<code>{}</code>", escape(text)),
        },
        (Some(start), Base::Integer | Base::Boolean) => match start.as_str() {
            Some(choice) => format!("<code>{choice}</code>"),
            None => start.to_string(),
        },
    }
}

fn range(table: &Table, v: &Variable) -> String {
    let (factor, offset, _) = shown_in(table, v);
    let shown = |limit: f64| short(limit * factor + offset);
    match (v.min, v.max) {
        (Some(min), Some(max)) => format!("{} to {}", shown(min), shown(max)),
        (Some(min), None) => format!("from {}", shown(min)),
        (None, Some(max)) => format!("to {}", shown(max)),
        (None, None) => String::new(),
    }
}

/// Factor, offset and name of the display unit. Without one they change nothing.
fn shown_in<'a>(table: &'a Table, v: &'a Variable) -> (f64, f64, &'a str) {
    let unit = table
        .units
        .iter()
        .find(|u| Some(&u.name) == v.unit.as_ref());
    let displays = unit.map_or(&[][..], |u| &u.display);
    displays
        .iter()
        .find(|d| Some(&d.name) == v.display_unit.as_ref())
        .map_or((1.0, 0.0, ""), |d| {
            (d.factor, d.offset.unwrap_or(0.0), d.name.as_str())
        })
}

/// At most six decimals, without trailing zeros.
fn short(value: f64) -> String {
    let text = format!("{value:.6}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "0" && value != 0.0 {
        return format!("{value:e}");
    }
    text.to_owned()
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
}
