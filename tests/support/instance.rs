//! An instance of the FMU with variables by name, and the log that it writes.

use super::{
    c::{self, Callbacks, Component, Functions, Reference, Status, Text},
    fmu::{Fmu, uri},
};
use helicopter_rotor::block::variables::{BOOLEANS, GUID, INTEGERS, REALS, STRINGS, Variable};
use std::{
    ffi::{CStr, CString, c_int, c_void},
    ptr,
    sync::Mutex,
};

/// One call of the logger.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    pub instance: String,
    pub status: Status,
    pub category: String,
    pub message: String,
}

/// Lines in the order of their arrival.
pub type Log = Mutex<Vec<Line>>;

/// Puts a line into the `Log` behind the component environment.
unsafe extern "C" fn collect(
    environment: *mut c_void,
    instance: Text,
    status: Status,
    category: Text,
    message: Text,
) {
    // SAFETY: the strings live during this call, as the standard demands.
    let text = |text: Text| unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned();
    let line = Line {
        instance: text(instance),
        status,
        category: text(category),
        message: text(message),
    };
    // SAFETY: every instance that gets this logger gets the address of a living `Log` with it.
    let log = unsafe { &*environment.cast::<Log>() };
    log.lock().unwrap().push(line);
}

/// A logger as the standard declares it, variadic, from one that is not.
pub fn logger(plain: c::PlainLogger) -> c::Logger {
    // SAFETY: the library passes no variadic arguments. Named arguments go the same way with and
    // without variadic ones behind them in the C conventions of the platforms that FMUs run on.
    unsafe { std::mem::transmute::<c::PlainLogger, c::Logger>(plain) }
}

/// Callbacks that collect lines in a log, which must outlive the instance.
pub fn callbacks(log: &Log) -> Callbacks {
    Callbacks {
        logger: Some(logger(collect)),
        allocate_memory: None,
        free_memory: None,
        step_finished: None,
        environment: ptr::from_ref(log).cast_mut().cast(),
    }
}

/// The arguments of fmi2Instantiate. None: a null pointer.
#[derive(Clone)]
pub struct Creation<'a> {
    pub name: Option<&'a [u8]>,
    pub kind: c_int,
    pub guid: Option<&'a [u8]>,
    pub resources: Option<String>,
    pub logging_on: bool,
}

impl Default for Creation<'_> {
    fn default() -> Self {
        Self {
            name: Some(b"rotor"),
            kind: c::CO_SIMULATION,
            guid: Some(GUID.as_bytes()),
            resources: Some(uri(&Fmu::shared().resources())),
            logging_on: false,
        }
    }
}

/// An instance; it is freed when it is dropped.
pub struct Instance<'f> {
    pub component: Component,
    pub functions: &'f Functions,
    /// Boxed, as the library keeps its address.
    log: Box<Log>,
}

/// The value reference of a variable in one of the tables.
pub fn reference<T>(table: &[Variable<T>], name: &str) -> Reference {
    let place = table.iter().position(|v| v.name == name);
    place.unwrap_or_else(|| panic!("no variable {name} of this type")) as Reference
}

impl<'f> Instance<'f> {
    /// Calls fmi2Instantiate; the log if it gives no instance.
    pub fn create(fmu: &'f Fmu, creation: &Creation) -> Result<Self, Vec<Line>> {
        let log = Box::new(Log::default());
        let text = |bytes: Option<&[u8]>| bytes.map(|b| CString::new(b).unwrap());
        let (name, guid) = (text(creation.name), text(creation.guid));
        let resources = text(creation.resources.as_deref().map(str::as_bytes));
        let pointer = |text: &Option<CString>| text.as_ref().map_or(ptr::null(), |t| t.as_ptr());
        let callbacks = callbacks(&log);
        // SAFETY: the pointers are null or valid during the call; the log outlives the instance.
        let component = unsafe {
            (fmu.functions.fmi2Instantiate)(
                pointer(&name),
                creation.kind,
                pointer(&guid),
                pointer(&resources),
                &callbacks,
                0,
                creation.logging_on.into(),
            )
        };
        if component.is_null() {
            return Err(log.into_inner().unwrap());
        }
        Ok(Self {
            component,
            functions: &fmu.functions,
            log,
        })
    }

