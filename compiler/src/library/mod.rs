//! Libraries: built from a manifest, cached by content, merged, compared, taken apart.
//!
//! ```text
//! manifest → keys → cache → (missing: make, in parallel) → pack
//! ```
//!
//! A texture's [key](crate::sources::key) is everything that decides its bytes. What the cache holds
//! under it is not made again, so a build that was interrupted goes on where it stopped.
//! `docs/libraries.md` describes the manifest and shows the commands.

mod build;
mod cache;
mod change;
mod diff;
mod error;
mod facts;
mod loaded_library;
mod lock;
mod make;
pub mod manifest;
mod merge;
mod pack;
mod report;
mod shard;
mod spill;
mod user_folder;

pub use crate::emit::rename::renamed;
pub use build::{Build, Built, Request};
pub use cache::{Cache, default_folder};
pub use change::Change;
pub use diff::{Difference, diff};
pub use error::{EntryError, LibraryFault};
pub use facts::Facts;
pub use loaded_library::LoadedLibrary;
pub use lock::{Lock, LockError, Pinned};
pub use manifest::Manifest;
pub use merge::merge;
pub use pack::{LibraryError, NamedAsset, encode, encode_scene, scene_len};
pub use report::{Report, Row};
pub use shard::Shard;
pub use spill::Packed;
