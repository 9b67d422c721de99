//! The platforms whose binaries an FMU can contain.

use crate::Failure;
use helicopter_rotor::fmi::legality::Version;
use object::{Architecture, BinaryFormat};
use std::{fmt, str::FromStr};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Platform {
    Linux64,
    Win64,
    Darwin64,
    Aarch64Linux,
    Aarch64Darwin,
}

use Platform::*;

impl Platform {
    pub const ALL: [Self; 5] = [Linux64, Win64, Darwin64, Aarch64Linux, Aarch64Darwin];

    /// Its folder below `binaries/` in an FMU: the name of FMI 2.0 or, where that has none, the
    /// tuple of FMI 3.0 (FMI 2.0.5, section 2.3).
    pub fn folder(self) -> &'static str {
        match self {
            Linux64 => "linux64",
            Win64 => "win64",
            Darwin64 => "darwin64",
            Aarch64Linux => "aarch64-linux",
            Aarch64Darwin => "aarch64-darwin",
        }
    }

    /// Its folder below `binaries/`: in FMI 3.0 the tuple of processor and system (FMI 3.0.2,
    /// section 2.5.1.4).
    pub fn folder_of(self, version: Version) -> &'static str {
        match (version, self) {
            (Version::Two, _) | (_, Aarch64Linux | Aarch64Darwin) => self.folder(),
            (_, Linux64) => "x86_64-linux",
            (_, Win64) => "x86_64-windows",
            (_, Darwin64) => "x86_64-darwin",
        }
    }

    /// The ending of its shared libraries.
    pub fn suffix(self) -> &'static str {
        match self {
            Linux64 | Aarch64Linux => ".so",
            Win64 => ".dll",
            Darwin64 | Aarch64Darwin => ".dylib",
        }
    }

    pub fn format(self) -> BinaryFormat {
        match self {
            Linux64 | Aarch64Linux => BinaryFormat::Elf,
            Win64 => BinaryFormat::Pe,
            Darwin64 | Aarch64Darwin => BinaryFormat::MachO,
        }
    }

    /// The processor. A library for `darwin64` may also serve the other one.
    pub fn processor(self) -> Architecture {
        match self {
            Linux64 | Win64 | Darwin64 => Architecture::X86_64,
            Aarch64Linux | Aarch64Darwin => Architecture::Aarch64,
        }
    }

    /// The platform on which this program runs.
    pub fn host() -> Result<Self, Failure> {
        let host = match (std::env::consts::OS, std::env::consts::ARCH) {
            ("linux", "x86_64") => Linux64,
            ("windows", "x86_64") => Win64,
            ("macos", "x86_64") => Darwin64,
            ("linux", "aarch64") => Aarch64Linux,
            ("macos", "aarch64") => Aarch64Darwin,
            (system, processor) => {
                return Err(Failure(format!(
                    "the .fmu has no folder for {system} on {processor}; choose platforms with `package --platforms`"
                )));
            }
        };
        Ok(host)
    }
}

impl fmt::Display for Platform {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.folder())
    }
}

impl FromStr for Platform {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|p| p.folder() == name);
        known.ok_or_else(|| {
            let names = Self::ALL.map(Self::folder).join(", ");
            format!("`{name}` is no platform; the platforms are {names}")
        })
    }
}
