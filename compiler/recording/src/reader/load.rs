//! All channels of a recording, in SI units, on the clocks of their files.

use super::{Header, Remark, clock, header, rows};
use crate::{
    channel::{Channel, Numbers},
    description::{self, Column, Description, Meaning, RATES_HZ, SensorFile, TIME_UNITS},
    remedy,
    signal::resample::Clock,
};
use asperity_io::diagnostic::Fault;
use std::path::{Path, PathBuf};

/// Most values that are kept of all channels together: 256 MiB. What comes later is checked, not
/// used.
pub const MAX_KEPT: usize = 64 << 20;
/// Difference between the stated rate and the clock's that is drift, as a fraction.
const MAX_RATE_DIFFERENCE: f64 = 0.02;
/// Factors by which the unit of a clock may be wrong.
const UNIT_FACTORS: [f64; 7] = [1.0, 1e3, 1e-3, 1e6, 1e-6, 1e9, 1e-9];
/// Files of one recording cover times that differ by no more than this factor.
const SAME_TIME: f64 = 3.0;
/// The middle of the rates of sensors, Hz.
const USUAL_HZ: f64 = 1000.0;

/// A recording in memory.
#[derive(Debug, Clone)]
pub struct Recording {
    /// The folder.
    pub folder: PathBuf,
    /// Its description.
    pub description: Description,
    /// Its channels.
    pub channels: Vec<Channel>,
    /// The clock of every file.
    pub clocks: Vec<FileClock>,
}

/// Statistics of a file's clock.
#[derive(Debug, Clone, PartialEq)]
pub struct FileClock {
    /// The file.
    pub file: String,
    /// Rows a second as the description says.
    pub stated_hz: Option<f64>,
    /// Rows a second as the clock says.
    pub clock_hz: Option<f64>,
    /// RMS distance of the clock from a steady one, s.
    pub jitter_s: f64,
    /// Gaps that were bridged.
    pub gaps: u64,
    /// Line of the first of them.
    pub first_gap: Option<u64>,
    /// Time in gaps, s.
    pub gap_s: f64,
    /// Rows.
    pub rows: u64,
    /// True if some rows were dropped.
    pub shortened: bool,
    /// Faults of the file that do not prevent reading it.
    pub remarks: Vec<Remark>,
}

impl FileClock {
    /// Excess of the clock over the stated rate, parts per million.
    #[must_use]
    pub fn drift_ppm(&self) -> Option<f64> {
        Some(1e6 * (self.clock_hz? / self.stated_hz? - 1.0))
    }
}

/// Reads all files of a recording.
///
/// # Errors
/// [`Fault`] with the file and the line at fault.
pub fn load(folder: &Path) -> Result<Recording, Fault> {
    load_at_most(folder, MAX_KEPT)
}

/// The same with another number of values that are kept of all channels together. Rows beyond are
/// read and checked, one at a time.
///
/// # Errors
/// [`Fault`] with the file and the line at fault.
pub fn load_at_most(folder: &Path, max_kept: usize) -> Result<Recording, Fault> {
    let description = description::read(folder)?;
    let channels: usize = description
        .files
        .iter()
        .map(|file| file.channels.len())
        .sum();
    let keep = max_kept / channels.max(1);
    let mut recording = Recording {
        folder: folder.to_owned(),
        channels: Vec::with_capacity(channels),
        clocks: Vec::new(),
        description,
    };
    for file in &recording.description.files {
        let (clock, channels) = read_file(folder, file, keep)?;
        recording.clocks.push(clock);
        recording.channels.extend(channels);
    }
    check_units(&recording, &recording.description.files)?;
    Ok(recording)
}

/// Ratio of two rates, at least 1.
fn factor(one: f64, other: f64) -> f64 {
    (one / other).max(other / one)
}

/// Where the columns of a file's entry are.
struct Columns {
    clock: Option<usize>,
    channels: Vec<usize>,
}

fn columns(path: &Path, file: &SensorFile, header: &Header) -> Result<Columns, Fault> {
    let find = |column: &Column| {
        let duplicates = match column {
            Column::Index(index) if *index < header.columns.len() => return Ok(*index),
            Column::Name(name) => {
                let mut found = (0..header.columns.len()).filter(|&n| header.columns[n] == *name);
                match (found.next(), found.count()) {
                    (Some(index), 0) => return Ok(index),
                    (Some(_), more) => 1 + more,
                    (None, _) => 0,
                }
            }
            Column::Index(_) => 0,
        };
        let column = column.to_string();
        let fault = if duplicates > 0 {
            let what = format!("has the column {column:?} {duplicates} times");
            let remedy = "give its number from 0 under `column`, or rename one of them in the file";
            Fault::new(what, remedy)
        } else {
            let found = header.columns.join(", ");
            let what = format!("has no column {column:?}; it has {found}");
            Fault::new(what, "name one of these under `column` in recording.toml")
        };
        Err(fault.at(path).line(header.line.max(1)))
    };
    Ok(Columns {
        clock: file.clock.as_ref().map(find).transpose()?,
        channels: file
            .channels
            .iter()
            .map(|c| find(&c.column))
            .collect::<Result<_, _>>()?,
    })
}

