//! Sequences of calls of both interfaces, legal or not, with good and bad values and with null and
//! misaligned pointers: no crash, only sentences in the log, only finite numbers with fmi2OK, and
//! after a reset the instance is as new.

#![no_main]

use arbitrary::Arbitrary;
use fuzz::{Instance, finite, promise};
use helicopter_rotor::{
    block::variables::{BOOLEANS, INTEGERS, REALS, STATES, STRINGS, Variable, integer, real},
    fmi2::{
        co_simulation::*, directional::*, fmu_state::*, get_set::*, life_cycle::*, logger::*,
        model_exchange::*, types::*,
    },
};
use libfuzzer_sys::fuzz_target;
use std::{
    ffi::{CString, c_char},
    ptr,
    sync::OnceLock,
};

/// Calls of a sequence, and those among them that compute.
const MAX_CALLS: usize = 60;
const MAX_COSTLY: usize = 12;

const OK: fmi2Status = fmi2Status::Ok;

/// The address that is passed for an array or a result.
#[derive(Debug, Arbitrary, Clone, Copy)]
struct Address(u8);

impl Address {
    /// One in 16 is null, one in 16 misaligned.
    fn of<T>(self, values: &mut [T]) -> *mut T {
        match self.0 {
            0..16 => ptr::null_mut(),
            16..32 => values.as_mut_ptr().wrapping_byte_add(1),
            _ => values.as_mut_ptr(),
        }
    }
}

/// A number, most of them moderate.
#[derive(Debug, Arbitrary, Clone, Copy)]
enum Number {
    Small(i8),
    Large(i16),
    Any(f64),
}

impl Number {
    fn value(self) -> f64 {
        match self {
            Self::Small(x) => f64::from(x) / 64.0,
            Self::Large(x) => f64::from(x) / 8.0,
            Self::Any(x) => x,
        }
    }

    /// In the range of a variable, unless it is any number.
    fn within(self, variable: &Variable<f64>) -> f64 {
        let fraction = match self {
            Self::Small(x) => (f64::from(x) + 128.0) / 255.0,
            Self::Large(x) => (f64::from(x) + 32768.0) / 65535.0,
            Self::Any(x) => return x,
        };
        let (low, high) = (variable.min.max(-100.0), variable.max.min(1000.0));
        low + fraction * (high - low)
    }
}

/// A value reference: a few are none.
#[derive(Debug, Arbitrary, Clone, Copy)]
struct Place(u16);

impl Place {
    fn among<T>(self, table: &[T]) -> fmi2ValueReference {
        u32::from(self.0) % (table.len() as u32 + 2)
    }
}

#[derive(Debug, Arbitrary, Clone)]
enum Text {
    Known(u8),
    Any(Vec<u8>),
}

impl Text {
    fn string(&self) -> CString {
        const KNOWN: [&str; 10] = [
            "",
            "naca0015.polar",
            "airfoils/circle.polar",
            "naca0015.txt",
            "knight-hefner-3.toml",
            "pca-2.toml",
            "missing %s %n",
            "/dev/zero",
            "logStatusError",
            "logEvents",
        ];
        let bytes = match self {
            Self::Known(i) => KNOWN[usize::from(*i) % KNOWN.len()].as_bytes().to_vec(),
            Self::Any(bytes) => bytes.iter().copied().filter(|b| *b != 0).collect(),
        };
        CString::new(bytes).unwrap()
    }
}

