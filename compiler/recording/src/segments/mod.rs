//! Stretches of strokes, chosen by test statistics, with the spectra of their vibration.
//!
//! A steady stretch is as long as speed and load stay near their means, within bounds. Hands that stroke freely
//! hold neither for long. So between steady stretches there are shorter ones in which both may change by
//! more: they count at their mean under the window of the spectrum, which its middle dominates. What the
//! sensors themselves make is known from the air and reported beside it. What lies below [`FLOOR_HZ`] is
//! motion of the hand, and above [`CEILING_HZ`] the resampling to the timeline removes power: both are
//! filled from the neighbouring band.

mod spans;
mod spectra;
mod stationary;

use crate::{
    signal::{
        filter::high_pass,
        quantile::{mean, quantile},
    },
    timeline::{RATE_HZ, Timeline},
};
use spans::{CHANGING, STEADY, in_air, outside, spans, usable};
use spectra::{Analyser, TRANSFORM, mean_under_window};
use stationary::{LARGEST_STATISTIC, Law, PARTS, bartlett, whitener};

/// Lags of the autocorrelation that a segment keeps.
pub const LAGS: usize = 48;
/// Band in which segments are compared with models, Hz.
pub const BAND_HZ: (f64, f64) = (14.0, 447.0);
/// Frequencies of a segment's spectrum over [`BAND_HZ`].
pub const POINTS: usize = 224;
/// Below it is the hand, Hz.
pub const FLOOR_HZ: f64 = 14.0;
/// Above it the resampling takes power away, Hz, and the window carries the loss down. A model that
/// must follow this edge has fewer poles for the surface.
pub const CEILING_HZ: f64 = 448.0;
/// Cut-off of the high-pass, Hz, and its half length, samples.
const HIGH_PASS: (f64, usize) = (11.0, 400);
/// A stretch in the air with more than so many times the power of their lower quartile is no rest.
const LOUD: f64 = 1.3;

/// A stretch of steady speed and load, or a shorter one in which they change.
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
    /// True if speed and load are steady; else their means are those under the window.
    pub is_steady: bool,
    /// Autocorrelation of the vibration at lags 0..=[`LAGS`], (m/s²)².
    pub lags: Vec<f64>,
    /// Power at [`POINTS`] frequencies, (m/s²)².
    pub power: Vec<f64>,
    /// Bartlett's statistic of the energies of its parts.
    pub statistic: f64,
}

/// Stretches of the vibration of a recording.
#[derive(Debug, Clone, Default)]
pub struct Segments {
    /// The segments.
    pub segments: Vec<Segment>,
    /// Autocorrelation of the sensors' noise, from stretches in the air.
    pub noise_lags: Option<Vec<f64>>,
    /// Power of that noise at the frequencies of the segments.
    pub noise_power: Option<Vec<f64>>,
    /// Stretches whose vibration was not as even as their speed and load.
    pub rejected: usize,
}

impl Segments {
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
pub fn segments(timeline: &Timeline, axes: &[Vec<f64>]) -> Segments {
    let analyser = Analyser::new();
    let mut found = Segments::default();
    let usable = usable(timeline);
    let steady = spans(timeline, &usable, STEADY);
    let changing = spans(timeline, &outside(&usable, &steady), CHANGING);
    let kinds = [(&steady, true), (&changing, false)];
    let spans = kinds
        .into_iter()
        .flat_map(|(spans, is_steady)| spans.iter().map(move |span| (*span, is_steady)));
    for ((start, length), is_steady) in spans {
        let (lags, power) = analyser.spectrum(axes, start, length);
        let at = |values: &[f64]| {
            let values = &values[start..start + length];
            if is_steady {
                mean(values)
            } else {
                mean_under_window(values)
            }
        };
        found.segments.push(Segment {
            start,
            length,
            speed_mm_s: at(&timeline.speed_mm_s),
            force_n: at(&timeline.load_n),
            is_steady,
            lags,
            power,
            statistic: 0.0,
        });
    }
    found.segments.sort_by_key(|segment| segment.start);
    let whitener = whitener(&found.segments);
    let law = Law::of(&found.segments);
    for segment in &mut found.segments {
        let levels = if segment.is_steady {
            [1.0; PARTS]
        } else {
            law.levels(timeline, segment)
        };
        segment.statistic = bartlett(axes, segment.start, segment.length, &whitener, levels);
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

#[cfg(test)]
mod tests;
