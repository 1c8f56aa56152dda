//! Clipping, drop-outs and impossible values of one channel.

use super::verdict::{Finding, FindingKind, Severity};
use crate::{
    channel::{Channel, Run},
    description::Quantity,
};
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
/// A step as many times the 99 % quantile of steps ends a drop-out of a signal that repeats itself.
const LARGE_STEP: f64 = 4.0;
/// A signal that comes to rest by itself does so in a step of less than this part of its median one.
const SMALL_STEP: f64 = 0.1;
/// A value that is held for this part of all samples is where a channel rests.
const USUAL: f64 = 0.05;
/// A step as many times the 99 % quantile of steps, there and back, is a spike of a motion.
const SPIKE: f64 = 6.0;
/// The same of a force, at least so many N, with so many samples on each side that stay together: what strikes
/// a tool makes it ring.
const FORCE_SPIKE: f64 = 30.0;
const LEAST_SPIKE_N: f64 = 5.0;
const QUIET: usize = 4;
/// Samples on each side of a run that tell how often the sensor repeats itself there.
const AROUND: usize = 250;
/// Runs of a length that chance makes in a whole channel, below which it made none.
const CHANCE: f64 = 0.01;
/// Part of the samples in runs above which a channel is coarse.
const COARSE: f64 = 0.1;

