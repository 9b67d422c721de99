//! The exact derivatives of the block, compared with differences of its values.

use crate::support::{
    block::{choose, default_block, enable_flapping, project, set, set_string},
    exact::{exact, inputs_and_states, known_scale, outputs_and_rates, unknown_scale},
};
use helicopter_rotor::block::{
    DerivativeError, RotorBlock,
    variables::{RealRef, integer, real, string},
};

/// Ways to hold the blades.
const BLADES: [&str; 3] = ["automatic", "disc", "flapping"];

/// The kind of difference. `Central` uses values on both sides. `OneSided` uses values on the side
/// to which the exact derivative points, in flights at a corner of the model: in axial flow the
/// edgewise speed is a magnitude, and descent begins.
#[derive(Clone, Copy, PartialEq)]
enum Difference {
    Central,
    OneSided,
}

struct Flight {
    name: &'static str,
    velocity: [f64; 3],
    difference: Difference,
    /// Step of the differences, as a fraction of the scale of a known.
    step: f64,
    /// Largest accepted error.
    bound: f64,
    settings: fn(&mut RotorBlock),
}

const FLIGHTS: [Flight; 6] = [
    Flight {
        name: "hover",
        velocity: [0.0, 0.0, 0.0],
        difference: Difference::OneSided,
        step: 1e-4,
        bound: 1e-7,
        settings: |_| {},
    },
    Flight {
        name: "climb, driven by a torque",
        velocity: [0.0, 0.0, 4.0],
        difference: Difference::OneSided,
        step: 1e-4,
        bound: 1e-7,
        settings: |block| {
            choose(block, integer::DRIVE__MODE, "torque");
            set(block, real::DRIVE_TORQUE, 3.0);
        },
    },
    Flight {
        name: "vertical descent",
        velocity: [0.0, 0.0, -5.0],
        difference: Difference::OneSided,
        // Some annuli pass the pieces of the law of descent, where its curvature jumps.
        step: 2e-5,
        bound: 1e-6,
        settings: |_| {},
    },
    Flight {
        name: "oblique descent by Johnson",
        velocity: [3.0, 1.0, -5.0],
        difference: Difference::Central,
        step: 3e-4,
        // Here the differences have errors of their own: the curvature of the curve jumps from
        // piece to piece, and for dynamic inflow the slope of the mass flow is itself a difference,
        // with its rounding.
        bound: 1e-6,
        settings: |block| choose(block, integer::MODELS__DESCENT, "johnson"),
    },
    Flight {
        name: "near the ground",
        velocity: [17.2, 3.0, 1.0],
        difference: Difference::Central,
        step: 2e-5,
        bound: 1e-7,
        settings: |block| {
            if block.values().integers[integer::MODELS__INFLOW] != 1 {
                choose(block, integer::MODELS__GROUND_EFFECT, "cheesemanBennett");
            }
            set(block, real::HEIGHT_ABOVE_GROUND, 1.9);
        },
    },
    Flight {
        name: "oblique descent of a clockwise rotor with cyclic and rates",
        velocity: [12.0, -2.0, -4.0],
        difference: Difference::Central,
        step: 3e-5,
        bound: 1e-7,
        settings: |block| {
            choose(block, integer::GEOMETRY__ROTATION, "clockwise");
            choose(block, integer::MODELS__TIP_LOSS, "prandtlTipAndRoot");
            for (reference, value) in [
                (real::CYCLIC_LATERAL, 0.03),
                (real::CYCLIC_LONGITUDINAL, 0.02),
                (real::TILT, 0.1),
                (real::ANGULAR_VELOCITY_1, 0.2),
                (real::ANGULAR_VELOCITY_2, 0.2),
            ] {
                set(block, reference, value);
            }
        },
    },
];

fn near_the_ground() -> &'static Flight {
    &FLIGHTS[4]
}

/// A block in a flight before its initialisation. Its section data have no corners.
fn smooth_block(inflow: &str, blades: &str, flight: &Flight) -> RotorBlock {
    let mut block = default_block();
    let file = project().join("tests/data/smooth.txt");
    let file = file.to_str().unwrap();
    set_string(&mut block, string::AIRFOIL__FILE, file);
    choose(&mut block, integer::MODELS__LIFT, "slopesByReynolds");
    into_flight(&mut block, inflow, blades, flight);
    block
}

fn into_flight(block: &mut RotorBlock, inflow: &str, blades: &str, flight: &Flight) {
    choose(block, integer::MODELS__INFLOW, inflow);
    if blades == "flapping" {
        enable_flapping(block);
        set(block, real::FLAPPING__HINGE_OFFSET, 0.05);
        set(block, real::FLAPPING__DELTA3, 0.2);
    } else {
        choose(block, integer::MODELS__BLADES, blades);
    }
    let references = [real::VELOCITY_1, real::VELOCITY_2, real::VELOCITY_3];
    for (reference, value) in references.into_iter().zip(flight.velocity) {
        set(block, reference, value);
    }
    set(block, real::COLLECTIVE, 0.15);
    (flight.settings)(block);
}

