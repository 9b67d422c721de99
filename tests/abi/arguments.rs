//! Arguments of the remaining functions: instantiation, debug logging, status.

use crate::support::{
    Creation, Instance, c,
    fmu::Fmu,
    instance::{bits, callbacks},
};
use helicopter_rotor::block::variables::{GUID, MODEL_IDENTIFIER};
use roxmltree::Document;
use std::{
    ffi::{CStr, CString, c_int},
    ptr,
    sync::Mutex,
};

/// Asserts that no instance is made, and that the log says why.
#[track_caller]
fn not_instantiated(creation: &Creation, parts: &[&str]) {
    let log = Instance::create(Fmu::shared(), creation)
        .err()
        .expect("there must be no instance");
    let [line] = &log[..] else {
        panic!("one line is expected: {log:?}")
    };
    assert_eq!(
        (line.status, line.category.as_str()),
        (c::ERROR, "logStatusError"),
        "{line:?}"
    );
    for part in [&["fmi2Instantiate"], parts].concat() {
        assert!(line.message.contains(part), "{part:?} is not in: {line:?}");
    }
}

#[test]
fn a_wrong_guid_gives_no_instance_and_says_why() {
    let other = b"{8c4e810f-3df3-4a00-8276-176fa3c9f9e0}";
    for guid in [&other[..], b"", b"{", b"\xff\xfe", b"100%"] {
        not_instantiated(
            &Creation {
                guid: Some(guid),
                ..Creation::default()
            },
            &["GUID"],
        );
    }
    not_instantiated(
        &Creation {
            guid: None,
            ..Creation::default()
        },
        &["GUID", "null pointer"],
    );
    let remedy = "modelDescription.xml and binary must come from the same .fmu";
    let creation = Creation {
        guid: Some(other),
        ..Creation::default()
    };
    not_instantiated(
        &creation,
        &["8c4e810f-3df3-4a00-8276-176fa3c9f9e0", GUID, remedy],
    );
}

#[test]
fn another_type_gives_no_instance_and_says_why() {
    for kind in [2, -1, c_int::MAX] {
        not_instantiated(
            &Creation {
                kind,
                ..Creation::default()
            },
            &["fmuType", &kind.to_string(), "fmi2CoSimulation"],
        );
    }
}

#[test]
fn the_description_in_the_archive_has_the_guid_of_the_binary() {
    let text = Fmu::shared().description();
    let description = Document::parse(&text).unwrap();
    assert_eq!(description.root_element().attribute("guid"), Some(GUID));
}

#[test]
fn without_a_name_the_log_has_the_name_of_the_model() {
    for name in [None, Some(&b""[..]), Some(b"\xff")] {
        let instance = Instance::create(
            Fmu::shared(),
            &Creation {
                name,
                ..Creation::default()
            },
        )
        .unwrap();
        assert_eq!(instance.step(0.0, 0.1), c::ERROR);
        assert_eq!(instance.take_log()[0].instance, MODEL_IDENTIFIER);
        instance.initialize();
    }
}

#[test]
fn without_callbacks_or_logger_the_instance_works_and_errors_are_answered() {
    let f = &Fmu::shared().functions;
    let log = Mutex::default();
    let no_logger = c::Callbacks {
        logger: None,
        ..callbacks(&log)
    };
    for callbacks in [ptr::null(), &raw const no_logger] {
        let guid = CString::new(GUID).unwrap();
        let instantiate = |guid: &CStr| {
            // SAFETY: the pointers are null or valid during the call.
            unsafe {
                (f.fmi2Instantiate)(
                    c"quiet".as_ptr(),
                    c::CO_SIMULATION,
                    guid.as_ptr(),
                    ptr::null(),
                    callbacks,
                    0,
                    1,
                )
            }
        };
        assert!(instantiate(c"wrong").is_null());
        let component = instantiate(&guid);
        assert!(!component.is_null());
        let (thrust, mut value) = (22, [0.0]);
        // SAFETY: the component lives until it is freed; the pointers have one element.
        unsafe {
            assert_eq!((f.fmi2DoStep)(component, 0.0, 0.1, 1), c::ERROR);
            assert_eq!((f.fmi2SetReal)(component, &0, 1, &f64::NAN), c::ERROR);
            assert_eq!(
                (f.fmi2SetupExperiment)(component, 0, 0.0, 0.0, 0, 0.0),
                c::OK
            );
            assert_eq!((f.fmi2EnterInitializationMode)(component), c::OK);
            assert_eq!((f.fmi2ExitInitializationMode)(component), c::OK);
            assert_eq!((f.fmi2DoStep)(component, 0.0, 0.1, 1), c::OK);
            assert_eq!(
                (f.fmi2GetReal)(component, &thrust, 1, value.as_mut_ptr()),
                c::OK
            );
            (f.fmi2FreeInstance)(component);
        }
        assert!(value[0].is_finite());
    }
    assert!(log.lock().unwrap().is_empty());
}

