//! The resonance of tool and sensor, from taps on the tool in free air, and its inverse.
//!
//! An accelerometer that is glued to a tool, or a tool that bends, is a mass on a spring. From the tip
//! to the sensor it passes acceleration as a low-pass of the second order,
//!
//! ```text
//! H(s) = ω0² / (s² + (ω0/Q) s + ω0²)
//! ```
//!
//! A finger that taps the tool in the air is gone after some milliseconds, and what follows is the free
//! oscillation e^(−ω0 t/2Q) of the same mass and spring. Its frequency and decay are fitted (module
//! `ring`), and the acceleration is divided by H (module `inverse`). Every axis is judged by itself.
//!
//! Assumed: one mode an axis; the same mode in the hand's grip in the air and on the surface; damping
//! across the spring that passes no force, which changes |H| by less than 0.3 dB at ω0 from Q = 4 on.

mod free_tap;
mod inverse;
mod ring;

use crate::{
    channel::Channel,
    description::Quantity,
    reader::Recording,
    signal::{
        quantile::{mean, median},
        resample::{Clock, resample},
    },
    timeline::Timeline,
};
use ring::Ring;
use serde::Serialize;

/// Frequencies of one resonance lie within this part of their median.
const SAME: f64 = 0.04;
/// An axis that rings less than this part of another one only hears it.
const HEARD: f64 = 0.1;

/// Resonances of the tool and its sensor, from taps in free air.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct FreeAir {
    /// Taps on the tool in free air.
    pub taps: usize,
    /// The axes that ring.
    pub resonances: Vec<Resonance>,
}

/// The resonance of one axis of the accelerometer.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Resonance {
    /// The channel, `acceleration z`.
    pub axis: String,
    /// ω0/2π, Hz: median over taps.
    pub freq_hz: f64,
    /// Q, median over taps.
    pub q: f64,
    /// Largest distance of a tap from the median frequency, Hz.
    pub freq_spread_hz: f64,
    /// Largest distance of a tap from the median Q.
    pub q_spread: f64,
    /// Taps that show it.
    pub taps: usize,
}

/// Finds the taps in free air, and the resonances that they show. `late_s` is by how much the
/// acceleration comes after the timeline.
#[must_use]
pub fn find(recording: &Recording, timeline: &Timeline, late_s: f64) -> FreeAir {
    let taps = free_tap::find(timeline);
    let axes: Vec<&Channel> = accelerometer(recording).collect();
    let rings: Vec<Vec<Option<Ring>>> = taps
        .iter()
        .map(|tap_s| {
            let of_axis = |channel: &&Channel| ring::after(channel, late_s, *tap_s);
            let mut of_tap: Vec<Option<Ring>> = axes.iter().map(of_axis).collect();
            let strongest = of_tap
                .iter()
                .flatten()
                .map(|ring| ring.amplitude_m_s2)
                .fold(0.0, f64::max);
            for ring in &mut of_tap {
                ring.take_if(|ring| ring.amplitude_m_s2 < HEARD * strongest);
            }
            of_tap
        })
        .collect();
    let resonances = axes
        .iter()
        .enumerate()
        .filter_map(|(axis, channel)| {
            let of_axis: Vec<Ring> = rings.iter().filter_map(|of_tap| of_tap[axis]).collect();
            resonance(&channel.label, &of_axis, taps.len())
        })
        .collect();
    FreeAir {
        taps: taps.len(),
        resonances,
    }
}

/// Rings of one frequency, of at least half of the taps.
fn resonance(axis: &str, rings: &[Ring], taps: usize) -> Option<Resonance> {
    let middle_hz = median(rings.iter().map(|ring| ring.freq_hz));
    let same: Vec<&Ring> = rings
        .iter()
        .filter(|ring| (ring.freq_hz - middle_hz).abs() <= SAME * middle_hz)
        .collect();
    if same.is_empty() || 2 * same.len() < taps {
        return None;
    }
    let values = |pick: fn(&Ring) -> f64| same.iter().map(move |ring| pick(ring));
    let spread = |pick: fn(&Ring) -> f64, middle: f64| {
        values(pick).map(|x| (x - middle).abs()).fold(0.0, f64::max)
    };
    let (freq_hz, q) = (median(values(|r| r.freq_hz)), median(values(|r| r.q)));
    Some(Resonance {
        axis: axis.to_owned(),
        freq_hz,
        q,
        freq_spread_hz: spread(|r| r.freq_hz, freq_hz),
        q_spread: spread(|r| r.q, q),
        taps: same.len(),
    })
}

/// Divides the axes that ring by their resonance, in the recording and on the timeline. Axes that do
/// not ring keep their bits.
pub fn compensate(
    recording: &mut Recording,
    timeline: &mut Timeline,
    late_s: f64,
    free_air: &FreeAir,
) {
    let axes = recording
        .channels
        .iter_mut()
        .filter(|channel| channel.quantity == Quantity::Acceleration);
    for (axis, channel) in axes.enumerate() {
        let Some(found) = free_air.resonances.iter().find(|r| r.axis == channel.label) else {
            continue;
        };
        let rate_hz = channel.clock.rate_hz;
        channel.samples = inverse::divided(&channel.samples, rate_hz, found.freq_hz, found.q);
        let from = Clock {
            start_s: channel.clock.start_s - late_s,
            rate_hz,
        };
        let samples = resample(&channel.samples, from, timeline.clock, timeline.len());
        let steady = mean(&samples);
        timeline.accel_m_s2[axis] = samples.into_iter().map(|a| a - steady).collect();
        timeline.steady_m_s2[axis] = steady;
    }
}

fn accelerometer(recording: &Recording) -> impl Iterator<Item = &Channel> {
    recording
        .channels
        .iter()
        .filter(|channel| channel.quantity == Quantity::Acceleration)
}

#[cfg(test)]
mod tests;
