//! Common interface of the text encoders.

use asperity_io::diagnostic::Diagnostic;
use thiserror::Error;

/// A frozen text encoder.
pub trait TextEncoder: Send + Sync {
    /// The name that a model description uses: `minilm` or `clip`.
    fn name(&self) -> &str;
    /// Width of its vectors.
    fn width(&self) -> usize;
    /// The unit vector of one text.
    ///
    /// # Errors
    /// [`TextError`] when the network fails or answers with another width.
    fn encode(&self, text: &str) -> Result<Encoded, TextError>;
    /// The unit vectors of several texts, each to the bit what [`encode`](Self::encode) gives, where
    /// the network treats every row of a batch by itself and sums it in the same order.
    ///
    /// # Errors
    /// As [`encode`](Self::encode), for the first text that fails.
    fn encode_all(&self, texts: &[&str]) -> Result<Vec<Encoded>, TextError> {
        texts.iter().map(|text| self.encode(text)).collect()
    }
    /// Returns true if it has tokens for a word. An encoder of bytes has them for every word.
    fn reads(&self, word: &str) -> bool {
        let _ = word;
        true
    }
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
    /// The network cannot be loaded or failed.
    #[error("text encoder: {0}")]
    Network(String),
    /// The network does not have the inputs and outputs of a text encoder.
    #[error("text encoder: {field}: {found}, expected {expected}")]
    Signature {
        /// The input or output.
        field: String,
        /// Actual signature.
        found: String,
        /// Expected signature.
        expected: String,
    },
    /// The bytes of a table of words do not divide into rows.
    #[error("table of words: {0} bytes are no whole number of rows")]
    Table(usize),
    /// The network answered with a vector that has no direction.
    #[error("text encoder: its vector for this text has length {0}")]
    NoDirection(f32),
}

/// Scales a vector to length one.
pub(super) fn unit(mut vector: Vec<f32>) -> Result<Vec<f32>, TextError> {
    // Summed in order, so that every machine gives the same bits.
    let norm = vector.iter().map(|x| x * x).sum::<f32>().sqrt();
    if !(norm.is_finite() && norm > 1e-6) {
        return Err(TextError::NoDirection(norm));
    }
    for x in &mut vector {
        *x /= norm;
    }
    Ok(vector)
}

impl Diagnostic for TextError {
    fn remedy(&self) -> String {
        match self {
            Self::Tokeniser(_) | Self::NoDirection(_) => "try other words".into(),
            Self::Table(_) => "take the table and its width from the same package".into(),
            Self::Network(_) | Self::Signature { .. } => {
                "export the text tower alone, with ids [1, 77] in and a vector [1, width] out; \
                 where an operator is unknown, try --backend onnxruntime"
                    .into()
            }
        }
    }
}
