//! Opens the page in the user's browser, by a private file that redirects to it: what a program is started with, other
//! users of the machine can read, and the page's address holds its token.

use asperity_io::diagnostic::Diagnostic;
use std::{
    env,
    ffi::OsStr,
    io::{self, Write as _},
    process::{Command, ExitStatus, Stdio},
    thread,
};
use tempfile::TempPath;
use thiserror::Error;

/// No browser was opened.
#[derive(Debug, Error)]
pub enum BrowserError {
    /// The file that redirects cannot be written.
    #[error("cannot open a browser: no file can be written in {}", env::temp_dir().display())]
    Redirect {
        /// Why.
        source: io::Error,
    },
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

/// Opens an address in the user's browser where that can be seen: the file that redirects there, which the browser needs
/// until the page is open. It does so on a thread, for it may last as long as the browser does; `failed` is called there.
#[must_use = "the file is removed when this is dropped"]
pub fn show(url: &str, failed: impl FnOnce(BrowserError) + Send + 'static) -> Option<TempPath> {
    if !has_display() {
        return None;
    }
    let file = match redirect(url) {
        Ok(file) => file,
        Err(source) => {
            failed(BrowserError::Redirect { source });
            return None;
        }
    };
    let path = file.to_owned();
    // Where no thread can be started, the printed address is left.
    let _ = thread::Builder::new()
        .name("browser".into())
        .spawn(move || {
            if let Err(error) = open(path.as_os_str()) {
                failed(error);
            }
        });
    Some(file)
}

/// A file that this user alone can read, from which a browser goes on to the address.
fn redirect(url: &str) -> io::Result<TempPath> {
    let mut file = tempfile::Builder::new()
        .prefix("asperity-studio-")
        .suffix(".html")
        .tempfile()?;
    writeln!(
        file,
        "<!doctype html><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">\
         <meta http-equiv=\"refresh\" content=\"0; url={url}\"><a href=\"{url}\">Asperity Studio</a>"
    )?;
    Ok(file.into_temp_path())
}

/// Returns true if a browser window can be shown: on Linux and other Unix systems with a display, elsewhere always.
fn has_display() -> bool {
    let set = |name: &str| env::var_os(name).is_some_and(|value| !value.is_empty());
    cfg!(any(windows, target_os = "macos")) || set("DISPLAY") || set("WAYLAND_DISPLAY")
}

/// Opens a file in the user's browser, and waits for the program that does so; some wait for the browser to close.
///
/// # Errors
/// [`BrowserError`] where that program is missing or fails.
fn open(file: &OsStr) -> Result<(), BrowserError> {
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
        .arg(file)
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_redirection_is_for_its_user_alone_and_goes_with_the_program() {
        let url = "http://127.0.0.1:4000/token/";
        let file = redirect(url).unwrap();
        let page = fs::read_to_string(&file).unwrap();
        assert!(page.contains(&format!("content=\"0; url={url}\"")));
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt as _;
            let mode = fs::metadata(&file).unwrap().permissions().mode();
            assert_eq!(mode & 0o077, 0, "{mode:o}");
        }
        let path = file.to_owned();
        drop(file);
        assert!(!path.exists());
    }
}
