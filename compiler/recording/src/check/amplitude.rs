//! Clipping, drop-outs and impossible values of one channel.

use super::verdict::{Finding, Kind, Severity};
use crate::{channel::Channel, description::Quantity};
use std::ops::Range;

/// Plateaus at an extreme that are clipping, and samples on them.
const LEAST_PLATEAUS: (usize, usize) = (3, 8);
/// An extreme nearer to zero than this fraction of the larger one is rest.
const AT_REST: f64 = 0.3;
/// Steps of the converter inside an extreme whose samples are held against those at it.
const INSIDE: f32 = 3.0;
/// Shortest run of one value that is a drop-out, s and samples.
const LEAST_HELD: (f64, f64) = (0.004, 8.0);
/// A step as many times the 99 % quantile of steps ends a drop-out of a slow signal.
const LARGE_STEP: f64 = 4.0;
/// Part of the samples in runs above which a channel is coarse.
const COARSE: f64 = 0.1;

/// What was found, and the bad stretches in samples.
pub(super) fn check(channel: &Channel) -> (Vec<Finding>, Vec<Range<u64>>) {
    let mut findings = Vec::new();
    let mut bad = Vec::new();
    let finding = |kind, what: String, remedy: &str| {
        Finding::of_channel(
            &channel.file,
            &channel.label,
            kind,
            Severity::Fault,
            what,
            remedy,
        )
    };
    let spans = clipped(channel);
    if !spans.is_empty() {
        let samples: u64 = spans.iter().map(|span| span.end - span.start).sum();
        let what = format!(
            "clipping: {samples} samples stand at {:.4} or {:.4}, first at {:.3} s",
            channel.numbers.min,
            channel.numbers.max,
            channel.clock.time_s(spans[0].start as f64)
        );
        findings.push(finding(
            Kind::Clipping,
            what,
            "choose a larger range of the sensor or stroke more gently; the stretches are left out",
        ));
        bad.extend(spans);
    }
    let numbers = &channel.numbers;
    if numbers.missing > 0 {
        let what = format!(
            "drop-outs: {} values are missing, the first in line {}, at most {} in a row",
            numbers.missing,
            numbers.first_missing.unwrap_or(0),
            numbers.longest_missing
        );
        findings.push(finding(
            Kind::DropOut,
            what,
            "look for a loose cable or a full buffer; the stretches are left out",
        ));
    }
    bad.extend(numbers.missing_spans.iter().cloned());
    let held = held(channel);
    if let Some(first) = held.first() {
        let what = format!(
            "drop-outs: one value is held {} times, first for {:.0} ms at {:.3} s",
            held.len(),
            1e3 * (first.end - first.start) as f64 / channel.clock.rate_hz,
            channel.clock.time_s(first.start as f64)
        );
        findings.push(finding(
            Kind::DropOut,
            what,
            "look for a loose cable or a full buffer; the stretches are left out",
        ));
        bad.extend(held);
    }
    let limit = largest(channel.quantity);
    let extreme = numbers.max.abs().max(numbers.min.abs());
    if extreme > limit {
        let what = format!("impossible: a value of {extreme:.4} SI, more than {limit} on any desk");
        findings.push(finding(
            Kind::Impossible,
            what,
            "check unit and scale; a spike in one sample is a loose cable",
        ));
    }
    (findings, bad)
}

/// Largest magnitude that a tool on a desk can show, SI.
fn largest(quantity: Quantity) -> f64 {
    match quantity {
        Quantity::Acceleration => 20_000.0,
        Quantity::Force => 500.0,
        Quantity::Torque => 50.0,
        Quantity::Position => 10.0,
        Quantity::Speed => 10.0,
    }
}

