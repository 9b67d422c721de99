//! `examples`: the systems that contain the rotor, run as a user runs them, and their numbers.

use crate::{
    support::{self, scratch, succeed},
    tables::{Row, assert_plot, csv, value},
};
use std::{f64::consts::PI, fs, path::PathBuf, process::Command};

/// Runs an example by its name, and returns its output and the folder of its files.
fn run(name: &str) -> (String, PathBuf) {
    let (text, out) = run_all(&[name]);
    (text, out.join(name))
}

/// Runs several, which may use each other's files.
fn run_all(names: &[&str]) -> (String, PathBuf) {
    let out = scratch().join(format!("examples-{}", names[0]));
    let mut command = support::program();
    command.arg("examples").args(names).arg("--out").arg(&out);
    let text = succeed(command.arg("--library").arg(support::library()));
    println!("{text}");
    (text, out)
}

#[test]
fn an_example_that_does_not_exist_is_refused_with_the_names_of_those_that_do() {
    let message = support::fail(support::program().args(["examples", "climbing-disk"]));
    for part in ["climbing-disk", "climbing-disc", "forward-flight"] {
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn an_example_that_fails_is_named_and_the_others_run() {
    let program = support::installed("failing-example");
    // In the place of Python.
    let script = r#"case "$2" in
*engine_off.py) echo "no engine" >&2; exit 1 ;;
*) echo "progress 1 2 half"; echo flown; touch "$6/table.csv" ;;
esac"#;
    support::install_interpreter(&program, script);
    let out = scratch().join("failing-example-results");
    let mut command = Command::new(&program);
    command.arg("--library").arg(support::library());
    command.args(["examples", "engine-off", "hover-trim", "--out"]);
    let output = command.arg(&out).output().unwrap();
    let (text, errors) = (
        String::from_utf8_lossy(&output.stdout),
        String::from_utf8_lossy(&output.stderr),
    );
    assert_eq!(output.status.code(), Some(1), "{text}{errors}");
    assert!(errors.contains("no engine"), "{errors}");
    assert!(
        errors.contains("these examples failed: engine-off;"),
        "{errors}"
    );
    // Progress is for the bar.
    assert!(
        text.contains("flown") && !text.contains("progress"),
        "{text}"
    );
    assert!(out.join("hover-trim/table.csv").is_file());
}

#[test]
fn a_disc_climbs_to_its_height_and_holds_it() {
    let (_, folder) = run("climbing-disc");
    let rows = csv(&folder.join("climbing-disc.csv"));
    let column = |name| rows.iter().map(|row| value(row, name)).collect::<Vec<_>>();
    let (heights, climbs) = (column("height"), column("climb"));
    let highest = heights.iter().copied().fold(0.0, f64::max);
    assert!((1.005..1.04).contains(&(highest / 2.5)), "{highest}");
    let settled = value(&rows[560], "time");
    assert!((settled - 2.8).abs() < 1e-9);
    for height in &heights[560..] {
        assert!((height / 2.5 - 1.0).abs() < 0.021, "{height}");
    }
    assert!((heights[200] - 1.369).abs() < 0.01, "{}", heights[200]);

    // What the disc has gained in momentum is the impulse of thrust less weight.
    let (thrusts, weight) = (column("thrust"), value(&rows[0], "thrust"));
    let impulse: f64 = thrusts
        .windows(2)
        .map(|pair| (0.5 * (pair[0] + pair[1]) - weight) * 0.005)
        .sum();
    let momentum = weight / 9.81 * climbs.last().unwrap();
    assert!((impulse - momentum).abs() < 1e-6, "{impulse} {momentum}");
    // Steady again, the rotor carries the weight at the pitch with which it began.
    let last = rows.last().unwrap();
    assert!((value(last, "thrust") / weight - 1.0).abs() < 1e-3);
    assert!((value(last, "collective") * 180.0 / PI - 8.0).abs() < 0.02);
    assert_plot(&folder.join("climbing-disc.png"));
    assert_plot(&folder.join("tip-path.png"));
    let film = folder.join("climbing-disc.gif").metadata().unwrap().len();
    assert!((100_000..2_000_000).contains(&film), "{film}");
    assert_plot(&folder.join("climbing-disc.html"));
}

