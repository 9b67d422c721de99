//! The FMU in an importer, FMPy: it validates, describes itself, simulates, and the examples that
//! a user copies run. Its thrust and torque are held against measurements here.

// The standard library's functions are independent of those under test.
#![allow(clippy::disallowed_methods)]

mod support;

use std::{
    collections::BTreeMap,
    path::{Path, PathBuf},
    process::Command,
};

/// The FMU, packaged once for this test program.
fn fmu() -> &'static Path {
    support::packaged_fmu()
}

/// The interpreter of the examples' environment, made if need be.
fn python() -> &'static Path {
    support::interpreter()
}

/// What a command prints; the test fails if the command does.
fn run(command: &mut Command) -> String {
    support::succeeded(&command.output().unwrap())
}

fn fmpy(arguments: &[&str]) -> String {
    run(Command::new(python())
        .args(["-m", "fmpy"])
        .args(arguments)
        .arg(fmu()))
}

fn example(script: &str) -> Command {
    let mut command = Command::new(python());
    let folder = support::sources().join("fmu-examples");
    command.arg(folder.join(script)).arg("--fmu").arg(fmu());
    command
}

fn scratch(name: &str) -> PathBuf {
    support::scratch().join(name)
}

/// The fields of a row by the names of the columns.
type Row = BTreeMap<String, String>;

/// The rows of a CSV file with a header.
fn csv(file: &Path) -> Vec<Row> {
    let mut table = csv::Reader::from_path(file).unwrap();
    table.deserialize().map(Result::unwrap).collect()
}

fn value(row: &Row, name: &str) -> f64 {
    let field = row.get(name).unwrap_or_else(|| panic!("no column {name}"));
    field.parse().unwrap()
}

#[test]
fn fmpy_finds_no_problem_and_describes_the_block() {
    assert_eq!(fmpy(&["validate"]).trim(), "No problems found.");
    let info = fmpy(&["info"]);
    for part in [
        "HelicopterRotor",
        "Co-Simulation",
        "Model Exchange",
        "linux64",
        "collective",
        "Blade pitch",
    ] {
        assert!(info.contains(part), "{part} is missing in\n{info}");
    }
}

#[test]
fn fmpy_simulates_with_defaults_to_a_steady_thrust() {
    let file = scratch("defaults.csv");
    fmpy(&[
        "simulate",
        "--interface-type",
        "CoSimulation",
        "--output-file",
        file.to_str().unwrap(),
    ]);
    let rows = csv(&file);
    assert!(rows.len() > 50, "{}", rows.len());
    let first = value(&rows[0], "thrust");
    assert!((50.0..80.0).contains(&first), "{first} N");
    for row in &rows {
        assert_eq!(value(row, "thrust"), first);
        assert_eq!(value(row, "force[3]"), first);
    }
}

#[test]
fn a_communication_step_that_does_not_divide_the_time_is_met() {
    let file = scratch("odd.csv");
    fmpy(&[
        "simulate",
        "--interface-type",
        "CoSimulation",
        "--stop-time",
        "0.5",
        "--output-interval",
        "0.0073",
        "--output-file",
        file.to_str().unwrap(),
    ]);
    let rows = csv(&file);
    assert!(value(rows.last().unwrap(), "time") > 0.49);
}

#[test]
fn fmpy_integrates_the_defaults_in_model_exchange() {
    let file = scratch("model-exchange.csv");
    fmpy(&[
        "simulate",
        "--interface-type",
        "ModelExchange",
        "--output-file",
        file.to_str().unwrap(),
    ]);
    let rows = csv(&file);
    let (first, last) = (&rows[0], rows.last().unwrap());
    assert_eq!(value(first, "thrust"), value(last, "thrust"));
    let turned = 960.0 / 60.0 * 2.0 * std::f64::consts::PI * value(last, "time");
    assert!((value(last, "azimuth") / turned - 1.0).abs() < 1e-3);
}

