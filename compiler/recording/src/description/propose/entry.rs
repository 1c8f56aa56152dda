//! Proposed entry of a file, from its headers and its first rows.

use crate::{
    description::{
        column_name::{Meaning, words},
        quantity::{GRAVITY_M_S2, Quantity, Unit},
        schema::{Axis, RATES_HZ, TIME_UNITS},
    },
    reader::{Header, clock_period, rows},
    signal::quantile::mean,
};
use std::{fmt::Write as _, path::Path};

/// Rows that tell the unit of a clock, and of an acceleration.
const ROWS: usize = 4000;
/// Tolerance, as a factor, of the mean acceleration from gravity within which its unit is known.
const GRAVITY_TOLERANCE: f64 = 1.15;
/// The middle of the rates of sensors, Hz.
const USUAL_HZ: f64 = 1000.0;
/// Header of Klipper's files, which are in mm/s² without stating it.
const KLIPPER: [&str; 4] = ["time", "accel_x", "accel_y", "accel_z"];

/// A column that a description can name.
pub(super) struct Proposed {
    pub(super) name: String,
    pub(super) index: usize,
    pub(super) quantity: Quantity,
    pub(super) axis: Axis,
    pub(super) unit: Option<Unit>,
}

/// A file that a description can name.
pub(super) struct Entry {
    pub(super) file: String,
    header: Header,
    pub(super) channels: Vec<Proposed>,
    /// Columns that are left out, and why.
    pub(super) left_out: Vec<(String, String)>,
    /// The name of the clock, its unit, and whether that is a guess.
    clock: Option<(usize, &'static str, bool)>,
    /// The unit of accelerations that name none.
    accelerated: Option<&'static str>,
    pub(super) shows_gravity: bool,
}

impl Entry {
    /// Reads the entry from the header; the error is the reason to leave the file out.
    pub(super) fn of(path: &Path, file: &str, header: Header) -> Result<Self, String> {
        let (channels, left_out) = channels(file, &header);
        if channels.is_empty() {
            let columns = header.columns.join(", ");
            let why: Vec<String> = left_out
                .iter()
                .filter(|(_, why)| *why != NO_QUANTITY)
                .map(|(name, why)| format!("; {}: {why}", quoted(name)))
                .collect();
            return Err(format!(
                "no name of its columns ({columns}) says what it measures{}",
                why.concat()
            ));
        }
        let clock = clock(path, &header);
        let unit = channels
            .iter()
            .find(|channel| channel.quantity == Quantity::Acceleration)
            .and_then(|channel| channel.unit);
        let gravity = by_gravity(path, &header, &channels, unit);
        Ok(Self {
            file: file.to_owned(),
            header,
            channels,
            left_out,
            clock,
            accelerated: gravity.filter(|_| unit.is_none()),
            shows_gravity: gravity.is_some(),
        })
    }

    /// Why its rows are too few for a recording, by a clock that says its unit.
    pub(super) fn slow(&self, folder: &Path) -> Option<String> {
        let (column, unit, false) = self.clock? else {
            return None;
        };
        let period = clock_period(&folder.join(&self.file), column)?;
        let (_, unit_s) = TIME_UNITS.iter().find(|(name, _)| *name == unit)?;
        let (rate_hz, least_hz) = (1.0 / (period * unit_s), RATES_HZ.0);
        let name = quoted(&self.header.columns[column]);
        (rate_hz < least_hz).then(|| {
            format!("its clock {name} gives {rate_hz:.3} rows a second, and a recording has {least_hz} at least")
        })
    }

    /// The column of a clock or channel as a description names it: by its number where the file has no names, or one
    /// of them twice.
    fn column(&self, index: usize) -> String {
        let name = &self.header.columns[index];
        let count = self.header.columns.iter().filter(|other| *other == name);
        if self.header.named && count.count() == 1 {
            quoted(name)
        } else {
            index.to_string()
        }
    }

