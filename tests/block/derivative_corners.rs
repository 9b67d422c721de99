//! The exact derivatives of the block at corners of the models, against one-sided differences to
//! both sides: random flights with all models, in which many values lie exactly at a corner.

use crate::support::{
    block::{
        choice, choose, default_block, enable_flapping, get, project, set, set_integer, set_string,
    },
    exact::{exact_along, inputs_and_states, known_scale, outputs_and_rates, unknown_scale},
};
use helicopter_rotor::block::{
    RotorBlock,
    variables::{RealRef, integer, real, string},
};

/// Random numbers that are the same in each run (Marsaglia 2003, "Xorshift RNGs").
struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 >> 11
    }

    fn below(&mut self, count: usize) -> usize {
        (self.next() % count as u64) as usize
    }

    fn one_in(&mut self, count: usize) -> bool {
        self.below(count) == 0
    }

    fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * (self.next() as f64 / (1u64 << 53) as f64)
    }
}

/// A block in a random flight, before its initialisation.
fn random_block(random: &mut Random) -> RotorBlock {
    let mut block = default_block();
    set_integer(&mut block, integer::NUMERICS__ELEMENTS, 12);
    for reference in [
        integer::MODELS__INFLOW,
        integer::MODELS__DESCENT,
        integer::MODELS__TIP_LOSS,
        integer::MODELS__BLADES,
        integer::MODELS__COMPRESSIBILITY,
        integer::MODELS__GROUND_EFFECT,
        integer::DRIVE__MODE,
        integer::GEOMETRY__ROTATION,
        integer::INITIALIZATION,
        integer::AIR__ATMOSPHERE,
    ] {
        let choices = reference.variable().choices;
        choose(&mut block, reference, choices[random.below(choices.len())]);
    }
    let is_closed_form = integer::MODELS__INFLOW.variable().choices[0] == "annulusClosedForm"
        && block.values().integers[integer::MODELS__INFLOW] == 1;
    if is_closed_form {
        choose(&mut block, integer::MODELS__GROUND_EFFECT, "none");
    }
    let (blades, order) = (1 + random.below(8) as i32, 1 + random.below(6) as i32);
    let references = [
        integer::GEOMETRY__NUMBER_OF_BLADES,
        integer::NUMERICS__INFLOW_ORDER,
    ];
    block.set_integers(&references, &[blades, order]).unwrap();
    if !is_closed_form && random.one_in(3) {
        enable_flapping(&mut block);
        choose(&mut block, integer::MODELS__BLADES, "automatic");
        set(&mut block, real::FLAPPING__HINGE_OFFSET, 0.05);
        set(&mut block, real::FLAPPING__DELTA3, 0.2);
        set(&mut block, real::FLAPPING__HINGE_SPRING, 5.0);
    } else if blades == 1 {
        // `automatic` changes from the azimuth average to the blade itself. For a rotor with one
        // blade that is a jump, which has no derivative.
        choose(&mut block, integer::MODELS__BLADES, "individual");
    }
    match random.below(4) {
        0 => {
            let file = project().join("tests/data/smooth.txt");
            let file = file.to_str().unwrap();
            set_string(&mut block, string::AIRFOIL__FILE, file);
            choose(&mut block, integer::MODELS__LIFT, "slopesByReynolds");
        }
        1 => choose(&mut block, integer::MODELS__LIFT, "twoPi"),
        _ => {}
    }
    random_flight(&mut block, random);
    block
}

