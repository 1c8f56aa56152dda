//! Vectors of words for Asperity's learned model, a package of its own because registries limit the size of one.
//!
//! `asperity-model` has the whole model. Licences of what is not ours are in `LICENSES/`.

#![no_std]

/// The words: lines `word TAB row`, sorted by the bytes of the word.
pub static WORD_ROWS: &str = include_str!("../words.tsv");
/// The vectors: [`WORD_WIDTH`] codes (int8) of each row, then the scale of each row (float32, little-endian), what a
/// code is worth.
pub static WORD_VECTORS: &[u8] = include_bytes!("../words.bin");
/// Codes of a row.
pub const WORD_WIDTH: usize = 96;
