//! The texts that the build makes from modelDescription/, for the program that packages the FMU.

/// modelDescription.xml of FMI 2.0, whose GUID is that of this library.
pub const XML: &str = include_str!(concat!(env!("OUT_DIR"), "/modelDescription.xml"));

/// modelDescription.xml of FMI 3.0, whose instantiationToken is that of this library.
pub const XML_OF_FMI3: &str = include_str!(concat!(env!("OUT_DIR"), "/modelDescription-fmi3.xml"));

/// terminalsAndIcons.xml in FMUs of FMI 2.0.
pub const TERMINALS: &str = include_str!(concat!(env!("OUT_DIR"), "/terminals.xml"));

/// terminalsAndIcons.xml in FMUs of FMI 3.0.
pub const TERMINALS_OF_FMI3: &str = include_str!(concat!(env!("OUT_DIR"), "/terminals-fmi3.xml"));

/// The tables of variables and choices for the documentation page, HTML.
pub const VARIABLES_HTML: &str = include_str!(concat!(env!("OUT_DIR"), "/variables.html"));
