//! Clipping, drop-outs and impossible values of one channel.

use super::verdict::{Finding, Kind, Severity};
use crate::{channel::Channel, description::Quantity};
use std::ops::Range;

/// Visits to an extreme that are clipping, and samples of them.
const LEAST_VISITS: (usize, u64) = (2, 3);
/// Samples of a single stretch at an extreme that is clipping.
const LEAST_PLATEAU: u64 = 8;
/// Samples inside an extreme that are held against those at it, and at least so many.
const RIVALS: usize = 4;
const LEAST_RIVALS: usize = 256;
/// An extreme nearer to zero than this fraction of the larger one is rest.
const AT_REST: f64 = 0.3;
/// Steps of the converter inside an extreme whose samples are held against those at it.
const INSIDE: f32 = 3.0;
/// Shortest run of one value that is a drop-out, s and samples.
const LEAST_HELD: (f64, f64) = (0.004, 8.0);
/// A step as many times the 99 % quantile of steps ends a drop-out of a slow signal.
const LARGE_STEP: f64 = 4.0;
/// A step as many times the 99 % quantile of steps, there and back, is a spike of a motion.
const SPIKE: f64 = 6.0;
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
    let spikes = spikes(channel);
    if let Some(&first) = spikes.first() {
        let what = format!(
            "impossible: {} values far from both neighbours, the first {:.4} SI at {:.3} s",
            spikes.len(),
            channel.samples[first],
            channel.clock.time_s(first as f64)
        );
        findings.push(finding(
            Kind::Impossible,
            what,
            "look for a loose cable or an overflow; correct these values in the file",
        ));
        bad.extend(spikes.iter().map(|&n| n as u64..n as u64 + 1));
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

/// Values of a motion that jump away from both neighbours: nothing that a hand holds does.
fn spikes(channel: &Channel) -> Vec<usize> {
    if !matches!(channel.quantity, Quantity::Position | Quantity::Speed) {
        return Vec::new();
    }
    let large = (SPIKE * channel.numbers.steps.quantile(0.99)) as f32;
    let jumps = |triple: &[f32]| {
        let (rise, fall) = (triple[1] - triple[0], triple[1] - triple[2]);
        large > 0.0 && rise.abs() > large && fall.abs() > large && rise * fall > 0.0
    };
    channel
        .samples
        .windows(3)
        .enumerate()
        .filter(|(_, triple)| jumps(triple))
        .map(|(before, _)| before + 1)
        .collect()
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
        let spans = visits(&channel.samples, extreme as f32);
        let samples: u64 = spans.iter().map(|span| span.end - span.start).sum();
        let longest = spans.iter().map(|span| span.end - span.start).max();
        let at_limit = limit.is_some_and(|limit| extreme.abs() >= 0.998 * limit.abs());
        let often = spans.len() >= LEAST_VISITS.0 && samples >= LEAST_VISITS.1
            || longest >= Some(LEAST_PLATEAU);
        let stands_out = || stands_out(&channel.samples, extreme as f32);
        if at_limit && samples >= LEAST_VISITS.1 || often && stands_out() {
            all.extend(spans);
        }
    }
    all
}

/// Whether an extreme holds more samples than the values just inside it. That of noise over a few steps
/// of a converter does not, nor that of a sine, nor that of a period that repeats itself to the bit. That
/// of a signal that is cut off does.
fn stands_out(samples: &[f32], extreme: f32) -> bool {
    // Distances from the extreme, of the samples on its side.
    let mut inside: Vec<f32> = samples
        .iter()
        .map(|x| (x - extreme).abs())
        .filter(|away| *away < 0.5 * extreme.abs())
        .collect();
    let at = inside.iter().filter(|away| **away == 0.0).count();
    let kept = at + (RIVALS * at).max(LEAST_RIVALS);
    if inside.len() > kept {
        inside.select_nth_unstable_by(kept, f32::total_cmp);
        inside.truncate(kept);
    }
    inside.sort_unstable_by(f32::total_cmp);
    let step = inside
        .windows(2)
        .map(|pair| pair[1] - pair[0])
        .filter(|step| *step > 0.0)
        .fold(f32::INFINITY, f32::min);
    let near = inside
        .iter()
        .filter(|away| **away < (INSIDE + 0.5) * step)
        .count()
        - at;
    let repeated = inside[at..]
        .chunk_by(|a, b| a == b)
        .map(<[f32]>::len)
        .max()
        .unwrap_or(0);
    2 * at > 3 * near && at > 2 * repeated
}

/// Stretches at a value, of one sample or more.
fn visits(samples: &[f32], value: f32) -> Vec<Range<u64>> {
    let mut spans: Vec<Range<u64>> = Vec::new();
    for (index, _) in samples.iter().enumerate().filter(|(_, x)| **x == value) {
        let index = index as u64;
        match spans.last_mut() {
            Some(last) if last.end == index => last.end += 1,
            _ => spans.push(index..index + 1),
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
    fn sines_do_not_stand_out() {
        for period in [17.0, 40.0, 83.7] {
            let sine = |n: usize| libm::sin(std::f64::consts::TAU * n as f64 / period) as f32;
            let exact: Vec<f32> = (0..20_000).map(sine).collect();
            // Every period to the bit, and by a converter of 12 bits.
            let again: Vec<f32> = (0..20_000).map(|n| sine(n % 40)).collect();
            let coarse: Vec<f32> = exact.iter().map(|x| (x * 2048.0).round()).collect();
            for signal in [exact, again, coarse] {
                let top = signal.iter().copied().fold(0.0, f32::max);
                assert!(!stands_out(&signal, top), "{period}");
            }
        }
    }

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
