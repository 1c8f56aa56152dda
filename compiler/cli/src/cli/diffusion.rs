//! Arguments of pictures by Stable Diffusion.

use asperity::{
    learned::inference::BackendName,
    views::diffusion::{Method, Options},
};
use clap::{Args, value_parser};
use std::path::PathBuf;

/// Which model makes a picture, and how.
#[derive(Debug, Args)]
pub(crate) struct Diffusion {
    /// Draw the picture with Stable Diffusion, from this ONNX folder (see docs/preview.md)
    #[arg(long, value_name = "DIR")]
    pub(crate) diffusion: Option<PathBuf>,
    /// Denoising steps, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = value_parser!(u16).range(1..=1000), requires = "diffusion")]
    pub(crate) steps: u16,
    /// Guidance scale, 1 to 30: how closely to follow the prompt; 1 ignores the negative prompt
    #[arg(long, value_name = "SCALE", default_value_t = 7.5, value_parser = |text: &str| super::within(text, &(1.0..=30.0)), requires = "diffusion")]
    pub(crate) guidance: f32,
    /// Scheduler of the denoising steps
    #[arg(
        long,
        value_name = "ddim|euler",
        default_value_t,
        requires = "diffusion"
    )]
    pub(crate) scheduler: Method,
    /// Negative prompt: what the picture must not show
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true,
        requires = "diffusion"
    )]
    pub(crate) negative: String,
    /// Draw a picture that tiles seamlessly; decoding takes four times as long
    #[arg(long, requires = "diffusion")]
    pub(crate) tile: bool,
    /// Back end of the diffusion networks; `portable` is only fast enough for tiny ones, as in tests
    #[arg(long, value_name = "onnxruntime|portable", default_value_t = BackendName::OnnxRuntime, requires = "diffusion")]
    pub(crate) diffusion_backend: BackendName,
}

impl Diffusion {
    /// The options with a prompt and a seed.
    pub(crate) fn options(&self, prompt: String, seed: u64) -> Options {
        Options {
            prompt,
            negative: self.negative.clone(),
            steps: self.steps.into(),
            guidance: self.guidance,
            method: self.scheduler,
            seed,
            tile: self.tile,
        }
    }
}
