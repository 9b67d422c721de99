//! An instance of FMI 3.0 with variables by name, and the log that it writes.

use super::{
    c::{self, FmuState, Reference, Status, Text},
    c3::{self, Bool, Functions, IntermediateUpdate},
    fmu::Fmu,
    instance::Line,
};
use helicopter_rotor::{block::variables::INSTANTIATION_TOKEN, description::XML_OF_FMI3};
use roxmltree::Document;
use std::{
    cell::{Cell, RefCell},
    collections::BTreeMap,
    ffi::{CStr, CString, c_void},
    ptr,
    sync::{Mutex, OnceLock},
};

/// A variable in modelDescription.xml.
#[derive(Debug, Clone)]
pub struct Variable {
    pub name: String,
    /// The name of its element.
    pub kind: String,
    pub reference: Reference,
    pub count: usize,
    pub causality: String,
    pub variability: String,
    pub is_intermediate: bool,
    /// The start values of its elements: one if they are alike, none if there are none.
    pub start: Vec<String>,
}

/// All variables by name, as modelDescription.xml of FMI 3.0 has them.
pub fn variables() -> &'static BTreeMap<String, Variable> {
    static VARIABLES: OnceLock<BTreeMap<String, Variable>> = OnceLock::new();
    VARIABLES.get_or_init(|| {
        let description = Document::parse(XML_OF_FMI3).unwrap();
        let list = description
            .descendants()
            .find(|n| n.has_tag_name("ModelVariables"));
        let elements = list.unwrap().children().filter(|n| n.is_element());
        let variable = |node: roxmltree::Node| {
            let attribute = |name| node.attribute(name).unwrap_or_default().to_owned();
            let dimension = node.children().find(|n| n.has_tag_name("Dimension"));
            let variable = Variable {
                name: attribute("name"),
                kind: node.tag_name().name().to_owned(),
                reference: attribute("valueReference").parse().unwrap(),
                count: dimension.map_or(1, |d| d.attribute("start").unwrap().parse().unwrap()),
                causality: attribute("causality"),
                variability: attribute("variability"),
                is_intermediate: node.attribute("intermediateUpdate") == Some("true"),
                start: match node.attribute("start") {
                    Some(start) => start.split_whitespace().map(str::to_owned).collect(),
                    None => {
                        let starts = node.children().filter(|n| n.has_tag_name("Start"));
                        starts
                            .map(|n| n.attribute("value").unwrap().to_owned())
                            .collect()
                    }
                },
            };
            (variable.name.clone(), variable)
        };
        elements.map(variable).collect()
    })
}

/// The variable with this name.
pub fn variable(name: &str) -> &'static Variable {
    let variable = variables().get(name);
    variable.unwrap_or_else(|| panic!("no variable {name}"))
}

/// What an intermediate update is called with, and what it may ask for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Update {
    pub time: f64,
    pub asks_for_inputs: bool,
    pub may_read: bool,
    pub is_finished: bool,
    pub can_return: bool,
}

/// What the importer does in an intermediate update; its answer is the time of an early return.
pub type OnUpdate = Box<dyn FnMut(&Instance3, Update) -> Option<f64>>;

/// Where the callbacks of an instance find the test.
#[derive(Default)]
struct Environment {
    log: Mutex<Vec<Line>>,
    on_update: RefCell<Option<OnUpdate>>,
    instance: Cell<*const Instance3>,
}

unsafe extern "C" fn collect(environment: *mut c_void, status: Status, category: Text, text: Text) {
    // SAFETY: the strings live during this call, as the standard demands.
    let read = |text: Text| unsafe { CStr::from_ptr(text) }.to_str().unwrap().to_owned();
    let line = Line {
        instance: String::new(),
        status,
        category: read(category),
        message: read(text),
    };
    // SAFETY: the address of a living environment.
    let environment = unsafe { &*environment.cast::<Environment>() };
    environment.log.lock().unwrap().push(line);
}