/// The block a few milliseconds after the start, with states that the importer may set.
fn under_way(mut block: RotorBlock) -> RotorBlock {
    block.start().unwrap();
    block.step(0.003).unwrap();
    block.begin_integration().unwrap();
    block
}

/// The derivatives of unknowns by one known, as differences of fourth order with steps of `part` of
/// the known's scale.
fn differences(
    block: &mut RotorBlock,
    unknowns: &[RealRef],
    known: RealRef,
    difference: Difference,
    part: f64,
) -> Vec<f64> {
    let (base, step) = (block.values().reals[known], part * known_scale(known));
    let mut at = |steps: f64| -> Vec<f64> {
        set(block, known, base + steps * step);
        block.update().unwrap();
        unknowns.iter().map(|u| block.values().reals[*u]).collect()
    };
    let weights: &[(f64, f64)] = match difference {
        Difference::Central => &[(-2.0, 1.0), (-1.0, -8.0), (1.0, 8.0), (2.0, -1.0)],
        Difference::OneSided => &[
            (0.0, -25.0),
            (1.0, 48.0),
            (2.0, -36.0),
            (3.0, 16.0),
            (4.0, -3.0),
        ],
    };
    let mut sums = vec![0.0; unknowns.len()];
    for (steps, weight) in weights {
        for (sum, value) in sums.iter_mut().zip(at(*steps)) {
            *sum += weight * value / (12.0 * step);
        }
    }
    at(0.0);
    sums
}

/// The largest error of an exact derivative, and a text that names it. Each derivative is
/// multiplied by the scale of its known, and the error is a fraction of the largest derivative of
/// the unknown.
fn worst(
    block: &mut RotorBlock,
    knowns: &[RealRef],
    difference: Difference,
    part: f64,
) -> (f64, String) {
    let unknowns = outputs_and_rates();
    let columns: Vec<_> = knowns
        .iter()
        .map(|known| {
            let exact = exact(block, &unknowns, *known);
            (
                exact,
                differences(block, &unknowns, *known, difference, part),
            )
        })
        .collect();
    let mut worst = (0.0, String::new());
    for (j, unknown) in unknowns.iter().enumerate() {
        // These change from one value to the next where an element stalls.
        if [real::STALLED_RADIUS, real::STALLED_FRACTION].contains(unknown) {
            assert!(columns.iter().all(|column| column.0[j] == 0.0));
            continue;
        }
        let sizes = columns.iter().zip(knowns);
        let sizes = sizes.map(|(column, known)| column.0[j].abs() * known_scale(*known));
        let scale = sizes.fold(unknown_scale(*unknown), f64::max);
        for ((exact, difference), known) in columns.iter().zip(knowns) {
            let (exact, difference) = (exact[j], difference[j]);
            let error = (exact - difference).abs() * known_scale(*known) / scale;
            if error > worst.0 {
                let (unknown, known) = (unknown.variable().name, known.variable().name);
                let text = format!("d {unknown}/d {known} = {exact:e}, differences {difference:e}");
                worst = (error, text);
            }
        }
    }
    worst
}

/// All inflow models with every way to hold the blades.
fn models() -> impl Iterator<Item = (&'static str, &'static str)> {
    let inflows = integer::MODELS__INFLOW.variable().choices.iter();
    let all = inflows.flat_map(|inflow| BLADES.map(|blades| (*inflow, blades)));
    all.filter(|case| *case != ("annulusClosedForm", "flapping"))
}

#[test]
fn derivatives_by_inputs_and_states_are_those_of_differences_in_all_models() {
    for (inflow, blades) in models() {
        for flight in &FLIGHTS {
            let mut block = under_way(smooth_block(inflow, blades, flight));
            let (error, which) = worst(
                &mut block,
                &inputs_and_states(),
                flight.difference,
                flight.step,
            );
            let case = format!("{inflow}, {blades}, {}", flight.name);
            assert!(error < flight.bound, "{case}: {error:.1e}, {which}");
        }
    }
}

#[test]
fn derivatives_by_tunable_parameters_are_those_of_differences() {
    let knowns: Vec<RealRef> = RealRef::all().filter(|r| r.variable().tunable).collect();
    assert_eq!(knowns.len(), 3, "spring, density, temperature");
    for (inflow, blades) in models() {
        let mut block = smooth_block(inflow, blades, &FLIGHTS[5]);
        choose(&mut block, integer::AIR__ATMOSPHERE, "userDefined");
        set(&mut block, real::FLAPPING__HINGE_SPRING, 5.0);
        block.start().unwrap();
        block.step(0.003).unwrap();
        let (error, which) = worst(&mut block, &knowns, Difference::Central, 1e-3);
        assert!(error < 1e-7, "{inflow}, {blades}: {error:.1e}, {which}");
    }
}