#[test]
fn a_status_is_answered_for_its_own_kind_only() {
    let instance = Instance::running();
    assert_eq!(instance.step(0.0, 0.25), c::OK);
    let (f, component) = (instance.functions, instance.component);
    let before = bits(&instance.reals());
    let kinds = [
        c::DO_STEP_STATUS,
        c::PENDING_STATUS,
        c::LAST_SUCCESSFUL_TIME,
        c::TERMINATED,
    ];
    for kind in [&kinds[..], &[4, -1, c_int::MAX, c_int::MIN]].concat() {
        let (mut status, mut time, mut count, mut end, mut text) = (9, -1.0, 9, 9, ptr::null());
        // SAFETY: the component lives, and the pointers have one element.
        let answers = unsafe {
            [
                (
                    c::DO_STEP_STATUS,
                    (f.fmi2GetStatus)(component, kind, &mut status),
                ),
                (
                    c::LAST_SUCCESSFUL_TIME,
                    (f.fmi2GetRealStatus)(component, kind, &mut time),
                ),
                (
                    c::TERMINATED,
                    (f.fmi2GetBooleanStatus)(component, kind, &mut end),
                ),
                (
                    c::PENDING_STATUS,
                    (f.fmi2GetStringStatus)(component, kind, &mut text),
                ),
                (-2, (f.fmi2GetIntegerStatus)(component, kind, &mut count)),
            ]
        };
        for (own, answer) in answers {
            assert_eq!(
                answer,
                if own == kind { c::OK } else { c::ERROR },
                "{own} for {kind}"
            );
        }
        assert_eq!(status, if kind == c::DO_STEP_STATUS { c::OK } else { 9 });
        assert_eq!(
            time,
            if kind == c::LAST_SUCCESSFUL_TIME {
                0.25
            } else {
                -1.0
            }
        );
        assert_eq!(end, if kind == c::TERMINATED { 0 } else { 9 });
        assert_eq!(count, 9);
        if kind == c::PENDING_STATUS {
            // SAFETY: the library's string lives until the next call.
            assert_eq!(unsafe { CStr::from_ptr(text) }, c"");
        } else {
            assert!(text.is_null());
        }
        for line in instance.take_log() {
            assert!(line.message.contains("fmi2StatusKind"), "{line:?}");
        }
    }
    assert_eq!(bits(&instance.reals()), before);
}

#[test]
fn null_pointers_for_answers_and_categories_are_refused() {
    let instance = Instance::running();
    let (f, component) = (instance.functions, instance.component);
    // SAFETY: the component lives; the functions must not touch what is null.
    let answers = unsafe {
        [
            (f.fmi2GetStatus)(component, c::DO_STEP_STATUS, ptr::null_mut()),
            (f.fmi2GetRealStatus)(component, c::LAST_SUCCESSFUL_TIME, ptr::null_mut()),
            (f.fmi2GetBooleanStatus)(component, c::TERMINATED, ptr::null_mut()),
            (f.fmi2GetStringStatus)(component, c::PENDING_STATUS, ptr::null_mut()),
            (f.fmi2SetDebugLogging)(component, 1, 1, ptr::null()),
            (f.fmi2SetDebugLogging)(component, 1, 1, &ptr::null()),
        ]
    };
    assert_eq!(answers, [c::ERROR; 6]);
    let log = instance.take_log();
    assert_eq!(log.len(), 6);
    for line in log {
        assert!(line.message.contains("null pointer"), "{line:?}");
    }
    assert_eq!(instance.step(0.0, 0.1), c::OK);
}
