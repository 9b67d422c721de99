//! The log: what is said, when, in which category, and how it is passed.

use crate::support::{
    Creation, Fmu, Instance, c,
    c::Text,
    instance::{callbacks, logger},
};
use helicopter_rotor::block::variables::{GUID, LOG_CATEGORIES};
use roxmltree::Document;
use std::{
    ffi::{CString, c_void},
    ptr,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
};

fn with_logging() -> Instance<'static> {
    let creation = Creation {
        logging_on: true,
        ..Creation::default()
    };
    Instance::create(Fmu::shared(), &creation).unwrap()
}

/// A whole simulation without errors.
fn clean_run(instance: &Instance) {
    assert_eq!(
        instance.set_string("geometry.file", "knight-hefner-3.toml"),
        c::OK
    );
    instance.initialize();
    assert_eq!(instance.set_real("collective", 0.1), c::OK);
    assert_eq!(instance.step(0.0, 0.01), c::OK);
    assert_eq!(instance.terminate(), c::OK);
}

#[test]
fn a_clean_run_logs_nothing_while_logging_is_off() {
    let instance = Instance::new();
    clean_run(&instance);
    assert_eq!(instance.take_log(), []);
    let instance = with_logging();
    assert_eq!(instance.set_debug_logging(false, &[]), c::OK);
    clean_run(&instance);
    assert_eq!(instance.take_log(), []);
}

/// The same in Model Exchange, with an event.
#[test]
fn a_clean_integration_logs_its_files_only_while_logging_is_on() {
    for logging_on in [false, true] {
        let creation = Creation {
            kind: c::MODEL_EXCHANGE,
            logging_on,
            ..Creation::default()
        };
        let instance = Instance::create(Fmu::shared(), &creation).unwrap();
        instance.begin_integration();
        let files = instance.take_log();
        assert_eq!(!files.is_empty(), logging_on);
        for line in &files {
            assert_eq!((line.status, line.category.as_str()), (c::OK, "logEvents"));
        }
        assert_eq!(instance.set_time(0.1), c::OK);
        assert_eq!(instance.set_states(&instance.states()), c::OK);
        assert_eq!(instance.set_real("velocity[3]", -30.0), c::OK);
        assert_eq!(instance.derivatives()[0], instance.real("der(azimuth)"));
        assert!(instance.completed_step());
        assert_eq!(instance.enter_event_mode(), c::OK);
        instance.new_discrete_states();
        assert_eq!(instance.enter_continuous_time(), c::OK);
        let state = instance.state();
        assert_eq!(instance.set_state(&state), c::OK);
        assert_eq!(instance.terminate(), c::OK);
        assert_eq!(instance.take_log(), []);
    }
}

#[test]
fn with_logging_on_the_log_says_which_files_were_read() {
    let instance = with_logging();
    clean_run(&instance);
    let log = instance.take_log();
    for line in &log {
        assert_eq!(
            (line.status, line.category.as_str()),
            (c::OK, "logEvents"),
            "{line:?}"
        );
        assert_eq!(line.instance, "rotor");
    }
    for file in [
        "rotors/knight-hefner-3.toml",
        "airfoils/circle.polar",
        "airfoils/naca0015-knight-hefner-reynolds.polar",
    ] {
        let path = Fmu::shared().resources().join(file);
        let with_slashes = |text: &str| text.replace('\\', "/");
        let path = with_slashes(path.to_str().unwrap());
        let lines = log
            .iter()
            .filter(|line| with_slashes(&line.message).contains(&path))
            .count();
        assert_eq!(lines, 1, "{path} in {log:?}");
    }
}

/// The lines that say that the flow goes beyond an airfoil file.
fn beyond(instance: &Instance) -> Vec<String> {
    let lines = instance.take_log().into_iter();
    let lines = lines.filter(|line| line.message.contains("said once"));
    lines
        .map(|line| {
            assert_eq!((line.status, line.category.as_str()), (c::OK, "logEvents"));
            line.message
        })
        .collect()
}

