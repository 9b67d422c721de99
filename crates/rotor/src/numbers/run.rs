//! The choice of the lanes in which a computation runs.

#[cfg(target_arch = "aarch64")]
use super::neon::Neon;
use super::{Plain, pair::Pair};
#[cfg(target_arch = "x86_64")]
use super::{avx2::Avx2, sse2::Sse2};

/// The lanes that every processor of this architecture has.
#[cfg(target_arch = "x86_64")]
pub type Portable = Pair<Sse2>;
/// The lanes that every processor of this architecture has.
#[cfg(target_arch = "aarch64")]
pub type Portable = Pair<Neon>;
/// The lanes that every processor of this architecture has.
#[cfg(not(any(target_arch = "x86_64", target_arch = "aarch64")))]
pub type Portable = Pair<Pair<f64>>;

/// How many lanes a register holds. The bits of an answer do not depend on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Width {
    /// The widest that the processor has.
    #[default]
    Widest,
    /// What every processor of this architecture has.
    Portable,
    /// Four numbers one after the other; for tests.
    #[cfg(test)]
    Single,
}

/// A computation for any lanes; `run` is `#[inline(always)]`, with all that it calls in lanes.
pub trait Kernel {
    /// What it computes.
    type Output;
    /// Computes in lanes of the kind `V`, `LANES` of them.
    fn run<V: Plain>(self) -> Self::Output;
}

/// Runs a computation in lanes.
pub fn run<K: Kernel>(width: Width, kernel: K) -> K::Output {
    match width {
        #[cfg(test)]
        Width::Single => kernel.run::<Pair<Pair<f64>>>(),
        #[cfg(target_arch = "x86_64")]
        Width::Widest if has_avx2() => {
            // SAFETY: the processor has AVX2.
            unsafe { in_avx2(kernel) }
        }
        Width::Widest | Width::Portable => kernel.run::<Portable>(),
    }
}

/// Whether to use AVX2.
#[cfg(target_arch = "x86_64")]
fn has_avx2() -> bool {
    !cfg!(feature = "portable") && std::arch::is_x86_feature_detected!("avx2")
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2")]
fn in_avx2<K: Kernel>(kernel: K) -> K::Output {
    kernel.run::<Avx2>()
}
