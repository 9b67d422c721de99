//! The state of an instance as bytes, the same on every platform:
//!
//! ```text
//! magic        8 bytes  "HelRotor"
//! version      4 bytes  of this format, little-endian
//! GUID        38 bytes  of modelDescription.xml of FMI 2.0, or the token of FMI 3.0
//! length       8 bytes  of the content, little-endian
//! content               an `FmuState` in the format of the crate postcard
//! checksum     4 bytes  CRC-32 of everything before it, little-endian
//! ```

use super::{
    fmu_state::FmuState,
    legality::{
        CONTINUOUS_TIME_MODE, EVENT_MODE, INITIALIZATION_MODE, INSTANTIATED, Interface,
        STEP_COMPLETE, STEP_MODE, TERMINATED, Version,
    },
};
use crate::block::{Contradiction, Stage, variables::GUID};
use crc::{CRC_32_ISO_HDLC, Crc};
use thiserror::Error;

const MAGIC: [u8; 8] = *b"HelRotor";
const VERSION: u32 = 4;
const HEAD: usize = MAGIC.len() + 4 + GUID.len() + 8;
const CHECKSUM: usize = 4;
/// The checksum of zip and PNG, with a table of 1 kB.
static CRC: Crc<u32> = Crc::<u32>::new(&CRC_32_ISO_HDLC);
/// More bytes than any state has, with texts as long as they may be.
const LONGEST: usize = 1 << 20;

/// Why bytes are not a state of this FMU.
#[derive(Debug, Error, PartialEq)]
pub enum DecodeError {
    #[error("the bytes are not a serialized state of this FMU")]
    Foreign,
    #[error(
        "the state was serialized in format {0}, this FMU reads {VERSION}; use the FMU that wrote it"
    )]
    Version(u32),
    #[error(
        "the state was serialized by an FMU with the {name} {given}, not {}; use that FMU",
        version.token()
    )]
    Token {
        given: String,
        version: Version,
        name: &'static str,
    },
    #[error("the state is cut short or too long: {given} bytes instead of {length}")]
    Length { given: usize, length: u64 },
    #[error("the state was damaged: its checksum is wrong")]
    Checksum,
    #[error("the state cannot be used: it ends too early")]
    Short,
    #[error("the state cannot be used: it has more bytes than it should have")]
    Long,
    #[error("the state cannot be used: it is not written as this FMU writes it")]
    Written,
    #[error("the state cannot be used: {0}")]
    Contradiction(#[from] Contradiction),
    #[error("the state cannot be used: its time is not finite")]
    Time,
    #[error("the state cannot be used: its state in the call sequence contradicts the rest")]
    Mode,
    #[error("the state cannot be written: {0}")]
    Unwritable(postcard::Error),
}

impl From<postcard::Error> for DecodeError {
    fn from(error: postcard::Error) -> Self {
        match error {
            postcard::Error::DeserializeUnexpectedEnd => Self::Short,
            _ => Self::Written,
        }
    }
}

impl FmuState {
    pub fn to_bytes(&self) -> Result<Vec<u8>, DecodeError> {
        let content = postcard::to_allocvec(self).map_err(DecodeError::Unwritable)?;
        let mut bytes = MAGIC.to_vec();
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(self.version.token().as_bytes());
        bytes.extend_from_slice(&(content.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&content);
        bytes.extend_from_slice(&CRC.checksum(&bytes).to_le_bytes());
        Ok(bytes)
    }

    /// A state of this version.
    pub fn from_bytes(bytes: &[u8], version: Version) -> Result<Self, DecodeError> {
        if bytes.len() > LONGEST {
            return Err(DecodeError::Long);
        }
        let content = content(bytes, version)?;
        let (mut state, rest) = postcard::take_from_bytes::<Self>(content)?;
        state.version = version;
        if !rest.is_empty() {
            return Err(DecodeError::Long);
        }
        state.check()?;
        // postcard also reads integers that take more bytes than they need.
        if state.to_bytes()? != bytes {
            return Err(DecodeError::Written);
        }
        Ok(state)
    }

    /// Refuses a state that no instance can be in.
    fn check(&self) -> Result<(), DecodeError> {
        let experiment = &self.experiment;
        let times = [experiment.start_time, experiment.time];
        if times.iter().any(|t| !t.is_finite()) || experiment.stop_time.is_some_and(f64::is_nan) {
            return Err(DecodeError::Time);
        }
        self.block.check()?;
        // The stages of the block in the states of the call sequence.
        let stage = self.block.stage();
        let is_consistent = match (self.interface, self.state) {
            (_, INSTANTIATED | INITIALIZATION_MODE) => stage == Stage::Configuring,
            (Interface::CoSimulation, TERMINATED) | (Interface::ModelExchange, EVENT_MODE) => {
                stage == Stage::Running
            }
            (Interface::CoSimulation, STEP_COMPLETE) => {
                self.version == Version::Two && stage == Stage::Running
            }
            (Interface::CoSimulation, STEP_MODE | EVENT_MODE) => {
                self.version == Version::Three && stage == Stage::Running
            }
            (Interface::ModelExchange, CONTINUOUS_TIME_MODE) => stage == Stage::Integrating,
            (Interface::ModelExchange, TERMINATED) => stage != Stage::Configuring,
            _ => false,
        };
        if !is_consistent {
            return Err(DecodeError::Mode);
        }
        Ok(())
    }
}

/// The content between the head and the checksum, which are checked.
fn content(bytes: &[u8], fmi: Version) -> Result<&[u8], DecodeError> {
    let foreign = DecodeError::Foreign;
    let Some((head, _)) = bytes.split_first_chunk::<HEAD>() else {
        return Err(foreign);
    };
    let (magic, head) = head.split_at(MAGIC.len());
    let (version, head) = head.split_at(4);
    let (guid, length) = head.split_at(GUID.len());
    if magic != MAGIC {
        return Err(foreign);
    }
    if version != VERSION.to_le_bytes() {
        let version = version.try_into().map_err(|_| foreign)?;
        return Err(DecodeError::Version(u32::from_le_bytes(version)));
    }
    if guid != fmi.token().as_bytes() {
        let given = String::from_utf8_lossy(guid);
        return Err(DecodeError::Token {
            given: given.chars().filter(char::is_ascii_graphic).collect(),
            version: fmi,
            name: fmi.token_name(),
        });
    }
    let length = u64::from_le_bytes(length.try_into().map_err(|_| foreign)?);
    let length = length.saturating_add((HEAD + CHECKSUM) as u64);
    let given = bytes.len();
    if given as u64 != length {
        return Err(DecodeError::Length { given, length });
    }
    let (body, checksum) = bytes.split_at(given - CHECKSUM);
    if CRC.checksum(body).to_le_bytes() != *checksum {
        return Err(DecodeError::Checksum);
    }
    Ok(&body[HEAD..])
}
