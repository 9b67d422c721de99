//! Directional derivatives and the derivatives of outputs in time, through the C interface. That
//! they are exact in all models is held by tests/block/derivatives.rs.

use crate::support::{
    Creation, Fmu, Instance,
    c::{self, Reference},
    instance::reference,
};
use helicopter_rotor::block::variables::{INTEGERS, REALS};
use std::ptr;

/// An instance with dynamic inflow, 10 ms after its start; in Continuous-Time Mode for Model
/// Exchange.
fn under_way(kind: i32) -> Instance<'static> {
    let creation = Creation {
        kind,
        ..Creation::default()
    };
    let instance = Instance::create(Fmu::shared(), &creation).unwrap();
    let choices = INTEGERS[reference(&INTEGERS, "models.inflow") as usize].choices;
    let model = choices.iter().position(|c| *c == "pittPetersDynamic");
    let model = model.unwrap() as i32 + 1;
    assert_eq!(instance.set_integer("models.inflow", model), c::OK);
    assert_eq!(instance.set_real("velocity[1]", 12.0), c::OK);
    assert_eq!(instance.set_real("flapping.hingeSpring", 3.0), c::OK);
    if kind == c::MODEL_EXCHANGE {
        instance.begin_integration();
    } else {
        instance.initialize();
        assert_eq!(instance.step(0.0, 0.01), c::OK);
    }
    instance
}

#[test]
fn derivatives_along_a_direction_are_those_of_differences() {
    let instance = under_way(c::MODEL_EXCHANGE);
    for (known, step) in [("collective", 1e-5), ("wind[3]", 1e-3)] {
        let base = instance.real(known);
        for unknown in ["thrust", "hubMoment[2]", "der(state.inflow[1])"] {
            let at = |value: f64| {
                assert_eq!(instance.set_real(known, value), c::OK);
                instance.real(unknown)
            };
            let difference = (at(base + step) - at(base - step)) / (2.0 * step);
            at(base);
            let exact = instance.derivative(unknown, known);
            assert!(
                (exact / difference - 1.0).abs() < 2e-3,
                "d {unknown}/d {known}: {exact} {difference}"
            );
        }
    }
    // By a state, which only Model Exchange may set, and in time.
    let states = instance.states();
    let base = instance.derivatives();
    let mut moved = states.clone();
    moved[2] += 1e-4;
    assert_eq!(instance.set_states(&moved), c::OK);
    let difference = (instance.derivatives()[2] - base[2]) / 1e-4;
    assert_eq!(instance.set_states(&states), c::OK);
    let exact = instance.derivative("der(state.inflow[1])", "state.inflow[1]");
    assert!(
        (exact / difference - 1.0).abs() < 2e-3,
        "{exact} {difference}"
    );
    assert_eq!(
        instance.derivative("der(state.inflow[9])", "collective"),
        0.0
    );
    assert_eq!(
        instance.derivative("der(state.flapAngle[1])", "state.flapRate[1]"),
        0.0
    );
}

#[test]
fn both_interfaces_have_the_same_derivatives() {
    let values = [c::CO_SIMULATION, c::MODEL_EXCHANGE].map(|kind| {
        let instance = Instance::create(
            Fmu::shared(),
            &Creation {
                kind,
                ..Creation::default()
            },
        )
        .unwrap();
        assert_eq!(instance.set_real("velocity[1]", 12.0), c::OK);
        instance.begin_initialization();
        instance.derivative("torque", "rpm")
    });
    assert_eq!(values[0], values[1]);
    assert!(values[0] > 0.0);
}

#[test]
fn outputs_have_their_derivative_in_time_at_the_end_of_a_step() {
    let instance = under_way(c::CO_SIMULATION);
    let outputs = ["thrust", "torque", "azimuth"].map(|name| reference(&REALS, name));
    for slope in [0.0, 0.7] {
        let time = instance.last_time();
        let size = 1e-5;
        let mut ends = [[0.0; 3]; 3];
        let mut rates = [f64::NAN; 3];
        for (i, end) in ends.iter_mut().enumerate() {
            assert_eq!(instance.set_slope("collective", slope), c::OK);
            assert_eq!(instance.step(time + i as f64 * size, size), c::OK);
            assert_eq!(instance.get_reals(&outputs, end), c::OK);
            if i == 1 {
                let status = instance.output_derivatives(&outputs, &[1; 3], &mut rates);
                assert_eq!(status, c::OK);
            }
        }
        for (i, rate) in rates.into_iter().enumerate() {
            let difference = (ends[2][i] - ends[0][i]) / (2.0 * size);
            assert!(
                (rate - difference).abs() < 1e-3 * (1.0 + difference.abs()),
                "{} at a slope of {slope}: {rate} {difference}",
                REALS[outputs[i] as usize].name
            );
        }
    }
}

