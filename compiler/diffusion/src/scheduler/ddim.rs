//! Denoising diffusion implicit models without noise in between (Song, Meng and Ermon, 2021).
//!
//! With ᾱ the paper's α, eq. 12 at σ = 0 reads
//!
//! ```text
//! x' = √ᾱ'·x₀ + √(1−ᾱ')·ε,   x₀ = (x − √(1−ᾱ)·ε)/√ᾱ
//! ```
//!
//! where primes stand for the step after. After the last one, ᾱ' is 1 or that of the first trained
//! step, as the model's configuration says.

use super::{
    Step,
    config::{Config, Prediction, Spacing},
    linear::{OUTPUT, SAMPLE},
    timesteps::timesteps,
};
use crate::error::Problem;

/// `count` steps; the first latent is noise of unit variance.
pub(super) fn steps(config: &Config, count: usize) -> Result<Vec<Step>, Problem> {
    let taken: Vec<f64> = timesteps(config, Spacing::Leading, count)?
        .into_iter()
        .map(f64::round_ties_even)
        .collect();
    let share = |t: f64| config.alphas_cumprod[t as usize];
    let last = match config.set_alpha_to_one {
        true => 1.0,
        false => config.alphas_cumprod[0],
    };
    let after = taken.iter().skip(1).map(|&t| share(t)).chain([last]);
    let steps = taken.iter().zip(after).map(|(&timestep, after)| {
        let now = share(timestep);
        let (signal, noise) = (now.sqrt(), (1.0 - now).sqrt());
        let (clean, epsilon) = match config.prediction {
            Prediction::Epsilon => ((SAMPLE - OUTPUT * noise) / signal, OUTPUT),
            Prediction::Velocity => (
                SAMPLE * signal - OUTPUT * noise,
                OUTPUT * signal + SAMPLE * noise,
            ),
        };
        Step {
            timestep,
            input_scale: 1.0,
            next: clean * after.sqrt() + epsilon * (1.0 - after).sqrt(),
        }
    });
    Ok(steps.collect())
}
