//! Options and results of compiling a prompt.

use super::{readable::Understood, reading::Reading};
use crate::{
    learned::{Certainty, Latent},
    passes::reduce::Fidelity,
    pipeline::Request,
    views::preview,
};
use asperity_texture::model::{Bearing, Direction, shift::Shift};

/// Compile options besides the prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// 0 for the texture that the prompt means. Other seeds give variations of it, as another
    /// piece of the same material varies.
    pub seed: u64,
    /// Options common to all textures; the rate is the decoder's own if `None`.
    pub request: Request,
}

/// At fidelity `auto`, with a preview of the usual size.
impl Default for Options {
    fn default() -> Self {
        Self {
            seed: 0,
            request: Request {
                fidelity: Fidelity::Auto,
                preview_px: Some(preview::SIZE),
                ..Request::default()
            },
        }
    }
}

impl Options {
    /// The same without a preview.
    #[must_use]
    pub fn without_preview(mut self) -> Self {
        self.request.preview_px = None;
        self
    }
}

/// Interpretation of a compiled prompt.
#[derive(Debug, Clone)]
pub struct CompiledPrompt {
    /// The latent that the texture was decoded from.
    pub z: Latent,
    /// Shift by the grammar of the prompt, applied after decoding.
    pub shift: Shift,
    /// The nearest materials, which friction is interpolated from.
    pub nearest: Vec<Nearest>,
    /// Certainty of the interpretation.
    pub certainty: Certainty,
    /// Largest cosine between the prompt and a material's mean caption.
    pub similarity: f64,
    /// Tokens read, and cut off.
    pub tokens: (usize, usize),
    /// Names and touch qualities in the prompt.
    pub reading: Reading,
    /// The direction of the strokes, where the prompt says one.
    pub bearing: Option<Bearing>,
    /// The direction of the material, if it has one.
    pub direction: Option<Direction>,
    /// Which words of the prompt the encoder can read.
    pub understood: Understood,
}

/// A material near the prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Nearest {
    /// Its name.
    pub name: String,
    /// Its family.
    pub family: String,
    /// Its coefficient of friction.
    pub mu: f64,
    /// Its weight, 0..=1.
    pub weight: f64,
}