fn read_file(
    folder: &Path,
    file: &SensorFile,
    keep: usize,
) -> Result<(FileClock, Vec<Channel>), Fault> {
    let path = folder.join(&file.file);
    let header = header(&path)?;
    let Columns {
        clock: clock_column,
        channels: columns,
    } = columns(&path, file, &header)?;
    let stated_hz = file.rate_hz.or(header.rate_hz);
    let in_entry = |what: String, remedy: &str| {
        let description = folder.join(description::FILE_NAME);
        Fault::new(what, remedy).at(description).line(file.line)
    };
    let (clock, seen) = match (clock_column, stated_hz) {
        (Some(column), _) => {
            let seen = clock::follow(&path, column, file.clock_s)?;
            (seen.clock, Some(seen))
        }
        (None, Some(rate_hz)) => {
            let start_s = file.start_s;
            (Clock { start_s, rate_hz }, None)
        }
        (None, None) => {
            let what = format!("{:?} has neither `clock` nor `rate_hz`", file.file);
            return Err(in_entry(what, remedy::MISSING));
        }
    };
    if let (Some(stated_hz), Some(seen)) = (stated_hz, &seen)
        && (seen.clock.rate_hz / stated_hz - 1.0).abs() > MAX_RATE_DIFFERENCE
    {
        let clock_hz = seen.clock.rate_hz;
        let what = format!(
            "rate_hz says {stated_hz} Hz, the clock says {clock_hz:.3} Hz: a factor of {:.4}",
            factor(stated_hz, clock_hz)
        );
        let remedy = "leave `rate_hz` out, or correct `clock_unit`";
        return Err(in_entry(what, remedy));
    }
    if let (Some(stated_hz), None) = (stated_hz, &seen)
        && let Some((column, clock_hz)) = unused_clock(&path, &header, stated_hz)
    {
        let what = format!(
            "rate_hz says {stated_hz} Hz, but its column {column:?} is a clock of {clock_hz:.3} Hz: a factor of {:.4}",
            factor(stated_hz, clock_hz)
        );
        let remedy =
            format!("write clock = {column:?} in place of `rate_hz`, or correct `rate_hz`");
        return Err(Fault::new(what, remedy).at(path));
    }
    let gaps = seen.as_ref().map_or(&[][..], |seen| &seen.gaps[..]);
    let mut later_gaps = gaps.iter().peekable();
    let mut samples: Vec<Vec<f32>> = vec![Vec::new(); columns.len()];
    let mut numbers = vec![Numbers::default(); columns.len()];
    let factors: Vec<f64> = file
        .channels
        .iter()
        .map(description::Channel::factor)
        .collect();
    let mut count = 0;
    let remark = rows(&path, &columns, &mut |line, row| {
        let gap = later_gaps.next_if(|gap| gap.row == count);
        let bridged = gap.map_or(0, |gap| gap.missing);
        for (((samples, numbers), &column), factor) in samples
            .iter_mut()
            .zip(&mut numbers)
            .zip(&columns)
            .zip(&factors)
        {
            if bridged > 0 {
                let start = numbers.count;
                numbers.count += bridged;
                numbers.bridged(start..start + bridged);
                let held = samples.last().copied().unwrap_or(0.0);
                let room = keep.saturating_sub(samples.len()).min(bridged as usize);
                samples.resize(samples.len() + room, held);
            }
            let value = numbers.take(row[column] * factor, line);
            if samples.len() < keep {
                samples.push(value as f32);
            }
        }
        count += 1;
        Ok(true)
    })?;
    if count < 2 {
        return Err(Fault::new("has fewer than two rows", remedy::TOO_LITTLE).at(path));
    }
    let report = FileClock {
        file: file.file.clone(),
        stated_hz,
        clock_hz: seen.as_ref().map(|seen| seen.clock.rate_hz),
        jitter_s: seen.as_ref().map_or(0.0, |seen| seen.jitter_s),
        gaps: gaps.len() as u64,
        first_gap: gaps.first().map(|gap| gap.line),
        gap_s: gaps.iter().map(|gap| gap.step_s).sum(),
        rows: count,
        shortened: numbers.iter().any(|numbers| numbers.count > keep as u64),
        remarks: header.remarks.iter().cloned().chain(remark).collect(),
    };
    let channels = file.channels.iter().zip(samples).zip(numbers).map(
        |((described, samples), mut numbers)| {
            numbers.finish();
            // A WAV of integers cannot hold more than full scale.
            let of_file = header.full_scale.then_some([-1.0, 1.0]);
            let range = described
                .range
                .map(|range| range.map(|x| x * described.unit.to_si));
            Channel {
                label: described.label(),
                file: file.file.clone(),
                quantity: described.quantity,
                axis: described.axis,
                range: range.or(of_file.map(|range| range.map(|x| x * described.factor().abs()))),
                clock,
                samples,
                numbers,
            }
        },
    );
    let channels: Vec<Channel> = channels.collect();
    if let Some(channel) = channels
        .iter()
        .find(|c| c.numbers.missing == c.numbers.count)
    {
        let what = format!("holds no number for {}", channel.label);
        return Err(Fault::new(what, remedy::TOO_LITTLE).at(path));
    }
    Ok((report, channels))
}

