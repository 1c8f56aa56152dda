//! Signatures of textures for comparison: spectra, levels, transients and objective attributes.

use crate::attributes::{self, Layout};
use asperity::signal::{
    level::nyquist_rms,
    lsf,
    spectrum::{ArmaModel, squared_magnitude},
};
use asperity_corpus::{BINS, Instance, SAMPLE_RATE_HZ, TAP_RATE_HZ, TAP_SAMPLES, TAPS};
use serde::{Deserialize, Serialize};
use std::f64::consts::TAU;

/// Band of spectral distances, Hz, at a point a hertz.
const BAND_HZ: (u32, u32) = (10, 450);
/// Third octaves of the transients: centres 100·2^(n/3) Hz, up to 4 kHz.
const TAP_BANDS: usize = 17;
/// Frequencies that the power of a third octave is averaged over.
const TAP_BAND_POINTS: usize = 8;
/// Depth below the strongest third octave of a trace that counts as silence, dB.
const TAP_RANGE_DB: f64 = 50.0;
/// Samples after the first that the initial slope of a transient is fitted to: 0.3 ms.
const RISE_SAMPLES: usize = 3;
/// Slopes below this share of a reference are no slopes.
const LEAST_SLOPE: f64 = 1e-2;

/// Objective attributes, as the compiler defines them for a texture.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Objective {
    /// Level above 40 Hz at 100 mm/s and 1 N, dB re 1 (m/s²)².
    pub(super) rough_db: f64,
    /// Spectral centroid of the same, Hz.
    pub(super) sharp_hz: f64,
    /// Spectral centroid of the fastest trace, Hz.
    pub(super) hard_hz: f64,
    /// Coefficient of kinetic friction; slipperiness is −μ.
    pub(super) mu: f64,
}

impl Objective {
    /// Names of [`values`](Self::values).
    pub(super) const NAMES: [&str; 4] = ["rough_db", "sharp_hz", "hard_hz", "mu"];

    /// In the order of [`NAMES`](Self::NAMES).
    #[must_use]
    pub(super) fn values(&self) -> [f64; 4] {
        [self.rough_db, self.sharp_hz, self.hard_hz, self.mu]
    }

    /// The same on scales on which equal steps are about equally large: dB, and natural
    /// logarithms of Hz and μ.
    #[must_use]
    pub(super) fn even(&self) -> [f64; 4] {
        let log = |x: f64| libm::log(x.max(1e-6));
        [
            self.rough_db,
            log(self.sharp_hz),
            log(self.hard_hz),
            log(self.mu),
        ]
    }
}

/// A texture, ready to be compared.
#[derive(Debug, Clone)]
pub(super) struct Signature {
    /// Power spectrum of each bin over [`BAND_HZ`], dB.
    spectra_db: Vec<f64>,
    level_db: [f32; BINS],
    /// Power of each trace in third octaves.
    taps: Vec<[f64; TAP_BANDS]>,
    /// Initial slope of the transients per impact speed, 1/s².
    slope: f64,
    pub(super) objective: Objective,
}

/// Distance between two textures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Distance {
    /// RMS over 10–450 Hz of the difference of log spectra, its mean taken off, mean
    /// over the bins, dB.
    pub(super) shape_db: f64,
    /// The same with the mean left in.
    pub(super) spectrum_db: f64,
    /// Mean over the bins of the difference of levels, dB.
    pub(super) level_db: f64,
    /// RMS over third octaves of 100–4000 Hz, mean over the traces, dB.
    pub(super) taps_db: f64,
    /// |ln| of the ratio of rate-hardness.
    pub(super) rate_hardness: f64,
}

impl Signature {
    /// Computes the signature of an instance of a layout, with its friction.
    pub(super) fn of(instance: &Instance, layout: &Layout, mu: f64) -> Self {
        let mut spectra_db = Vec::with_capacity(BINS * (BAND_HZ.1 - BAND_HZ.0 + 1) as usize);
        for model in models(instance) {
            let points = BAND_HZ.0..=BAND_HZ.1;
            spectra_db.extend(points.map(|f| decibels(model.power(f64::from(f)))));
        }
        let attributes = attributes::of(instance, layout);
        Self {
            spectra_db,
            level_db: instance.level_db,
            taps: instance.taps_m_s2.iter().map(third_octaves).collect(),
            slope: slope(instance, &layout.speeds_m_s),
            objective: Objective {
                rough_db: attributes.rough_db,
                sharp_hz: attributes.sharp_hz,
                hard_hz: attributes.hard_hz,
                mu,
            },
        }
    }

