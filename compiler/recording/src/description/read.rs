//! Reads and checks a description.

use super::{
    propose::{Proposal, propose},
    quantity::{Quantity, Unit},
    schema::{Axis, Channel, Column, Description, RATES_HZ, SensorFile, TIME_UNITS, Tool},
};
use crate::{
    file,
    remedy::{self, unreadable},
};
use asperity_io::diagnostic::Fault;
use serde::Deserialize;
use std::{io::Read, path::Path};
use toml::Spanned;

/// Name of the description in its folder.
pub const FILE_NAME: &str = "recording.toml";
/// Most bytes of a description.
pub const MAX_BYTES: u64 = 1024 * 1024;
/// Most files and most channels of a file.
const MAX_ENTRIES: usize = 64;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawDescription {
    name: String,
    device: Option<String>,
    #[serde(default)]
    tool: Tool,
    #[serde(default)]
    file: Vec<Spanned<RawFile>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawFile {
    path: String,
    rate_hz: Option<Spanned<f64>>,
    clock: Option<Column>,
    clock_unit: Option<Spanned<String>>,
    #[serde(default)]
    start_s: f64,
    #[serde(default)]
    channel: Vec<Spanned<RawChannel>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawChannel {
    column: Column,
    quantity: Quantity,
    axis: Option<Axis>,
    unit: Spanned<String>,
    scale: Option<f64>,
    range: Option<[f64; 2]>,
}

/// Returns true if a folder has no description, or an empty one.
#[must_use]
pub fn is_absent(folder: &Path) -> bool {
    let path = folder.join(FILE_NAME);
    match std::fs::metadata(&path) {
        Ok(file) if file.is_file() && file.len() <= MAX_BYTES => {
            std::fs::read(&path).is_ok_and(|bytes| bytes.trim_ascii().is_empty())
        }
        Ok(_) => false,
        Err(_) => path.symlink_metadata().is_err(),
    }
}

/// Returns the fault of a folder without a description; [`propose`] has read its files for one.
pub fn no_description(folder: &Path, proposal: Option<&Proposal>) -> Fault {
    let mut what = "the folder has no recording.toml".to_owned();
    let remedy = match proposal {
        Some(Proposal { files: 0, text }) => {
            what += &format!(", and no file that can be used as it is\n{}", text.trim());
            "do what is said of each file, then run `asperity record-check --init`"
        }
        Some(_) => {
            "`asperity record-check --init` writes a draft of it into the folder; correct its guesses"
        }
        None => "give a folder with recording.toml and CSV, WAV or NumPy files",
    };
    Fault::new(what, remedy).at(folder)
}

/// Reads the description of a folder.
///
/// # Errors
/// [`Fault`] with the line at fault, and [`no_description`] where the folder has none.
pub fn read(folder: &Path) -> Result<Description, Fault> {
    let path = folder.join(FILE_NAME);
    if !folder.is_dir() {
        let error = std::io::Error::other("it is no folder");
        return Err(unreadable(folder)(error));
    }
    if is_absent(folder) {
        return Err(no_description(folder, propose(folder)?.as_ref()));
    }
    let mut text = String::new();
    let file = file::open(&path)?;
    let read = file
        .take(MAX_BYTES + 1)
        .read_to_string(&mut text)
        .map_err(unreadable(&path))?;
    if read as u64 > MAX_BYTES {
        let what = format!("has more than {MAX_BYTES} bytes");
        return Err(Fault::new(what, remedy::KEYS).at(path));
    }
    parse(&text, &path)
}

fn parse(text: &str, path: &Path) -> Result<Description, Fault> {
    let line_of = |offset: usize| 1 + text[..offset.min(text.len())].matches('\n').count() as u64;
    let raw: RawDescription = toml::from_str(text).map_err(|error| {
        let line = error.span().map(|span| line_of(span.start));
        Fault::new(error.message(), remedy::KEYS)
            .at(path)
            .line(line)
    })?;
    let field = |offset: usize, field: &str, value: String, rule: &str| {
        let fault = Fault::new(format!("{field} = {value:?} {rule}"), remedy::KEYS);
        fault.at(path).line(line_of(offset))
    };
    if raw.name.trim().is_empty() || raw.name.len() > 64 {
        return Err(field(0, "name", raw.name, "must have 1 to 64 bytes"));
    }
    if let Some(mass_kg) = raw.tool.mass_kg
        && !(mass_kg > 0.0 && mass_kg < 10.0)
    {
        let at = text.find("mass_kg").unwrap_or(0);
        return Err(field(
            at,
            "mass_kg",
            mass_kg.to_string(),
            "must be above 0 and below 10",
        ));
    }
    if raw.file.is_empty() || raw.file.len() > MAX_ENTRIES {
        let value = format!("{} entries", raw.file.len());
        return Err(field(
            0,
            "file",
            value,
            "must have 1 to 64 entries [[file]]",
        ));
    }
    let mut files = Vec::with_capacity(raw.file.len());
    for entry in raw.file {
        let at = entry.span().start;
        let entry = entry.into_inner();
        let inside = Path::new(&entry.path)
            .components()
            .all(|part| matches!(part, std::path::Component::Normal(_)));
        if entry.path.is_empty() || !inside {
            return Err(field(
                at,
                "path",
                entry.path,
                "must name a file inside the folder",
            ));
        }
        let (low, high) = RATES_HZ;
        if let Some(rate) = &entry.rate_hz
            && !(*rate.get_ref() >= low && *rate.get_ref() <= high)
        {
            let (at, value) = (rate.span().start, rate.get_ref().to_string());
            return Err(field(
                at,
                "rate_hz",
                value,
                "must lie between 10 and 200000",
            ));
        }
        if !entry.start_s.is_finite() {
            return Err(field(
                at,
                "start_s",
                entry.start_s.to_string(),
                "must be finite",
            ));
        }
        let clock_unit = entry.clock_unit.as_ref().map_or("s", |unit| unit.get_ref());
        let Some((clock_unit, clock_s)) =
            TIME_UNITS.into_iter().find(|(unit, _)| *unit == clock_unit)
        else {
            let at = entry
                .clock_unit
                .as_ref()
                .map_or(at, |unit| unit.span().start);
            return Err(field(
                at,
                "clock_unit",
                clock_unit.to_owned(),
                "is none of s, ms, us, ns",
            ));
        };
        if entry.channel.is_empty() || entry.channel.len() > MAX_ENTRIES {
            let value = format!("{} entries", entry.channel.len());
            return Err(field(
                at,
                "channel",
                value,
                "must have 1 to 64 entries [[file.channel]]",
            ));
        }
        let mut channels = Vec::with_capacity(entry.channel.len());
        for raw in entry.channel {
            let at = raw.span().start;
            let raw = raw.into_inner();
            let Some(unit) = Unit::named(raw.unit.get_ref(), raw.quantity) else {
                let rule = format!(
                    "is no unit of {}: {}",
                    raw.quantity,
                    Unit::all(raw.quantity)
                );
                let at = raw.unit.span().start;
                return Err(field(at, "unit", raw.unit.into_inner(), &rule));
            };
            let scale = raw.scale.unwrap_or(1.0);
            if !scale.is_finite() || scale == 0.0 {
                return Err(field(
                    at,
                    "scale",
                    scale.to_string(),
                    "must be finite and not 0",
                ));
            }
            if let Some([low, high]) = raw.range
                && (low.is_nan() || high.is_nan() || low >= high)
            {
                return Err(field(
                    at,
                    "range",
                    format!("[{low}, {high}]"),
                    "must ascend",
                ));
            }
            channels.push(Channel {
                column: raw.column,
                quantity: raw.quantity,
                axis: raw.axis.unwrap_or(Axis::Along),
                unit,
                scale,
                range: raw.range,
            });
        }
        files.push(SensorFile {
            file: entry.path,
            line: line_of(at),
            rate_hz: entry.rate_hz.map(Spanned::into_inner),
            clock: entry.clock,
            clock_unit,
            clock_s,
            start_s: entry.start_s,
            channels,
        });
    }
    Ok(Description {
        name: raw.name,
        device: raw.device,
        tool: raw.tool,
        files,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"
name = "oak"
[tool]
mass_kg = 0.05
[[file]]
path = "accel.csv"
clock = "t"
clock_unit = "ms"
[[file.channel]]
column = "az"
quantity = "acceleration"
axis = "z"
unit = "g"
range = [-16, 16]
"#;

    fn fault(text: &str) -> String {
        parse(text, Path::new("recording.toml"))
            .expect_err("a fault")
            .to_string()
    }

    #[test]
    fn a_description_says_what_it_means() {
        let oak = parse(GOOD, Path::new("recording.toml")).expect("valid");
        let channel = &oak.files[0].channels[0];
        assert_eq!(oak.files[0].clock_s, 1e-3);
        assert!((channel.factor() - 9.80665).abs() < 1e-9);
        assert_eq!(channel.label(), "acceleration z");
    }

    #[test]
    fn a_fault_is_named_with_its_line_and_what_would_be_right() {
        let unit = fault(&GOOD.replace("\"g\"", "\"gee\""));
        assert!(
            unit.starts_with("recording.toml:13: unit = \"gee\""),
            "{unit}"
        );
        assert!(unit.contains("m/s^2"), "{unit}");
        let key = fault(&GOOD.replace("axis", "axes"));
        assert!(
            key.starts_with("recording.toml:12: unknown field `axes`"),
            "{key}"
        );
        assert!(fault(&GOOD.replace("accel.csv", "../x.csv")).contains("inside the folder"));
        assert!(fault("name = \"x\"").contains("[[file]]"));
        let named = |length: usize| format!("name = \"{}\"", "n".repeat(length));
        let line = GOOD.lines().find(|line| line.starts_with("name")).unwrap();
        assert!(parse(&GOOD.replace(line, &named(64)), Path::new("x")).is_ok());
        assert!(fault(&GOOD.replace(line, &named(65))).contains("1 to 64 bytes"));
        assert!(fault(&GOOD.replace("0.05", "-1")).contains("recording.toml:4: mass_kg"));
    }
}
