//! All channels of a recording, in SI units, on the clocks of their files.

use super::{header, rows};
use crate::{
    channel::{Channel, Numbers},
    description::{self, Column, Description, SensorFile},
    error::{Problem, RecordingError},
    signal::{quantile::median, resample::Clock},
};
use std::path::{Path, PathBuf};

/// Most values that are kept of all channels together: 256 MiB. What comes later is checked, not
/// used.
pub const MAX_KEPT: usize = 64 << 20;
/// Rows whose clock tells the rate before a file is read.
const CLOCK_ROWS: usize = 4000;
/// Longest gap of a clock that is bridged, s.
const MAX_GAP_S: f64 = 1.0;
/// Shortest gap, s, and in samples. Anything less is jitter.
const LEAST_GAP: (f64, f64) = (0.005, 3.0);
/// Difference between the stated rate and the clock's that is drift, as a fraction.
const MAX_RATE_DIFFERENCE: f64 = 0.02;

/// A recording in memory.
#[derive(Debug, Clone)]
pub struct Recording {
    /// The folder.
    pub folder: PathBuf,
    /// What it says of itself.
    pub description: Description,
    /// Its channels.
    pub channels: Vec<Channel>,
    /// The clock of every file.
    pub clocks: Vec<FileClock>,
}

/// What was seen of the clock of a file.
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
    /// Whether not all of them are kept.
    pub shortened: bool,
}

impl FileClock {
    /// How much faster the clock is than the stated rate, parts per million.
    #[must_use]
    pub fn drift_ppm(&self) -> Option<f64> {
        Some(1e6 * (self.clock_hz? / self.stated_hz? - 1.0))
    }
}

/// Reads all files of a recording.
///
/// # Errors
/// [`RecordingError`] with the file and the line at fault.
pub fn load(folder: &Path) -> Result<Recording, RecordingError> {
    load_at_most(folder, MAX_KEPT)
}

/// The same with another number of values that are kept of all channels together. Rows beyond are
/// read and checked, one at a time.
///
/// # Errors
/// [`RecordingError`] with the file and the line at fault.
pub fn load_at_most(folder: &Path, max_kept: usize) -> Result<Recording, RecordingError> {
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
    Ok(recording)
}

fn read_file(
    folder: &Path,
    file: &SensorFile,
    keep: usize,
) -> Result<(FileClock, Vec<Channel>), RecordingError> {
    let path = folder.join(&file.file);
    let header = header(&path)?;
    let find = |column: &Column| {
        let found = match column {
            Column::Index(index) => (*index < header.columns.len()).then_some(*index),
            Column::Name(name) => header.columns.iter().position(|known| known == name),
        };
        found.ok_or_else(|| {
            let found = header.columns.join(", ");
            let problem = Problem::NoColumn {
                column: column.to_string(),
                found,
            };
            RecordingError::at(&path, 1, problem)
        })
    };
    let clock_column = file.clock.as_ref().map(find).transpose()?;
    let columns = file
        .channels
        .iter()
        .map(|c| find(&c.column))
        .collect::<Result<Vec<_>, _>>()?;
    let stated_hz = file.rate_hz.or(header.rate_hz);
    let mut watch = match clock_column {
        Some(column) => ClockWatch::new(first_period_s(&path, column, file.clock_s)?),
        None => {
            let Some(rate_hz) = stated_hz else {
                let entry = folder.join(description::FILE_NAME);
                let problem =
                    Problem::Missing(format!("{:?} has neither `clock` nor `rate_hz`", file.file));
                return Err(RecordingError::at(entry, file.line, problem));
            };
            ClockWatch::new(1.0 / rate_hz)
        }
    };
    let mut samples: Vec<Vec<f32>> = vec![Vec::new(); columns.len()];
    let mut numbers = vec![Numbers::default(); columns.len()];
    let factors: Vec<f64> = file
        .channels
        .iter()
        .map(description::Channel::factor)
        .collect();
    rows(&path, &mut |line, row| {
        let bridged = match clock_column {
            Some(column) => {
                let at_s = row[column] * file.clock_s;
                watch
                    .take(at_s)
                    .map_err(|problem| RecordingError::at(&path, line, problem))?
            }
            None => 0,
        };
        if bridged > 0 {
            watch.first_gap.get_or_insert(line);
        }
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
        watch.index += 1;
        Ok(true)
    })?;
    if watch.index < 2 {
        return Err(RecordingError::of(
            &path,
            Problem::TooLittle("has fewer than two rows".into()),
        ));
    }
    let entry = || folder.join(description::FILE_NAME);
    let fitted = clock_column.map(|_| watch.fitted());
    let clock = match fitted {
        Some((clock, _)) => clock,
        None => Clock {
            start_s: file.start_s,
            rate_hz: 1.0 / watch.period_s,
        },
    };
    if let (Some(stated_hz), Some((clock, _))) = (stated_hz, fitted)
        && (clock.rate_hz / stated_hz - 1.0).abs() > MAX_RATE_DIFFERENCE
    {
        let problem = Problem::RateContradiction {
            stated_hz,
            clock_hz: clock.rate_hz,
        };
        return Err(RecordingError::at(entry(), file.line, problem));
    }
    let report = FileClock {
        file: file.file.clone(),
        stated_hz,
        clock_hz: fitted.map(|(clock, _)| clock.rate_hz),
        jitter_s: fitted.map_or(0.0, |(_, jitter_s)| jitter_s),
        gaps: watch.gaps,
        first_gap: watch.first_gap,
        gap_s: watch.gap_s,
        rows: watch.rows,
        shortened: numbers.iter().any(|numbers| numbers.count > keep as u64),
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
        let problem = Problem::TooLittle(format!("holds no number for {}", channel.label));
        return Err(RecordingError::of(&path, problem));
    }
    Ok((report, channels))
}

