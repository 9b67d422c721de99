//! A running simulation allocates no memory: not when numbers are set and read, in steps, and with
//! states and derivatives.

#![cfg(all(target_os = "linux", target_env = "gnu"))]

use crate::support::{allocations::Allocations, child};
use helicopter_rotor::{
    block::variables::{GUID, STATES, boolean, integer, real},
    fmi2::{
        co_simulation::{fmi2DoStep, fmi2SetRealInputDerivatives},
        creation::{fmi2FreeInstance, fmi2Instantiate},
        get_set::{fmi2GetReal, fmi2SetBoolean, fmi2SetInteger, fmi2SetReal},
        life_cycle::{fmi2EnterInitializationMode, fmi2ExitInitializationMode},
        model_exchange::{
            fmi2CompletedIntegratorStep, fmi2EnterContinuousTimeMode, fmi2EnterEventMode,
            fmi2GetContinuousStates, fmi2GetDerivatives, fmi2NewDiscreteStates,
            fmi2SetContinuousStates, fmi2SetTime,
        },
        types::{
            FMI2_CO_SIMULATION, FMI2_MODEL_EXCHANGE, fmi2Component, fmi2Enumeration, fmi2EventInfo,
            fmi2Status,
        },
    },
};
use std::{ffi::CString, ptr};

/// Every inflow model, with rigid and with flapping blades.
fn rotors() -> Vec<(&'static str, i32)> {
    let models = integer::MODELS__INFLOW.variable().choices.iter();
    let all = models.flat_map(|model| [(*model, 0), (*model, 1)]);
    all.filter(|rotor| *rotor != ("annulusClosedForm", 1))
        .collect()
}

const INPUTS: [u32; 4] = [
    real::COLLECTIVE.number(),
    real::RPM.number(),
    real::VELOCITY_1.number(),
    real::VELOCITY_3.number(),
];
const OUTPUTS: [u32; 3] = [
    real::THRUST.number(),
    real::TORQUE.number(),
    real::HUB_FORCE_1.number(),
];

/// An initialised instance.
fn instance(kind: fmi2Enumeration, (model, flaps): (&str, i32)) -> fmi2Component {
    let choices = integer::MODELS__INFLOW.variable().choices;
    let choice = choices.iter().position(|c| *c == model).unwrap() as i32 + 1;
    let name = CString::new("rotor").unwrap();
    let guid = CString::new(GUID).unwrap();
    let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");
    let resources = CString::new(resources).unwrap();
    // SAFETY: the calls and their arguments are those of the standard.
    unsafe {
        let (name, guid, folder) = (name.as_ptr(), guid.as_ptr(), resources.as_ptr());
        let c = fmi2Instantiate(name, kind, guid, folder, ptr::null(), 0, 0);
        assert!(!c.is_null());
        let reference = integer::MODELS__INFLOW.number();
        assert_eq!(fmi2SetInteger(c, &reference, 1, &choice), fmi2Status::Ok);
        let reference = boolean::FLAPPING__ENABLED.number();
        assert_eq!(fmi2SetBoolean(c, &reference, 1, &flaps), fmi2Status::Ok);
        assert_eq!(fmi2EnterInitializationMode(c), fmi2Status::Ok);
        assert_eq!(fmi2ExitInitializationMode(c), fmi2Status::Ok);
        c
    }
}

/// Sets inputs that depend on the number of the step.
fn set_inputs(c: fmi2Component, i: i32) -> fmi2Status {
    let x = f64::from(i);
    let commands = [0.1 + 0.01 * x, 900.0 + x, 2.0 * x, 1.0];
    // SAFETY: the instance lives, and the arrays are as long as is said.
    unsafe { fmi2SetReal(c, INPUTS.as_ptr(), INPUTS.len(), commands.as_ptr()) }
}

