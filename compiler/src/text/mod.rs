//! Text to vectors: frozen sentence encoders with their tokenisers.

use thiserror::Error;

/// A frozen text encoder.
pub trait TextEncoder: Send + Sync {
    /// `minilm` or `clip`: what a model description calls it.
    fn name(&self) -> &str;
    /// Width of its vectors.
    fn width(&self) -> usize;
    /// The unit vector of one text.
    ///
    /// # Errors
    /// [`TextError`] when the network fails or answers with another width.
    fn encode(&self, text: &str) -> Result<Encoded, TextError>;
}

/// A text as its encoder sees it.
#[derive(Debug, Clone, PartialEq)]
pub struct Encoded {
    /// Unit vector.
    pub vector: Vec<f32>,
    /// Tokens that were read, start and end marks included.
    pub tokens: usize,
    /// Tokens that did not fit and were cut off.
    pub cut: usize,
}

/// Why a text has no vector.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum TextError {
    /// The tokeniser refused the text or its own vocabulary.
    #[error("tokeniser: {0}")]
    Tokeniser(String),
    /// The network failed.
    #[error("text encoder: {0}")]
    Network(String),
}
