//! Numbers side by side: one source for one number and for four, plain or dual.
//!
//! The formulas of a blade element are the same for every element, so they are written once for
//! any [`Lanes`]: a single number, or four neighbouring elements at a time in the registers of the
//! processor. Each lane is computed by the same operations in the same order, without fused
//! multiply-add, and sums over lanes have a fixed order of four. So the bits of an answer do not
//! depend on the processor:
//!
//! ```text
//! f64                   one number, outside of the blocks of elements
//! Pair<Pair<f64>>       four, one after the other, on any processor: the definition
//! Pair<Sse2>            four in two registers: every x86-64
//! Pair<Neon>            four in two registers: every 64-bit ARM
//! Avx2                  four in one register: chosen at run time
//! ```
//!
//! A branch becomes a choice between two values that are both computed ([`Lanes::select`]). An
//! expensive branch is skipped if no lane needs it. Iterations end together for all lanes.
//!
//! Functions of lanes are `#[inline(always)]`: only then does the compiler use the wide registers
//! of the caller, which [`run()`] chooses. In registers that every processor has the elementary
//! functions are called instead: copies in each place are large.
//!
//! Outside of the elements numbers come one by one: a [`Scalar`].

#[cfg(target_arch = "x86_64")]
mod avx2;
mod constant;
mod dual;
mod elementary;
mod lanes;
#[cfg(target_arch = "aarch64")]
mod neon;
mod one;
mod pair;
mod run;
mod scalar;
#[cfg(target_arch = "x86_64")]
mod sse2;

use lanes::alike_in_plain_lanes;

pub use constant::C;
pub use dual::{Dual, Dual64};
pub use lanes::{Equation, LANES, Lanes, Mask, PerLane, Plain, converted};
pub use run::{Kernel, Portable, Width, run};
pub use scalar::Scalar;
