//! The networks inside the binary: a prompt needs no file.

use super::{
    Files,
    files::wrong_file,
    inference::Backend,
    text::{Vocabulary, WithWords, WordStates, WordTable, minilm::MiniLm},
};
use asperity_io::diagnostic::Fault;
use asperity_model::{
    AR_DECODER, DESCRIPTION, ENCODER, MODEL_CRC32, TAP_DECODER, TEXT_ENCODER, TEXT_PROJECTION,
    VOCABULARY, WORD_ROWS, WORD_VECTORS, WORD_WIDTH,
};
use asperity_nn::{Bytes, Portable, Session};
use std::sync::LazyLock;

/// The files of the shipped model.
#[must_use]
pub fn model() -> Files {
    Files {
        description: DESCRIPTION.into(),
        text_projection: TEXT_PROJECTION.into(),
        ar_decoder: AR_DECODER.into(),
        tap_decoder: TAP_DECODER.into(),
        encoder: ENCODER.into(),
        known_crc32: Some(MODEL_CRC32),
    }
}

/// all-MiniLM-L6-v2 on a back end, with the table of words beside it.
///
/// # Errors
/// [`Fault`] when the back end refuses it.
pub fn text_encoder(backend: &Backend) -> Result<WithWords<MiniLm>, Fault> {
    let session = match backend {
        Backend::Portable => portable().map(|network| Box::new(network) as Box<dyn Session>),
        Backend::OnnxRuntime => backend.session(TEXT_ENCODER.into()),
    };
    let session = session.map_err(|message| wrong_file("text_encoder.onnx", message))?;
    let table = word_table()?;
    let sentence = MiniLm::new(session, Vocabulary::new(VOCABULARY));
    Ok(WithWords::new(sentence, table))
}

/// The encoder on the portable engine, loaded once.
fn portable() -> Result<&'static Portable, String> {
    static NETWORK: LazyLock<Result<Portable, String>> = LazyLock::new(|| {
        let network = Portable::from_shared(Bytes::from_static(TEXT_ENCODER));
        network.map_err(|error| error.to_string())
    });
    NETWORK.as_ref().map_err(Clone::clone)
}

/// States of words in the same encoder, on the portable engine whatever the back end. It is loaded when the first
/// sentence is read.
#[must_use]
pub fn word_states() -> WordStates {
    WordStates::new(portable, Vocabulary::new(VOCABULARY))
}

/// The table of words.
///
/// # Errors
/// [`Fault`] when its bytes are no table.
pub fn word_table() -> Result<WordTable, Fault> {
    let table = WordTable::new(Vocabulary::new(WORD_ROWS), WORD_VECTORS, WORD_WIDTH);
    table.map_err(|fault| wrong_file("words.bin", fault))
}

/// Bytes of the text encoder and of the learned model.
#[must_use]
pub fn sizes() -> (usize, usize) {
    (
        TEXT_ENCODER.len() + VOCABULARY.len() + WORD_ROWS.len() + WORD_VECTORS.len(),
        model().parts().iter().map(|part| part.len()).sum(),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_stated_checksum_is_that_of_the_files() {
        let files = model();
        assert_eq!(files.crc32(), files.checksum(), "set `MODEL_CRC32` anew");
    }
}
