//! Stretches of steady speed and load, chosen by test statistics, with the spectra of their vibration.
//!
//! A stretch is as long as speed and load stay near their means, within bounds. What the sensors
//! themselves make is known from the air and reported beside it. What lies below [`FLOOR_HZ`] is
//! motion of the hand, and above [`CEILING_HZ`] the resampling to the timeline removes power: both are
//! filled from the neighbouring band.

use crate::{
    signal::{
        filter::high_pass,
        quantile::{mean, quantile},
        spectrum::hann,
    },
    timeline::{RATE_HZ, Timeline},
};
use realfft::{RealFftPlanner, RealToComplex};
use std::{f64::consts::PI, sync::Arc};

/// Lags of the autocorrelation that a segment keeps.
pub const LAGS: usize = 48;
/// Band in which segments are compared with models, Hz.
pub const BAND_HZ: (f64, f64) = (14.0, 447.0);
/// Frequencies of a segment's spectrum over [`BAND_HZ`].
pub const POINTS: usize = 224;
/// Below it is the hand, Hz.
pub const FLOOR_HZ: f64 = 14.0;
/// Band that fills what lies below, Hz.
const FILL_HZ: (f64, f64) = (14.0, 26.0);
/// Above it the resampling takes power away, Hz, and the window carries the loss down. A model that
/// must follow this edge has fewer poles for the surface.
pub const CEILING_HZ: f64 = 448.0;
/// Band that fills what lies above, Hz.
const FILL_ABOVE_HZ: (f64, f64) = (424.0, 448.0);
/// Cut-off of the high-pass, Hz, and its half length, samples.
const HIGH_PASS: (f64, usize) = (11.0, 400);
/// Shortest and longest stretch, samples.
const LENGTHS: (usize, usize) = (100, 800);
/// Length of a stretch in the air, samples.
const IN_AIR: usize = 250;
/// Speed may differ from the mean by this fraction, or by so many mm/s.
const SPEED_BOUND: (f64, f64) = (0.15, 5.0);
/// The same of the load, N.
const LOAD_BOUND: (f64, f64) = (0.15, 0.08);
/// Slowest stroke, mm/s.
const SLOWEST_MM_S: f64 = 8.0;
/// Time in contact before a stretch, in which a landing rings out, samples.
const SETTLE: usize = 60;
/// Parts of a stretch whose energies are compared.
const PARTS: usize = 4;
/// Order of the filter that whitens before the comparison.
const WHITENER: usize = 10;
/// Bartlett's statistic above which a stretch is not stationary. Its 10⁻⁵ quantile is 25.9; a speed
/// within its bounds adds some.
const LARGEST_STATISTIC: f64 = 34.0;
/// A stretch in the air with more than so many times the power of their lower quartile is no rest.
const LOUD: f64 = 1.3;
/// Length of the transform.
const TRANSFORM: usize = 2048;

/// A stretch of steady speed and load.
#[derive(Debug, Clone, PartialEq)]
pub struct Segment {
    /// First sample of the timeline.
    pub start: usize,
    /// Samples.
    pub length: usize,
    /// Mean speed, mm/s.
    pub speed_mm_s: f64,
    /// Mean load, N.
    pub force_n: f64,
    /// Autocorrelation of the vibration at lags 0..=[`LAGS`], (m/s²)².
    pub lags: Vec<f64>,
    /// Power at [`POINTS`] frequencies, (m/s²)².
    pub power: Vec<f64>,
    /// Bartlett's statistic of the energies of its parts.
    pub statistic: f64,
}

/// What the vibration of a recording is made of.
#[derive(Debug, Clone, Default)]
pub struct Steady {
    /// The segments.
    pub segments: Vec<Segment>,
    /// Autocorrelation of the sensors' noise, from stretches in the air.
    pub noise_lags: Option<Vec<f64>>,
    /// Power of that noise at the frequencies of the segments.
    pub noise_power: Option<Vec<f64>>,
    /// Stretches that were steady in speed and load and not stationary.
    pub rejected: usize,
}