/// They exchange values in different orders, and differ by some centimetres on the way.
#[test]
fn three_tools_fly_the_same_ssp() {
    let (_, folder) = run("climbing-disc-ssp");
    let rows = csv(&folder.join("climbing-disc-ssp.csv"));
    assert_eq!(rows.len(), 1601);
    let at = |row: &Row, tool| value(row, tool);
    let tools: Vec<_> = ["fmpy", "ecos", "libcosim"]
        .into_iter()
        .filter(|tool| rows[0].contains_key(*tool))
        .collect();
    // There is no libcosimpy for Python 3.10.
    assert!(tools.len() >= 2, "{tools:?}");
    for tool in tools {
        for (i, height, tolerance) in [
            (200, 1.369, 0.03),
            (1000, 2.539, 0.006),
            (1600, 2.506, 0.002),
        ] {
            let found = at(&rows[i], tool);
            assert!((found - height).abs() < tolerance, "{tool} {i}: {found}");
        }
    }
    assert_plot(&folder.join("climbing-disc-ssp.png"));
    assert!(folder.join("climbing-disc.ssp").is_file());
}

#[test]
fn a_helicopter_of_two_rotors_is_trimmed_and_linearised() {
    let (_, folder) = run("helicopter");
    let rows = csv(&folder.join("trim.csv"));
    assert_eq!(rows.len(), 13);
    for row in &rows {
        assert!(value(row, "residual") < 1e-8, "{row:?}");
        assert!(value(row, "steps") <= 6.0, "{row:?}");
    }
    power_has_its_bucket(&rows);
    // The tail rotor's thrust to the right is balanced by a roll to the left, the more the torque.
    assert!((-4.0..-2.0).contains(&value(&rows[0], "roll")));
    let derivatives = csv(&folder.join("derivatives.csv"));
    heave_damping_in_hover_is_that_of_theory(&derivatives);
    the_phugoid_is_unstable_in_hover_only(&csv(&folder.join("eigenvalues.csv")));
    stability_derivatives_follow_the_rotors(&csv(&folder.join("response.csv")));
    for name in ["trim.png", "eigenvalues.png", "response.png"] {
        assert_plot(&folder.join(name));
    }
}

const MASS: f64 = 5401.0 * 4.4482216 / 9.80665; // kg
const DISC_LOADED: f64 = 1.225 * PI * 5.4864 * 5.4864; // density times disc area, kg/m

/// In hover the main rotor takes the power of momentum theory over a figure of merit of 0.65 to
/// 0.8, and the tail rotor some per cent. The power is least near 65 knots, at about half of that.
/// (The drag of 10.8 ft2, and profile power as in hover, give the rest.)
fn power_has_its_bucket(rows: &[Row]) {
    let weight = MASS * 9.80665;
    let ideal = weight * (weight / (2.0 * DISC_LOADED)).sqrt();
    let merit = ideal / value(&rows[0], "mainPower");
    assert!((0.65..0.8).contains(&merit), "{merit}");
    let part = value(&rows[0], "tailPower") / value(&rows[0], "mainPower");
    assert!((0.05..0.12).contains(&part), "{part}");
    let power = |row: &Row| value(row, "mainPower") + value(row, "tailPower");
    let least = rows
        .iter()
        .min_by(|a, b| power(a).total_cmp(&power(b)))
        .unwrap();
    assert!((30.0..=40.0).contains(&value(least, "speed")), "{least:?}");
    let depth = power(least) / power(&rows[0]);
    assert!((0.45..0.65).contains(&depth), "{depth}");
    // Two engines of 420 hp were installed.
    assert!(rows.iter().all(|row| power(row) < 2.0 * 420.0 * 745.7));
}

