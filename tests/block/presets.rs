//! The presets: each is read and hovers, and those that were measured in hover are compared with
//! the measurement. Knight & Hefner's rotors are compared in
//! crates/program/tests/commands/importers.rs, and the rotors of which less is known in
//! presets/published.rs.

mod published;

use crate::support::block::{choose, default_block, project, resources, set_string};
use helicopter_rotor::block::{
    RotorBlock,
    variables::{integer, real, string},
};
use rotor::{
    airfoil::Airfoil,
    geometry::{self, GivenValue, RotorDefinition},
};
use std::fs;

fn preset(file: &str) -> RotorBlock {
    let mut block = default_block();
    set_string(&mut block, string::GEOMETRY__FILE, file);
    block
}

/// Thrust and torque coefficient in hover.
fn hover(block: &mut RotorBlock, collective_deg: f64, rpm: f64) -> [f64; 2] {
    let references = [real::COLLECTIVE, real::RPM];
    let values = [collective_deg.to_radians(), rpm];
    block.set_reals(&references, &values).unwrap();
    block.update().unwrap();
    [real::THRUST_COEFFICIENT, real::TORQUE_COEFFICIENT]
        .map(|reference| block.values().reals[reference])
}

/// The rows of a measured table in these columns. Rows with an empty field are left out.
fn measured<const N: usize>(file: &str, columns: [&str; N]) -> Vec<[f64; N]> {
    let path = project().join("fmu-examples/data").join(file);
    let mut table = csv::ReaderBuilder::new();
    let mut table = table.comment(Some(b'#')).from_path(path).unwrap();
    let header = table.headers().unwrap();
    let indices = columns.map(|c| header.iter().position(|h| h == c).unwrap());
    let rows = table.records().filter_map(|record| {
        let record = record.unwrap();
        let mut row = [0.0; N];
        for (slot, index) in row.iter_mut().zip(indices) {
            *slot = record[index].parse().ok()?;
        }
        Some(row)
    });
    rows.collect()
}

/// Castles & Gray's hover tests (NACA TN 2474, Table V): rev/min, pitch in deg, thrust coefficient.
fn castles_and_gray() -> Vec<[f64; 3]> {
    measured(
        "castles-gray-1951-tn2474-tableV-hover-6ft.csv",
        ["rpm", "theta_075R_deg", "CT"],
    )
}

#[test]
fn every_rotor_hovers() {
    let folder = resources().join("rotors");
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        let given = RotorDefinition::read(&path).unwrap().given;
        let number = |name: &str, default: f64| {
            let given = given.iter().find(|given| given.name == name);
            match given.map(|given| &given.value) {
                Some(GivenValue::Number(value)) => *value,
                _ => default,
            }
        };
        let (collective, rpm) = (number("collective", 10.0), number("rpm", 400.0));
        let [thrust, torque] = hover(&mut preset(name), collective, rpm);
        assert!((1e-3..0.02).contains(&thrust), "{name}: CT {thrust}");
        assert!((5e-5..3e-3).contains(&torque), "{name}: CQ {torque}");
        count += 1;
    }
    assert!(count >= 13);
}

/// Below CT = 0.0025 repeated runs differ by up to 20 %, so single points are compared above it. At
/// 12 deg the blades stall, and the computed thrust is 18 % too large.
#[test]
fn castles_and_grays_rotor_has_the_measured_thrust_in_hover() {
    let rows = castles_and_gray();
    let mut block = preset("castles-gray-6ft.toml");
    let mut ratios = Vec::new();
    let is_compared = |row: &[f64; 3]| row[2] > 0.0025 && row[1] < 11.0;
    for [rpm, pitch, thrust] in rows.into_iter().filter(is_compared) {
        let [computed, _] = hover(&mut block, pitch, rpm);
        let ratio = computed / thrust;
        assert!(
            (ratio - 1.0).abs() < 0.13,
            "{rpm} rpm, {pitch} deg: {ratio}"
        );
        ratios.push(ratio);
    }
    let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
    assert!(ratios.len() > 10 && (mean - 1.0).abs() < 0.02, "{mean}");
}

/// All runs, also repeated ones, from 4 deg of pitch to below stall.
#[test]
fn castles_and_grays_mean_error_of_thrust_is_below_5_per_cent() {
    let rows = castles_and_gray();
    let mut block = preset("castles-gray-6ft.toml");
    let compared = rows.iter().filter(|row| (4.0..11.0).contains(&row[1]));
    let magnitudes: Vec<f64> = compared
        .map(|[rpm, pitch, thrust]| (hover(&mut block, *pitch, *rpm)[0] / thrust - 1.0).abs())
        .collect();
    let mean = magnitudes.iter().sum::<f64>() / magnitudes.len() as f64;
    println!(
        "mean |dCT| {:.1} % of {} points",
        100.0 * mean,
        magnitudes.len()
    );
    assert!(magnitudes.len() == 15 && mean < 0.05, "{mean}");
}

