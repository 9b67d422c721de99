//! The library prints nothing: what it has to say goes to the importer's logger.

use crate::support::{Fmu, c, child};
use helicopter_rotor::block::variables::GUID;
use std::{ffi::CString, ptr};

#[test]
fn nothing_is_printed_also_when_errors_find_no_logger() {
    let name = "silence::nothing_is_printed_also_when_errors_find_no_logger";
    if let Some(printed) = child::run_alone(name) {
        assert_eq!(printed.watched(), ["", ""], "stdout and stderr");
        return;
    }
    let f = &Fmu::shared().functions;
    let guid = CString::new(GUID).unwrap();
    let (here, nowhere) = (c"rotor".as_ptr(), ptr::null());
    // SAFETY: the pointers are null or valid during the calls; the component lives until it is
    // freed.
    child::watched(|| unsafe {
        let instantiate =
            |guid| (f.fmi2Instantiate)(here, c::CO_SIMULATION, guid, nowhere, ptr::null(), 1, 1);
        assert!(instantiate(c"wrong".as_ptr()).is_null());
        let component = instantiate(guid.as_ptr());
        let mut errors = 0;
        let mut count = |status| errors += usize::from(status == c::ERROR);
        count((f.fmi2DoStep)(component, 0.0, 0.1, 1));
        count((f.fmi2SetReal)(component, &0, 1, &f64::NAN));
        count((f.fmi2SetString)(
            component,
            &1,
            1,
            &c"no-such-file".as_ptr(),
        ));
        count((f.fmi2EnterInitializationMode)(component));
        count((f.fmi2ExitInitializationMode)(component));
        count((f.fmi2Reset)(component));
        count((f.fmi2EnterInitializationMode)(component));
        count((f.fmi2ExitInitializationMode)(component));
        count((f.fmi2SetReal)(component, &9, 1, &1e300));
        count((f.fmi2DoStep)(component, 0.0, 0.1, 1));
        (f.fmi2FreeInstance)(component);
        assert_eq!(errors, 4);
    });
}
