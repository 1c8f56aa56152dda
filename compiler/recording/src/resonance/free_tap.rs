//! Taps on the tool while it is held in the air.
//!
//! Such a tap begins within a few milliseconds out of rest, which no hand does that moves the tool, and
//! the tool is away from the surface before and after it, which a landing is not.

use crate::{
    impact,
    signal::quantile::{median, quantile},
    timeline::Timeline,
};

/// The tool is away from the surface for so long before and after, samples of the timeline.
const AWAY: usize = 50;
/// Away is so much above the surface, m, if the height was recorded.
const ABOVE_M: f64 = 0.001;
/// A tap is the largest change of acceleration within so many samples.
const APART: usize = 60;
/// Least change of acceleration from sample to sample, m/s², and over its RMS in the air.
const LEAST: (f64, f64) = (1.0, 20.0);
/// Before a tap it rests: over these samples the mean square change is this part of the tap's.
const BEFORE: (usize, usize) = (50, 6);
const AT_REST: f64 = 0.01;
/// Most taps that are looked at: the strongest ones.
const MOST: usize = 16;

/// When the tool was tapped in free air, s, in order of time.
pub(super) fn find(timeline: &Timeline) -> Vec<f64> {
    // The motion of a hand hardly changes within a millisecond.
    let change = |n: usize| -> f64 {
        timeline
            .accel_m_s2
            .iter()
            .map(|axis| (axis[n] - axis[n.saturating_sub(1)]).powi(2))
            .sum()
    };
    let power: Vec<f64> = (0..timeline.len()).map(change).collect();
    let away = away(timeline);
    let rest = median(
        power
            .iter()
            .zip(&away)
            .filter(|(_, away)| **away)
            .map(|(p, _)| *p),
    );
    let least = (LEAST.0 * LEAST.0).max(LEAST.1 * LEAST.1 * rest);
    let is_tap = |&n: &usize| {
        let around = &power[n.saturating_sub(APART)..(n + APART + 1).min(power.len())];
        let before = &power[n.saturating_sub(BEFORE.0)..n.saturating_sub(BEFORE.1)];
        away[n]
            && power[n] >= least
            && around.iter().all(|p| *p <= power[n])
            && !before.is_empty()
            && before.iter().sum::<f64>() <= AT_REST * power[n] * before.len() as f64
    };
    let mut taps: Vec<usize> = (0..power.len()).filter(is_tap).collect();
    taps.sort_by(|a, b| power[*b].total_cmp(&power[*a]));
    taps.truncate(MOST);
    taps.sort_unstable();
    taps.into_iter()
        .map(|n| timeline.clock.time_s(n as f64))
        .collect()
}

/// Per sample: true if the tool is away from the surface around it, by the height; without a height, the force must
/// show no contact at all.
fn away(timeline: &Timeline) -> Vec<bool> {
    let is_near: Vec<bool> = match &timeline.height_m {
        Some(height_m) => {
            let touching = height_m
                .iter()
                .zip(&timeline.contact)
                .filter(|(_, touches)| **touches)
                .map(|(height_m, _)| *height_m);
            let surface_m = quantile(touching, 0.95);
            height_m
                .iter()
                .zip(&timeline.contact)
                .map(|(height_m, touches)| *touches || *height_m < surface_m + ABOVE_M)
                .collect()
        }
        None => impact::touches(timeline)
            .into_iter()
            .zip(&timeline.contact)
            .map(|(shows, touches)| shows || *touches)
            .collect(),
    };
    let mut away = vec![true; timeline.len()];
    for (n, is_good) in timeline.good.iter().enumerate() {
        if is_near[n] || !is_good {
            away[n.saturating_sub(AWAY)..(n + AWAY + 1).min(timeline.len())].fill(false);
        }
    }
    away
}

#[cfg(test)]
#[path = "free_tap_tests.rs"]
mod laws;