#[derive(Debug, Arbitrary)]
enum Call {
    SetUp {
        start: Number,
        stop: Option<Number>,
    },
    EnterInitialization,
    ExitInitialization,
    Terminate,
    Reset,
    SetLogging {
        on: bool,
        categories: Vec<Text>,
        at: Address,
    },
    SetReal {
        values: Vec<(Place, Number)>,
        at: [Address; 2],
    },
    SetInteger {
        values: Vec<(Place, u8)>,
        at: [Address; 2],
    },
    SetBoolean {
        values: Vec<(Place, i8)>,
        at: [Address; 2],
    },
    SetString {
        values: Vec<(Place, Text)>,
        at: [Address; 2],
    },
    GetReal {
        places: Vec<Place>,
        at: [Address; 2],
    },
    GetInteger {
        places: Vec<Place>,
        at: [Address; 2],
    },
    GetBoolean {
        places: Vec<Place>,
        at: [Address; 2],
    },
    GetString {
        places: Vec<Place>,
        at: [Address; 2],
    },
    GetState {
        slot: bool,
        at: Address,
    },
    SetState {
        slot: bool,
    },
    FreeState {
        slot: bool,
        at: Address,
    },
    ThroughBytes {
        slot: bool,
        short: u8,
        at: Address,
    },
    Derivative {
        unknowns: Vec<Place>,
        knowns: Vec<(Place, Number)>,
        at: [Address; 4],
    },
    InputDerivatives {
        values: Vec<(Place, i8, Number)>,
        at: [Address; 3],
    },
    OutputDerivatives {
        values: Vec<(Place, i8)>,
        at: [Address; 3],
    },
    Step {
        offset: Option<Number>,
        size: Size,
    },
    CancelStep,
    Status {
        kind: i8,
        at: Address,
    },
    EnterEventMode,
    NewDiscreteStates {
        at: Address,
    },
    EnterContinuousTime,
    CompletedStep {
        at: [Address; 2],
    },
    SetTime(Number),
    SetStates {
        changes: Vec<(u8, Number)>,
        short: u8,
        at: Address,
    },
    GetVector {
        which: u8,
        short: u8,
        at: Address,
    },
}

/// A step size: short, or none that a step can have.
#[derive(Debug, Arbitrary, Clone, Copy)]
enum Size {
    Short(u8),
    Impossible(u8),
}

impl Size {
    fn value(self) -> f64 {
        match self {
            Self::Short(x) => f64::from(x) * 4e-5,
            Self::Impossible(x) => {
                [-1.0, f64::NAN, f64::INFINITY, 1e300, -1e-300][usize::from(x) % 5]
            }
        }
    }
}

#[derive(Debug, Arbitrary)]
struct Sequence {
    for_model_exchange: bool,
    initialized: bool,
    calls: Vec<Call>,
}

/// What the importer keeps beside the instance.
struct Importer {
    instance: Instance,
    states: [fmi2FMUstate; 2],
    costly: usize,
}

/// How many of the states a vector leaves out: mostly none.
fn length(short: u8) -> usize {
    STATES.len() - usize::from(short.saturating_sub(240)).min(STATES.len())
}

/// Value references with what belongs to them.
fn columns<T>(rows: impl Iterator<Item = (fmi2ValueReference, T)>) -> (Vec<u32>, Vec<T>) {
    rows.unzip()
}

/// Whether all addresses are good, so that the results can be read.
fn are_good(at: &[Address]) -> bool {
    at.iter().all(|address| address.0 >= 32)
}

/// Parameters that decide how long a step takes stay as they are.
fn is_costly(reference: fmi2ValueReference) -> bool {
    [real::NUMERICS__AZIMUTH_STEP.number(), real::RPM.number()].contains(&reference)
}

impl Importer {
    /// Counts a call that computes; false if there were enough of them.
    fn may_compute(&mut self) -> bool {
        self.costly += 1;
        self.costly <= MAX_COSTLY
    }

