//! Nothing half-written outlives an interrupt.

use asperity_io::{diagnostic::Diagnostic, output::clean_up_and_exit};
use thiserror::Error;

/// The system starts no thread that waits for an interrupt.
#[derive(Debug, Error)]
#[error("no thread can be started that waits for an interrupt")]
pub struct NoHandler(#[from] ctrlc::Error);

impl Diagnostic for NoHandler {
    fn remedy(&self) -> String {
        "allow more processes and threads: `ulimit -u`, or the limit of the container or service"
            .into()
    }
}

/// On an interrupt (Ctrl-C, termination): removes what is unfinished and exits with
/// status 130. For a command's `main`; calling it twice has no effect.
///
/// # Errors
/// [`NoHandler`] where the system allows no further thread.
pub fn clean_up_on_interrupt() -> Result<(), NoHandler> {
    match ctrlc::set_handler(|| clean_up_and_exit()) {
        Ok(()) | Err(ctrlc::Error::MultipleHandlers) => Ok(()),
        Err(error) => Err(error.into()),
    }
}