impl Steady {
    /// Time that the segments cover, s.
    #[must_use]
    pub fn covered_s(&self) -> f64 {
        let mut end = 0;
        let mut covered = 0;
        for segment in &self.segments {
            let last = segment.start + segment.length;
            covered += last.saturating_sub(segment.start.max(end));
            end = end.max(last);
        }
        covered as f64 / RATE_HZ
    }
}

/// Frequencies of [`Segment::power`], Hz.
#[must_use]
pub fn frequencies_hz() -> Vec<f64> {
    bins()
        .map(|bin| bin as f64 * RATE_HZ / TRANSFORM as f64)
        .collect()
}

fn bins() -> impl Iterator<Item = usize> {
    let width = RATE_HZ / TRANSFORM as f64;
    let first = (BAND_HZ.0 / width).ceil();
    let step = (BAND_HZ.1 / width - first) / (POINTS - 1) as f64;
    (0..POINTS).map(move |n| (first + n as f64 * step) as usize)
}

/// The vibration of every axis without the motion of the hand.
#[must_use]
pub fn vibration(timeline: &Timeline) -> Vec<Vec<f64>> {
    let (cut_off_hz, half) = HIGH_PASS;
    timeline
        .accel_m_s2
        .iter()
        .map(|axis| high_pass(axis, cut_off_hz / RATE_HZ, half))
        .collect()
}

/// Finds the segments of a recording. `axes` is its [`vibration`].
#[must_use]
pub fn segments(timeline: &Timeline, axes: &[Vec<f64>]) -> Steady {
    let analyser = Analyser::new();
    let mut found = Steady::default();
    for (start, length) in spans(timeline) {
        let (lags, power) = analyser.spectrum(axes, start, length);
        found.segments.push(Segment {
            start,
            length,
            speed_mm_s: mean(&timeline.speed_mm_s[start..start + length]),
            force_n: mean(&timeline.load_n[start..start + length]),
            lags,
            power,
            statistic: 0.0,
        });
    }
    let whitener = whitener(&found.segments);
    for segment in &mut found.segments {
        segment.statistic = bartlett(axes, segment.start, segment.length, &whitener);
    }
    let before = found.segments.len();
    found
        .segments
        .retain(|segment| segment.statistic < LARGEST_STATISTIC && segment.lags[0] > 0.0);
    found.rejected = before - found.segments.len();
    let air: Vec<(Vec<f64>, Vec<f64>)> = in_air(timeline)
        .into_iter()
        .map(|(start, length)| analyser.spectrum(axes, start, length))
        .collect();
    if !air.is_empty() {
        let (lags, power): (Vec<_>, Vec<_>) = at_rest(air).into_iter().unzip();
        found.noise_lags = Some(average(&lags));
        found.noise_power = Some(average(&power));
    }
    found
}

/// Autocorrelation and power of the stretches in which the hand does not knock against the tool. The
/// quietest ones alone would say less noise than there is.
fn at_rest(air: Vec<(Vec<f64>, Vec<f64>)>) -> Vec<(Vec<f64>, Vec<f64>)> {
    let limit = LOUD * quantile(air.iter().map(|(lags, _)| lags[0]), 0.25);
    air.into_iter()
        .filter(|(lags, _)| lags[0] <= limit)
        .collect()
}

fn average(rows: &[Vec<f64>]) -> Vec<f64> {
    let length = rows.first().map_or(0, Vec::len);
    (0..length)
        .map(|n| rows.iter().map(|row| row[n]).sum::<f64>() / rows.len() as f64)
        .collect()
}

