//! From noise to a latent: which steps are taken, and what each of them does.
//!
//! Every step of both schedulers is linear in the latent and the UNet's output, so a schedule is a
//! list of coefficients. They are computed in f64 from the formulas that `ddim` and `euler`
//! state.

mod betas;
mod config;
mod ddim;
mod euler;
mod linear;
mod timesteps;

pub use config::{Config, Prediction, Spacing};

use crate::error::Problem;
use linear::Linear;
use std::{fmt, str::FromStr};

/// A method of sampling.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// DDIM with η = 0: `ddim`.
    #[default]
    Ddim,
    /// Euler's method: `euler`.
    Euler,
}

impl FromStr for Method {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "ddim" => Ok(Self::Ddim),
            "euler" => Ok(Self::Euler),
            _ => Err("`ddim` or `euler`".into()),
        }
    }
}

impl fmt::Display for Method {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Ddim => "ddim",
            Self::Euler => "euler",
        })
    }
}

/// A sampling step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// The trained step whose noise is in the latent; whole unless the UNet takes numbers.
    pub timestep: f64,
    /// The UNet is given the latent times this.
    pub input_scale: f64,
    next: Linear,
}

impl Step {
    /// Takes the latent to the next step. `output` is what the UNet gave, of the same length.
    pub fn advance(&self, sample: &mut [f32], output: &[f32]) {
        for (x, y) in sample.iter_mut().zip(output) {
            *x = (self.next.sample * f64::from(*x) + self.next.output * f64::from(*y)) as f32;
        }
    }
}

/// All steps of one picture.
#[derive(Debug, Clone, PartialEq)]
pub struct Schedule {
    /// Standard deviation of the first latent, which is noise.
    pub first_spread: f64,
    /// The steps in order.
    pub steps: Vec<Step>,
}

impl Schedule {
    /// The schedule of a model. `whole` is for a UNet that takes steps as integers.
    ///
    /// # Errors
    /// [`Problem::Steps`] for no step, or more than the model was trained on.
    pub fn new(
        config: &Config,
        method: Method,
        count: usize,
        whole: bool,
    ) -> Result<Self, Problem> {
        let (steps, first_spread) = match method {
            Method::Ddim => (ddim::steps(config, count)?, 1.0),
            Method::Euler => euler::steps(config, count, whole)?,
        };
        Ok(Self {
            first_spread,
            steps,
        })
    }
}
