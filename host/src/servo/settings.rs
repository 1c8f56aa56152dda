//! Settings of a servo loop.

use super::pace::Pace;
use asperity_runtime::math::rounds_to_nearest;
use std::ops::RangeInclusive;
use thiserror::Error;

/// Valid rates of a servo loop, Hz.
pub const RATES_HZ: RangeInclusive<u32> = 250..=10_000;

/// Policy for missed periods.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Overrun {
    /// Missed periods are skipped; the next sample says how many passed. The loop stays in phase.
    #[default]
    Skip,
    /// Missed periods are made up for by back-to-back ticks, at most a tenth of a second; older
    /// ones are skipped.
    CatchUp,
    /// The loop ends: force to zero, device released.
    Stop,
}

impl Overrun {
    /// Every policy.
    pub const ALL: [Self; 3] = [Self::Skip, Self::CatchUp, Self::Stop];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Skip => "skip",
            Self::CatchUp => "catch-up",
            Self::Stop => "stop",
        }
    }
}

/// Settings of a servo loop.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Tick rate, Hz.
    pub rate_hz: u32,
    /// Policy for missed periods.
    pub overrun: Overrun,
    /// Number of periods after which it ends; unlimited without it.
    pub periods: Option<u64>,
    /// When the first tick is due on the loop's clock, ns; a period after the start without it.
    pub start_ns: Option<u64>,
    /// Source of the number of periods between two readings.
    pub pace: Pace,
}

/// Why a loop cannot run.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// A rate outside [`RATES_HZ`].
    #[error("a servo loop runs at 250 to 10000 Hz, not at {0}")]
    Rate(u32),
    /// The renderer is configured for another rate.
    #[error("the renderer is configured for {renderer_hz} Hz, the servo loop for {servo_hz} Hz")]
    OtherRate {
        /// The renderer's.
        renderer_hz: f32,
        /// The loop's.
        servo_hz: u32,
    },
    /// The processor is set to round otherwise than to nearest: forces would have other bits.
    #[error("the processor rounds otherwise than to nearest")]
    Rounding,
}

impl Settings {
    /// A loop at a rate that skips missed periods and runs until it is stopped.
    #[must_use]
    pub fn at(rate_hz: u32) -> Self {
        Self {
            rate_hz,
            overrun: Overrun::Skip,
            periods: None,
            start_ns: None,
            pace: Pace::Clock,
        }
    }

    /// Length of a period, ns, rounded down.
    #[must_use]
    pub fn period_ns(&self) -> u64 {
        super::clock::SECOND_NS / u64::from(self.rate_hz.max(1))
    }

    /// Checks the rate, alone and against that of a renderer, and how this thread rounds, which a
    /// thread that it starts takes over.
    ///
    /// # Errors
    /// [`SettingsError`].
    pub fn check(&self, renderer_hz: f32) -> Result<(), SettingsError> {
        if !rounds_to_nearest() {
            return Err(SettingsError::Rounding);
        }
        if !RATES_HZ.contains(&self.rate_hz) {
            return Err(SettingsError::Rate(self.rate_hz));
        }
        if renderer_hz != self.rate_hz as f32 {
            return Err(SettingsError::OtherRate {
                renderer_hz,
                servo_hz: self.rate_hz,
            });
        }
        Ok(())
    }
}
