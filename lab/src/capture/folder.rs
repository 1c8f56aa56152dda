//! A recording as a folder: `recording.toml`, `touch.csv` and `accel.csv`.

use super::columns::Channel;
use super::take::{Load, Take, Touch};
use asperity_recording::description::{Axis, Quantity};
use asperity_recording::signal::quantile::median;
use std::fmt::Write as _;
use std::io::{self, Write};
use std::ops::Range;

/// Files of a recording: its description, the device, the sensor.
pub const FILES: [&str; 3] = ["recording.toml", "touch.csv", "accel.csv"];
/// Longest gap that an import bridges, s, with a margin.
const MOST_GAP_S: f64 = 0.9;
/// Shortest gap of a clock that an import sees, s and periods; it takes anything less for jitter.
const GAP: (f64, f64) = (0.005, 3.0);
/// Step of the sensor's clock, in periods, at which samples were lost.
const LOST: f64 = 1.75;
/// Times that differ by less are the same, s.
const SAME_S: f64 = 1e-8;
/// Shortest recording that is kept, s.
const LEAST_S: f64 = 1.0;

/// Metadata of a recording.
#[derive(Debug, Clone, PartialEq)]
pub struct About {
    /// Name of the material.
    pub name: String,
    /// Device and sensor.
    pub device: String,
    /// The tool.
    pub tool: Option<String>,
    /// Its mass, kg.
    pub mass_kg: Option<f64>,
    /// Largest acceleration of the sensor, in the unit of its channels.
    pub full_acceleration: Option<f64>,
    /// Largest force of the sensor, in the unit of its channels.
    pub full_force: Option<f64>,
}

/// The usable part of a take: the time that both files cover without a long gap.
#[derive(Debug, Clone, PartialEq)]
pub struct Part {
    /// Samples whose time stamps are believed, and their times on the loop's clock, s.
    believed: Vec<u32>,
    times_s: Vec<f64>,
    touches: Range<usize>,
    samples: Range<usize>,
    /// When it begins on the loop's clock, s.
    begin_s: f64,
    /// Duration, s.
    pub seconds: f64,
    /// Samples a second.
    pub rate_hz: f64,
    /// True if the data after a gap was dropped.
    pub is_cut: bool,
    /// Samples that were left out because their time stamps were damaged.
    pub misdated: usize,
}

impl Part {
    /// Rows of the device, and samples of the sensor.
    #[must_use]
    pub fn rows(&self) -> (usize, usize) {
        (self.touches.len(), self.samples.len())
    }
}

/// Times without a long gap from the first on: how many.
fn unbroken(times_s: &[f64]) -> usize {
    let gap = times_s
        .windows(2)
        .position(|pair| pair[1] - pair[0] > MOST_GAP_S);
    gap.map_or(times_s.len(), |before| before + 1)
}

/// Returns the usable part of a take; `None` where device and sensor overlap for less than a second.
#[must_use]
pub fn part(take: &Take) -> Option<Part> {
    let (believed, times_s) = take.timed();
    let touched_s: Vec<f64> = take
        .touches()
        .iter()
        .map(|touch| 1e-9 * touch.at_ns as f64)
        .collect();
    let begin_s = touched_s.first()?.max(*times_s.first()?);
    let after = |times_s: &[f64]| times_s.partition_point(|t_s| *t_s < begin_s);
    let (first_touch, first_sample) = (after(&touched_s), after(&times_s));
    let touch_count = unbroken(touched_s.get(first_touch..)?);
    let sample_count = unbroken(times_s.get(first_sample..)?);
    if touch_count < 2 || sample_count < 2 {
        return None;
    }
    let touches = first_touch..first_touch + touch_count;
    let samples = first_sample..first_sample + sample_count;
    let is_cut = touches.end < touched_s.len() || samples.end < times_s.len();
    let end_s = touched_s[touches.end - 1].min(times_s[samples.end - 1]);
    let until = |times_s: &[f64]| times_s.partition_point(|t_s| *t_s <= end_s);
    let touches = touches.start..touches.end.min(until(&touched_s));
    let samples = samples.start..samples.end.min(until(&times_s));
    let seconds = end_s - begin_s;
    if seconds < LEAST_S || touches.len() < 2 || samples.len() < 2 {
        return None;
    }
    Some(Part {
        rate_hz: 1.0 / period_s(&times_s[samples.clone()]),
        misdated: take.samples() - believed.len(),
        believed,
        times_s,
        touches,
        samples,
        begin_s,
        seconds,
        is_cut,
    })
}

/// Time from sample to sample, s. Some may be lost, which the median does not see; a coarse clock
/// gives several samples one time, which the mean does not see.
fn period_s(times_s: &[f64]) -> f64 {
    let mean_s = (times_s[times_s.len() - 1] - times_s[0]) / (times_s.len() - 1) as f64;
    let middle_s = median(times_s.windows(2).map(|pair| pair[1] - pair[0]));
    if middle_s > 0.5 * mean_s && middle_s < mean_s {
        middle_s
    } else {
        mean_s
    }
}

/// Writes one of the [`FILES`] of a recording.
///
/// # Errors
/// [`io::Error`] of what is written to.
pub fn write(
    which: usize,
    about: &About,
    take: &Take,
    part: &Part,
    to: &mut impl Write,
) -> io::Result<()> {
    match which {
        0 => to.write_all(description(about, take).as_bytes()),
        1 => touch(take, part, to),
        _ => accel(take, part, to),
    }
}

