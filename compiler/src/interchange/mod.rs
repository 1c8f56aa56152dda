//! Textures in other tools' formats, one file a format, and what each of them loses.
//!
//! Most of these formats know neither speed nor force. They get a *clip*: strokes at a fixed speed
//! and force and taps, as the runtime renders them. What a format can carry of a clip is read back
//! from the bytes that were written, played, and compared with the clip in third octaves.
//!
//! | file | holds |
//! |---|---|
//! | `clip`, `envelope` | strokes and taps on one time line; amplitude and frequency over time |
//! | `playback` | what a player makes of tones, curves and transients |
//! | `third_octave` | band levels, and the difference of two of them |
//! | `c_array`, `rust_source` | the bytes of an asset or a library as source text |
//! | `wav`, `csv` | the clip sample by sample |
//! | `haptic`, `ahap`, `hjif`, `hmpg` | the clip as effects; the first three are also read |
//! | `gltf` | a material that looks and feels: MPEG_haptic_material |
//! | `export` | a format by its name, and what is reported |

pub mod ahap;
mod c_array;
mod clip;
mod csv;
mod envelope;
mod error;
mod export;
mod gltf;
pub mod haptic;
pub mod hjif;
mod hmpg;
mod parse;
pub mod playback;
mod rust_source;
#[cfg(test)]
mod tests;
pub mod third_octave;
mod wav;

pub use clip::{Clip, Scale, Take};
pub use error::{EffectError, EffectProblem, ExportError};
pub use export::{
    Carried, ClipFormat, Exported, Format, Language, Options, clip, export, export_bytes, session,
};
