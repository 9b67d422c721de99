//! What a rotor file gives for parameters of the FMU.

use serde::{
    Deserialize, Deserializer,
    de::{Error, MapAccess, Visitor},
};
use std::fmt;
use toml::Spanned;

/// Maximum number of parameters in a table.
const MAX_PARAMETERS: usize = 60;

/// A value that a rotor file gives for a parameter.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    /// Name of the parameter in the FMU, such as `models.inflow`.
    pub name: String,
    /// As in the file: angles are in degrees.
    pub value: GivenValue,
    /// Line in the file, from 1; 0 for what follows from other lines.
    pub line: usize,
}

/// The value itself.
#[derive(Debug, Clone, PartialEq)]
pub enum GivenValue {
    /// true or false.
    Boolean(bool),
    /// A number without a decimal point.
    Integer(i64),
    /// Any number.
    Number(f64),
    /// A text, such as the name of a choice.
    Text(String),
}

impl Given {
    pub(super) fn new(name: &str, value: GivenValue, line: usize) -> Self {
        Self {
            name: name.to_owned(),
            value,
            line,
        }
    }

    pub(super) fn number(name: &str, value: f64, line: usize) -> Self {
        Self::new(name, GivenValue::Number(value), line)
    }
}

impl fmt::Display for GivenValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Boolean(value) => write!(f, "{value}"),
            Self::Integer(value) => write!(f, "{value}"),
            Self::Number(value) => write!(f, "{value}"),
            Self::Text(value) => write!(f, "{value:?}"),
        }
    }
}

/// A table of parameters.
pub(super) struct FileParameters(pub(super) Vec<(String, Spanned<GivenValue>)>);

impl<'de> Deserialize<'de> for FileParameters {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Table;
        impl<'de> Visitor<'de> for Table {
            type Value = FileParameters;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a table of parameters")
            }

            fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<FileParameters, A::Error> {
                let mut found = Vec::new();
                while let Some(entry) = map.next_entry()? {
                    if found.len() == MAX_PARAMETERS {
                        return Err(A::Error::custom(
                            "this table has too many keys; remove some",
                        ));
                    }
                    found.push(entry);
                }
                Ok(FileParameters(found))
            }
        }
        deserializer.deserialize_map(Table)
    }
}

impl<'de> Deserialize<'de> for GivenValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Scalar;
        impl Visitor<'_> for Scalar {
            type Value = GivenValue;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a number, true or false, or a text")
            }

            fn visit_bool<E: Error>(self, value: bool) -> Result<GivenValue, E> {
                Ok(GivenValue::Boolean(value))
            }

            fn visit_i64<E: Error>(self, value: i64) -> Result<GivenValue, E> {
                Ok(GivenValue::Integer(value))
            }

            fn visit_f64<E: Error>(self, value: f64) -> Result<GivenValue, E> {
                Ok(GivenValue::Number(value))
            }

            fn visit_str<E: Error>(self, value: &str) -> Result<GivenValue, E> {
                Ok(GivenValue::Text(value.to_owned()))
            }
        }
        deserializer.deserialize_any(Scalar)
    }
}
