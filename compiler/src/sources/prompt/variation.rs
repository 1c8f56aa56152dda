//! Another piece of the same material.

use crate::learned::Latent;
use rand_core::{Rng as _, SeedableRng as _};
use rand_xoshiro::Xoshiro256PlusPlus;

/// The latent moved as far as instances of one material lie apart; not at all by seed 0.
///
/// `spread` is the standard deviation of each component within a material.
pub(super) fn varied(mut z: Latent, spread: &[f32], seed: u64) -> Latent {
    if seed == 0 {
        return z;
    }
    let mut random = Xoshiro256PlusPlus::seed_from_u64(seed);
    for (x, spread) in z.iter_mut().zip(spread) {
        *x += spread * normal(&mut random) as f32;
    }
    z
}

/// A standard normal number, by Box and Muller.
fn normal(random: &mut Xoshiro256PlusPlus) -> f64 {
    let mut uniform = || ((random.next_u64() >> 11) as f64 + 0.5) / (1u64 << 53) as f64;
    let radius = (-2.0 * libm::log(uniform())).sqrt();
    radius * libm::cos(std::f64::consts::TAU * uniform())
}
