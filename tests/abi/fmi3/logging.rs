//! Which messages an importer of FMI 3.0 gets.

use crate::support::{Instance3, c, c::Text, instance3::Creation3};
use std::ffi::{CStr, CString};

fn set_logging(instance: &Instance3, on: bool, categories: &[&str]) -> c::Status {
    let texts: Vec<CString> = categories
        .iter()
        .map(|c| CString::new(*c).unwrap())
        .collect();
    let pointers: Vec<Text> = texts.iter().map(|t| t.as_ptr()).collect();
    let set = instance.functions.fmi3SetDebugLogging;
    // SAFETY: the instance lives, and the pointers are valid for their count.
    unsafe {
        set(
            instance.pointer,
            on.into(),
            pointers.len(),
            pointers.as_ptr(),
        )
    }
}

#[test]
fn with_logging_off_an_importer_gets_no_message_at_all() {
    let creation = Creation3 {
        logging_on: false,
        ..Creation3::default()
    };
    let instance = creation.make().unwrap();
    assert_eq!(instance.set_floats(&["thrust"], &[1.0]), c::ERROR);
    assert_eq!(instance.set_floats(&["rpm"], &[-1.0]), c::OK);
    instance.initialize();
    assert_eq!(instance.take_log(), []);
    assert_eq!(set_logging(&instance, true, &[]), c::OK);
    assert_eq!(instance.set_floats(&["thrust"], &[1.0]), c::ERROR);
    assert_eq!(instance.take_log().len(), 1);
}

#[test]
fn categories_are_turned_on_and_off_one_by_one() {
    let instance = Instance3::new();
    let errs = || {
        assert_eq!(instance.set_floats(&["thrust"], &[1.0]), c::ERROR);
        instance.take_log().len()
    };
    assert_eq!(errs(), 1);
    assert_eq!(set_logging(&instance, false, &["logStatusError"]), c::OK);
    assert_eq!(errs(), 0);
    // Others stay as they were.
    instance.begin_initialization();
    instance.exit_initialization();
    let events = instance.take_log();
    assert!(
        events.iter().any(|line| line.category == "logEvents"),
        "{events:?}"
    );
    assert_eq!(set_logging(&instance, false, &[]), c::OK);
    assert_eq!(set_logging(&instance, true, &["logStatusError"]), c::OK);
    assert_eq!(errs(), 1);
    // The answer says it, also where no message does.
    assert_eq!(set_logging(&instance, true, &["logNothing"]), c::WARNING);
}

/// `#` begins the value reference of a variable in a message.
#[test]
fn a_number_sign_in_a_message_is_doubled_and_a_per_cent_sign_is_not() {
    let instance = Instance3::new();
    let file = crate::support::instance3::variable("airfoil.file").reference;
    let set = instance.functions.fmi3SetString;
    // SAFETY: the instance and the string live.
    instance.ok(unsafe { set(instance.pointer, &file, 1, &c"no#such%file".as_ptr(), 1) });
    instance.begin_initialization();
    // SAFETY: the instance lives.
    let status = unsafe { (instance.functions.fmi3ExitInitializationMode)(instance.pointer) };
    let message = instance.refused(status);
    assert!(message.contains("no##such%file"), "{message}");
}

#[test]
fn the_version_is_that_of_the_headers() {
    let instance = Instance3::new();
    // SAFETY: a constant C string.
    let version = unsafe { CStr::from_ptr((instance.functions.fmi3GetVersion)()) };
    assert_eq!(version, c"3.0");
}
