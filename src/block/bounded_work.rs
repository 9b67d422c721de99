//! Tests of what steps and starts cost, counted in computations of the loads of a blade section,
//! and of what the bound on it costs in accuracy.

use super::{
    BlockError, Note, RotorBlock,
    flight_condition::FlightCondition,
    variables::{
        BooleanRef, DriveMode, InflowModel, IntegerRef, RealRef, TipLossModel, boolean, integer,
        real,
    },
};
use rotor::{Start, Workspace};

const RESOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");

type Failure = Box<dyn std::error::Error>;

/// Sections in one evaluation of the default rotor with individual blades.
const EVALUATION: u64 = 4 * 40;

#[derive(Default)]
struct Case {
    reals: &'static [(RealRef, f64)],
    integers: &'static [(IntegerRef, i32)],
    is_rigid: bool,
}

/// In forward flight with dynamic inflow, unless the case says otherwise.
fn block(case: &Case) -> Result<RotorBlock, Failure> {
    let mut block = RotorBlock::new(RESOURCES.into());
    let inflow = InflowModel::PittPetersDynamic as i32;
    block.set_integers(&[integer::MODELS__INFLOW], &[inflow])?;
    let enabled: [BooleanRef; 1] = [boolean::FLAPPING__ENABLED];
    block.set_booleans(&enabled, &[(!case.is_rigid).into()])?;
    block.set_reals(&[real::VELOCITY_1], &[10.0])?;
    for (reference, value) in case.reals {
        block.set_reals(&[*reference], &[*value])?;
    }
    for (reference, value) in case.integers {
        block.set_integers(&[*reference], &[*value])?;
    }
    Ok(block)
}

/// The work of `count` equal steps in all of `duration`, and the block afterwards.
fn work(case: &Case, duration: f64, count: u32) -> Result<(u64, RotorBlock), Failure> {
    let mut block = block(case)?;
    block.start()?;
    let mut done = 0;
    for _ in 0..count {
        block.step(duration / f64::from(count))?;
        done += block.workspace.work.done();
    }
    Ok((done, block))
}

const SLOW_AND_STIFF: Case = Case {
    reals: &[(real::RPM, 20.0), (real::FLAPPING__HINGE_SPRING, 1e6)],
    integers: &[],
    is_rigid: false,
};
const SLOW: Case = Case {
    reals: &[(real::RPM, 20.0)],
    integers: &[],
    is_rigid: false,
};
const STIFF: Case = Case {
    reals: &[(real::FLAPPING__HINGE_SPRING, 1e4)],
    integers: &[],
    is_rigid: false,
};
const USUAL: Case = Case {
    reals: &[],
    integers: &[],
    is_rigid: false,
};

/// A short step costs the evaluation that its outputs need. All other work depends on the whole
/// time, to within the step that is ahead at its end.
#[test]
fn the_cost_of_a_time_does_not_depend_on_how_it_is_cut() -> Result<(), Failure> {
    for (name, case, duration, most_in_step) in [
        ("slow and stiff", SLOW_AND_STIFF, 0.02, 100),
        ("slow", SLOW, 0.02, 100),
        ("stiff", STIFF, 0.02, 100),
        ("usual", USUAL, 0.02, 100),
        ("usual, long", USUAL, 0.5, 1000),
    ] {
        let (whole, _) = work(&case, duration, 1)?;
        for count in [2, 3, 50, most_in_step] {
            let (cut, _) = work(&case, duration, count)?;
            let outputs = u64::from(count) * EVALUATION;
            // The step at the end of the first cut, the step ahead, and the rates at its ends.
            let ends = 12 * EVALUATION;
            let bound = whole + outputs + ends;
            assert!(cut <= bound, "{name}, {count}: {cut}, in one: {whole}");
        }
    }
    Ok(())
}

/// With constant inputs 1 ms steps cost three evaluations for each step of the method and one for
/// the outputs of each.
#[test]
fn with_constant_inputs_nothing_is_computed_twice() -> Result<(), Failure> {
    let (done, block) = work(&USUAL, 0.5, 500)?;
    let azimuth = block.memory.state.azimuth;
    let steps = (azimuth / block.values().reals[real::NUMERICS__AZIMUTH_STEP]) as u64 + 1;
    let needed = EVALUATION * (3 * steps + 500);
    assert!(done <= needed + 6 * EVALUATION, "{done}, needed {needed}");
    Ok(())
}