#[test]
fn flow_beyond_the_numbers_of_an_airfoil_file_is_logged_once_for_each_instance() {
    // A file with one Reynolds number, which hardly any element meets: the default.
    let instance = with_logging();
    instance.initialize();
    assert_eq!(instance.step(0.0, 0.01), c::OK);
    let lines = beyond(&instance);
    assert_eq!(lines.len(), 1, "{lines:?}");
    for part in [
        "Reynolds numbers",
        "242000 in the airfoil file",
        "Knight & Hefner",
    ] {
        assert!(lines[0].contains(part), "{lines:?}");
    }

    // Within at first, beyond in a step.
    let instance = with_logging();
    assert_eq!(instance.set_string("airfoil.file", "naca0015.polar"), c::OK);
    instance.initialize();
    assert_eq!(beyond(&instance), [""; 0]);
    for (i, rpm) in [960.0, 100.0, 960.0, 50.0, 0.0].into_iter().enumerate() {
        assert_eq!(instance.set_real("rpm", rpm), c::OK);
        assert_eq!(instance.step(0.1 * i as f64, 0.1), c::OK);
        let expected = usize::from(rpm == 100.0);
        assert_eq!(beyond(&instance).len(), expected, "at {rpm} rpm");
    }

    // Another instance says it again, and Mach numbers count by themselves.
    let file = crate::support::fmu::scratch().join("two-mach-numbers.c81");
    let table = |values: &str| format!("0.2 0.3\n-180 {values}\n180 {values}\n");
    let text = format!("two 2 2 2 2\n{}{}", table("0 0"), table("0.01 0.02"));
    std::fs::write(&file, text).unwrap();
    let instance = with_logging();
    assert_eq!(
        instance.set_string("airfoil.file", file.to_str().unwrap()),
        c::OK
    );
    instance.initialize();
    let lines = beyond(&instance);
    assert!(
        lines.len() == 1
            && lines[0].starts_with("Mach numbers 0.0")
            && lines[0].contains("0.200 to 0.300"),
        "{lines:?}"
    );
}

/// A warning needs no logging_on and does not change the answer of the call.
#[test]
fn implausible_values_are_logged_at_the_end_of_initialisation() {
    let warned = |chosen: &[&str]| {
        let instance = Instance::new();
        if !chosen.is_empty() {
            assert_eq!(instance.set_debug_logging(false, chosen), c::OK);
        }
        assert_eq!(instance.set_real("tilt", 8.0), c::OK);
        assert_eq!(instance.set_real("geometry.chord", 0.5), c::OK);
        instance.initialize();
        assert_eq!(instance.step(0.0, 0.01), c::OK);
        instance.take_log()
    };
    let log = warned(&[]);
    for part in ["tilt = 8 rad", "chord given in mm?", "solidity"] {
        let lines: Vec<_> = log
            .iter()
            .filter(|line| line.message.contains(part))
            .collect();
        let [line] = lines[..] else {
            panic!("one line with {part:?} is expected: {log:?}")
        };
        assert_eq!(
            (line.status, line.category.as_str()),
            (c::WARNING, "logStatusWarning")
        );
        assert!(
            line.message.starts_with("fmi2ExitInitializationMode: "),
            "{line:?}"
        );
    }
    assert_eq!(warned(&["logStatusWarning"]), log);
    assert_eq!(warned(&["logStatusError", "logEvents"]), []);
}

#[test]
fn errors_are_logged_also_while_logging_is_off() {
    let instance = Instance::new();
    assert!(
        instance
            .refused(instance.step(0.0, 0.1))
            .contains("fmi2DoStep")
    );
    assert_eq!(instance.set_debug_logging(false, &[]), c::OK);
    assert!(
        instance
            .refused(instance.step(0.0, 0.1))
            .contains("fmi2DoStep")
    );
}

