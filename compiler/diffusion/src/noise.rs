//! Normal numbers from a seed, the same on every machine.

use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Noise(Xoshiro256PlusPlus);

impl Noise {
    /// The stream of a seed.
    #[must_use]
    pub(crate) fn new(seed: u64) -> Self {
        Self(Xoshiro256PlusPlus::seed_from_u64(seed))
    }

    /// `count` numbers of zero mean and unit variance, by Box and Muller.
    #[must_use]
    pub(crate) fn normal(&mut self, count: usize) -> Vec<f32> {
        let mut numbers = Vec::with_capacity(count + 1);
        while numbers.len() < count {
            let radius = (-2.0 * libm::log(self.uniform())).sqrt();
            let (sine, cosine) = libm::sincos(TAU * self.uniform());
            numbers.extend([(radius * cosine) as f32, (radius * sine) as f32]);
        }
        numbers.truncate(count);
        numbers
    }

    /// A whole number in 0..`end`, or 0 if that is empty.
    #[must_use]
    pub(crate) fn below(&mut self, end: usize) -> usize {
        ((self.uniform() * end as f64) as usize).min(end.saturating_sub(1))
    }

    /// A number in (0, 1).
    fn uniform(&mut self) -> f64 {
        ((self.0.next_u64() >> 11) as f64 + 0.5) / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn noise_is_normal_and_repeats() {
        let numbers = Noise::new(3).normal(65_537);
        assert_eq!(numbers, Noise::new(3).normal(65_537));
        assert_ne!(numbers[0], Noise::new(4).normal(1)[0]);
        let mean = |power: i32| -> f64 {
            let powers = numbers.iter().map(|x| f64::from(*x).powi(power));
            powers.sum::<f64>() / numbers.len() as f64
        };
        // Standard errors of the first four moments are 1, √2, √15 and √96 over √65537.
        let bound = |spread: f64| 5.0 * spread / (numbers.len() as f64).sqrt();
        assert!(mean(1).abs() < bound(1.0));
        assert!((mean(2) - 1.0).abs() < bound(1.42));
        assert!(mean(3).abs() < bound(3.88));
        assert!((mean(4) - 3.0).abs() < bound(9.8));
    }

    #[test]
    fn whole_numbers_stay_below_their_end() {
        let mut noise = Noise::new(0);
        let drawn: Vec<usize> = (0..1000).map(|_| noise.below(7)).collect();
        assert!((0..7).all(|n| drawn.contains(&n)) && drawn.iter().all(|n| *n < 7));
        assert_eq!(noise.below(0), 0);
    }
}
