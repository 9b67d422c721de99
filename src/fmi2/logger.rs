//! Messages to the importer, by the callback that it gave.

use super::types::{fmi2CallbackLogger, fmi2ComponentEnvironment, fmi2Status};
use crate::block::variables::LOG_CATEGORIES;
use std::ffi::CString;

/// The declared categories, by their places in modelDescription.xml.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    Error = 0,
    Warning = 1,
    Events = 2,
}

/// The importer's logger as copied at instantiation.
///
/// Errors and warnings are always logged, unless fmi2SetDebugLogging chose other categories;
/// events only while logging is on.
#[derive(Clone)]
pub struct Logger {
    pub callback: Option<fmi2CallbackLogger>,
    pub environment: fmi2ComponentEnvironment,
    pub instance_name: CString,
    pub logging_on: bool,
    /// The categories that fmi2SetDebugLogging chose; none: all.
    pub chosen: Option<[bool; LOG_CATEGORIES.len()]>,
}

impl Logger {
    pub fn log(&self, status: fmi2Status, category: Category, message: &str) {
        let wanted = self.chosen.is_none_or(|chosen| chosen[category as usize]);
        if !wanted || (category == Category::Events && !self.logging_on) {
            return;
        }
        let Some(callback) = self.callback else {
            return;
        };
        let category = printable(LOG_CATEGORIES[category as usize]);
        // The message is the format of a printf.
        let message = printable(&message.trim_end().replace('%', "%%"));
        // SAFETY: the importer's function, with the arguments that the standard demands. The
        // strings live until it returns.
        unsafe {
            callback(
                self.environment,
                self.instance_name.as_ptr(),
                status,
                category.as_ptr(),
                message.as_ptr(),
            );
        }
    }
}

/// A C string; a NUL inside, which C cannot hold, becomes a blank.
pub fn printable(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}
