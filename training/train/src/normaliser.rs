//! Between physical units and what the network sees; and the bounds of what it says.

use crate::{
    coding,
    config::{Coding, Normalisation},
    error::FitError,
};
use asperity_corpus::{BINS, Corpus, Instance, ORDER, TAP_SAMPLES, TAPS};

/// LSFs of an instance.
pub(crate) const LSFS: usize = BINS * ORDER;
/// AR inputs of the network: [`LSFS`], then the coded excitation of every bin.
pub(crate) const AR: usize = LSFS + BINS;
/// Tap inputs of the network: traces one after the other.
pub(crate) const TAP_VALUES: usize = TAPS * TAP_SAMPLES;

/// Neighbouring LSFs, zero and π included, are at least this far apart after decoding,
/// rad: poles then stay off the unit circle.
pub(crate) const MIN_GAP_RAD: f32 = 0.012;
/// Levels may exceed those of the corpus by this, dB.
const LEVEL_MARGIN_DB: f32 = 6.0;
/// Tap samples may exceed those of the corpus by this factor.
const TAP_MARGIN: f32 = 1.25;
/// Smallest deviation of an LSF, rad: one that hardly moves must not drown the others.
const MIN_LSF_DEVIATION: f32 = 0.01;
/// The same of excitations and tap samples, as a share of their range in the corpus.
const MIN_SHARE: f32 = 1e-3;

/// Means, deviations and bounds, all from the training instances.
///
/// `AR` values lie LSFs first, bin by bin, then one excitation a bin; taps trace by
/// trace.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Normaliser {
    /// Coding of the excitation, and grouping of the values that share a deviation.
    pub(crate) coding: Coding,
    /// Mean of the `AR` values.
    pub(crate) ar_mean: Vec<f32>,
    /// Deviation of the `AR` values.
    pub(crate) ar_deviation: Vec<f32>,
    /// Mean of the tap samples, m/s².
    pub(crate) tap_mean: Vec<f32>,
    /// Deviation of the tap samples, m/s².
    pub(crate) tap_deviation: Vec<f32>,
    /// Smallest and largest excitation that is decoded, coded.
    pub(crate) excitation_bounds: (f32, f32),
    /// Smallest and largest level that is decoded, dB.
    pub(crate) level_bounds_db: (f32, f32),
    /// Largest tap sample that is decoded, m/s².
    pub(crate) tap_bound: Vec<f32>,
    /// Mean share of π of the 22 gaps between LSFs, bin by bin: where the decoder starts.
    pub(crate) gaps: Vec<f32>,
}

/// Instances in the order of the network, not yet normalised.
#[derive(Debug, Clone)]
pub(crate) struct Coded {
    /// Instances × [`AR`].
    pub(crate) ar: Vec<f32>,
    /// Instances × [`TAP_VALUES`].
    pub(crate) taps: Vec<f32>,
}

impl Coded {
    /// Codes instances.
    pub(crate) fn of<'a>(coding: Coding, instances: impl Iterator<Item = &'a Instance>) -> Self {
        let mut coded = Self {
            ar: Vec::new(),
            taps: Vec::new(),
        };
        for instance in instances {
            coded.ar.extend(instance.lsf_rad.iter().flatten());
            for (lsf_rad, &level_db) in instance.lsf_rad.iter().zip(&instance.level_db) {
                coded
                    .ar
                    .push(coding::encode(coding.excitation, lsf_rad, level_db));
            }
            coded.taps.extend(instance.taps_m_s2.iter().flatten());
        }
        coded
    }

    /// Number of instances.
    pub(crate) fn len(&self) -> usize {
        self.ar.len() / AR
    }
}

