//! Seeded random numbers and random filters.

use rand_core::Rng;
use rand_xoshiro::Xoshiro256PlusPlus;

/// Uniform in 0..1.
pub(super) fn unit(rng: &mut Xoshiro256PlusPlus) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}

/// Random line spectral frequencies of an order, at least `gap` rad apart.
pub(super) fn random_lsf(rng: &mut Xoshiro256PlusPlus, order: usize, gap: f64) -> Vec<f64> {
    // The largest step is up to ten times the smallest.
    let steps: Vec<f64> = (0..=order).map(|_| 0.2 + 1.8 * unit(rng)).collect();
    let room = std::f64::consts::PI - gap * (order + 1) as f64;
    let total: f64 = steps.iter().sum();
    let mut at = 0.0;
    steps[..order]
        .iter()
        .map(|step| {
            at += gap + room * step / total;
            at
        })
        .collect()
}