    /// SAFETY in all of these: the instance lives; addresses are good for their counts, null or
    /// misaligned.
    fn make(&mut self, call: &Call) {
        let c = self.instance.0;
        match call {
            Call::SetUp { start, stop } => {
                let (is_defined, stop) = (stop.is_some(), stop.map_or(0.0, Number::value));
                // SAFETY: see above.
                unsafe { fmi2SetupExperiment(c, 0, 0.0, start.value(), is_defined.into(), stop) };
            }
            // SAFETY: see above.
            Call::EnterInitialization => unsafe { self.ok(fmi2EnterInitializationMode(c)) },
            Call::ExitInitialization if self.may_compute() => {
                // SAFETY: see above.
                unsafe { self.ok(fmi2ExitInitializationMode(c)) }
            }
            // SAFETY: see above.
            Call::Terminate => unsafe { self.ok(fmi2Terminate(c)) },
            Call::Reset => {
                // SAFETY: see above.
                unsafe { self.ok(fmi2Reset(c)) };
                self.instance.simplify();
            }
            Call::SetLogging { on, categories, at } => {
                let texts: Vec<CString> = categories.iter().map(Text::string).collect();
                let mut pointers: Vec<_> = texts.iter().map(|text| text.as_ptr()).collect();
                let address = at.of(&mut pointers);
                // SAFETY: see above.
                unsafe { fmi2SetDebugLogging(c, (*on).into(), pointers.len(), address) };
            }
            Call::SetReal { .. }
            | Call::SetInteger { .. }
            | Call::SetBoolean { .. }
            | Call::SetString { .. } => self.set(call),
            Call::GetReal { .. }
            | Call::GetInteger { .. }
            | Call::GetBoolean { .. }
            | Call::GetString { .. }
                if self.may_compute() =>
            {
                self.get(call)
            }
            Call::GetState { .. }
            | Call::SetState { .. }
            | Call::FreeState { .. }
            | Call::ThroughBytes { .. }
                if self.may_compute() =>
            {
                self.move_state(call)
            }
            Call::Derivative { .. }
            | Call::InputDerivatives { .. }
            | Call::OutputDerivatives { .. }
                if self.may_compute() =>
            {
                self.differentiate(call)
            }
            Call::Step { offset, size } if self.may_compute() => {
                let time = self.instance.time() + offset.map_or(0.0, Number::value);
                // SAFETY: see above.
                unsafe { fmi2DoStep(c, time, size.value(), 1) };
            }
            // SAFETY: see above.
            Call::CancelStep => unsafe { self.ok(fmi2CancelStep(c)) },
            Call::Status { kind, at } => ask_status(c, (*kind).into(), *at),
            Call::EnterEventMode
            | Call::NewDiscreteStates { .. }
            | Call::EnterContinuousTime
            | Call::CompletedStep { .. }
            | Call::SetTime(_)
            | Call::SetStates { .. }
            | Call::GetVector { .. }
                if self.may_compute() =>
            {
                self.exchange(call)
            }
            _ => {}
        }
    }

    /// A call without results.
    fn ok(&self, _: fmi2Status) {}

    fn set(&self, call: &Call) {
        let c = self.instance.0;
        match call {
            Call::SetReal { values, at } => {
                let rows = values.iter().map(|(place, number)| {
                    let reference = place.among(&REALS);
                    let variable = REALS.get(reference as usize);
                    (reference, variable.map_or(0.0, |v| number.within(v)))
                });
                let rows = rows.filter(|(reference, _)| !is_costly(*reference));
                let (mut vr, mut values) = columns(rows);
                let (n, at) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                unsafe { fmi2SetReal(c, at.0, n, at.1) };
            }
            Call::SetInteger { values, at } => {
                let rows = values.iter().map(|(place, value)| {
                    // 255 stands for those that no variable has.
                    let value = if *value == 255 {
                        i32::MAX
                    } else {
                        (*value % 24).into()
                    };
                    (place.among(&INTEGERS), value)
                });
                let (mut vr, mut values) = columns(rows);
                let (n, at) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                unsafe { fmi2SetInteger(c, at.0, n, at.1) };
            }
            Call::SetBoolean { values, at } => {
                let rows = values
                    .iter()
                    .map(|(place, value)| (place.among(&BOOLEANS), (*value).into()));
                let (mut vr, mut values) = columns(rows);
                let (n, at) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                unsafe { fmi2SetBoolean(c, at.0, n, at.1) };
            }
            Call::SetString { values, at } => {
                let texts: Vec<CString> = values.iter().map(|(_, text)| text.string()).collect();
                let rows = values.iter().zip(&texts);
                let rows = rows.map(|((place, _), text)| (place.among(&STRINGS), text.as_ptr()));
                let (mut vr, mut values) = columns(rows);
                let (n, at) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                unsafe { fmi2SetString(c, at.0, n, at.1) };
            }
            _ => {}
        }
    }