/// The states between two points of the grid come from the cubic between them.
#[test]
fn what_is_read_between_steps_is_as_accurate_as_the_steps() -> Result<(), Failure> {
    let fine = Case {
        reals: &[(real::NUMERICS__AZIMUTH_STEP, 0.002)],
        ..USUAL
    };
    let duration = 0.0313;
    let flapping = |block: &RotorBlock| block.memory.state.flaps;
    // From rest, so that everything moves.
    let fly = |case: &Case, count: u32| -> Result<_, Failure> {
        let mut block = block(case)?;
        block.set_integers(&[integer::INITIALIZATION], &[2])?;
        block.start()?;
        for _ in 0..count {
            block.step(duration / f64::from(count))?;
        }
        Ok(flapping(&block))
    };
    let exact = fly(&fine, 1)?;
    let error = |flaps: [rotor::disc::Flap; 8]| {
        let each = flaps.iter().zip(&exact);
        each.map(|(a, b)| (a.angle - b.angle).abs())
            .fold(0.0, f64::max)
    };
    let by_step = error(fly(&USUAL, 1)?);
    for count in [3, 20, 31, 313] {
        let read = error(fly(&USUAL, count)?);
        assert!(read <= 1.5 * by_step, "{count}: {read:e}, {by_step:e}");
    }
    Ok(())
}

/// The exponential method against the plain one with far shorter steps.
#[test]
fn stiff_blades_move_as_with_short_plain_steps() -> Result<(), Failure> {
    for (spring, inertia) in [(2e7, 0.05), (5e8, 0.05), (0.0, 1e-4), (1e6, 1e-4)] {
        let fly = |azimuth_step: f64, count: u32| -> Result<RotorBlock, Failure> {
            let mut block = block(&USUAL)?;
            let references = [
                real::FLAPPING__HINGE_SPRING,
                real::FLAPPING__INERTIA,
                real::NUMERICS__AZIMUTH_STEP,
            ];
            block.set_reals(&references, &[spring, inertia, azimuth_step])?;
            block.set_integers(&[integer::NUMERICS__BUDGET], &[i32::MAX])?;
            block.start()?;
            // Out of the periodic motion.
            block.set_reals(&[real::CYCLIC_LATERAL], &[0.05])?;
            for _ in 0..count {
                block.step(0.02 / f64::from(count))?;
            }
            Ok(block)
        };
        let stiff = fly(0.0523, 1)?;
        let point = FlightCondition::new(stiff.values())?.point;
        let rotor = stiff.rotor.as_ref().ok_or("no rotor")?;
        let cell = 0.0523 / point.speed;
        let division = |cell| rotor.division(&point, &stiff.memory.state, cell);
        assert!(division(cell).is_stiff(), "spring {spring}");
        assert!(!division(cell / 52.3).is_stiff(), "spring {spring}");
        let plain = fly(0.001, 1)?;
        // Also where communication points lie within the steps.
        for count in [1, 7, 53] {
            let stiff = fly(0.0523, count)?;
            let flaps = |block: &RotorBlock| block.memory.state.flaps;
            for (a, b) in flaps(&stiff).iter().zip(&flaps(&plain)).take(4) {
                let off = (a.angle - b.angle).abs();
                assert!(off < 2e-5, "{spring}, {inertia}, {count}: {off:e}");
            }
            let thrust = |block: &RotorBlock| block.values().reals[real::THRUST];
            let off = (thrust(&stiff) / thrust(&plain) - 1.0).abs();
            assert!(off < 1e-3, "{spring}, {inertia}, {count}: {off:e}");
        }
    }
    Ok(())
}

/// A rotor with blades of a tenth of a gram on stiff springs, the stiffest that there is.
#[test]
fn the_stiffest_blades_cost_little_more_than_others() -> Result<(), Failure> {
    let stiffest = Case {
        reals: &[
            (real::FLAPPING__HINGE_SPRING, 1e6),
            (real::FLAPPING__INERTIA, 1e-7),
        ],
        ..USUAL
    };
    let (usual, _) = work(&USUAL, 0.01, 1)?;
    let (done, _) = work(&stiffest, 0.01, 1)?;
    assert!(done <= 4 * usual, "{done}, usual {usual}");
    Ok(())
}

