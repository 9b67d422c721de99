//! Value references, one type for each FMI base type, and arrays that only the right type indexes.
//!
//! A reference of one base type does not read the values of another:
//!
//! ```
//! use helicopter_rotor::block::{Values, variables::{integer, real}};
//!
//! let values = Values::default();
//! assert_eq!(values.reals[real::RPM], 960.0);
//! assert_eq!(values.integers[integer::GEOMETRY__NUMBER_OF_BLADES], 4);
//! ```
//!
//! ```compile_fail,E0308
//! use helicopter_rotor::block::{Values, variables::integer};
//!
//! let values = Values::default();
//! let wrong = values.reals[integer::GEOMETRY__NUMBER_OF_BLADES];
//! ```
//!
//! Nor does it set them:
//!
//! ```compile_fail,E0277
//! use helicopter_rotor::block::{RotorBlock, variables::integer};
//!
//! let mut block = RotorBlock::new("resources".into());
//! block.set_reals(&[integer::GEOMETRY__NUMBER_OF_BLADES], &[960.0]);
//! ```

use super::{
    values::ValueError,
    variables::{BOOLEANS, INTEGERS, REALS, STRINGS, Variable},
};
use core::{
    marker::PhantomData,
    ops::{Deref, DerefMut, Index, IndexMut},
};
use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};

/// A value reference of a variable that exists. It is the variable's index in the table of its
/// base type and in the arrays of values.
pub trait Reference: Copy + Into<u32> + 'static {
    type Value: 'static;
    /// The base type, as messages name it.
    const BASE_TYPE: &'static str;

    fn index(self) -> usize;
    fn variable(self) -> &'static Variable<Self::Value>;
}

/// Names a variable: by a reference, or by the number that an importer passes for one.
pub trait Names<R>: Copy {
    /// An error if there is no such variable.
    fn reference(self) -> Result<R, ValueError>;
}

macro_rules! references {
    ($($name:ident, $base_type:literal, $table:ident, $value:ty;)*) => {$(
        #[doc = concat!("Value reference of a variable of the type ", $base_type, ".")]
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
        pub struct $name(u32);

        impl $name {
            /// For the constants of the generated table.
            pub(super) const fn at(index: u32) -> Self {
                assert!((index as usize) < $table.len());
                Self(index)
            }

            /// The number that FMI passes for it.
            pub const fn number(self) -> u32 {
                self.0
            }

            /// All references of this type, in ascending order.
            pub fn all() -> impl DoubleEndedIterator<Item = Self> + Clone {
                (0..$table.len() as u32).map(Self)
            }

            /// The variable's row in the table.
            pub const fn variable(self) -> &'static Variable<$value> {
                &$table[self.0 as usize]
            }
        }

        impl Reference for $name {
            type Value = $value;
            const BASE_TYPE: &'static str = $base_type;

            fn index(self) -> usize {
                self.0 as usize
            }

            fn variable(self) -> &'static Variable<$value> {
                self.variable()
            }
        }

        impl Names<Self> for $name {
            fn reference(self) -> Result<Self, ValueError> {
                Ok(self)
            }
        }

        impl Names<$name> for u32 {
            fn reference(self) -> Result<$name, ValueError> {
                if (self as usize) < $table.len() {
                    return Ok($name(self));
                }
                Err(ValueError::Unknown {
                    reference: self,
                    base_type: $base_type,
                    last: $table.len().saturating_sub(1),
                })
            }
        }

        impl From<$name> for u32 {
            fn from(reference: $name) -> Self {
                reference.0
            }
        }
    )*};
}

references! {
    RealRef, "Real", REALS, f64;
    IntegerRef, "Integer or Enumeration", INTEGERS, i32;
    BooleanRef, "Boolean", BOOLEANS, bool;
    StringRef, "String", STRINGS, &'static str;
}

impl RealRef {
    /// Whether it is that of a continuous state.
    pub fn is_state(self) -> bool {
        self.variable().is_state
    }
}

/// One `T` for each variable of a base type, indexed by its reference `R`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerVariable<R, T, const N: usize> {
    values: [T; N],
    by: PhantomData<R>,
}

/// A number for each Real variable.
pub type Reals<S = f64> = PerVariable<RealRef, S, { REALS.len() }>;
pub type Integers = PerVariable<IntegerRef, i32, { INTEGERS.len() }>;
pub type Booleans = PerVariable<BooleanRef, bool, { BOOLEANS.len() }>;
pub type Strings = PerVariable<StringRef, String, { STRINGS.len() }>;

impl<R, T, const N: usize> PerVariable<R, T, N> {
    /// From values in the order of the references.
    pub const fn new(values: [T; N]) -> Self {
        Self {
            values,
            by: PhantomData,
        }
    }

    pub fn map<U>(self, f: impl FnMut(T) -> U) -> PerVariable<R, U, N> {
        PerVariable::new(self.values.map(f))
    }
}

impl<R: Reference, T, const N: usize> Index<R> for PerVariable<R, T, N> {
    type Output = T;

    fn index(&self, reference: R) -> &T {
        &self.values[reference.index()]
    }
}

impl<R: Reference, T, const N: usize> IndexMut<R> for PerVariable<R, T, N> {
    fn index_mut(&mut self, reference: R) -> &mut T {
        &mut self.values[reference.index()]
    }
}

/// The values in the order of the references.
impl<R, T, const N: usize> Deref for PerVariable<R, T, N> {
    type Target = [T; N];

    fn deref(&self) -> &[T; N] {
        &self.values
    }
}

impl<R, T, const N: usize> DerefMut for PerVariable<R, T, N> {
    fn deref_mut(&mut self) -> &mut [T; N] {
        &mut self.values
    }
}

impl<R, T, const N: usize> IntoIterator for PerVariable<R, T, N> {
    type Item = T;
    type IntoIter = core::array::IntoIter<T, N>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.into_iter()
    }
}

impl<'a, R, T, const N: usize> IntoIterator for &'a PerVariable<R, T, N> {
    type Item = &'a T;
    type IntoIter = core::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.values.iter()
    }
}

impl<R, T: Serialize, const N: usize> Serialize for PerVariable<R, T, N> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(&self.values)
    }
}

impl<'de, R, T: Deserialize<'de>, const N: usize> Deserialize<'de> for PerVariable<R, T, N> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let values = Vec::<T>::deserialize(deserializer)?.try_into();
        let values = values.map_err(|_| D::Error::custom("another number of variables"))?;
        Ok(Self::new(values))
    }
}