/// Stretches in which speed and load stay within their bounds; neighbours overlap by half.
fn spans(timeline: &Timeline) -> Vec<(usize, usize)> {
    let (shortest, longest) = LENGTHS;
    let mut spans = Vec::new();
    let mut settled = 0;
    let usable: Vec<bool> = (0..timeline.len())
        .map(|n| {
            settled = if timeline.contact[n] { settled + 1 } else { 0 };
            settled > SETTLE && timeline.good[n] && timeline.speed_mm_s[n] > SLOWEST_MM_S
        })
        .collect();
    let within = |low: f64, high: f64, (fraction, least): (f64, f64)| {
        high - low < (fraction * (high + low)).max(2.0 * least)
    };
    let mut start = 0;
    while start + shortest <= timeline.len() {
        let (mut speeds, mut loads) = ((f64::INFINITY, 0.0_f64), (f64::INFINITY, 0.0_f64));
        let mut length = 0;
        while length < longest && start + length < timeline.len() && usable[start + length] {
            let (speed, load) = (
                timeline.speed_mm_s[start + length],
                timeline.load_n[start + length],
            );
            speeds = (speeds.0.min(speed), speeds.1.max(speed));
            loads = (loads.0.min(load), loads.1.max(load));
            if !within(speeds.0, speeds.1, SPEED_BOUND) || !within(loads.0, loads.1, LOAD_BOUND) {
                break;
            }
            length += 1;
        }
        if length >= shortest {
            spans.push((start, length));
            start += length / 2;
        } else {
            start += 10;
        }
    }
    spans
}

/// Stretches in the air. A hand that taps gives short ones.
fn in_air(timeline: &Timeline) -> Vec<(usize, usize)> {
    let length = IN_AIR;
    let mut found = Vec::new();
    let mut start = 0;
    while start + length <= timeline.len() {
        let blocked = (start..start + length)
            .rev()
            .find(|&n| timeline.contact[n] || !timeline.good[n]);
        match blocked {
            // A tap rings on in the air.
            Some(last) => start = last + 100,
            None => {
                found.push((start, length));
                start += length / 2;
            }
        }
    }
    found
}

/// Transforms stretches of any length up to half of [`TRANSFORM`].
struct Analyser {
    forward: Arc<dyn RealToComplex<f64>>,
}

impl Analyser {
    fn new() -> Self {
        Self {
            forward: RealFftPlanner::new().plan_fft_forward(TRANSFORM),
        }
    }

    /// |X|² of a stretch.
    fn transform(&self, stretch: &[f64]) -> Vec<f64> {
        let mut padded = vec![0.0; TRANSFORM];
        padded[..stretch.len()].copy_from_slice(stretch);
        let mut spectrum = self.forward.make_output_vec();
        // The lengths are those of the plan, so it cannot fail.
        if self.forward.process(&mut padded, &mut spectrum).is_err() {
            return vec![0.0; TRANSFORM / 2 + 1];
        }
        spectrum.iter().map(|x| x.norm_sqr()).collect()
    }

    /// Autocorrelation and power of a stretch, summed over its axes as DFT321 does.
    fn spectrum(&self, axes: &[Vec<f64>], start: usize, length: usize) -> (Vec<f64>, Vec<f64>) {
        let window = hann(length);
        let energy: f64 = window.iter().map(|w| w * w).sum();
        let mut power = vec![0.0; TRANSFORM / 2 + 1];
        for axis in axes {
            let stretch = &axis[start..start + length];
            let level = mean(stretch);
            let tapered: Vec<f64> = stretch
                .iter()
                .zip(&window)
                .map(|(x, w)| (x - level) * w)
                .collect();
            for (sum, p) in power.iter_mut().zip(self.transform(&tapered)) {
                *sum += p / energy;
            }
        }
        let bin = |freq_hz: f64| (freq_hz * TRANSFORM as f64 / RATE_HZ) as usize;
        let fill = mean(&power[bin(FILL_HZ.0)..bin(FILL_HZ.1)]);
        power[..bin(FLOOR_HZ)].fill(fill);
        let fill = mean(&power[bin(FILL_ABOVE_HZ.0)..bin(FILL_ABOVE_HZ.1)]);
        power[bin(CEILING_HZ)..].fill(fill);
        // The autocorrelation of the window, by which that of the stretch is too small.
        let of_window = lags(&self.transform(&window));
        let lags = lags(&power)
            .into_iter()
            .zip(of_window)
            .map(|(r, w)| r * energy / w)
            .collect();
        (lags, bins().map(|bin| power[bin]).collect())
    }
}

