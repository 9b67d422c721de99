//! Which function may be called in which state: every function in every state that this FMU enters,
//! against the sections of the standard (FMI 3.0.2, sections 2.3, 3.2 and 4.2).

use crate::support::{
    Fmu, Instance3,
    c::{self, Status},
    c3::{self, Functions},
    instance3::{Creation3, Kind, OnUpdate, Update, variable},
};
use helicopter_rotor::block::variables::STATES as CONTINUOUS;
use std::{cell::RefCell, ptr, rc::Rc};

/// The columns of the table: the states of Co-Simulation, then those of Model Exchange.
const STATES: [&str; 12] = [
    "instantiated",
    "Initialization Mode",
    "Event Mode",
    "Step Mode",
    "Intermediate Update Mode where inputs are asked for",
    "Intermediate Update Mode where outputs may be read",
    "terminated",
    "instantiated",
    "Initialization Mode",
    "Event Mode",
    "Continuous-Time Mode",
    "terminated",
];

/// The first column of Model Exchange.
const MODEL_EXCHANGE: usize = 7;
const INTERMEDIATE: [usize; 2] = [4, 5];

/// One letter for each state, in the order of `STATES`:
/// `x` legal; `-` illegal; `o` legal, but not offered by this FMU; `l` not in the standard's list
/// and accepted nevertheless, as `src/fmi3/legality.rs` says; `M` a function of Model Exchange, `C`
/// one of Co-Simulation, `S` one of Scheduled Execution, `P` one for structural parameters.
///
/// The functions that make instances do not depend on the state of this one. During an intermediate
/// update this FMU is stricter than the standard.
const TABLE: &str = "
    fmi3GetVersion                      xxxxxxx xxxxx
    fmi3SetDebugLogging                 xxxxxxx xxxxx
    fmi3InstantiateModelExchange        xxxxxxx xxxxx
    fmi3InstantiateCoSimulation         xxxxxxx xxxxx
    fmi3InstantiateScheduledExecution   xxxxxxx xxxxx
    fmi3FreeInstance                    xxxx--x xxxxx
    fmi3EnterInitializationMode         x------ x----
    fmi3ExitInitializationMode          -x----- -x---
    fmi3EnterEventMode                  ---x--- ---x-
    fmi3Terminate                       --xx--- --xx-
    fmi3Reset                           xxxx--x xxxxx
    fmi3GetFloat32                      oooo--o ooooo
    fmi3GetFloat64                      xxxx-xx xxxxx
    fmi3GetInt8                         oooo--o ooooo
    fmi3GetUInt8                        oooo--o ooooo
    fmi3GetInt16                        oooo--o ooooo
    fmi3GetUInt16                       oooo--o ooooo
    fmi3GetInt32                        xxxx--x xxxxx
    fmi3GetUInt32                       oooo--o ooooo
    fmi3GetInt64                        xxxx--x xxxxx
    fmi3GetUInt64                       oooo--o ooooo
    fmi3GetBoolean                      xxxx--x xxxxx
    fmi3GetString                       xxxx--x xxxxx
    fmi3GetBinary                       oooo--o ooooo
    fmi3GetClock                        --o---- --o--
    fmi3SetFloat32                      oooo--- oooo-
    fmi3SetFloat64                      xxxxx-- xxxx-
    fmi3SetInt8                         oooo--- ooo--
    fmi3SetUInt8                        oooo--- ooo--
    fmi3SetInt16                        oooo--- ooo--
    fmi3SetUInt16                       oooo--- ooo--
    fmi3SetInt32                        xxxx--- xxx--
    fmi3SetUInt32                       oooo--- ooo--
    fmi3SetInt64                        xxxx--- xxx--
    fmi3SetUInt64                       oooo--- ooo--
    fmi3SetBoolean                      xxxx--- xxx--
    fmi3SetString                       xxxx--- xxx--
    fmi3SetBinary                       oooo--- ooo--
    fmi3SetClock                        --o---- --o--
    fmi3GetNumberOfVariableDependencies xxxx--x xxxxx
    fmi3GetVariableDependencies         xxxx--x xxxxx
    fmi3GetFMUState                     xxxx--x xxxxx
    fmi3SetFMUState                     xxxx--x xxxxx
    fmi3FreeFMUState                    xxxx--x xxxxx
    fmi3SerializedFMUStateSize          xxxx--x xxxxx
    fmi3SerializeFMUState               xxxx--x xxxxx
    fmi3DeserializeFMUState             xxxx--x xxxxx
    fmi3GetDirectionalDerivative        -xxx--x -xxxx
    fmi3GetAdjointDerivative            -xxx--x -xxxx
    fmi3EnterConfigurationMode          PPPPPPP PPPPP
    fmi3ExitConfigurationMode           PPPPPPP PPPPP
    fmi3GetIntervalDecimal              -oo---- -oo--
    fmi3GetIntervalFraction             -oo---- -oo--
    fmi3GetShiftDecimal                 -o----- -o---
    fmi3GetShiftFraction                -o----- -o---
    fmi3SetIntervalDecimal              -oo---- -oo--
    fmi3SetIntervalFraction             -oo---- -oo--
    fmi3SetShiftDecimal                 -o----- -o---
    fmi3SetShiftFraction                -o----- -o---
    fmi3EvaluateDiscreteStates          --o---- --o--
    fmi3UpdateDiscreteStates            --x---- --x--
    fmi3EnterContinuousTimeMode         MMMMMMM --x--
    fmi3CompletedIntegratorStep         MMMMMMM ---x-
    fmi3SetTime                         MMMMMMM --lx-
    fmi3SetContinuousStates             MMMMMMM ---x-
    fmi3GetContinuousStateDerivatives   MMMMMMM -xxxx
    fmi3GetEventIndicators              MMMMMMM -xxxx
    fmi3GetContinuousStates             MMMMMMM -xxxx
    fmi3GetNominalsOfContinuousStates   MMMMMMM -xxxx
    fmi3GetNumberOfEventIndicators      MMMMMMM xlxll
    fmi3GetNumberOfContinuousStates     MMMMMMM xlxll
    fmi3EnterStepMode                   --x---- CCCCC
    fmi3GetOutputDerivatives            ---x-xx CCCCC
    fmi3DoStep                          ---x--- CCCCC
    fmi3ActivateModelPartition          SSSSSSS SSSSS
