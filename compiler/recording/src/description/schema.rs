//! Schema of a description.

use super::quantity::{Quantity, Unit};
use serde::Deserialize;
use std::fmt;

/// Range of rates, Hz.
pub(crate) const RATES_HZ: (f64, f64) = (10.0, 200_000.0);
/// Units of a clock, and the seconds in one.
pub(crate) const TIME_UNITS: [(&str, f64); 4] =
    [("s", 1.0), ("ms", 1e-3), ("us", 1e-6), ("ns", 1e-9)];

/// A recording as its `recording.toml` describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct Description {
    /// Name of the material.
    pub name: String,
    /// The recording device.
    pub device: Option<String>,
    /// The tool.
    pub tool: Tool,
    /// The sensor files.
    pub files: Vec<SensorFile>,
}

/// The tool that touched the surface.
#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Tool {
    /// Name of the tool.
    pub name: Option<String>,
    /// Its moving mass without the hand, kg.
    pub mass_kg: Option<f64>,
}

/// A sensor file: channels that share rows.
#[derive(Debug, Clone, PartialEq)]
pub struct SensorFile {
    /// Name within the folder.
    pub file: String,
    /// Line of its entry in the description.
    pub line: u64,
    /// Rows a second, if there is no clock or to be held against it.
    pub rate_hz: Option<f64>,
    /// The column of the clock.
    pub clock: Option<Column>,
    /// The unit of the clock: s, ms, us or ns.
    pub clock_unit: &'static str,
    /// Seconds in one unit of the clock.
    pub clock_s: f64,
    /// Time of the first row, s, for a file without a clock.
    pub start_s: f64,
    /// The channels.
    pub channels: Vec<Channel>,
}

/// A column of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct Channel {
    /// Which column.
    pub column: Column,
    /// The measured quantity.
    pub quantity: Quantity,
    /// Along which axis.
    pub axis: Axis,
    /// Its unit.
    pub unit: Unit,
    /// Factor to apply before the unit.
    pub scale: f64,
    /// Least and largest value that the sensor can give, in `unit`.
    pub range: Option<[f64; 2]>,
}

impl Channel {
    /// `quantity axis`, for reports.
    #[must_use]
    pub fn label(&self) -> String {
        match self.axis {
            Axis::Along => self.quantity.to_string(),
            axis => format!("{} {axis}", self.quantity),
        }
    }

    /// From the file's number to SI.
    #[must_use]
    pub fn factor(&self) -> f64 {
        self.scale * self.unit.to_si
    }
}

/// A column by its header, or by its number from 0.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(untagged)]
pub enum Column {
    /// From 0.
    Index(usize),
    /// As the header writes it.
    Name(String),
}

impl fmt::Display for Column {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Index(index) => write!(f, "{index}"),
            Self::Name(name) => f.write_str(name),
        }
    }
}

/// Axes of the surface: x and y in its plane, z out of it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Axis {
    /// In the plane.
    X,
    /// In the plane, across x.
    Y,
    /// The surface's normal, outwards.
    Z,
    /// Along the stroke: a speed, a friction force, or the one axis of an accelerometer.
    Along,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::X, Self::Y, Self::Z, Self::Along];

    /// 0, 1, 2 of x, y, z.
    #[must_use]
    pub fn index(self) -> Option<usize> {
        match self {
            Self::X => Some(0),
            Self::Y => Some(1),
            Self::Z => Some(2),
            Self::Along => None,
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::X => "x",
            Self::Y => "y",
            Self::Z => "z",
            Self::Along => "along",
        })
    }
}
