//! A description to start from, by the headers of the files in a folder.

use crate::reader::{self, Header};
use std::{fmt::Write as _, path::Path};

/// Most files that are looked at.
const MAX_FILES: usize = 32;

/// A `recording.toml` that fits the headers of the folder's files; `None` where there is no file of
/// a known kind. Quantities and units are guesses from the columns' names.
#[must_use]
pub fn propose(folder: &Path) -> Option<String> {
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .ok()?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort();
    let name = folder
        .file_name()
        .map_or("texture".into(), |name| name.to_string_lossy().into_owned());
    let mut text = format!("name = {name:?}\n\n[tool]\nmass_kg = 0.05  # measure it\n");
    let mut any = false;
    for file in names.into_iter().take(MAX_FILES) {
        let Ok(header) = reader::header(&folder.join(&file)) else {
            continue;
        };
        any = true;
        entry(&mut text, &file, &header);
    }
    any.then_some(text)
}

fn entry(text: &mut String, file: &str, header: &Header) {
    // Writing to a string cannot fail.
    let _ = writeln!(text, "\n[[file]]\npath = {file:?}");
    let clock = header
        .columns
        .iter()
        .find_map(|name| Some((name, clock_unit(name)?)));
    match (&clock, header.rate_hz) {
        (Some((name, unit)), _) => {
            let _ = writeln!(text, "clock = {name:?}\nclock_unit = {unit:?}");
        }
        (None, Some(rate_hz)) => {
            let _ = writeln!(text, "rate_hz = {rate_hz}");
        }
        (None, None) => {
            let _ = writeln!(text, "rate_hz = 1000  # not in the file: give it");
        }
    }
    for (index, name) in header.columns.iter().enumerate() {
        if clock.as_ref().is_some_and(|(clock, _)| *clock == name) {
            continue;
        }
        let (quantity, unit) = guess(name);
        let column = if header.named {
            format!("{name:?}")
        } else {
            index.to_string()
        };
        let _ = writeln!(
            text,
            "[[file.channel]]\ncolumn = {column}\nquantity = \"{quantity}\"\naxis = \"{}\"\nunit = \"{unit}\"",
            axis(name)
        );
    }
}

fn clock_unit(name: &str) -> Option<&'static str> {
    let name = name.to_lowercase();
    let unit = match name.as_str() {
        "t_ms" | "time_ms" | "ms" | "timestamp_ms" => "ms",
        "t_us" | "time_us" | "us" | "timestamp_us" => "us",
        "t" | "t_s" | "time" | "time_s" | "s" | "timestamp" | "seconds" => "s",
        _ => return None,
    };
    Some(unit)
}

fn guess(name: &str) -> (&'static str, &'static str) {
    let name = name.to_lowercase();
    let has = |part: &str| name.contains(part);
    if has("torque") || name.starts_with("tx") || name.starts_with("ty") || name.starts_with("tz") {
        ("torque", "N*m")
    } else if has("force") || name.starts_with('f') {
        ("force", if has("mn") { "mN" } else { "N" })
    } else if has("speed") || has("vel") || name.starts_with('v') {
        ("speed", if has("mm") { "mm/s" } else { "m/s" })
    } else if has("acc") || name.starts_with('a') || has("channel") {
        ("acceleration", if has("_g") { "g" } else { "m/s^2" })
    } else {
        ("position", if has("mm") { "mm" } else { "m" })
    }
}

fn axis(name: &str) -> &'static str {
    let name = name.to_lowercase();
    let stem = name.split(['_', ' ', '[', '(']).next().unwrap_or_default();
    let ends = |axis: char| {
        stem.ends_with(axis)
            || name
                .split('_')
                .any(|part| part.len() == 1 && part.starts_with(axis))
    };
    if ends('x') {
        "x"
    } else if ends('y') {
        "y"
    } else if ends('z') || name.contains("normal") {
        "z"
    } else {
        "along"
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_proposal_can_be_read_again() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(
            folder.path().join("a.csv"),
            "t_ms,ax_g,ay_g,az_g\n0,0,0,1\n",
        )
        .expect("written");
        std::fs::write(folder.path().join("f.csv"), "time_s,fz,x_mm\n0,0,1\n").expect("written");
        let text = propose(folder.path()).expect("two files");
        std::fs::write(folder.path().join("recording.toml"), &text).expect("written");
        let read = crate::description::read(folder.path()).expect("valid");
        assert_eq!(read.files.len(), 2);
        assert_eq!(read.files[0].channels[2].label(), "acceleration z");
        assert_eq!(read.files[1].channels[1].unit.name, "mm");
        assert_eq!(read.files[0].clock_s, 1e-3);
    }

    #[test]
    fn a_folder_without_sensor_files_has_no_proposal() {
        let folder = tempfile::tempdir().expect("a folder");
        std::fs::write(folder.path().join("notes.md"), "hello").expect("written");
        assert_eq!(propose(folder.path()), None);
    }
}