/// Stretches at which the channel stands at its extremes.
fn clipped(channel: &Channel) -> Vec<Range<u64>> {
    if !matches!(channel.quantity, Quantity::Acceleration | Quantity::Force) {
        return Vec::new();
    }
    let (min, max) = (channel.numbers.min, channel.numbers.max);
    let reach = min.abs().max(max.abs());
    let mut all = Vec::new();
    for (extreme, limit) in [
        (max, channel.range.map(|r| r[1])),
        (min, channel.range.map(|r| r[0])),
    ] {
        if extreme.abs() < AT_REST * reach {
            continue;
        }
        let spans = plateaus(&channel.samples, extreme as f32);
        let samples: u64 = spans.iter().map(|span| span.end - span.start).sum();
        let at_limit = limit.is_some_and(|limit| extreme.abs() >= 0.998 * limit.abs());
        if !at_limit && !stands_out(&channel.samples, extreme as f32) {
            continue;
        }
        let (least_spans, least_samples) = LEAST_PLATEAUS;
        if (spans.len() >= least_spans && samples >= least_samples as u64)
            || (at_limit && samples >= 3)
        {
            all.extend(spans);
        }
    }
    all
}

/// Whether an extreme holds more samples than the values just inside it. That of noise over a few steps
/// of a converter does not; that of a signal that is cut off does.
fn stands_out(samples: &[f32], extreme: f32) -> bool {
    let step = samples
        .windows(2)
        .map(|pair| (pair[1] - pair[0]).abs())
        .filter(|step| *step > 0.0)
        .fold(f32::INFINITY, f32::min);
    let within = |steps: f32| {
        samples
            .iter()
            .filter(|x| (**x - extreme).abs() < steps * step)
            .count()
    };
    let (at, near) = (within(0.5), within(INSIDE + 0.5));
    near - at < at
}

/// Stretches of at least two samples at a value.
fn plateaus(samples: &[f32], value: f32) -> Vec<Range<u64>> {
    let mut spans = Vec::new();
    let mut start = None;
    for (index, &x) in samples.iter().enumerate() {
        match (x == value, start) {
            (true, None) => start = Some(index),
            (false, Some(first)) => {
                if index - first >= 2 {
                    spans.push(first as u64..index as u64);
                }
                start = None;
            }
            _ => {}
        }
    }
    spans
}

/// Stretches at which a value is held that should move.
fn held(channel: &Channel) -> Vec<Range<u64>> {
    let numbers = &channel.numbers;
    let (least_s, least_samples) = LEAST_HELD;
    let least = least_samples.max(least_s * channel.clock.rate_hz);
    let coarse = numbers.in_runs as f64 > COARSE * numbers.count as f64;
    let slow = matches!(channel.quantity, Quantity::Position | Quantity::Speed) || coarse;
    let large = LARGE_STEP * numbers.steps.quantile(0.99);
    numbers
        .runs
        .iter()
        .filter(|run| run.length as f64 >= least)
        .filter(|run| {
            slow || (run.value != numbers.min && run.value != numbers.max) || run.value == 0.0
        })
        .filter(|run| !slow || run.jump_after > large)
        .map(|run| run.start..run.start + run.length)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_cut_signal_stands_out_and_noise_over_a_few_steps_does_not() {
        let mut state = 1_u64;
        let noise: Vec<f32> = (0..4000)
            .map(|_| {
                state = state
                    .wrapping_mul(6_364_136_223_846_793_005)
                    .wrapping_add(1_442_695_040_888_963_407);
                // Nine steps of a converter.
                ((state >> 33) % 9) as f32 * 0.01
            })
            .collect();
        assert!(!stands_out(&noise, 0.08) && !stands_out(&noise, 0.0));
        let cut: Vec<f32> = (0..4000)
            .map(|n| {
                let value = libm::sinf(n as f32 * 0.037) + 0.1 * noise[n];
                // A converter of 16 bits.
                (value.clamp(-0.6, 0.6) * 32768.0).round() / 32768.0
            })
            .collect();
        let top = cut.iter().copied().fold(0.0, f32::max);
        assert!(stands_out(&cut, top));
    }
}
