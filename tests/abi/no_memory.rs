//! Where an allocation fails, the call fails with a sentence or succeeds, and the importer lives.
//! In the way of curl's "torture tests" each allocation of a run fails once.

#![cfg(all(target_os = "linux", target_env = "gnu"))]

use crate::support::{
    Fmu,
    allocations::Allocations,
    c::{self, Component, FmuState, Functions, Reference, Status},
    child,
    fmu::uri,
    instance::{logger, reference},
};
use helicopter_rotor::block::variables::{
    BOOLEANS, GUID, INSTANTIATION_TOKEN, INTEGERS, REALS, STRINGS,
};
use std::{
    ffi::{CStr, CString, c_void},
    ptr,
    sync::atomic::{AtomicU32, Ordering},
};

/// Messages of errors, and those of them that speak of memory.
static ERRORS: AtomicU32 = AtomicU32::new(0);
static ABOUT_MEMORY: AtomicU32 = AtomicU32::new(0);

/// Counts messages without an allocation.
unsafe extern "C" fn count(
    _: *mut c_void,
    _: c::Text,
    status: Status,
    _: c::Text,
    message: c::Text,
) {
    if status == c::ERROR {
        ERRORS.fetch_add(1, Ordering::Relaxed);
        // SAFETY: the string lives during the call.
        let message = unsafe { CStr::from_ptr(message) }.to_bytes();
        let says = |part: &[u8]| message.windows(part.len()).any(|w| w == part);
        if says(b"emory") {
            ABOUT_MEMORY.fetch_add(1, Ordering::Relaxed);
        }
    }
}

/// What the importer has allocated before.
struct Importer<'a> {
    f: &'a Functions,
    callbacks: c::Callbacks,
    guid: CString,
    resources: CString,
    /// For a model, with flapping; names an airfoil file.
    settings: CString,
    airfoil: CString,
}

/// An instance on its way, the number of the call that failed, and what was seen at the end.
struct Run {
    component: Component,
    state: FmuState,
    bytes: [std::ffi::c_char; 1 << 16],
    size: usize,
    seen: [u64; REALS.len()],
}

impl Importer<'_> {
    /// Call number `step` of a run; none after the last.
    fn call(&self, run: &mut Run, step: usize) -> Option<Status> {
        let (f, c) = (self.f, run.component);
        let reference = |number: &Reference| ptr::from_ref(number);
        let strings = ["airfoil.file", "settings"].map(|n| self::reference(&STRINGS, n));
        let flaps = self::reference(&BOOLEANS, "flapping.enabled");
        let inflow = self::reference(&INTEGERS, "models.inflow");
        let collective = self::reference(&REALS, "collective");
        let thrust = self::reference(&REALS, "thrust");
        let mut value = 0.0;
        let mut text = ptr::null();
        // SAFETY: the calls and their arguments are those of the standard.
        unsafe {
            Some(match step {
                0 => {
                    let (name, guid) = (c"rotor".as_ptr(), self.guid.as_ptr());
                    let folder = self.resources.as_ptr();
                    let kind = c::CO_SIMULATION;
                    run.component =
                        (f.fmi2Instantiate)(name, kind, guid, folder, &self.callbacks, 0, 1);
                    if run.component.is_null() {
                        c::ERROR
                    } else {
                        c::OK
                    }
                }
                1 => (f.fmi2SetString)(c, &strings[0], 1, &self.airfoil.as_ptr()),
                2 => (f.fmi2SetString)(c, &strings[1], 1, &self.settings.as_ptr()),
                3 => (f.fmi2SetInteger)(c, reference(&inflow), 1, &12),
                4 => (f.fmi2SetBoolean)(c, reference(&flaps), 1, &1),
                5 => (f.fmi2SetReal)(c, reference(&collective), 1, &0.12),
                6 => (f.fmi2SetupExperiment)(c, 0, 0.0, 0.0, 0, 0.0),
                7 => (f.fmi2EnterInitializationMode)(c),
                8 => (f.fmi2GetReal)(c, reference(&thrust), 1, &mut value),
                9 => (f.fmi2GetString)(c, &strings[0], 1, &mut text),
                10 => (f.fmi2ExitInitializationMode)(c),
                11 => (f.fmi2DoStep)(c, 0.0, 0.01, 1),
                12 => {
                    let (known, unknown) = (reference(&collective), reference(&thrust));
                    let get = f.fmi2GetDirectionalDerivative;
                    get(c, unknown, 1, known, 1, &1.0, &mut value)
                }
                13 => (f.fmi2GetFMUstate)(c, &mut run.state),
                14 => (f.fmi2SerializedFMUstateSize)(c, run.state, &mut run.size),
                15 => {
                    let bytes = run.bytes.as_mut_ptr();
                    (f.fmi2SerializeFMUstate)(c, run.state, bytes, run.size)
                }
                16 => (f.fmi2FreeFMUstate)(c, &mut run.state),
                17 => (f.fmi2Reset)(c),
                18 => {
                    let bytes = run.bytes.as_ptr();
                    (f.fmi2DeSerializeFMUstate)(c, bytes, run.size, &mut run.state)
                }
                19 => (f.fmi2SetFMUstate)(c, run.state),
                20 => (f.fmi2SetFMUstate)(c, run.state),
                // An input out of range, for a warning.
                21 => (f.fmi2SetReal)(c, reference(&collective), 1, &9.0),
                22 => (f.fmi2DoStep)(c, 0.01, 0.01, 1),
                23 => (f.fmi2FreeFMUstate)(c, &mut run.state),
                24 => {
                    let all: [Reference; REALS.len()] = core::array::from_fn(|i| i as Reference);
                    let mut values = [0.0; REALS.len()];
                    let status = (f.fmi2GetReal)(c, all.as_ptr(), all.len(), values.as_mut_ptr());
                    run.seen = values.map(f64::to_bits);
                    status
                }
                25 => {
                    (f.fmi2FreeInstance)(c);
                    run.component = ptr::null_mut();
                    c::OK
                }
                _ => return None,
            })
        }
    }

    /// A run in which allocation number `failing` of call number `at` fails. A call that fails is
    /// repeated with memory. Returns what was seen at the end, and whether that call failed.
    fn run(&self, tool: &Allocations, at: usize, failing: i64, all: bool) -> (Run, i64, bool) {
        let mut run = Run {
            component: ptr::null_mut(),
            state: ptr::null_mut(),
            bytes: [0; 1 << 16],
            size: 0,
            seen: [0; REALS.len()],
        };
        let (mut count, mut failed) = (0, false);
        for step in 0.. {
            let first = if step == at { failing } else { 0 };
            let (status, done) = tool.fail(first, all, || self.call(&mut run, step));
            let Some(status) = status else { break };
            if step == at {
                count = done;
                failed = status != c::OK;
                if failed {
                    let errors = ERRORS.swap(0, Ordering::Relaxed);
                    let about_memory = ABOUT_MEMORY.swap(0, Ordering::Relaxed);
                    assert_eq!((errors, about_memory), (1, 1), "call {step}, {failing}");
                    let again = self.call(&mut run, step);
                    assert_eq!(again, Some(c::OK), "call {step} with memory, {failing}");
                }
            } else {
                assert_eq!(status, c::OK, "call {step}, memory failed in {at}");
            }
        }
        (run, count, failed)
    }
}

