//! A description to start from, by the headers of the files in a folder and by their first rows.
//!
//! What a header says is taken. What it does not say is not made up: a column of an unknown quantity, or a
//! rate that is nowhere, becomes a comment that says what to write.

mod entry;
mod other_files;
#[cfg(test)]
mod tests;

use super::{quantity::Quantity, schema::Axis};
use crate::reader;
use asperity_io::diagnostic::Fault;
use entry::{Entry, Proposed, quoted};
use std::{fmt::Write as _, path::Path};

/// Most files that are looked at.
const MAX_FILES: usize = 32;
/// Most bytes of a name.
const MAX_NAME: usize = 64;

/// A draft of a description.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Proposal {
    /// As `recording.toml` holds it; comments say what is left out, and why.
    pub text: String,
    /// Number of files that it describes. With none, the text is comments alone.
    pub files: usize,
}

/// A `recording.toml` that fits the headers of the folder's files; `None` where there is no file that
/// holds a recording.
///
/// # Errors
/// [`Fault`] of the first file of a known kind where none can be read.
pub fn propose(folder: &Path) -> Result<Option<Proposal>, Fault> {
    let Ok(entries) = std::fs::read_dir(folder) else {
        return Ok(None);
    };
    // A control character in a name would break a line of the draft.
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| !name.contains(char::is_control))
        .collect();
    names.sort();
    let (known, others): (Vec<String>, Vec<String>) = names
        .into_iter()
        .partition(|name| reader::is_known(Path::new(name)));
    let mut left_out = Vec::new();
    let (mut files, mut fault) = (Vec::new(), None);
    for name in known.into_iter().take(MAX_FILES) {
        let path = folder.join(&name);
        match reader::header(&path) {
            Ok(header) => match Entry::of(&path, &name, header) {
                Ok(entry) => files.push(entry),
                Err(why) => left_out.push((name, why)),
            },
            Err(error) => {
                left_out.push((name, error.what.clone()));
                fault.get_or_insert(error);
            }
        }
    }
    let unread = others.into_iter().take(MAX_FILES).filter_map(|name| {
        let why = other_files::remedy(&folder.join(&name))?;
        Some((name, why))
    });
    left_out.extend(unread);
    // Positions of a satellite beside the sensors; alone, the unit of the clock may be wrong.
    let slow: Vec<Option<String>> = files
        .iter()
        .map(|entry: &Entry| entry.slow(folder))
        .collect();
    if slow.contains(&None) {
        let mut slow = slow.into_iter();
        files.retain(|entry| match slow.next().flatten() {
            Some(why) => {
                left_out.push((entry.file.clone(), why));
                false
            }
            None => true,
        });
    }
    one_of_each(&mut files);
    if let (true, [_], Some(fault)) = (files.is_empty(), &left_out[..], fault) {
        return Err(fault);
    }
    if files.is_empty() && left_out.is_empty() {
        return Ok(None);
    }
    let described = files
        .iter()
        .filter(|entry| !entry.channels.is_empty())
        .count();
    let mut text = String::new();
    if described > 0 {
        text = format!(
            "name = {}\n\n[tool]\n# mass_kg = 0.05  # measure it: it tells wrong units of the force\n",
            quoted(&name_of(folder))
        );
    }
    for entry in &files {
        entry.write(&mut text);
    }
    for (name, why) in left_out {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "\n# {} is left out: {why}", quoted(&name));
    }
    Ok(Some(Proposal {
        text,
        files: described,
    }))
}

/// The folder's name, as long as a description may have it.
fn name_of(folder: &Path) -> String {
    let name = folder.file_name().map(|name| name.to_string_lossy());
    let mut name = name.unwrap_or_default().replace(char::is_control, " ");
    while name.len() > MAX_NAME {
        name.pop();
    }
    if name.trim().is_empty() {
        return "texture".into();
    }
    name
}

/// Leaves each quantity along each axis in one file: that whose acceleration shows gravity, or the first.
fn one_of_each(files: &mut [Entry]) {
    let mut order: Vec<usize> = (0..files.len()).collect();
    order.sort_by_key(|&index| !files[index].shows_gravity);
    let mut taken: Vec<(Quantity, Axis, String)> = Vec::new();
    for index in order {
        let entry = &mut files[index];
        let of = |channel: &Proposed| {
            let known = |(quantity, axis, _): &&(Quantity, Axis, String)| {
                *quantity == channel.quantity && *axis == channel.axis
            };
            taken.iter().find(known).map(|(.., file)| file.clone())
        };
        let (kept, twice): (Vec<Proposed>, Vec<Proposed>) = std::mem::take(&mut entry.channels)
            .into_iter()
            .partition(|channel| of(channel).is_none());
        for channel in &twice {
            let (quantity, other) = (channel.quantity, of(channel).unwrap_or_default());
            let why = format!("{} has this {quantity} already", quoted(&other));
            entry.left_out.push((channel.name.clone(), why));
        }
        let own = kept
            .iter()
            .map(|channel| (channel.quantity, channel.axis, entry.file.clone()));
        taken.extend(own);
        entry.channels = kept;
    }
}