unsafe extern "C" fn update(
    environment: *mut c_void,
    time: f64,
    set: Bool,
    get: Bool,
    finished: Bool,
    can_return: Bool,
    requested: *mut Bool,
    return_time: *mut f64,
) {
    for flag in [set, get, finished, can_return] {
        assert!([0, 1].contains(&flag));
    }
    let update = Update {
        time,
        asks_for_inputs: set == 1,
        may_read: get == 1,
        is_finished: finished == 1,
        can_return: can_return == 1,
    };
    // SAFETY: the address of a living environment, whose instance lives while it makes a step.
    let (environment, instance) = unsafe {
        let environment = &*environment.cast::<Environment>();
        (environment, &*environment.instance.get())
    };
    let mut on_update = environment.on_update.borrow_mut();
    if let Some(time) = on_update.as_mut().and_then(|f| f(instance, update)) {
        // SAFETY: places for these answers, as the standard demands.
        unsafe {
            *requested = 1;
            *return_time = time;
        }
    }
}

/// What an instance is made for.
#[derive(Clone, Copy, PartialEq)]
pub enum Kind {
    CoSimulation,
    ModelExchange,
    ScheduledExecution,
}

/// The arguments of the functions that make instances.
#[derive(Clone)]
pub struct Creation3<'a> {
    pub token: &'a str,
    pub kind: Kind,
    pub logging_on: bool,
    pub event_mode: bool,
    pub early_return: bool,
    /// The names of the variables for intermediate updates.
    pub required: Vec<&'a str>,
    pub has_callback: bool,
}

impl Default for Creation3<'_> {
    fn default() -> Self {
        Self {
            token: INSTANTIATION_TOKEN,
            kind: Kind::CoSimulation,
            logging_on: true,
            event_mode: false,
            early_return: false,
            required: Vec::new(),
            has_callback: false,
        }
    }
}

/// What fmi3DoStep answers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stepped {
    pub needs_event: bool,
    pub is_early: bool,
    pub time: f64,
}

/// An instance; it is freed when it is dropped.
pub struct Instance3 {
    pub pointer: c3::Instance,
    pub functions: &'static Functions,
    environment: Box<Environment>,
}

impl Creation3<'_> {
    /// The instance; the log if there is none.
    pub fn make(&self) -> Result<Instance3, Vec<Line>> {
        let fmu = Fmu::shared();
        let functions = &fmu.of_fmi3;
        let environment = Box::<Environment>::default();
        let token = CString::new(self.token).unwrap();
        let resources = format!("{}/", fmu.resources().to_str().unwrap());
        let resources = CString::new(resources).unwrap();
        let (name, token, resources) = (c"rotor".as_ptr(), token.as_ptr(), resources.as_ptr());
        let required: Vec<Reference> = self
            .required
            .iter()
            .map(|name| variable(name).reference)
            .collect();
        let callback: Option<IntermediateUpdate> = self.has_callback.then_some(update);
        let logging_on = self.logging_on.into();
        let place = ptr::from_ref(&*environment).cast_mut().cast();
        // SAFETY: the pointers live during the call; the environment outlives the instance.
        let pointer = unsafe {
            match self.kind {
                Kind::ModelExchange => {
                    let make = functions.fmi3InstantiateModelExchange;
                    make(name, token, resources, 0, logging_on, place, Some(collect))
                }
                Kind::CoSimulation => (functions.fmi3InstantiateCoSimulation)(
                    name,
                    token,
                    resources,
                    0,
                    logging_on,
                    self.event_mode.into(),
                    self.early_return.into(),
                    required.as_ptr(),
                    required.len(),
                    place,
                    Some(collect),
                    callback,
                ),
                Kind::ScheduledExecution => (functions.fmi3InstantiateScheduledExecution)(
                    name,
                    token,
                    resources,
                    0,
                    logging_on,
                    place,
                    Some(collect),
                    None,
                    None,
                    None,
                ),
            }
        };
        if pointer.is_null() {
            return Err(environment.log.into_inner().unwrap());
        }
        Ok(Instance3 {
            pointer,
            functions,
            environment,
        })
    }
}

impl Drop for Instance3 {
    fn drop(&mut self) {
        // SAFETY: it lives, and is not used afterwards.
        unsafe { (self.functions.fmi3FreeInstance)(self.pointer) };
    }
}

// SAFETY in all of these: the instance is living, and pointers are valid for their counts.
impl Instance3 {
    /// An instance for Co-Simulation.
    pub fn new() -> Self {
        Creation3::default().make().unwrap()
    }

    pub fn for_model_exchange() -> Self {
        let creation = Creation3 {
            kind: Kind::ModelExchange,
            ..Creation3::default()
        };
        creation.make().unwrap()
    }

    pub fn take_log(&self) -> Vec<Line> {
        std::mem::take(&mut *self.environment.log.lock().unwrap())
    }