fn random_flight(block: &mut RotorBlock, random: &mut Random) {
    let is_unloaded = random.one_in(4);
    if is_unloaded {
        // Before the first step there is no inflow, so that the whole blade lies exactly at a knot
        // of the section's tables.
        set(block, real::COLLECTIVE, 0.0);
        choose(block, integer::INITIALIZATION, "rest");
        if block.values().integers[integer::MODELS__TIP_LOSS]
            == choice(integer::MODELS__TIP_LOSS, "prandtlThrust")
        {
            // The end of the lift depends on the square root of the thrust, whose slope is infinite
            // at thrust 0.
            choose(block, integer::MODELS__TIP_LOSS, "prandtl");
        }
    } else if random.one_in(2) {
        set(block, real::COLLECTIVE, random.between(-0.1, 0.3));
    }
    set(block, real::RPM, random.between(300.0, 1200.0));
    for reference in [real::VELOCITY_1, real::VELOCITY_2, real::VELOCITY_3] {
        if random.one_in(3) {
            set(block, reference, random.between(-8.0, 12.0));
        }
    }
    for (reference, size) in [
        (real::TILT, 0.3),
        (real::CYCLIC_LATERAL, 0.05),
        (real::ANGULAR_VELOCITY_2, 0.5),
    ] {
        if !is_unloaded && random.one_in(3) {
            set(block, reference, random.between(-size, size));
        }
    }
    let radius = get(block, real::GEOMETRY__RADIUS);
    // The heights at which ground effect ends, begins to fade, and is held constant.
    let heights = [3.0, 2.0, 0.5, 0.0, random.between(0.5, 3.0)];
    let height = heights[random.below(heights.len())] * radius;
    set(block, real::HEIGHT_ABOVE_GROUND, height);
    set(block, real::DRIVE_TORQUE, random.between(-3.0, 3.0));
}

/// The outputs and rates that have a one-sided derivative everywhere except at thrust 0.
fn unknowns() -> Vec<RealRef> {
    let steps = [real::STALLED_RADIUS, real::STALLED_FRACTION];
    let mut all = outputs_and_rates();
    all.retain(|reference| !steps.contains(reference) && *reference != real::FIGURE_OF_MERIT);
    all
}

/// The largest error of the exact derivatives along one known to one side, and a text that names
/// the unknown. The error of each is that against the best of several differences, of first and
/// second order and with several steps, as a fraction of the change of the unknown.
fn worst(block: &mut RotorBlock, known: RealRef, side: f64) -> (f64, String) {
    let unknowns = unknowns();
    let exact = exact_along(block, &unknowns, known, side);
    let (base, scale) = (get(block, known), known_scale(known));
    let mut errors = vec![f64::INFINITY; unknowns.len()];
    let mut closest = errors.clone();
    for part in [1e-3, 1e-4, 1e-5, 1e-6, 1e-7] {
        let step = part * scale;
        let mut at = |steps: f64| -> Vec<f64> {
            set(block, known, base + side * steps * step);
            block.update().unwrap();
            unknowns.iter().map(|u| get(block, *u)).collect()
        };
        let (one, two, unmoved) = (at(1.0), at(2.0), at(0.0));
        for (j, unknown) in unknowns.iter().enumerate() {
            let change = (exact[j].abs() * scale).max(0.1 * unmoved[j].abs());
            let change = change.max(100.0 * unknown_scale(*unknown).min(0.1));
            for difference in [
                (one[j] - unmoved[j]) / step,
                (4.0 * one[j] - 3.0 * unmoved[j] - two[j]) / (2.0 * step),
            ] {
                let error = (exact[j] - difference).abs() * scale / change;
                if error < errors[j] {
                    (errors[j], closest[j]) = (error, difference);
                }
            }
        }
    }
    let mut worst = (0.0, String::new());
    for (j, unknown) in unknowns.iter().enumerate() {
        if errors[j] > worst.0 {
            let (unknown, known) = (unknown.variable().name, known.variable().name);
            let (exact, closest) = (exact[j], closest[j]);
            let text =
                format!("d {unknown}/d {known} to {side}: {exact:e}, difference {closest:e}");
            worst = (errors[j], text);
        }
    }
    worst
}

#[test]
fn derivatives_to_either_side_of_corners_are_those_of_differences() {
    let mut compared = 0;
    for seed in 1..=300 {
        let mut random = Random(0x9E37_79B9_7F4A_7C15_u64.wrapping_mul(seed));
        let mut block = random_block(&mut random);
        let is_unloaded = get(&block, real::COLLECTIVE) == 0.0;
        block.start().unwrap();
        if !is_unloaded && random.one_in(2) {
            block.step(0.003).unwrap();
        }
        block.begin_integration().unwrap();
        let knowns = inputs_and_states();
        for _ in 0..6 {
            let known = knowns[random.below(knowns.len())];
            for side in [1.0, -1.0] {
                if side < 0.0 && get(&block, known) <= known.variable().min {
                    continue;
                }
                let (error, which) = worst(&mut block, known, side);
                assert!(error < 1e-4, "flight {seed}: {error:.1e}, {which}");
                compared += 1;
            }
        }
    }
    assert!(compared > 3000, "{compared}");
}

