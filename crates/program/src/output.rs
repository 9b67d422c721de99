//! The standard output and the standard error. `println!` would panic where they cannot be written.

use crate::{Failure, failed};
use std::{
    fmt::Display,
    io::{self, ErrorKind, Write},
    sync::atomic::{AtomicBool, Ordering},
};

/// The exit status that shells give a program whose reader has gone. It is what other command line
/// tools end with in `... | head -1`, without a message.
pub const EXIT_STATUS_WITHOUT_READER: u8 = 141;

static READER_HAS_GONE: AtomicBool = AtomicBool::new(false);

pub fn reader_has_gone() -> bool {
    READER_HAS_GONE.load(Ordering::Relaxed)
}

/// Prints a line on the standard output.
pub fn print(line: impl Display) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    written(writeln!(output, "{line}").and_then(|()| output.flush()))
}

/// Makes an error in writing to the standard output a sentence.
pub fn written(result: io::Result<()>) -> Result<(), Failure> {
    if let Err(error) = &result
        && error.kind() == ErrorKind::BrokenPipe
    {
        READER_HAS_GONE.store(true, Ordering::Relaxed);
    }
    result.map_err(failed(
        "cannot write to the standard output; redirect it to a place with space",
    ))
}

/// Prints a line on the standard error. Where that fails there is nobody to tell.
pub fn note(line: impl Display) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Fails if the program was started without a standard output, as by `>&-` in a shell.
pub fn check() -> Result<(), Failure> {
    #[cfg(unix)]
    if at_start::IS_CLOSED.load(Ordering::Relaxed) {
        return Err(Failure(
            "the standard output is closed; redirect it to a file or to /dev/null".into(),
        ));
    }
    Ok(())
}

#[cfg(unix)]
mod at_start {
    use std::sync::atomic::{AtomicBool, Ordering};

    pub static IS_CLOSED: AtomicBool = AtomicBool::new(false);

    /// Runs before `main`, because Rust's runtime opens /dev/null for a closed standard output. It
    /// must not use the standard library's input and output.
    #[ctor::ctor(unsafe)]
    fn look() {
        let flags = rustix::io::fcntl_getfd(rustix::stdio::stdout());
        IS_CLOSED.store(flags.is_err(), Ordering::Relaxed);
    }
}
