//! Textures in other tools' formats, one file per format, and what each of them loses.
//!
//! Most of these formats know neither speed nor force. They get a *clip*: strokes at a fixed speed
//! and force, and taps, as the runtime renders them. What a format can carry of a clip is read back
//! from the bytes that were written, played, and compared with the clip in third octaves.
//!
//! ```
//! use asperity::{sources::builtin, interchange::{ClipFormat, Options, export, session}, emit::lower::lower};
//! use asperity_formats::Asset;
//!
//! let bytes = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! let asset = Asset::parse(&bytes).expect("a valid asset");
//! let options = Options {
//!     session: session(Some(100.0), Some(1.0), Some(0.5), false), // mm/s, N, s, no taps
//!     rate_hz: None,
//!     seed: 1,
//!     full_scale_m_s2: None,
//!     tap_full_scale_m_s2: None,
//!     size_px: 64,
//! };
//! let exported = export(&asset, ClipFormat::Hjif, &options)?;
//! assert!(exported.bytes.starts_with(b"{"));
//! assert!(exported.carried[0].loss.is_some()); // of the stroke, in dB
//! # Ok::<(), asperity_io::diagnostic::Fault>(())
//! ```
//!
//! | file | holds |
//! |---|---|
//! | `clip`, `envelope` | strokes and taps on one time line; amplitude and frequency over time |
//! | `playback` | how a player renders tones, curves and transients |
//! | `third_octave` | band levels, and the difference of two of them |
//! | `source`, `c_array`, `rust_source` | the bytes of an asset or a library as source text |
//! | `wav`, `csv` | the clip sample by sample |
//! | `haptic`, `ahap`, `hjif`, `hmpg` | the clip as effects; the first three are also read |
//! | `gltf` | a material that looks and feels: MPEG_haptic_material |
//! | `export` | a format by its name, and what is reported |

pub mod ahap;
mod c_array;
mod clip;
mod csv;
mod envelope;
mod export;
mod gltf;
pub mod haptic;
pub mod hjif;
mod hmpg;
mod parse;
pub mod playback;
mod rust_source;
mod source;
#[cfg(test)]
mod tests;
pub mod third_octave;
mod wav;

pub use clip::{Clip, Scale, Take};
pub use export::{
    Carried, ClipFormat, Exported, Format, Language, Options, clip, export, ranges, session,
};
pub use source::{SourceOptions, SourceText, export_source, header_beside, parse_symbol};