fn to_both_sides(block: &mut RotorBlock, known: RealRef) {
    for side in [1.0, -1.0] {
        let (error, which) = worst(block, known, side);
        assert!(error < 1e-4, "{error:.1e}, {which}");
    }
}

/// Corners of formulae at values that random numbers do not hit.
#[test]
fn derivatives_at_known_corners() {
    // The tropopause lies at 11 km of geopotential altitude. Find a double that is mapped to it.
    const EARTH_RADIUS: f64 = 6_356_766.0;
    let geopotential = |altitude: f64| altitude * EARTH_RADIUS / (altitude + EARTH_RADIUS);
    let mut altitude = 11_000.0 * EARTH_RADIUS / (EARTH_RADIUS - 11_000.0) - 1e-9;
    while geopotential(altitude) < 11_000.0 {
        altitude = altitude.next_up();
    }
    assert_eq!(geopotential(altitude), 11_000.0);
    let mut block = default_block();
    set(&mut block, real::ALTITUDE, altitude);
    block.start().unwrap();
    to_both_sides(&mut block, real::ALTITUDE);

    // At zero lift in climb and descent the closed form is mirrored, and its lift slope is that at
    // the Mach number.
    for climb in [0.0, 2.0, -2.0] {
        let mut block = default_block();
        choose(&mut block, integer::MODELS__INFLOW, "annulusClosedForm");
        choose(&mut block, integer::MODELS__LIFT, "twoPi");
        set(&mut block, real::RPM, 2500.0);
        set(&mut block, real::COLLECTIVE, 0.0);
        set(&mut block, real::VELOCITY_3, climb);
        block.start().unwrap();
        to_both_sides(&mut block, real::COLLECTIVE);
    }

    // A stopped rotor in edgewise wind: on half of it the air comes from behind, at exactly 180
    // deg.
    let mut block = default_block();
    choose(&mut block, integer::MODELS__INFLOW, "uniform");
    set(&mut block, real::COLLECTIVE, 0.0);
    set(&mut block, real::RPM, 0.0);
    set(&mut block, real::VELOCITY_1, 10.0);
    block.start().unwrap();
    to_both_sides(&mut block, real::VELOCITY_3);
    to_both_sides(&mut block, real::COLLECTIVE);

    // A section in still air has flow as soon as the rotor begins to turn.
    let mut block = default_block();
    set(&mut block, real::RPM, 0.0);
    block.start().unwrap();
    let mach = exact_along(&mut block, &[real::STATION_20__MACH], real::RPM, 1.0)[0];
    set(&mut block, real::RPM, 1e-3);
    block.update().unwrap();
    let difference = get(&block, real::STATION_20__MACH) / 1e-3;
    assert!(
        mach > 0.0 && (mach / difference - 1.0).abs() < 0.01,
        "{mach} {difference}"
    );
}

/// For a model without inflow states, values of these states do not break the symmetry of the disc.
#[test]
fn states_that_the_model_does_not_use_have_no_effect() {
    let mut block = default_block();
    set_integer(&mut block, integer::GEOMETRY__NUMBER_OF_BLADES, 1);
    block.start().unwrap();
    block.begin_integration().unwrap();
    let outputs = |block: &RotorBlock| {
        unknowns()
            .iter()
            .map(|u| get(block, *u))
            .collect::<Vec<_>>()
    };
    let before = outputs(&block);
    for reference in RealRef::all().filter(|r| r.variable().name.starts_with("state.inflow")) {
        assert!(reference.is_state());
        set(&mut block, reference, 1.0);
    }
    block.update().unwrap();
    assert_eq!(outputs(&block), before);
}