    fn get(&self, call: &Call) {
        let c = self.instance.0;
        match call {
            Call::GetReal { places, at } => {
                let rows = places.iter().map(|place| (place.among(&REALS), f64::NAN));
                let (mut vr, mut values) = columns(rows);
                let (n, to) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                let status = unsafe { fmi2GetReal(c, to.0, n, to.1) };
                if status == OK && are_good(at) {
                    finite(&values);
                }
            }
            Call::GetInteger { places, at } => {
                let rows = places
                    .iter()
                    .map(|place| (place.among(&INTEGERS), i32::MIN));
                let (mut vr, mut values) = columns(rows);
                let (n, to) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                let status = unsafe { fmi2GetInteger(c, to.0, n, to.1) };
                let is_read = values.iter().all(|v| *v != i32::MIN);
                promise(status != OK || !are_good(at) || is_read, || {
                    "not read".into()
                });
            }
            Call::GetBoolean { places, at } => {
                let rows = places.iter().map(|place| (place.among(&BOOLEANS), 9));
                let (mut vr, mut values) = columns(rows);
                let (n, to) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above.
                let status = unsafe { fmi2GetBoolean(c, to.0, n, to.1) };
                let is_read = values.iter().all(|v| [0, 1].contains(v));
                promise(status != OK || !are_good(at) || is_read, || {
                    "not read".into()
                });
            }
            Call::GetString { places, at } => {
                let rows = places
                    .iter()
                    .map(|place| (place.among(&STRINGS), ptr::null()));
                let (mut vr, mut values) = columns::<*const c_char>(rows);
                let (n, to) = (vr.len(), (at[0].of(&mut vr), at[1].of(&mut values)));
                // SAFETY: see above; the strings live until the next call.
                unsafe {
                    if fmi2GetString(c, to.0, n, to.1) == OK && are_good(at) {
                        for text in values {
                            std::hint::black_box(std::ffi::CStr::from_ptr(text).to_bytes());
                        }
                    }
                }
            }
            _ => {}
        }
    }

    fn move_state(&mut self, call: &Call) {
        let c = self.instance.0;
        match call {
            Call::GetState { slot, at } => {
                let place = &mut self.states[usize::from(*slot)];
                // SAFETY: see above; the place is null or has a living state.
                unsafe { fmi2GetFMUstate(c, at.of(std::slice::from_mut(place))) };
            }
            Call::SetState { slot } => {
                // SAFETY: see above; the state is null or lives.
                unsafe { fmi2SetFMUstate(c, self.states[usize::from(*slot)]) };
            }
            Call::FreeState { slot, at } => {
                let place = &mut self.states[usize::from(*slot)];
                // SAFETY: as above.
                unsafe { fmi2FreeFMUstate(c, at.of(std::slice::from_mut(place))) };
            }
            Call::ThroughBytes { slot, short, at } => {
                let (state, mut size) = (self.states[usize::from(*slot)], 0);
                let mut read = ptr::null_mut();
                // SAFETY: as above; the bytes have their size, or are fewer.
                unsafe {
                    let sized = fmi2SerializedFMUstateSize(c, state, &mut size);
                    let size = size.saturating_sub(usize::from(short.saturating_sub(200)));
                    // One more for the address that is no multiple of anything.
                    let mut bytes = vec![0_u8; size + 1];
                    let address = at.of(&mut bytes).cast();
                    let written = fmi2SerializeFMUstate(c, state, address, size);
                    if [sized, written] == [OK; 2] {
                        let status = fmi2DeSerializeFMUstate(c, address, size, &mut read);
                        promise(status == OK, || "the bytes are not read".into());
                        fmi2SetFMUstate(c, read);
                        fmi2FreeFMUstate(c, &mut read);
                    }
                }
            }
            _ => {}
        }
    }

