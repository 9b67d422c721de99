//! The floating-point environment: which exceptions trap, how results are rounded, and whether
//! subnormal numbers are flushed to zero.
//!
//! An importer, its language or another library in its process may have changed it. Traps would
//! kill the process in harmless 0/0 that the compiler computes beside a guarded division; the other
//! settings would change results.

/// Runs a function in the default environment of IEEE 754: no traps, rounding to nearest,
/// subnormal numbers kept. Afterwards, also after a panic, the importer's environment is back, with
/// the exceptions that were raised in it, and without those that the function raised.
pub fn in_default_environment<T>(function: impl FnOnce() -> T) -> T {
    let _environment = Saved::replace_by_default();
    apart(function)
}

/// Not inlined, so that the compiler moves no computation out of the function.
#[inline(never)]
fn apart<T>(function: impl FnOnce() -> T) -> T {
    function()
}

/// The importer's environment, which returns when this is dropped.
struct Saved(control::Registers);

impl Saved {
    fn replace_by_default() -> Self {
        let saved = control::read();
        control::write(control::DEFAULT);
        Self(saved)
    }
}

impl Drop for Saved {
    fn drop(&mut self) {
        control::write(self.0);
    }
}

/// MXCSR of the SSE unit, in which Rust computes on this processor. It never uses the x87 unit.
#[cfg(target_arch = "x86_64")]
mod control {
    use core::arch::asm;

    pub type Registers = u32;

    /// Intel, Software Developer's Manual, volume 1, section 10.2.3: all exceptions masked, none
    /// raised.
    pub const DEFAULT: Registers = 0x1f80;

    pub fn read() -> Registers {
        let mut value: Registers = 0;
        // SAFETY: writes 4 bytes to `value`.
        unsafe { asm!("stmxcsr [{}]", in(reg) &raw mut value, options(nostack, preserves_flags)) };
        value
    }

    pub fn write(value: Registers) {
        // SAFETY: the value is the default or was read from the register, so that no reserved bit
        // is set. Traps of the importer begin again only where its own computations go on.
        unsafe {
            asm!("ldmxcsr [{}]", in(reg) &raw const value, options(nostack, preserves_flags))
        };
    }
}

/// FPCR (control) and FPSR (exceptions raised).
#[cfg(target_arch = "aarch64")]
mod control {
    use core::arch::asm;

    pub type Registers = (u64, u64);

    /// Arm, Architecture Reference Manual for A-profile, C5.2.8 and C5.2.9.
    pub const DEFAULT: Registers = (0, 0);

    pub fn read() -> Registers {
        let (control, status): Registers;
        // SAFETY: reads two registers.
        unsafe {
            asm!("mrs {}, fpcr", "mrs {}, fpsr", out(reg) control, out(reg) status,
                options(nostack, preserves_flags));
        }
        (control, status)
    }

    pub fn write((control, status): Registers) {
        // SAFETY: the values are the default or were read from the registers. Traps of the importer
        // begin again only where its own computations go on.
        unsafe {
            asm!("msr fpsr, {}", "msr fpcr, {}", in(reg) status, in(reg) control,
                options(nostack, preserves_flags));
        }
    }
}

/// Elsewhere (WebAssembly has no such environment) nothing is changed.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
mod control {
    pub type Registers = ();
    pub const DEFAULT: Registers = ();
    pub fn read() -> Registers {}
    pub fn write((): Registers) {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::panic::{AssertUnwindSafe, catch_unwind};

    #[test]
    fn the_environment_is_the_default_inside_and_as_before_afterwards_also_after_a_panic() {
        #[cfg(target_arch = "x86_64")]
        let changed = 0x7fa1; // rounding towards zero, an invalid operation and inexactness raised
        #[cfg(target_arch = "aarch64")]
        let changed = (3 << 22, 0x11);
        #[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
        let changed = ();
        let before = control::read();
        control::write(changed);
        let inside = in_default_environment(control::read);
        let after = control::read();
        let panicked = catch_unwind(AssertUnwindSafe(|| {
            in_default_environment(|| std::panic::resume_unwind(Box::new(())));
        }));
        let after_panic = control::read();
        control::write(before);
        assert_eq!(inside, control::DEFAULT);
        assert_eq!(after, changed);
        assert!(panicked.is_err());
        assert_eq!(after_panic, changed);
    }
}
