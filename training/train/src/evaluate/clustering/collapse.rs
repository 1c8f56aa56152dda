//! Posterior collapse: information about the inputs in a latent that clusters well.

use super::indices::sums_of_squares;
use crate::{eigen, metrics::active_units};
use asperity::learned::{Latent, description::LATENT};
use asperity_corpus::Instance;
use serde::{Deserialize, Serialize};

/// Deviations of inputs below these count as these: rad, dB, m/s².
const LEAST_DEVIATION: [f64; 3] = [0.01, 0.1, 0.05];

/// Share of the inputs that the latent keeps, and number of directions it uses.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Collapse {
    /// Share of the variance of the LSFs, each on its own scale, that decoding the
    /// posterior mean explains.
    pub lsf_explained: f64,
    /// The same of the levels.
    pub level_explained: f64,
    /// The same of the tap samples.
    pub taps_explained: f64,
    /// Units whose posterior mean varies by more than 0.01.
    pub active_units: usize,
    /// exp of the entropy of the covariance's eigenvalues (Roy and Vetterli, 2007).
    pub effective_rank: f64,
    /// (Σλ)²/Σλ² of the same.
    pub participation: f64,
    /// Variance of materials' means over the total variance.
    pub between_share: f64,
}

impl Collapse {
    pub(super) fn of(
        instances: &[&Instance],
        decoded: &[&Instance],
        latents: &[Latent],
        labels: &[usize],
    ) -> Self {
        let explained = |least: f64, values: fn(&Instance) -> &[f32]| {
            let truth: Vec<&[f32]> = instances.iter().map(|i| values(i)).collect();
            let said: Vec<&[f32]> = decoded.iter().map(|i| values(i)).collect();
            explained(&truth, &said, least)
        };
        let [lsf, level, taps] = LEAST_DEVIATION;
        let covariance = covariance(latents);
        let eigenvalues = eigen::symmetric(covariance, LATENT);
        let values: Vec<f64> = eigenvalues.iter().map(|pair| pair.0.max(0.0)).collect();
        let total: f64 = values.iter().sum();
        let square: f64 = values.iter().map(|x| x * x).sum();
        let shares = values.iter().map(|x| x / total).filter(|p| *p > 0.0);
        let entropy: f64 = -shares.map(|p| p * libm::log(p)).sum::<f64>();
        let (within, between) = sums_of_squares(latents, labels);
        let varies = total > 0.0;
        Self {
            lsf_explained: explained(lsf, |i| i.lsf_rad.as_flattened()),
            level_explained: explained(level, |i| &i.level_db),
            taps_explained: explained(taps, |i| i.taps_m_s2.as_flattened()),
            active_units: active_units(latents),
            effective_rank: if varies { libm::exp(entropy) } else { 0.0 },
            participation: if varies { total * total / square } else { 0.0 },
            between_share: if varies {
                between / (within + between)
            } else {
                0.0
            },
        }
    }
}

/// 1 − residual/total, summed over columns that are each scaled by their deviation.
fn explained(truth: &[&[f32]], said: &[&[f32]], least: f64) -> f64 {
    let columns = truth.first().map_or(0, |row| row.len());
    let rows = truth.len() as f64;
    let (mut residual, mut total) = (0.0, 0.0);
    for column in 0..columns {
        let mean = truth.iter().map(|row| f64::from(row[column])).sum::<f64>() / rows;
        let (mut off, mut spread) = (0.0, 0.0);
        for (x, y) in truth.iter().zip(said) {
            let (x, y) = (f64::from(x[column]), f64::from(y[column]));
            off += (x - y) * (x - y);
            spread += (x - mean) * (x - mean);
        }
        let scale = (spread / rows).max(least * least);
        residual += off / scale;
        total += spread / scale;
    }
    if total > 0.0 {
        1.0 - residual / total
    } else {
        0.0
    }
}

/// Row by row, over the number of latents.
fn covariance(latents: &[Latent]) -> Vec<f64> {
    let count = latents.len().max(1) as f64;
    let mean: Vec<f64> = (0..LATENT)
        .map(|unit| latents.iter().map(|z| f64::from(z[unit])).sum::<f64>() / count)
        .collect();
    let mut sums = vec![0.0; LATENT * LATENT];
    for z in latents {
        for i in 0..LATENT {
            let x = f64::from(z[i]) - mean[i];
            for j in 0..LATENT {
                sums[i * LATENT + j] += x * (f64::from(z[j]) - mean[j]);
            }
        }
    }
    sums.iter_mut().for_each(|sum| *sum /= count);
    sums
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::synthetic;

    #[test]
    fn a_latent_of_two_even_directions_has_rank_two() {
        let corpus = synthetic::corpus(2, 2);
        let instances: Vec<&Instance> =
            corpus.materials.iter().flat_map(|m| &m.instances).collect();
        let mut latents = vec![[0.0; LATENT]; 4];
        for (row, [x, y]) in [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]]
            .into_iter()
            .enumerate()
        {
            (latents[row][3], latents[row][9]) = (x, y);
        }
        let collapse = Collapse::of(&instances, &instances, &latents, &[0, 0, 1, 1]);
        assert_eq!(collapse.active_units, 2);
        assert!((collapse.effective_rank - 2.0).abs() < 1e-9);
        assert!((collapse.participation - 2.0).abs() < 1e-9);
        assert!((collapse.between_share - 0.5).abs() < 1e-9);
        assert_eq!(collapse.lsf_explained, 1.0);
    }

    #[test]
    fn the_mean_explains_nothing() {
        let rows: [&[f32]; 3] = [&[1.0, 0.0], &[2.0, 5.0], &[3.0, 10.0]];
        let mean: [&[f32]; 3] = [&[2.0, 5.0]; 3];
        assert!(explained(&rows, &mean, 0.01).abs() < 1e-12);
    }
}
