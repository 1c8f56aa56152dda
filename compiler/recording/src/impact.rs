//! Taps: impacts, the speed of each, and a mean transient for each speed.

use crate::{
    description::{Axis, Quantity},
    reader::Recording,
    signal::{
        quantile::{mean, median},
        resample::{Clock, resample},
    },
    timeline::{RATE_HZ, Timeline},
};

/// Rate of the transients, Hz.
pub const TAP_RATE_HZ: f64 = 10_000.0;
/// Samples of a transient, 10 ms.
pub const TAP_SAMPLES: usize = 100;
/// Most speeds, each with a transient of its own.
const MOST_SPEEDS: usize = 8;
/// Fewest impacts of a speed.
const FEWEST: usize = 3;
/// Speeds of one group differ by less than this factor.
const GROUP: f64 = 1.35;
/// Time in the air before an impact, samples of the timeline.
const IN_AIR: usize = 40;
/// Slowest and fastest impact, m/s.
const SPEEDS_M_S: (f64, f64) = (0.02, 2.0);
/// Samples of height that give the speed: the last ones before contact.
const SLOPE: usize = 12;
/// Around the contact that the load shows, the transient is looked for, s. The load is low-passed, so
/// it shows contact early.
const SEARCH_S: (f64, f64) = (0.012, 0.035);
/// A transient begins where this part of its peak is reached.
const ONSET: f64 = 0.15;
/// Samples that are cut before the onset.
const LEAD: usize = 2;
/// The end is faded over these samples.
const FADE: usize = 20;
/// An impact is heard this many times above the noise before it.
const ABOVE_NOISE: f64 = 6.0;

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

/// The impacts of a recording, in order of time.
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
    onsets(timeline)
        .into_iter()
        .filter_map(|sample| {
            let at_s = timeline.clock.time_s(sample as f64);
            let around_s = SEARCH_S.0 + 0.02;
            let from = Clock {
                start_s: at_s - around_s,
                rate_hz: TAP_RATE_HZ,
            };
            let count = ((around_s + SEARCH_S.1) * TAP_RATE_HZ) as usize + TAP_SAMPLES + 50;
            let stretch = resample(&channel.samples[..], own, from, count);
            let speed_m_s = speed_by_height(timeline, sample)?;
            if !(SPEEDS_M_S.0..SPEEDS_M_S.1).contains(&speed_m_s) {
                return None;
            }
            let accel_m_s2 = cut(
                &stretch,
                (0.02 * TAP_RATE_HZ) as usize,
                (SEARCH_S.0 + SEARCH_S.1) * TAP_RATE_HZ,
            )?;
            Some(Impact {
                at_s,
                speed_m_s,
                accel_m_s2,
            })
        })
        .collect()
}