/// A manoeuvre with dynamic inflow, flapping blades and a torque that drives, along a ramp of nine
/// inputs.
#[test]
fn fmpy_flies_the_same_manoeuvre_through_both_interfaces_and_goes_back_to_a_state() {
    let script = "crates/program/tests/both_interfaces.py";
    let words = run(support::python(script).arg(fmu()));
    let numbers = |name: &str| -> Vec<f64> {
        let mut lines = words.lines().filter_map(|line| line.strip_prefix(name));
        let line = lines
            .next()
            .unwrap_or_else(|| panic!("no {name} in {words}"));
        line.split_whitespace()
            .map(|w| w.parse().unwrap())
            .collect()
    };
    // Thrust, rotor speed, coning, azimuth, and the collective at the end.
    let [integrated, held, moving, short] =
        ["ModelExchange", "held", "moving", "shortSteps"].map(numbers);
    for (i, part) in [(1, 1e-5), (2, 1e-4), (3, 1e-5)] {
        let [exchange, held] = [integrated[i], held[i]];
        assert!(
            (exchange / held - 1.0).abs() < part,
            "{i}: {exchange} {held}"
        );
    }
    // FMPy gives no derivatives at the time 0, so that the first of the 40 steps is held.
    for i in 0..4 {
        let lag = (held[i] - short[i]).abs();
        assert!(
            (moving[i] - short[i]).abs() < 0.05 * lag,
            "{i}: {moving:?} {held:?} {short:?}"
        );
    }
    assert!((moving[4] - 0.2).abs() < 1e-12, "{}", moving[4]);
    let [first, second] = numbers("state")[..] else {
        panic!("{words}")
    };
    assert_eq!(first, second);
    assert!(first > 50.0);
}

/// The largest errors by setting, as the example writes them.
fn errors_of(rows: &[Row], manoeuvre: &str, interface: &str) -> Vec<(f64, f64)> {
    let chosen = rows
        .iter()
        .filter(|row| row["manoeuvre"] == manoeuvre && row["interface"] == interface);
    chosen
        .map(|row| (value(row, "setting"), value(row, "error")))
        .collect()
}

/// Slope of the line through the points in logarithms (least squares).
fn order(points: &[(f64, f64)]) -> f64 {
    let points = points.iter().map(|(x, y)| (x.ln(), y.ln()));
    let n = points.len() as f64;
    let (x, y) = points
        .clone()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0, y + p.1));
    let (x, y) = (x / n, y / n);
    let (above, below) = points.fold((0.0, 0.0), |(a, b), p| {
        (a + (p.0 - x) * (p.1 - y), b + (p.0 - x) * (p.0 - x))
    });
    above / below
}

/// Model Exchange comes to what Co-Simulation has with its shortest steps, as the solver's
/// tolerance shrinks. A solver of order p that keeps the error of each step at the tolerance takes
/// steps as tolerance^(1/(p + 1)), so that the error of all of them goes with tolerance^(p/(p +
/// 1)): powers of 0.5 to 0.83 for CVode's backward differences of orders 1 to 5, with some leeway
/// for orders that rise as the tolerance shrinks. Heun's third-order method in Co-Simulation has
/// the power 3.
#[test]
fn both_interfaces_converge_to_the_same_flights() {
    let folder = scratch("solver-accuracy");
    println!(
        "{}",
        run(example("solver_accuracy.py").arg("--out").arg(&folder))
    );
    let rows = csv(&folder.join("solver-accuracy.csv"));
    for (manoeuvre, at_default_step) in [
        ("hover", 1e-7),
        ("forward-flight", 2e-4),
        ("run-down", 1e-8),
    ] {
        let exchange = errors_of(&rows, manoeuvre, "ModelExchange");
        assert_eq!(exchange.len(), 7);
        for pair in exchange.windows(2) {
            assert!(pair[1].1 < 1.2 * pair[0].1, "{manoeuvre}: {pair:?}");
        }
        let (tolerance, error) = exchange[4];
        assert!((tolerance / 1e-7 - 1.0).abs() < 1e-9);
        assert!(error < 3e-5, "{manoeuvre}: {error}");
        let power = order(&exchange);
        assert!((0.5..1.0).contains(&power), "{manoeuvre}: {power}");

        let simulation = errors_of(&rows, manoeuvre, "CoSimulation");
        assert_eq!(simulation.len(), 5);
        let power = order(&simulation);
        assert!((2.8..3.5).contains(&power), "{manoeuvre}: {power}");
        let (step, error) = simulation[2];
        assert_eq!(step, 3.0);
        assert!(error < at_default_step, "{manoeuvre}: {error}");
    }
    let picture = folder.join("solver-accuracy.png");
    assert!(picture.metadata().unwrap().len() > 10_000);
}

