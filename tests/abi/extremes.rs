//! Operation at and past the limits: finite and physical results, or an error that leaves no trace.

use crate::support::{Instance, c, instance::bits};
use std::f64::consts::{FRAC_PI_2, PI};

/// All Real variables after a step with these inputs; an error is answered with its message.
fn flown(instance: &Instance, inputs: &[(&str, f64)]) -> Result<Vec<f64>, String> {
    for (name, value) in inputs {
        assert_eq!(instance.set_real(name, *value), c::OK, "{name}");
    }
    let status = instance.step(instance.last_time(), 0.125);
    if status != c::OK {
        return Err(instance.refused(status));
    }
    let reals = instance.reals();
    assert!(
        reals.iter().all(|value| value.is_finite()),
        "{inputs:?}: {reals:?}"
    );
    Ok(reals)
}

/// A running instance with an inflow model (1 annulusClosedForm, 2 annulus).
fn with_inflow(model: i32) -> Instance<'static> {
    let instance = Instance::new();
    assert_eq!(instance.set_integer("models.inflow", model), c::OK);
    instance.initialize();
    instance
}

#[test]
fn a_stopped_rotor_in_still_air_makes_no_force() {
    for model in [1, 2] {
        let rotor = with_inflow(model);
        for collective in [0.0, 0.2, -0.2, FRAC_PI_2] {
            flown(&rotor, &[("rpm", 0.0), ("collective", collective)]).unwrap();
            for name in [
                "thrust",
                "torque",
                "power",
                "inducedVelocity",
                "thrustCoefficient",
            ] {
                assert_eq!(rotor.real(name), 0.0, "{name}, collective {collective}");
            }
        }
        flown(&rotor, &[("rpm", 960.0), ("collective", 0.2)]).unwrap();
        assert!(rotor.real("thrust") > 0.0, "it runs again");
    }
}

#[test]
fn wind_pushes_a_stopped_rotor_where_it_blows() {
    let rotor = with_inflow(2);
    for (wind, sign) in [(10.0, 1.0), (-10.0, -1.0)] {
        flown(
            &rotor,
            &[("rpm", 0.0), ("collective", 0.0), ("wind[3]", wind)],
        )
        .unwrap();
        assert!(
            sign * rotor.real("thrust") > 0.0,
            "wind {wind}: {} N",
            rotor.real("thrust")
        );
        assert_eq!(rotor.real("power"), 0.0);
    }
}

#[test]
fn only_the_flow_between_hub_and_air_counts() {
    let (climbing, blown) = (with_inflow(2), with_inflow(2));
    flown(&climbing, &[("velocity[3]", 3.0)]).unwrap();
    flown(&blown, &[("wind[3]", -3.0)]).unwrap();
    assert_eq!(climbing.real("thrust"), blown.real("thrust"));
    assert!(
        climbing.real("thrust") < Instance::running().real("thrust"),
        "a climb unloads the rotor"
    );
}

#[test]
fn negative_collective_pushes_down() {
    for model in [1, 2] {
        let rotor = with_inflow(model);
        flown(&rotor, &[("collective", 0.14)]).unwrap();
        let up = rotor.real("thrust");
        flown(&rotor, &[("collective", -0.14)]).unwrap();
        let down = rotor.real("thrust");
        assert!(
            up > 0.0 && (up + down).abs() < 1e-6 * up,
            "{up} N up, {down} N: a symmetric section"
        );
        assert!(rotor.real("torque") > 0.0, "and takes torque");
    }
}

#[test]
fn blades_across_the_flow_are_a_brake() {
    for collective in [FRAC_PI_2, -FRAC_PI_2] {
        let rotor = with_inflow(2);
        flown(&rotor, &[("collective", collective)]).unwrap();
        let braking = rotor.real("torque");
        flown(&rotor, &[("collective", 0.14)]).unwrap();
        assert!(braking > 10.0 * rotor.real("torque"), "{braking} N m");
    }
}

