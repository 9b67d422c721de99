//! Flights in FMI 2.0 and in FMI 3.0 give the same numbers to the last bit.

use crate::support::{
    Instance, Instance3, c,
    instance::{bits, reference},
    instance3::{Creation3, variables},
};
use helicopter_rotor::block::variables::{INTEGERS, REALS};

/// Inputs of forward flight with a driven, flapping rotor, by their names in FMI 2.0 and 3.0.
const INPUTS: [(&str, f64); 4] = [
    ("collective", 0.16),
    ("cyclicLongitudinal", 0.03),
    ("driveTorque", 4.0),
    ("tilt", 0.05),
];

fn choice(variable: &str, item: &str) -> i32 {
    let choices = INTEGERS[reference(&INTEGERS, variable) as usize].choices;
    choices.iter().position(|c| *c == item).unwrap() as i32 + 1
}

fn configure(two: &Instance, three: &Instance3) {
    for (name, item) in [
        ("models.inflow", "pittPetersDynamic"),
        ("drive.mode", "torque"),
    ] {
        assert_eq!(two.set_integer(name, choice(name, item)), c::OK);
        three.ok(three.choose(name, choice(name, item).into()));
    }
    assert_eq!(two.set_boolean("flapping.enabled", 1), c::OK);
    three.ok(three.set_boolean("flapping.enabled", 1));
    for (name, value) in INPUTS {
        assert_eq!(two.set_real(name, value), c::OK);
        three.set(name, value);
    }
    move_hub(two, three, 12.0);
}

fn move_hub(two: &Instance, three: &Instance3, speed: f64) {
    assert_eq!(two.set_real("velocity[1]", speed), c::OK);
    assert_eq!(two.set_real("velocity[3]", 0.5), c::OK);
    three.ok(three.set_floats(&["velocity"], &[speed, 0.0, 0.5]));
}

/// All Real variables of FMI 2.0, in the order in which FMI 3.0 has them.
fn all_of_fmi2(instance: &Instance) -> Vec<f64> {
    let values = instance.reals();
    let of_fmi3 = variables().values().filter(|v| v.kind == "Float64");
    let of_fmi3 = of_fmi3.filter(|v| v.name != "time");
    let elements = of_fmi3.flat_map(|v| {
        let begin = v.reference as usize;
        begin..begin + v.count
    });
    elements.map(|i| values[i]).collect()
}

#[test]
fn co_simulation_gives_the_same_bits_in_both_versions() {
    let (two, three) = (Instance::new(), Instance3::new());
    configure(&two, &three);
    two.initialize();
    three.initialize();
    let mut time = 0.0;
    for i in 0..40 {
        move_hub(&two, &three, 12.0 + 0.1 * f64::from(i));
        let size = [0.01, 0.003, 0.02][i as usize % 3];
        assert_eq!(two.step(time, size), c::OK);
        let stepped = three.step(time, size);
        time += size;
        assert_eq!((stepped.time, stepped.is_early), (time, false));
        assert_eq!(
            bits(&all_of_fmi2(&two)),
            bits(&three.all_floats()),
            "at {time} s"
        );
        assert_eq!(
            i64::from(two.integer("flowState")),
            three.choice("flowState")
        );
    }
    assert_eq!(three.float("time"), time);
}

/// Heun's method as the importer's.
#[test]
fn model_exchange_gives_the_same_bits_in_both_versions() {
    let (two, three) = (
        Instance::for_model_exchange(),
        Instance3::for_model_exchange(),
    );
    configure(&two, &three);
    two.begin_integration();
    three.initialize();
    three.update_discrete_states();
    three.enter_continuous_time();
    assert_eq!(
        two.nominals(),
        three.state_vector(three.functions.fmi3GetNominalsOfContinuousStates)
    );
    let size = 5e-4;
    for i in 0..60 {
        let time = f64::from(i) * size;
        assert_eq!(two.set_time(time), c::OK);
        // SAFETY: the instance lives.
        three.ok(unsafe { (three.functions.fmi3SetTime)(three.pointer, time) });
        let x = two.states();
        assert_eq!(bits(&x), bits(&three.states()));
        let first = two.derivatives();
        assert_eq!(bits(&first), bits(&three.derivatives()), "at {time} s");
        let euler: Vec<f64> = x.iter().zip(&first).map(|(x, f)| x + size * f).collect();
        assert_eq!(two.set_states(&euler), c::OK);
        three.ok(three.set_states(&euler));
        let second = two.derivatives();
        assert_eq!(bits(&second), bits(&three.derivatives()));
        let mean = first.iter().zip(&second).map(|(a, b)| 0.5 * (a + b));
        let next: Vec<f64> = x.iter().zip(mean).map(|(x, f)| x + size * f).collect();
        assert_eq!(two.set_states(&next), c::OK);
        three.ok(three.set_states(&next));
        assert_eq!(bits(&all_of_fmi2(&two)), bits(&three.all_floats()));
    }
    assert!(REALS.len() > three.states().len());
}

/// Event Mode at every communication point, as a careful importer has it, changes no number.
#[test]
fn event_mode_between_steps_changes_no_number() {
    let (two, three) = (
        Instance::new(),
        Creation3 {
            event_mode: true,
            ..Creation3::default()
        }
        .make()
        .unwrap(),
    );
    configure(&two, &three);
    two.initialize();
    three.initialize();
    three.update_discrete_states();
    three.enter_step_mode();
    for i in 0..10 {
        let time = 0.01 * f64::from(i);
        assert_eq!(two.step(time, 0.01), c::OK);
        three.step(time, 0.01);
        assert_eq!(
            bits(&all_of_fmi2(&two)),
            bits(&three.all_floats()),
            "at {time} s"
        );
        three.enter_event_mode();
        three.update_discrete_states();
        three.enter_step_mode();
    }
}
