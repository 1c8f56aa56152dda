//! Standard Gaussian noise from a seeded generator, by Box and Muller.

use rand_core::Rng;
use std::f64::consts::TAU;

/// A number in (0, 1).
pub fn uniform(random: &mut impl Rng) -> f64 {
    ((random.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
}

/// Independent samples of mean 0 and variance 1.
pub fn gaussian(random: &mut impl Rng, count: usize) -> Vec<f64> {
    (0..count)
        .map(|_| {
            let radius = (-2.0 * libm::log(uniform(random))).sqrt();
            radius * libm::cos(TAU * uniform(random))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_core::SeedableRng as _;
    use rand_xoshiro::Xoshiro256PlusPlus;

    #[test]
    fn moments_are_those_of_a_gaussian() {
        let samples = gaussian(&mut Xoshiro256PlusPlus::seed_from_u64(1), 1_000_000);
        let moment =
            |power: i32| samples.iter().map(|x| x.powi(power)).sum::<f64>() / samples.len() as f64;
        // Each bound is five standard errors.
        assert!(moment(1).abs() < 5e-3);
        assert!((moment(2) - 1.0).abs() < 7e-3);
        assert!((moment(4) - 3.0).abs() < 5e-2);
    }
}