/// Reads a few loads and returns the thrust.
fn thrust(c: fmi2Component) -> f64 {
    let mut values = [0.0; 3];
    // SAFETY: the instance lives, and the arrays are as long as is said.
    let status = unsafe { fmi2GetReal(c, OUTPUTS.as_ptr(), OUTPUTS.len(), values.as_mut_ptr()) };
    assert_eq!(status, fmi2Status::Ok);
    values[0]
}

#[test]
fn steps_and_numbers_allocate_nothing() {
    if child::run_counting("no_allocation::steps_and_numbers_allocate_nothing").is_some() {
        return;
    }
    let allocations = Allocations::find();
    for rotor in rotors() {
        for is_moving in [false, true] {
            let c = instance(FMI2_CO_SIMULATION, rotor);
            let count = allocations.count(|| {
                for i in 0..5 {
                    assert_eq!(set_inputs(c, i), fmi2Status::Ok);
                    let (orders, slopes) = ([1; 4], [0.1, 20.0, 1.0, -1.0]);
                    let (vr, n) = (INPUTS.as_ptr(), INPUTS.len());
                    // SAFETY: the calls and their arguments are those of the standard.
                    unsafe {
                        if is_moving {
                            let (orders, slopes) = (orders.as_ptr(), slopes.as_ptr());
                            let status = fmi2SetRealInputDerivatives(c, vr, n, orders, slopes);
                            assert_eq!(status, fmi2Status::Ok);
                        }
                        let status = fmi2DoStep(c, 0.01 * f64::from(i), 0.01, 1);
                        assert_eq!(status, fmi2Status::Ok);
                    }
                    assert!(thrust(c).is_finite());
                }
            });
            // SAFETY: it lives, and is not used afterwards.
            unsafe { fmi2FreeInstance(c) };
            assert_eq!(
                count, 0,
                "allocations in 5 steps of {rotor:?}, inputs move: {is_moving}"
            );
        }
    }
}

#[test]
fn an_integration_by_the_importer_allocates_nothing() {
    if child::run_counting("no_allocation::an_integration_by_the_importer_allocates_nothing")
        .is_some()
    {
        return;
    }
    let allocations = Allocations::find();
    for rotor in rotors() {
        let c = instance(FMI2_MODEL_EXCHANGE, rotor);
        let mut info = fmi2EventInfo {
            newDiscreteStatesNeeded: 1,
            terminateSimulation: 1,
            nominalsOfContinuousStatesChanged: 1,
            valuesOfContinuousStatesChanged: 1,
            nextEventTimeDefined: 1,
            nextEventTime: 0.0,
        };
        let (mut x, mut rates) = ([0.0; STATES.len()], [0.0; STATES.len()]);
        let (mut event, mut end) = (1, 1);
        let n = STATES.len();
        let count = allocations.count(|| {
            for i in 0..5 {
                // SAFETY: the calls and their arguments are those of the standard.
                let statuses = unsafe {
                    [
                        fmi2NewDiscreteStates(c, &mut info),
                        fmi2EnterContinuousTimeMode(c),
                        fmi2GetContinuousStates(c, x.as_mut_ptr(), n),
                        fmi2GetDerivatives(c, rates.as_mut_ptr(), n),
                        fmi2SetTime(c, 1e-3 * f64::from(i + 1)),
                        set_inputs(c, i),
                        {
                            let states = x.iter_mut().zip(&rates);
                            states.for_each(|(x, rate)| *x += 1e-3 * rate);
                            fmi2SetContinuousStates(c, x.as_ptr(), n)
                        },
                        fmi2GetDerivatives(c, rates.as_mut_ptr(), n),
                        fmi2CompletedIntegratorStep(c, 1, &mut event, &mut end),
                        fmi2EnterEventMode(c),
                    ]
                };
                assert_eq!(statuses, [fmi2Status::Ok; 10]);
                assert!(thrust(c).is_finite());
            }
        });
        // SAFETY: it lives, and is not used afterwards.
        unsafe { fmi2FreeInstance(c) };
        assert_eq!(count, 0, "allocations in 5 steps of {rotor:?}");
        assert_eq!(info.newDiscreteStatesNeeded, 0);
    }
}
