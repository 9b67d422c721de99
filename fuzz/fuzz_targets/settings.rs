//! The parameter `settings`: any text is refused and changes nothing, or sets parameters with which
//! an instance starts with finite numbers or an error.

#![no_main]

use fuzz::{Instance, promise};
use helicopter_rotor::{
    block::variables::string,
    fmi2::{
        get_set::fmi2SetString,
        life_cycle::{fmi2EnterInitializationMode, fmi2ExitInitializationMode},
        types::*,
    },
};
use libfuzzer_sys::fuzz_target;
use std::ffi::CString;

fuzz_target!(|text: &str| {
    let Ok(text) = CString::new(text) else {
        return;
    };
    let instance = Instance::new(FMI2_CO_SIMULATION);
    instance.simplify();
    let before = instance.serialized();
    let reference = string::SETTINGS.number();
    // SAFETY: the instance lives, and the pointers live during the calls.
    unsafe {
        if fmi2SetString(instance.0, &reference, 1, &text.as_ptr()) != fmi2Status::Ok {
            promise(instance.serialized() == before, || {
                "refused settings have changed something".into()
            });
            return;
        }
        fmi2EnterInitializationMode(instance.0);
        if instance.is_quick() {
            fmi2ExitInitializationMode(instance.0);
            instance.reals();
        }
    }
});