/// The period of a clock by its first rows, s.
fn first_period_s(path: &Path, column: usize, unit_s: f64) -> Result<f64, RecordingError> {
    let mut times = Vec::with_capacity(CLOCK_ROWS);
    rows(path, &mut |_, row| {
        times.push(row[column] * unit_s);
        Ok(times.len() < CLOCK_ROWS)
    })?;
    let steps: Vec<f64> = times
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|dt| dt.is_finite())
        .collect();
    let middle = median(steps.iter().copied());
    // A coarse clock gives several rows the same time.
    let short: Vec<f64> = steps
        .iter()
        .copied()
        .filter(|dt| *dt < LEAST_GAP.0.max(10.0 * middle))
        .collect();
    let mean = short.iter().sum::<f64>() / short.len().max(1) as f64;
    let period_s = if mean > 0.0 { mean } else { middle };
    if period_s > 0.0 {
        Ok(period_s)
    } else {
        Err(RecordingError::of(
            path,
            Problem::TooLittle("has a clock that does not move".into()),
        ))
    }
}

/// Follows a clock: finds gaps, and fits a steady rate.
struct ClockWatch {
    period_s: f64,
    /// Samples so far, bridged ones included.
    index: u64,
    rows: u64,
    last_s: Option<f64>,
    first_s: f64,
    gaps: u64,
    gap_s: f64,
    first_gap: Option<u64>,
    // Sums of a regression of time on index, about running means.
    means: (f64, f64),
    sums: (f64, f64, f64),
}

impl ClockWatch {
    fn new(period_s: f64) -> Self {
        Self {
            period_s,
            index: 0,
            rows: 0,
            last_s: None,
            first_s: 0.0,
            gaps: 0,
            gap_s: 0.0,
            first_gap: None,
            means: (0.0, 0.0),
            sums: (0.0, 0.0, 0.0),
        }
    }

    /// Takes the time of a row, and gives the samples that are missing before it.
    fn take(&mut self, at_s: f64) -> Result<u64, Problem> {
        if !at_s.is_finite() {
            return Err(Problem::Format("has a row without a time".into()));
        }
        let mut bridged = 0;
        if let Some(before_s) = self.last_s {
            let step_s = at_s - before_s;
            if step_s < 0.0 {
                return Err(Problem::ClockBackwards {
                    before_s,
                    now_s: at_s,
                });
            }
            if step_s > MAX_GAP_S + self.period_s {
                return Err(Problem::Gap { gap_s: step_s });
            }
            let (least_s, least_samples) = LEAST_GAP;
            if step_s > least_s && step_s > least_samples * self.period_s {
                bridged = (step_s / self.period_s).round() as u64 - 1;
                self.gaps += 1;
                self.gap_s += step_s;
            }
        } else {
            self.first_s = at_s;
        }
        self.last_s = Some(at_s);
        self.index += bridged;
        self.rows += 1;
        let (x, y) = (self.index as f64, at_s - self.first_s);
        let share = 1.0 / self.rows as f64;
        let (dx, dy) = (x - self.means.0, y - self.means.1);
        self.means.0 += share * dx;
        self.means.1 += share * dy;
        self.sums.0 += dx * (x - self.means.0);
        self.sums.1 += dx * (y - self.means.1);
        self.sums.2 += dy * (y - self.means.1);
        Ok(bridged)
    }

    /// The steady clock that fits best, and the RMS distance from it, s.
    fn fitted(&self) -> (Clock, f64) {
        let (xx, xy, yy) = self.sums;
        let period_s = if xx > 0.0 { xy / xx } else { self.period_s };
        let clock = Clock {
            start_s: self.first_s + self.means.1 - period_s * self.means.0,
            rate_hz: 1.0 / period_s,
        };
        let rest = (yy - xy * period_s).max(0.0) / self.rows.max(1) as f64;
        (clock, rest.sqrt())
    }
}