/// -2 a A_b rho Omega R lambda/((16 lambda + a sigma) m), with the blade area A_b (Padfield 2007,
/// Helicopter Flight Dynamics); the fuselage in the wake adds some per cent.
fn heave_damping_in_hover_is_that_of_theory(derivatives: &[Row]) {
    let hover = |row: &&Row| row["row"] == "up" && value(row, "speed") == 0.0;
    let found = value(derivatives.iter().find(hover).unwrap(), "up");
    let (slope, solidity, tip) = (6.0, 4.0 * 1.1 / (18.0 * PI), 385.0 * PI / 30.0 * 5.4864);
    let inflow = (MASS * 9.80665 / (2.0 * DISC_LOADED)).sqrt() / tip;
    let theory = -2.0 * slope * solidity * DISC_LOADED * tip * inflow
        / ((16.0 * inflow + slope * solidity) * MASS);
    assert!((1.0..1.15).contains(&(found / theory)), "{found} {theory}");
}

/// Its period is 10 to 20 s in hover, and longer the faster the flight. All else is damped.
fn the_phugoid_is_unstable_in_hover_only(modes: &[Row]) {
    let at = |speed: f64| -> Vec<(f64, f64)> {
        modes
            .iter()
            .filter(|row| value(row, "speed") == speed)
            .map(|row| (value(row, "real"), value(row, "imaginary")))
            .filter(|(_, imaginary)| *imaginary >= 0.0)
            .collect()
    };
    let unstable: Vec<_> = at(0.0)
        .into_iter()
        .filter(|(real, _)| *real > 0.0)
        .collect();
    let [(growth, frequency)] = unstable[..] else {
        panic!("{unstable:?}")
    };
    assert!((0.1..0.5).contains(&growth), "{growth}");
    assert!(
        (10.0..20.0).contains(&(2.0 * PI / frequency)),
        "{frequency}"
    );
    let fast = at(60.0);
    assert!(fast.iter().all(|(real, _)| *real < 0.0), "{fast:?}");
    let slowest = fast
        .iter()
        .filter(|(_, imaginary)| *imaginary > 0.01)
        .map(|(_, imaginary)| 2.0 * PI / imaginary)
        .fold(0.0, f64::max);
    assert!((30.0..70.0).contains(&slowest), "{slowest}");
}

/// Half a degree of cyclic pitch: the rates of the body agree within a tenth for two seconds.
fn stability_derivatives_follow_the_rotors(rows: &[Row]) {
    for (name, part) in [("pitchRate", 0.1), ("pitch", 0.05), ("forward", 0.1)] {
        let early: Vec<&Row> = rows.iter().filter(|row| value(row, "time") < 2.0).collect();
        let largest = early
            .iter()
            .fold(0.0_f64, |most, row| most.max(value(row, name).abs()));
        for row in &early {
            let off = value(row, name) - value(row, &format!("linear:{name}"));
            assert!(off.abs() < part * largest, "{name}: {off} of {largest}");
        }
    }
}