    /// An instance of the shared FMU before its initialisation.
    pub fn new() -> Instance<'static> {
        Instance::create(Fmu::shared(), &Creation::default()).unwrap()
    }

    /// An instance of the shared FMU after its initialisation, with all values at their defaults.
    pub fn running() -> Instance<'static> {
        let instance = Instance::new();
        instance.initialize();
        instance
    }

    /// An instance of the shared FMU for Model Exchange before its initialisation.
    pub fn for_model_exchange() -> Instance<'static> {
        let creation = Creation {
            kind: c::MODEL_EXCHANGE,
            ..Creation::default()
        };
        Instance::create(Fmu::shared(), &creation).unwrap()
    }

    /// From fmi2SetupExperiment, with start time 0 and no stop time, to the end of initialisation.
    pub fn initialize(&self) {
        self.begin_initialization();
        assert_eq!(self.exit_initialization(), c::OK, "{:?}", self.take_log());
    }

    /// As `initialize`, but stays in Initialization Mode.
    pub fn begin_initialization(&self) {
        assert_eq!(self.set_up(0.0, None), c::OK);
        assert_eq!(self.enter_initialization(), c::OK);
    }

    /// The lines that were logged since the last call.
    pub fn take_log(&self) -> Vec<Line> {
        std::mem::take(&mut self.log.lock().unwrap())
    }

    /// Asserts that a call was refused with one sentence in the log, and answers that.
    #[track_caller]
    pub fn refused(&self, status: Status) -> String {
        let log = self.take_log();
        assert_eq!(status, c::ERROR, "the call must be refused; log: {log:?}");
        let [line] = &log[..] else {
            panic!("one line is expected for one error: {log:?}")
        };
        assert_eq!(
            (line.status, line.category.as_str()),
            (c::ERROR, "logStatusError"),
            "{line:?}"
        );
        assert!(
            line.message.starts_with("fmi2"),
            "it must begin with the function: {line:?}"
        );
        line.message.clone()
    }
}

impl Drop for Instance<'_> {
    fn drop(&mut self) {
        // SAFETY: from fmi2Instantiate, and not used afterwards.
        unsafe { (self.functions.fmi2FreeInstance)(self.component) };
    }
}

