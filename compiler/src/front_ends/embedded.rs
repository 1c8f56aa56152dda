//! The networks inside the binary: a prompt needs no file.

use crate::front_ends::{
    inference::Backend,
    learned::{Files, ModelError},
    text::{Vocabulary, minilm::MiniLm},
};

const TEXT_ENCODER: &[u8] = include_bytes!("../../model/text_encoder.onnx");
const VOCABULARY: &str = include_str!("../../model/vocab.tsv");

/// The files of the shipped model.
#[must_use]
pub fn model() -> Files {
    Files {
        description: include_str!("../../model/model.json").into(),
        text_projection: include_bytes!("../../model/text_projection.onnx")
            .as_slice()
            .into(),
        ar_decoder: include_bytes!("../../model/ar_decoder.onnx")
            .as_slice()
            .into(),
        tap_decoder: include_bytes!("../../model/tap_decoder.onnx")
            .as_slice()
            .into(),
        encoder: include_bytes!("../../model/encoder.onnx").as_slice().into(),
    }
}

/// all-MiniLM-L6-v2 on a back end.
///
/// # Errors
/// [`ModelError::Network`] when the back end refuses it.
pub fn text_encoder(backend: &Backend) -> Result<MiniLm, ModelError> {
    let session = backend
        .session(TEXT_ENCODER.into())
        .map_err(|message| ModelError::Network {
            file: "text_encoder.onnx".into(),
            message,
        })?;
    Ok(MiniLm::new(session, Vocabulary::new(VOCABULARY)))
}

/// Bytes of the text encoder and of the learned model.
#[must_use]
pub fn sizes() -> (usize, usize) {
    let files = model();
    let model = files.description.len()
        + files.text_projection.len()
        + files.ar_decoder.len()
        + files.tap_decoder.len()
        + files.encoder.len();
    (TEXT_ENCODER.len() + VOCABULARY.len(), model)
}
