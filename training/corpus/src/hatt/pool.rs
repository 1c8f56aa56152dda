//! The models that an augmented instance draws from: the entries of a material for every bin.

use super::{
    ar::Sounding,
    bins::Bins,
    interpolation::{Growth, OwnGrid, mixed_lsf},
};
use crate::{BINS, ORDER, augment::Draws};

/// Share by which an entry is moved towards the model that the material's grid interpolates at the centroid, after its
/// level is carried there by the material's own growth. At 1 all entries of a bin would be the same.
const TOWARDS_GRID: f64 = 0.5;

/// A model carried to the centroid of its bin.
#[derive(Debug, Clone, PartialEq)]
struct Entry {
    /// Probability of being drawn; those of a bin sum to one.
    weight: f64,
    lsf_rad: [f64; ORDER],
    level_db: f64,
}

/// The entries of a material by bin; no bin is empty.
#[derive(Debug, Clone)]
pub(super) struct Pool {
    bins: Vec<Vec<Entry>>,
}

/// An entry for each bin: LSFs, rad, and levels, dB re 1 m/s².
pub(super) type Channels = ([[f32; ORDER]; BINS], [f32; BINS]);

impl Pool {
    /// The entries of every bin.
    ///
    /// A bin holds the samples that fall into it, with equal probabilities. A bin without samples
    /// holds the models around its centroid with their barycentric weights as probabilities, so
    /// that their mean is the model interpolated there.
    pub(super) fn of(own: &OwnGrid, bins: &Bins) -> Self {
        let growth = Growth::of(own.samples());
        let mut within: Vec<Vec<&Sounding>> = vec![Vec::new(); BINS];
        for sample in own.samples() {
            within[bins.nearest(sample.speed_mm_s, sample.force_n)].push(sample);
        }
        let entries = |(place, samples): (&crate::Bin, Vec<&Sounding>)| {
            let around = own.around(place.speed_mm_s, place.force_n);
            let grid_rad = mixed_lsf(around.iter().map(|(w, model)| (*w, &model.lsf_rad)));
            let carried = |model: &Sounding| growth.carried(model, place.speed_mm_s, place.force_n);
            let grid_db: f64 = around.iter().map(|(w, model)| w * carried(model)).sum();
            let odds = 1.0 / samples.len().max(1) as f64;
            let drawn = if samples.is_empty() {
                around
            } else {
                samples.into_iter().map(|sample| (odds, sample)).collect()
            };
            drawn
                .into_iter()
                .map(|(weight, model)| Entry {
                    weight,
                    lsf_rad: mixed_lsf([
                        (1.0 - TOWARDS_GRID, &model.lsf_rad),
                        (TOWARDS_GRID, &grid_rad),
                    ]),
                    level_db: (1.0 - TOWARDS_GRID) * carried(model) + TOWARDS_GRID * grid_db,
                })
                .collect()
        };
        Self {
            bins: bins.grid.bins.iter().zip(within).map(entries).collect(),
        }
    }

    /// The mean of every bin: of the LSFs, each at its place in the order, and of levels in dB.
    pub(super) fn mean(&self) -> Channels {
        self.channels(|entries| Entry {
            weight: 1.0,
            lsf_rad: mixed_lsf(entries.iter().map(|entry| (entry.weight, &entry.lsf_rad))),
            level_db: entries
                .iter()
                .map(|entry| entry.weight * entry.level_db)
                .sum(),
        })
    }

    /// Draws an entry for every bin.
    pub(super) fn drawn(&self, draws: &mut Draws) -> Channels {
        self.channels(|entries| {
            let mut left = draws.uniform();
            let chosen = entries.iter().find(|entry| {
                left -= entry.weight;
                left <= 0.0
            });
            chosen.unwrap_or(&entries[entries.len() - 1]).clone()
        })
    }

    /// Binary logarithm of the number of ways to draw.
    #[cfg(test)]
    pub(super) fn bits(&self) -> f64 {
        self.bins
            .iter()
            .map(|entries| libm::log2(entries.len() as f64))
            .sum()
    }

    fn channels(&self, mut of: impl FnMut(&[Entry]) -> Entry) -> Channels {
        let mut lsf_rad = [[0.0; ORDER]; BINS];
        let mut level_db = [0.0; BINS];
        for (bin, entries) in self.bins.iter().enumerate() {
            let entry = of(entries);
            lsf_rad[bin] = entry.lsf_rad.map(|omega| omega as f32);
            level_db[bin] = entry.level_db as f32;
        }
        (lsf_rad, level_db)
    }
}
