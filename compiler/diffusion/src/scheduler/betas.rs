//! β of each trained step: the variance of the noise that it adds.

use crate::error::Problem;
use serde::Deserialize;
use std::f64::consts::FRAC_PI_2;

/// Schedule of β over the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(super) enum Schedule {
    /// β grows linearly (Ho et al., 2020).
    Linear,
    /// √β grows linearly, as in latent diffusion (Rombach et al., 2022).
    ScaledLinear,
    /// ᾱ follows a squared cosine (Nichol and Dhariwal, 2021).
    #[serde(rename = "squaredcos_cap_v2")]
    SquaredCosine,
}

/// β of `steps` steps, from `start` to `end`.
pub(super) fn betas(schedule: Schedule, start: f64, end: f64, steps: usize) -> Vec<f64> {
    let last = (steps - 1) as f64;
    let line = |from: f64, to: f64, n: usize| from + (to - from) * n as f64 / last;
    let at = |n: usize| match schedule {
        Schedule::Linear => line(start, end, n),
        Schedule::ScaledLinear => {
            let root = line(start.sqrt(), end.sqrt(), n);
            root * root
        }
        Schedule::SquaredCosine => {
            let share = |n: usize| {
                let t = n as f64 / steps as f64;
                let cosine = libm::cos((t + 0.008) / 1.008 * FRAC_PI_2);
                cosine * cosine
            };
            (1.0 - share(n + 1) / share(n)).min(0.999)
        }
    };
    (0..steps).map(at).collect()
}

/// ᾱ_t = Π (1 − β_s) over s ≤ t.
pub(super) fn alphas_cumprod(betas: &[f64]) -> Result<Vec<f64>, Problem> {
    let mut product = 1.0;
    let mut alphas = Vec::with_capacity(betas.len());
    for (step, &beta) in betas.iter().enumerate() {
        product *= 1.0 - beta;
        // Written so that NaN is refused as well.
        if !(beta > 0.0 && beta < 1.0 && product >= f64::from(f32::MIN_POSITIVE)) {
            return Err(Problem::Field {
                field: "betas",
                found: format!("{beta} at step {step}"),
                expected: "between 0 and 1, and some of the picture left at the last".into(),
            });
        }
        alphas.push(product);
    }
    Ok(alphas)
}
