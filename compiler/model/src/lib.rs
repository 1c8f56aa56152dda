//! The learned model that Asperity ships, and the text encoder that it was trained with, as bytes
//! in the binary.
//!
//! The networks are ONNX files. Where one is larger than a package may be, it lies in packages of
//! its own. `cargo run -p asperity-model --example folder -- DIR` writes the model folder that
//! `--model DIR` takes. Licences of what is not ours are in `LICENSES/`.

#![no_std]

mod parts;

pub use asperity_model_ar_decoder::AR_DECODER;
pub use asperity_model_tap_decoder::TAP_DECODER;
pub use asperity_model_text_projection::TEXT_PROJECTION;
pub use asperity_model_words::{WORD_ROWS, WORD_VECTORS, WORD_WIDTH};

/// The file `model.json`: what the model is, and the materials that it was trained on.
pub static DESCRIPTION: &str = include_str!("../model.json");
/// The file `encoder.onnx`: `ar` [B, 18, 22], `taps_m_s2` [B, 13, 100] and `present` [B, 2] to
/// `mean` and `log_variance` [B, 64].
pub static ENCODER: &[u8] = include_bytes!("../encoder.onnx");
/// The file `text_encoder.onnx`: `input_ids` [B, S], at most 128 of them, to `embedding` [B, 384].
pub static TEXT_ENCODER: &[u8] = &parts::TEXT_ENCODER;
/// The word pieces of the text encoder: lines `piece TAB id`, sorted by the bytes of the piece.
pub static VOCABULARY: &str = include_str!("../vocab.tsv");

/// The merges of CLIP's byte-pair encoding, most frequent first, below a head line: what its
/// 49,408 tokens are made by.
pub static CLIP_MERGES: &str = include_str!("../clip_merges.txt");

/// The contact laws of materials that give way, by the names of `model.json`, as TOML. They are no part of
/// [`folder`]: what does not give way does not depend on them.
pub static CONTACT_LAWS: &str = include_str!("../contact_laws.toml");

/// The directions of materials with ribs, a grain or a nap, by the names of `model.json`, as TOML; no part of [`folder`],
/// either.
pub static DIRECTIONS: &str = include_str!("../directions.toml");

/// Indentation moduli of materials, MPa, by the names of `model.json`: lines `name TAB modulus`; no part of [`folder`],
/// either.
pub static MODULI: &str = include_str!("../moduli.tsv");

/// CRC-32 of the files of [`folder`], one after another. A test compares.
pub const MODEL_CRC32: u32 = 0x7b36_8b4c;

/// The files of a model folder, which `--model DIR` takes, with their names. No static, for some linkers would put every
/// file into a program twice.
#[must_use]
pub const fn folder() -> [(&'static str, &'static [u8]); 5] {
    [
        ("model.json", DESCRIPTION.as_bytes()),
        ("text_projection.onnx", TEXT_PROJECTION),
        ("ar_decoder.onnx", AR_DECODER),
        ("tap_decoder.onnx", TAP_DECODER),
        ("encoder.onnx", ENCODER),
    ]
}
