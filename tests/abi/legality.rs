//! Which function may be called in which state: every function in every state that this FMU enters,
//! against the tables of the standard (FMI 2.0.5, sections 4.2.4, Co-Simulation, and 3.2.3, Model
//! Exchange).

use crate::support::{
    Instance,
    c::{self, Component, EventInfo, Functions, Status},
    instance::{bits, callbacks, reference},
};
use helicopter_rotor::block::variables::{GUID, INTEGERS, REALS, STATES as CONTINUOUS};
use std::{ffi::CString, ptr, sync::Mutex};

/// The columns of the table: the states of Co-Simulation, then those of Model Exchange.
const STATES: [&str; 9] = [
    "instantiated",
    "Initialization Mode",
    "stepComplete",
    "terminated",
    "instantiated",
    "Initialization Mode",
    "Event Mode",
    "Continuous-Time Mode",
    "terminated",
];

/// The first column of Model Exchange.
const MODEL_EXCHANGE: usize = 4;

/// One letter for each state, in the order of `STATES`:
/// `x` legal; `-` illegal; `o` legal, but an option that this FMU does not offer; `M` a function
/// of Model Exchange, `C` one of Co-Simulation.
///
/// fmi2Instantiate makes another instance, which does not depend on the state of this one.
/// fmi2SetTime in Event Mode is marked for a "Pure Discrete-Time FMU" only (condition 8 of the
/// table); it is accepted as other exporters accept it.
const TABLE: &str = "
    fmi2GetTypesPlatform              xxxx xxxxx
    fmi2GetVersion                    xxxx xxxxx
    fmi2SetDebugLogging               xxxx xxxxx
    fmi2Instantiate                   xxxx xxxxx
    fmi2FreeInstance                  xxxx xxxxx
    fmi2SetupExperiment               x--- x----
    fmi2EnterInitializationMode       x--- x----
    fmi2ExitInitializationMode        -x-- -x---
    fmi2Terminate                     --x- --xx-
    fmi2Reset                         xxxx xxxxx
    fmi2GetReal                       -xxx -xxxx
    fmi2GetInteger                    -xxx -xxxx
    fmi2GetBoolean                    -xxx -xxxx
    fmi2GetString                     -xxx -xxxx
    fmi2SetReal                       xxx- xxxx-
    fmi2SetInteger                    xxx- xxx--
    fmi2SetBoolean                    xxx- xxx--
    fmi2SetString                     xxx- xxx--
    fmi2GetFMUstate                   xxxx xxxxx
    fmi2SetFMUstate                   xxxx xxxxx
    fmi2FreeFMUstate                  xxxx xxxxx
    fmi2SerializedFMUstateSize        xxxx xxxxx
    fmi2SerializeFMUstate             xxxx xxxxx
    fmi2DeSerializeFMUstate           xxxx xxxxx
    fmi2GetDirectionalDerivative      -xxx -xxxx
    fmi2SetRealInputDerivatives       xxx- CCCCC
    fmi2GetRealOutputDerivatives      --xx CCCCC
    fmi2DoStep                        --x- CCCCC
    fmi2CancelStep                    ---- CCCCC
    fmi2GetStatus                     --xx CCCCC
    fmi2GetRealStatus                 --xx CCCCC
    fmi2GetIntegerStatus              --oo CCCCC
    fmi2GetBooleanStatus              --xx CCCCC
    fmi2GetStringStatus               --xx CCCCC
    fmi2EnterEventMode                MMMM --xx-
    fmi2NewDiscreteStates             MMMM --x--
    fmi2EnterContinuousTimeMode       MMMM --x--
    fmi2CompletedIntegratorStep       MMMM ---x-
    fmi2SetTime                       MMMM --xx-
    fmi2SetContinuousStates           MMMM ---x-
    fmi2GetDerivatives                MMMM -xxxx
    fmi2GetEventIndicators            MMMM -xxxx
    fmi2GetContinuousStates           MMMM -xxxx
    fmi2GetNominalsOfContinuousStates MMMM xxxxx
";