    /// Asserts that a call was refused with one sentence in the log, and returns it.
    #[track_caller]
    pub fn refused(&self, status: Status) -> String {
        let log = self.take_log();
        assert_eq!(status, c::ERROR, "{log:?}");
        assert_eq!(log.len(), 1, "{log:?}");
        assert_eq!(
            (log[0].status, &*log[0].category),
            (c::ERROR, "logStatusError")
        );
        log[0].message.clone()
    }

    #[track_caller]
    pub fn ok(&self, status: Status) {
        assert_eq!(status, c::OK, "{:?}", self.take_log());
    }

    #[track_caller]
    pub fn begin_initialization(&self) {
        let enter = self.functions.fmi3EnterInitializationMode;
        // SAFETY: see above.
        self.ok(unsafe { enter(self.pointer, 0, 0.0, 0.0, 0, 0.0) });
    }

    #[track_caller]
    pub fn exit_initialization(&self) {
        // SAFETY: see above.
        self.ok(unsafe { (self.functions.fmi3ExitInitializationMode)(self.pointer) });
    }

    /// Through the initialisation, whose events are taken from the log.
    #[track_caller]
    pub fn initialize(&self) {
        self.begin_initialization();
        self.exit_initialization();
        let mut log = self.environment.log.lock().unwrap();
        log.retain(|line| line.category != "logEvents");
    }

    #[track_caller]
    pub fn enter_event_mode(&self) {
        // SAFETY: see above.
        self.ok(unsafe { (self.functions.fmi3EnterEventMode)(self.pointer) });
    }

    /// Asserts that nothing but the discrete states changes.
    #[track_caller]
    pub fn update_discrete_states(&self) {
        let (mut f, mut time) = ([9; 5], -1.0);
        let [a, b, c, d, e] = f.each_mut();
        let update = self.functions.fmi3UpdateDiscreteStates;
        // SAFETY: see above.
        self.ok(unsafe { update(self.pointer, a, b, c, d, e, &mut time) });
        assert_eq!(f, [0; 5]);
    }

    #[track_caller]
    pub fn enter_step_mode(&self) {
        // SAFETY: see above.
        self.ok(unsafe { (self.functions.fmi3EnterStepMode)(self.pointer) });
    }

    #[track_caller]
    pub fn enter_continuous_time(&self) {
        // SAFETY: see above.
        self.ok(unsafe { (self.functions.fmi3EnterContinuousTimeMode)(self.pointer) });
    }

    pub fn set_floats(&self, names: &[&str], values: &[f64]) -> Status {
        let references: Vec<Reference> = names.iter().map(|n| variable(n).reference).collect();
        let (r, set) = (references.as_ptr(), self.functions.fmi3SetFloat64);
        // SAFETY: see above.
        unsafe {
            let (n, x) = (references.len(), values.as_ptr());
            set(self.pointer, r, n, x, values.len())
        }
    }

    #[track_caller]
    pub fn set(&self, name: &str, value: f64) {
        self.ok(self.set_floats(&[name], &[value]));
    }

    /// Sets an enumeration.
    pub fn choose(&self, name: &str, value: i64) -> Status {
        let set = self.functions.fmi3SetInt64;
        // SAFETY: see above.
        unsafe { set(self.pointer, &variable(name).reference, 1, &value, 1) }
    }

    pub fn set_boolean(&self, name: &str, value: Bool) -> Status {
        let set = self.functions.fmi3SetBoolean;
        // SAFETY: see above.
        unsafe { set(self.pointer, &variable(name).reference, 1, &value, 1) }
    }

    /// Reads into a buffer for `count` values.
    pub fn get_floats(&self, names: &[&str], count: usize) -> (Status, Vec<f64>) {
        let references: Vec<Reference> = names.iter().map(|n| variable(n).reference).collect();
        let mut values = vec![f64::NAN; count];
        let (r, n) = (references.as_ptr(), references.len());
        let get = self.functions.fmi3GetFloat64;
        // SAFETY: see above.
        let status = unsafe { get(self.pointer, r, n, values.as_mut_ptr(), count) };
        (status, values)
    }

    #[track_caller]
    pub fn floats(&self, name: &str) -> Vec<f64> {
        let (status, values) = self.get_floats(&[name], variable(name).count);
        self.ok(status);
        values
    }

    #[track_caller]
    pub fn float(&self, name: &str) -> f64 {
        self.floats(name)[0]
    }