/// Refuses a corpus the network cannot be trained on.
pub(crate) fn check(corpus: &Corpus, materials: &[usize]) -> Result<(), FitError> {
    if materials.len() < 2 {
        return Err(FitError::TooFewMaterials(materials.len()));
    }
    for &index in materials {
        let material = &corpus.materials[index];
        let fault = |field| FitError::Material {
            name: material.name.clone(),
            field,
        };
        if material.training.is_empty() {
            return Err(fault("training: no caption"));
        }
        if material.instances.is_empty() {
            return Err(fault("instances: none"));
        }
        let all = material.instances.iter().chain([&material.prototype]);
        for instance in all {
            let lsf_rad = instance.lsf_rad.iter();
            if lsf_rad.clone().any(|bin| !is_ordered(bin)) {
                return Err(fault("lsf_rad: not ascending inside (0, π)"));
            }
            if instance.level_db.iter().any(|x| !x.is_finite()) {
                return Err(fault("level_db: not finite"));
            }
            if instance.taps_m_s2.iter().flatten().any(|x| !x.is_finite()) {
                return Err(fault("taps_m_s2: not finite"));
            }
        }
    }
    Ok(())
}

fn is_ordered(lsf_rad: &[f32; ORDER]) -> bool {
    lsf_rad[0] > 0.0
        && lsf_rad[ORDER - 1] < std::f32::consts::PI
        && lsf_rad.windows(2).all(|pair| pair[0] < pair[1])
}

impl Normaliser {
    /// The statistics of coded instances, of which there must be one.
    pub(crate) fn of(coding: Coding, coded: &Coded, levels_db: impl Iterator<Item = f32>) -> Self {
        let excitations = coded
            .ar
            .chunks(AR)
            .flat_map(|row| row[LSFS..].iter().copied());
        let (low, high) = range(excitations);
        let (ar_mean, mut ar_deviation) = match coding.normalisation {
            Normalisation::Bin => moments(&coded.ar, AR, |element| element),
            // A channel an LSF index, and one for the excitation.
            Normalisation::Channel => moments(&coded.ar, AR, |element| {
                if element < LSFS {
                    element % ORDER
                } else {
                    ORDER
                }
            }),
        };
        at_least(&mut ar_deviation[..LSFS], MIN_LSF_DEVIATION);
        at_least(
            &mut ar_deviation[LSFS..],
            (MIN_SHARE * (high - low)).max(f32::MIN_POSITIVE),
        );
        let (tap_mean, mut tap_deviation) =
            moments(&coded.taps, TAP_VALUES, |element| element / TAP_SAMPLES);
        let (tap_low, tap_high) = range(coded.taps.iter().copied());
        let least = (MIN_SHARE * (tap_high - tap_low)).max(f32::MIN_POSITIVE);
        at_least(&mut tap_deviation, least);
        let (level_low, level_high) = range(levels_db);
        let tap_bound: Vec<f32> = (0..TAPS)
            .flat_map(|trace| {
                let samples = trace * TAP_SAMPLES..(trace + 1) * TAP_SAMPLES;
                let rows = coded.taps.chunks(TAP_VALUES);
                let peak = rows
                    .flat_map(|row| &row[samples.clone()])
                    .fold(0.0_f32, |peak, x| peak.max(x.abs()));
                [TAP_MARGIN * peak.max(least); TAP_SAMPLES]
            })
            .collect();
        Self {
            coding,
            gaps: mean_gaps(&moments(&coded.ar, AR, |element| element).0),
            ar_mean,
            ar_deviation,
            tap_mean,
            tap_deviation,
            excitation_bounds: coding::widen(coding.excitation, low, high, LEVEL_MARGIN_DB),
            level_bounds_db: (level_low - LEVEL_MARGIN_DB, level_high + LEVEL_MARGIN_DB),
            tap_bound,
        }
    }

    /// Brings coded values to mean zero and deviation one, in place.
    pub(crate) fn normalise(&self, coded: &mut Coded) {
        scale(&mut coded.ar, &self.ar_mean, &self.ar_deviation);
        scale(&mut coded.taps, &self.tap_mean, &self.tap_deviation);
    }
}