#[test]
fn every_function_in_every_state_answers_as_the_table_of_the_standard_says() {
    let rows: Vec<(&str, String)> = TABLE
        .lines()
        .filter_map(|line| line.trim().split_once(' '))
        .map(|(name, letters)| (name, letters.replace(' ', "")))
        .collect();
    let mut names: Vec<&str> = rows.iter().map(|(name, _)| *name).collect();
    let mut all = c::NAMES.to_vec();
    names.sort_unstable();
    all.sort_unstable();
    assert_eq!(names, all, "the table must have each function once");

    // By state: the azimuth tells whether a step was made.
    let undisturbed: Vec<_> = (0..STATES.len())
        .map(|state| finish(&in_state(state), state))
        .collect();
    for (name, letters) in rows {
        assert_eq!(letters.len(), STATES.len());
        for (state, letter) in letters.chars().enumerate() {
            let interface = if state < MODEL_EXCHANGE {
                "Co-Simulation"
            } else {
                "Model Exchange"
            };
            let cell = format!("{name} in the state {} of {interface}", STATES[state]);
            let instance = in_state(state);
            if name == "fmi2FreeInstance" {
                drop(instance); // calls it
                continue;
            }
            let status = call(name, instance.functions, instance.component);
            if letter == 'x' {
                assert_eq!((status, instance.take_log()), (c::OK, vec![]), "{cell}");
                continue;
            }
            let message = instance.refused(status);
            assert!(message.contains(name), "{cell}: {message}");
            let reason = match letter {
                '-' => STATES[state],
                'M' => "belongs to Model Exchange",
                'C' => "belongs to Co-Simulation",
                _ => "",
            };
            assert!(message.contains(reason), "{cell}: {message}");
            let illegal = message.contains("must not be called in the state");
            assert_eq!(illegal, letter == '-', "{cell}: {message}");
            assert_eq!(
                finish(&instance, state),
                undisturbed[state],
                "{cell}: the results must not change"
            );
        }
    }
}

#[test]
fn without_an_instance_every_function_refuses_and_none_crashes() {
    let instance = Instance::running();
    for name in c::NAMES {
        if !["fmi2GetTypesPlatform", "fmi2GetVersion", "fmi2Instantiate"].contains(&name) {
            let status = call(name, instance.functions, ptr::null_mut());
            let expected = if name == "fmi2FreeInstance" {
                c::OK
            } else {
                c::ERROR
            };
            assert_eq!(status, expected, "{name}");
        }
    }
}

/// A fresh instance in one of `STATES`.
fn in_state(state: usize) -> Instance<'static> {
    if state >= MODEL_EXCHANGE {
        return in_state_of_model_exchange(state - MODEL_EXCHANGE);
    }
    let instance = Instance::new();
    if state >= 1 {
        instance.begin_initialization();
    }
    if state >= 2 {
        assert_eq!(instance.exit_initialization(), c::OK);
    }
    if state >= 3 {
        assert_eq!(instance.terminate(), c::OK);
    }
    instance
}

fn in_state_of_model_exchange(state: usize) -> Instance<'static> {
    let instance = Instance::for_model_exchange();
    if state >= 1 {
        instance.begin_initialization();
    }
    if state >= 2 {
        assert_eq!(instance.exit_initialization(), c::OK);
    }
    if state >= 3 {
        assert_eq!(instance.enter_continuous_time(), c::OK);
    }
    if state >= 4 {
        assert_eq!(instance.terminate(), c::OK);
    }
    instance
}

/// Goes from a state on to the end by legal calls; all values there.
fn finish(instance: &Instance, state: usize) -> Vec<u64> {
    let (begun, last) = if state < MODEL_EXCHANGE {
        (state, 3)
    } else {
        (state - MODEL_EXCHANGE, 4)
    };
    if begun < 1 {
        instance.begin_initialization();
    }
    if begun < 2 {
        assert_eq!(instance.exit_initialization(), c::OK);
    }
    if begun < last && state < MODEL_EXCHANGE {
        assert_eq!(instance.step(0.0, 0.1), c::OK);
    }
    if begun < 3 && state >= MODEL_EXCHANGE {
        assert_eq!(instance.enter_continuous_time(), c::OK);
    }
    if begun < last && state >= MODEL_EXCHANGE {
        let mut x = instance.states();
        x[0] = 0.3;
        assert_eq!(instance.set_time(0.1) | instance.set_states(&x), c::OK);
    }
    if begun < last {
        assert_eq!(instance.terminate(), c::OK);
    }
    assert_eq!(instance.take_log(), []);
    bits(&instance.reals())
}

