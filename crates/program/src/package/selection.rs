//! Which platforms the .fmu is for, and where their libraries come from.

use super::{
    binary::{self, Binary},
    cross, library,
    platform::Platform,
};
use crate::{Failure, page};
use clap::Args;
use std::path::{Path, PathBuf};

#[derive(Args)]
pub struct Selection {
    /// Platforms of the .fmu: `all`, `arm`, or a list such as linux64,win64 [default: those of
    /// --binary, or this machine's]
    ///
    /// The platforms are linux64, win64, darwin64 (for both processors; in FMI 3.0 beside
    /// aarch64-darwin for Intel alone), aarch64-linux and aarch64-darwin. Their libraries are built
    /// with cargo in target/platforms, for Linux with glibc 2.17 and macOS 11 or later; what that
    /// needs is told where it is missing.
    ///
    /// `arm` makes an .fmu for ARM Linux only: its folder linux64 contains the library of
    /// aarch64-linux, since some importers look for it there.
    #[arg(long, value_name = "LIST")]
    platforms: Option<Wanted>,
    /// Use this built library for a platform and do not build one; can be repeated
    #[arg(long, value_name = "PLATFORM=FILE")]
    binary: Vec<Given>,
    /// Put the page for browsers into documentation/, too; with `--platforms all` it always is
    #[arg(long)]
    page: bool,
}

/// The platforms of the .fmu.
#[derive(Debug, Clone, PartialEq)]
enum Wanted {
    Each(Vec<Platform>),
    /// ARM Linux, also for importers that load `linux64` there.
    Arm,
}

impl std::str::FromStr for Wanted {
    type Err = String;

    fn from_str(list: &str) -> Result<Self, String> {
        match list {
            "all" => return Ok(Self::Each(Platform::ALL.to_vec())),
            "arm" => return Ok(Self::Arm),
            _ => {}
        }
        let mut platforms = Vec::new();
        for name in list.split(',') {
            let platform = name
                .trim()
                .parse()
                .map_err(|e| format!("{e}, or `all` or `arm` alone"))?;
            if !platforms.contains(&platform) {
                platforms.push(platform);
            }
        }
        Ok(Self::Each(platforms))
    }
}

/// A library that the user has built.
#[derive(Debug, Clone)]
struct Given {
    platform: Platform,
    file: PathBuf,
}

impl std::str::FromStr for Given {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let parts = text.split_once('=').filter(|(_, file)| !file.is_empty());
        let (platform, file) =
            parts.ok_or("name a platform and a file, such as win64=target/helicopter_rotor.dll")?;
        Ok(Self {
            platform: platform.parse()?,
            file: file.into(),
        })
    }
}

/// The libraries of an .fmu.
pub struct Contents {
    /// With the folder of each.
    pub binaries: Vec<(Platform, Binary)>,
    /// The library in `linux64` is for ARM.
    pub is_for_arm_only: bool,
    /// The libraries of both folders for macOS were built here, so that they may share the code for
    /// Apple silicon. Given libraries stay as they are.
    pub is_macos_code_shared: bool,
    /// The page for browsers.
    pub page: Option<String>,
}

impl Contents {
    /// This machine's library alone.
    pub fn of_host(library: &Path) -> Result<Self, Failure> {
        let host = Platform::host()?;
        Ok(Self {
            binaries: vec![(host, binary::read(host, library)?)],
            is_for_arm_only: false,
            is_macos_code_shared: false,
            page: None,
        })
    }
}

impl Selection {
    /// The given libraries, the others, which are built here, and the page. `library` is this
    /// machine's, if the user has named it; `target` is cargo's target folder.
    pub fn contents(self, library: Option<PathBuf>, target: &Path) -> Result<Contents, Failure> {
        let is_for_all = Some(Wanted::Each(Platform::ALL.to_vec())) == self.platforms;
        let has_page = self.page || is_for_all;
        let mut contents = self.libraries(library, target)?;
        if has_page {
            contents.page = Some(page::make(target)?);
        }
        Ok(contents)
    }

    fn libraries(self, library: Option<PathBuf>, target: &Path) -> Result<Contents, Failure> {
        let mut given = self.binary;
        if self.platforms.is_none() && given.is_empty() {
            return Contents::of_host(&library.map_or_else(|| library::build(target), Ok)?);
        }
        if let Some(file) = library {
            let platform = Platform::host()?;
            given.push(Given { platform, file });
        }
        for (i, one) in given.iter().enumerate() {
            if given[..i]
                .iter()
                .any(|other| other.platform == one.platform)
            {
                return Err(Failure(format!(
                    "two libraries are given for {}; name one",
                    one.platform
                )));
            }
        }
        let wanted = self
            .platforms
            .unwrap_or_else(|| Wanted::Each(given.iter().map(|one| one.platform).collect()));
        let made_for = match &wanted {
            Wanted::Each(platforms) => platforms.clone(),
            Wanted::Arm => vec![Platform::Aarch64Linux],
        };
        if let Some(other) = given.iter().find(|one| !made_for.contains(&one.platform)) {
            return Err(Failure(format!(
                "{} is given for {}, which is not among the platforms; add it to --platforms or leave the library out",
                other.file.display(),
                other.platform
            )));
        }

        // Those that are given come first: they fail at once.
        let mut binaries = Vec::new();
        for one in &given {
            binaries.push((one.platform, binary::read(one.platform, &one.file)?));
        }
        let to_build: Vec<_> = made_for
            .into_iter()
            .filter(|platform| !given.iter().any(|one| one.platform == *platform))
            .collect();
        for platform in &to_build {
            binaries.push((*platform, cross::build(*platform, target)?));
        }
        let for_macos = [Platform::Darwin64, Platform::Aarch64Darwin];
        let is_macos_code_shared = for_macos.iter().all(|one| to_build.contains(one));
        binaries.sort_by_key(|(platform, _)| Platform::ALL.iter().position(|p| p == platform));
        let is_for_arm_only = wanted == Wanted::Arm;
        if is_for_arm_only {
            let copies: Vec<_> = binaries.iter().map(|(_, binary)| binary.clone()).collect();
            binaries.extend(copies.into_iter().map(|binary| (Platform::Linux64, binary)));
        }
        Ok(Contents {
            binaries,
            is_for_arm_only,
            is_macos_code_shared,
            page: None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn platforms_are_named_one_by_one_or_all_at_once() {
        let wanted = |list: &str| list.parse::<Wanted>();
        let two = vec![Platform::Win64, Platform::Linux64];
        assert_eq!(wanted("win64, linux64,win64"), Ok(Wanted::Each(two)));
        assert_eq!(wanted("all"), Ok(Wanted::Each(Platform::ALL.to_vec())));
        assert_eq!(wanted("arm"), Ok(Wanted::Arm));
        for list in ["", "linux32", "linux64,all", "linux64,"] {
            assert!(
                wanted(list).unwrap_err().contains("is no platform"),
                "{list}"
            );
        }
    }

    #[test]
    fn a_given_library_names_its_platform() {
        let given: Given = "win64=a=b.dll".parse().unwrap();
        assert_eq!(
            (given.platform, given.file),
            (Platform::Win64, "a=b.dll".into())
        );
        for text in ["win64", "win64=", "b.dll", "=b.dll"] {
            assert!(text.parse::<Given>().is_err(), "{text}");
        }
    }
}
