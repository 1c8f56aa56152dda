//! The bytes of Asperity: the asset (`.asp`), one texture, and the library
//! (`.aspl`), many of them behind an index.
//!
//! `no_std`, no allocation, no maths of rendering. [`Asset::parse`] is where all
//! distrust ends: it checks length, magic, version, checksums, structure and
//! meaning, in that order and in time linear in the size, and returns a view that
//! borrows the bytes. Whatever reads through the view afterwards cannot fail.
//!
//! ```
//! use asperity_formats::{Asset, FormatError};
//!
//! # let bytes = include_bytes!(concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/law-v2.asp"));
//! let asset = Asset::parse(bytes)?;
//! assert_eq!(asset.name(), "Cork, waxed");
//! assert!(asset.grid().vertices().all(|vertex| vertex.sigma_m_s2 >= 0.0));
//!
//! // A single damaged bit is found.
//! let mut damaged = *bytes;
//! damaged[bytes.len() - 1] ^= 1;
//! assert!(matches!(Asset::parse(&damaged), Err(FormatError::Checksum { .. })));
//! let error = Asset::parse(b"RIFF....").unwrap_err();
//! assert!(matches!(error, FormatError::TooShort { .. }));
//! # Ok::<(), FormatError>(())
//! ```
//!
//! # What to read first
//!
//! [`Asset`], then the views that it gives: [`Grid`], [`Taps`], [`Friction`], [`Coupling`], [`ContactLaw`],
//! [`Direction`]. [`encode()`] writes an asset from [`AssetParts`]. [`Library`] finds one texture among many, [`Scene`] places them on solids, and
//! [`limits`] states what readers have to make room for. `SPEC.md` beside this crate specifies every byte.
#![no_std]
#![forbid(unsafe_code)]

mod asset;
mod checksum;
mod contact;
mod coupling;
mod direction;
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
pub use contact::{Adhesion, ContactLaw, Drag, Imprint, Relaxation, SpringPoint};
pub use coupling::Coupling;
pub use direction::Direction;
pub use encode::{
    AssetParts, ContactParts, FrictionParts, GridParts, ModelParts, TapParts, encode,
};
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
