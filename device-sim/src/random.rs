//! Uniform random numbers.

use rand_core::Rng;

/// A number in 0..1, with the 53 bits that a double holds.
#[must_use]
pub fn unit(rng: &mut impl Rng) -> f64 {
    (rng.next_u64() >> 11) as f64 / (1_u64 << 53) as f64
}
