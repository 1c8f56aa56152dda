//! Opens the page in the user's browser.

use asperity_io::diagnostic::Diagnostic;
use std::{
    env, io,
    process::{Command, ExitStatus, Stdio},
    thread,
};
use thiserror::Error;

/// No browser was opened.
#[derive(Debug, Error)]
pub enum BrowserError {
    /// The program that opens addresses cannot be started.
    #[error("cannot open a browser: {program} cannot be started")]
    Start {
        /// The program.
        program: &'static str,
        /// Why.
        source: io::Error,
    },
    /// It failed.
    #[error("cannot open a browser: {program} failed ({status})")]
    Failed {
        /// The program.
        program: &'static str,
        /// Its exit status.
        status: ExitStatus,
    },
}

impl Diagnostic for BrowserError {
    fn remedy(&self) -> String {
        "open the address above by hand".into()
    }
}

/// Opens an address in the user's browser where that can be seen. It does so on a thread, for it may last as long as the
/// browser does; `failed` is called there.
pub fn show(url: &str, failed: impl FnOnce(BrowserError) + Send + 'static) {
    if !has_display() {
        return;
    }
    let url = url.to_owned();
    // Where no thread can be started, the printed address is left.
    let _ = thread::Builder::new()
        .name("browser".into())
        .spawn(move || {
            if let Err(error) = open(&url) {
                failed(error);
            }
        });
}

/// Returns true if a browser window can be shown: on Linux and other Unix systems with a display, elsewhere always.
fn has_display() -> bool {
    let set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos")) || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

/// Opens an address in the user's browser, and waits for the program that does so; some wait for the browser to close.
///
/// # Errors
/// [`BrowserError`] where that program is missing or fails.
fn open(url: &str) -> Result<(), BrowserError> {
    let (program, before): (&str, &[&str]) = if cfg!(windows) {
        // The empty text is the title of a window.
        ("cmd", &["/c", "start", ""])
    } else if cfg!(target_os = "macos") {
        ("open", &[])
    } else {
        ("xdg-open", &[])
    };
    let status = Command::new(program)
        .args(before)
        .arg(url)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .status()
        .map_err(|source| BrowserError::Start { program, source })?;
    if status.success() {
        Ok(())
    } else {
        Err(BrowserError::Failed { program, status })
    }
}