/// NACA TN 626, p. 14: "The blade plan form was straight" and "the blade tip in cross section was
/// semicircular". So the plan form is rounded over half the section's thickness only, 0.15 in. A
/// tip that is semicircular in plan form would have nearly 2 % less torque.
#[test]
fn knight_and_hefners_blades_are_straight_up_to_the_edge_of_the_tip() {
    for blades in [3, 4] {
        let file = format!("rotors/knight-hefner-{blades}.toml");
        let text = fs::read_to_string(resources().join(file)).unwrap();
        let table: toml::Table = text.parse().unwrap();
        let stations: Vec<[f64; 2]> = table["station"]
            .as_array()
            .unwrap()
            .iter()
            .map(|s| ["r", "chord"].map(|key| s[key].as_float().unwrap()))
            .collect();
        let edge = 1.0 - 0.15 / 30.0;
        for [radius, chord] in &stations {
            let is_straight = (5.0 / 30.0..edge).contains(radius);
            assert!(!is_straight || *chord == 0.0508, "{blades}: {radius}");
        }
        let area: f64 = stations
            .windows(2)
            .filter(|pair| pair[0][0] > 0.9)
            .map(|pair| 0.5 * (pair[0][1] + pair[1][1]) * (pair[1][0] - pair[0][0]))
            .sum();
        // Half the section's area: 0.6851/2 t c, t = 0.15 c.
        let section = 0.5 * 0.6851 * 0.15 * 0.0508 * 0.0508 / 0.762;
        assert!(
            (area / section - 1.0).abs() < 0.03,
            "{blades}: {area} {section}"
        );
    }
}

/// The polar with drag by Reynolds number contains the measured polar at the Reynolds number of the
/// measurement. Its lift is the measured lift at all Reynolds numbers, and its drag falls with the
/// Reynolds number.
#[test]
fn the_polar_with_drag_by_reynolds_number_contains_the_measured_polar() {
    let blocks = |name: &str| -> Vec<(f64, Vec<[f64; 3]>)> {
        let text = fs::read_to_string(resources().join("airfoils").join(name)).unwrap();
        let mut blocks = Vec::new();
        for line in text.lines().filter(|line| !line.starts_with('#')) {
            let words: Vec<&str> = line.split_whitespace().collect();
            match words.as_slice() {
                ["reynolds", number] => blocks.push((number.parse().unwrap(), Vec::new())),
                [alpha, cl, cd] if alpha.parse::<f64>().is_ok() => {
                    let row = [alpha, cl, cd].map(|word| word.parse().unwrap());
                    blocks.last_mut().unwrap().1.push(row);
                }
                _ => {}
            }
        }
        blocks
    };
    let measured = blocks("naca0015-knight-hefner.polar");
    let scaled = blocks("naca0015-knight-hefner-reynolds.polar");
    assert!(measured.len() == 1 && scaled.contains(&measured[0]));
    assert!(scaled[0].0 <= 4e4 && scaled.last().unwrap().0 >= 1e6);
    for pair in scaled.windows(2) {
        for (low, high) in pair[0].1.iter().zip(&pair[1].1) {
            assert_eq!(low[..2], high[..2]);
            let is_stall = low[0].abs() > 12.0;
            assert!(
                low[2] > high[2] || is_stall && low[2] >= high[2],
                "{low:?} {high:?}"
            );
        }
    }
}

/// Caradonna & Tung (NASA TM-81232, figs. 3 to 5): annuli are known to give too much thrust for
/// blades of aspect ratio 6. This is only a regression test.
#[test]
fn caradonna_and_tungs_rotor_has_the_known_excess_of_thrust_with_annuli() {
    let rows = measured(
        "caradonna-tung-1981-tm81232-CT.csv",
        ["collective_deg", "rpm", "CT"],
    );
    let mut block = preset("caradonna-tung.toml");
    // At 2268 rpm the report has an evident misprint.
    for [collective, rpm, thrust] in rows.into_iter().filter(|row| row[1] != 2268.0) {
        let [computed, _] = hover(&mut block, collective, rpm);
        let ratio = computed / thrust;
        assert!(
            (1.25..1.45).contains(&ratio),
            "{collective} deg, {rpm} rpm: {ratio}"
        );
    }
}

/// The thesis gives no measured thrust. At its speed and pitch, its lift slopes give nearly the
/// thrust of the airfoil table.
#[test]
fn the_thesis_rotor_hovers_with_the_thesis_lift_slopes() {
    for collective in [15.3, 16.9] {
        let mut block = preset("thesis.toml");
        let [table, _] = hover(&mut block, collective, 430.5);
        set_string(&mut block, string::AIRFOIL__FILE, "naca0015.txt");
        choose(&mut block, integer::MODELS__LIFT, "slopesByReynolds");
        let [slopes, _] = hover(&mut block, collective, 430.5);
        let tip_speed = 430.5 * std::f64::consts::PI / 30.0 * 1.22;
        assert!((tip_speed - 55.0).abs() < 0.01);
        assert!((slopes / table - 1.0).abs() < 0.15, "{table} {slopes}");
    }
}

#[test]
fn every_airfoil_is_read() {
    for entry in fs::read_dir(resources().join("airfoils")).unwrap() {
        let path = entry.unwrap().path();
        Airfoil::read(&path).unwrap_or_else(|error| panic!("{error}"));
    }
}

/// A rotor file may hold what the parameters may hold.
#[test]
fn the_ranges_of_rotor_files_are_those_of_the_parameters() {
    for (reference, range) in [
        (real::GEOMETRY__RADIUS, geometry::RADIUS),
        (real::GEOMETRY__ROOT_CUTOUT, geometry::CUTOUT),
        (real::GEOMETRY__CHORD, geometry::CHORD),
        (real::GEOMETRY__TWIST, geometry::TWIST),
        (real::GEOMETRY__PITCH_REFERENCE_RADIUS, 0.0..=1.0),
    ] {
        let variable = reference.variable();
        assert_eq!(variable.min..=variable.max, range, "{}", variable.name);
    }
    let blades = integer::GEOMETRY__NUMBER_OF_BLADES.variable();
    assert_eq!((blades.min, blades.max), (1, geometry::MAX_BLADES as i32));
}
