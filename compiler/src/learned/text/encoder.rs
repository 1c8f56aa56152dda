//! Common interface of the text encoders.

use asperity_io::diagnostic::Fault;
use std::fmt::Display;

/// A frozen text encoder.
pub trait TextEncoder: Send + Sync {
    /// The name that a model description uses: `minilm` or `clip`.
    fn name(&self) -> &str;
    /// Width of its vectors.
    fn width(&self) -> usize;
    /// The unit vector of one text.
    ///
    /// # Errors
    /// [`Fault`] when the network fails or answers with another width.
    fn encode(&self, text: &str) -> Result<Encoded, Fault>;
    /// The unit vectors of several texts, each to the bit what [`encode`](Self::encode) gives, where
    /// the network treats every row of a batch by itself and sums it in the same order.
    ///
    /// # Errors
    /// As [`encode`](Self::encode), for the first text that fails.
    fn encode_all(&self, texts: &[&str]) -> Result<Vec<Encoded>, Fault> {
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

/// Returns the fault of a network that cannot be loaded, or failed.
pub(super) fn failed(what: impl Display) -> Fault {
    Fault::new(
        format!("text encoder: {what}"),
        "export the text tower alone, with ids [1, 77] in and a vector [1, width] out; \
         where an operator is unknown, try --backend onnxruntime",
    )
}

/// Returns the fault of a network with other inputs or outputs than a text encoder.
pub(super) fn signature(port: &str, found: &str, expected: &str) -> Fault {
    failed(format_args!("{port}: {found}, expected {expected}"))
}

/// Scales a vector to length one.
pub(super) fn unit(mut vector: Vec<f32>) -> Result<Vec<f32>, Fault> {
    // Summed in order, so that every machine gives the same bits.
    let norm = vector.iter().map(|x| x * x).sum::<f32>().sqrt();
    if !(norm.is_finite() && norm > 1e-6) {
        let what = format!("text encoder: its vector for this text has length {norm}");
        return Err(Fault::new(what, "try other words"));
    }
    for x in &mut vector {
        *x /= norm;
    }
    Ok(vector)
}
