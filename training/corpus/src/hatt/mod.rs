//! A user's own folder of HaTT models as a corpus, after the paper.
//!
//! 1. `source` reads every file and converts every model that vibrates from ARMA to AR(21) under
//!    1 + z⁻¹ (`ar`), with its level.
//! 2. `bins` clusters the measured places of all materials by `kmeans` into the bins of one grid.
//! 3. `pool` holds, for each material and bin, the models that an instance draws from. The
//!    material's own grid interpolates between them (`interpolation`).
//! 4. `tap` synthesises taps from the hardness in our `captions`, since HaTT has none.
//!
//! Models on the border of a material's rectangle are not measured; the source extends them from
//! measured ones. Those at zero speed or zero force are silent and left out. The others serve only
//! as corners of triangles: they are neither clustered nor counted as samples.
//!
//! HaTT's licence forbids redistribution, so a model that is trained on such a corpus stays with
//! whoever trained it.

mod ar;
mod bins;
mod captions;
mod interpolation;
mod kmeans;
mod pool;
mod source;
mod tap;
#[cfg(test)]
mod tests;

pub use crate::error::HattCorpusError;
pub use captions::physical_by_name;

use crate::{
    BINS, Bin, Corpus, CorpusError, Instance, Material,
    augment::{self, Draws},
    generator,
};
use bins::Bins;
use captions::Captioned;
use pool::Pool;
use rayon::prelude::*;
use source::Source;
use std::{collections::BTreeSet, path::PathBuf};

/// Options for loading and augmenting the HaTT.
#[derive(Debug, Clone, PartialEq)]
pub struct HattOptions {
    /// The folder of `Models_<name>.xml`.
    pub folder: PathBuf,
    /// Augmented instances of each material (paper: 20).
    pub instances: usize,
    /// Number of the first instance.
    ///
    /// An instance depends only on the seed and its number. The 20 after the first 20 are therefore
    /// new instances of the same kind, which a model trained on the first 20 has not seen.
    pub first_instance: usize,
    /// Seed of the augmentation; the grid does not depend on it.
    pub seed: u64,
}

/// Loads, converts, clusters and augments a folder. The same files and options give
/// the same corpus, whatever the thread count.
///
/// # Errors
/// [`CorpusError::Hatt`] for a folder or file that is refused, a material without
/// captions, or too few samples; it names the file.
pub fn load(options: &HattOptions) -> Result<Corpus, CorpusError> {
    let sources = source::read(&options.folder)?;
    let described = described(sources)?;
    let bins = clustered(options, &described)?;
    let unaugmented: Vec<(Pool, Instance)> = described
        .par_iter()
        .map(|material| {
            let pool = Pool::of(&material.source.own, &bins);
            let (lsf_rad, level_db) = pool.mean();
            let taps_m_s2 = tap::bank(&material.surface);
            (
                pool,
                Instance {
                    lsf_rad,
                    level_db,
                    taps_m_s2,
                },
            )
        })
        .collect();
    let crc32 = checksum(&described);
    let (pools, prototypes): (Vec<Pool>, Vec<Instance>) = unaugmented.into_iter().unzip();
    let materials = described
        .into_par_iter()
        .enumerate()
        .map(|(index, material)| Material {
            instances: (0..options.instances)
                .map(|number| {
                    let number = options.first_instance + number;
                    let mut draws = Draws::new(options.seed, index, number);
                    let (lsf_rad, level_db) = pools[index].drawn(&mut draws);
                    let taps_m_s2 = prototypes[index].taps_m_s2;
                    let mut instance = Instance {
                        lsf_rad,
                        level_db,
                        taps_m_s2,
                    };
                    augment::mix_taps(&mut instance, &prototypes, index, &mut draws);
                    instance
                })
                .collect(),
            prototype: prototypes[index].clone(),
            name: material.source.name,
            family: material.captioned.family,
            synonyms: Vec::new(),
            training: material.captioned.training,
            held_out: material.captioned.held_out,
            rating: None,
            mu: material.source.mu,
            stiffness_n_m: generator::wall_stiffness_n_m(&material.surface),
        })
        .collect();
    Ok(Corpus {
        name: "hatt".into(),
        licence: "Penn Haptic Texture Toolkit: non-profit research only, no redistribution \
                  (captions: MIT OR Apache-2.0)"
            .into(),
        crc32,
        grid: bins.grid,
        tap_speeds_m_s: generator::tap_speeds_m_s(),
        taps_synthetic: true,
        materials,
    })
}

/// A material with our description of it.
struct Described {
    source: Source,
    captioned: Captioned,
    surface: generator::Physical,
}

fn described(sources: Vec<Source>) -> Result<Vec<Described>, CorpusError> {
    let mut captions = captions::all()?;
    let (mut described, mut unknown) = (Vec::new(), Vec::new());
    for source in sources {
        let found = captions.remove(&source.name).and_then(|captioned| {
            let surface = tap::surface(captioned.hard, &captioned.family, source.mu)?;
            Some((captioned, surface))
        });
        match found {
            Some((captioned, surface)) => {
                described.push(Described {
                    source,
                    captioned,
                    surface,
                });
            }
            None => unknown.push((source.file, source.name)),
        }
    }
    if !unknown.is_empty() {
        return Err(HattCorpusError::NoCaptions { unknown }.into());
    }
    Ok(described)
}

fn clustered(options: &HattOptions, described: &[Described]) -> Result<Bins, HattCorpusError> {
    let samples: Vec<Bin> = described
        .iter()
        .flat_map(|material| material.source.own.samples())
        .map(|model| Bin {
            speed_mm_s: model.speed_mm_s,
            force_n: model.force_n,
        })
        .collect();
    let places: BTreeSet<(u64, u64)> = samples
        .iter()
        .map(|s| (s.speed_mm_s.to_bits(), s.force_n.to_bits()))
        .collect();
    if places.len() < BINS {
        return Err(HattCorpusError::TooFewSamples {
            folder: options.folder.clone(),
            found: places.len(),
        });
    }
    Ok(Bins::of(&samples))
}

/// Checksum over file names, files and captions.
fn checksum(described: &[Described]) -> u32 {
    let crc = crc::Crc::<u32>::new(&crc::CRC_32_ISO_HDLC);
    let mut digest = crc.digest();
    for Described { source, .. } in described {
        digest.update(
            source
                .file
                .file_name()
                .unwrap_or_default()
                .as_encoded_bytes(),
        );
        digest.update(&source.bytes);
    }
    digest.update(captions::EMBEDDED.as_bytes());
    digest.finalize()
}
