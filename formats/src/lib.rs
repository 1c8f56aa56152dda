//! The bytes of Asperity: the asset (`.asp`), one texture, and the library
//! (`.aspl`), many of them behind an index.
//!
//! `no_std`, no allocation, no maths of rendering. [`Asset::parse`] is where all
//! distrust ends: it checks length, magic, version, checksums, structure and
//! meaning, in that order and in time linear in the size, and returns a view that
//! borrows the bytes. Whatever reads through the view afterwards cannot fail.
//!
//! `SPEC.md` beside this crate specifies every byte.
//!
//! ```
//! use asperity_formats::{Asset, FormatError};
//!
//! let error = Asset::parse(b"RIFF....").unwrap_err();
//! assert!(matches!(error, FormatError::TooShort { .. }));
//! ```
#![no_std]
#![forbid(unsafe_code)]

mod asset;
mod checksum;
mod coupling;
mod encode;
mod error;
mod friction;
mod friction_law;
mod grid;
mod header;
mod latent;
pub mod library;
pub mod limits;
mod lsf;
mod provenance;
pub mod scene;
mod sections;
mod solid;
pub mod taps;
mod wire;

pub use asset::Asset;
pub use coupling::Coupling;
pub use encode::{AssetParts, FrictionParts, GridParts, ModelParts, TapParts, encode};
pub use error::{EncodeError, FormatError};
pub use friction::{Anchor, Friction};
pub use friction_law::{FrictionLaw, LawPoint};
pub use grid::{Grid, Model, Numerator, Vertex, VertexKind};
pub use header::{SectionInfo, VERSION};
pub use latent::Latents;
pub use library::Library;
pub use lsf::LsfCode;
pub use provenance::Provenance;
pub use scene::{Scene, SceneSurface};
pub use sections::{assemble, assembled_len};
pub use solid::Solid;
pub use taps::{Taps, Trace};