    /// Returns the distance from `truth`.
    pub(super) fn distance(&self, truth: &Self) -> Distance {
        let points = self.spectra_db.len() / BINS;
        let (mut shape_db, mut spectrum_db, mut level_db) = (0.0, 0.0, 0.0);
        for bin in 0..BINS {
            let range = bin * points..(bin + 1) * points;
            let pairs = self.spectra_db[range.clone()]
                .iter()
                .zip(&truth.spectra_db[range]);
            let differences: Vec<f64> = pairs.map(|(x, y)| x - y).collect();
            let mean = super::statistics::mean(&differences);
            shape_db += root_mean_square(differences.iter().map(|d| d - mean));
            spectrum_db += root_mean_square(differences.iter().copied());
            level_db += f64::from((self.level_db[bin] - truth.level_db[bin]).abs());
        }
        let traces = self.taps.iter().zip(&truth.taps);
        let taps_db: f64 = traces.map(|(x, y)| tap_distance_db(x, y)).sum();
        let bins = BINS as f64;
        let slope = self.slope.max(LEAST_SLOPE * truth.slope);
        Distance {
            shape_db: shape_db / bins,
            spectrum_db: spectrum_db / bins,
            level_db: level_db / bins,
            taps_db: taps_db / TAPS as f64,
            rate_hardness: libm::log(slope / truth.slope).abs(),
        }
    }
}

/// The AR model of every bin, under the numerator 1 + z⁻¹.
fn models(instance: &Instance) -> impl Iterator<Item = ArmaModel> + '_ {
    let bins = instance.lsf_rad.iter().zip(instance.level_db);
    bins.map(|(lsf_rad, level_db)| {
        let lsf_rad = lsf_rad.map(f64::from);
        let level = libm::exp10(f64::from(level_db) / 20.0);
        ArmaModel {
            sample_rate_hz: SAMPLE_RATE_HZ,
            a: lsf::to_polynomial(&lsf_rad),
            b: vec![1.0, 1.0],
            level_m_s2: level / nyquist_rms(&lsf_rad),
        }
    })
}

fn decibels(power: f64) -> f64 {
    10.0 * libm::log10(power.max(f64::MIN_POSITIVE))
}

fn root_mean_square(values: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = values.len().max(1) as f64;
    (values.map(|x| x * x).sum::<f64>() / count).sqrt()
}

fn third_octaves(trace: &[f32; TAP_SAMPLES]) -> [f64; TAP_BANDS] {
    let trace = trace.map(f64::from);
    std::array::from_fn(|band| {
        let total: f64 = (0..TAP_BAND_POINTS)
            .map(|point| {
                let place = (point as f64 + 0.5) / TAP_BAND_POINTS as f64 - 0.5;
                let freq_hz = 100.0 * libm::exp2((band as f64 + place) / 3.0);
                squared_magnitude(&trace, TAU * freq_hz / TAP_RATE_HZ)
            })
            .sum();
        total / TAP_BAND_POINTS as f64
    })
}

fn tap_distance_db(x: &[f64; TAP_BANDS], truth: &[f64; TAP_BANDS]) -> f64 {
    let strongest = truth.iter().copied().fold(0.0, f64::max);
    let floor = strongest * libm::exp10(-TAP_RANGE_DB / 10.0);
    let difference = |(x, y): (&f64, &f64)| decibels(x.max(floor)) - decibels(y.max(floor));
    root_mean_square(x.iter().zip(truth).map(difference))
}

/// Least squares of slope = h·v over the traces, each slope fitted through the first
/// sample: the rate-hardness of Lawrence et al. (2000), of acceleration rather than force.
fn slope(instance: &Instance, speeds_m_s: &[f64; TAPS]) -> f64 {
    let (mut product, mut square) = (0.0, 0.0);
    for (trace, &speed) in instance.taps_m_s2.iter().zip(speeds_m_s) {
        let (mut rise, mut times) = (0.0, 0.0);
        for n in 1..=RISE_SAMPLES {
            let t_s = n as f64 / TAP_RATE_HZ;
            rise += t_s * f64::from(trace[n] - trace[0]);
            times += t_s * t_s;
        }
        product += speed * rise / times;
        square += speed * speed;
    }
    product / square
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    #[test]
    fn a_louder_texture_differs_in_level_alone() {
        let corpus = synthetic::corpus(2, 1);
        let quiet = corpus.materials[0].prototype.clone();
        let mut loud = quiet.clone();
        loud.level_db.iter_mut().for_each(|x| *x += 6.0);
        let layout = Layout::of(&corpus);
        let truth = Signature::of(&quiet, &layout, 0.5);
        let distance = Signature::of(&loud, &layout, 0.5).distance(&truth);
        assert!(distance.shape_db < 1e-4, "{distance:?}");
        assert!((distance.spectrum_db - 6.0).abs() < 1e-4);
        assert!((distance.level_db - 6.0).abs() < 1e-4);
        assert_eq!((distance.taps_db, distance.rate_hardness), (0.0, 0.0));
    }

    #[test]
    fn twice_the_transient_is_six_db_and_twice_the_rate() {
        let corpus = synthetic::corpus(2, 1);
        let soft = corpus.materials[0].prototype.clone();
        let mut strong = soft.clone();
        strong
            .taps_m_s2
            .iter_mut()
            .flatten()
            .for_each(|x| *x *= 2.0);
        let layout = Layout::of(&corpus);
        let truth = Signature::of(&soft, &layout, 0.5);
        let distance = Signature::of(&strong, &layout, 0.5).distance(&truth);
        assert!(
            distance.taps_db > 4.0 && distance.taps_db < 6.03,
            "{distance:?}"
        );
        assert!((distance.rate_hardness - std::f64::consts::LN_2).abs() < 1e-6);
    }
}