fn scale(values: &mut [f32], mean: &[f32], deviation: &[f32]) {
    for row in values.chunks_mut(mean.len()) {
        for ((x, mean), deviation) in row.iter_mut().zip(mean).zip(deviation) {
            *x = (*x - mean) / deviation;
        }
    }
}

/// Mean and deviation of every column of `rows`, where columns of the same `group`
/// share them.
fn moments(values: &[f32], columns: usize, group: impl Fn(usize) -> usize) -> (Vec<f32>, Vec<f32>) {
    let groups: Vec<usize> = (0..columns).map(group).collect();
    let size = groups.iter().max().map_or(0, |most| most + 1);
    let (mut count, mut sum, mut square) = (vec![0.0; size], vec![0.0; size], vec![0.0; size]);
    for row in values.chunks(columns) {
        for (&x, &group) in row.iter().zip(&groups) {
            count[group] += 1.0;
            sum[group] += f64::from(x);
        }
    }
    let mean: Vec<f64> = sum
        .iter()
        .zip(&count)
        .map(|(sum, count)| sum / count)
        .collect();
    for row in values.chunks(columns) {
        for (&x, &group) in row.iter().zip(&groups) {
            let away = f64::from(x) - mean[group];
            square[group] += away * away;
        }
    }
    let deviation = |group: usize| libm::sqrt(square[group] / count[group]) as f32;
    (
        groups.iter().map(|&group| mean[group] as f32).collect(),
        groups.iter().map(|&group| deviation(group)).collect(),
    )
}

fn at_least(deviations: &mut [f32], least: f32) {
    deviations.iter_mut().for_each(|x| *x = x.max(least));
}

fn range(values: impl Iterator<Item = f32>) -> (f32, f32) {
    values.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    })
}

fn mean_gaps(ar_mean: &[f32]) -> Vec<f32> {
    let pi = std::f32::consts::PI;
    let mut gaps = Vec::with_capacity(LSFS + BINS);
    for lsf_rad in ar_mean[..LSFS].chunks(ORDER) {
        let mut below = 0.0;
        for &omega in lsf_rad.iter().chain([&pi]) {
            gaps.push((omega - below) / pi);
            below = omega;
        }
    }
    gaps
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{config::Excitation, synthetic};

    fn normaliser(normalisation: Normalisation) -> (Normaliser, Coded) {
        let coding = Coding {
            excitation: Excitation::Level,
            normalisation,
        };
        let corpus = synthetic::corpus(5, 4);
        let instances = || corpus.materials.iter().flat_map(|m| &m.instances);
        let coded = Coded::of(coding, instances());
        let levels = instances().flat_map(|i| i.level_db);
        (Normaliser::of(coding, &coded, levels), coded)
    }

    #[test]
    fn normalised_columns_have_mean_zero_and_deviation_one() {
        let (normaliser, mut coded) = normaliser(Normalisation::Bin);
        normaliser.normalise(&mut coded);
        let (mean, deviation) = moments(&coded.ar, AR, |element| element);
        assert!(mean.iter().all(|x| x.abs() < 1e-4));
        for (deviation, of) in deviation.iter().zip(&normaliser.ar_deviation) {
            // A channel that hardly moves is not blown up.
            let expected = if *of > MIN_LSF_DEVIATION {
                1.0
            } else {
                *deviation
            };
            assert!((deviation - expected).abs() < 1e-2 && *deviation < 1.01);
        }
    }

    #[test]
    fn the_paper_shares_a_mean_among_bins() {
        let (normaliser, _) = normaliser(Normalisation::Channel);
        assert_eq!(normaliser.ar_mean[3], normaliser.ar_mean[3 + ORDER]);
        assert_eq!(normaliser.ar_mean[LSFS], normaliser.ar_mean[LSFS + 7]);
    }

    #[test]
    fn mean_gaps_add_up_to_pi() {
        let (normaliser, _) = normaliser(Normalisation::Bin);
        for bin in normaliser.gaps.chunks(ORDER + 1) {
            assert!((bin.iter().sum::<f32>() - 1.0).abs() < 1e-5);
        }
    }
}