#[test]
fn a_quadrotor_of_four_rotors_reaches_its_place_and_heading() {
    let (text, folder) = run("quadrotor");
    assert!(
        text.contains("s of computing for each second of flight"),
        "{text}"
    );
    let table = csv(&folder.join("quadrotor.csv"));
    let flight = |gyroscopic: &str| -> Vec<&Row> {
        table
            .iter()
            .filter(|row| row["gyroscopic"] == gyroscopic)
            .collect()
    };
    let (rows, without) = (flight("1"), flight("0"));
    // It hovers until the step at 0.5 s, then goes 3 m forward without overshoot, keeps its height,
    // and turns.
    for row in &rows[..250] {
        for name in ["x", "y", "z"] {
            assert!(value(row, name).abs() < 1e-3, "{row:?}");
        }
    }
    for row in &rows {
        assert!(
            value(row, "z").abs() < 0.1 && value(row, "x") < 3.05,
            "{row:?}"
        );
    }
    let last = rows.last().unwrap();
    assert!((value(last, "x") - 3.0).abs() < 0.02, "{last:?}");
    assert!((value(last, "heading") - 90.0).abs() < 0.5, "{last:?}");

    // It first turns only. What body and rotors gain in angular momentum comes from the air.
    let (from, to) = (rows[250], rows[300]);
    let gained = value(to, "yawMomentum") - value(from, "yawMomentum");
    let of_air: f64 = rows[250..=300]
        .windows(2)
        .map(|pair| 0.5 * 0.002 * (value(pair[0], "airTorque") + value(pair[1], "airTorque")))
        .sum();
    assert!((gained / of_air - 1.0).abs() < 0.02, "{gained} {of_air}");
    assert!(value(to, "yawRate") > 0.5);

    // Blades of 2 x 4.8e-5 kg.m2 on four rotors, whose speeds differ, pull at a body that pitches.
    let changes = rows.iter().zip(&without);
    let most = changes
        .map(|(row, other)| (value(row, "pitch") - value(other, "pitch")).abs())
        .fold(0.0, f64::max);
    assert!((2.0..6.0).contains(&most), "{most}");
    assert_plot(&folder.join("quadrotor.png"));
}

#[test]
fn a_map_of_100000_conditions_has_the_same_bits_however_it_is_made() {
    let (text, out) = run_all(&["rotor-map", "surrogate"]);
    assert!(
        text.contains("All 100000 conditions are the same in all runs: True"),
        "{text}"
    );
    assert!(text.contains("killing worker process"), "{text}");
    let runs = csv(&out.join("rotor-map/map.csv"));
    assert_eq!(runs.len(), 4);
    for run in &runs {
        assert_eq!(run["same_bits"], "True");
        let [half, end] = ["memory_half", "memory_end"].map(|name| value(run, name));
        assert!(end < 1.1 * half && end < 400.0, "{run:?}");
        assert!(value(run, "rate") > 100.0, "{run:?}");
    }
    assert_plot(&out.join("rotor-map/map.png"));
    the_surrogate_has_its_error(&csv(&out.join("surrogate/surrogate.csv")));
    assert_plot(&out.join("surrogate/surrogate.png"));
}

/// In conditions that the map does not have; the FMU says what is right.
fn the_surrogate_has_its_error(rows: &[Row]) {
    assert_eq!(rows.len(), 1000);
    for (name, root_mean_square, worst) in [("thrust", 2e-4, 2e-3), ("torque", 5e-4, 5e-3)] {
        let largest = rows
            .iter()
            .fold(0.0_f64, |most, row| most.max(value(row, name).abs()));
        let errors = rows
            .iter()
            .map(|row| (value(row, &format!("surrogate:{name}")) - value(row, name)) / largest);
        let (squares, most) = errors.fold((0.0, 0.0_f64), |(sum, most), e| {
            (sum + e * e, most.max(e.abs()))
        });
        let mean = (squares / rows.len() as f64).sqrt();
        assert!(
            mean < root_mean_square && most < worst,
            "{name}: {mean} {most}"
        );
        assert!(mean > 0.0);
    }
}

/// What needs the Modelica Standard Library is left out where MODELICAPATH does not name it.
#[test]
fn the_modelica_package_is_parsed_and_has_the_names_and_frames_of_the_fmu() {
    let (text, out) = run("modelica");
    for part in [
        "parse the package.",
        "names of the FMU stay different",
        "has the FMU's thrust and derivatives",
        "The frames agree with SciPy",
    ] {
        assert!(text.contains(part), "{part} is missing in\n{text}");
    }
    let imported = fs::read_to_string(out.join("HelicopterRotor_me_FMU.mo")).unwrap();
    assert!(imported.contains("RealInput velocity_1_;"), "{imported}");
}

