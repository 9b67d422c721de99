//! Messages to the importer by its callback, and which of them it wants.

#![allow(non_snake_case)]

use super::{
    arguments::{elements, text},
    instance::{Instance, Message, call},
    legality::Function,
    types::*,
};
use crate::block::variables::LOG_CATEGORIES;
use std::{borrow::Cow, ffi::CString};

/// The log categories, in the order in which modelDescription.xml declares them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Category {
    Error = 0,
    Warning = 1,
    Events = 2,
}

impl Category {
    /// The status that goes with a message.
    pub fn status(self) -> fmi2Status {
        match self {
            Self::Error => fmi2Status::fmi2Error,
            Self::Warning => fmi2Status::fmi2Warning,
            Self::Events => fmi2Status::fmi2OK,
        }
    }
}

/// Maximum number of characters of a message.
const MAX_MESSAGE: usize = 500;

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
    /// The categories that fmi2SetDebugLogging chose; `None` for all.
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
        let message = printable(&limited(message.trim_end()).replace('%', "%%"));
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

/// A message of at most `MAX_MESSAGE` characters. A longer one names a very long path: its
/// beginning says where that comes from, and its end what to do, so that the middle is left out.
fn limited(message: &str) -> Cow<'_, str> {
    if message.chars().nth(MAX_MESSAGE).is_none() {
        return message.into();
    }
    let half = MAX_MESSAGE / 2;
    let begin = message.chars().take(half);
    let mut end: Vec<char> = message.chars().rev().take(MAX_MESSAGE - half - 1).collect();
    end.reverse();
    begin.chain(['…']).chain(end).collect::<String>().into()
}

/// A C string. A NUL inside the text, which C would take for its end, becomes a blank.
pub fn printable(text: &str) -> CString {
    CString::new(text.replace('\0', " ")).unwrap_or_default()
}

/// # Safety
/// As in the standard: `c` from fmi2Instantiate, `categories` with `nCategories` C strings.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi2SetDebugLogging(
    c: fmi2Component,
    loggingOn: fmi2Boolean,
    nCategories: usize,
    categories: *const fmi2String,
) -> fmi2Status {
    let body = |instance: &mut Instance| {
        let mut chosen = [false; LOG_CATEGORIES.len()];
        let mut unknown = Vec::new();
        // SAFETY: passed on from the caller.
        for category in unsafe { elements(categories, nCategories, "categories")? } {
            // SAFETY: passed on from the caller.
            let name = unsafe { text(*category, "a category")? };
            match LOG_CATEGORIES.iter().position(|known| *known == name) {
                Some(index) => chosen[index] = true,
                None => unknown.push(name),
            }
        }
        instance.logger.logging_on = loggingOn != FMI2_FALSE;
        instance.logger.chosen = (nCategories > 0).then_some(chosen);
        if unknown.is_empty() {
            return Ok(());
        }
        Err(Message::Warning(format!(
            "unknown log categories {}; this FMU has {}",
            unknown.join(", "),
            LOG_CATEGORIES.join(", ")
        )))
    };
    // SAFETY: passed on from the caller.
    unsafe { call(c, Function::fmi2SetDebugLogging, body) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_message_keeps_its_beginning_and_its_end() {
        for length in [0, 1, 499, 500] {
            let message = "ü".repeat(length);
            assert_eq!(limited(&message), message);
        }
        for length in [492, 1_000_000] {
            let message = format!("begin{}end.", "ü".repeat(length));
            let expected = format!("begin{}…{}end.", "ü".repeat(245), "ü".repeat(245));
            assert_eq!(expected.chars().count(), MAX_MESSAGE);
            assert_eq!(limited(&message), expected);
        }
    }
}