/// Exact derivatives make Newton's method converge quadratically, and the linear model what the FMU
/// does in small steps.
#[test]
fn a_hover_is_trimmed_and_made_linear_by_exact_derivatives() {
    let folder = scratch("hover-trim");
    let words = run(example("hover_trim.py").arg("--out").arg(&folder));
    println!("{words}");
    let numbers = |title: &str| -> Vec<f64> {
        let mut lines = words.lines().skip_while(|line| !line.starts_with(title));
        let line = lines.nth(1).unwrap_or_else(|| panic!("no {title}"));
        line.split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect()
    };
    for title in ["Trim in the wind", "Rigid blades in still air"] {
        let residuals = numbers(title);
        assert!((3..=6).contains(&residuals.len()), "{title}: {residuals:?}");
        assert!(residuals[0] > 0.01 && *residuals.last().unwrap() < 1e-6);
        for pair in residuals.windows(2) {
            assert!(pair[1] < 2.0 * pair[0] * pair[0], "{title}: {residuals:?}");
        }
    }
    // Inflow over rigid blades, by the theory of Pitt & Peters with the blades as dampers.
    let title = "Eigenvalues of their inflow";
    let row = |label: &str| {
        let mut lines = words.lines().skip_while(|line| !line.starts_with(title));
        let line = lines.find(|line| line.trim_start().starts_with(label));
        let found: Vec<f64> = line
            .unwrap()
            .split_whitespace()
            .filter_map(|word| word.parse().ok())
            .collect();
        found
    };
    let (model, theory) = (row("linear model"), row("theory"));
    assert_eq!(model.len(), 3);
    for (found, expected) in model.iter().zip(&theory) {
        assert!(
            (found / expected - 1.0).abs() < 0.005,
            "{model:?} {theory:?}"
        );
    }
    // Flapping and inflow die away. Differential flapping gives no load to the inflow: its
    // frequency is that of a blade in vacuum on its hinge, sqrt(1 + 1.5 e/(1 - e)) per turn
    // (Johnson 1980), e = 0.05.
    let modes = words
        .lines()
        .filter_map(|line| line.trim_start().strip_prefix("eigenvalue"));
    let modes: Vec<(f64, f64)> = modes
        .map(|line| {
            let words: Vec<&str> = line.split_whitespace().collect();
            (
                words[0].parse().unwrap(),
                words.last().unwrap().parse().unwrap(),
            )
        })
        .collect();
    assert!(modes.len() >= 6 && modes.iter().all(|(damping, _)| *damping < -5.0));
    let expected = (1.0_f64 + 1.5 * 0.05 / 0.95).sqrt();
    assert!(
        modes
            .iter()
            .any(|(_, n)| (n / expected - 1.0).abs() < 0.005),
        "{modes:?}"
    );

    // Half a degree of collective is small: the linear model is within some per cent of the change.
    let rows = csv(&folder.join("step-response.csv"));
    for (output, bound) in [
        ("force[3]", 0.03),
        ("coning", 0.03),
        ("hubMoment[1]", 0.1),
        ("hubMoment[2]", 0.1),
    ] {
        let column = |kind: &str| -> Vec<f64> {
            rows.iter()
                .map(|row| value(row, &format!("{kind}:{output}")))
                .collect()
        };
        let (step, held, linear) = (column("step"), column("held"), column("linear"));
        let changes: Vec<f64> = step.iter().zip(&held).map(|(s, h)| s - h).collect();
        let largest = changes.iter().fold(0.0_f64, |most, c| most.max(c.abs()));
        for (change, linear_value) in changes.iter().zip(&linear) {
            let off = change - (linear_value - linear[0]);
            assert!(off.abs() < bound * largest, "{output}: {off} of {largest}");
        }
        assert_eq!(changes[0], 0.0);
    }
    // At once as much thrust as the pitch makes, half as much when inflow and flapping have
    // followed.
    let change = |i: usize| value(&rows[i], "step:force[3]") - value(&rows[i], "held:force[3]");
    assert!(change(51) > 8.0 && (5.0..6.5).contains(&change(350)));
    assert!(folder.join("step-response.png").metadata().unwrap().len() > 10_000);
    assert!(folder.join("hover-trim.npz").is_file());
}

