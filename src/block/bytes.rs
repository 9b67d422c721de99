//! Reading numbers and texts out of bytes that may be anything.

use thiserror::Error;

/// Why bytes are not what they should be.
#[derive(Debug, Error, Clone, PartialEq, Eq)]
pub enum Damage {
    #[error("the bytes end too early")]
    Short,
    #[error("there are more bytes than there should be")]
    Long,
    #[error("a text among the bytes is no UTF-8")]
    Text,
    #[error("the bytes hold a value that {0} cannot have")]
    Value(String),
}

/// What is left of some bytes.
#[derive(Debug)]
pub struct Reader<'a> {
    rest: &'a [u8],
}

impl<'a> Reader<'a> {
    pub fn new(bytes: &'a [u8]) -> Self {
        Self { rest: bytes }
    }

    /// The next `count` bytes.
    pub fn slice(&mut self, count: usize) -> Result<&'a [u8], Damage> {
        let (slice, rest) = self.rest.split_at_checked(count).ok_or(Damage::Short)?;
        self.rest = rest;
        Ok(slice)
    }

    /// The next bytes, as many as the array has.
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        let (array, rest) = self.rest.split_first_chunk().ok_or(Damage::Short)?;
        self.rest = rest;
        Ok(*array)
    }

    pub fn byte(&mut self) -> Result<u8, Damage> {
        self.array::<1>().map(|[byte]| byte)
    }

    pub fn integer(&mut self) -> Result<i32, Damage> {
        self.array().map(i32::from_le_bytes)
    }

    pub fn reals<const N: usize>(&mut self) -> Result<[f64; N], Damage> {
        let mut reals = [0.0; N];
        for real in &mut reals {
            *real = self.array().map(f64::from_le_bytes)?;
        }
        Ok(reals)
    }

    /// A text with its length, 4 bytes, before it.
    pub fn text(&mut self) -> Result<String, Damage> {
        let count = self.array().map(u32::from_le_bytes)?;
        let bytes = self.slice(count as usize)?;
        String::from_utf8(bytes.to_vec()).map_err(|_| Damage::Text)
    }

    /// An error if something is left.
    pub fn end(&self) -> Result<(), Damage> {
        if self.rest.is_empty() {
            Ok(())
        } else {
            Err(Damage::Long)
        }
    }
}
