//! Libraries: built from a manifest, cached by content, merged, compared, taken apart.
//!
//! ```text
//! manifest → keys → cache → (missing: make, in parallel) → pack
//! ```
//!
//! A texture's [key](crate::sources::key) is everything that decides its bytes. What the cache holds
//! under it is not made again, so a build that was interrupted continues where it stopped.
//! `docs/libraries.md` describes the manifest and shows the commands.
//!
//! ```
//! use asperity::{sources::builtin, library::{Build, Manifest, Request}, emit::lower::lower};
//! use asperity_formats::Library;
//!
//! let folder = tempfile::tempdir().expect("a temporary folder");
//! let grit = lower(&builtin::texture(), None).expect("a texture that fits an asset").bytes;
//! std::fs::write(folder.path().join("grit.asp"), &grit).expect("a writable folder");
//! let text = "[[texture]]\nname = \"grit\"\nasset = \"grit.asp\"\n";
//! let manifest = Manifest::of_text(&folder.path().join("desk.toml"), text).expect("a valid manifest");
//!
//! let request = Request::default();
//! let build = Build::new(&manifest, &request).expect("files that can be read");
//! // Entries with a prompt would ask for a prompt compiler.
//! let built = build.run(&|| unreachable!(), &|| ()).expect("textures that pass");
//! let mut bytes = Vec::new();
//! built.library.write(&mut bytes).expect("room in memory");
//! let library = Library::parse(&bytes).expect("a valid library");
//! assert_eq!(library.index().find("grit"), Some(0));
//! ```

mod build;
mod build_file;
mod cache;
mod change;
mod diff;
mod facts;
mod loaded_library;
mod lock;
mod make;
pub mod manifest;
mod merge;
mod report;
mod setup;
mod shard;
mod spill;
mod split;
mod user_folder;

pub use crate::name::check_name;
pub use build::{Build, Built, Request};
pub use build_file::BuildFile;
pub use cache::{Cache, default_folder};
pub use change::Change;
pub use diff::{Difference, diff};
pub use facts::Facts;
pub use loaded_library::LoadedLibrary;
pub use lock::{Lock, Pinned};
pub use manifest::Manifest;
pub use merge::merge;
pub use report::{Report, TextureReport};
pub use setup::{Setup, model_files};
pub use shard::Shard;
pub use spill::Packed;
pub(crate) use spill::no_room;
pub use split::split;
pub use user_folder::user_folder;
