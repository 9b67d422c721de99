//! Ctrl-C and SIGTERM: the program ends what it has started, removes what is not complete, and
//! exits. A second one ends it at once.

use crate::{Failure, failed};
use signal_hook::{
    consts::{SIGINT, SIGTERM},
    flag,
};
use std::sync::{
    Arc, LazyLock,
    atomic::{AtomicBool, Ordering},
};

/// The exit status that shells give a program that Ctrl-C has ended.
pub const EXIT_STATUS: u8 = 130;

static REQUESTED: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// From now on the first of these signals only makes `check` fail.
pub fn watch() -> Result<(), Failure> {
    for signal in [SIGINT, SIGTERM] {
        // The first acts on a signal that comes when the second has already seen one.
        flag::register_conditional_shutdown(signal, EXIT_STATUS.into(), Arc::clone(&REQUESTED))
            .and_then(|_| flag::register(signal, Arc::clone(&REQUESTED)))
            .map_err(failed("cannot watch for Ctrl-C"))?;
    }
    Ok(())
}

pub fn is_requested() -> bool {
    REQUESTED.load(Ordering::Relaxed)
}

/// Fails after one of these signals. All that waits calls it several times a second.
pub fn check() -> Result<(), Failure> {
    if is_requested() {
        return Err(Failure("interrupted".into()));
    }
    Ok(())
}
