//! Seeded streams of random numbers, one a purpose and epoch.

use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;
use std::f64::consts::TAU;

/// Purpose of a stream. The numbers are part of a run's identity.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Purpose {
    Initialisation = 1,
    Epoch = 2,
    Verification = 5,
}

/// A stream of random numbers.
#[derive(Debug, Clone)]
pub(crate) struct Stream {
    generator: Xoshiro256PlusPlus,
    spare: Option<f32>,
}

impl Stream {
    /// The stream of a purpose at an epoch.
    pub(crate) fn new(seed: u64, purpose: Purpose, epoch: usize) -> Self {
        // An odd multiplier spreads neighbouring epochs; the generator mixes the rest.
        let epoch = (epoch as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        Self::seeded(seed ^ epoch.rotate_left(17) ^ ((purpose as u64) << 56))
    }

    /// The stream of a seed alone, for splits and starts of the evaluation.
    pub(crate) fn seeded(seed: u64) -> Self {
        Self {
            generator: Xoshiro256PlusPlus::seed_from_u64(seed),
            spare: None,
        }
    }

    /// Uniform in [0, 1), 53 bits.
    pub(crate) fn uniform_f64(&mut self) -> f64 {
        (self.generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Uniform in [0, 1), 24 bits.
    pub(crate) fn uniform(&mut self) -> f32 {
        (self.generator.next_u64() >> 40) as f32 * (1.0 / 16_777_216.0)
    }

    /// An index below `count`, which must not be zero.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        // The bias of the product's high half is count / 2⁶⁴.
        ((u128::from(self.generator.next_u64()) * count as u128) >> 64) as usize
    }

    /// Standard normal (Box and Muller).
    pub(crate) fn normal(&mut self) -> f32 {
        if let Some(spare) = self.spare.take() {
            return spare;
        }
        let uniform = |bits: u64| ((bits >> 11) as f64 + 0.5) / 9_007_199_254_740_992.0;
        let radius = libm::sqrt(-2.0 * libm::log(uniform(self.generator.next_u64())));
        let (sin, cos) = libm::sincos(TAU * uniform(self.generator.next_u64()));
        self.spare = Some((radius * sin) as f32);
        (radius * cos) as f32
    }

    /// `count` standard normals.
    pub(crate) fn normals(&mut self, count: usize) -> Vec<f32> {
        (0..count).map(|_| self.normal()).collect()
    }

    /// Returns true with this probability.
    pub(crate) fn happens(&mut self, probability: f64) -> bool {
        f64::from(self.uniform()) < probability
    }

    /// Factors of inverted dropout: 0 with probability `rate`, else 1/(1 − rate).
    pub(crate) fn keep(&mut self, count: usize, rate: f64) -> Vec<f32> {
        let kept = (1.0 / (1.0 - rate)) as f32;
        // 16 bits a decision: four decisions a draw.
        let threshold = (rate * 65_536.0) as u64;
        let mut factors = Vec::with_capacity(count + 3);
        while factors.len() < count {
            let bits = self.generator.next_u64();
            for lane in 0..4 {
                let dropped = (bits >> (16 * lane)) & 0xFFFF < threshold;
                factors.push(if dropped { 0.0 } else { kept });
            }
        }
        factors.truncate(count);
        factors
    }

    /// Shuffles in place (Fisher and Yates).
    pub(crate) fn shuffle<T>(&mut self, items: &mut [T]) {
        for last in (1..items.len()).rev() {
            let other = self.below(last + 1);
            items.swap(last, other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn streams_repeat_and_differ_by_epoch_and_purpose() {
        let first = |seed, purpose, epoch| Stream::new(seed, purpose, epoch).uniform();
        let reference = first(1, Purpose::Epoch, 3);
        assert_eq!(reference, first(1, Purpose::Epoch, 3));
        assert_ne!(reference, first(1, Purpose::Epoch, 4));
        assert_ne!(reference, first(1, Purpose::Verification, 3));
        assert_ne!(reference, first(2, Purpose::Epoch, 3));
    }

    #[test]
    fn normals_have_mean_zero_and_variance_one() {
        let draws = Stream::new(1, Purpose::Epoch, 0).normals(100_000);
        let mean = draws.iter().sum::<f32>() / 1e5;
        let variance = draws.iter().map(|x| x * x).sum::<f32>() / 1e5;
        // Five standard errors.
        assert!(mean.abs() < 0.016 && (variance - 1.0).abs() < 0.023);
    }

    #[test]
    fn dropout_keeps_the_mean() {
        let factors = Stream::new(1, Purpose::Epoch, 0).keep(100_001, 0.1);
        assert_eq!(factors.len(), 100_001);
        let mean = factors.iter().sum::<f32>() / 100_001.0;
        assert!((mean - 1.0).abs() < 0.006);
    }
}
