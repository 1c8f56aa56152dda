//! Taps: impacts, the speed of each, and a mean transient for each speed.
//!
//! The load before it is smoothed tells when the tool lands. Near that, the acceleration is the
//! transient on top of what the hand does (see the module `baseline`), and the transient begins where
//! it leaves the noise. The speed is that of the height just before, or that of the integrated
//! acceleration (see the module `speed`).

mod group;
mod speed;
mod trace;

pub use group::transients;

use crate::{
    description::{Axis, Quantity},
    reader::Recording,
    signal::{
        quantile::{RMS_OF_MEDIAN, median},
        resample::Clock,
    },
    timeline::Timeline,
};
use serde::Serialize;

/// Rate of the transients, Hz.
pub const TAP_RATE_HZ: f64 = 10_000.0;
/// Samples of a transient, 10 ms.
pub const TAP_SAMPLES: usize = 100;
/// Slowest and fastest impact, m/s.
const SPEEDS_M_S: (f64, f64) = (0.02, 2.0);

/// An impact.
#[derive(Debug, Clone, PartialEq)]
pub struct Impact {
    /// When, s.
    pub at_s: f64,
    /// Speed towards the surface, m/s: by the height, or integrated where no height was recorded.
    pub speed_m_s: f64,
    /// The same by the integrated acceleration along z, m/s, where that can be told.
    pub integrated_m_s: Option<f64>,
    /// Acceleration from the onset, m/s², at [`TAP_RATE_HZ`].
    pub accel_m_s2: Vec<f64>,
}

/// Where impact speeds come from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SpeedSource {
    /// `position` or `acceleration`.
    pub source: &'static str,
    /// Impacts whose speed both tell.
    pub by_both: usize,
    /// Median over these of the integrated speed over that of the position, less one.
    pub integrated_over_position: Option<f64>,
    /// Median size of the same.
    pub apart: Option<f64>,
}

impl SpeedSource {
    /// That of the impacts of a timeline.
    #[must_use]
    pub fn new(timeline: &Timeline, impacts: &[Impact]) -> Self {
        let has_height = timeline.height_m.is_some();
        let ratios: Vec<f64> = impacts
            .iter()
            .filter(|_| has_height)
            .filter_map(|impact| Some(impact.integrated_m_s? / impact.speed_m_s - 1.0))
            .collect();
        let of_some = |value: f64| (!ratios.is_empty()).then_some(value);
        Self {
            source: if has_height {
                "position"
            } else {
                "acceleration"
            },
            by_both: ratios.len(),
            integrated_over_position: of_some(median(ratios.iter().copied())),
            apart: of_some(median(ratios.iter().map(|x| x.abs()))),
        }
    }
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
    let normal = recording
        .channels
        .iter()
        .filter(|c| c.quantity == Quantity::Acceleration)
        .position(|c| c.axis == Axis::Z)
        .and_then(|axis| timeline.accel_m_s2.get(axis));
    let touches = touches(timeline);
    let Some(channel) = accel(Axis::Z).or_else(|| accel(Axis::Along)) else {
        return Vec::new();
    };
    let own = Clock {
        start_s: channel.clock.start_s - late_s,
        ..channel.clock
    };
    landings(timeline, &touches)
        .into_iter()
        .filter_map(|sample| {
            let landing_s = timeline.clock.time_s(sample as f64);
            let trace = trace::trace(&channel.samples, own, landing_s)?;
            let integrated_m_s = normal.and_then(|accel_m_s2| {
                speed::by_acceleration(accel_m_s2, &touches, sample, trace.at_s, timeline)
            });
            let speed_m_s = match timeline.height_m {
                Some(_) => speed::by_height(timeline, trace.at_s),
                None => integrated_m_s,
            }?;
            (SPEEDS_M_S.0..SPEEDS_M_S.1)
                .contains(&speed_m_s)
                .then_some(Impact {
                    at_s: trace.at_s,
                    speed_m_s,
                    integrated_m_s,
                    accel_m_s2: trace.accel_m_s2,
                })
        })
        .collect()
}

// When the tool lands: the load before it is smoothed.

/// Time in the air before an impact, samples of the timeline.
const IN_AIR: usize = 40;
/// Least load of a landing, N, and the same as a multiple of the load's noise in the air.
const LEAST: (f64, f64) = (0.06, 8.0);

/// Per sample: true if the unsmoothed load shows a contact.
pub(crate) fn touches(timeline: &Timeline) -> Vec<bool> {
    let load = &timeline.unsmoothed_load_n;
    let in_air = || {
        load.iter()
            .zip(&timeline.contact)
            .filter(|(_, touches)| !**touches)
            .map(|(load, _)| *load)
    };
    let rest = median(in_air());
    let noise = RMS_OF_MEDIAN * median(in_air().map(|load| (load - rest).abs()));
    let threshold = rest + LEAST.0.max(LEAST.1 * noise);
    load.iter().map(|load| *load > threshold).collect()
}

/// Samples of the timeline at which a contact begins after a time in the air.
fn landings(timeline: &Timeline, touches: &[bool]) -> Vec<usize> {
    let mut air = 0;
    let mut found = Vec::new();
    for (n, touches) in touches.iter().enumerate() {
        if *touches {
            if air >= IN_AIR && timeline.good[n] {
                found.push(n);
            }
            air = 0;
        } else {
            air += 1;
        }
    }
    found
}

#[cfg(test)]
mod tests;
