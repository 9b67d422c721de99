//! The inflow of Pitt & Peters with its three states, averaged over one revolution: its steady
//! state, how it settles there, and that the answer does not depend on the communication step.

use crate::support::block::{choice, default_block, get, project, set, set_integer, set_string};
use helicopter_rotor::block::{
    BlockError, RotorBlock,
    variables::{integer, real, string},
};

const DISC: i32 = 2;
const STEADY: i32 = 1;
const REST: i32 = 2;

fn block(model: &str, initialization: i32) -> RotorBlock {
    let mut block = default_block();
    let references = [
        integer::MODELS__INFLOW,
        integer::MODELS__BLADES,
        integer::INITIALIZATION,
    ];
    block
        .set_integers(
            &references,
            &[choice(integer::MODELS__INFLOW, model), DISC, initialization],
        )
        .unwrap();
    block
}

#[test]
fn a_steady_start_stays_steady() {
    for (speed, climb) in [(0.0, 0.0), (0.0, 3.0), (15.0, 0.0), (25.0, -1.0)] {
        let mut block = block("pittPetersDynamic", STEADY);
        set(&mut block, real::VELOCITY_1, speed);
        set(&mut block, real::VELOCITY_3, climb);
        block.start().unwrap();
        let start = get(&block, real::THRUST);
        for _ in 0..20 {
            block.step(0.01).unwrap();
            let thrust = get(&block, real::THRUST);
            assert!(
                (thrust / start - 1.0).abs() < 1e-9,
                "{speed} {climb}: {start} {thrust}"
            );
        }
    }
}

/// In hover the inflow has no gradient, and the steady state of the dynamic model is the static
/// model.
#[test]
fn in_hover_the_steady_state_is_that_of_the_static_model() {
    let thrust = |model| {
        let mut block = block(model, STEADY);
        block.start().unwrap();
        get(&block, real::THRUST)
    };
    let (dynamic, uniform) = (thrust("pittPetersDynamic"), thrust("uniform"));
    assert!(
        (dynamic / uniform - 1.0).abs() < 1e-9,
        "{dynamic} {uniform}"
    );
}

/// After a start with air at rest the blades have no inflow at first, and more thrust than in the
/// steady state. The thrust settles within a few time constants of R 8/(3 pi)/(4 v0) = 40 ms.
#[test]
fn from_rest_the_thrust_falls_to_the_steady_one() {
    let mut steady = block("pittPetersDynamic", STEADY);
    steady.start().unwrap();
    let end = get(&steady, real::THRUST);
    let mut block = block("pittPetersDynamic", REST);
    block.start().unwrap();
    let mut previous = get(&block, real::THRUST);
    assert!(previous > 1.5 * end, "{previous} {end}");
    for _ in 0..60 {
        block.step(0.01).unwrap();
        let thrust = get(&block, real::THRUST);
        assert!(thrust <= previous, "{previous} {thrust}");
        previous = thrust;
    }
    assert!((previous / end - 1.0).abs() < 1e-6, "{previous} {end}");
}

/// Loads in the transient after a jump of collective in forward flight.
fn after_a_jump(steps: &[f64], azimuth_step: f64) -> [f64; 3] {
    let block = block("pittPetersDynamic", STEADY);
    loads_after_a_jump(block, steps, azimuth_step)
}

fn loads_after_a_jump(mut block: RotorBlock, steps: &[f64], azimuth_step: f64) -> [f64; 3] {
    set(&mut block, real::NUMERICS__AZIMUTH_STEP, azimuth_step);
    set(&mut block, real::VELOCITY_1, 10.0);
    set(&mut block, real::COLLECTIVE, 0.05);
    block.start().unwrap();
    set(&mut block, real::COLLECTIVE, 0.15);
    for step in steps {
        block.step(*step).unwrap();
    }
    [real::THRUST, real::HUB_MOMENT_1, real::HUB_MOMENT_2].map(|reference| get(&block, reference))
}

/// Communication points between the internal steps are read off the cubic between these, whose
/// error is far below that of the steps.
#[test]
fn the_communication_step_does_not_change_the_answer() {
    let three_degrees = 3.0_f64.to_radians();
    let once = after_a_jump(&[0.0219], three_degrees);
    let fine = after_a_jump(&[0.0219], 0.1 * three_degrees);
    let errors = once.iter().zip(fine).map(|(a, b)| (a - b).abs());
    let error = errors.fold(0.0, f64::max);
    for steps in [vec![0.0073; 3], vec![0.001; 22], vec![0.0002; 110]] {
        let mut steps = steps;
        let rest = 0.0219 - steps.iter().sum::<f64>();
        if rest.abs() > 1e-12 {
            // The last step takes the remainder, as in importers.
            let last = steps.len() - 1;
            steps[last] += rest;
        }
        let cut = after_a_jump(&steps, three_degrees);
        for (a, b) in once.iter().zip(cut) {
            assert!((a - b).abs() < 1e-3 * error, "{error:e}: {once:?} {cut:?}");
        }
    }
}

