//! Messages to the importer by its callback, and which of them it wants.

use super::{
    arguments::{elements, text},
    instance::{Instance, Message, Outcome},
    types::{Environment, Status, Text},
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
    pub fn status(self) -> Status {
        match self {
            Self::Error => Status::Error,
            Self::Warning => Status::Warning,
            Self::Events => Status::Ok,
        }
    }
}

/// Whether the importer wants the messages of each category.
pub type Wanted = [bool; LOG_CATEGORIES.len()];

/// Maximum number of characters of a message.
const MAX_MESSAGE: usize = 500;

/// The importer's function for messages: the `logger` of FMI 2.0, whose message is the format of a
/// printf, or the `logMessage` of FMI 3.0.
#[derive(Clone, Copy)]
pub enum Callback {
    Two(unsafe extern "C" fn(Environment, Text, Status, Text, Text, ...)),
    Three(unsafe extern "C" fn(Environment, Status, Text, Text)),
}

/// The importer's logger as copied at instantiation.
#[derive(Clone)]
pub struct Logger {
    pub callback: Option<Callback>,
    pub environment: Environment,
    pub instance_name: CString,
    pub wanted: Wanted,
}

impl Logger {
    pub fn log(&self, category: Category, message: &str) {
        if self.wanted[category as usize] {
            self.send(category, message);
        }
    }

    /// Sends a message, whether its category is wanted or not.
    pub fn send(&self, category: Category, message: &str) {
        let status = category.status();
        let category = printable(LOG_CATEGORIES[category as usize]);
        let message = limited(message.trim_end());
        match self.callback {
            // SAFETY: the importer's function, with the arguments that the standard demands. The
            // strings live until it returns.
            Some(Callback::Two(logger)) => unsafe {
                let (environment, name) = (self.environment, self.instance_name.as_ptr());
                let message = printable(&message.replace('%', "%%"));
                logger(
                    environment,
                    name,
                    status,
                    category.as_ptr(),
                    message.as_ptr(),
                );
            },
            // SAFETY: as above.
            Some(Callback::Three(log_message)) => unsafe {
                // FMI 3.0 reads #5# as the variable with value reference 5, so # is doubled.
                let message = printable(&message.replace('#', "##"));
                log_message(
                    self.environment,
                    status,
                    category.as_ptr(),
                    message.as_ptr(),
                );
            },
            None => {}
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

/// Changes which messages the importer wants by the categories that it names. `change` gets whether
/// each of them is named. A warning if there are unknown names among them.
///
/// # Safety
/// `categories` has `count` C strings.
pub unsafe fn choose(
    instance: &mut Instance,
    categories: *const Text,
    count: usize,
    change: impl FnOnce(&mut Wanted, Wanted),
) -> Outcome {
    let mut named = [false; LOG_CATEGORIES.len()];
    let mut unknown = Vec::new();
    // SAFETY: passed on from the caller.
    for category in unsafe { elements(categories, count, "categories")? } {
        // SAFETY: passed on from the caller.
        let name = unsafe { text(*category, "a category")? };
        match LOG_CATEGORIES.iter().position(|known| *known == name) {
            Some(index) => named[index] = true,
            None => unknown.push(name),
        }
    }
    change(&mut instance.logger.wanted, named);
    if unknown.is_empty() {
        return Ok(());
    }
    Err(Message::Warning(format!(
        "unknown log categories {}; this FMU has {}",
        unknown.join(", "),
        LOG_CATEGORIES.join(", ")
    )))
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
