//! The networks inside the binary: a prompt needs no file.

use crate::front_ends::{
    inference::Backend,
    learned::{Files, ModelError},
    text::{Vocabulary, minilm::MiniLm},
};
use asperity_model::{
    AR_DECODER, DESCRIPTION, ENCODER, TAP_DECODER, TEXT_ENCODER, TEXT_PROJECTION, VOCABULARY,
};

/// The files of the shipped model.
#[must_use]
pub fn model() -> Files {
    Files {
        description: DESCRIPTION.into(),
        text_projection: TEXT_PROJECTION.into(),
        ar_decoder: AR_DECODER.into(),
        tap_decoder: TAP_DECODER.into(),
        encoder: ENCODER.into(),
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