/// The bounds that the model is held to, against Knight & Hefner (1937), NACA TN 626, at 4 deg of
/// pitch and above, where the thrust is large enough for differences in per cent.
#[test]
fn thrust_and_torque_of_knight_and_hefners_rotors() {
    let folder = scratch("knight-hefner");
    println!(
        "{}",
        run(example("knight_hefner.py").arg("--out").arg(&folder))
    );
    let rows = csv(&folder.join("knight-hefner.csv"));
    assert_eq!(rows.len(), 20);
    let compared: Vec<_> = rows
        .iter()
        .filter(|row| value(row, "theta") >= 4.0)
        .collect();
    assert_eq!(compared.len(), 14);
    for (column, measured, bound) in [("dCT", "CT", 4.0), ("dCQ", "CQ", 5.0)] {
        let differences = compared.iter().map(|row| {
            let difference = value(row, column);
            let computed = value(row, &format!("{measured}_fmu"));
            let again = 100.0 * (computed / value(row, measured) - 1.0);
            assert!(
                (difference - again).abs() < 1e-9,
                "the column {column} is what it says"
            );
            difference.abs()
        });
        let (sum, worst) = differences.fold((0.0, 0.0_f64), |(s, w), d| (s + d, w.max(d)));
        let mean = sum / compared.len() as f64;
        println!("mean |{column}| {mean:.2} %, worst {worst:.2} %");
        assert!(
            mean <= bound,
            "mean |{column}| is {mean:.2} %, above {bound} %"
        );
        assert!(worst <= 12.0, "the worst {column} is {worst:.2} %");
    }
    assert!(folder.join("knight-hefner.png").metadata().unwrap().len() > 10_000);
}

#[test]
fn the_ramp_of_collective_raises_the_thrust_step_by_step() {
    let text = run(&mut example("collective_ramp.py"));
    let thrust: Vec<f64> = text
        .lines()
        .skip(1)
        .map(|line| line.split_whitespace().last().unwrap().parse().unwrap())
        .collect();
    assert_eq!(thrust.len(), 20);
    assert!(
        thrust.windows(2).all(|pair| pair[1] > pair[0]),
        "{thrust:?}"
    );
    assert!(
        (100.0..140.0).contains(thrust.last().unwrap()),
        "{thrust:?}"
    );
}

/// Known of every helicopter: the power needed in level flight falls from hover to a minimum at a
/// middling speed and rises again; the tip path leans back more the faster it flies, and early to
/// the advancing side where the inflow grows towards the rear.
#[test]
fn level_flight_has_the_bucket_of_power_and_the_flapping_of_textbooks() {
    let folder = scratch("forward-flight");
    run(example("forward_flight.py").arg("--out").arg(&folder));
    let rows = csv(&folder.join("forward-flight.csv"));
    let flown = |model: &str| {
        let chosen = rows.iter().filter(|row| row["model"] == model);
        chosen.cloned().collect::<Vec<Row>>()
    };
    for model in ["uniform", "pittPetersDynamic", "petersHe"] {
        let rows = flown(model);
        assert_eq!(rows.len(), 10, "{model}");
        for row in &rows {
            let (sin, cos) = value(row, "tilt").to_radians().sin_cos();
            let (thrust, aft) = (value(row, "thrust"), value(row, "H"));
            let weight = thrust * cos + aft * sin;
            assert!((weight - 60.0).abs() < 0.1, "{model}: {weight} N");
            // The default rotor's tip speed, m/s.
            let speed = value(row, "mu") * 76.605;
            let pull = (thrust * sin - aft * cos) * speed;
            let needed = value(row, "parasite_power");
            assert!(
                (pull - needed).abs() < 0.1 * speed + 1e-9,
                "{model}: {pull} W"
            );
        }
        for pair in rows.windows(2) {
            let falls = value(&pair[1], "power") < value(&pair[0], "power");
            assert_eq!(falls, value(&pair[1], "mu") < 0.16, "{model}: {pair:?}");
            assert!(
                value(&pair[1], "a1") > value(&pair[0], "a1"),
                "{model}: {pair:?}"
            );
        }
        let least = value(&rows[5], "power") / value(&rows[0], "power");
        assert!((0.5..0.75).contains(&least), "{model}: {least}");
    }
    let slow = |model| value(&flown(model)[3], "b1");
    assert!(slow("pittPetersDynamic") > 3.0 * slow("uniform"));
    assert!(slow("petersHe") > 3.0 * slow("uniform"));

    // Over the disc: small angles on the advancing side, large ones on the retreating side, and
    // flow from behind within the circle of diameter mu R there.
    let points = csv(&folder.join("angle-of-attack.csv"));
    assert_eq!(points.len(), 120 * 20);
    let tilt = value(&flown("pittPetersDynamic")[9], "tilt").to_radians();
    let along = 0.35 * tilt.cos();
    for point in points {
        let (azimuth, radius) = (value(&point, "azimuth"), value(&point, "radius"));
        let angle = value(&point, "angle_of_attack");
        let inside = -along * azimuth.to_radians().sin() - radius;
        if inside.abs() > 0.03 {
            assert_eq!(angle.abs() > 90.0, inside > 0.0, "{point:?}");
        }
        if radius > 0.75 && (azimuth - 90.0).abs() < 30.0 {
            assert!((0.0..3.5).contains(&angle), "{point:?}");
        }
        if radius > 0.75 && (azimuth - 270.0).abs() < 30.0 {
            assert!((7.0..12.0).contains(&angle), "{point:?}");
        }
    }
    for name in ["forward-flight.png", "angle-of-attack.png"] {
        assert!(folder.join(name).metadata().unwrap().len() > 10_000);
    }
}

