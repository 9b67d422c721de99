//! Which values a rotor file gave, and what they were before.

use super::{
    references::Names,
    values::{ValueError, Values},
    variables::{BOOLEANS, INTEGERS, REALS, RealRef, STRINGS, StringRef, real},
};
use serde::{Deserialize, Serialize};

/// The values that a rotor file gave for parameters and inputs that the importer has not set.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct FromFile {
    replaced: Vec<Own>,
    /// Whether the importer has set `rpm` and `collective`, even if to their defaults.
    has_rpm: bool,
    has_collective: bool,
}

/// A value before the file's, by its value reference.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub enum Own {
    Real(u32, f64),
    Integer(u32, i32),
    Boolean(u32, bool),
    Text(u32, String),
}

impl FromFile {
    /// Keeps a value that the file's will replace.
    pub fn push(&mut self, own: Own) {
        self.replaced.push(own);
    }

    /// Whether the importer has set this input.
    pub fn is_set(&self, input: RealRef) -> bool {
        (input == real::RPM && self.has_rpm) || (input == real::COLLECTIVE && self.has_collective)
    }

    /// The importer has set a Real variable. An input keeps its value whatever the file says.
    pub fn set_by_importer(&mut self, reference: RealRef) {
        match reference {
            real::RPM => self.has_rpm = true,
            real::COLLECTIVE => self.has_collective = true,
            _ => return,
        }
        let number = reference.number();
        self.replaced
            .retain(|own| !matches!(own, Own::Real(known, _) if *known == number));
    }

    /// Whether the file's value replaced this one. An importer that writes its values again after
    /// the initialisation writes this one.
    pub fn replaced(&self, own: &Own) -> bool {
        self.replaced.contains(own)
    }

    /// As `replaced`, without the allocation of a text.
    pub fn replaced_text(&self, reference: u32, text: &str) -> bool {
        let is_this = |own: &Own| matches!(own, Own::Text(known, value) if *known == reference && value == text);
        self.replaced.iter().any(is_this)
    }

    /// Whether the file gave the value of a String variable.
    pub fn gave(&self, text: StringRef) -> bool {
        let is_this = |own: &Own| matches!(own, Own::Text(known, _) if *known == text.number());
        self.replaced.iter().any(is_this)
    }

    /// Whether each value that was replaced may be one of its variable.
    pub fn is_sound(&self) -> bool {
        self.replaced.iter().all(|own| match own {
            Own::Real(r, value) => REALS
                .get(*r as usize)
                .is_some_and(|v| (v.min..=v.max).contains(value)),
            Own::Integer(r, value) => INTEGERS
                .get(*r as usize)
                .is_some_and(|v| (v.min..=v.max).contains(value)),
            Own::Boolean(r, _) => (*r as usize) < BOOLEANS.len(),
            Own::Text(r, text) => (*r as usize) < STRINGS.len() && !text.contains('\0'),
        })
    }
}

impl Values {
    /// Puts back the values that a rotor file's have replaced.
    pub fn withdraw_file(&mut self) -> Result<(), ValueError> {
        for own in std::mem::take(&mut self.from_file.replaced) {
            match own {
                Own::Real(reference, value) => self.reals[reference.reference()?] = value,
                Own::Integer(reference, value) => self.integers[reference.reference()?] = value,
                Own::Boolean(reference, value) => self.booleans[reference.reference()?] = value,
                Own::Text(reference, value) => self.strings[reference.reference()?] = value,
            }
        }
        Ok(())
    }

    /// Whether a rotor file gave any of the values.
    pub fn has_file_values(&self) -> bool {
        !self.from_file.replaced.is_empty()
    }
}
