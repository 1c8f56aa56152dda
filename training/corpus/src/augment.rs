//! Augmented instances: the same material at another place of its sheet.

use crate::{Instance, generator::Physical};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;
use serde::{Deserialize, Serialize};

/// Variation between instances of a material: standard deviations of normal draws.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Augmentation {
    /// Wavelength, octaves.
    pub wavelength_octaves: f64,
    /// Height, dB.
    pub height_db: f64,
    /// Modulus, decades.
    pub modulus_decades: f64,
    /// Spread of the height spectrum, relative.
    pub spread: f64,
    /// Level of single bins, dB.
    pub bin_level_db: f64,
    /// Weight of another material's taps (paper: 0.05).
    pub tap_mixing: f64,
}

impl Default for Augmentation {
    fn default() -> Self {
        Self {
            wavelength_octaves: 0.08,
            height_db: 0.6,
            modulus_decades: 0.06,
            spread: 0.06,
            bin_level_db: 0.3,
            tap_mixing: 0.05,
        }
    }
}

/// The instances of material `index`, each made of its varied parameters. `prototypes` are the
/// unaugmented materials, whose taps are mixed in.
#[must_use]
pub fn instances(
    physical: &Physical,
    make: impl Fn(&Physical) -> Instance,
    prototypes: &[Instance],
    index: usize,
    count: usize,
    augmentation: &Augmentation,
    seed: u64,
) -> Vec<Instance> {
    (0..count)
        .map(|number| {
            let mut draws = Draws::new(seed, index, number);
            let varied = Physical {
                wavelength_mm: physical.wavelength_mm
                    * libm::exp2(augmentation.wavelength_octaves * draws.normal()),
                height_um: physical.height_um
                    * libm::exp10(augmentation.height_db * draws.normal() / 20.0),
                modulus_mpa: physical.modulus_mpa
                    * libm::exp10(augmentation.modulus_decades * draws.normal()),
                spread_octaves: physical.spread_octaves
                    * libm::exp(augmentation.spread * draws.normal()),
                ..*physical
            };
            let mut instance = make(&varied);
            for level_db in &mut instance.level_db {
                *level_db += (augmentation.bin_level_db * draws.normal()) as f32;
            }
            mix_taps(
                &mut instance,
                prototypes,
                index,
                augmentation.tap_mixing,
                &mut draws,
            );
            instance
        })
        .collect()
}

/// Mixes in the taps of another material, drawn uniformly, with the weight of the options.
pub(crate) fn mix_taps(
    instance: &mut Instance,
    prototypes: &[Instance],
    index: usize,
    share: f64,
    draws: &mut Draws,
) {
    if prototypes.len() < 2 {
        return;
    }
    let step = 1 + draws.below(prototypes.len() - 1);
    let other = &prototypes[(index + step) % prototypes.len()];
    let share = share as f32;
    for (trace, theirs) in instance.taps_m_s2.iter_mut().zip(&other.taps_m_s2) {
        for (a, b) in trace.iter_mut().zip(theirs) {
            *a = (1.0 - share) * *a + share * b;
        }
    }
}

/// Random draws of one instance, which do not depend on the order of work.
pub(crate) struct Draws(Xoshiro256PlusPlus);

impl Draws {
    pub(crate) fn new(seed: u64, index: usize, number: usize) -> Self {
        let stream = (index as u64) << 32 | number as u64;
        Self(Xoshiro256PlusPlus::seed_from_u64(
            seed ^ stream.wrapping_mul(0x9e37_79b9_7f4a_7c15),
        ))
    }

    /// Uniform in (0, 1).
    pub(crate) fn uniform(&mut self) -> f64 {
        use rand_core::Rng;
        (self.0.next_u64() >> 11) as f64 / (1u64 << 53) as f64 + 0.5 / (1u64 << 53) as f64
    }

    /// An index below `limit`.
    pub(crate) fn below(&mut self, limit: usize) -> usize {
        ((self.uniform() * limit as f64) as usize).min(limit.saturating_sub(1))
    }

    /// Standard normal, by Box and Muller.
    pub(crate) fn normal(&mut self) -> f64 {
        let radius = (-2.0 * libm::log(self.uniform())).sqrt();
        radius * libm::cos(std::f64::consts::TAU * self.uniform())
    }
}