/// A column that is a clock by its name and runs at another rate than the stated one, and its rate.
fn unused_clock(path: &Path, header: &Header, stated_hz: f64) -> Option<(String, f64)> {
    let off = |clock_hz: f64| libm::log(clock_hz / stated_hz).abs();
    let rates = header
        .columns
        .iter()
        .enumerate()
        .filter_map(|(index, name)| {
            let Meaning::Clock(_) = header.meaning(index) else {
                return None;
            };
            let period = clock::period(path, index)?;
            // The unit in which it comes nearest: a header may not name it, or the wrong one.
            let nearest = TIME_UNITS
                .into_iter()
                .map(|(_, unit_s)| 1.0 / (period * unit_s))
                .min_by(|one, other| off(*one).total_cmp(&off(*other)))?;
            Some((name.clone(), nearest))
        });
    let mut rates: Vec<(String, f64)> = rates.collect();
    rates.sort_by(|(_, one), (_, other)| off(*one).total_cmp(&off(*other)));
    rates
        .into_iter()
        .next()
        .filter(|(_, rate_hz)| (rate_hz / stated_hz - 1.0).abs() > MAX_RATE_DIFFERENCE)
}

/// Finds a clock whose unit cannot be right: by the rates that sensors have, and by the time that the other
/// files cover.
fn check_units(recording: &Recording, files: &[SensorFile]) -> Result<(), Fault> {
    let durations: Vec<f64> = files
        .iter()
        .zip(&recording.clocks)
        .map(|(file, clock)| {
            let channel = recording.channels.iter().find(|c| c.file == file.file);
            channel.map_or(0.0, |c| clock.rows as f64 / c.clock.rate_hz)
        })
        .collect();
    let (least_hz, most_hz) = RATES_HZ;
    // How far a rate is from those that sensors have.
    let strange = |rate_hz: f64| {
        let outside = (least_hz / rate_hz).max(rate_hz / most_hz).max(1.0);
        libm::log(outside) * 10.0 + libm::log(rate_hz / USUAL_HZ).abs()
    };
    let mut worst: Option<(usize, f64, f64)> = None;
    for (index, clock) in recording.clocks.iter().enumerate() {
        let Some(rate_hz) = clock.clock_hz else {
            continue;
        };
        let others = (0..files.len()).filter(|other| *other != index);
        let agrees = |factor: f64| {
            others
                .clone()
                .filter(|&other| {
                    let ratio = durations[index] / durations[other] / factor;
                    ratio > 1.0 / SAME_TIME && ratio < SAME_TIME
                })
                .count()
        };
        let factor = UNIT_FACTORS.into_iter().max_by(|one, other| {
            let plausible =
                |factor: f64| rate_hz * factor >= least_hz && rate_hz * factor <= most_hz;
            agrees(*one)
                .cmp(&agrees(*other))
                .then(plausible(*one).cmp(&plausible(*other)))
                .then(strange(rate_hz * other).total_cmp(&strange(rate_hz * one)))
        });
        let is_right =
            agrees(1.0) > 0 || files.len() == 1 && rate_hz >= least_hz && rate_hz <= most_hz;
        if let Some(factor) = factor.filter(|factor| *factor != 1.0 && !is_right)
            && (agrees(factor) > 0 || rate_hz < least_hz || rate_hz > most_hz)
            && worst.is_none_or(|(.., known)| strange(rate_hz) > known)
        {
            worst = Some((index, factor, strange(rate_hz)));
        }
    }
    let Some((index, factor, _)) = worst else {
        return Ok(());
    };
    let (file, clock) = (&files[index], &recording.clocks[index]);
    let column = file
        .clock
        .as_ref()
        .map(ToString::to_string)
        .unwrap_or_default();
    let (pace, factor) = match factor > 1.0 {
        true => ("too slow", factor),
        false => ("too fast", 1.0 / factor),
    };
    let what = format!(
        "the clock {column:?} gives {:.4} rows a second if its unit is {}: it is {pace} by a factor of {factor}",
        clock.clock_hz.unwrap_or_default(),
        file.clock_unit
    );
    let fault = Fault::new(what, "correct `clock_unit` in recording.toml");
    Err(fault.at(recording.folder.join(&file.file)))
}

#[cfg(test)]
#[path = "load_tests.rs"]
mod tests;
