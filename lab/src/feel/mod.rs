//! A hand feels a texture: the session, and its summary, CSV, sheet and sound.

pub mod csv;
mod error;
mod recording;
mod run;
pub mod sheet;
pub mod spectrogram;
mod statistics;
mod stroke;
pub mod summary;
mod tap;
pub mod wav;

pub use error::FeelError;
pub use recording::{Recording, Span, TextureFacts};
pub use run::{FeelOptions, record};
pub use stroke::{StrokeReport, strokes};
pub use summary::Summary;
pub use tap::{TapReport, Taps, taps};

#[cfg(test)]
mod tests;
