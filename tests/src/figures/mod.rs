//! Measured figures that pages quote, from one source each.
//!
//! A command that measures keeps a [`Set`] in `docs/figures/NAME.toml`. Pages quote it between
//! [markers](page), which `cargo run -p asperity-tests --bin figures` fills in. A test that measures at full size
//! [holds](hold) the file to what it found, so that neither the file nor a page can age unseen.

pub mod cell;
pub mod evaluation;
pub mod page;
mod set;
pub mod tables;
pub mod unmarked;

pub use set::{Measured, Set, SetError, files};

use crate::size::{self, Size};
use std::{
    path::{Path, PathBuf},
    process::Command,
};

/// Set to `write`, tests that measure write their figures instead of comparing them.
pub const VARIABLE: &str = "ASPERITY_FIGURES";

/// The top of the project.
#[must_use]
pub fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// The folder of the sets.
#[must_use]
pub fn folder() -> PathBuf {
    root().join("docs/figures")
}

/// Holds the set `name` to what was measured, or writes it where [`VARIABLE`] asks for that.
///
/// `command` is what follows `cargo test --release`.
///
/// # Panics
///
/// Where the set differs or cannot be read or written.
pub fn hold(
    name: &str,
    command: &str,
    figures: impl IntoIterator<Item = (impl Into<String>, String)>,
) {
    let command = format!("cargo test --release {command}");
    hold_to(name, &Set::new(&command, figures));
}

/// The same for figures that a run at small size does not measure: it holds nothing.
///
/// # Panics
///
/// As [`hold`].
pub fn hold_at_full(
    name: &str,
    command: &str,
    figures: impl IntoIterator<Item = (impl Into<String>, String)>,
) {
    if Size::asked() == Size::Full {
        let command = format!("{}=full cargo test --release {command}", size::VARIABLE);
        hold_to(name, &Set::new(&command, figures));
    }
}

fn hold_to(name: &str, measured: &Set) {
    let command = &measured.command;
    let file = folder().join(name).with_extension("toml");
    let held = if asked_to_write() {
        measured.write(&file)
    } else {
        Set::read(&file).map(|stated| {
            assert!(
                stated.figures == measured.figures,
                "{}: {:?} is stated, {:?} was measured; run `{VARIABLE}=write {command}`, then `cargo run -p \
                 asperity-tests --bin figures`",
                file.display(),
                stated.figures,
                measured.figures,
            );
        })
    };
    held.unwrap_or_else(|error| panic!("{error}"));
}

/// Writes the set `name` where [`VARIABLE`] asks for that, and else compares it with what was measured. A set that
/// differs is reported as a line `stale: …`, which `.ci/run` and `.ci/full` repeat at their end; one of other conditions, such as
/// another compiler, is not compared.
///
/// # Errors
/// [`SetError`] for a file that cannot be read or written.
pub fn keep(name: &str, measured: &Set) -> Result<(), SetError> {
    let file = folder().join(name).with_extension("toml");
    if asked_to_write() {
        return measured.write(&file);
    }
    let stated = Set::read(&file)?;
    if stated.conditions != measured.conditions {
        let [then, now] = [&stated, measured].map(|set| set.conditions.as_deref().unwrap_or("any"));
        println!("docs/figures/{name}.toml is of {then}; this was {now}");
    } else if stated.figures != measured.figures {
        println!(
            "stale: docs/figures/{name}.toml: `{VARIABLE}=write {}`",
            stated.command
        );
    }
    Ok(())
}

fn asked_to_write() -> bool {
    std::env::var_os(VARIABLE).is_some_and(|value| value == "write")
}

/// The compiler's name and version, as a condition of figures.
#[must_use]
pub fn compiler() -> String {
    let output = Command::new("rustc").arg("-V").output();
    let text = output.map(|output| String::from_utf8_lossy(&output.stdout).into_owned());
    let words = text.unwrap_or_default();
    words.split(' ').take(2).collect::<Vec<_>>().join(" ")
}

/// A count as pages print it: 1,804.
#[must_use]
pub fn count(number: u64) -> String {
    let digits = number.to_string();
    let groups = digits.as_bytes().rchunks(3).rev();
    let groups: Vec<&str> = groups.filter_map(|g| str::from_utf8(g).ok()).collect();
    groups.join(",")
}

/// A limit, rounded up, so that "within" holds.
#[must_use]
pub fn within(value: f64, decimals: usize) -> String {
    let scale = 10_f64.powi(decimals as i32);
    format!("{:.decimals$}", (value * scale).ceil() / scale)
}

/// A share in whole per cent.
#[must_use]
pub fn percent(part: usize, whole: usize) -> String {
    format!("{:.0}", 100.0 * part as f64 / whole as f64)
}

/// A share in per cent with a decimal, which a share of all does not need.
#[must_use]
pub fn tenths_of_percent(part: usize, whole: usize) -> String {
    let share = format!("{:.1}", 100.0 * part as f64 / whole as f64);
    share
        .strip_suffix(".0")
        .map_or(share.clone(), str::to_owned)
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_limit_is_never_below_what_it_limits() {
        assert_eq!(super::within(0.0534, 3), "0.054");
        assert_eq!(super::within(0.25, 2), "0.25");
    }

    #[test]
    fn counts_are_grouped_by_thousands() {
        assert_eq!(super::count(7), "7");
        assert_eq!(super::count(355), "355");
        assert_eq!(super::count(1804), "1,804");
        assert_eq!(super::count(1_234_567), "1,234,567");
    }
}