/// The mean inflow of a rotor with lift slope a settles in 8 R/(3 pi)/(4 v + a sigma Omega R/4)
/// (Pitt & Peters 1981), here with v = 3.8 m/s and a of 6 to 6.5: 24 to 26 ms.
#[test]
fn the_notebook_runs_from_import_to_a_linear_model() {
    let (text, folder) = run("notebook");
    let number_after = |words: &str| -> f64 {
        let found = text.split(words).nth(1);
        let mut rest = found
            .unwrap_or_else(|| panic!("no {words} in {text}"))
            .split_whitespace();
        rest.next().unwrap().parse().unwrap()
    };
    let merit = number_after("best figure of merit");
    assert!((0.6..0.75).contains(&merit), "{merit}");
    let settling = number_after("time constant of the mean inflow");
    assert!((22.0..28.0).contains(&settling), "{settling}");
    let difference = number_after("largest difference");
    assert!((0.0..3.0).contains(&difference), "{difference}");
    assert!(folder.join("rotor.ipynb").is_file());
    for name in ["notebook-1.png", "notebook-2.png"] {
        assert_plot(&folder.join(name));
    }
}

#[test]
fn tilt_and_speed_act_on_the_forces_as_they_must() {
    let (_, folder) = run("complete-model");
    let rows = csv(&folder.join("complete-model.csv"));
    assert_eq!(rows.len(), 4 * 8);
    let sweeps: Vec<&[Row]> = rows.chunks(8).collect();
    let force = |row: &Row| value(row, "forward").hypot(value(row, "up"));
    for sweep in &sweeps {
        // In hover the force turns with the shaft; only the weight of the blades does not.
        let tilt = value(&sweep[0], "tilt").to_radians();
        assert!((force(&sweep[0]) / force(&sweeps[1][0]) - 1.0).abs() < 1e-3);
        let slope = value(&sweep[0], "forward") / value(&sweep[0], "up");
        assert!((slope - tilt.tan()).abs() < 1e-3, "{slope} {tilt}");
        // The faster, the more the tip path leans back.
        for pair in sweep.windows(2) {
            assert!(value(&pair[1], "a1") > value(&pair[0], "a1"), "{pair:?}");
        }
    }
    // Tilted forward the disc takes more air from above: less lift, more power, less flapping.
    for i in 2..8 {
        for pair in sweeps.windows(2) {
            let [back, forward] = [&pair[0][i], &pair[1][i]];
            assert!(
                value(forward, "up") < value(back, "up"),
                "{back:?} {forward:?}"
            );
            assert!(value(forward, "power") > value(back, "power"));
            assert!(value(forward, "a1") < value(back, "a1"));
        }
    }
    // Tilted back it is an autogiro: the air drives it.
    assert!(value(&sweeps[0][7], "power") < 0.0);
    flow_around_the_disc_is_that_of_textbooks(&csv(&folder.join("disc.csv")));
    for name in ["complete-model.png", "disc.png"] {
        assert_plot(&folder.join(name));
    }
}

/// The Mach number is that of rotation and flight; flow is reversed in a circle of diameter mu R,
/// and stalled on the retreating side only.
fn flow_around_the_disc_is_that_of_textbooks(points: &[Row]) {
    assert_eq!(points.len(), 120 * 20);
    let mu = 0.35 * 4.0_f64.to_radians().cos();
    let tip = 385.0 * PI / 30.0 * 5.4864 / 340.294;
    let mut stalled = 0;
    for point in points {
        let (azimuth, radius) = (value(point, "azimuth").to_radians(), value(point, "radius"));
        let along = radius + mu * azimuth.sin();
        let mach = value(point, "mach");
        if along > 0.4 {
            assert!((mach / (tip * along) - 1.0).abs() < 0.03, "{point:?}");
        }
        if along.abs() > 0.08 {
            assert_eq!(point["flow"] == "2", along < 0.0, "{point:?}");
        }
        if point["flow"] == "1" {
            stalled += 1;
            assert!(radius * azimuth.sin() < 0.1, "{point:?}");
        }
    }
    assert!((20..400).contains(&stalled), "{stalled}");
}
