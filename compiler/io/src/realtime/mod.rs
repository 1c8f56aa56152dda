//! Settings of this machine that decide how punctual a servo loop is, and how each is changed.
//!
//! They are read from `/proc` and `/sys`, so there are none but on Linux.

mod files;
mod read;
#[cfg(test)]
mod tests;

use crate::shown::size;
use files::Files;
use read::{
    CAP_IPC_LOCK, CAP_SYS_NICE, governor, hardware, idle, interrupts, isolation, preemption,
    privilege, smt, throttling,
};
use serde::Serialize;
use std::{fmt::Write as _, path::Path};

/// A setting: its current value, and the command that changes it.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Setting {
    /// Name of the setting.
    pub name: &'static str,
    /// Current value.
    pub now: String,
    /// True if the value suits a servo loop; `None` where the system does not tell.
    pub good: Option<bool>,
    /// The command that changes it.
    pub change: String,
}

/// The settings of this machine for a loop on processor `cpu`, or on any.
#[must_use]
pub fn settings(cpu: Option<usize>) -> Vec<Setting> {
    if cfg!(target_os = "linux") {
        settings_in(Path::new("/"), cpu)
    } else {
        Vec::new()
    }
}

/// The settings of a machine whose `proc` and `sys` are below `root`.
#[must_use]
pub fn settings_in(root: &Path, cpu: Option<usize>) -> Vec<Setting> {
    let files = Files(root.to_owned());
    vec![
        preemption(&files),
        throttling(&files),
        // A priority of 80 is what the loop asks for; it locks all its memory, also what it gets later.
        privilege(
            &files,
            "real-time priority",
            CAP_SYS_NICE,
            ("Max realtime priority", 80),
            |priority| priority.to_string(),
        ),
        privilege(
            &files,
            "locked memory",
            CAP_IPC_LOCK,
            ("Max locked memory", u64::MAX),
            size,
        ),
        isolation(&files, cpu),
        interrupts(&files, cpu),
        governor(&files, cpu.unwrap_or(0)),
        idle(&files, cpu.unwrap_or(0)),
        smt(&files),
        hardware(&files),
    ]
}

/// As a table: what is good first in each row, and the command where it is not.
#[must_use]
pub fn table(settings: &[Setting]) -> String {
    let width = |of: fn(&Setting) -> &str| {
        let lengths = settings.iter().map(|setting| of(setting).chars().count());
        lengths.max().unwrap_or(0)
    };
    let (names, values) = (width(|s| s.name), width(|s| &s.now));
    let mut text = String::new();
    for setting in settings {
        let mark = match setting.good {
            Some(true) => "good",
            Some(false) => "poor",
            None => "?",
        };
        let Setting { name, now, .. } = setting;
        // Writing to a string does not fail.
        let _ = match setting.good {
            Some(true) => writeln!(text, "{name:<names$}  {mark:<4}  {now}"),
            _ => writeln!(
                text,
                "{name:<names$}  {mark:<4}  {now:<values$}  {}",
                setting.change
            ),
        };
    }
    text
}