";

#[test]
fn every_function_in_every_state_answers_as_the_standard_says() {
    let rows: Vec<(&'static str, String)> = TABLE
        .lines()
        .filter_map(|line| line.trim().split_once(' '))
        .map(|(name, letters)| (name, letters.replace(' ', "")))
        .collect();
    let mut names: Vec<&str> = rows.iter().map(|(name, _)| *name).collect();
    let mut all = c3::NAMES.to_vec();
    names.sort_unstable();
    all.sort_unstable();
    assert_eq!(names, all, "the table must have each function once");

    for (name, letters) in rows {
        assert_eq!(letters.len(), STATES.len(), "{name}");
        for (state, letter) in letters.chars().enumerate() {
            let check: Check = Rc::new(move |instance: &Instance3| {
                answers(instance, name, state, letter);
            });
            if INTERMEDIATE.contains(&state) {
                during_an_update(state, check);
                continue;
            }
            let instance = in_state(state);
            if name == "fmi3FreeInstance" {
                drop(instance); // calls it
                continue;
            }
            let before = instance.serialized();
            check(&instance);
            if !['x', 'l'].contains(&letter) {
                assert_eq!(
                    instance.serialized(),
                    before,
                    "{name} has changed something"
                );
            }
        }
    }
}

type Check = Rc<dyn Fn(&Instance3)>;

/// Asserts that a call of a function is answered as its letter says.
fn answers(instance: &Instance3, name: &str, state: usize, letter: char) {
    let interface = if state < MODEL_EXCHANGE {
        "Co-Simulation"
    } else {
        "Model Exchange"
    };
    let cell = format!("{name} in {} of {interface}", STATES[state]);
    let saved = Saved::new(kind_of(state));
    let status = call(name, instance.functions, instance.pointer, Some(&saved));
    if ['x', 'l'].contains(&letter) {
        assert_eq!((status, instance.take_log()), (c::OK, vec![]), "{cell}");
        return;
    }
    if name == "fmi3FreeInstance" {
        assert_eq!(instance.take_log().len(), 1, "{cell}");
        return;
    }
    let message = instance.refused(status);
    assert!(message.starts_with(name), "{cell}: {message}");
    let reason = match letter {
        '-' => STATES[state],
        'M' => "belongs to Model Exchange",
        'C' => "belongs to Co-Simulation",
        'S' => "Scheduled Execution",
        'P' => "structural parameters",
        _ => "",
    };
    assert!(message.contains(reason), "{cell}: {message}");
    let illegal = message.contains("must not be called in the state");
    assert_eq!(illegal, letter == '-', "{cell}: {message}");
}

#[test]
fn without_an_instance_every_function_refuses_and_none_crashes() {
    let f = &Fmu::shared().of_fmi3;
    for name in c3::NAMES {
        let is_free = ["fmi3GetVersion", "fmi3FreeInstance"].contains(&name)
            || name.starts_with("fmi3Instantiate");
        let expected = if is_free { c::OK } else { c::ERROR };
        assert_eq!(call(name, f, ptr::null_mut(), None), expected, "{name}");
    }
}

fn kind_of(state: usize) -> Kind {
    if state < MODEL_EXCHANGE {
        Kind::CoSimulation
    } else {
        Kind::ModelExchange
    }
}

/// A fresh instance in one of `STATES`, with a message for nothing but errors.
fn in_state(state: usize) -> Instance3 {
    let kind = kind_of(state);
    let creation = Creation3 {
        kind,
        event_mode: true,
        ..Creation3::default()
    };
    let instance = creation.make().unwrap();
    let f = instance.functions;
    // SAFETY: the instance lives.
    unsafe {
        let events = c"logEvents".as_ptr();
        instance.ok((f.fmi3SetDebugLogging)(instance.pointer, 0, 1, &events));
    }
    let place = match kind {
        // The same numbers as in Co-Simulation, without those of intermediate updates.
        Kind::ModelExchange => [0, 1, 2, 3, 6][state - MODEL_EXCHANGE],
        _ => state,
    };
    if place >= 1 {
        instance.begin_initialization();
    }
    if place >= 2 {
        instance.exit_initialization();
    }
    if place >= 3 {
        match kind {
            Kind::ModelExchange => instance.enter_continuous_time(),
            _ => instance.enter_step_mode(),
        }
    }
    if place == 6 {
        // SAFETY: the instance lives.
        instance.ok(unsafe { (f.fmi3Terminate)(instance.pointer) });
    }
    instance
}

/// Checks a function while a step asks for inputs or lets outputs be read.
fn during_an_update(state: usize, check: Check) {
    let creation = Creation3 {
        required: vec!["collective", "thrust"],
        has_callback: true,
        ..Creation3::default()
    };
    let instance = creation.make().unwrap();
    instance.initialize();
    instance.take_log();
    let count = Rc::new(RefCell::new(0));
    let calls = Rc::clone(&count);
    let on_update: OnUpdate = Box::new(move |instance: &Instance3, update: Update| {
        if update.asks_for_inputs == (state == INTERMEDIATE[0]) {
            check(instance);
            *calls.borrow_mut() += 1;
        }
        None
    });
    let (status, stepped) = instance.step_with(0.0, 0.01, Some(on_update));
    instance.ok(status);
    assert_eq!((*count.borrow(), stepped.time), (1, 0.01));
}

/// A state of a fresh instance for an interface, and its bytes.
struct Saved {
    donor: Instance3,
    pointer: c::FmuState,
    bytes: Vec<u8>,
}

impl Saved {
    fn new(kind: Kind) -> Self {
        let creation = Creation3 {
            kind,
            ..Creation3::default()
        };
        let donor = creation.make().unwrap();
        let mut pointer = ptr::null_mut();
        // SAFETY: the instance lives.
        donor.ok(unsafe { (donor.functions.fmi3GetFMUState)(donor.pointer, &mut pointer) });
        Self {
            pointer,
            bytes: donor.serialized(),
            donor,
        }
    }
}

impl Drop for Saved {
    fn drop(&mut self) {
        let free = self.donor.functions.fmi3FreeFMUState;
        // SAFETY: the instance and the state live.
        self.donor
            .ok(unsafe { free(self.donor.pointer, &mut self.pointer) });
    }
}

/// Calls a function with harmless arguments, or frees nothing. Where it answers no status, 0 says
/// that its answer is good.
fn call(name: &str, f: &Functions, p: c3::Instance, saved: Option<&Saved>) -> Status {
    let [collective, thrust, blades] =
        ["collective", "thrust", "geometry.numberOfBlades"].map(|n| variable(n).reference);
    let [inflow, flaps, settings] =
        ["models.inflow", "flapping.enabled", "settings"].map(|n| variable(n).reference);
    let reference = &collective;
    let (mut x, mut i, mut l, mut b) = ([0.125], [4], [2], [0_u8; 6]);
    let (mut small, mut t) = ([0_u64; 2], [c"".as_ptr()]);
    let (mut states, nx) = ([0.0; CONTINUOUS.len()], CONTINUOUS.len());
    let (mut size, mut sizes, mut binary) = (0, [0], [ptr::null()]);
    let mut new_state = ptr::null_mut();
    let state = saved.map_or(ptr::null_mut(), |saved| saved.pointer);
    let bytes = saved.map_or(&[][..], |saved| &saved.bytes);
    let mut room = vec![0; bytes.len()];
    let (x, i, l) = (x.as_mut_ptr(), i.as_mut_ptr(), l.as_mut_ptr());
    let (states, small) = (states.as_mut_ptr(), small.as_mut_ptr());
    let [b0, b1, b2, b3, b4, _] = b.each_mut().map(|b| b as *mut u8);
    // SAFETY: `p` is null or a living instance; all pointers are valid for the counts given.
    unsafe {
        match name {
            "fmi3GetVersion" => (f.fmi3GetVersion)().is_null().into(),
            "fmi3InstantiateModelExchange" => {
                drop(Instance3::for_model_exchange());
                c::OK
            }
            "fmi3InstantiateCoSimulation" => {
                drop(Instance3::new());
                c::OK
            }
            "fmi3InstantiateScheduledExecution" => {
                let creation = Creation3 {
                    kind: Kind::ScheduledExecution,
                    ..Creation3::default()
                };
                creation.make().is_ok().into()
            }
            "fmi3FreeInstance" => {
                (f.fmi3FreeInstance)(p);
                c::OK
            }
            // With the same choice as before.
            "fmi3SetDebugLogging" => (f.fmi3SetDebugLogging)(p, 0, 1, &c"logEvents".as_ptr()),
            "fmi3EnterInitializationMode" => {
                (f.fmi3EnterInitializationMode)(p, 0, 0.0, 0.0, 0, 0.0)
            }
            "fmi3ExitInitializationMode" => (f.fmi3ExitInitializationMode)(p),
            "fmi3EnterEventMode" => (f.fmi3EnterEventMode)(p),
            "fmi3Terminate" => (f.fmi3Terminate)(p),
            "fmi3Reset" => (f.fmi3Reset)(p),
            "fmi3GetFloat32" => (f.fmi3GetFloat32)(p, reference, 1, small.cast(), 1),
            "fmi3GetFloat64" => (f.fmi3GetFloat64)(p, &thrust, 1, x, 1),
            "fmi3GetInt8" => (f.fmi3GetInt8)(p, reference, 1, small.cast(), 1),
            "fmi3GetUInt8" => (f.fmi3GetUInt8)(p, reference, 1, small.cast(), 1),
            "fmi3GetInt16" => (f.fmi3GetInt16)(p, reference, 1, small.cast(), 1),
            "fmi3GetUInt16" => (f.fmi3GetUInt16)(p, reference, 1, small.cast(), 1),
            "fmi3GetInt32" => (f.fmi3GetInt32)(p, &blades, 1, i, 1),
            "fmi3GetUInt32" => (f.fmi3GetUInt32)(p, reference, 1, small.cast(), 1),
            "fmi3GetInt64" => (f.fmi3GetInt64)(p, &inflow, 1, l, 1),
            "fmi3GetUInt64" => (f.fmi3GetUInt64)(p, reference, 1, small, 1),
            "fmi3GetBoolean" => (f.fmi3GetBoolean)(p, &flaps, 1, b0, 1),
            "fmi3GetString" => (f.fmi3GetString)(p, &settings, 1, t.as_mut_ptr(), 1),
            "fmi3GetBinary" => {
                let (sizes, values) = (sizes.as_mut_ptr(), binary.as_mut_ptr());
                (f.fmi3GetBinary)(p, reference, 1, sizes, values, 1)
            }
            "fmi3GetClock" => (f.fmi3GetClock)(p, reference, 1, b0),
            "fmi3SetFloat32" => (f.fmi3SetFloat32)(p, reference, 1, small.cast(), 1),
            "fmi3SetFloat64" => (f.fmi3SetFloat64)(p, reference, 1, x, 1),
            "fmi3SetInt8" => (f.fmi3SetInt8)(p, reference, 1, small.cast(), 1),
            "fmi3SetUInt8" => (f.fmi3SetUInt8)(p, reference, 1, small.cast(), 1),
            "fmi3SetInt16" => (f.fmi3SetInt16)(p, reference, 1, small.cast(), 1),
            "fmi3SetUInt16" => (f.fmi3SetUInt16)(p, reference, 1, small.cast(), 1),
            "fmi3SetInt32" => (f.fmi3SetInt32)(p, &blades, 1, i, 1),
            "fmi3SetUInt32" => (f.fmi3SetUInt32)(p, reference, 1, small.cast(), 1),
            "fmi3SetInt64" => (f.fmi3SetInt64)(p, &inflow, 1, l, 1),
            "fmi3SetUInt64" => (f.fmi3SetUInt64)(p, reference, 1, small, 1),
            "fmi3SetBoolean" => (f.fmi3SetBoolean)(p, &flaps, 1, b0, 1),
            "fmi3SetString" => (f.fmi3SetString)(p, &settings, 1, t.as_ptr(), 1),
            "fmi3SetBinary" => {
                (f.fmi3SetBinary)(p, reference, 1, sizes.as_ptr(), binary.as_ptr(), 1)
            }
            "fmi3SetClock" => (f.fmi3SetClock)(p, reference, 1, b0),
            "fmi3GetNumberOfVariableDependencies" => {
                (f.fmi3GetNumberOfVariableDependencies)(p, collective, &mut size)
            }
            "fmi3GetVariableDependencies" => {
                let (none, refs) = (ptr::null_mut(), ptr::null_mut());
                let kinds = ptr::null_mut();
                (f.fmi3GetVariableDependencies)(p, collective, none, refs, none, kinds, 0)
            }
            "fmi3GetFMUState" => {
                let status = (f.fmi3GetFMUState)(p, &mut new_state);
                if status == c::OK {
                    (f.fmi3FreeFMUState)(p, &mut new_state);
                }
                status
            }
            "fmi3SetFMUState" => (f.fmi3SetFMUState)(p, state),
            "fmi3FreeFMUState" => (f.fmi3FreeFMUState)(p, &mut new_state),
            "fmi3SerializedFMUStateSize" => (f.fmi3SerializedFMUStateSize)(p, state, &mut size),
            "fmi3SerializeFMUState" => {
                (f.fmi3SerializeFMUState)(p, state, room.as_mut_ptr(), room.len())
            }
            "fmi3DeserializeFMUState" => {
                let (bytes, n) = (bytes.as_ptr(), bytes.len());
                let status = (f.fmi3DeserializeFMUState)(p, bytes, n, &mut new_state);
                if status == c::OK {
                    (f.fmi3FreeFMUState)(p, &mut new_state);
                }
                status
            }
            "fmi3GetDirectionalDerivative" => {
                (f.fmi3GetDirectionalDerivative)(p, &thrust, 1, reference, 1, x, 1, x, 1)
            }
            "fmi3GetAdjointDerivative" => {
                (f.fmi3GetAdjointDerivative)(p, &thrust, 1, reference, 1, x, 1, x, 1)
            }
            "fmi3EnterConfigurationMode" => (f.fmi3EnterConfigurationMode)(p),
            "fmi3ExitConfigurationMode" => (f.fmi3ExitConfigurationMode)(p),
            "fmi3GetIntervalDecimal" => (f.fmi3GetIntervalDecimal)(p, reference, 1, x, i),
            "fmi3GetIntervalFraction" => {
                (f.fmi3GetIntervalFraction)(p, reference, 1, small, small.add(1), i)
            }
            "fmi3GetShiftDecimal" => (f.fmi3GetShiftDecimal)(p, reference, 1, x),
            "fmi3GetShiftFraction" => {
                (f.fmi3GetShiftFraction)(p, reference, 1, small, small.add(1))
            }
            "fmi3SetIntervalDecimal" => (f.fmi3SetIntervalDecimal)(p, reference, 1, x),
            "fmi3SetIntervalFraction" => (f.fmi3SetIntervalFraction)(p, reference, 1, small, small),
            "fmi3SetShiftDecimal" => (f.fmi3SetShiftDecimal)(p, reference, 1, x),
            "fmi3SetShiftFraction" => (f.fmi3SetShiftFraction)(p, reference, 1, small, small),
            "fmi3EvaluateDiscreteStates" => (f.fmi3EvaluateDiscreteStates)(p),
            "fmi3UpdateDiscreteStates" => (f.fmi3UpdateDiscreteStates)(p, b0, b1, b2, b3, b4, x),
            "fmi3EnterContinuousTimeMode" => (f.fmi3EnterContinuousTimeMode)(p),
            "fmi3CompletedIntegratorStep" => (f.fmi3CompletedIntegratorStep)(p, 1, b0, b1),
            "fmi3SetTime" => (f.fmi3SetTime)(p, 0.0),
            "fmi3SetContinuousStates" => (f.fmi3SetContinuousStates)(p, states, nx),
            "fmi3GetContinuousStateDerivatives" => {
                (f.fmi3GetContinuousStateDerivatives)(p, states, nx)
            }
            "fmi3GetEventIndicators" => (f.fmi3GetEventIndicators)(p, x, 0),
            "fmi3GetContinuousStates" => (f.fmi3GetContinuousStates)(p, states, nx),
            "fmi3GetNominalsOfContinuousStates" => {
                (f.fmi3GetNominalsOfContinuousStates)(p, states, nx)
            }
            "fmi3GetNumberOfEventIndicators" => (f.fmi3GetNumberOfEventIndicators)(p, &mut size),
            "fmi3GetNumberOfContinuousStates" => (f.fmi3GetNumberOfContinuousStates)(p, &mut size),
            "fmi3EnterStepMode" => (f.fmi3EnterStepMode)(p),
            "fmi3GetOutputDerivatives" => (f.fmi3GetOutputDerivatives)(p, &thrust, 1, &1, x, 1),
            "fmi3DoStep" => (f.fmi3DoStep)(p, 0.0, 0.01, 1, b0, b1, b2, x),
            "fmi3ActivateModelPartition" => (f.fmi3ActivateModelPartition)(p, collective, 0.0),
            _ => panic!("no call of {name}"),
        }
    }
}