/// Checks the amplitudes of a channel; returns the findings and the bad stretches, in samples.
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
            FindingKind::Clipping,
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
            FindingKind::DropOut,
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
            FindingKind::DropOut,
            what,
            "look for a loose cable or a full buffer; the stretches are left out",
        ));
        bad.extend(held);
    }
    let spikes = match channel.quantity {
        Quantity::Force => force_spikes(channel),
        _ => spikes(channel),
    };
    if let Some(&first) = spikes.first() {
        let what = format!(
            "impossible: {} values far from both neighbours, the first {:.4} SI at {:.3} s",
            spikes.len(),
            channel.samples[first],
            channel.clock.time_s(first as f64)
        );
        findings.push(finding(
            FindingKind::Impossible,
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
            FindingKind::Impossible,
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

/// Forces that jump away from what is quiet before and behind.
fn force_spikes(channel: &Channel) -> Vec<usize> {
    let usual = channel.numbers.steps.quantile(0.99);
    let large = (FORCE_SPIKE * usual).max(LEAST_SPIKE_N) as f32;
    let quiet = (LARGE_STEP * usual) as f32;
    let jumps = |around: &[f32]| {
        let value = around[QUIET];
        let rest = around[..QUIET].iter().chain(&around[QUIET + 1..]);
        let (low, high) = rest.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), x| {
            (low.min(*x), high.max(*x))
        });
        high - low < quiet && (value - high > large || low - value > large)
    };
    let windows = channel.samples.windows(2 * QUIET + 1).enumerate();
    windows
        .filter(|(_, around)| jumps(around))
        .map(|(before, _)| before + QUIET)
        .collect()
}

/// Returns true if a run this long occurs by chance at the rate of repeated samples around it.
fn is_chance(channel: &Channel, run: &Run) -> bool {
    let samples = &channel.samples;
    let (start, end) = (run.start as usize, (run.start + run.length) as usize);
    let before = samples
        .get(start.saturating_sub(AROUND)..start)
        .unwrap_or_default();
    let behind = samples
        .get(end.min(samples.len())..(end + AROUND).min(samples.len()))
        .unwrap_or_default();
    let pairs = || before.windows(2).chain(behind.windows(2));
    let repeated = pairs().filter(|pair| pair[0] == pair[1]).count();
    let share = (repeated as f64 + 1.0) / (pairs().count() as f64 + 2.0);
    channel.numbers.count as f64 * libm::pow(share, run.length as f64 - 1.0) > CHANCE
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

/// Returns true if an extreme holds more samples than the values just inside it: that of a clipped signal does, that of
/// noise over a few steps of a converter, of a sine or of a bit-exact periodic signal does not.
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
///
/// A signal with noise never repeats itself for long, so whatever it holds is a drop-out. A channel that
/// is coarse, or a force that a device renders, repeats itself while nothing moves: it comes to rest or
/// leaves it in steps as small as it makes. There a drop-out is what jumps further than the signal ever
/// does: the value that was held is no longer that of the world.
fn held(channel: &Channel) -> Vec<Range<u64>> {
    let numbers = &channel.numbers;
    let (least_s, least_samples) = LEAST_HELD;
    let least = least_samples.max(least_s * channel.clock.rate_hz);
    let is_long = |run: &&Run| run.length as f64 >= least;
    let long = || numbers.runs.iter().filter(is_long);
    let coarse = numbers.in_runs as f64 > COARSE * numbers.count as f64;
    let small = (SMALL_STEP * numbers.steps.quantile(0.5)).max(1.2 * numbers.steps.quantile(0.001));
    let rests = long()
        .filter(|run| run.jump_before.min(run.jump_after) <= small)
        .count();
    let repeats = matches!(channel.quantity, Quantity::Position | Quantity::Speed)
        || coarse
        || 2 * rests >= long().count();
    let large = LARGE_STEP * numbers.steps.quantile(0.99);
    // Where a channel often is, it may be at rest until something strikes it: a force in the air.
    let is_usual = |run: &Run| {
        let there: u64 = long()
            .filter(|other| other.value == run.value)
            .map(|other| other.length)
            .sum();
        run.start == 0 || there as f64 > USUAL * numbers.count as f64
    };
    let is_held = |run: &&Run| {
        if repeats {
            run.jump_after > large && (run.jump_before > large || !is_usual(run))
        } else {
            (run.value == 0.0 || (run.value != numbers.min && run.value != numbers.max))
                && !is_chance(channel, run)
        }
    };
    long()
        .filter(is_held)
        .map(|run| run.start..run.start + run.length)
        .collect()
}

#[cfg(test)]
#[path = "amplitude_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        channel::Numbers,
        description::Axis,
        signal::{noise::white, resample::Clock},
    };

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

    const RATE_HZ: f64 = 1000.0;

    /// A force along z of 8 s.
    fn force(value: impl Fn(usize) -> f64) -> Channel {
        let mut numbers = Numbers::default();
        let samples: Vec<f32> = (0..8000)
            .map(|n| numbers.take(value(n), n as u64) as f32)
            .collect();
        numbers.finish();
        Channel {
            label: "force z".into(),
            file: "force.csv".into(),
            quantity: Quantity::Force,
            axis: Axis::Z,
            range: None,
            clock: Clock {
                start_s: 0.0,
                rate_hz: RATE_HZ,
            },
            samples,
            numbers,
        }
    }

    /// In the air for a second, then two seconds on the surface, in turn. A landing is a step, and a
    /// hand lifts the tool in 20 ms.
    fn load(n: usize) -> f64 {
        let t_s = n as f64 / RATE_HZ;
        let since_s = t_s % 3.0 - 1.0;
        if since_s < 0.0 {
            return 0.0;
        }
        let pressed = 1.2 + 0.5 * libm::sin(5.0 * t_s) + 0.1 * libm::sin(700.0 * t_s);
        pressed * ((2.0 - since_s) / 0.02).min(1.0)
    }

    /// Held at a value from one sample of some tens of milliseconds on.
    fn stuck(signal: &[f64], at: impl Fn(f64) -> f64) -> Vec<f64> {
        let mut signal = signal.to_vec();
        for start in [1700, 4300, 4900] {
            let value = at(signal[start]);
            signal[start..start + 60].fill(value);
        }
        signal
    }

    #[test]
    fn a_noisy_sensor_that_repeats_itself_is_stuck() {
        let noise = white(3, 8000, 12);
        for level in [0.0, 1.0] {
            let sensor: Vec<f64> = (0..8000)
                .map(|n| level * load(n) + 0.005 * noise[n])
                .collect();
            assert!(held(&force(|n| sensor[n])).is_empty());
            for values in [stuck(&sensor, |x| x), stuck(&sensor, |_| 0.0)] {
                assert_eq!(held(&force(|n| values[n])).len(), 3, "{level}");
            }
        }
    }

    #[test]
    fn a_coarse_sensor_may_repeat_itself_and_may_not_stand_still_while_the_load_goes_on() {
        let noise = white(4, 8000, 12);
        // From a step as small as the noise to one in which a stroke is hardly seen.
        for step in [0.005, 0.02, 0.1] {
            let round = |x: f64| (x / step).round() * step;
            let sensor: Vec<f64> = (0..8000)
                .map(|n| round(load(n) + 0.003 * noise[n]))
                .collect();
            assert!(held(&force(|n| sensor[n])).is_empty(), "{step}");
            // A cable that is loose while the tool presses.
            let values = stuck(&sensor, |_| -0.5);
            assert_eq!(held(&force(|n| values[n])).len(), 3, "{step}");
        }
    }

    #[test]
    fn a_rendered_force_rests_in_the_air_and_where_the_tool_does_not_sink() {
        // A depth in steps of a count, vibration while the tool moves, and neither in the air.
        let rendered = |n: usize| {
            let t_s = n as f64 / RATE_HZ;
            let moves = libm::sin(0.9 * t_s) > 0.2;
            let depth = ((2.0 * libm::sin(1.3 * t_s) - 0.4) / 0.03).round() * 0.03;
            let vibration = if moves {
                0.05 * libm::sin(411.0 * t_s)
            } else {
                0.0
            };
            if depth > 0.0 { depth + vibration } else { 0.0 }
        };
        assert!(held(&force(rendered)).is_empty());
        // Frozen while it presses, 0.4 N from where it goes on.
        let frozen = |n: usize| match n {
            700..900 => 2.9,
            _ => rendered(n),
        };
        let found = held(&force(frozen));
        assert_eq!((found.len(), found.first()), (1, Some(&(700..900))));
    }
}