/// A speed that halves ever again, as behind a first-order lag, down to the smallest numbers: no
/// step is refused, and with the annulus model the results go towards those at rest. (Small angles
/// against a flow that does not turn have no such limit.)
#[test]
fn a_rotor_that_runs_down_comes_to_rest_smoothly() {
    let mut refused = Vec::new();
    for model in [1, 2] {
        for climb in [0.0, 1.0, -10.0, 60.0] {
            let at_rest = with_inflow(model);
            flown(&at_rest, &[("rpm", 0.0), ("velocity[3]", climb)]).unwrap();
            let rotor = with_inflow(model);
            flown(&rotor, &[("velocity[3]", climb)]).unwrap();
            let mut rpm = 1.0;
            while rpm > 0.0 {
                let case = format!("inflow {model}, climb {climb} m/s, {rpm:e} rev/min");
                if flown(&rotor, &[("rpm", rpm)]).is_err() {
                    refused.push(case);
                    break;
                }
                for name in ["thrust", "torque", "power", "inducedVelocity"] {
                    let (slow, still) = (rotor.real(name), at_rest.real(name));
                    let near = (slow - still).abs() < 1e-6 * (1.0 + still.abs());
                    assert!(
                        near || model == 1 || rpm > 1e-9,
                        "{case}: {name} = {slow}, at rest {still}"
                    );
                }
                rpm *= 0.5;
            }
        }
    }
    assert_eq!(refused, [""; 0], "the first refusals");
}

/// Every combination of a wide grid, in both models: never OK with what is not finite, and after
/// an error the same bits as without it.
#[test]
fn no_corner_of_the_inputs_gives_results_that_are_not_finite() {
    let axial = [
        0.0, -0.0, 1e-300, 1.0, -1.0, 7.3, -7.3, 60.0, -60.0, 1e6, -1e6, 1e154, 1e300, -1e300,
    ];
    let mut refused = 0;
    for model in [1, 2] {
        let rotor = with_inflow(model);
        for rpm in [0.0, 1e-3, 1.0, 960.0, 1e6] {
            for collective in [0.0, 1e-12, 0.2, -0.2, FRAC_PI_2, -FRAC_PI_2, PI, -PI] {
                for climb in axial {
                    let inputs = [
                        ("rpm", rpm),
                        ("collective", collective),
                        ("velocity[3]", climb),
                    ];
                    if let Err(message) = flown(&rotor, &inputs) {
                        refused += 1;
                        assert!(message.contains("check the inputs"), "{message}");
                        assert!(climb.abs() > 1e5, "{inputs:?}: {message}");
                    }
                }
            }
        }
    }
    assert!(
        refused > 0,
        "thrust at 1e300 m/s is beyond floating-point numbers"
    );
}

#[test]
fn a_refused_step_leaves_no_trace() {
    let run = |disturbances: &[(&str, f64)]| {
        let rotor = Instance::running();
        flown(&rotor, &[("collective", 0.2)]).unwrap();
        let before = bits(&rotor.reals());
        for (name, value) in disturbances {
            let usual = rotor.real(name);
            let message = flown(&rotor, &[(name, *value)]).unwrap_err();
            assert!(message.contains(&format!("{name} = ")), "{message}");
            assert_eq!(rotor.last_time(), 0.125, "the step did not happen");
            assert_eq!(rotor.set_real(name, usual), c::OK);
        }
        assert_eq!(bits(&rotor.reals()), before);
        flown(&rotor, &[("collective", 0.1)]).unwrap();
        bits(&rotor.reals())
    };
    assert_eq!(
        run(&[
            ("velocity[3]", 1e300),
            ("wind[3]", 1e300),
            ("wind[3]", -1e300)
        ]),
        run(&[])
    );
}

#[test]
fn tilt_of_any_size_turns_the_force_and_keeps_its_size() {
    let rotor = with_inflow(2);
    for tilt in [0.0, 0.3, -0.3, PI, 1e3, 1e300, -1e300] {
        flown(&rotor, &[("tilt", tilt)]).unwrap();
        let force = ["force[1]", "force[2]", "force[3]"].map(|name| rotor.real(name));
        let size = force.iter().map(|f| f * f).sum::<f64>().sqrt();
        let thrust = rotor.real("thrust");
        assert!(
            (size - thrust).abs() < 1e-9 * thrust,
            "tilt {tilt}: {force:?}, thrust {thrust} N"
        );
    }
    flown(&rotor, &[("tilt", 0.3)]).unwrap();
    assert!(
        rotor.real("force[1]") > 0.0,
        "positive tilt tips the thrust forward"
    );
}