// SAFETY in all of these: the component is living, and pointers are valid for their counts.
impl Instance<'_> {
    pub fn set_up(&self, start: f64, stop: Option<f64>) -> Status {
        let (defined, stop) = (stop.is_some().into(), stop.unwrap_or(0.0));
        // SAFETY: see above.
        unsafe {
            (self.functions.fmi2SetupExperiment)(self.component, 0, 0.0, start, defined, stop)
        }
    }

    pub fn enter_initialization(&self) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2EnterInitializationMode)(self.component) }
    }

    pub fn exit_initialization(&self) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2ExitInitializationMode)(self.component) }
    }

    pub fn terminate(&self) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2Terminate)(self.component) }
    }

    pub fn reset(&self) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2Reset)(self.component) }
    }

    pub fn step(&self, time: f64, size: f64) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2DoStep)(self.component, time, size, 1) }
    }

    pub fn last_time(&self) -> f64 {
        let (kind, mut time) = (c::LAST_SUCCESSFUL_TIME, f64::NAN);
        // SAFETY: see above.
        let status = unsafe { (self.functions.fmi2GetRealStatus)(self.component, kind, &mut time) };
        assert_eq!(status, c::OK);
        time
    }

    pub fn set_debug_logging(&self, on: bool, categories: &[&str]) -> Status {
        let texts: Vec<CString> = categories
            .iter()
            .map(|c| CString::new(*c).unwrap())
            .collect();
        let pointers: Vec<Text> = texts.iter().map(|t| t.as_ptr()).collect();
        let set = self.functions.fmi2SetDebugLogging;
        // SAFETY: see above.
        unsafe { set(self.component, on.into(), pointers.len(), pointers.as_ptr()) }
    }

    pub fn set_real(&self, name: &str, value: f64) -> Status {
        self.set_reals(&[reference(&REALS, name)], &[value])
    }

    pub fn set_reals(&self, references: &[Reference], values: &[f64]) -> Status {
        assert_eq!(references.len(), values.len());
        let set = self.functions.fmi2SetReal;
        // SAFETY: see above.
        unsafe {
            set(
                self.component,
                references.as_ptr(),
                values.len(),
                values.as_ptr(),
            )
        }
    }

    pub fn set_integer(&self, name: &str, value: c_int) -> Status {
        self.set_integer_at(reference(&INTEGERS, name), value)
    }

    pub fn set_integer_at(&self, reference: Reference, value: c_int) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2SetInteger)(self.component, &reference, 1, &value) }
    }

    pub fn set_boolean(&self, name: &str, value: c_int) -> Status {
        self.set_booleans(&[reference(&BOOLEANS, name)], &[value])
    }

    pub fn set_booleans(&self, references: &[Reference], values: &[c_int]) -> Status {
        assert_eq!(references.len(), values.len());
        let (r, n, x) = (references.as_ptr(), values.len(), values.as_ptr());
        // SAFETY: see above.
        unsafe { (self.functions.fmi2SetBoolean)(self.component, r, n, x) }
    }

    pub fn set_string(&self, name: &str, value: &str) -> Status {
        self.set_string_at(reference(&STRINGS, name), &CString::new(value).unwrap())
    }

    pub fn set_string_at(&self, reference: Reference, value: &CStr) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2SetString)(self.component, &reference, 1, &value.as_ptr()) }
    }

    pub fn get_reals(&self, references: &[Reference], values: &mut [f64]) -> Status {
        assert_eq!(references.len(), values.len());
        let get = self.functions.fmi2GetReal;
        // SAFETY: see above.
        unsafe {
            get(
                self.component,
                references.as_ptr(),
                values.len(),
                values.as_mut_ptr(),
            )
        }
    }

    pub fn get_integer_at(&self, reference: Reference, value: &mut c_int) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2GetInteger)(self.component, &reference, 1, value) }
    }

    pub fn get_boolean_at(&self, reference: Reference, value: &mut c_int) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2GetBoolean)(self.component, &reference, 1, value) }
    }

    #[track_caller]
    pub fn real(&self, name: &str) -> f64 {
        let mut value = [f64::NAN];
        let status = self.get_reals(&[reference(&REALS, name)], &mut value);
        assert_eq!(status, c::OK, "{name}: {:?}", self.take_log());
        value[0]
    }

    /// All Real variables by value reference.
    #[track_caller]
    pub fn reals(&self) -> Vec<f64> {
        let references: Vec<Reference> = (0..REALS.len() as Reference).collect();
        let mut values = vec![f64::NAN; REALS.len()];
        assert_eq!(
            self.get_reals(&references, &mut values),
            c::OK,
            "{:?}",
            self.take_log()
        );
        values
    }

    #[track_caller]
    pub fn integer(&self, name: &str) -> c_int {
        let mut value = c_int::MIN;
        let status = self.get_integer_at(reference(&INTEGERS, name), &mut value);
        assert_eq!(status, c::OK, "{name}: {:?}", self.take_log());
        value
    }

    #[track_caller]
    pub fn boolean(&self, name: &str) -> c_int {
        let mut value = c_int::MIN;
        let status = self.get_boolean_at(reference(&BOOLEANS, name), &mut value);
        assert_eq!(status, c::OK, "{name}: {:?}", self.take_log());
        value
    }

    #[track_caller]
    pub fn string(&self, name: &str) -> String {
        let mut value = ptr::null();
        let reference = reference(&STRINGS, name);
        let get = self.functions.fmi2GetString;
        // SAFETY: see above.
        let status = unsafe { get(self.component, &reference, 1, &mut value) };
        assert_eq!(status, c::OK, "{name}: {:?}", self.take_log());
        // SAFETY: the library's string lives until the next call.
        unsafe { CStr::from_ptr(value) }
            .to_str()
            .unwrap()
            .to_owned()
    }
}

/// Input derivatives, and the complete state. SAFETY as above.
impl<'f> Instance<'f> {
    /// The derivatives of variables along a direction that others take.
    pub fn along(
        &self,
        unknowns: &[Reference],
        knowns: &[Reference],
        seeds: &[f64],
        out: &mut [f64],
    ) -> Status {
        assert_eq!((knowns.len(), unknowns.len()), (seeds.len(), out.len()));
        let get = self.functions.fmi2GetDirectionalDerivative;
        // SAFETY: see above.
        unsafe {
            get(
                self.component,
                unknowns.as_ptr(),
                unknowns.len(),
                knowns.as_ptr(),
                knowns.len(),
                seeds.as_ptr(),
                out.as_mut_ptr(),
            )
        }
    }

