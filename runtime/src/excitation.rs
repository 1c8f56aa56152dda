//! Excitation ε: standard Gaussian noise by the Box–Muller transform.

use crate::math::{cos_pi, ln, sqrt};
use rand_core::{Rng, SeedableRng};
use rand_xoshiro::Xoshiro128PlusPlus;

/// A seeded stream of standard Gaussian samples.
///
/// Two 32-bit draws a sample, no branch and no rejection, so every sample costs the
/// same. Over 10⁷ samples: mean 0 within 1e-3, variance 1 within 1.5e-3, skewness 0 within
/// 4e-3, kurtosis 3 within 1e-2 (tested). |ε| ≤ √(2·ln 2²⁴) = 5.77.
#[derive(Debug, Clone, PartialEq)]
pub struct Excitation {
    generator: Xoshiro128PlusPlus,
}

impl Excitation {
    /// A stream; the same seed gives the same samples on every platform.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self {
            generator: Xoshiro128PlusPlus::seed_from_u64(seed),
        }
    }

    /// The next sample.
    #[inline]
    pub fn next_gaussian(&mut self) -> f32 {
        const STEP: f32 = 1.0 / 16_777_216.0;
        // u in (0, 1], v in [0, 1), both exact multiples of 2⁻²⁴.
        let u = ((self.generator.next_u32() >> 8) + 1) as f32 * STEP;
        let v = (self.generator.next_u32() >> 8) as f32 * STEP;
        let radius = sqrt(-2.0 * ln(u));
        // cos(2πv) is even about v = ½.
        let folded = 2.0 * v - 1.0;
        -radius * cos_pi(if folded < 0.0 { -folded } else { folded })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_are_those_of_a_gaussian() {
        let mut noise = Excitation::new(1);
        let count = 10_000_000;
        let (mut m1, mut m2, mut m3, mut m4, mut lag, mut last) = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0);
        let mut beyond_three = 0_u32;
        for _ in 0..count {
            let x = f64::from(noise.next_gaussian());
            assert!(x.abs() < 5.78);
            m1 += x;
            m2 += x * x;
            m3 += x * x * x;
            m4 += x * x * x * x;
            lag += x * last;
            last = x;
            beyond_three += u32::from(x.abs() > 3.0);
        }
        let n = f64::from(count);
        // Standard errors at this count: 3e-4, 4.5e-4, 1.2e-3, 3.1e-3, 3e-4.
        assert!((m1 / n).abs() < 1e-3);
        assert!((m2 / n - 1.0).abs() < 1.5e-3);
        assert!((m3 / n).abs() < 4e-3);
        assert!((m4 / n - 3.0).abs() < 1e-2);
        assert!((lag / n).abs() < 1e-3);
        assert!((f64::from(beyond_three) / n - 0.002_699_8).abs() < 6e-5);
    }
}