/// The tables of the default airfoil have corners everywhere, but few of them lie within a small
/// difference.
#[test]
fn derivatives_with_a_table_of_corners_are_those_of_small_differences() {
    for inflow in ["annulus", "uniform", "finiteBlades", "petersHe"] {
        for flight in &FLIGHTS {
            let mut block = default_block();
            into_flight(&mut block, inflow, "automatic", flight);
            let mut block = under_way(block);
            let (error, which) = worst(&mut block, &inputs_and_states(), flight.difference, 1e-6);
            let case = format!("{inflow}, {}", flight.name);
            assert!(error < 1e-3, "{case}: {error:.1e}, {which}");
        }
    }
}

/// Before initialisation the states are those at the start, which depend on the inputs.
#[test]
fn derivatives_at_the_start_are_those_of_differences() {
    let knowns = [
        real::COLLECTIVE,
        real::RPM,
        real::CYCLIC_LATERAL,
        real::VELOCITY_1,
        real::VELOCITY_3,
        real::ALTITUDE,
    ];
    for (inflow, blades) in [
        ("annulus", "automatic"),
        ("annulus", "flapping"),
        ("pittPetersDynamic", "disc"),
        ("pittPetersDynamic", "automatic"),
        ("pittPetersDynamic", "flapping"),
        ("petersHe", "disc"),
        ("petersHe", "flapping"),
    ] {
        for flight in [&FLIGHTS[0], near_the_ground()] {
            let mut block = smooth_block(inflow, blades, flight);
            set(&mut block, real::NUMERICS__AZIMUTH_STEP, 0.15);
            block.update().unwrap();
            let (error, which) = worst(&mut block, &knowns, flight.difference, 1e-4);
            let case = format!("{inflow}, {blades}, {}", flight.name);
            // The start has an error of 1e-10 of the tip speed, which the differences divide by
            // their small steps.
            assert!(error < 5e-5, "{case}: {error:.1e}, {which}");
        }
    }
}

#[test]
fn rates_of_outputs_are_their_changes_in_a_short_step() {
    let mut block = smooth_block("pittPetersDynamic", "flapping", near_the_ground());
    choose(&mut block, integer::INITIALIZATION, "rest");
    set(&mut block, real::NUMERICS__AZIMUTH_STEP, 0.001);
    block.start().unwrap();
    block.step(0.01).unwrap();
    let outputs = [real::THRUST, real::TORQUE, real::CONING, real::AZIMUTH];
    let rates: Vec<f64> = block.output_rates(&outputs).unwrap().collect();
    let step = 1e-7;
    let at_present = outputs.map(|o| block.values().reals[o]);
    block.step(step).unwrap();
    for ((output, rate), before) in outputs.into_iter().zip(rates).zip(at_present) {
        let difference = (block.values().reals[output] - before) / step;
        let name = output.variable().name;
        assert!(
            (rate / difference - 1.0).abs() < 1e-3,
            "{name}: {rate} {difference}"
        );
    }
}

/// The derivative along a direction is the sum over the knowns in it.
#[test]
fn derivatives_along_several_knowns_add_up() {
    let mut block = under_way(smooth_block("annulus", "automatic", near_the_ground()));
    let unknowns = outputs_and_rates();
    let knowns = [real::COLLECTIVE, real::VELOCITY_3, real::COLLECTIVE];
    let sum: Vec<f64> = block
        .directional_derivative(&unknowns, &knowns, &[0.5, 2.0, 0.25])
        .unwrap()
        .collect();
    let by_pitch = exact(&mut block, &unknowns, knowns[0]);
    let by_climb = exact(&mut block, &unknowns, knowns[1]);
    for (i, sum) in sum.iter().enumerate() {
        let expected = 0.75 * by_pitch[i] + 2.0 * by_climb[i];
        assert!((sum - expected).abs() <= 1e-10 * (1.0 + expected.abs()));
    }
}

#[test]
fn computing_derivatives_leaves_the_simulation_unchanged() {
    let run = |asks: bool| {
        let mut block = smooth_block("petersHe", "flapping", near_the_ground());
        block.start().unwrap();
        for _ in 0..3 {
            block.step(0.01).unwrap();
            if asks {
                exact(&mut block, &outputs_and_rates(), real::COLLECTIVE);
            }
        }
        block.values().reals.map(f64::to_bits)
    };
    assert_eq!(run(true), run(false));
}

#[test]
fn variables_without_derivatives_are_refused_by_name() {
    let mut block = under_way(smooth_block("annulus", "automatic", near_the_ground()));
    let mut ask = |unknown: RealRef, known: RealRef| {
        block
            .directional_derivative(&[unknown], &[known], &[1.0])
            .map(|_| ())
            .unwrap_err()
    };
    assert_eq!(
        ask(real::COLLECTIVE, real::RPM),
        DerivativeError::NotUnknown { name: "collective" }
    );
    assert_eq!(
        ask(real::THRUST, real::GEOMETRY__RADIUS),
        DerivativeError::NotKnown {
            name: "geometry.radius"
        }
    );
    assert_eq!(
        ask(real::THRUST, real::TORQUE),
        DerivativeError::NotKnown { name: "torque" }
    );
    let unknown = block
        .directional_derivative(&[real::THRUST], &[99_999_u32], &[1.0])
        .map(|_| ());
    assert!(matches!(unknown, Err(DerivativeError::Reference(_))));
}