/// Samples of the timeline at which contact begins after a time in the air.
fn onsets(timeline: &Timeline) -> Vec<usize> {
    let mut air = 0;
    let mut found = Vec::new();
    for n in 0..timeline.len() {
        if timeline.contact[n] {
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

/// Speed towards the surface by the least-squares slope of the height before contact.
///
/// The load is low-passed, so contact shows a few samples early: the steepest slope nearby counts.
fn speed_by_height(timeline: &Timeline, onset: usize) -> Option<f64> {
    let height = timeline.height_m.as_ref()?;
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
    (onset.saturating_sub(4)..onset + 40)
        .filter_map(slope)
        .reduce(f64::max)
}

/// The transient in a stretch whose first `quiet` samples are before it.
fn cut(stretch: &[f64], quiet: usize, search: f64) -> Option<Vec<f64>> {
    let rest = median(stretch[..quiet].iter().copied());
    let noise = mean(
        &stretch[..quiet]
            .iter()
            .map(|x| (x - rest).powi(2))
            .collect::<Vec<_>>(),
    )
    .sqrt();
    let window = quiet..(quiet + search as usize).min(stretch.len());
    let peak = stretch[window.clone()]
        .iter()
        .map(|x| (x - rest).abs())
        .fold(0.0, f64::max);
    if peak < ABOVE_NOISE * noise.max(1e-9) {
        return None;
    }
    let first = window
        .into_iter()
        .find(|&n| (stretch[n] - rest).abs() > ONSET * peak)?;
    let start = first.checked_sub(LEAD)?;
    let trace = stretch.get(start..start + TAP_SAMPLES)?;
    // What the tool did just before goes on.
    let before = mean(&stretch[start.saturating_sub(20)..start]);
    Some(trace.iter().map(|x| x - before).collect())
}

/// Transients by speed, in ascending order. Impacts of a group are scaled to its mean speed and
/// moved to where they match best.
#[must_use]
pub fn transients(impacts: &[Impact]) -> Vec<Transient> {
    let mut sorted: Vec<&Impact> = impacts.iter().collect();
    sorted.sort_by(|a, b| a.speed_m_s.total_cmp(&b.speed_m_s));
    let mut groups: Vec<Vec<&Impact>> = Vec::new();
    for impact in sorted {
        match groups.last_mut() {
            Some(group) if impact.speed_m_s < GROUP * group[0].speed_m_s => group.push(impact),
            _ => groups.push(vec![impact]),
        }
    }
    groups.retain(|group| group.len() >= FEWEST);
    while groups.len() > MOST_SPEEDS {
        let least = (0..groups.len())
            .min_by_key(|&n| groups[n].len())
            .unwrap_or(0);
        groups.remove(least);
    }
    groups.iter().map(|group| average(group)).collect()
}

fn average(group: &[&Impact]) -> Transient {
    let speed_m_s = mean(
        &group
            .iter()
            .map(|impact| impact.speed_m_s)
            .collect::<Vec<_>>(),
    );
    let scaled: Vec<Vec<f64>> = group
        .iter()
        .map(|impact| {
            impact
                .accel_m_s2
                .iter()
                .map(|a| a * speed_m_s / impact.speed_m_s)
                .collect()
        })
        .collect();
    let mean_of = |traces: &[Vec<f64>]| -> Vec<f64> {
        (0..TAP_SAMPLES)
            .map(|n| traces.iter().map(|t| t[n]).sum::<f64>() / traces.len() as f64)
            .collect()
    };
    let first = mean_of(&scaled);
    let aligned: Vec<Vec<f64>> = scaled
        .iter()
        .map(|trace| moved(trace, best_shift(&first, trace)))
        .collect();
    let mut accel_m_s2 = mean_of(&aligned);
    let power = |t: &[f64]| t.iter().map(|x| x * x).sum::<f64>();
    let apart: f64 = aligned
        .iter()
        .map(|t| {
            t.iter()
                .zip(&accel_m_s2)
                .map(|(a, b)| (a - b).powi(2))
                .sum::<f64>()
        })
        .sum();
    let spread = (apart / group.len() as f64 / power(&accel_m_s2).max(1e-300)).sqrt();
    for (n, a) in accel_m_s2.iter_mut().rev().take(FADE).enumerate() {
        *a *= 0.5 - 0.5 * libm::cos(std::f64::consts::PI * n as f64 / FADE as f64);
    }
    Transient {
        speed_m_s,
        impacts: group.len(),
        accel_m_s2,
        spread,
    }
}

/// The shift within ±5 samples at which a trace matches best.
fn best_shift(reference: &[f64], trace: &[f64]) -> isize {
    let product = |shift: isize| -> f64 {
        moved(trace, shift)
            .iter()
            .zip(reference)
            .map(|(a, b)| a * b)
            .sum()
    };
    (-5..=5)
        .max_by(|&a, &b| product(a).total_cmp(&product(b)))
        .unwrap_or(0)
}

fn moved(trace: &[f64], shift: isize) -> Vec<f64> {
    (0..trace.len() as isize)
        .map(|n| {
            usize::try_from(n + shift)
                .ok()
                .and_then(|n| trace.get(n))
                .copied()
                .unwrap_or(0.0)
        })
        .collect()
}
