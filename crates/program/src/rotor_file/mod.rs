//! Rotor definition files: checking one, and writing a new one.

mod check;
mod drawing;
mod new;

pub use check::{Check, block};
pub use new::New;