    /// The derivative of one variable by another.
    #[track_caller]
    pub fn derivative(&self, unknown: &str, known: &str) -> f64 {
        let references = [unknown, known].map(|name| reference(&REALS, name));
        let mut out = [f64::NAN];
        let status = self.along(&references[..1], &references[1..], &[1.0], &mut out);
        assert_eq!(status, c::OK, "{:?}", self.take_log());
        out[0]
    }

    pub fn output_derivatives(
        &self,
        references: &[Reference],
        orders: &[c_int],
        out: &mut [f64],
    ) -> Status {
        assert_eq!(
            (references.len(), references.len()),
            (orders.len(), out.len())
        );
        let get = self.functions.fmi2GetRealOutputDerivatives;
        let (r, n) = (references.as_ptr(), references.len());
        // SAFETY: see above.
        unsafe { get(self.component, r, n, orders.as_ptr(), out.as_mut_ptr()) }
    }

    pub fn set_slope(&self, name: &str, slope: f64) -> Status {
        self.set_input_derivatives(&[reference(&REALS, name)], &[1], &[slope])
    }

    pub fn set_input_derivatives(
        &self,
        references: &[Reference],
        orders: &[c_int],
        values: &[f64],
    ) -> Status {
        assert_eq!(
            (references.len(), orders.len()),
            (values.len(), values.len())
        );
        let set = self.functions.fmi2SetRealInputDerivatives;
        let (r, n, o) = (references.as_ptr(), references.len(), orders.as_ptr());
        // SAFETY: see above.
        unsafe { set(self.component, r, n, o, values.as_ptr()) }
    }

    /// A copy of the state.
    #[track_caller]
    pub fn state(&self) -> State<'_, 'f> {
        let mut pointer = ptr::null_mut();
        assert_eq!(self.get_state(&mut pointer), c::OK, "{:?}", self.take_log());
        assert!(!pointer.is_null());
        State {
            pointer,
            owner: self,
        }
    }

    pub fn get_state(&self, pointer: &mut c::FmuState) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2GetFMUstate)(self.component, pointer) }
    }

    pub fn set_state(&self, state: &State) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi2SetFMUstate)(self.component, state.pointer) }
    }

    /// The state that bytes hold.
    pub fn deserialize(&self, bytes: &[u8]) -> Result<State<'_, 'f>, Status> {
        let mut pointer = ptr::null_mut();
        let read = self.functions.fmi2DeSerializeFMUstate;
        // SAFETY: see above.
        let status = unsafe {
            read(
                self.component,
                bytes.as_ptr().cast(),
                bytes.len(),
                &mut pointer,
            )
        };
        if status != c::OK {
            assert!(pointer.is_null());
            return Err(status);
        }
        Ok(State {
            pointer,
            owner: self,
        })
    }
}

/// A copy of an instance's state; it is freed when it is dropped.
pub struct State<'i, 'f> {
    pub pointer: c::FmuState,
    owner: &'i Instance<'f>,
}

impl State<'_, '_> {
    #[track_caller]
    pub fn serialize(&self) -> Vec<u8> {
        let (f, component) = (self.owner.functions, self.owner.component);
        let mut size = 0;
        // SAFETY: the instance and the state live; the pointers are valid for their counts.
        unsafe {
            let status = (f.fmi2SerializedFMUstateSize)(component, self.pointer, &mut size);
            assert_eq!(status, c::OK);
            let mut bytes = vec![0_u8; size];
            let out = bytes.as_mut_ptr().cast();
            let status = (f.fmi2SerializeFMUstate)(component, self.pointer, out, size);
            assert_eq!(status, c::OK);
            bytes
        }
    }
}

impl Drop for State<'_, '_> {
    fn drop(&mut self) {
        let free = self.owner.functions.fmi2FreeFMUstate;
        // SAFETY: the instance lives, and the state is not used afterwards.
        let status = unsafe { free(self.owner.component, &mut self.pointer) };
        assert!(std::thread::panicking() || (status == c::OK && self.pointer.is_null()));
    }
}

/// The bits of floating-point numbers, which compare as they are: also -0 and NaN.
pub fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|v| v.to_bits()).collect()
}
