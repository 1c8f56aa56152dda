//! Executed instructions of this program, started again under valgrind.

use std::{env, error::Error, ffi::OsStr, process::Command};

/// Executed instructions of the running program with other arguments.
///
/// # Errors
/// If valgrind is not on the PATH, or counts nothing.
pub fn count<A: AsRef<OsStr>>(arguments: &[A]) -> Result<u64, Box<dyn Error>> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(env::current_exe()?)
        .args(arguments)
        .output()
        .map_err(|error| format!("valgrind cannot be started ({error}); install it"))?;
    let log = String::from_utf8_lossy(&output.stderr);
    log.lines()
        .find_map(|line| line.split("Collected :").nth(1))
        .and_then(|count| count.trim().parse().ok())
        .ok_or_else(|| format!("valgrind counted nothing:\n{log}").into())
}