/// What took up to 25 s for a step of 10 ms, and other absurd rotors.
#[test]
fn a_step_or_a_start_never_takes_more_than_its_budget() -> Result<(), Failure> {
    const TORQUE: (IntegerRef, i32) = (integer::DRIVE__MODE, DriveMode::Torque as i32);
    const UNIFORM: (IntegerRef, i32) = (integer::MODELS__INFLOW, InflowModel::Uniform as i32);
    const BY_THRUST: (IntegerRef, i32) = (
        integer::MODELS__TIP_LOSS,
        TipLossModel::PrandtlThrust as i32,
    );
    let budget = 200_000;
    for (name, case) in [
        (
            "light blades",
            Case {
                reals: &[(real::FLAPPING__INERTIA, 1e-6)],
                ..USUAL
            },
        ),
        (
            "light blades on a stopped rotor",
            Case {
                reals: &[(real::FLAPPING__INERTIA, 1e-6), (real::RPM, 0.0)],
                ..USUAL
            },
        ),
        (
            "light blades, slow",
            Case {
                reals: &[(real::FLAPPING__INERTIA, 1e-5), (real::RPM, 1.0)],
                integers: &[UNIFORM],
                is_rigid: false,
            },
        ),
        (
            "a light rotor under a torque",
            Case {
                reals: &[
                    (real::DRIVE__INERTIA, 1e-6),
                    (real::FLAPPING__HINGE_SPRING, 1e6),
                ],
                integers: &[TORQUE],
                is_rigid: false,
            },
        ),
        (
            "many elements and blades",
            Case {
                integers: &[
                    (integer::NUMERICS__ELEMENTS, 2000),
                    (integer::GEOMETRY__NUMBER_OF_BLADES, 8),
                    UNIFORM,
                ],
                ..USUAL
            },
        ),
        (
            "an end of the lift that depends on the thrust",
            Case {
                integers: &[UNIFORM, BY_THRUST],
                ..USUAL
            },
        ),
        ("a usual rotor for a long time", USUAL),
    ] {
        let mut block = block(&case)?;
        block.set_integers(&[integer::NUMERICS__BUDGET], &[budget])?;
        let elements = block.values().integers[integer::NUMERICS__ELEMENTS];
        let blades = block.values().integers[integer::GEOMETRY__NUMBER_OF_BLADES];
        // The bound is passed by one computation of the whole rotor at most, with its iterations.
        let most = budget as u64 + 100 * (elements * blades) as u64;
        let point = FlightCondition::new(block.values())?.point;
        let rotor = block.rotor()?;
        let mut workspace = Workspace::new(&rotor);
        workspace.work = block.budget();
        let started = rotor.start(&point, Start::Steady, 0.05, &mut workspace);
        assert!(started.is_ok(), "{name}");
        let done = workspace.work.done();
        assert!(done <= most, "{name}: a start of {done}");
        block.start()?;
        block.stage = super::Stage::Running;
        let before = (block.memory, block.values().reals);
        let error = block.step(10.0).err().ok_or(name)?;
        let done = block.workspace.work.done();
        assert!(done <= most, "{name}: a step of {done}");
        assert_eq!((block.memory, block.values().reals), before, "{name}");
        let text = error.to_string();
        if let BlockError::TooMuchWork(_) = error {
            for part in ["numerics.budget = 200000", "shorter steps", "elements"] {
                assert!(text.contains(part), "{name}: {text}");
            }
        } else {
            assert!(text.contains("faster than steps"), "{name}: {text}");
        }
    }
    Ok(())
}

#[test]
fn a_hopeless_step_is_refused_at_once() -> Result<(), Failure> {
    let mut block = block(&USUAL)?;
    block.start()?;
    let error = block.step(1e4).err().ok_or("10^4 s of forward flight")?;
    assert!(matches!(error, BlockError::TooMuchWork(_)), "{error}");
    assert_eq!(block.workspace.work.done(), 0);
    // Also in the course of a flight with the same inputs.
    block.step(0.01)?;
    let error = block.step(1e4).err().ok_or("10^4 s more")?;
    assert!(matches!(error, BlockError::TooMuchWork(_)), "{error}");
    assert_eq!(block.workspace.work.done(), 0);
    // One that settles is not hopeless.
    block.set_reals(&[real::VELOCITY_1], &[0.0])?;
    block.step(1e4)?;
    Ok(())
}

/// A rotor at rest in still air that nothing drives does not move: its steps are known, and cost
/// nothing.
#[test]
fn steps_without_work_are_bounded_too() -> Result<(), Failure> {
    let mut block = block(&Case {
        reals: &[(real::RPM, 0.0), (real::VELOCITY_1, 0.0)],
        integers: &[(integer::DRIVE__MODE, DriveMode::Torque as i32)],
        is_rigid: true,
    })?;
    block.set_integers(&[integer::NUMERICS__BUDGET], &[1000])?;
    block.start()?;
    let error = block.step(1e9).err().ok_or("10^9 s")?;
    assert!(matches!(error, BlockError::TooMuchWork(_)), "{error}");
    Ok(())
}

/// A rotor that runs up from its droop stops takes short steps only at first.
#[test]
fn a_run_up_from_the_stops_is_not_hopeless() -> Result<(), Failure> {
    let mut block = block(&Case {
        reals: &[
            (real::RPM, 0.0),
            (real::VELOCITY_1, 0.0),
            (real::DRIVE_TORQUE, 20.0),
        ],
        integers: &[(integer::DRIVE__MODE, DriveMode::Torque as i32)],
        is_rigid: false,
    })?;
    block.start()?;
    block.step(2.0)?;
    assert!(block.values().reals[real::ROTOR_SPEED] > 100.0);
    Ok(())
}

#[test]
fn a_start_beyond_its_budget_is_a_warning() -> Result<(), Failure> {
    let mut block = block(&USUAL)?;
    block.set_integers(&[integer::NUMERICS__BUDGET], &[2000])?;
    block.start()?;
    let is_warning = |note: &Note| matches!(note, Note::Warning(text) if text.contains("numerics.budget = 2000"));
    assert!(block.take_notes().iter().any(is_warning));
    assert!(block.values().reals[real::THRUST] > 0.0);
    Ok(())
}