    fn differentiate(&self, call: &Call) {
        let c = self.instance.0;
        match call {
            Call::Derivative {
                unknowns,
                knowns,
                at,
            } => {
                let rows = unknowns.iter().map(|place| (place.among(&REALS), f64::NAN));
                let (mut unknowns, mut derivatives) = columns(rows);
                let rows = knowns
                    .iter()
                    .map(|(place, seed)| (place.among(&REALS), seed.value()));
                let (mut knowns, mut seeds) = columns(rows);
                let counts = (unknowns.len(), knowns.len());
                // SAFETY: see above.
                let status = unsafe {
                    fmi2GetDirectionalDerivative(
                        c,
                        at[0].of(&mut unknowns),
                        counts.0,
                        at[1].of(&mut knowns),
                        counts.1,
                        at[2].of(&mut seeds),
                        at[3].of(&mut derivatives),
                    )
                };
                if status == OK && are_good(at) {
                    finite(&derivatives);
                }
            }
            Call::InputDerivatives { values, at } => {
                let rows = values.iter();
                let rows = rows.map(|(place, order, x)| (place.among(&REALS), (*order, x.value())));
                let (mut vr, rest) = columns(rows);
                let (mut orders, mut values): (Vec<i32>, Vec<f64>) = rest
                    .into_iter()
                    .map(|(order, x)| (i32::from(order), x))
                    .unzip();
                let (n, at) = (
                    vr.len(),
                    (
                        at[0].of(&mut vr),
                        at[1].of(&mut orders),
                        at[2].of(&mut values),
                    ),
                );
                // SAFETY: see above.
                unsafe { fmi2SetRealInputDerivatives(c, at.0, n, at.1, at.2) };
            }
            Call::OutputDerivatives { values, at } => {
                let rows = values
                    .iter()
                    .map(|(place, order)| (place.among(&REALS), (*order).into()));
                let (mut vr, mut orders) = columns::<i32>(rows);
                let mut out = vec![f64::NAN; vr.len()];
                let (n, to) = (
                    vr.len(),
                    (at[0].of(&mut vr), at[1].of(&mut orders), at[2].of(&mut out)),
                );
                // SAFETY: see above.
                let status = unsafe { fmi2GetRealOutputDerivatives(c, to.0, n, to.1, to.2) };
                if status == OK && are_good(at) {
                    finite(&out);
                }
            }
            _ => {}
        }
    }

