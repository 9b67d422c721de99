//! The flights whose cost is measured, through the C interface as an importer has it.

pub mod blades;

use helicopter_rotor::{
    block::variables::{GUID, REALS, STRINGS, Variable},
    fmi2::{co_simulation::*, creation::*, directional::*, get_set::*, life_cycle::*, types::*},
};
use std::{ffi::CString, hint::black_box, ptr};

/// 960 rev/min, as in Knight & Hefner's hover tests.
const RPM: f64 = 960.0;

/// Duration of 3 deg at 960 rev/min, the default step in azimuth, s.
pub const AZIMUTH_STEP: f64 = 3.0 / (6.0 * RPM);

/// The rotor speed for factors of real time, rev/min.
#[allow(dead_code)] // counts of instructions need none
pub const REAL_TIME_RPM: f64 = 430.0;

/// A rotor that flies.
pub struct Flight {
    component: fmi2Component,
    time: f64,
    rpm: f64,
    forward: f64,
    is_up: bool,
    inputs: [fmi2ValueReference; 3],
    outputs: [fmi2ValueReference; 6],
}

/// A flight to begin: parameters as in `settings`, rotor speed, rev/min, forward speed and climb,
/// m/s.
#[derive(Clone)]
pub struct Begin {
    settings: String,
    rpm: f64,
    forward: f64,
    climb: f64,
}

impl Begin {
    /// Hover in still air.
    pub fn hover(settings: &str) -> Self {
        Self {
            settings: settings.to_owned(),
            rpm: RPM,
            forward: 0.0,
            climb: 0.0,
        }
    }

    /// Descent in the vortex ring state.
    pub fn descent(settings: &str) -> Self {
        Self {
            climb: -4.0,
            ..Self::hover(settings)
        }
    }

    /// Forward flight at an advance ratio of 0.2 with blades that flap, in an inflow model.
    pub fn flapping(inflow: &str) -> Self {
        Self {
            forward: 15.3,
            ..Self::hover(&format!(
                "flapping.enabled = true; models.inflow = {inflow}"
            ))
        }
    }

    /// The same at another rotor speed and the same advance ratio.
    #[allow(dead_code)] // counts of instructions need none
    pub fn at(self, rpm: f64) -> Self {
        let forward = self.forward * rpm / self.rpm;
        Self {
            rpm,
            forward,
            ..self
        }
    }
}

fn reference<T>(table: &[Variable<T>], name: &str) -> fmi2ValueReference {
    let place = table.iter().position(|v| v.name == name);
    place.unwrap_or_else(|| panic!("no variable {name}")) as fmi2ValueReference
}

fn ok(status: fmi2Status) {
    assert!(status == fmi2Status::Ok, "{status:?}");
}

impl Flight {
    /// An instance in initialization mode.
    pub fn prepared(begin: Begin) -> Self {
        let text = |text: &str| CString::new(text).unwrap();
        let (name, guid) = (text("rotor"), text(GUID));
        let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/modelDescription/resources");
        let resources = text(&format!("file://{folder}"));
        let settings = text(&begin.settings);
        // SAFETY: the strings live during the calls.
        unsafe {
            let callbacks = fmi2CallbackFunctions {
                logger: None,
                allocateMemory: None,
                freeMemory: None,
                stepFinished: None,
                componentEnvironment: ptr::null_mut(),
            };
            let component = fmi2Instantiate(
                name.as_ptr(),
                FMI2_CO_SIMULATION,
                guid.as_ptr(),
                resources.as_ptr(),
                &callbacks,
                0,
                0,
            );
            assert!(!component.is_null());
            let of = reference(STRINGS.as_slice(), "settings");
            ok(fmi2SetString(component, &of, 1, &settings.as_ptr()));
            let mut flight = Self {
                component,
                time: 0.0,
                rpm: begin.rpm,
                forward: begin.forward,
                is_up: false,
                inputs: ["collective", "rpm", "velocity[1]"].map(|n| reference(&REALS, n)),
                outputs: [
                    "force[1]",
                    "force[2]",
                    "force[3]",
                    "moment[1]",
                    "moment[2]",
                    "moment[3]",
                ]
                .map(|n| reference(&REALS, n)),
            };
            let climb = reference(&REALS, "velocity[3]");
            ok(fmi2SetReal(component, &climb, 1, &begin.climb));
            flight.set(8.0);
            ok(fmi2SetupExperiment(component, 0, 0.0, 0.0, 0, 0.0));
            ok(fmi2EnterInitializationMode(component));
            flight
        }
    }

    /// A flight at its start.
    pub fn begun(begin: Begin) -> Self {
        let mut flight = Self::prepared(begin);
        flight.initialize();
        flight
    }

    /// A flight after a few steps in azimuth.
    pub fn under_way(begin: Begin) -> Self {
        let mut flight = Self::begun(begin);
        for _ in 0..5 {
            flight.step(AZIMUTH_STEP);
        }
        flight
    }

    /// Moves the collective to and fro, advances, and gets the outputs: what a system model does
    /// in each of its steps.
    #[inline(never)]
    pub fn exchange(&mut self, duration: f64) -> [f64; 6] {
        self.is_up = !self.is_up;
        self.set(if self.is_up { 8.1 } else { 8.0 });
        self.step(duration);
        self.get()
    }

    /// Ends the initialization.
    pub fn initialize(&mut self) {
        // SAFETY: the component lives.
        ok(unsafe { fmi2ExitInitializationMode(self.component) });
        self.get();
    }

    /// Sets three inputs: collective, deg; rotor speed; forward speed.
    pub fn set(&mut self, collective: f64) {
        let values = [black_box(collective).to_radians(), self.rpm, self.forward];
        // SAFETY: three references and values.
        ok(unsafe { fmi2SetReal(self.component, self.inputs.as_ptr(), 3, values.as_ptr()) });
    }

    /// Gets six outputs.
    pub fn get(&mut self) -> [f64; 6] {
        let mut values = [0.0; 6];
        // SAFETY: six references and values.
        ok(unsafe {
            fmi2GetReal(
                self.component,
                self.outputs.as_ptr(),
                6,
                values.as_mut_ptr(),
            )
        });
        black_box(values)
    }

    /// Advances by a time, s.
    pub fn step(&mut self, duration: f64) {
        // SAFETY: the component lives.
        ok(unsafe { fmi2DoStep(self.component, self.time, duration, 1) });
        self.time += duration;
    }

    /// The derivative of the force along z by the collective.
    pub fn derivative(&mut self) -> f64 {
        let (direction, mut change) = (1.0, 0.0);
        // SAFETY: one of each.
        ok(unsafe {
            fmi2GetDirectionalDerivative(
                self.component,
                &self.outputs[2],
                1,
                &self.inputs[0],
                1,
                &direction,
                &mut change,
            )
        });
        black_box(change)
    }
}

impl Drop for Flight {
    fn drop(&mut self) {
        // SAFETY: the component lives and is not used again.
        unsafe { fmi2FreeInstance(self.component) };
    }
}