/// Calls a function that takes a state with one that the instance made just before.
fn with_state(name: &str, f: &Functions, c: Component) -> Status {
    let (mut state, mut size) = (ptr::null_mut(), 0);
    // SAFETY: `c` is null or a living instance; all pointers are valid for the counts given.
    unsafe {
        if c.is_null() {
            let answers = [
                (f.fmi2SetFMUstate)(c, state),
                (f.fmi2SerializedFMUstateSize)(c, state, &mut size),
                (f.fmi2SerializeFMUstate)(c, state, ptr::null_mut(), 0),
                (f.fmi2DeSerializeFMUstate)(c, ptr::null(), 0, &mut state),
            ];
            assert_eq!(answers, [c::ERROR; 4]);
            return c::ERROR;
        }
        assert_eq!((f.fmi2GetFMUstate)(c, &mut state), c::OK);
        assert_eq!((f.fmi2SerializedFMUstateSize)(c, state, &mut size), c::OK);
        let mut bytes = vec![0; size];
        let out = bytes.as_mut_ptr();
        assert_eq!((f.fmi2SerializeFMUstate)(c, state, out, size), c::OK);
        let status = match name {
            "fmi2SetFMUstate" => (f.fmi2SetFMUstate)(c, state),
            "fmi2DeSerializeFMUstate" => (f.fmi2DeSerializeFMUstate)(c, out, size, &mut state),
            _ => c::OK,
        };
        assert_eq!((f.fmi2FreeFMUstate)(c, &mut state), c::OK);
        status
    }
}