    pub(super) fn write(&self, text: &mut String) {
        let (header, file) = (&self.header, quoted(&self.file));
        if self.channels.is_empty() {
            let whys: Vec<&str> = self.left_out.iter().map(|(_, why)| why.as_str()).collect();
            let why = whys.iter().find(|why| **why != NO_QUANTITY).unwrap_or(&"");
            let _ = writeln!(text, "\n# {file} is left out: {why}");
            return;
        }
        let _ = writeln!(text, "\n[[file]]\npath = {file}");
        match (self.clock, header.rate_hz) {
            (Some((column, unit, guessed)), _) => {
                let why = if guessed {
                    "  # by its steps; the header names no unit"
                } else {
                    ""
                };
                let _ = writeln!(
                    text,
                    "clock = {}\nclock_unit = \"{unit}\"{why}",
                    self.column(column)
                );
            }
            (None, Some(rate_hz)) => {
                let _ = writeln!(text, "rate_hz = {rate_hz}");
            }
            (None, None) => {
                let why = self.unread_clock();
                let why = why.unwrap_or_else(|| "the file does not say it".to_owned());
                let _ = writeln!(text, "# rate_hz =   # rows a second: {why}, so give it");
            }
        }
        for (name, why) in &self.left_out {
            let _ = writeln!(text, "# column {} is left out: {why}", quoted(name));
        }
        for channel in &self.channels {
            self.write_channel(text, channel);
        }
    }

    fn write_channel(&self, text: &mut String, channel: &Proposed) {
        let (unit, why) = match (channel.unit, self.accelerated, channel.quantity) {
            (Some(unit), ..) => (unit.name, ""),
            (None, Some(unit), Quantity::Acceleration) => {
                (unit, "  # by gravity; the header names no unit")
            }
            (None, _, quantity) => (usual(quantity), "  # a guess: the header names no unit"),
        };
        let place = if self.header.named {
            ""
        } else {
            "  # a guess: the file names no channels"
        };
        let _ = writeln!(
            text,
            "[[file.channel]]\ncolumn = {}\nquantity = \"{}\"\naxis = \"{}\"{place}\nunit = \"{unit}\"{why}",
            self.column(channel.index),
            channel.quantity,
            channel.axis
        );
        if self.header.full_scale {
            let _ = writeln!(text, "scale = 1.0  # {unit} of full scale: look it up");
        }
    }

    /// A clock by its name whose text is no time that is read.
    fn unread_clock(&self) -> Option<String> {
        let header = &self.header;
        (0..header.columns.len()).find_map(|column| {
            let text = header.text(column)?;
            let is_clock = matches!(header.meaning(column), Meaning::Clock(_));
            let name = quoted(&header.columns[column]);
            let text: String = text.chars().take(40).collect();
            is_clock.then(|| {
                format!(
                    "{name} holds {}, which is no time that is read",
                    quoted(&text)
                )
            })
        })
    }
}

const NO_QUANTITY: &str = "its name says no quantity";

/// A text as TOML has it.
pub(super) fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

/// The columns that measure something, and the names of the others with the reason.
fn channels(file: &str, header: &Header) -> (Vec<Proposed>, Vec<(String, String)>) {
    let of_file = of_file(file, header);
    let mut channels: Vec<Proposed> = Vec::new();
    let mut left_out = Vec::new();
    let columns = 0..header.columns.len();
    let meanings: Vec<Meaning> = columns.map(|column| header.meaning(column)).collect();
    // Beside accelerations and forces that are named, x, y and z are a position.
    let beside = meanings
        .iter()
        .any(|meaning| matches!(meaning, Meaning::Channel { .. }))
        .then_some(Quantity::Position);
    let klipper = header.columns == KLIPPER;
    for (index, (name, meaning)) in header.columns.iter().zip(&meanings).enumerate() {
        let mut why = NO_QUANTITY.to_owned();
        let found = match *meaning {
            Meaning::Clock(_) => continue,
            Meaning::Channel {
                quantity,
                axis,
                unit,
            } => Some((quantity, axis, unit)),
            Meaning::Bare(axis) => of_file.or(beside).map(|quantity| (quantity, axis, None)),
            Meaning::Unknown if !header.named => {
                let axis = match (header.columns.len(), index) {
                    (2.., 0) => Axis::X,
                    (2.., 1) => Axis::Y,
                    (3, 2) => Axis::Z,
                    _ => Axis::Along,
                };
                of_file
                    .filter(|_| header.columns.len() <= 3)
                    .map(|quantity| (quantity, axis, None))
            }
            Meaning::OtherUnit(quantity) => {
                let units = Unit::all(quantity);
                why = format!("its unit is none of {quantity} ({units}); name one, with a `scale`");
                None
            }
            Meaning::Unknown => None,
        };
        let is_new = |&(quantity, axis, _): &(Quantity, Axis, Option<Unit>)| {
            channels
                .iter()
                .all(|known| (known.quantity, known.axis) != (quantity, axis))
        };
        match found.filter(is_new) {
            Some((quantity, axis, unit)) => channels.push(Proposed {
                name: name.clone(),
                index,
                quantity,
                axis,
                unit: if klipper { Unit::any("mm/s^2") } else { unit },
            }),
            None => left_out.push((name.clone(), why)),
        }
    }
    (channels, left_out)
}

/// Infers the quantity from a word in the file's own name. A WAV without one holds an acceleration.
fn of_file(file: &str, header: &Header) -> Option<Quantity> {
    let stem = file.rsplit_once('.').map_or(file, |(stem, _)| stem);
    let of_name = words(stem).iter().find_map(|word| match word.as_str() {
        "acc" | "accel" | "accelerometer" | "acceleration" | "accelerations" | "vibration"
        | "vibrations" => Some(Quantity::Acceleration),
        "force" | "forces" | "load" | "loads" | "loadcell" => Some(Quantity::Force),
        "torque" | "torques" => Some(Quantity::Torque),
        "pos" | "position" | "positions" | "motion" | "trajectory" | "traject" => {
            Some(Quantity::Position)
        }
        "speed" | "speeds" | "velocity" => Some(Quantity::Speed),
        _ => None,
    });
    let is_wav = !header.named && header.rate_hz.is_some();
    of_name.or(is_wav.then_some(Quantity::Acceleration))
}

fn usual(quantity: Quantity) -> &'static str {
    match quantity {
        Quantity::Acceleration => "m/s^2",
        other => Unit::si(other),
    }
}

