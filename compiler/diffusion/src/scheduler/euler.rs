//! Euler's method on the probability flow (Karras et al., 2022, algorithm 2 without churn).
//!
//! In the paper's variance-exploding form the latent is x = x₀ + σ·ε with σ = √((1−ᾱ)/ᾱ), and
//!
//! ```text
//! x' = x + (σ' − σ)·d,   d = (x − D(x; σ))/σ
//! ```
//!
//! where D is the denoised latent. The UNet was trained on latents of unit variance: its input is
//! x/√(σ² + 1). After the last step σ' is 0.

use super::{
    Step,
    config::{Config, Prediction, Spacing},
    linear::{OUTPUT, SAMPLE},
    timesteps::timesteps,
};
use crate::error::Problem;

/// `count` steps, and the standard deviation of the first latent. `whole` rounds the steps, for a
/// UNet that takes integers.
pub(super) fn steps(
    config: &Config,
    count: usize,
    whole: bool,
) -> Result<(Vec<Step>, f64), Problem> {
    let mut taken = timesteps(config, Spacing::Linspace, count)?;
    if whole {
        taken.iter_mut().for_each(|t| *t = t.round_ties_even());
    }
    let sigmas: Vec<f64> = taken.iter().map(|&t| sigma(config, t)).collect();
    let after = sigmas.iter().skip(1).copied().chain([0.0]);
    let pairs = sigmas.iter().zip(after);
    let steps = taken.iter().zip(pairs).map(|(&timestep, (&now, after))| {
        let scale = (now * now + 1.0).sqrt();
        let slope = match config.prediction {
            // x₀ = x − σ·ε
            Prediction::Epsilon => OUTPUT,
            // x₀ = x/(σ²+1) − v·σ/√(σ²+1), from v and x in the form of unit variance
            Prediction::Velocity => {
                let clean = SAMPLE / (scale * scale) - OUTPUT * (now / scale);
                (SAMPLE - clean) / now
            }
        };
        Step {
            timestep,
            input_scale: scale.recip(),
            next: SAMPLE + slope * (after - now),
        }
    });
    let first = sigmas.first().copied().unwrap_or_default();
    let spread = match config.spacing.unwrap_or(Spacing::Linspace) {
        // The last trained step is taken: what is left of the picture there is neglected.
        Spacing::Linspace | Spacing::Trailing => first,
        Spacing::Leading => (first * first + 1.0).sqrt(),
    };
    Ok((steps.collect(), spread))
}

/// σ at a step, linear between whole ones.
fn sigma(config: &Config, timestep: f64) -> f64 {
    let alphas = &config.alphas_cumprod;
    let at = |n: usize| ((1.0 - alphas[n]) / alphas[n]).sqrt();
    let below = (timestep as usize).min(alphas.len() - 1);
    let above = (below + 1).min(alphas.len() - 1);
    let fraction = timestep - below as f64;
    at(below) + fraction * (at(above) - at(below))
}
