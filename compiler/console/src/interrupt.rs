//! Nothing half-written outlives an interrupt.

use asperity_io::{diagnostic::Diagnostic, output::clean_up_and_exit, system};
use std::io;
use thiserror::Error;

/// The system lets no thread wait for an interrupt.
#[derive(Debug, Error)]
#[error("cannot install a handler for interrupts")]
pub struct NoHandler(#[source] io::Error);

impl Diagnostic for NoHandler {
    fn remedy(&self) -> String {
        let threads = "allow more processes and threads: `ulimit -u`, or the limit of the service";
        system::remedy(&self.0).unwrap_or(threads).into()
    }
}

/// On an interrupt (Ctrl-C, a request to terminate, a timer or a limit that ends a process): removes
/// what is unfinished and exits with status 130. For a command's `main`, once.
///
/// # Errors
/// As [`on_interrupt`].
pub fn clean_up_on_interrupt() -> Result<(), NoHandler> {
    on_interrupt(|| clean_up_and_exit())
}

/// Does this at every interrupt, on a thread of its own. For a command's `main`, once.
///
/// # Errors
/// [`NoHandler`] where the system allows no further thread or file.
#[cfg(unix)]
pub fn on_interrupt(mut work: impl FnMut() + Send + 'static) -> Result<(), NoHandler> {
    use signal_hook::{consts::signal, flag, iterator::Signals};
    use std::sync::{Arc, atomic::AtomicBool};

    /// Signals that end a process by default, apart from those of a bug and of `kill -9`.
    const ENDING: [i32; 10] = [
        signal::SIGHUP,
        signal::SIGINT,
        signal::SIGQUIT,
        signal::SIGALRM,
        signal::SIGTERM,
        signal::SIGUSR1,
        signal::SIGUSR2,
        signal::SIGXCPU,
        signal::SIGVTALRM,
        signal::SIGPROF,
    ];

    // A file that grows beyond its limit is then an error of the write, as a full disk is.
    flag::register(signal::SIGXFSZ, Arc::<AtomicBool>::default()).map_err(NoHandler)?;
    let mut signals = Signals::new(ENDING).map_err(NoHandler)?;
    std::thread::Builder::new()
        .name("interrupt".into())
        .spawn(move || signals.forever().for_each(|_| work()))
        .map_err(NoHandler)?;
    Ok(())
}

/// Does this at every interrupt, on a thread of its own. For a command's `main`, once.
///
/// # Errors
/// [`NoHandler`] where the system allows no further thread.
#[cfg(not(unix))]
pub fn on_interrupt(work: impl FnMut() + Send + 'static) -> Result<(), NoHandler> {
    ctrlc::set_handler(work).map_err(|error| NoHandler(io::Error::other(error)))
}
