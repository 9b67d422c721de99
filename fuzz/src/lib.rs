//! What the targets share: an instance whose log is checked.

use helicopter_rotor::{
    block::variables::{GUID, IntegerRef, REALS, integer, real},
    fmi2::{
        co_simulation::fmi2GetRealStatus,
        creation::{fmi2FreeInstance, fmi2Instantiate},
        fmu_state::*,
        get_set::{fmi2GetInteger, fmi2GetReal, fmi2SetInteger},
        types::*,
    },
};
use std::{
    ffi::{CStr, CString, c_char, c_int, c_void},
    ptr,
};

/// Ends the process: the fuzzer keeps the input. The library's own panic hook prints nothing, so
/// that a panic would leave no message.
pub fn fail(what: &str) -> ! {
    eprintln!("{what}");
    std::process::abort()
}

/// Fails if a promise does not hold.
pub fn promise(holds: bool, what: impl FnOnce() -> String) {
    if !holds {
        fail(&what());
    }
}

/// The logger: each message is a sentence of limited length, the format of a printf without
/// arguments, and never tells of a caught panic.
unsafe extern "C" fn check(
    _: *mut c_void,
    _: *const c_char,
    _: fmi2Status,
    _: *const c_char,
    message: *const c_char,
) {
    // SAFETY: the string lives during this call, as the standard demands.
    let message = unsafe { CStr::from_ptr(message) };
    let Ok(message) = message.to_str() else {
        fail(&format!("not UTF-8: {message:?}"))
    };
    let unescaped = message.replace("%%", "");
    promise(!unescaped.contains('%'), || format!("a format: {message}"));
    let length = message.replace("%%", "%").chars().count();
    promise((1..=500).contains(&length), || {
        format!("{length} characters: {message}")
    });
    promise(!message.contains("internal error"), || message.to_owned());
}

/// An instance; it is freed when it is dropped.
pub struct Instance(pub fmi2Component);

impl Instance {
    /// A new instance for an interface, with the project's resources. It logs everything.
    pub fn new(kind: fmi2Enumeration) -> Self {
        let plain: unsafe extern "C" fn(_, _, _, _, _) = check;
        let functions = fmi2CallbackFunctions {
            // SAFETY: the library passes no variadic arguments. Named arguments go the same way
            // with and without variadic ones behind them.
            logger: Some(unsafe {
                std::mem::transmute::<
                    unsafe extern "C" fn(
                        *mut c_void,
                        *const c_char,
                        fmi2Status,
                        *const c_char,
                        *const c_char,
                    ),
                    fmi2CallbackLogger,
                >(plain)
            }),
            allocateMemory: None,
            freeMemory: None,
            stepFinished: None,
            componentEnvironment: ptr::null_mut(),
        };
        let resources = concat!(env!("CARGO_MANIFEST_DIR"), "/../modelDescription/resources");
        let [guid, resources] = [GUID, resources].map(|text| CString::new(text).unwrap());
        let (name, guid, resources) = (c"rotor".as_ptr(), guid.as_ptr(), resources.as_ptr());
        // SAFETY: the pointers live during the call.
        let component = unsafe { fmi2Instantiate(name, kind, guid, resources, &functions, 0, 1) };
        promise(!component.is_null(), || "no instance".to_owned());
        Self(component)
    }

    /// A blade of few elements, so that nothing takes long.
    pub fn simplify(&self) {
        self.set_integer(integer::NUMERICS__ELEMENTS, 4);
    }

    pub fn set_integer(&self, reference: IntegerRef, value: c_int) {
        // SAFETY: the pointers live during the call.
        let status = unsafe { fmi2SetInteger(self.0, &reference.number(), 1, &value) };
        promise(status == fmi2Status::Ok, || "not set".to_owned());
    }

    /// All Real variables. Where that is OK, they are finite.
    pub fn reals(&self) -> Option<Vec<f64>> {
        let references: Vec<fmi2ValueReference> = (0..REALS.len() as u32).collect();
        let mut values = vec![f64::NAN; references.len()];
        let (vr, value) = (references.as_ptr(), values.as_mut_ptr());
        // SAFETY: the pointers are valid for the count.
        let status = unsafe { fmi2GetReal(self.0, vr, values.len(), value) };
        (status == fmi2Status::Ok).then(|| {
            finite(&values);
            values
        })
    }

    /// The complete state as bytes.
    pub fn serialized(&self) -> Vec<u8> {
        let (mut state, mut size) = (ptr::null_mut(), 0);
        // SAFETY: the pointers live during the calls.
        unsafe {
            let taken = fmi2GetFMUstate(self.0, &mut state);
            let sized = fmi2SerializedFMUstateSize(self.0, state, &mut size);
            let mut bytes = vec![0_u8; size];
            let written = fmi2SerializeFMUstate(self.0, state, bytes.as_mut_ptr().cast(), size);
            let freed = fmi2FreeFMUstate(self.0, &mut state);
            let is_ok = [taken, sized, written, freed] == [fmi2Status::Ok; 4];
            promise(is_ok, || "no state".into());
            bytes
        }
    }

    /// Whether a step takes little time: few elements, moderate speeds, coarse steps.
    pub fn is_quick(&self) -> bool {
        let (mut elements, mut reals) = (0, [0.0; 2]);
        let references = [real::RPM, real::NUMERICS__AZIMUTH_STEP].map(|r| r.number());
        // SAFETY: the pointers live during the calls.
        unsafe {
            let reference = integer::NUMERICS__ELEMENTS.number();
            fmi2GetInteger(self.0, &reference, 1, &mut elements);
            fmi2GetReal(self.0, references.as_ptr(), 2, reals.as_mut_ptr());
        }
        elements <= 50 && reals[0] < 1e4 && reals[1] > 0.01
    }

    /// The end of the last step, or the start.
    pub fn time(&self) -> f64 {
        let mut time = 0.0;
        // SAFETY: the place lives during the call.
        unsafe { fmi2GetRealStatus(self.0, FMI2_LAST_SUCCESSFUL_TIME, &mut time) };
        time
    }
}

impl Drop for Instance {
    fn drop(&mut self) {
        // SAFETY: from fmi2Instantiate, and not used afterwards.
        unsafe { fmi2FreeInstance(self.0) };
    }
}

/// Fails if a number that was read with fmi2OK is not finite.
pub fn finite(values: &[f64]) {
    promise(values.iter().all(|v| v.is_finite()), || {
        format!("not finite: {values:?}")
    });
}