/// Inputs that stood still in the last step do so in the derivative.
#[test]
fn an_input_that_has_come_to_rest_moves_no_output() {
    let instance = Instance::running();
    let thrust = [reference(&REALS, "thrust")];
    let rate = |instance: &Instance| {
        let mut rate = [f64::NAN];
        assert_eq!(instance.output_derivatives(&thrust, &[1], &mut rate), c::OK);
        rate[0]
    };
    assert_eq!(instance.set_slope("collective", 0.5), c::OK);
    assert_eq!(instance.step(0.0, 0.01), c::OK);
    let moving = rate(&instance);
    assert!((moving / (0.5 * instance.derivative("thrust", "collective")) - 1.0).abs() < 1e-12);
    // The state keeps it.
    let state = instance.state();
    assert_eq!(instance.step(0.01, 0.01), c::OK);
    assert_eq!(rate(&instance), 0.0);
    assert_eq!(instance.set_state(&state), c::OK);
    assert_eq!(rate(&instance), moving);
}

#[test]
fn what_has_no_derivative_is_refused_and_nothing_is_written() {
    let instance = under_way(c::CO_SIMULATION);
    let by_name = |name: &str| reference(&REALS, name);
    let refused = |unknown: Reference, known: Reference, parts: [&str; 2]| {
        let mut out = [7.0];
        let status = instance.along(&[unknown], &[known], &[1.0], &mut out);
        let message = instance.refused(status);
        for part in parts {
            assert!(message.contains(part), "{part:?} is not in: {message}");
        }
        assert_eq!(out, [7.0]);
    };
    let (thrust, collective) = (by_name("thrust"), by_name("collective"));
    refused(collective, collective, ["collective", "not computed"]);
    refused(
        thrust,
        by_name("geometry.radius"),
        ["geometry.radius", "tunable"],
    );
    refused(thrust, by_name("power"), ["power", "inputs"]);
    refused(thrust, 9_999, ["9999", "modelDescription.xml"]);
    refused(9_999, collective, ["9999", "modelDescription.xml"]);

    let mut out = [7.0];
    for (name, order, part) in [
        ("thrust", 2, "order = 2"),
        ("thrust", 0, "order = 0"),
        ("collective", 1, "collective"),
        ("station[1].mach", 1, "station[1].mach"),
    ] {
        let status = instance.output_derivatives(&[by_name(name)], &[order], &mut out);
        let message = instance.refused(status);
        assert!(message.contains(part), "{part:?} is not in: {message}");
        assert_eq!(out, [7.0]);
    }

    // Null pointers are refused where there should be something behind them, and only there.
    let (get, component) = (
        instance.functions.fmi2GetDirectionalDerivative,
        instance.component,
    );
    // SAFETY: the instance lives; pointers that are not null have one element.
    let statuses = unsafe {
        let (seed, out) = (&1.0, &mut out[0] as *mut f64);
        [
            get(component, ptr::null(), 1, &collective, 1, seed, out),
            get(component, &thrust, 1, ptr::null(), 1, seed, out),
            get(component, &thrust, 1, &collective, 1, ptr::null(), out),
            get(component, &thrust, 1, &collective, 1, seed, ptr::null_mut()),
        ]
    };
    let log = instance.take_log();
    assert_eq!((statuses, log.len()), ([c::ERROR; 4], 4));
    assert!(
        log.iter().all(|line| line.message.contains("null pointer")),
        "{log:?}"
    );
    // No knowns is no direction.
    let mut out = [7.0];
    assert_eq!(instance.along(&[thrust], &[], &[], &mut out), c::OK);
    assert_eq!(out, [0.0]);
}