    fn exchange(&self, call: &Call) {
        let c = self.instance.0;
        match call {
            // SAFETY: see above.
            Call::EnterEventMode => unsafe { self.ok(fmi2EnterEventMode(c)) },
            Call::NewDiscreteStates { at } => {
                // SAFETY: zeros are valid for this plain structure.
                let mut info: fmi2EventInfo = unsafe { std::mem::zeroed() };
                // SAFETY: see above.
                unsafe { fmi2NewDiscreteStates(c, at.of(std::slice::from_mut(&mut info))) };
            }
            // SAFETY: see above.
            Call::EnterContinuousTime => unsafe { self.ok(fmi2EnterContinuousTimeMode(c)) },
            Call::CompletedStep { at } => {
                let (mut event, mut end) = ([0], [0]);
                // SAFETY: see above.
                unsafe {
                    fmi2CompletedIntegratorStep(c, 1, at[0].of(&mut event), at[1].of(&mut end))
                };
            }
            // SAFETY: see above.
            Call::SetTime(time) => unsafe { self.ok(fmi2SetTime(c, time.value())) },
            Call::SetStates { changes, short, at } => {
                let mut x = vec![0.0; STATES.len()];
                let count = length(*short);
                // SAFETY: see above.
                unsafe {
                    fmi2GetContinuousStates(c, x.as_mut_ptr(), x.len());
                    for (place, value) in changes {
                        x[usize::from(*place) % STATES.len()] = value.value();
                    }
                    fmi2SetContinuousStates(c, at.of(&mut x), count);
                }
            }
            Call::GetVector { which, short, at } => {
                let get = [
                    fmi2GetDerivatives,
                    fmi2GetEventIndicators,
                    fmi2GetContinuousStates,
                    fmi2GetNominalsOfContinuousStates,
                ][usize::from(*which) % 4];
                let mut x = vec![f64::NAN; STATES.len()];
                let count = length(*short);
                // SAFETY: see above.
                let status = unsafe { get(c, at.of(&mut x), count) };
                // There are no event indicators.
                if status == OK && are_good(&[*at]) && *which % 4 != 1 {
                    finite(&x);
                }
            }
            _ => {}
        }
    }
}

fn ask_status(c: fmi2Component, kind: fmi2Enumeration, at: Address) {
    let (mut status, mut real, mut integer, mut text) = ([OK], [0.0], [0], [ptr::null()]);
    // SAFETY: the instance lives; the address is good, null or misaligned.
    unsafe {
        fmi2GetStatus(c, kind, at.of(&mut status));
        fmi2GetRealStatus(c, kind, at.of(&mut real));
        fmi2GetIntegerStatus(c, kind, at.of(&mut integer));
        fmi2GetBooleanStatus(c, kind, at.of(&mut integer));
        fmi2GetStringStatus(c, kind, at.of(&mut text));
    }
}

/// Initialises an instance that is new, and answers its numbers.
fn initialized(instance: &Instance) -> Vec<f64> {
    instance.simplify();
    // SAFETY: the instance lives.
    let status = unsafe {
        [
            fmi2EnterInitializationMode(instance.0),
            fmi2ExitInitializationMode(instance.0),
        ]
    };
    promise(status == [OK; 2], || "not initialised".into());
    instance.reals().unwrap_or_else(|| fuzz::fail("not read"))
}

fn numbers(kind: fmi2Enumeration) -> &'static [f64] {
    static NUMBERS: [OnceLock<Vec<f64>>; 2] = [OnceLock::new(), OnceLock::new()];
    NUMBERS[kind as usize].get_or_init(|| initialized(&Instance::new(kind)))
}

fuzz_target!(|sequence: Sequence| {
    let kind = if sequence.for_model_exchange {
        FMI2_MODEL_EXCHANGE
    } else {
        FMI2_CO_SIMULATION
    };
    let instance = Instance::new(kind);
    instance.simplify();
    instance.set_integer(integer::GEOMETRY__NUMBER_OF_BLADES, 2);
    let mut importer = Importer {
        instance,
        states: [ptr::null_mut(); 2],
        costly: 0,
    };
    if sequence.initialized {
        importer.make(&Call::EnterInitialization);
        importer.make(&Call::ExitInitialization);
    }
    for call in sequence.calls.iter().take(MAX_CALLS) {
        importer.make(call);
    }
    let Importer {
        instance,
        mut states,
        ..
    } = importer;
    for state in &mut states {
        // SAFETY: the state is null or lives.
        unsafe { fmi2FreeFMUstate(instance.0, state) };
    }
    // SAFETY: the instance lives.
    promise(unsafe { fmi2Reset(instance.0) } == OK, || {
        "not reset".into()
    });
    promise(initialized(&instance) == numbers(kind), || {
        "after a reset the instance is not as new".into()
    });
});
