//! The texts that the build makes from modelDescription/, for the program that packages the FMU.

/// modelDescription.xml, whose GUID is that of this library.
pub const XML: &str = include_str!(concat!(env!("OUT_DIR"), "/modelDescription.xml"));

/// The tables of variables and choices for the documentation page, HTML.
pub const VARIABLES_HTML: &str = include_str!(concat!(env!("OUT_DIR"), "/variables.html"));
