//! Making instances, and mixing versions.

use crate::support::{
    Fmu, Instance, Instance3, c,
    instance::reference,
    instance3::{Creation3, Kind},
};
use helicopter_rotor::block::variables::{GUID, REALS};
use std::ptr;

#[test]
fn another_token_gives_no_instance_and_says_why_whether_logging_is_on_or_not() {
    for logging_on in [true, false] {
        for token in [GUID, "", "{}"] {
            let creation = Creation3 {
                token,
                logging_on,
                ..Creation3::default()
            };
            let log = creation.make().err().unwrap();
            assert_eq!(log.len(), 1);
            assert!(log[0].message.contains("instantiationToken"), "{log:?}");
        }
    }
}

#[test]
fn scheduled_execution_is_not_offered() {
    let creation = Creation3 {
        kind: Kind::ScheduledExecution,
        ..Creation3::default()
    };
    let log = creation.make().err().unwrap();
    assert_eq!(log.len(), 1);
    let (line, name) = (&log[0], "fmi3InstantiateScheduledExecution");
    assert_eq!(line.status, c::ERROR);
    assert!(
        line.message.starts_with(name) && line.message.contains("offer Scheduled Execution"),
        "{line:?}"
    );
}

#[test]
fn variables_that_cannot_be_accessed_in_a_step_are_refused_for_intermediate_updates() {
    for name in [
        "geometry.radius",
        "flowState",
        "time",
        "state.inflow",
        "station.mach",
    ] {
        let creation = Creation3 {
            required: vec!["collective", name],
            has_callback: true,
            ..Creation3::default()
        };
        let log = creation
            .make()
            .err()
            .unwrap_or_else(|| panic!("{name} was accepted"));
        let reference = crate::support::instance3::variable(name)
            .reference
            .to_string();
        assert!(log[0].message.contains(&reference), "{log:?}");
    }
}

/// An importer that takes the functions of one version for an instance of the other.
#[test]
fn functions_of_one_version_refuse_instances_and_states_of_the_other() {
    let (two, three) = (Instance::running(), Instance3::new());
    three.initialize();
    let (f2, f3) = (two.functions, three.functions);
    let (thrust, mut x) = (reference(&REALS, "thrust"), 0.0);
    // SAFETY: both instances live, and the pointers are valid for one element.
    unsafe {
        let status = (f2.fmi2GetReal)(three.pointer, &thrust, 1, &mut x);
        assert!(three.refused(status).contains("belongs to FMI 2.0"));
        let status = (f3.fmi3GetFloat64)(two.component, &thrust, 1, &mut x, 1);
        assert_eq!(status, c::ERROR);
        // Freed by its own version only.
        (f3.fmi3FreeInstance)(two.component);
        let log = two.take_log();
        assert_eq!(log.len(), 2);
        assert!(
            log.iter()
                .all(|line| line.message.contains("belongs to FMI 3.0"))
        );
        (f2.fmi2FreeInstance)(three.pointer);
        let log = three.take_log();
        assert_eq!(log.len(), 1);
        assert!(log[0].message.contains("belongs to FMI 2.0"), "{log:?}");

        let mut state = ptr::null_mut();
        assert_eq!((f2.fmi2GetFMUstate)(two.component, &mut state), c::OK);
        let status = (f3.fmi3SetFMUState)(three.pointer, state);
        assert!(three.refused(status).contains("FMI 2.0"));
        assert_eq!((f2.fmi2FreeFMUstate)(two.component, &mut state), c::OK);
    }
    let message = three.refused(three.continue_from(&two.state().serialize()));
    assert!(message.contains(GUID), "{message}");
    assert_eq!(two.step(0.0, 0.01), c::OK);
    three.step(0.0, 0.01);
}

#[test]
fn the_resources_are_found_by_a_plain_path_and_without_one() {
    let f = &Fmu::shared().of_fmi3;
    let token = std::ffi::CString::new(helicopter_rotor::block::variables::INSTANTIATION_TOKEN);
    let token = token.unwrap();
    // SAFETY: the strings live during the call, and the instance is freed.
    unsafe {
        let make = f.fmi3InstantiateModelExchange;
        let (name, none) = (c"rotor".as_ptr(), ptr::null());
        let instance = make(name, token.as_ptr(), none, 0, 0, ptr::null_mut(), None);
        assert!(!instance.is_null());
        let enter = f.fmi3EnterInitializationMode;
        assert_eq!(enter(instance, 0, 0.0, 0.0, 0, 0.0), c::OK);
        assert_eq!((f.fmi3ExitInitializationMode)(instance), c::OK);
        (f.fmi3FreeInstance)(instance);
        (f.fmi3FreeInstance)(ptr::null_mut());
    }
}
