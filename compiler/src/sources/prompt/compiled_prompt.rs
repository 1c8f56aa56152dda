//! What can be asked of a prompt's texture, and what there is to know of it.

use super::{reading::Reading, understood::Understood};
use crate::{
    learned::{Certainty, Latent},
    passes::reduce::Fidelity,
    pipeline::Request,
    views::preview,
};
use asperity_texture::model::shift::Shift;

/// What a user can ask of a texture besides its prompt.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// 0 for the texture that the prompt means. Other seeds give variations of it, as another
    /// piece of the same material varies.
    pub seed: u64,
    /// What is asked of any texture; the rate is the decoder's own if `None`.
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

/// What was found of a prompt.
#[derive(Debug, Clone)]
pub struct CompiledPrompt {
    /// The latent that the texture was decoded from.
    pub z: Latent,
    /// What the grammar of the prompt moved after that.
    pub shift: Shift,
    /// The nearest materials, which friction is interpolated from.
    pub nearest: Vec<Nearest>,
    /// How well what it says is known.
    pub certainty: Certainty,
    /// Largest cosine between the prompt and a material's mean caption.
    pub similarity: f64,
    /// Tokens read, and cut off.
    pub tokens: (usize, usize),
    /// What the prompt names, and what it says of touch.
    pub reading: Reading,
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
