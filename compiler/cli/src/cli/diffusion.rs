//! Arguments of pictures by Stable Diffusion.

use asperity::{
    diffusion::{Method, Options},
    inference::BackendName,
};
use clap::{Args, value_parser};
use std::path::PathBuf;

/// Which model makes a picture, and how.
#[derive(Debug, Args)]
pub(crate) struct Diffusion {
    /// Let Stable Diffusion make the picture: an ONNX folder of your own, see docs/preview.md
    #[arg(long, value_name = "DIR")]
    pub(crate) diffusion: Option<PathBuf>,
    /// Steps from noise to the picture, 1 to 1000
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = value_parser!(u16).range(1..=1000), requires = "diffusion")]
    pub(crate) steps: u16,
    /// How far each step goes towards the prompt, 1 to 30; 1 leaves the negative prompt out
    #[arg(long, value_name = "SCALE", default_value_t = 7.5, value_parser = |text: &str| super::within(text, 1.0, 30.0), requires = "diffusion")]
    pub(crate) guidance: f32,
    /// How steps are taken
    #[arg(
        long,
        value_name = "ddim|euler",
        default_value_t,
        requires = "diffusion"
    )]
    pub(crate) scheduler: Method,
    /// What the picture does not show
    #[arg(
        long,
        value_name = "TEXT",
        default_value = "",
        hide_default_value = true,
        requires = "diffusion"
    )]
    pub(crate) negative: String,
    /// Let the picture repeat in both directions; decoding takes four times as long
    #[arg(long, requires = "diffusion")]
    pub(crate) tile: bool,
    /// Where its networks run: `onnxruntime`, or `portable` for networks as small as tests have
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