    /// All Float64 variables but `time`, by name.
    #[track_caller]
    pub fn all_floats(&self) -> Vec<f64> {
        let all = variables().values().filter(|v| v.kind == "Float64");
        let all: Vec<&Variable> = all.filter(|v| v.name != "time").collect();
        let names: Vec<&str> = all.iter().map(|v| v.name.as_str()).collect();
        let (status, values) = self.get_floats(&names, all.iter().map(|v| v.count).sum());
        self.ok(status);
        values
    }

    #[track_caller]
    pub fn choice(&self, name: &str) -> i64 {
        let mut value = i64::MIN;
        let get = self.functions.fmi3GetInt64;
        // SAFETY: see above.
        self.ok(unsafe { get(self.pointer, &variable(name).reference, 1, &mut value, 1) });
        value
    }

    /// Makes a step; what happens in intermediate updates is up to `on_update`.
    pub fn step_with(
        &self,
        time: f64,
        size: f64,
        on_update: Option<OnUpdate>,
    ) -> (Status, Stepped) {
        *self.environment.on_update.borrow_mut() = on_update;
        self.environment.instance.set(self);
        let (mut flags, mut reached) = ([9; 3], f64::NAN);
        let [event, end, early] = flags.each_mut();
        let step = self.functions.fmi3DoStep;
        // SAFETY: see above.
        let status = unsafe { step(self.pointer, time, size, 1, event, end, early, &mut reached) };
        if status == c::OK {
            assert!(flags.iter().all(|flag| *flag <= 1) && flags[1] == 0);
        }
        let stepped = Stepped {
            needs_event: flags[0] == 1,
            is_early: flags[2] == 1,
            time: reached,
        };
        (status, stepped)
    }

    #[track_caller]
    pub fn step(&self, time: f64, size: f64) -> Stepped {
        let (status, stepped) = self.step_with(time, size, None);
        self.ok(status);
        stepped
    }

    #[track_caller]
    pub fn states(&self) -> Vec<f64> {
        self.state_vector(self.functions.fmi3GetContinuousStates)
    }

    #[track_caller]
    pub fn derivatives(&self) -> Vec<f64> {
        self.state_vector(self.functions.fmi3GetContinuousStateDerivatives)
    }

    #[track_caller]
    pub fn state_vector(
        &self,
        get: unsafe extern "C" fn(c3::Instance, *mut f64, usize) -> Status,
    ) -> Vec<f64> {
        let mut count = 0;
        // SAFETY: see above.
        unsafe {
            let number = self.functions.fmi3GetNumberOfContinuousStates;
            self.ok(number(self.pointer, &mut count));
            let mut x = vec![f64::NAN; count];
            self.ok(get(self.pointer, x.as_mut_ptr(), count));
            x
        }
    }

    pub fn set_states(&self, x: &[f64]) -> Status {
        // SAFETY: see above.
        unsafe { (self.functions.fmi3SetContinuousStates)(self.pointer, x.as_ptr(), x.len()) }
    }

    /// The bytes of its state.
    #[track_caller]
    pub fn serialized(&self) -> Vec<u8> {
        let (f, instance) = (self.functions, self.pointer);
        let (mut state, mut size): (FmuState, usize) = (ptr::null_mut(), 0);
        // SAFETY: see above.
        unsafe {
            self.ok((f.fmi3GetFMUState)(instance, &mut state));
            self.ok((f.fmi3SerializedFMUStateSize)(instance, state, &mut size));
            let mut bytes = vec![0; size];
            self.ok((f.fmi3SerializeFMUState)(
                instance,
                state,
                bytes.as_mut_ptr(),
                size,
            ));
            self.ok((f.fmi3FreeFMUState)(instance, &mut state));
            assert!(state.is_null());
            bytes
        }
    }

    /// Continues from the bytes of a state.
    pub fn continue_from(&self, bytes: &[u8]) -> Status {
        let (f, instance) = (self.functions, self.pointer);
        let mut state = ptr::null_mut();
        // SAFETY: see above.
        unsafe {
            let read =
                (f.fmi3DeserializeFMUState)(instance, bytes.as_ptr(), bytes.len(), &mut state);
            if read != c::OK {
                return read;
            }
            let set = (f.fmi3SetFMUState)(instance, state);
            self.ok((f.fmi3FreeFMUState)(instance, &mut state));
            set
        }
    }
}