#[test]
fn an_allocation_that_fails_is_an_error_or_nothing_and_kills_nobody() {
    let name = "no_memory::an_allocation_that_fails_is_an_error_or_nothing_and_kills_nobody";
    if let Some(printed) = child::run_counting(name) {
        println!("{}", printed.watched()[0]);
        return;
    }
    let tool = Allocations::find();
    let fmu = Fmu::shared();
    let text = |text: &str| CString::new(text).unwrap();
    let importer = Importer {
        f: &fmu.functions,
        callbacks: c::Callbacks {
            logger: Some(logger(count)),
            allocate_memory: None,
            free_memory: None,
            step_finished: None,
            environment: ptr::null_mut(),
        },
        guid: text(GUID),
        resources: text(&uri(&fmu.resources())),
        settings: text("numerics.elements = 3; initialization = rest; geometry.file = pca-2.toml"),
        airfoil: text("naca0012.polar"),
    };
    // The largest rotor that there is, without any memory in the calls that need much.
    let large = Importer {
        callbacks: importer.callbacks,
        guid: importer.guid.clone(),
        resources: importer.resources.clone(),
        settings: text(
            "numerics.elements = 2000; geometry.numberOfBlades = 8; initialization = rest",
        ),
        airfoil: text("naca0012.polar"),
        f: importer.f,
    };
    let (usual, ..) = large.run(&tool, usize::MAX, 0, false);
    for step in [0, 8, 10, 12, 13, 18, 19] {
        let (run, ..) = large.run(&tool, step, 1, true);
        assert!(run.seen == usual.seen, "call {step} of the largest rotor");
    }
    let (usual, ..) = importer.run(&tool, usize::MAX, 0, false);
    let (mut tried, mut refused) = (0, 0);
    for all in [false, true] {
        for step in 0..=25 {
            let (_, count, _) = importer.run(&tool, step, 0, false);
            // Where all after it fail, too, every seventh will do.
            let stride = if all { 7 } else { 1 };
            for failing in (1..=count).step_by(stride) {
                let (run, _, failed) = importer.run(&tool, step, failing, all);
                assert!(run.seen == usual.seen, "call {step}, allocation {failing}");
                tried += 1;
                refused += u32::from(failed);
            }
        }
    }
    child::watched(|| println!("{tried} failing allocations, {refused} calls refused"));
    assert!(tried > 500 && refused > 100, "{tried}, {refused}");
}

/// The list of variables for intermediate updates stays with the instance, so that it must fit.
#[test]
fn an_instance_without_memory_for_its_intermediate_variables_is_refused() {
    let name = "no_memory::an_instance_without_memory_for_its_intermediate_variables_is_refused";
    if child::run_counting(name).is_some() {
        return;
    }
    let (tool, fmu) = (Allocations::find(), Fmu::shared());
    let (make, free) = (
        fmu.of_fmi3.fmi3InstantiateCoSimulation,
        fmu.of_fmi3.fmi3FreeInstance,
    );
    let token = CString::new(INSTANTIATION_TOKEN).unwrap();
    let resources = CString::new(fmu.resources().to_str().unwrap()).unwrap();
    let (token, resources) = (token.as_ptr(), resources.as_ptr());
    let required = reference(&REALS, "collective");
    let refusals = |count: usize| {
        let begin = |failing: i64| {
            tool.fail(failing, false, || {
                let (name, none) = (c"rotor".as_ptr(), ptr::null_mut());
                // SAFETY: the pointers live during the call.
                unsafe {
                    make(
                        name, token, resources, 0, 0, 0, 0, &required, count, none, None, None,
                    )
                }
            })
        };
        let end = |instance| {
            // SAFETY: the instance lives, or there is none.
            unsafe { free(instance) }
        };
        let (instance, allocations) = begin(0);
        end(instance);
        let refused = (1..=allocations).filter(|failing| {
            let (instance, _) = begin(*failing);
            end(instance);
            instance.is_null()
        });
        refused.count()
    };
    let without = refusals(0);
    assert!(without > 3, "{without}");
    assert_eq!(refusals(1), without + 1);
}
