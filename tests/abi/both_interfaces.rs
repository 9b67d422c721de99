//! The two interfaces are one rotor: what an importer integrates in Model Exchange approaches what
//! Co-Simulation computes.

use crate::support::{Instance, c, instance::reference};
use helicopter_rotor::block::variables::{INTEGERS, STATES};

/// Forward flight with dynamic inflow, three flapping blades and a torque that drives.
fn configure(instance: &Instance) {
    let choices = INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices;
    let inflow = choices
        .iter()
        .position(|c| *c == "pittPetersDynamic")
        .unwrap() as i32
        + 1;
    for (name, value) in [
        ("models.inflow", inflow),
        ("drive.mode", 2),
        ("geometry.numberOfBlades", 3),
        // A flat plate: no kinks of a table between its points, where methods lose their order.
        ("models.lift", 2),
        ("numerics.elements", 12),
    ] {
        assert_eq!(instance.set_integer(name, value), c::OK);
    }
    assert_eq!(instance.set_boolean("flapping.enabled", 1), c::OK);
    for (name, value) in [
        ("velocity[1]", 15.0),
        ("tilt", 0.06),
        ("driveTorque", 6.0),
        ("drive.inertia", 0.5),
        ("flapping.hingeOffset", 0.04),
        // Both find their start, which is of the steps in flight, with this one.
        ("numerics.azimuthStep", AZIMUTH_STEP),
    ] {
        assert_eq!(instance.set_real(name, value), c::OK);
    }
}

/// rad
const AZIMUTH_STEP: f64 = 0.002;

/// s; some two thirds of a turn.
const DURATION: f64 = 0.04;

/// The step of the control in the middle of the flight, where all integrations end a step.
const COLLECTIVE: f64 = 0.2;

fn co_simulation() -> Vec<f64> {
    let instance = Instance::new();
    configure(&instance);
    instance.initialize();
    assert_eq!(instance.step(0.0, DURATION / 2.0), c::OK);
    assert_eq!(instance.set_real("collective", COLLECTIVE), c::OK);
    assert_eq!(instance.step(DURATION / 2.0, DURATION / 2.0), c::OK);
    let reals = instance.reals();
    let states = STATES.iter().map(|row| reals[row.value.number() as usize]);
    states
        .chain([instance.real("thrust"), instance.real("hubMoment[1]")])
        .collect()
}

/// An explicit Runge-Kutta method.
struct Method {
    name: &'static str,
    /// Fractions of the step at which the stages are, each reached by the rates of the stage
    /// before.
    stages: &'static [f64],
    weights: &'static [f64],
    order: f64,
    /// Numbers of steps, each twice the one before, with errors well above those of Co-Simulation.
    steps: [u32; 3],
}

const METHODS: [Method; 2] = [
    Method {
        name: "Heun, order 2",
        stages: &[0.0, 1.0],
        weights: &[0.5, 0.5],
        order: 2.0,
        steps: [128, 256, 512],
    },
    Method {
        name: "Kutta, order 4",
        stages: &[0.0, 0.5, 0.5, 1.0],
        weights: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
        order: 4.0,
        steps: [16, 32, 64],
    },
];

fn plus(x: &[f64], factor: f64, rates: &[f64]) -> Vec<f64> {
    x.iter()
        .zip(rates)
        .map(|(x, rate)| x + factor * rate)
        .collect()
}

