//! Landing speed of the tool: from its height, or from its acceleration along z.
//!
//! The height's slope is steepest just before the landing. Without a height, the acceleration is
//! integrated from one rest to the next: the tip rests while it presses on the surface, before it is
//! lifted and after it has landed. The mean between the two is gravity and bias, so that the velocity is
//! zero at both. Assumed: z of the accelerometer points out of the surface, and the tool keeps its tilt
//! from one rest to the next. A tilt that changes by 1° in a tool held at 30° changes gravity along z by
//! 0.09 m/s².

use crate::timeline::{RATE_HZ, Timeline};

/// Samples of height that give the speed: the last ones before contact.
const SLOPE: usize = 12;
/// The height's clock may be off by so many samples before and after the onset.
const CLOCK: (usize, usize) = (4, 2);
/// A contact that is interrupted by no more samples goes on.
const BOUNCE: usize = 8;
/// The tip rests so long after it landed, and so long before it leaves, samples, or in the middle of a
/// contact that is shorter.
const RESTS: (usize, usize) = (40, 8);
/// Shortest contact in which it rests, samples.
const SHORTEST: usize = 16;
/// Longest flight from contact to contact, samples. After a longer one, and before the first contact,
/// the flight begins at the stillest stretch of the last second.
const LONGEST: usize = 1500;
/// That stretch begins so long before the landing, samples, and lasts so long.
const STILL: (usize, usize, usize) = (1000, 120, 60);
/// The fastest way down is looked for so long before the landing, samples.
const LANDING: usize = 80;

/// Speed towards the surface by the least-squares slope of the height before an instant, m/s: the
/// steepest of those that the uncertainty of the clock allows.
pub(super) fn by_height(timeline: &Timeline, at_s: f64) -> Option<f64> {
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

/// Speed towards the surface by the integral of the acceleration along z, m/s. `touches` says when the
/// load shows a contact, `landing` when this one begins, `at_s` when the acceleration shows it.
pub(super) fn by_acceleration(
    accel_m_s2: &[f64],
    touches: &[bool],
    landing: usize,
    at_s: f64,
    timeline: &Timeline,
) -> Option<f64> {
    let onset = (timeline.clock.sample(at_s).max(0.0) as usize).min(accel_m_s2.len());
    let (from, to) = (
        rest_before(accel_m_s2, touches, landing.min(onset))?,
        rest_after(touches, landing)?,
    );
    let flight = accel_m_s2.get(from..=to)?;
    // By the trapezoidal rule, as the velocity is.
    let whole: f64 = flight
        .windows(2)
        .map(|pair| 0.5 * (pair[0] + pair[1]))
        .sum();
    let level = whole / (flight.len() - 1) as f64;
    let mut velocity = 0.0;
    let mut fastest = 0.0_f64;
    for (n, pair) in flight.windows(2).enumerate() {
        velocity += (0.5 * (pair[0] + pair[1]) - level) / RATE_HZ;
        let now = from + n + 1;
        if now + LANDING >= onset && now <= onset {
            fastest = fastest.max(-velocity);
        }
    }
    (fastest > 0.0).then_some(fastest)
}

/// When the tip rests after it has landed.
fn rest_after(touches: &[bool], landing: usize) -> Option<usize> {
    let mut last = landing;
    for (n, touches) in touches.iter().enumerate().skip(landing) {
        if *touches {
            last = n;
        } else if n > last + BOUNCE {
            break;
        }
        if n >= landing + 2 * RESTS.0 {
            break;
        }
    }
    (last >= landing + SHORTEST).then_some(landing + ((last - landing) / 2).min(RESTS.0))
}

/// When the tip rested before it left the surface, or was still in the air.
fn rest_before(accel_m_s2: &[f64], touches: &[bool], landing: usize) -> Option<usize> {
    let first = landing.saturating_sub(LONGEST);
    let last = touches.get(first..landing)?.iter().rposition(|t| *t);
    if let Some(last) = last {
        let last = first + last;
        let held = touches[..=last]
            .iter()
            .rev()
            .take(2 * RESTS.1)
            .filter(|t| **t)
            .count();
        if held >= SHORTEST {
            return Some(last - RESTS.1);
        }
    }
    let (from, to, length) = STILL;
    let start = landing.saturating_sub(from);
    let end = landing.checked_sub(to)?;
    let variance = |n: usize| -> f64 {
        let stretch = &accel_m_s2[n..n + length];
        let mean = stretch.iter().sum::<f64>() / length as f64;
        stretch.iter().map(|a| (a - mean).powi(2)).sum()
    };
    (start..end.saturating_sub(length))
        .step_by(5)
        .min_by(|a, b| variance(*a).total_cmp(&variance(*b)))
        .map(|n| n + length / 2)
}

#[cfg(test)]
#[path = "speed_tests.rs"]
mod laws;
