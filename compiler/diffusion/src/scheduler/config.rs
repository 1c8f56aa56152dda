//! `scheduler/scheduler_config.json`: how the model was trained, as far as sampling needs it.

use super::betas;
use crate::{error::Problem, json};
use serde::Deserialize;

/// Steps that a schedule may have.
const TRAINED_STEPS: std::ops::RangeInclusive<usize> = 2..=100_000;

/// Quantity that the UNet predicts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub enum Prediction {
    /// The noise ε in x = √ᾱ·x₀ + √(1−ᾱ)·ε.
    #[serde(rename = "epsilon")]
    Epsilon,
    /// v = √ᾱ·ε − √(1−ᾱ)·x₀ (Salimans and Ho, 2022).
    #[serde(rename = "v_prediction")]
    Velocity,
}

/// Which of the trained steps are taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Spacing {
    /// Evenly from the last to the first.
    Linspace,
    /// The first of each of as many parts of one length, `steps_offset` added.
    Leading,
    /// The last of each of as many parts of one length.
    Trailing,
}

/// A schedule.
#[derive(Debug, Clone, PartialEq)]
pub struct Config {
    /// ᾱ of each trained step: the share of the picture in the variance, descending in (0, 1).
    pub alphas_cumprod: Vec<f64>,
    /// Quantity that the UNet predicts.
    pub prediction: Prediction,
    /// Which steps are taken; each scheduler has a default of its own.
    pub spacing: Option<Spacing>,
    /// Added to the steps with [`Spacing::Leading`].
    pub steps_offset: usize,
    /// True if the last step of DDIM ends at ᾱ = 1 rather than at that of the first trained step.
    pub set_alpha_to_one: bool,
}

#[derive(Deserialize)]
struct File {
    #[serde(default = "thousand")]
    num_train_timesteps: usize,
    beta_start: Option<f64>,
    beta_end: Option<f64>,
    beta_schedule: Option<betas::Schedule>,
    trained_betas: Option<Vec<f64>>,
    #[serde(default = "epsilon")]
    prediction_type: Prediction,
    timestep_spacing: Option<Spacing>,
    #[serde(default)]
    steps_offset: usize,
    #[serde(default = "yes")]
    set_alpha_to_one: bool,
    #[serde(default)]
    clip_sample: bool,
    #[serde(default)]
    thresholding: bool,
    #[serde(default)]
    rescale_betas_zero_snr: bool,
}

const fn thousand() -> usize {
    1000
}

const fn epsilon() -> Prediction {
    Prediction::Epsilon
}

const fn yes() -> bool {
    true
}

impl Config {
    /// Reads `scheduler_config.json`, whichever scheduler wrote it.
    ///
    /// # Errors
    /// [`Problem::Json`], and [`Problem::Field`] for what is out of range or not supported.
    pub fn parse(text: &str) -> Result<Self, Problem> {
        let file: File = json::parse(text)?;
        let steps = file.num_train_timesteps;
        if !TRAINED_STEPS.contains(&steps) {
            return Err(Problem::Field {
                field: "num_train_timesteps",
                found: steps.to_string(),
                expected: "2 to 100000".into(),
            });
        }
        for (field, is_set) in [
            ("clip_sample", file.clip_sample),
            ("thresholding", file.thresholding),
            ("rescale_betas_zero_snr", file.rescale_betas_zero_snr),
        ] {
            if is_set {
                return Err(Problem::Field {
                    field,
                    found: "true".into(),
                    expected: "false, as of a latent diffusion model".into(),
                });
            }
        }
        if file.steps_offset >= steps {
            return Err(Problem::Field {
                field: "steps_offset",
                found: file.steps_offset.to_string(),
                expected: format!("less than {steps}"),
            });
        }
        let betas = match file.trained_betas {
            Some(betas) if betas.len() == steps => betas,
            Some(betas) => {
                return Err(Problem::Field {
                    field: "trained_betas",
                    found: format!("a list of {}", betas.len()),
                    expected: format!("a list of {steps}"),
                });
            }
            None => betas::betas(
                file.beta_schedule.unwrap_or(betas::Schedule::ScaledLinear),
                file.beta_start.unwrap_or(0.000_85),
                file.beta_end.unwrap_or(0.012),
                steps,
            ),
        };
        Ok(Self {
            alphas_cumprod: betas::alphas_cumprod(&betas)?,
            prediction: file.prediction_type,
            spacing: file.timestep_spacing,
            steps_offset: file.steps_offset,
            set_alpha_to_one: file.set_alpha_to_one,
        })
    }

    /// Number of steps on which the model was trained.
    #[must_use]
    pub fn trained_steps(&self) -> usize {
        self.alphas_cumprod.len()
    }
}