/// A block that restores the snapshot of another before its initialisation also gets its rotor.
#[test]
fn derivatives_are_those_of_the_restored_rotor() {
    let configured = |radius: f64| {
        let mut block = default_block();
        set(&mut block, real::GEOMETRY__RADIUS, radius);
        block.update().unwrap();
        let derivative = exact_along(&mut block, &[real::THRUST], real::COLLECTIVE, 1.0);
        (block, derivative)
    };
    let (large, expected) = configured(2.0);
    let (mut small, other) = configured(0.762);
    assert_ne!(expected, other);
    small.restore(&large.snapshot()).unwrap();
    let derivative = exact_along(&mut small, &[real::THRUST], real::COLLECTIVE, 1.0);
    assert_eq!(derivative, expected);
}

/// A blade exactly at a stop, blades at depths where the damper has a part of its strength and all
/// of it, and one that leaves the stop so fast that the stop lets go.
#[test]
fn derivatives_at_the_stops_of_flapping_blades() {
    for (lowest, highest) in [(-0.5, 0.25), (-0.25, 0.5)] {
        let mut block = default_block();
        enable_flapping(&mut block);
        set_integer(&mut block, integer::NUMERICS__ELEMENTS, 12);
        set(&mut block, real::FLAPPING__LOWEST_ANGLE, lowest);
        set(&mut block, real::FLAPPING__HIGHEST_ANGLE, highest);
        set(&mut block, real::FLAPPING__HINGE_OFFSET, 0.05);
        set(&mut block, real::VELOCITY_1, 10.0);
        block.start().unwrap();
        block.begin_integration().unwrap();
        let stop = if highest < -lowest { highest } else { lowest };
        for (depth, rate) in [
            (0.0, 2.0),
            (0.0, -2.0),
            (0.005, 1.0),
            (0.03, 2.0),
            (0.005, -9.0),
        ] {
            let (angle, rate) = (stop + depth * stop.signum(), rate * stop.signum());
            set(&mut block, real::STATE__FLAP_ANGLE_1, angle);
            set(&mut block, real::STATE__FLAP_RATE_1, rate);
            block.update().unwrap();
            for known in [
                real::STATE__FLAP_ANGLE_1,
                real::STATE__FLAP_RATE_1,
                real::RPM,
            ] {
                to_both_sides(&mut block, known);
            }
        }
    }
}

/// The steady start of a stopped rotor is the balance of its blades, in which the air has a part.
#[test]
fn derivatives_of_the_balance_of_blades_that_do_not_turn() {
    let unknowns = [
        real::CONING,
        real::LONGITUDINAL_FLAPPING,
        real::LATERAL_FLAPPING,
    ];
    for (spring, wind) in [(0.0, 0.0), (2.0, 0.0), (5.0, 3.0)] {
        let mut block = default_block();
        enable_flapping(&mut block);
        set_integer(&mut block, integer::NUMERICS__ELEMENTS, 12);
        for (reference, value) in [
            (real::RPM, 0.0),
            (real::FLAPPING__HINGE_SPRING, spring),
            (real::TILT, 0.2),
            (real::WIND_3, wind),
        ] {
            set(&mut block, reference, value);
        }
        for (known, step) in [(real::TILT, 1e-5), (real::FLAPPING__HINGE_SPRING, 1e-4)] {
            block.update().unwrap();
            let exact = exact_along(&mut block, &unknowns, known, 1.0);
            let base = get(&block, known);
            let mut at = |value: f64| {
                set(&mut block, known, value);
                block.update().unwrap();
                unknowns.map(|u| get(&block, u))
            };
            let (one, two, unmoved) = (at(base + step), at(base + 2.0 * step), at(base));
            for (k, exact) in exact.iter().enumerate() {
                let difference = (4.0 * one[k] - 3.0 * unmoved[k] - two[k]) / (2.0 * step);
                let error = (exact - difference).abs();
                let what = known.variable().name;
                assert!(
                    error < 1e-6 + 1e-4 * exact.abs(),
                    "spring {spring}, wind {wind}, {what}: {exact} {difference}"
                );
            }
        }
    }
}
