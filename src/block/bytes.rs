//! Reading numbers and texts out of bytes that may be anything.

use thiserror::Error;

/// Why bytes are not what they should be.
#[derive(Debug, Error, Clone, PartialEq, Eq)]
pub enum DecodeError {
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
    pub fn slice(&mut self, count: usize) -> Result<&'a [u8], DecodeError> {
        let (slice, rest) = self
            .rest
            .split_at_checked(count)
            .ok_or(DecodeError::Short)?;
        self.rest = rest;
        Ok(slice)
    }

    /// The next bytes, as many as the array has.
    pub fn array<const N: usize>(&mut self) -> Result<[u8; N], DecodeError> {
        let (array, rest) = self.rest.split_first_chunk().ok_or(DecodeError::Short)?;
        self.rest = rest;
        Ok(*array)
    }

    pub fn byte(&mut self) -> Result<u8, DecodeError> {
        self.array::<1>().map(|[byte]| byte)
    }

    pub fn integer(&mut self) -> Result<i32, DecodeError> {
        self.array().map(i32::from_le_bytes)
    }

    pub fn reals<const N: usize>(&mut self) -> Result<[f64; N], DecodeError> {
        let mut reals = [0.0; N];
        for real in &mut reals {
            *real = self.array().map(f64::from_le_bytes)?;
        }
        Ok(reals)
    }

    /// A text with its length, 4 bytes, before it.
    pub fn text(&mut self) -> Result<String, DecodeError> {
        let count = self.array().map(u32::from_le_bytes)?;
        let bytes = self.slice(count as usize)?;
        String::from_utf8(bytes.to_vec()).map_err(|_| DecodeError::Text)
    }

    /// An error if something is left.
    pub fn end(&self) -> Result<(), DecodeError> {
        if self.rest.is_empty() {
            Ok(())
        } else {
            Err(DecodeError::Long)
        }
    }
}
