//! A running simulation allocates no memory: setting and reading numbers, and steps.

use helicopter_rotor::{
    block::variables::{GUID, INTEGERS, boolean, integer, real},
    fmi2::{
        co_simulation::fmi2DoStep,
        common::{
            fmi2EnterInitializationMode, fmi2ExitInitializationMode, fmi2FreeInstance,
            fmi2Instantiate,
        },
        types::{FMI2_CO_SIMULATION, fmi2Status},
        values::{fmi2GetReal, fmi2SetBoolean, fmi2SetInteger, fmi2SetReal},
    },
};
use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
    ffi::CString,
    ptr,
};

/// The system's allocator, which counts what each thread asks of it.
struct Counting;

thread_local! {
    static COUNT: Cell<u64> = const { Cell::new(0) };
}

// SAFETY: everything is passed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        COUNT.with(|count| count.set(count.get() + 1));
        // SAFETY: passed on from the caller.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: passed on from the caller.
        unsafe { System.dealloc(pointer, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

#[test]
fn steps_and_numbers_allocate_nothing() {
    for model in INTEGERS[integer::MODEL__INFLOW].choices {
        for flaps in [0, 1] {
            if (*model, flaps) != ("annulusClosedForm", 1) {
                steps_allocate_nothing(model, flaps);
            }
        }
    }
}

fn steps_allocate_nothing(model: &str, flaps: i32) {
    let choices = INTEGERS[integer::MODEL__INFLOW].choices;
    let choice = choices.iter().position(|c| *c == model).unwrap() as i32 + 1;
    let name = CString::new("rotor").unwrap();
    let guid = CString::new(GUID).unwrap();
    let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");
    let resources = CString::new(resources).unwrap();
    let inputs = [
        real::COLLECTIVE,
        real::RPM,
        real::VELOCITY_1,
        real::VELOCITY_3,
    ]
    .map(|r| r as u32);
    let outputs = [real::THRUST, real::TORQUE, real::HUB_FORCE_1].map(|r| r as u32);
    let mut values = [0.0; 3];
    // SAFETY: the calls and their arguments are those of the standard.
    unsafe {
        let (name, guid, place) = (name.as_ptr(), guid.as_ptr(), resources.as_ptr());
        let c = fmi2Instantiate(name, FMI2_CO_SIMULATION, guid, place, ptr::null(), 0, 0);
        assert!(!c.is_null());
        let place = integer::MODEL__INFLOW as u32;
        assert_eq!(fmi2SetInteger(c, &place, 1, &choice), fmi2Status::fmi2OK);
        let place = boolean::FLAPPING__ENABLED as u32;
        assert_eq!(fmi2SetBoolean(c, &place, 1, &flaps), fmi2Status::fmi2OK);
        assert_eq!(fmi2EnterInitializationMode(c), fmi2Status::fmi2OK);
        assert_eq!(fmi2ExitInitializationMode(c), fmi2Status::fmi2OK);
        let before = COUNT.with(Cell::get);
        for i in 0..5 {
            let x = f64::from(i);
            let commands = [0.1 + 0.01 * x, 900.0 + x, 2.0 * x, 1.0];
            let status = fmi2SetReal(c, inputs.as_ptr(), inputs.len(), commands.as_ptr());
            assert_eq!(status, fmi2Status::fmi2OK);
            assert_eq!(fmi2DoStep(c, 0.01 * x, 0.01, 1), fmi2Status::fmi2OK);
            let status = fmi2GetReal(c, outputs.as_ptr(), outputs.len(), values.as_mut_ptr());
            assert_eq!(status, fmi2Status::fmi2OK);
        }
        let count = COUNT.with(Cell::get) - before;
        fmi2FreeInstance(c);
        assert!(values[0] > 0.0);
        assert_eq!(
            count, 0,
            "allocations in 5 steps of {model}, flapping {flaps}"
        );
    }
}
