//! Steps of FMI 3.0 allocate no memory either: with arrays, enumerations and Booleans set, outputs
//! read, and with intermediate updates.

#![cfg(all(target_os = "linux", target_env = "gnu"))]

use crate::support::{allocations::Allocations, child, instance3::variable};
use std::{cell::Cell, ffi::c_void, ptr};

thread_local! {
    static INSTANCE: Cell<*mut c_void> = const { Cell::new(ptr::null_mut()) };
}

/// Moves an array and reads the thrust.
unsafe extern "C" fn update(
    functions: *mut c_void,
    time: f64,
    set: u8,
    _: u8,
    _: u8,
    _: u8,
    _: *mut u8,
    _: *mut f64,
) {
    // SAFETY: the address of the functions that the library has.
    let f = unsafe { &*functions.cast::<crate::support::c3::Functions>() };
    let (velocity, thrust) = (6, 30);
    let (speeds, mut x) = ([1.0 + time, 0.0, 0.5], 0.0);
    let c = INSTANCE.get();
    // SAFETY: the instance lives, and the pointers are valid for their counts.
    let status = unsafe {
        match set {
            1 => (f.fmi3SetFloat64)(c, &velocity, 1, speeds.as_ptr(), 3),
            _ => (f.fmi3GetFloat64)(c, &thrust, 1, &mut x, 1),
        }
    };
    assert_eq!(status, 0);
}

#[test]
fn steps_and_numbers_of_fmi_3_allocate_nothing() {
    let name = "fmi3::no_allocation::steps_and_numbers_of_fmi_3_allocate_nothing";
    if child::run_counting(name).is_some() {
        return;
    }
    let allocations = Allocations::find();
    assert_eq!(
        [variable("velocity").reference, variable("thrust").reference],
        [6, 30]
    );
    let f = &crate::support::Fmu::shared().of_fmi3;
    let token = helicopter_rotor::block::variables::INSTANTIATION_TOKEN;
    let token = std::ffi::CString::new(token).unwrap();
    let names = ["models.inflow", "flapping.enabled", "velocity", "thrust"];
    let [inflow, flaps, velocity, thrust] = names.map(|name| variable(name).reference);
    let required = [velocity, thrust];
    for has_updates in [false, true] {
        // SAFETY: the calls and their arguments are those of the standard.
        let count = unsafe {
            let (name, place) = (c"rotor".as_ptr(), ptr::from_ref(f).cast_mut().cast());
            let (r, n) = (required.as_ptr(), 2);
            let update: Option<crate::support::c3::IntermediateUpdate> =
                has_updates.then_some(update);
            let none = ptr::null();
            let c = (f.fmi3InstantiateCoSimulation)(
                name,
                token.as_ptr(),
                none,
                0,
                0,
                1,
                1,
                r,
                n,
                place,
                None,
                update,
            );
            INSTANCE.set(c);
            assert_eq!((f.fmi3SetInt64)(c, &inflow, 1, &12, 1), 0);
            assert_eq!((f.fmi3SetBoolean)(c, &flaps, 1, &1, 1), 0);
            assert_eq!((f.fmi3EnterInitializationMode)(c, 0, 0.0, 0.0, 0, 0.0), 0);
            assert_eq!((f.fmi3ExitInitializationMode)(c), 0);
            let (mut b, mut time, mut x) = (0, 0.0, 0.0);
            let (b, t) = (&raw mut b, &raw mut time);
            assert_eq!((f.fmi3EnterStepMode)(c), 0);
            let count = allocations.count(|| {
                for i in 0..5 {
                    let point = f64::from(i) * 0.01;
                    let speeds = [1.0, 0.1 * f64::from(i), 0.5];
                    let status = [
                        (f.fmi3SetFloat64)(c, &velocity, 1, speeds.as_ptr(), 3),
                        (f.fmi3SetInt64)(c, &inflow, 1, &12, 1),
                        (f.fmi3SetBoolean)(c, &flaps, 1, &1, 1),
                        (f.fmi3DoStep)(c, point, 0.01, 1, b, b, b, t),
                        (f.fmi3GetFloat64)(c, &thrust, 1, &mut x, 1),
                    ];
                    assert_eq!(status, [0; 5]);
                }
            });
            (f.fmi3FreeInstance)(c);
            assert_eq!(time, 0.05);
            count
        };
        assert_eq!(count, 0, "with updates: {has_updates}");
    }
}