/// The clock's column, its unit, and whether that is a guess. A unit that the header does not name is the
/// one in which the rows come at a usual rate; a time as text is in seconds.
fn clock(path: &Path, header: &Header) -> Option<(usize, &'static str, bool)> {
    let clocks: Vec<(usize, Option<&'static str>)> = (0..header.columns.len())
        .filter_map(
            |column| match (header.meaning(column), header.text(column)) {
                (Meaning::Clock(_), Some(_)) => Some((column, Some("s"))),
                (Meaning::Clock(unit), None) => Some((column, unit)),
                _ => None,
            },
        )
        .collect();
    let period = |index| clock_period(path, index).filter(|period| *period > 0.0);
    if let Some((index, unit)) = clocks
        .iter()
        .filter_map(|(index, unit)| Some((*index, (*unit)?)))
        .find(|(index, _)| period(*index).is_some())
    {
        return Some((index, unit, false));
    }
    let (index, period) = clocks
        .iter()
        .find_map(|(index, _)| Some((*index, period(*index)?)))?;
    let off = |unit_s: f64| libm::log(1.0 / (period * unit_s) / USUAL_HZ).abs();
    let (unit, _) = TIME_UNITS
        .into_iter()
        .min_by(|(_, one), (_, other)| off(*one).total_cmp(&off(*other)))?;
    Some((index, unit, true))
}

/// The unit in which the mean of the accelerations that name this unit, or none, is gravity.
fn by_gravity(
    path: &Path,
    header: &Header,
    channels: &[Proposed],
    unit: Option<Unit>,
) -> Option<&'static str> {
    let axes: Vec<usize> = channels
        .iter()
        .filter(|channel| channel.quantity == Quantity::Acceleration && channel.unit == unit)
        .map(|channel| channel.index)
        .collect();
    if axes.len() < 3 || header.full_scale {
        return None;
    }
    let mut columns = vec![Vec::with_capacity(ROWS); axes.len()];
    rows(path, &axes, &mut |_, row| {
        for (column, &axis) in columns.iter_mut().zip(&axes) {
            if row[axis].is_finite() {
                column.push(row[axis]);
            }
        }
        Ok(columns[0].len() < ROWS)
    })
    .ok()?;
    let means = columns.iter().map(|column| mean(column));
    let size = means.map(|x| x * x).sum::<f64>().sqrt();
    let units = [
        ("m/s^2", GRAVITY_M_S2),
        ("g", 1.0),
        ("mg", 1e3),
        ("mm/s^2", 1e3 * GRAVITY_M_S2),
    ];
    let is_near = |gravity: f64| (size / gravity).max(gravity / size) < GRAVITY_TOLERANCE;
    let mut found = units.into_iter().filter(|(_, gravity)| is_near(*gravity));
    let own = |name: &str| unit.is_none_or(|unit| unit.name == name);
    found.find(|(name, _)| own(name)).map(|(unit, _)| unit)
}