#[test]
fn only_declared_categories_are_used() {
    let text = Fmu::shared().description();
    let description = Document::parse(&text).unwrap();
    let declared = description
        .descendants()
        .filter(|node| node.has_tag_name("Category"));
    let declared: Vec<&str> = declared.flat_map(|node| node.attribute("name")).collect();
    assert_eq!(declared, LOG_CATEGORIES);
    let instance = with_logging();
    assert_eq!(instance.step(0.0, 0.1), c::ERROR);
    assert_eq!(
        instance.set_debug_logging(true, &["unheard-of"]),
        c::WARNING
    );
    assert_eq!(instance.set_debug_logging(true, &[]), c::OK);
    clean_run(&instance);
    let log = instance.take_log();
    for category in LOG_CATEGORIES {
        // Each occurs in this run, the warning but when no category is left for it.
        let found = log.iter().any(|line| line.category == category);
        assert!(
            found || category == "logStatusWarning",
            "{category} in {log:?}"
        );
    }
    assert!(
        log.iter()
            .all(|line| LOG_CATEGORIES.contains(&line.category.as_str())),
        "{log:?}"
    );
}

#[test]
fn chosen_categories_alone_are_logged() {
    for (chosen, error, events) in [
        (&["logStatusError"][..], true, false),
        (&["logEvents"], false, true),
        (
            &["logEvents", "logStatusError", "logStatusWarning"],
            true,
            true,
        ),
        (&["logStatusWarning"], false, false),
        (&[], true, true),
    ] {
        let instance = Instance::new();
        assert_eq!(instance.set_debug_logging(true, chosen), c::OK);
        assert_eq!(
            instance.step(0.0, 0.1),
            c::ERROR,
            "it is answered in any case"
        );
        clean_run(&instance);
        let log = instance.take_log();
        let logged = |category: &str| log.iter().any(|line| line.category == category);
        assert_eq!(
            (logged("logStatusError"), logged("logEvents")),
            (error, events),
            "{chosen:?}"
        );
    }
}

#[test]
fn an_unknown_category_gives_a_warning_and_the_others_are_chosen() {
    let instance = Instance::new();
    let chosen = ["logStatusWarning", "logEverything", "logEvents"];
    assert_eq!(instance.set_debug_logging(true, &chosen), c::WARNING);
    let log = instance.take_log();
    let [line] = &log[..] else {
        panic!("one line is expected: {log:?}")
    };
    assert_eq!(
        (line.status, line.category.as_str()),
        (c::WARNING, "logStatusWarning")
    );
    for part in [
        "fmi2SetDebugLogging",
        "logEverything",
        &LOG_CATEGORIES.join(", "),
    ] {
        assert!(line.message.contains(part), "{part} in {line:?}");
    }
    assert_eq!(instance.step(0.0, 0.1), c::ERROR);
    assert_eq!(instance.take_log(), [], "errors were not chosen");
    clean_run(&instance);
    assert!(!instance.take_log().is_empty(), "events were");
}

/// The message is the format of a printf: a lone % would read arguments that are not there.
#[test]
fn percent_signs_arrive_escaped() {
    let instance = Instance::new();
    assert_eq!(
        instance.set_string("airfoil.file", "100%s/%n%5d%%.polar"),
        c::OK
    );
    instance.begin_initialization();
    let message = instance.refused(instance.exit_initialization());
    assert!(message.contains("100%%s/%%n%%5d%%%%.polar"), "{message}");
    assert!(!message.replace("%%", "").contains('%'), "{message}");
}

#[test]
fn messages_are_single_sentences_without_a_newline_at_the_end() {
    let instance = with_logging();
    clean_run(&instance);
    assert_eq!(instance.step(0.0, 0.1), c::ERROR);
    assert_eq!(
        instance.set_debug_logging(true, &["unheard-of"]),
        c::WARNING
    );
    for line in instance.take_log() {
        assert!(
            !line.message.contains('\n') && line.message.trim() == line.message,
            "{line:?}"
        );
    }
}

#[test]
fn each_instance_logs_to_its_own_environment_under_its_own_name() {
    let create = |name: &'static [u8]| {
        let creation = Creation {
            name: Some(name),
            ..Creation::default()
        };
        Instance::create(Fmu::shared(), &creation).unwrap()
    };
    let (one, two) = (create(b"main rotor"), create("Heckrotor ü 100%".as_bytes()));
    assert_eq!(two.step(0.0, 0.1), c::ERROR);
    assert_eq!(one.take_log(), []);
    assert_eq!(two.take_log()[0].instance, "Heckrotor ü 100%");
    assert_eq!(one.step(0.0, 0.1), c::ERROR);
    assert_eq!(two.take_log(), []);
    assert_eq!(one.take_log()[0].instance, "main rotor");
}

