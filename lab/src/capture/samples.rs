//! Samples of a sensor, as its own clock or count times them.

/// Consecutive samples of a sensor.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Samples {
    /// Time of each by the sensor's own clock, s; its number where the sensor has no clock.
    pub own: Vec<f64>,
    /// Values of each, channel by channel, in the units of the channels; NaN for a missing one.
    pub values: Vec<f32>,
}

impl Samples {
    /// Returns the number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.own.len()
    }

    /// Returns true if there are no samples.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.own.is_empty()
    }
}

/// Totals received from a sensor.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Counts {
    /// Samples.
    pub samples: u64,
    /// Lines that are no samples.
    pub bad_lines: u64,
    /// Values that are not finite.
    pub missing: u64,
}