/// With section data that have no corners, at which any method loses its order.
#[test]
fn the_integrator_is_of_third_order() {
    let smooth = |azimuth_step: f64, time: f64| {
        let mut block = block("pittPetersDynamic", STEADY);
        let file = project().join("tests/data/smooth.txt");
        set_string(&mut block, string::AIRFOIL__FILE, file.to_str().unwrap());
        loads_after_a_jump(block, &[time], azimuth_step.to_radians())[0]
    };
    // Five times 24 deg at 960 rev/min, a multiple of all azimuth steps.
    let time = 24.0 / 360.0 / 16.0 * 5.0;
    let error = {
        let reference = smooth(0.5, time);
        move |degrees: f64| (smooth(degrees, time) - reference).abs()
    };
    let (coarse, fine) = (error(8.0), error(4.0));
    let order = (coarse / fine).log2();
    assert!(
        (2.7..3.3).contains(&order),
        "order {order}: {coarse:e} {fine:e}"
    );
}

#[test]
fn every_flight_is_finite_or_one_clear_error() {
    let (mut flown, mut refused) = (0, 0);
    for initialization in [STEADY, REST] {
        for rpm in [0.0, 480.0, 1440.0] {
            for edgewise in [0.0, 4.0, 40.0] {
                for climb in [-12.0, -4.0, 0.0, 12.0] {
                    for degrees in [-20.0_f64, 0.0, 8.0, 25.0, 40.0] {
                        let mut block = block("pittPetersDynamic", initialization);
                        set_integer(&mut block, integer::NUMERICS__ELEMENTS, 8);
                        set(&mut block, real::RPM, rpm);
                        set(&mut block, real::VELOCITY_1, edgewise);
                        set(&mut block, real::VELOCITY_3, climb);
                        set(&mut block, real::COLLECTIVE, degrees.to_radians());
                        // Outputs that are not finite are an error of another kind.
                        match block.start().and_then(|()| block.step(0.1)) {
                            Ok(()) => flown += 1,
                            Err(BlockError::Unsolved(e, _)) => {
                                println!("{initialization} {rpm} {edgewise} {climb} {degrees} {e}");
                                refused += 1
                            }
                            Err(error) => panic!("{error}"),
                        }
                    }
                }
            }
        }
    }
    println!("{flown} flown, {refused} refused");
    assert!(refused * 20 < flown, "{flown} flown, {refused} refused");
}

/// Flight in another direction is forward flight with all loads turned by that direction.
#[test]
fn the_transient_turns_with_the_direction_of_flight() {
    let fly = |direction: f64| {
        let mut block = block("pittPetersDynamic", REST);
        set(&mut block, real::VELOCITY_1, 12.0 * direction.cos());
        set(&mut block, real::VELOCITY_2, 12.0 * direction.sin());
        block.start().unwrap();
        block.step(0.03).unwrap();
        let [x, y] = [real::HUB_FORCE_1, real::HUB_FORCE_2].map(|reference| get(&block, reference));
        let [l, m] =
            [real::HUB_MOMENT_1, real::HUB_MOMENT_2].map(|reference| get(&block, reference));
        let turned = |x: f64, y: f64| {
            (
                x * direction.cos() + y * direction.sin(),
                y * direction.cos() - x * direction.sin(),
            )
        };
        (turned(x, y), turned(l, m), get(&block, real::THRUST))
    };
    let (forward, other) = (fly(0.0), fly(2.1));
    for (a, b) in [
        (forward.0.0, other.0.0),
        (forward.0.1, other.0.1),
        (forward.1.0, other.1.0),
        (forward.1.1, other.1.1),
        (forward.2, other.2),
    ] {
        assert!((a - b).abs() < 1e-11 * forward.2, "{forward:?} {other:?}");
    }
}

/// The inflow states belong to the hub frame and not to the wind axes. So the induced velocities
/// keep their places when a faint wind reverses its direction.
#[test]
fn wind_that_reverses_leaves_the_induced_velocities_unchanged() {
    let mut block = block("pittPetersDynamic", STEADY);
    set(&mut block, real::CYCLIC_LATERAL, 0.05);
    set(&mut block, real::VELOCITY_1, 1e-6);
    block.start().unwrap();
    let moments = |b: &RotorBlock| [real::HUB_MOMENT_1, real::HUB_MOMENT_2].map(|p| get(b, p));
    let before = moments(&block);
    assert!(
        before[1].abs() > 1.0,
        "the cyclic pitch makes a moment, and with it gradients of inflow: {before:?}"
    );
    set(&mut block, real::VELOCITY_1, -1e-6);
    block.update().unwrap();
    for (a, b) in before.iter().zip(moments(&block)) {
        assert!((a - b).abs() < 1e-5, "{before:?} {:?}", moments(&block));
    }
}

/// The induced velocity of a stopped rotor decays, in steps of any length.
#[test]
fn a_stopped_rotor_can_take_long_steps() {
    let mut block = block("pittPetersDynamic", STEADY);
    block.start().unwrap();
    set(&mut block, real::RPM, 0.0);
    for duration in [1.0, 100.0, 1e6] {
        block.step(duration).unwrap();
    }
    assert!(get(&block, real::INDUCED_VELOCITY).abs() < 0.01);
}
