//! Taps: impacts, the speed of each, and a mean transient for each speed.
//!
//! The load before it is smoothed tells when the tool lands. Near that, the acceleration is the
//! transient on top of what the hand does (see the module `baseline`), and the transient begins where
//! it leaves the noise. The speed is the steepest slope of the height just before.

mod baseline;
mod contact;
mod group;
mod trace;

pub use group::transients;

use crate::{
    description::{Axis, Quantity},
    reader::Recording,
    signal::resample::Clock,
    timeline::{RATE_HZ, Timeline},
};

/// Rate of the transients, Hz.
pub const TAP_RATE_HZ: f64 = 10_000.0;
/// Samples of a transient, 10 ms.
pub const TAP_SAMPLES: usize = 100;
/// Slowest and fastest impact, m/s.
const SPEEDS_M_S: (f64, f64) = (0.02, 2.0);
/// Samples of height that give the speed: the last ones before contact.
const SLOPE: usize = 12;
/// The height's clock may be off by so many samples before and after the onset.
const CLOCK: (usize, usize) = (4, 2);

/// One impact.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// When, s.
    pub at_s: f64,
    /// Speed towards the surface, m/s.
    pub speed_m_s: f64,
    /// Acceleration from the onset, m/s², at [`TAP_RATE_HZ`].
    pub accel_m_s2: Vec<f64>,
}

/// A transient for an impact speed.
#[derive(Debug, Clone, PartialEq)]
pub struct Transient {
    /// Mean impact speed, m/s.
    pub speed_m_s: f64,
    /// Impacts that it is the mean of.
    pub impacts: usize,
    /// Mean acceleration, m/s².
    pub accel_m_s2: Vec<f64>,
    /// RMS of the difference between an impact and the mean, relative to the mean.
    pub spread: f64,
}

/// The impacts of a recording, in order of time. `late_s` is by how much the acceleration comes after
/// the timeline.
#[must_use]
pub fn impacts(recording: &Recording, timeline: &Timeline, late_s: f64) -> Vec<Impact> {
    let accel = |axis: Axis| {
        recording
            .channels
            .iter()
            .find(|c| c.quantity == Quantity::Acceleration && c.axis == axis)
    };
    let Some(channel) = accel(Axis::Z).or_else(|| accel(Axis::Along)) else {
        return Vec::new();
    };
    let own = Clock {
        start_s: channel.clock.start_s - late_s,
        ..channel.clock
    };
    contact::landings(timeline)
        .into_iter()
        .filter_map(|sample| {
            let landing_s = timeline.clock.time_s(sample as f64);
            let trace = trace::trace(&channel.samples, own, landing_s)?;
            let speed_m_s = speed_by_height(timeline, trace.at_s)?;
            (SPEEDS_M_S.0..SPEEDS_M_S.1)
                .contains(&speed_m_s)
                .then_some(Impact {
                    at_s: trace.at_s,
                    speed_m_s,
                    accel_m_s2: trace.accel_m_s2,
                })
        })
        .collect()
}

/// Speed towards the surface by the least-squares slope of the height before an instant: the steepest
/// of those that the uncertainty of the clock allows.
fn speed_by_height(timeline: &Timeline, at_s: f64) -> Option<f64> {
    let height = timeline.height_m.as_ref()?;
    let onset = timeline.clock.sample(at_s).max(0.0) as usize;
    let centre = (SLOPE as f64 - 1.0) / 2.0;
    let norm: f64 = (0..SLOPE).map(|k| (k as f64 - centre).powi(2)).sum();
    let slope = |end: usize| -> Option<f64> {
        let start = end.checked_sub(SLOPE)?;
        let stretch = height.get(start..end)?;
        let product: f64 = stretch
            .iter()
            .enumerate()
            .map(|(k, h)| (k as f64 - centre) * h)
            .sum();
        Some(-product / norm * RATE_HZ)
    };
    (onset.saturating_sub(CLOCK.0)..=onset + CLOCK.1)
        .filter_map(slope)
        .reduce(f64::max)
}