/// Calls a function with harmless arguments, or frees nothing. Where it answers no status, 0 says
/// that its answer is good.
fn call(name: &str, f: &Functions, c: Component) -> Status {
    let first = [0];
    let blades = reference(&INTEGERS, "geometry.numberOfBlades");
    let thrust = reference(&REALS, "thrust");
    let (mut real, mut integer, mut text) = ([REALS[0].start], [4], [ptr::null()]);
    let empty = [c"".as_ptr()];
    let mut state = ptr::null_mut();
    let (mut x0, nx) = ([0.0; CONTINUOUS.len()], CONTINUOUS.len());
    let x0 = x0.as_mut_ptr();
    let mut info = EventInfo::default();
    let mut flag = [0, 0];
    let (r, n) = (first.as_ptr(), 1);
    let (x, i) = (real.as_mut_ptr(), integer.as_mut_ptr());
    // SAFETY: `c` is null or a living instance; all pointers are valid for the counts given.
    unsafe {
        match name {
            "fmi2GetTypesPlatform" => (f.fmi2GetTypesPlatform)().is_null().into(),
            "fmi2GetVersion" => (f.fmi2GetVersion)().is_null().into(),
            "fmi2Instantiate" => instantiate_another(f),
            "fmi2FreeInstance" => {
                assert!(c.is_null(), "an instance is freed by its owner");
                (f.fmi2FreeInstance)(c);
                c::OK
            }
            "fmi2SetDebugLogging" => (f.fmi2SetDebugLogging)(c, 1, 0, ptr::null()),
            "fmi2SetupExperiment" => (f.fmi2SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0),
            "fmi2EnterInitializationMode" => (f.fmi2EnterInitializationMode)(c),
            "fmi2ExitInitializationMode" => (f.fmi2ExitInitializationMode)(c),
            "fmi2Terminate" => (f.fmi2Terminate)(c),
            "fmi2Reset" => (f.fmi2Reset)(c),
            "fmi2GetReal" => (f.fmi2GetReal)(c, r, n, x),
            "fmi2GetInteger" => (f.fmi2GetInteger)(c, r, n, i),
            "fmi2GetBoolean" => (f.fmi2GetBoolean)(c, r, n, flag.as_mut_ptr()),
            "fmi2GetString" => (f.fmi2GetString)(c, r, n, text.as_mut_ptr()),
            "fmi2SetReal" => (f.fmi2SetReal)(c, r, n, x),
            "fmi2SetInteger" => (f.fmi2SetInteger)(c, &blades, n, i),
            "fmi2SetBoolean" => (f.fmi2SetBoolean)(c, r, n, flag.as_ptr()),
            "fmi2SetString" => (f.fmi2SetString)(c, r, n, empty.as_ptr()),
            "fmi2GetFMUstate" => {
                let status = (f.fmi2GetFMUstate)(c, &mut state);
                (f.fmi2FreeFMUstate)(c, &mut state);
                status
            }
            "fmi2FreeFMUstate" => (f.fmi2FreeFMUstate)(c, &mut state),
            "fmi2SetFMUstate"
            | "fmi2SerializedFMUstateSize"
            | "fmi2SerializeFMUstate"
            | "fmi2DeSerializeFMUstate" => with_state(name, f, c),
            "fmi2GetDirectionalDerivative" => {
                (f.fmi2GetDirectionalDerivative)(c, &thrust, n, r, n, [1.0].as_ptr(), x)
            }
            "fmi2EnterEventMode" => (f.fmi2EnterEventMode)(c),
            "fmi2NewDiscreteStates" => (f.fmi2NewDiscreteStates)(c, &mut info),
            "fmi2EnterContinuousTimeMode" => (f.fmi2EnterContinuousTimeMode)(c),
            "fmi2CompletedIntegratorStep" => {
                let [event, end] = &mut flag;
                (f.fmi2CompletedIntegratorStep)(c, 1, event, end)
            }
            "fmi2SetTime" => (f.fmi2SetTime)(c, 0.0),
            "fmi2SetContinuousStates" => (f.fmi2SetContinuousStates)(c, x0, nx),
            "fmi2GetDerivatives" => (f.fmi2GetDerivatives)(c, x0, nx),
            "fmi2GetEventIndicators" => (f.fmi2GetEventIndicators)(c, x, 0),
            "fmi2GetContinuousStates" => (f.fmi2GetContinuousStates)(c, x0, nx),
            "fmi2GetNominalsOfContinuousStates" => (f.fmi2GetNominalsOfContinuousStates)(c, x0, nx),
            "fmi2SetRealInputDerivatives" => {
                (f.fmi2SetRealInputDerivatives)(c, r, n, [1].as_ptr(), x)
            }
            "fmi2GetRealOutputDerivatives" => {
                (f.fmi2GetRealOutputDerivatives)(c, &thrust, n, [1].as_ptr(), x)
            }
            "fmi2DoStep" => (f.fmi2DoStep)(c, 0.0, 0.1, 1),
            "fmi2CancelStep" => (f.fmi2CancelStep)(c),
            "fmi2GetStatus" => (f.fmi2GetStatus)(c, c::DO_STEP_STATUS, i),
            "fmi2GetRealStatus" => (f.fmi2GetRealStatus)(c, c::LAST_SUCCESSFUL_TIME, x),
            // No kind of status is an Integer.
            "fmi2GetIntegerStatus" => (f.fmi2GetIntegerStatus)(c, c::DO_STEP_STATUS, i),
            "fmi2GetBooleanStatus" => (f.fmi2GetBooleanStatus)(c, c::TERMINATED, i),
            "fmi2GetStringStatus" => {
                (f.fmi2GetStringStatus)(c, c::PENDING_STATUS, text.as_mut_ptr())
            }
            _ => panic!("no call of {name}"),
        }
    }
}

fn instantiate_another(f: &Functions) -> Status {
    let (log, guid) = (Mutex::default(), CString::new(GUID).unwrap());
    let (name, nowhere) = (c"another".as_ptr(), ptr::null());
    let callbacks = callbacks(&log);
    // SAFETY: the pointers are null or valid during the call; the instance is freed at once.
    unsafe {
        let another = (f.fmi2Instantiate)(
            name,
            c::CO_SIMULATION,
            guid.as_ptr(),
            nowhere,
            &callbacks,
            0,
            0,
        );
        (f.fmi2FreeInstance)(another);
        if another.is_null() { c::ERROR } else { c::OK }
    }
}