/// Known of every helicopter: without its engine the rotor slows down until the collective is
/// lowered, and then turns by the air that comes from below; straight down that is at 1.7 to 1.9
/// v_h (Leishman 2006), a little more where the blades' own drag counts much; and the energy in the
/// rotor is worth a soft landing.
#[test]
fn a_helicopter_lands_softly_without_its_engine() {
    let folder = scratch("engine-off");
    let words = run(example("engine_off.py").arg("--out").arg(&folder));
    // FMPy prints what the FMU logs, with its status in brackets.
    assert!(!words.contains('['), "{words}");
    let rows = csv(&folder.join("engine-off.csv"));
    let between = |from: f64, to: f64| {
        let chosen = rows
            .iter()
            .filter(move |row| (from..to).contains(&value(row, "time")));
        chosen.collect::<Vec<_>>()
    };
    let hover = value(&rows[0], "rpm");
    let weight = value(&rows[0], "thrust");
    // Steady up to the failure at 3 s: governor, weight and inflow are in balance from the start.
    for row in between(0.0, 3.0) {
        assert!((value(row, "rpm") / hover - 1.0).abs() < 1e-4, "{row:?}");
        assert!(value(row, "sink_rate").abs() < 1e-3, "{row:?}");
        assert_eq!(row["flow_state"], "normal");
    }
    // With no torque, the pitch as it was and the rotor's inertia, the speed falls at once as Q/I.
    let cut = between(3.0, 3.2);
    let torque = value(cut[0], "rotor_torque");
    let lost = hover - value(cut[10], "rpm");
    let duration = value(cut[10], "time") - value(cut[0], "time");
    let inertia = 2.0 * 1.225 * 2.0 * std::f64::consts::PI * 0.28 * 5.6_f64.powi(4) / 5.0;
    let expected = torque / inertia * duration * 30.0 / std::f64::consts::PI;
    assert!((lost / expected - 1.0).abs() < 0.05, "{lost} {expected}");
    let slowest = between(3.0, 10.0)
        .iter()
        .map(|row| value(row, "rpm"))
        .fold(f64::INFINITY, f64::min);
    assert!((0.8..0.9).contains(&(slowest / hover)), "{slowest}");

    let steady = between(18.0, 22.0);
    let hover_inflow = 6.9836; // m/s, of 1200 kg on a radius of 5.6 m at 1.225 kg/m3
    for row in &steady {
        let sink = value(row, "sink_rate");
        assert!((1.75..1.95).contains(&(sink / hover_inflow)), "{row:?}");
        assert!((value(row, "rpm") / hover - 1.0).abs() < 0.01, "{row:?}");
        assert!(
            (value(row, "thrust") / weight - 1.0).abs() < 0.01,
            "{row:?}"
        );
        assert!(value(row, "rotor_torque").abs() < 0.02 * torque, "{row:?}");
        assert_eq!(value(row, "drive_torque"), 0.0);
        assert!((1.0..5.0).contains(&value(row, "collective")), "{row:?}");
    }
    let mut states: Vec<&str> = rows.iter().map(|row| row["flow_state"].as_str()).collect();
    states.dedup();
    // Through the vortex ring into faster descent than is steady, back, and to rest.
    let (normal, ring, wake) = ("normal", "vortexRing", "turbulentWake");
    let expected = [normal, ring, wake, "windmillBrake", wake, ring, normal];
    assert_eq!(states, expected);

    let last = rows.last().unwrap();
    assert_eq!(value(last, "height"), 3.0);
    let touch = value(last, "sink_rate");
    assert!((0.0..3.0).contains(&touch), "{touch} m/s");
    // Paid for by the rotor.
    assert!(value(last, "rpm") < 0.85 * hover);
    assert!(folder.join("engine-off.png").metadata().unwrap().len() > 10_000);
}