fn model_exchange(method: &Method, steps: u32) -> Vec<f64> {
    let instance = Instance::for_model_exchange();
    configure(&instance);
    instance.begin_integration();
    let size = DURATION / f64::from(steps);
    for i in 0..steps {
        let begin = f64::from(i) * size;
        if i == steps / 2 {
            assert_eq!(instance.set_real("collective", COLLECTIVE), c::OK);
        }
        let start = instance.states();
        let mut end = start.clone();
        let mut rates = vec![0.0; start.len()];
        for (stage, weight) in method.stages.iter().zip(method.weights) {
            assert_eq!(instance.set_time(begin + stage * size), c::OK);
            assert_eq!(
                instance.set_states(&plus(&start, stage * size, &rates)),
                c::OK
            );
            rates = instance.derivatives();
            end = plus(&end, weight * size, &rates);
        }
        assert_eq!(instance.set_time(begin + size), c::OK);
        assert_eq!(instance.set_states(&end), c::OK);
        if instance.completed_step() {
            assert_eq!(instance.enter_event_mode(), c::OK);
            instance.new_discrete_states();
            assert_eq!(instance.enter_continuous_time(), c::OK);
        }
    }
    let loads = [instance.real("thrust"), instance.real("hubMoment[1]")];
    instance.states().into_iter().chain(loads).collect()
}

/// Largest difference in the orders of magnitude of the states, and of 100 N and 10 N.m.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let scales = STATES.iter().map(|row| row.nominal).chain([100.0, 10.0]);
    let differences = a
        .iter()
        .zip(b)
        .zip(scales)
        .map(|((a, b), s)| (a - b).abs() / s);
    differences.fold(0.0, f64::max)
}

#[test]
fn model_exchange_approaches_co_simulation_by_the_order_of_the_importers_method() {
    let expected = co_simulation();
    for method in &METHODS {
        let errors = method
            .steps
            .map(|steps| distance(&model_exchange(method, steps), &expected));
        let order = libm::log2(errors[0] / errors[2]) / 2.0;
        println!("{}: {errors:?}, order {order:.2}", method.name);
        assert!(
            (order - method.order).abs() < 0.4,
            "{}: {errors:?}, order {order}",
            method.name
        );
    }
}

/// A long flight with every inflow model: the same rotor, to the error of the methods.
#[test]
fn every_inflow_model_is_the_same_rotor_in_both_interfaces() {
    let choices = INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices;
    for (i, inflow) in choices.iter().enumerate() {
        let prepare = |instance: &Instance| {
            configure(instance);
            assert_eq!(instance.set_integer("models.inflow", i as i32 + 1), c::OK);
            let flaps = i32::from(*inflow != "annulusClosedForm");
            assert_eq!(instance.set_boolean("flapping.enabled", flaps), c::OK);
            assert_eq!(instance.set_real("numerics.azimuthStep", 0.02), c::OK);
            assert_eq!(instance.set_integer("initialization", 2), c::OK);
        };
        let co_simulation = Instance::new();
        prepare(&co_simulation);
        co_simulation.initialize();
        let model_exchange = Instance::for_model_exchange();
        prepare(&model_exchange);
        model_exchange.begin_integration();
        let steps = 80;
        let size = 0.02 / f64::from(steps);
        for i in 0..steps {
            let x = model_exchange.states();
            let first = model_exchange.derivatives();
            assert_eq!(model_exchange.set_states(&plus(&x, size, &first)), c::OK);
            let last = model_exchange.derivatives();
            let half = plus(&x, 0.5 * size, &first);
            assert_eq!(
                model_exchange.set_states(&plus(&half, 0.5 * size, &last)),
                c::OK
            );
            model_exchange.completed_step();
            assert_eq!(co_simulation.step(f64::from(i) * size, size), c::OK);
        }
        let reals = co_simulation.reals();
        let expected: Vec<f64> = STATES
            .iter()
            .map(|row| reals[row.value.number() as usize])
            .collect();
        let error = distance(&model_exchange.states(), &expected);
        println!("{inflow}: {error:.1e}");
        assert!(error < 2e-4, "{inflow}: {error}");
        for name in [
            "thrust",
            "torque",
            "hubMoment[2]",
            "coning",
            "inducedVelocity",
        ] {
            let [a, b] = [&co_simulation, &model_exchange].map(|i| i.real(name));
            assert!(
                (a - b).abs() < 1e-3 * (1.0 + a.abs()),
                "{inflow}: {name} {a} {b}"
            );
        }
    }
}
