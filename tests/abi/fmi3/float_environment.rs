//! As `float_environment` of FMI 2.0: traps, other rounding and flushing in the importer change no
//! bit of a flight in FMI 3.0 and stay, also for the function that it gives for updates.

#![cfg(target_arch = "x86_64")]

use crate::{
    float_environment::{DEFAULT, Host, OTHERS, mxcsr, set_mxcsr},
    support::{
        child,
        instance::bits,
        instance3::{Creation3, OnUpdate, Update},
    },
};

fn fly(host: &Host) -> Vec<u64> {
    let expected = host.0;
    let creation = Creation3 {
        required: vec!["velocity"],
        has_callback: true,
        event_mode: true,
        early_return: true,
        ..Creation3::default()
    };
    let rotor = host.call("fmi3InstantiateCoSimulation", || creation.make().unwrap());
    host.call("fmi3SetInt64", || {
        rotor.ok(rotor.choose("models.inflow", 12))
    });
    host.call("fmi3ExitInitializationMode", || rotor.initialize());
    host.call("fmi3UpdateDiscreteStates", || {
        rotor.update_discrete_states();
        rotor.enter_step_mode();
    });
    let on_update: OnUpdate = Box::new(move |rotor, update: Update| {
        assert_eq!(
            mxcsr() & !0x3f,
            expected & !0x3f,
            "the importer's own environment"
        );
        if update.asks_for_inputs {
            // The sum is the test's own: it is made in the default environment.
            set_mxcsr(DEFAULT);
            let speed = -30.0 * update.time;
            set_mxcsr(expected);
            rotor.ok(rotor.set_floats(&["velocity"], &[1.0, 0.0, speed]));
        }
        None
    });
    let stepped = host.call("fmi3DoStep", || {
        let (status, stepped) = rotor.step_with(0.0, 0.1, Some(on_update));
        rotor.ok(status);
        stepped
    });
    // An answer on which a comparison would trap.
    let ask: OnUpdate = Box::new(|_, update| {
        let signalling = f64::from_bits(0x7ff0_0000_0000_0001);
        update.may_read.then_some(signalling)
    });
    let time = stepped.time;
    host.call("fmi3DoStep", || {
        let (status, stepped) = rotor.step_with(time, 0.1, Some(ask));
        rotor.ok(status);
        assert!(stepped.is_early);
    });
    let mut seen = host.call("fmi3GetFloat64", || bits(&rotor.all_floats()));
    seen.push(stepped.time.to_bits());
    seen
}

#[test]
fn traps_rounding_and_flushing_change_no_bit_of_fmi_3_and_stay() {
    let name =
        "fmi3::float_environment::traps_rounding_and_flushing_change_no_bit_of_fmi_3_and_stay";
    if child::run_alone(name).is_some() {
        return;
    }
    let usual = fly(&Host(DEFAULT));
    for environment in OTHERS {
        assert!(fly(&Host(environment)) == usual, "{environment:x}");
    }
}