/// The device on an even clock. Between two readings a place is interpolated, so that a period that
/// was missed bends no clock; longer gaps stay.
fn touch(take: &Take, part: &Part, file: &mut impl Write) -> io::Result<()> {
    let mut file = io::BufWriter::new(file);
    let has_force = take.load() == Load::Loop;
    file.write_all(if has_force {
        b"t_s,x,y,z,fx,fy,fz\n"
    } else {
        b"t_s,x,y,z\n"
    })?;
    let touches = &take.touches()[part.touches.clone()];
    let tick_s = 1.0 / take.rate_hz();
    let gap_s = GAP.0.max(GAP.1 * tick_s);
    let at_s = |touch: &Touch| 1e-9 * touch.at_ns as f64 - part.begin_s;
    let mut row = 0_u64;
    for pair in touches.windows(2) {
        let (from_s, to_s) = (at_s(&pair[0]), at_s(&pair[1]));
        loop {
            let t_s = row as f64 * tick_s;
            if t_s > to_s + SAME_S {
                break;
            }
            row += 1;
            if t_s < from_s - SAME_S || (to_s - from_s > gap_s && t_s > from_s + SAME_S) {
                continue;
            }
            let share = (t_s - from_s) / (to_s - from_s);
            let between = |from: f32, to: f32| f64::from(from) + share * f64::from(to - from);
            write!(file, "{t_s:.6}")?;
            for (from, to) in pair[0].place_m.iter().zip(pair[1].place_m) {
                write!(file, ",{:.4}", 1e3 * between(*from, to))?;
            }
            if has_force {
                for (from, to) in pair[0].force_n.iter().zip(pair[1].force_n) {
                    write!(file, ",{:.5}", between(*from, to))?;
                }
            }
            file.write_all(b"\n")?;
        }
    }
    file.flush()
}

/// The sensor on the loop's clock. Where one or a few samples are missing, rows without values stand.
fn accel(take: &Take, part: &Part, file: &mut impl Write) -> io::Result<()> {
    let mut file = io::BufWriter::new(file);
    let channels = take.channels();
    file.write_all(b"t_s")?;
    for channel in &channels {
        write!(file, ",{}", channel.name())?;
    }
    file.write_all(b"\n")?;
    let period_s = 1.0 / part.rate_hz;
    let gap_s = GAP.0.max(GAP.1 * period_s);
    let mut before_s = None;
    for sample in part.samples.clone() {
        let t_s = part.times_s[sample] - part.begin_s;
        let step_s = before_s.replace(t_s).map_or(0.0, |before_s| t_s - before_s);
        if step_s > LOST * period_s && step_s <= gap_s && take.tells_samples_apart(period_s) {
            let lost = (step_s / period_s).round() as usize - 1;
            for n in 1..=lost {
                let share = n as f64 / (lost + 1) as f64;
                write!(file, "{:.7}", t_s - step_s + share * step_s)?;
                file.write_all(&b",".repeat(channels.len()))?;
                file.write_all(b"\n")?;
            }
        }
        write!(file, "{t_s:.7}")?;
        for value in take.values(part.believed[sample] as usize) {
            // Nothing stands for a missing value.
            if value.is_finite() {
                write!(file, ",{value}")?;
            } else {
                file.write_all(b",")?;
            }
        }
        file.write_all(b"\n")?;
    }
    file.flush()
}

/// A string of TOML. Its escapes are those of JSON.
fn quoted(text: &str) -> String {
    serde_json::Value::from(text)
        .to_string()
        .replace('\u{7f}', "\\u007f")
}

fn description(about: &About, take: &Take) -> String {
    let mut text = format!(
        "name = {}\ndevice = {}\n",
        quoted(&about.name),
        quoted(&about.device)
    );
    if about.tool.is_some() || about.mass_kg.is_some() {
        text += "\n[tool]\n";
    }
    // Writing to a string cannot fail.
    if let Some(tool) = &about.tool {
        let _ = writeln!(text, "name = {}", quoted(tool));
    }
    if let Some(mass_kg) = about.mass_kg {
        let _ = writeln!(text, "mass_kg = {mass_kg:?}");
    }
    let file = |path: &str| format!("\n[[file]]\npath = \"{path}\"\nclock = \"t_s\"\n");
    let channel = |column: &str, quantity: Quantity, axis: Axis, unit: &str| {
        format!(
            "[[file.channel]]\ncolumn = \"{column}\"\nquantity = \"{quantity}\"\naxis = \"{axis}\"\nunit = \"{unit}\"\n"
        )
    };
    let axes = [Axis::X, Axis::Y, Axis::Z];
    text += &file(FILES[1]);
    for axis in axes {
        text += &channel(&axis.to_string(), Quantity::Position, axis, "mm");
    }
    if take.load() == Load::Loop {
        for axis in axes {
            text += &channel(&format!("f{axis}"), Quantity::Force, axis, "N");
        }
    }
    text += &file(FILES[2]);
    for measured in take.channels() {
        let Channel {
            quantity,
            axis,
            unit,
        } = measured;
        text += &channel(&measured.name(), quantity, axis, unit.name);
        let full = match quantity {
            Quantity::Force => about.full_force,
            _ => about.full_acceleration,
        };
        if let Some(full) = full {
            let _ = writeln!(text, "range = [-{full:?}, {full:?}]");
        }
    }
    text
}

#[cfg(test)]
#[path = "folder_tests.rs"]
mod tests;