/// The inverse transform of a power spectrum at the first lags.
fn lags(power: &[f64]) -> Vec<f64> {
    let last = power.len() - 1;
    (0..=LAGS)
        .map(|lag| {
            let step = lag as f64 * PI / last as f64;
            let twice = 2.0 * libm::cos(step);
            // cos(n·step) by Chebyshev's recurrence.
            let (mut before, mut now) = (libm::cos(step), 1.0);
            let mut sum = 0.0;
            for (n, p) in power.iter().enumerate() {
                let weight = if n == 0 || n == last { 1.0 } else { 2.0 };
                sum += weight * p * now;
                (before, now) = (now, twice * now - before);
            }
            sum / (2 * last) as f64
        })
        .collect()
}

/// A filter that makes the mean spectrum of all segments flat.
fn whitener(segments: &[Segment]) -> Vec<f64> {
    let mut mean = vec![0.0; WHITENER + 1];
    for segment in segments.iter().filter(|segment| segment.lags[0] > 0.0) {
        for (sum, r) in mean.iter_mut().zip(&segment.lags) {
            *sum += r / segment.lags[0];
        }
    }
    if mean[0] > 0.0 {
        mean[0] *= 1.0 + 1e-6;
        crate::autoregression::levinson(&mean).a
    } else {
        vec![1.0]
    }
}

/// Bartlett's statistic of the energies of the parts of a whitened stretch: χ² with three degrees of
/// freedom for stationary noise.
fn bartlett(axes: &[Vec<f64>], start: usize, length: usize, whitener: &[f64]) -> f64 {
    let part = length / PARTS;
    let energies: Vec<f64> = (0..PARTS)
        .map(|index| {
            let from = start + index * part;
            let energy = |axis: &Vec<f64>| -> f64 {
                (from..from + part)
                    .map(|n| {
                        let e: f64 = whitener
                            .iter()
                            .enumerate()
                            .map(|(k, a)| a * axis[n.saturating_sub(k)])
                            .sum();
                        e * e
                    })
                    .sum()
            };
            axes.iter().map(energy).sum::<f64>() / part as f64
        })
        .collect();
    let pooled = mean(&energies);
    if pooled <= 0.0 {
        return f64::INFINITY;
    }
    let freedom = part as f64;
    let sum: f64 = energies
        .iter()
        .map(|e| libm::log(pooled / e.max(1e-300)))
        .sum();
    let correction = 1.0 + (PARTS as f64 + 1.0) / (3.0 * PARTS as f64 * freedom);
    freedom * sum / correction
}

#[cfg(test)]
#[path = "steady_tests.rs"]
mod laws;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::signal::noise::white;

    #[test]
    fn the_noise_of_the_sensors_is_known_to_two_percent_in_spite_of_knocks() {
        let analyser = Analyser::new();
        let mut axes: Vec<Vec<f64>> = (1..=3).map(|seed| white(seed, 20_000, 12)).collect();
        let exact: f64 = axes
            .iter()
            .map(|axis| axis.iter().map(|x| x * x).sum::<f64>() / axis.len() as f64)
            .sum();
        // Every fifth stretch has a knock.
        for start in (0..20_000).step_by(5 * IN_AIR) {
            for (n, a) in axes[0][start + 100..start + 140].iter_mut().enumerate() {
                *a += 20.0 * libm::sin(n as f64);
            }
        }
        let air: Vec<_> = (0..20_000 / IN_AIR)
            .map(|n| analyser.spectrum(&axes, n * IN_AIR, IN_AIR))
            .collect();
        let all = air.len();
        let rest = at_rest(air);
        assert!(rest.len() > 3 * all / 4, "{} of {all}", rest.len());
        let (lags, power): (Vec<_>, Vec<_>) = rest.into_iter().unzip();
        let (level, flat) = (average(&lags)[0], mean(&average(&power)));
        assert!((level / exact - 1.0).abs() < 0.02, "{level} {exact}");
        assert!((flat / exact - 1.0).abs() < 0.02, "{flat} {exact}");
    }
}
