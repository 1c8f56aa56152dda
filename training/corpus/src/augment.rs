//! Augmented instances: the same material at another place of its sheet.

use crate::{Instance, generator::Physical};
use rand_core::SeedableRng;
use rand_xoshiro::Xoshiro256PlusPlus;

// Variation between instances of a material: standard deviations of normal draws.
const WAVELENGTH_OCTAVES: f64 = 0.08;
const HEIGHT_DB: f64 = 0.6;
const MODULUS_DECADES: f64 = 0.06;
/// Of the height spectrum, relative.
const SPREAD: f64 = 0.06;
const BIN_LEVEL_DB: f64 = 0.3;
/// Weight of another material's taps, as in the paper.
const TAP_MIXING: f32 = 0.05;

/// The instances of material `index`, each made of its varied parameters. `prototypes` are the
/// unaugmented materials, whose taps are mixed in.
pub(crate) fn instances(
    physical: &Physical,
    make: impl Fn(&Physical) -> Instance,
    prototypes: &[Instance],
    index: usize,
    count: usize,
    seed: u64,
) -> Vec<Instance> {
    (0..count)
        .map(|number| {
            let mut draws = Draws::new(seed, index, number);
            let varied = Physical {
                wavelength_mm: physical.wavelength_mm
                    * libm::exp2(WAVELENGTH_OCTAVES * draws.normal()),
                height_um: physical.height_um * libm::exp10(HEIGHT_DB * draws.normal() / 20.0),
                modulus_mpa: physical.modulus_mpa * libm::exp10(MODULUS_DECADES * draws.normal()),
                spread_octaves: physical.spread_octaves * libm::exp(SPREAD * draws.normal()),
                ..*physical
            };
            let mut instance = make(&varied);
            for level_db in &mut instance.level_db {
                *level_db += (BIN_LEVEL_DB * draws.normal()) as f32;
            }
            mix_taps(&mut instance, prototypes, index, &mut draws);
            instance
        })
        .collect()
}

/// Mixes in the taps of another material, drawn uniformly.
pub(crate) fn mix_taps(
    instance: &mut Instance,
    prototypes: &[Instance],
    index: usize,
    draws: &mut Draws,
) {
    if prototypes.len() < 2 {
        return;
    }
    let step = 1 + draws.below(prototypes.len() - 1);
    let other = &prototypes[(index + step) % prototypes.len()];
    for (trace, theirs) in instance.taps_m_s2.iter_mut().zip(&other.taps_m_s2) {
        for (a, b) in trace.iter_mut().zip(theirs) {
            *a = (1.0 - TAP_MIXING) * *a + TAP_MIXING * b;
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
