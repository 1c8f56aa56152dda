//! Text to vectors: frozen sentence encoders with their tokenisers.
//!
//! [`minilm`] is embedded, with a [table of words](WordTable) beside it. [`clip`] runs a user's export of CLIP's text tower.

mod choice;
pub mod clip;
mod encoder;
pub mod minilm;
mod vocabulary;
mod word_piece;
mod words;

pub use choice::TextEncoderChoice;
pub use encoder::{Encoded, TextEncoder, TextError};
pub use vocabulary::Vocabulary;
pub use words::{WithWords, WordTable};
