//! An importer's process may trap floating-point exceptions, round in another direction or flush
//! subnormal numbers: the results are the same, and its environment stays as it was.

#![cfg(target_arch = "x86_64")]

use crate::support::{Instance, c, child, instance::bits};
use helicopter_rotor::block::variables::{REALS, integer};
use std::arch::asm;

/// MXCSR: the default, and the bits of Intel's Software Developer's Manual, volume 1, 10.2.3.
pub const DEFAULT: u32 = 0x1f80;
const MASKS: u32 = 0x1f80;
const FLUSH_TO_ZERO: u32 = 1 << 15;
const DENORMALS_ARE_ZERO: u32 = 1 << 6;
const DOWN: u32 = 1 << 13;
const UP: u32 = 2 << 13;
const TOWARDS_ZERO: u32 = 3 << 13;
const INVALID: u32 = 1;
const DIVISION_BY_ZERO: u32 = 1 << 2;
const OVERFLOW: u32 = 1 << 3;
const UNDERFLOW: u32 = 1 << 4;
const INEXACT: u32 = 1 << 5;

/// Traps of three kinds and of all, other rounding, and flushing.
pub const OTHERS: [u32; 6] = [
    DEFAULT & !(INVALID | DIVISION_BY_ZERO | OVERFLOW) << 7,
    DEFAULT & !MASKS,
    DEFAULT | DOWN | INEXACT,
    DEFAULT | UP | UNDERFLOW,
    DEFAULT | TOWARDS_ZERO | INVALID,
    DEFAULT | FLUSH_TO_ZERO | DENORMALS_ARE_ZERO,
];

pub fn mxcsr() -> u32 {
    let mut value = 0_u32;
    // SAFETY: writes 4 bytes to `value`.
    unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value) };
    value
}

pub fn set_mxcsr(value: u32) {
    // SAFETY: only defined bits are set.
    unsafe { asm!("ldmxcsr [{}]", in(reg) &raw const value) };
}

/// Makes calls in an environment, and asserts that each leaves it as it is.
pub struct Host(pub u32);

impl Host {
    #[inline(never)]
    pub fn call<T>(&self, what: &str, call: impl FnOnce() -> T) -> T {
        set_mxcsr(self.0);
        let answer = call();
        let after = mxcsr();
        set_mxcsr(DEFAULT);
        assert_eq!(after, self.0, "{what} changed the environment {:x}", self.0);
        answer
    }
}

/// All values after a flight with an inflow model, and derivatives.
fn fly(host: &Host, inflow: i32, flaps: bool, inputs: &[(&str, f64)]) -> Vec<u64> {
    let rotor = host.call("fmi2Instantiate", Instance::new);
    host.call("fmi2SetInteger", || {
        assert_eq!(rotor.set_integer("models.inflow", inflow), c::OK);
        assert_eq!(rotor.set_integer("numerics.elements", 8), c::OK);
        assert_eq!(rotor.set_boolean("flapping.enabled", flaps.into()), c::OK);
    });
    host.call("fmi2SetReal", || {
        for (name, value) in inputs {
            assert_eq!(rotor.set_real(name, *value), c::OK, "{name}");
        }
    });
    host.call("fmi2ExitInitializationMode", || rotor.initialize());
    let mut seen = host.call("fmi2GetReal", || bits(&rotor.reals()));
    for i in 0..2 {
        host.call("fmi2DoStep", || {
            let status = rotor.step(0.01 * f64::from(i), 0.01);
            assert_eq!(status, c::OK, "{:?}", rotor.take_log());
        });
        seen.extend(host.call("fmi2GetReal", || bits(&rotor.reals())));
    }
    let slope = host.call("fmi2GetDirectionalDerivative", || {
        rotor.derivative("thrust", "collective")
    });
    seen.push(slope.to_bits());
    host.call("fmi2FreeInstance", || drop(rotor));
    seen
}

/// Hover, climb, descent in the vortex ring, forward flight, a stopped rotor in wind and all at
/// rest, with every inflow model, and with flapping where it can flap.
#[test]
fn traps_rounding_and_flushing_of_the_importer_change_no_bit_and_stay() {
    let name =
        "float_environment::traps_rounding_and_flushing_of_the_importer_change_no_bit_and_stay";
    if child::run_alone(name).is_some() {
        return;
    }
    let flights: [&[(&str, f64)]; 6] = [
        &[("collective", 0.14)],
        &[("velocity[3]", 3.0)],
        &[("velocity[3]", -4.0)],
        &[("velocity[1]", 15.0)],
        &[("rpm", 0.0), ("wind[1]", 10.0)],
        &[("rpm", 0.0), ("collective", 0.0)],
    ];
    let mut cases = 0;
    for inflow in 1..=integer::MODELS__INFLOW.variable().choices.len() as i32 {
        for flaps in [false, true] {
            if (inflow, flaps) == (1, true) {
                continue; // The closed form is for rigid blades.
            }
            for flight in flights {
                let usual = fly(&Host(DEFAULT), inflow, flaps, flight);
                for environment in OTHERS {
                    let here = fly(&Host(environment), inflow, flaps, flight);
                    let case = format!("inflow {inflow}, {flaps}, {flight:?}, {environment:x}");
                    assert_eq!(here.len(), usual.len());
                    let other = here.iter().zip(&usual).position(|(a, b)| a != b);
                    let variable = other.map(|i| REALS[i % REALS.len()].name);
                    assert_eq!(variable, None, "{case}");
                }
                cases += 1;
            }
        }
    }
    assert_eq!(cases, 25 * 6);
}
