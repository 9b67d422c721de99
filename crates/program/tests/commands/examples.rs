//! `examples`: the systems that contain the rotor, run as a user runs them, and their numbers.

use crate::{
    support::{self, scratch, succeed},
    tables::{Row, assert_plot, csv, value},
};
use std::{f64::consts::PI, path::PathBuf};

/// Runs an example by its name, and returns its output and the folder of its files.
fn run(name: &str) -> (String, PathBuf) {
    let out = scratch().join(format!("examples-{name}"));
    let mut command = support::program();
    command.args(["examples", name, "--out"]).arg(&out);
    let text = succeed(command.arg("--library").arg(support::library()));
    println!("{text}");
    (text, out.join(name))
}

#[test]
fn an_example_that_does_not_exist_is_refused_with_the_names_of_those_that_do() {
    let message = support::fail(support::program().args(["examples", "climbing-disk"]));
    for part in ["climbing-disk", "climbing-disc", "forward-flight"] {
        assert!(message.contains(part), "{message}");
    }
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