#[test]
fn a_null_environment_is_handed_back_as_null() {
    static CALLS: AtomicUsize = AtomicUsize::new(0);
    unsafe extern "C" fn count(environment: *mut c_void, _: Text, _: c::Status, _: Text, _: Text) {
        if environment.is_null() {
            CALLS.fetch_add(1, Ordering::Relaxed);
        }
    }
    let (log, guid) = (Mutex::default(), CString::new(GUID).unwrap());
    let callbacks = c::Callbacks {
        logger: Some(logger(count)),
        environment: ptr::null_mut(),
        ..callbacks(&log)
    };
    let f = &Fmu::shared().functions;
    // SAFETY: the pointers are null or valid during the call; the instance is freed at its end.
    unsafe {
        let component = (f.fmi2Instantiate)(
            c"rotor".as_ptr(),
            c::CO_SIMULATION,
            guid.as_ptr(),
            ptr::null(),
            &callbacks,
            0,
            0,
        );
        assert_eq!((f.fmi2DoStep)(component, 0.0, 0.1, 1), c::ERROR);
        (f.fmi2FreeInstance)(component);
    }
    assert_eq!(CALLS.load(Ordering::Relaxed), 1);
}

/// An importer may free the instance, or change its logging, when it hears of an error.
#[test]
fn the_logger_may_call_back_even_to_free_the_instance() {
    static FREED: AtomicUsize = AtomicUsize::new(0);
    /// Frees the instance that the environment points to, at the first call.
    unsafe extern "C" fn free(environment: *mut c_void, _: Text, _: c::Status, _: Text, _: Text) {
        let functions = &Fmu::shared().functions;
        // SAFETY: the environment is the place of the component, set before the call that logs.
        let component = unsafe { *environment.cast::<c::Component>() };
        if FREED.fetch_add(1, Ordering::Relaxed) == 0 {
            // SAFETY: the component is alive and not used afterwards.
            unsafe {
                (functions.fmi2SetDebugLogging)(component, 1, 0, ptr::null());
                (functions.fmi2FreeInstance)(component);
            }
        }
    }
    let (log, guid) = (Mutex::default(), CString::new(GUID).unwrap());
    let mut place: c::Component = ptr::null_mut();
    let callbacks = c::Callbacks {
        logger: Some(logger(free)),
        environment: (&raw mut place).cast(),
        ..callbacks(&log)
    };
    let f = &Fmu::shared().functions;
    let name = c"rotor".as_ptr();
    // SAFETY: the pointers are null or valid during the calls; the logger frees the instance.
    unsafe {
        let kind = c::CO_SIMULATION;
        let guid = guid.as_ptr();
        place = (f.fmi2Instantiate)(name, kind, guid, ptr::null(), &callbacks, 0, 1);
        assert_eq!((f.fmi2DoStep)(place, 0.0, 0.1, 1), c::ERROR);
    }
    assert_eq!(FREED.load(Ordering::Relaxed), 1);
}

/// A gale from below lifts the blades of a stopped rotor far beyond their flap stops: one warning,
/// also while logging is off, and the calls succeed.
#[test]
fn blades_far_beyond_their_stops_are_a_warning() {
    let instance = Instance::new();
    assert_eq!(instance.set_boolean("flapping.enabled", 1), c::OK);
    assert_eq!(instance.set_real("rpm", 0.0), c::OK);
    assert_eq!(instance.set_real("wind[3]", 45.0), c::OK);
    instance.begin_initialization();
    assert_eq!(instance.exit_initialization(), c::OK);
    for step in 0..3 {
        assert_eq!(instance.step(0.01 * f64::from(step), 0.01), c::OK);
    }
    let log = instance.take_log();
    let warnings: Vec<_> = log
        .iter()
        .filter(|line| {
            line.message
                .contains("far beyond the stop at flapping.highestAngle")
        })
        .collect();
    let [line] = &warnings[..] else {
        panic!("one warning is expected: {log:?}")
    };
    assert_eq!(
        (line.status, line.category.as_str()),
        (c::WARNING, "logStatusWarning")
    );
}
